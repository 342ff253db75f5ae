"""Representations of values in notebooks: pictures and tables."""

from __future__ import annotations

from html import escape
from typing import TYPE_CHECKING

from exactpt.render.frame import frame_of
from exactpt.render.still import Still, still_of
from exactpt.render.svg import svg_of
from exactpt.render.words import clean, incidences_in_words, polynomial_in_words, time_in_words

if TYPE_CHECKING:
    from exactpt.collision.contact import Contact
    from exactpt.scene.scene import Scene
    from exactpt.simulation.simulation import Simulation

__all__ = ["contact_html", "scene_svg", "simulation_svg"]


def scene_svg(scene: Scene) -> str:
    """An SVG picture of the bodies of a scene at its start."""
    return svg_of(frame_of(Still(scene, scene._start, None, None)))


def simulation_svg(simulation: Simulation) -> str:
    """An SVG picture of the bodies and the tiling at the current time, or of the contact."""
    return svg_of(frame_of(still_of(simulation)))


def contact_html(contact: Contact) -> str:
    """An HTML table of the exact time and of the incidences."""
    number = contact.time.simplified()
    heading = f"First contact at {time_in_words(number)} ({contact.kind})"
    lines = incidences_in_words(contact)
    if not number.is_rational:
        lines.insert(0, f"the time is a root of {polynomial_in_words(number._polynomial)}")
    items = "".join(f"<li>{escape(clean(line))}</li>" for line in lines)
    return f"<div><b>{escape(heading)}</b><ul>{items}</ul></div>"
