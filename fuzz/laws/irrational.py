"""A law about the tiling at an event whose time is irrational."""

from __future__ import annotations

from fractions import Fraction
from random import Random
from typing import Final

from exactpt import AlgebraicNumber, InputError, Scene, Simulation
from exactpt.pseudotriangulation.snapshot import Node, Snapshot
from fuzz.laws.law import check_equal, refuse_unless
from fuzz.laws.tilings import a_tiling
from fuzz.witnesses import Difference

__all__ = ["irrational_tiling_is_that_just_after"]

STEPS: Final = 12
"""Number of steps of a run."""

NEAR: Final = Fraction(1, 2**80)
"""Width to which a time is refined; places are compared within the square root of it."""

HALVINGS: Final = 400
"""Number of halvings after which a time between now and the next event must be found."""


def irrational_tiling_is_that_just_after(scene: Scene, random: Random) -> str:
    """At an irrational event the tiling is that of a time just after it, at exact places."""
    run = Simulation(scene, tiling=a_tiling(scene, random))
    seen = 0
    for _ in range(STEPS):
        if not run.step() or run.contact is not None:
            break
        now = run.now.simplified()
        if now.is_rational:
            continue
        tiling = run.tiling
        later = _just_after(run, now)
        check_equal("edges", tiling.edges, later.edges)
        check_equal("faces", tiling.faces, later.faces)
        check_equal("time", tiling.at, now)
        _check_place(run, random.choice(tiling.nodes), now)
        seen += 1
    refuse_unless(seen)
    return f"{run.name}, {'some' if seen > 2 else 'few'} irrational times"


def _just_after(run: Simulation, now: AlgebraicNumber) -> Snapshot:
    """Return the tiling at a rational time between now and the next event."""
    beyond = Fraction(1)
    for _ in range(HALVINGS):
        beyond /= 2
        while now.high - now.low > beyond:
            now.refine()
        try:
            return run.space(now.high + beyond).snapshot
        except InputError:  # not before the next event, or not within the time span
            continue
    raise Difference("just after", f"no time between {now} and the next event")


def _check_place(run: Simulation, node: Node, now: AlgebraicNumber) -> None:
    """Check that a node is where its vertex is a little before now.

    Raises:
        Difference: if it is elsewhere.
    """
    while now.high - now.low > NEAR:
        now.refine()
    margin = Fraction(1, 2**40)
    place = run.scene.body(node.body).at(now.low)[node.vertex]
    for found, near in zip((node.x, node.y), place, strict=True):
        if not near - margin < found < near + margin:
            raise Difference("node", f"{found} of {node}, but just before it is at {near}")
