"""The registry of scenes: every source by name, each a function from random choices to a scene.

The name of a source may be followed by changes: ``tiny/pair+awkward+nudged``. They are those of
`fuzz.changes.registry`.
"""

from __future__ import annotations

from collections.abc import Callable
from fractions import Fraction
from functools import cache
from random import Random
from typing import Final, TypeAlias
from zlib import crc32

from exactpt import Body, Scene, Translation
from exactpt.testing import FAMILIES as PAIRS
from exactpt.testing import make_question
from exactpt.testing.scenes import CATALOGUE, EVERY, SPINNING, generate
from fuzz import many
from fuzz.changes.excerpts import scene_of
from fuzz.changes.registry import CHANGES, changed
from fuzz.general import NUMBERS, general_scene, lanes
from fuzz.laws import kept
from fuzz.questions.batched import touching_while_turning
from fuzz.questions.convoys import convoy
from fuzz.questions.crossed import crossed_pair
from fuzz.questions.pieces import planks, sliders, walkers
from fuzz.questions.pockets import pocket_scene
from fuzz.questions.rounded import rounded_pair
from fuzz.questions.scaled import scaled_pair, wheels
from fuzz.questions.scenes import (
    arc_scene,
    chevrons,
    crowded_scene,
    distant_scene,
    meeting_scene,
    relay,
)
from fuzz.questions.spinning import path_scene, spinning_scene
from fuzz.questions.tiny import pair_scene, touching_scene
from fuzz.questions.touching_rings import threaded, touching_pair
from fuzz.small_scope.scope import planned

__all__ = ["KINDS", "SOURCES", "drawn", "is_source", "made", "names_of"]

Source: TypeAlias = Callable[[Random], Scene]

SEEDS: Final = 10**6
"""Number of seeds of a family."""

SHAPES: Final = (
    [(0, 0)],
    [(0, 0), (1, 0)],
    [(0, 0), (2, 0), (0, 2)],
    [(0, 0), (2, 0), (2, 2), (0, 2)],
)
DENOMINATORS: Final = (3, 7, 9, 13)
HOOK: Final = [(0, 0), (6, 0), (6, 5)]
CORNERED: Final = (
    [(0, 0)],
    [(0, 0), (3, 1)],
    [(0, 0), (4, 0), (4, 4), (0, 4)],
    [(0, 0), (5, 1), (1, 3)],
    [(0, 0), (9, 0), (9, 2), (2, 2), (2, 9), (0, 9)],
    HOOK,
    [(0, 6), (-1, 1), (-6, 0), (-1, -1), (0, -6), (1, -1), (6, 0), (1, 1)],
)
"""Shapes with ends, corners and inner corners; the hook is a chain."""
SPEEDS: Final = (-3, -2, -1, 1, 2, 3)
CROWDS: Final = ("convex", "row", "convoy", "small_grid")


def _of_family(name: str) -> Source:
    return lambda random: scene_of(name, random.randrange(SEEDS))


def _of_pair(name: str) -> Source:
    return lambda random: make_question(name, random.randrange(SEEDS)).scene


def fractions_scene(random: Random) -> Scene:
    """Return two or three small shapes with places and velocities in thirds, sevenths, ..."""
    denominator = random.choice(DENOMINATORS)

    def number(most: int) -> Fraction:
        return Fraction(random.randint(-most * denominator, most * denominator), denominator)

    bodies = []
    for i in range(random.choice([2, 3, 3])):
        x, y = number(4), number(4)
        shape = [(x + u, y + v) for u, v in random.choice(SHAPES)]
        bodies.append(Body(f"b{i}", shape, Translation([0, number(2)], [0, number(2)])))
    return Scene(bodies, time=(0, 3))


def grazing_scene(random: Random) -> Scene:
    """A chain that falls and rises again: at its lowest place an end of it, or both, meet points.

    Its ends are level, and a point is level with them: an orientation of these has an even zero.
    """
    width, height, turn = random.randint(1, 4), random.randint(1, 3), random.randint(1, 3)
    corners = [(width, 0), (width, height), (0, height), (0, 0)]
    falling = Translation([0], [turn * turn, -2 * turn, 1])
    points = [(width, 0), (0, 0), (width + random.randint(1, 3), random.randint(-7, 0))]
    chain = Body("chain", corners, falling, closed=False)
    some = random.sample(points, random.randint(1, 3))
    return Scene([chain, *(Body(str(k), [place]) for k, place in enumerate(some))], (0, 2 * turn))


def corner_scene(random: Random) -> Scene:
    """Return a body of which a vertex comes to a vertex of a wall at t = 8, if nothing else does.

    It comes to an end, to an inner corner, or corner on corner.
    """
    (mover, wall), (u, v) = random.choices(CORNERED, k=2), random.choices(SPEEDS, k=2)
    (x, y), (z, w) = random.choice(mover), random.choice(wall)
    shape = [(p - x + z - 8 * u, q - y + w - 8 * v) for p, q in mover]
    moving = Body("body", shape, Translation([0, u], [0, v]), closed=mover is not HOOK)
    return Scene([moving, Body("wall", wall, closed=wall is not HOOK)], time=(0, 20))


def one_point(random: Random) -> Scene:
    """Return a point alone: no tiling has an edge, and each query of a space has its own answer."""
    place = random.randint(-2, 2), random.randint(-2, 2)
    velocity = random.choice([0, 1])
    return Scene([Body("point", [place], Translation([0, velocity]))], time=(0, 2))


