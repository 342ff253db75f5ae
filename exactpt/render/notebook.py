"""Representations of values in notebooks: pictures and tables."""

from __future__ import annotations

from html import escape
from typing import TYPE_CHECKING, Final

from exactpt.errors import BudgetExceeded
from exactpt.render.canvas import frame_of
from exactpt.render.film import film_of
from exactpt.render.marked import film_of_run
from exactpt.render.page import page_of
from exactpt.render.still import Still, has_fan, still_of
from exactpt.render.svg import svg_of
from exactpt.render.words import clean, incidences_in_words, polynomial_in_words, time_in_words

if TYPE_CHECKING:
    from exactpt.pair.contact import Contact
    from exactpt.scene.scene import Scene
    from exactpt.simulation.simulation import Simulation

MAX_EVENTS: Final = 2000
MAX_SECONDS: Final = 5.0
"""Bounds on the run of a scene that a notebook shows."""


def scene_svg(scene: Scene) -> str:
    """Return an SVG picture of the bodies of a scene at its start."""
    return svg_of(frame_of(Still(scene, scene.exact_start, None, None)))


def simulation_svg(simulation: Simulation) -> str:
    """Return an SVG picture of the bodies and the tiling at the current time, or of the contact."""
    return svg_of(frame_of(still_of(simulation)))


def scene_player(scene: Scene) -> str | None:
    """Return the animation of a scene in a frame of its own; None if its run takes long."""
    try:
        film = film_of(scene, max_events=MAX_EVENTS, max_seconds=MAX_SECONDS)
    except BudgetExceeded:
        return None
    return _framed(page_of(film, title="scene"))


def simulation_player(simulation: Simulation) -> str | None:
    """Return the animation of a remembered run; None if no time has passed."""
    history = simulation.history()
    if history.start == history.end:
        return None
    film = film_of_run(history, fan=has_fan(simulation))
    return _framed(page_of(film, title="simulation"))


def _framed(page: str) -> str:
    look = "width:100%;height:640px;border:0"
    return f'<iframe sandbox="allow-scripts" style="{look}" srcdoc="{escape(page)}"></iframe>'


def contact_html(contact: Contact) -> str:
    """Return an HTML table of the exact time and of the incidences."""
    number = contact.time.simplified()
    heading = f"First contact at {time_in_words(number)} ({contact.kind})"
    lines = incidences_in_words(contact)
    if not number.is_rational:
        lines.insert(0, f"the time is a root of {polynomial_in_words(number.exact_polynomial)}")
    items = "".join(f"<li>{escape(clean(line))}</li>" for line in lines)
    return f"<div><b>{escape(heading)}</b><ul>{items}</ul></div>"
