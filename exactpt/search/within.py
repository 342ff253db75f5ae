"""The first time at which two bodies, or any two of a scene, are within a distance."""

from __future__ import annotations

from collections.abc import Collection, Iterable, Sequence
from dataclasses import dataclass
from typing import TypeAlias, final, overload

from exactpt.brief import record_in_brief
from exactpt.errors import InputError
from exactpt.kernel.algebraic import AlgebraicNumber
from exactpt.kernel.numbers import QQ, Rational, rational, show
from exactpt.kernel.square_root import exact_square_root, root_above
from exactpt.motion.body import Body
from exactpt.pair.distance import compare_distance
from exactpt.pair.pieces_of_two import two_bodies
from exactpt.pair.start import within_at_start
from exactpt.scene.groups import groups_given
from exactpt.scene.scene import Scene, a_scene, scene_of
from exactpt.search.query import Selection
from exactpt.search.reading import rows_of_scene
from exactpt.search.sweep_search import Slabs, Sweep, pairs_that_count

Near: TypeAlias = "tuple[AlgebraicNumber, Collection[tuple[int, int]]]"
"""The time of an approach, and the indices i < j of the bodies that are within the distance."""


@final
@dataclass(frozen=True, slots=True)
class Approach:
    """The first time at which any two bodies are within a distance.

    Attributes:
        time: the exact time.
        pairs: the names of all pairs within the distance at that time, each in the order of
            the scene, sorted.
    """

    time: AlgebraicNumber
    pairs: tuple[tuple[str, str], ...]

    def __repr__(self) -> str:
        return record_in_brief(self)


@overload
def first_within(
    scene: Scene,
    a: str,
    b: str,
    distance: Rational | None = None,
    *,
    distance_squared: Rational | None = None,
) -> AlgebraicNumber | None: ...


@overload
def first_within(
    scene: Scene,
    *,
    distance: Rational | None = None,
    distance_squared: Rational | None = None,
    between: Iterable[Sequence[str]] | None = None,
    ignoring: Iterable[Iterable[str]] = (),
) -> Approach | None: ...


def first_within(
    scene: Scene,
    a: str | None = None,
    b: str | None = None,
    distance: Rational | None = None,
    *,
    distance_squared: Rational | None = None,
    between: Iterable[Sequence[str]] | None = None,
    ignoring: Iterable[Iterable[str]] = (),
) -> AlgebraicNumber | Approach | None:
    """Return the first time in the scene's span at which bodies are at most a distance apart.

    >>> from exactpt import Body, Scene, Translation
    >>> ball = Body("ball", [(0, 0), (1, 0), (0, 1)], Translation([0, 2]))
    >>> scene = Scene([ball, Body("wall", [(9, -5), (9, 5)])], time=(0, 10))
    >>> first_within(scene, "ball", "wall", 1)
    AlgebraicNumber('7/2')
    >>> first_within(scene, distance=1)
    Approach(time=AlgebraicNumber('7/2'), pairs=(('ball', 'wall'),))

    A `Spin` or a `PosePath` counts as its pieces: docs/howto/motions.md has the bounds for the
    true motion.

    Args:
        scene: the bodies and the time span.
        a: the name of a body.
        b: the name of another body; without names, any two bodies of the scene.
        distance: a Euclidean distance >= 0; 0 means the first contact.
        distance_squared: the square of the distance, instead of it, so that the square root of
            a rational number can be given. (Of bodies with radii it must be the square of a
            rational number.)
        between: pairs of names, for a question without names; other pairs do not count.
        ignoring: groups of names and patterns as of a `Scene`, beside those of the scene, for a
            question without names; two bodies of one group do not count.

    Returns:
        The exact time, of any two bodies with the pairs; None if the bodies stay farther apart.

    Raises:
        InputError: if a body does not exist, or the distance is missing or negative, or its
            square is not that of a rational number although a body has a radius; if a group is
            wrong, or named bodies ignore each other.
    """
    a_scene(scene)
    if (a is None) != (b is None):
        raise InputError(
            "two names of bodies are given, or none for all bodies; the distance by its name"
        )
    squared = _square_of(distance, distance_squared)
    more = groups_given(ignoring)
    if a is not None and b is not None:
        if between is not None or more:
            raise InputError("between and ignoring are not supported for two named bodies")
        first, second = two_bodies(scene, a, b)
        return time_within_of_two(first, second, scene.exact_start, scene.exact_end, squared)
    selection = Selection(scene, between, more)
    largest_radius = max((body.exact_radius for body in scene.bodies), default=QQ(0))
    square_between_cores(squared, largest_radius)  # refuses a square without a rational root
    found: Near | None = None
    if len(scene.bodies) > 1:
        found = _first(scene, squared, selection)
    if found is None:
        return None
    names = {(scene.bodies[i].name, scene.bodies[j].name) for i, j in found[1]}
    return Approach(found[0], tuple(sorted(names)))


def _square_of(distance: Rational | None, squared: Rational | None) -> QQ:
    """Return the square of the distance of a caller, who gives either of them.

    Raises:
        InputError: if not exactly one of them is given, or it is negative.
    """
    given = squared if distance is None else distance
    if given is None or (distance is not None and squared is not None):
        raise InputError("expected either a distance or its square")
    number = rational(given)
    if number < 0:
        raise InputError(f"a distance is not negative: {show(number)}")
    return number if distance is None else number * number


def square_between_cores(squared: QQ, radii: QQ) -> QQ:
    """Return the squared distance of two cores at which the bodies are at a distance.

    Args:
        squared: the square of the distance of the bodies.
        radii: the sum of their radii.

    Raises:
        InputError: if the bodies have radii and the distance is irrational.
    """
    if not radii:
        return squared
    distance = exact_square_root(squared)
    if distance is None:
        raise InputError(
            f"distance_squared={show(squared)}: of rounded bodies it must be the square of "
            "a rational"
        )
    return (distance + radii) ** 2


def time_within_of_two(a: Body, b: Body, start: QQ, end: QQ, squared: QQ) -> AlgebraicNumber | None:
    """Return the first time in [start, end] at which two bodies are within a distance.

    Args:
        a: a body.
        b: another body.
        start: the first time.
        end: the last time; it may be the first one.
        squared: the square of the distance.
    """
    squared_of_cores = square_between_cores(squared, a.exact_radius + b.exact_radius)
    if start == end:
        is_within = compare_distance(a, b, start, squared_of_cores) <= 0
        return AlgebraicNumber(start) if is_within else None
    scene = scene_of((a, b), start, end)
    found = _first(scene, squared, Selection(scene))
    return None if found is None else found[0]


def _first(scene: Scene, squared: QQ, selection: Selection) -> Near | None:
    """Return the first approach of any two bodies of a scene that count."""
    radii = [body.exact_radius for body in scene.bodies]

    def limit(i: int, j: int) -> QQ:
        return square_between_cores(squared, radii[i] + radii[j])

    rows = rows_of_scene(scene, root_above(squared) / 2)
    pairs = pairs_that_count(rows, selection, with_themselves=False)
    sweep = Sweep(rows, Slabs(rows, pairs), limit)
    at_start = [ij for ij, _ in within_at_start(scene, limit, sweep.near_at_start())]
    if at_start:
        return AlgebraicNumber(scene.exact_start), at_start
    found = sweep.first_after_start()
    if found is None:
        return None
    return found.number, [(min(t.body, t.other), max(t.body, t.other)) for t in found.touches]
