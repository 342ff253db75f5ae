"""The scope: its scenes by number, those of the complete part and those of the sample.

A round consists of each placement of the complete part with each order of contact, and of the
sample. The other properties of a scene (time of contact, direction, motion in the other
coordinate, moving body, symmetry, order of bodies and vertices) vary from placement to
placement and from round to round.
"""

from __future__ import annotations

from collections import Counter
from functools import cache
from typing import Final, NamedTuple

from exactpt.scene.scene import Scene
from fuzz.small_scope.motions import ORDERS, SLOTS, Approach, Clock, approaches
from fuzz.small_scope.numbering import mixed, spread
from fuzz.small_scope.placements import Placement, complete
from fuzz.small_scope.sample import SAMPLES, Third, sampled
from fuzz.small_scope.scenes import Plan, Presentation, scene_of, touching

__all__ = ["COMPLETE", "Cell", "Planned", "entries", "in_part", "planned", "sizes"]

COMPLETE: Final = "complete"


class Cell(NamedTuple):
    """The common properties of a group of scenes.

    Attributes:
        part: "complete", or the part of the sample.
        kinds: the kinds of the two shapes.
        order: the order of contact.
        place: what touches.
        time: the time of contact, by name.
    """

    part: str
    kinds: str
    order: str
    place: str
    time: str


class Planned(NamedTuple):
    """A scene with a planned contact.

    Attributes:
        number: number of the scene.
        cell: its group.
        clock: the planned contact is at the zero of its first local time.
        scene: the scene.
    """

    number: int
    cell: Cell
    clock: Clock
    scene: Scene


LEAST: Final = 200
"""Minimum number of scenes in a round with the same kinds of shapes, order and place; if there are
fewer placements, each is repeated."""


class Entry(NamedTuple):
    """A placement of the complete part.

    Attributes:
        placement: the placement.
        copy: index of this repetition within a round.
        copies: number of repetitions within a round.
    """

    placement: Placement
    copy: int
    copies: int


@cache
def entries() -> tuple[Entry, ...]:
    """The placements of the complete part, those of rare kinds repeated."""
    counts = Counter((p.kinds, p.place) for p in complete())
    times = {key: -(-LEAST // count) for key, count in counts.items()}
    return tuple(
        Entry(p, copy, times[p.kinds, p.place])
        for p in complete()
        for copy in range(times[p.kinds, p.place])
    )


@cache
def sizes() -> dict[str, int]:
    """The number of scenes of each part of a round."""
    return {COMPLETE: len(entries()) * len(ORDERS), **SAMPLES}


def planned(number: int) -> Planned:
    """The scene with a number.

    In a round the parts are evenly mixed; each part contributes all of its scenes once.
    """
    turn, place = divmod(number, sum(sizes().values()))
    index = spread(place, sum(sizes().values()))
    for part, size in sizes().items():
        if index < size:
            return in_part(number, part, index, turn)
        index -= size
    raise AssertionError("an index is in one of the parts")


def in_part(number: int, part: str, index: int, turn: int) -> Planned:
    """The scene with an index in a part of a round, in the presentation given by its number."""
    if part == COMPLETE:
        place, k = divmod(index, len(ORDERS))
        placement, copy, copies = entries()[place]
        place, turn = place - copy, turn * copies + copy
        third, order = None, ORDERS[k]
    else:
        place = index + turn * SAMPLES[part]
        placement, third = sampled(part, place)
        order = ORDERS[1 + mixed(place) // 1024 % (len(ORDERS) - 1)]
    plan = _plan(placement, third, order, place, turn)
    cell = Cell(part, placement.kinds, order, placement.place, plan.clock.time)
    scene = scene_of(plan, Presentation.numbered(mixed(number)))
    return Planned(number, cell, plan.clock, scene)


def _plan(placement: Placement, third: Third | None, order: str, place: int, turn: int) -> Plan:
    """The plan for a turn; after enough rounds all plans have been used."""
    if order == "rest":
        return Plan(placement, third, order, SLOTS[-1], Approach("alone", 0), 0)
    both = [approaches(order, placement.free, touching(placement, mover)[0]) for mover in (0, 1)]
    count = len(SLOTS) * (len(both[0]) + len(both[1]))
    first = mixed(place * len(ORDERS) + ORDERS.index(order))
    k, slot = divmod((first + spread(turn, count)) % count, len(SLOTS))
    mover = int(k >= len(both[0]))
    return Plan(placement, third, order, SLOTS[slot], (both[0] + both[1])[k], mover)
