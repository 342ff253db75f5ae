"""Laws about the fan triangulation of points, which is maintained beside the incremental tiling."""

from __future__ import annotations

from fractions import Fraction
from itertools import pairwise
from random import Random
from typing import Final, TypeAlias

from exactpt import Body, RunEvent, Scene, Simulation, onward
from exactpt.kernel.algebraic import AlgebraicNumber, rational_between
from exactpt.kernel.numbers import QQ, fraction
from exactpt.pseudotriangulation.snapshot import Snapshot
from fuzz.laws.law import check_equal, refuse_unless
from fuzz.laws.runs import restored
from fuzz.witnesses import Difference, tilings_of

__all__ = ["fan_events_lead_from_fan_to_fan", "fan_goes_on_after_a_change"]

DENOMINATOR: Final = 10_007
"""A prime: the denominator of shares, which no scene has."""

Edges: TypeAlias = set[frozenset[str]]
"""Edges by the names of their ends."""


def fan_events_lead_from_fan_to_fan(scene: Scene, random: Random) -> str:
    """The events of a fan change it as its tiling does; all others are those without a fan.

    The run is saved and read again on the way.
    """
    refuse_unless(scene.bodies and "incremental" in tilings_of(scene))
    without = Simulation(scene, tiling="incremental")
    refuse_unless(without.contact is None)
    expected = list(without.run())
    times = [AlgebraicNumber(scene.start), *sorted({event.time for event in expected})]
    if without.contact is None:
        times.append(AlgebraicNumber(scene.end))

    run = Simulation(scene, tiling="incremental", fan=True)
    saved_at = random.randrange(len(times))
    edges: Edges | None = None
    events: list[RunEvent] = []
    for number, time in enumerate(_between(times, random)):
        if number == saved_at:
            run = restored(run)
        new = list(run.run(until=time))
        after = _triangulation(run.tiling)
        if edges is not None:  # at the start itself fewer edges may be there than just after it
            check_equal(f"fan at t = {time}", _changed(edges, new), after)
        edges = after
        events += new
    events += run.run()
    others = [event.to_json() for event in events if event.kind != "fan"]
    check_equal("events of other kinds", others, [event.to_json() for event in expected])
    changes = _count_changes(events)
    check_equal("number of changes", run.stats["fan_changes"], changes)
    return "changes" if changes else "no changes"


def fan_goes_on_after_a_change(scene: Scene, random: Random) -> str:
    """Events lead a fan over new motions and points that go, and all of its changes are counted."""
    refuse_unless(scene.bodies and "incremental" in tilings_of(scene))
    run = Simulation(scene, tiling="incremental", fan=True)
    refuse_unless(run.contact is None)
    span, place = scene.end - scene.start, Fraction(random.randint(1, DENOMINATOR - 1), DENOMINATOR)
    events = list(run.run(until=scene.start + place * span))
    refuse_unless(run.contact is None)
    before = _triangulation(run.tiling)
    if random.random() < 0.5:
        run.remove(random.choice(scene.bodies).name)  # the tiling is built anew
    else:
        chosen = random.sample(scene.bodies, random.randint(1, min(3, len(scene.bodies))))
        run.set_motions({body.name: _in_any_direction(body, run, random) for body in chosen})
    later = list(run.run(until=scene.end - (1 - place) * span / 7))
    if run.contact is None:
        check_equal("fan after a change", _changed(before, later), _triangulation(run.tiling))
    changes = _count_changes([*events, *later])
    check_equal("number of changes", run.stats["fan_changes"], changes)
    return "changes" if changes else "no changes"


def _in_any_direction(body: Body, run: Simulation, random: Random) -> Body:
    """Return a body that goes on from where it is now."""
    velocity = random.randint(-4, 4), random.randint(-4, 4)
    return body.with_motion(onward(body, run.now.low, velocity))


def _count_changes(events: list[RunEvent]) -> int:
    """Return the number of edges that enter or leave the fan by some events."""
    return sum(len(e.removed) + len(e.added) for e in events if e.kind == "fan")


def _between(times: list[AlgebraicNumber], random: Random) -> list[Fraction]:
    """Return a rational time between any two consecutive ones.

    At a simple one, such as 1, points may be in line for an instant, without an event; then fewer
    edges are there. So it is one of a large denominator.
    """
    chosen = []
    for a, b in pairwise(times):
        if a < b:
            first = rational_between(a, b)
            second = rational_between(AlgebraicNumber(first), b)
            share = QQ(random.randint(1, DENOMINATOR - 1), DENOMINATOR)
            chosen.append(fraction(first + share * (second - first)))
    return chosen


def _triangulation(snapshot: Snapshot) -> Edges:
    """Return the edges of a tiling and of its fan."""
    names = [f"{node.body}:{node.vertex}" for node in snapshot.nodes]
    ends = [*((edge.u, edge.v) for edge in snapshot.edges), *snapshot.fan]
    return {frozenset((names[u], names[v])) for u, v in ends}


def _changed(edges: Edges, events: list[RunEvent]) -> Edges:
    """Return the edges after some events.

    Raises:
        Difference: if an event removes an edge that is not there, or adds one that is.
    """
    for event in events:
        if event.kind == "fan":
            removed, added = (
                {frozenset(pair) for pair in of} for of in (event.removed, event.added)
            )
            if not removed <= edges or edges & added:
                raise Difference("event of the fan", f"{event}")
            edges = edges - removed | added
    return edges