def crossing_points(random: Random) -> Scene:
    """Return points that move on a small grid, where many are in line and level at one time."""
    cells = random.sample(range(64), random.randint(3, 12))
    bodies = []
    for cell in cells:
        x, y = divmod(cell, 8)
        motion = Translation([0, random.randint(-1, 1)], [0, random.randint(-1, 1)])
        bodies.append(Body(f"p{cell}", [(x, y)], motion))
    return Scene(bodies, time=(0, 8))


def _of_scope(random: Random) -> Scene:
    return planned(random.randrange(SEEDS)).scene


def _kept(name: str) -> Source:
    return lambda _: kept.kept(name).scene


def _whole(name: str) -> Source:
    return lambda random: generate(name, random.randrange(SEEDS))


def _nothing(random: Random) -> Scene:  # noqa: ARG001
    return Scene([])


def _crowd(random: Random) -> Scene:
    return generate(random.choice(CROWDS), random.randrange(SEEDS))


def _lanes(random: Random) -> Scene:
    return lanes(random.choice(NUMBERS), random.randrange(SEEDS), bodies=random.choice([16, 64]))


SOURCES: Final[dict[str, Source]] = {
    **{f"family/{name}": _of_family(name) for name in EVERY if name not in SPINNING},
    **{f"pair/{name}": _of_pair(name) for name in PAIRS},
    "tiny/pair": pair_scene,
    "tiny/touching": touching_scene,
    "tiny/distant": distant_scene,
    "tiny/crowded": crowded_scene,
    "tiny/meeting": meeting_scene,
    "tiny/rounded": rounded_pair,
    "tiny/fractions": fractions_scene,
    "tiny/rings": touching_pair,
    "tiny/threads": threaded,
    "tiny/scaled": scaled_pair,
    "tiny/crossed": crossed_pair,
    "tiny/crossing points": crossing_points,
    "tiny/one point": one_point,
    "tiny/turned": touching_while_turning,
    "scope": _of_scope,
    **{f"{kept.PREFIX}{name}": _kept(name) for name in kept.names()},
    "crowd": _crowd,
    "walkers": walkers,
    "planks": planks,
    "wheels": wheels,
    **{f"whole/{name}": _whole(name) for name in EVERY if name not in SPINNING},
    **{f"many/{make.__name__}": make for make in many.KINDS},
    "long/arc": many.long_arc,
    "general/any": general_scene,
    "general/lanes": _lanes,
    "far/relay": relay,
    "chevrons": chevrons,
    "far/arc": arc_scene,
    "pockets": pocket_scene,
    "tiny/corners": corner_scene,
    "tiny/sliders": sliders,
    "tiny/grazing": grazing_scene,
    "far/convoy": convoy,
    "spinning": spinning_scene,
    "poses": path_scene,
    "own": _nothing,
}
"""Some bodies of a scene of a family; pairs of `exactpt.testing`; small integers, with ties; scenes
of the small scope, and those of tests/cases; whole scenes of many bodies; bodies in general
position, near or far in space and time; contacts at the last double before bodies turn back, and
far from the origin; bodies that turn at a constant rate or along poses; bodies of many pieces of
motion, long thin ones, and those of many vertices; no bodies, for laws that draw their own cases. A
new family is a new row here, and all laws take it."""

KINDS: Final[dict[str, tuple[str, ...]]] = {
    "turning": ("turning", "turning_stars", "turning_points", "rolling_discs"),
    "deforming": ("deforming", "keyframed"),
    "curved": ("ballistic", "ballistic_points", "parabola_points"),
    "pieces": ("pieces", "piecewise_points", "rounded_motions"),
    "convex": tuple(CATALOGUE["convex"]),
    "points": tuple(CATALOGUE["points"]),
    "radii": tuple(CATALOGUE["rounded"]),
    "rings": (*CATALOGUE["rings"], *CATALOGUE["touching"]),
}
"""Families by kind of motion or of body: a law that names a kind gives it a share of its own,
however many families there are of it."""


@cache
def names_of(pattern: str) -> tuple[str, ...]:
    """Return the sources that a pattern names: "tiny", "family", "turning", "tiny/pair+awkward".

    Raises:
        KeyError: if there is none, or a change of that name does not exist.
    """
    head, *changes = pattern.split("+")
    for change in changes:
        CHANGES[change]
    if head in KINDS:
        names = [f"family/{name}" for name in KINDS[head]]
    else:
        names = [name for name in SOURCES if name == head or name.startswith(f"{head}/")]
    if not names:
        raise KeyError(pattern)
    return tuple("+".join([name, *changes]) for name in names)


def is_source(text: str) -> bool:
    """Return True if a text is the name of one source, with changes that exist."""
    name, *changes = text.split("+")
    return name in SOURCES and all(change in CHANGES for change in changes)


def made(source: str, random: Random) -> Scene:
    """Return a scene of a source, with its changes.

    Raises:
        InputError, TypeError, ValueError: if a change is not possible for the scene.
    """
    name, *changes = source.split("+")
    return changed(SOURCES[name](random), changes, random)


def drawn(patterns: tuple[str, ...], lot: str, number: int) -> str:
    """Return the source of the case of a number: the patterns take turns.

    Within a pattern the highest hash of a source and the lot wins (rendezvous hashing). So a new
    source takes a few cases over, and leaves all others as they are.
    """
    group = names_of(patterns[number % len(patterns)])

    def weight(name: str) -> int:
        return crc32(f"{lot} {number} {name}".encode())

    return max(group, key=weight)
