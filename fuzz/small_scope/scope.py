"""The scope: its scenes by number, those of the complete part and those of the sample.

A round has `TOTAL` scenes: each placement of the complete part with each order of contact,
and the sample. What is left of a scene (the time of contact, the direction, what the other
coordinate does, which body moves, how the scene is turned and listed) takes turns, from
placement to placement and from round to round.
"""

from __future__ import annotations

from collections import Counter
from functools import cache
from typing import Final, NamedTuple

from exactpt.scene.scene import Scene
from fuzz.small_scope.motions import ORDERS, SLOTS, Clock, Way, ways
from fuzz.small_scope.numbering import mixed, spread
from fuzz.small_scope.placements import Placement, complete
from fuzz.small_scope.sample import SAMPLES, Third, sampled
from fuzz.small_scope.scenes import Plan, Presentation, scene_of, touching

__all__ = ["COMPLETE", "Cell", "Planned", "entries", "in_part", "planned", "sizes"]

COMPLETE: Final = "complete"


class Cell(NamedTuple):
    """What scenes have in common.

    Attributes:
        part: "complete", or of which sample.
        kinds: the two shapes.
        order: of contact.
        place: what touches.
        time: when.
    """

    part: str
    kinds: str
    order: str
    place: str
    time: str


class Planned(NamedTuple):
    """A scene and the contact that is planned in it.

    Attributes:
        number: of the scene.
        cell: where it belongs.
        clock: the planned contact is where the first local time is 0.
        scene: the scene.
    """

    number: int
    cell: Cell
    clock: Clock
    scene: Scene


LEAST: Final = 200
"""Scenes of a round with the same kinds of shapes, order and place, at least: where there are
fewer placements, each comes more than once."""


class Entry(NamedTuple):
    """A placement of the complete part.

    Attributes:
        placement: the placement.
        copy: which one it is of the times that it comes in a round.
        copies: how often it comes.
    """

    placement: Placement
    copy: int
    copies: int


@cache
def entries() -> tuple[Entry, ...]:
    """The placements of the complete part, those of rare kinds more than once."""
    counts = Counter((p.kinds, p.place) for p in complete())
    times = {key: -(-LEAST // count) for key, count in counts.items()}
    return tuple(
        Entry(p, copy, times[p.kinds, p.place])
        for p in complete()
        for copy in range(times[p.kinds, p.place])
    )


@cache
def sizes() -> dict[str, int]:
    """How many scenes each part of a round has."""
    return {COMPLETE: len(entries()) * len(ORDERS), **SAMPLES}


def planned(number: int) -> Planned:
    """The scene with a number.

    In a round the parts come evenly mixed; of each part all scenes come once.
    """
    turn, place = divmod(number, sum(sizes().values()))
    index = spread(place, sum(sizes().values()))
    for part, size in sizes().items():
        if index < size:
            return in_part(number, part, index, turn)
        index -= size
    raise AssertionError("an index is in one of the parts")


def in_part(number: int, part: str, index: int, turn: int) -> Planned:
    """The scene with an index in a part of a round, to be shown as its number wants it."""
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
    """The plan whose turn it is: in enough rounds all come."""
    if order == "rest":
        return Plan(placement, third, order, SLOTS[-1], Way("alone", 0), 0)
    both = [ways(order, placement.free, touching(placement, mover)[0]) for mover in (0, 1)]
    count = len(SLOTS) * (len(both[0]) + len(both[1]))
    first = mixed(place * len(ORDERS) + ORDERS.index(order))
    k, slot = divmod((first + spread(turn, count)) % count, len(SLOTS))
    mover = int(k >= len(both[0]))
    return Plan(placement, third, order, SLOTS[slot], (both[0] + both[1])[k], mover)
