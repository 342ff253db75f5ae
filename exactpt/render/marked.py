"""The film of a run that went on after contacts, with what happened to the bodies as events."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING, Final, TypeVar

from exactpt.kernel.numbers import rational
from exactpt.render.film import Change, Film, Step, film_of, film_without_tiling
from exactpt.render.tracker import EdgeSpan, TileSpan
from exactpt.render.words import clean, short
from exactpt.scene.scene import scene_of

if TYPE_CHECKING:
    from collections.abc import Sequence

    from exactpt.simulation.history import History, Mark

Span = TypeVar("Span", EdgeSpan, TileSpan)

_WORDS: Final = {
    "contact": "{} come into contact",
    "plan": "a new motion for {}",
    "arrival": "{} added",
    "departure": "{} removed",
}
_NAMED: Final = 4
"""Maximum number of bodies that an event names."""


def film_of_run(history: History, *, fan: bool = False) -> Film:
    """Return the film of a run so far.

    With the same bodies throughout, it is that of `History.scene`, with a tiling and perhaps its
    fan; bodies that came or went are shown without one.

    Raises:
        InputError: if no time has passed.
    """
    if history.is_scene:
        return _marked(film_of(history.scene(), fan=fan), history.marks)
    lives = history.lives
    scene = scene_of([life.body for life in lives], rational(history.start), rational(history.end))
    spans = tuple((rational(life.since), rational(life.until)) for life in lives)
    return _marked(film_without_tiling(scene, "no", history.contact, spans), history.marks)


def _marked(film: Film, marks: Sequence[Mark]) -> Film:
    """Return a film with more events; its last contact, if there is one, is not marked twice."""
    last = None if film.contact is None else film.contact.time
    added = [
        Step(mark.time, [Change(mark.kind, (), (), _in_words(mark))], ())
        for mark in marks
        if mark.kind != "contact" or last is None or mark.time != last
    ]
    place = {0: 0}
    steps: list[Step] = []
    numbered = [*((0, step) for step in added), *enumerate(film.steps, 1)]
    for number, step in sorted(numbered, key=lambda pair: pair[1].time):
        if steps and steps[-1].time == step.time:
            before = steps[-1]
            steps[-1] = Step(
                step.time, before.changes + step.changes, before.certificate + step.certificate
            )
        else:
            steps.append(step)
        if number:
            place[number] = len(steps)
    return replace(
        film,
        steps=tuple(steps),
        edges=tuple(_moved(edge, place) for edge in film.edges),
        tiles=tuple(_moved(tile, place) for tile in film.tiles),
    )


def _moved(span: Span, place: dict[int, int]) -> Span:
    """Return a lifetime in numbers of other steps."""
    last = None if span.last is None else place[span.last]
    return span._replace(first=place[span.first], last=last)


def _in_words(mark: Mark) -> str:
    names = [short(clean(name)) for name in mark.bodies]
    if len(names) > _NAMED:
        names = [*names[: _NAMED - 1], f"{len(names) - _NAMED + 1} others"]
    together = f"{', '.join(names[:-1])} and {names[-1]}" if len(names) > 1 else "".join(names)
    return _WORDS[mark.kind].format(together)
