"""The first time at which two bodies, or any two of a scene, are within a distance."""

from __future__ import annotations

import warnings
from collections.abc import Collection, Iterable, Sequence
from dataclasses import dataclass
from functools import partial
from itertools import combinations, islice, pairwise, takewhile
from typing import Final, Literal, TypeAlias, final, overload

import numpy as np

from exactpt.errors import InputError
from exactpt.kernel.algebraic import AlgebraicNumber
from exactpt.kernel.numbers import QQ, Rational, enclosing_floats, isqrt
from exactpt.motion.body import Body
from exactpt.pairs.approach_search import ApproachSearch
from exactpt.pairs.candidate_pairs import candidate_pairs
from exactpt.pairs.piece_pairs import two_bodies
from exactpt.pairs.pieces import ContactDistance, MotionPiece
from exactpt.pairs.rational import Earliest
from exactpt.pairs.search import first_among_pieces, scene_pieces_if_linear
from exactpt.pairs.selection import Selection
from exactpt.pairs.start import near_at_start, within_at_start
from exactpt.pairs.within import Norm, asked_distance, of_cores, time_within
from exactpt.scene.scene import Scene, a_scene, scene_of

Near: TypeAlias = "tuple[AlgebraicNumber, Collection[tuple[int, int]]]"
"""The time of an approach, and the indices i < j of the bodies that are within the distance."""

BITS: Final = 64
"""Bits of an upper bound of a distance, at least."""


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


@overload
def first_within(
    scene: Scene,
    a: str,
    b: str,
    distance: Rational | None = None,
    *,
    norm: Norm | None = None,
    distance_squared: Rational | None = None,
) -> AlgebraicNumber | None: ...


@overload
def first_within(
    scene: Scene,
    *,
    distance: Rational | None = None,
    norm: Norm | None = None,
    distance_squared: Rational | None = None,
    between: Iterable[Sequence[str]] | None = None,
    ignoring: Iterable[Collection[str]] = (),
) -> Approach | None: ...


def first_within(
    scene: Scene,
    a: str | None = None,
    b: str | None = None,
    distance: Rational | None = None,
    *,
    norm: Norm | None = None,
    distance_squared: Rational | None = None,
    between: Iterable[Sequence[str]] | None = None,
    ignoring: Iterable[Collection[str]] = (),
) -> AlgebraicNumber | Approach | None:
    """Return the first time in the scene's span at which bodies are at most a distance apart.

    >>> from exactpt import Body, Scene, Translation
    >>> ball = Body("ball", [(0, 0), (1, 0), (0, 1)], Translation([0, 2]))
    >>> scene = Scene([ball, Body("wall", [(9, -5), (9, 5)])], time=(0, 10))
    >>> first_within(scene, "ball", "wall", 1, norm="euclidean")
    AlgebraicNumber('7/2')
    >>> first_within(scene, distance=1, norm="euclidean")
    Approach(time=AlgebraicNumber('7/2'), pairs=(('ball', 'wall'),))

    A `Spin` or a `PosePath` counts as its pieces: docs/howto/motions.md has the bounds for the
    true motion.

    Args:
        scene: the bodies and the time span.
        a: the name of a body.
        b: the name of another body; without names, any two bodies of the scene.
        distance: a number >= 0; 0 means the first contact.
        norm: "euclidean"; "max": the larger of the distances in x and in y; "x" or "y": the gap
            between the intervals that the bodies, with all their parts, span on that axis. To
            leave it out for two bodies means "max", and is deprecated.
        distance_squared: the square of the distance, instead of it, so that the square root of
            a rational number can be given; for the Euclidean norm. (Of rounded bodies it must
            be the square of a rational number.)
        between: pairs of names, for a question without names; other pairs do not count.
        ignoring: groups of body names, for a question without names; two bodies of one group
            do not count.

    Returns:
        The exact time, of any two bodies with the pairs; None if the bodies stay farther apart.

    Raises:
        InputError: if a body or the norm does not exist, the distance is negative, or a body is
            rounded and the norm is "max".
    """
    a_scene(scene)
    if (a is None) != (b is None):
        raise InputError(
            "two names of bodies are given, or none for all bodies; the distance by its name"
        )
    if a is not None and b is not None and norm is None:
        warnings.warn(
            'first_within without a norm means norm="max"; name the norm',
            DeprecationWarning,
            stacklevel=2,
        )
        norm = "max"
    norm, d = asked_distance(distance, distance_squared, norm)
    selection = Selection(scene, between, ignoring)
    if a is not None and b is not None:
        if not selection.is_all:
            raise InputError("between and ignoring are not supported for two named bodies")
        first, second = two_bodies(scene, a, b)
        return time_within_of_two(first, second, scene._start, scene._end, d, norm)
    found: Near | None = None
    of_cores(d, max((body._radius for body in scene.bodies), default=QQ(0)), norm)  # or refuses it
    if len(scene.bodies) > 1:
        found = _first(scene, d, norm) if selection.is_all else _selected(scene, selection, d, norm)
    if found is None:
        return None
    names = {(scene.bodies[i].name, scene.bodies[j].name) for i, j in found[1]}
    return Approach(found[0], tuple(sorted(names)))


def _first(scene: Scene, d: QQ, norm: Norm) -> Near | None:
    """Return the first approach of any two bodies, of which there are two."""
    if norm == "euclidean":
        return _euclidean(scene, d)
    if norm == "max":
        return _by_pairs(scene, candidate_pairs(scene, d), d, norm)
    return _on_axis(scene, d, norm)


def _selected(scene: Scene, selection: Selection, d: QQ, norm: Norm) -> Near | None:
    """Return the first approach of the pairs that count."""
    if norm in ("x", "y"):  # a gap on one axis bounds no box
        return _by_pairs(scene, selection.all_pairs(), d, norm)
    reach = root_above(d) if norm == "euclidean" else d
    return _by_pairs(scene, selection.of(candidate_pairs(scene, reach)), d, norm)


def _on_axis(scene: Scene, d: QQ, norm: Literal["x", "y"]) -> Near | None:
    """Return the first approach along an axis.

    If all gaps between projections are more than d at the start, the order of the projections
    stays the same until one is d: a first approach is one of neighbours. Another pair can be
    within d at that time only if d is 0 and points are between them.
    """
    axis = "xy".index(norm)
    spans: list[tuple[QQ, QQ, int]] = []
    for i, body in enumerate(scene.bodies):
        places = [point[axis] for point in body._at(scene._start)]
        spans.append((min(places) - body._radius, max(places) + body._radius, i))
    spans.sort()
    near: list[tuple[int, int]] = []
    for k, (_, high, i) in enumerate(spans):
        beside = takewhile(partial(_starts_by, high + d), islice(spans, k + 1, None))
        near += [(min(i, j), max(i, j)) for _, _, j in beside]
    if near:
        return AlgebraicNumber(scene._start), near
    order = [i for _, _, i in spans]
    found = _by_pairs(scene, pairwise(order), d, norm)
    if found is None or d:
        return found
    met = sorted({i for pair in found[1] for i in pair})
    return _by_pairs(scene, combinations(met, 2), d, norm)


def _starts_by(limit: QQ, span: tuple[QQ, QQ, int]) -> bool:
    return span[0] <= limit


def _by_pairs(
    scene: Scene, candidates: Iterable[tuple[int, int]], d: QQ, norm: Norm
) -> Near | None:
    """Return the first approach of some pairs: each is searched up to the best time so far."""
    best: Earliest[tuple[int, int]] = Earliest()
    for i, j in map(sorted, candidates):
        two, until = (scene.bodies[i], scene.bodies[j]), best.until(scene._end)
        time = time_within_of_two(*two, scene._start, until, d, norm)
        if time is not None:
            best.add(time, [(i, j)])
    return None if best.number is None else (best.number, best.found)


def time_within_of_two(
    a: Body, b: Body, start: QQ, end: QQ, d: QQ, norm: Norm
) -> AlgebraicNumber | None:
    """Return the first time in [start, end] at which two bodies are within d."""
    of_cores(d, a._radius + b._radius, norm)  # or refuses it
    if norm != "euclidean" or start == end:
        return time_within(a, b, start, end, d, norm)
    found = _euclidean(scene_of((a, b), start, end), d)  # filtered by doubles
    return None if found is None else found[0]


def _euclidean(scene: Scene, squared: QQ) -> Near | None:
    most = root_above(squared)
    radii = [body._radius for body in scene.bodies]

    def limit(i: int, j: int) -> QQ:
        return of_cores(squared, radii[i] + radii[j], "euclidean")

    def distance(a: MotionPiece, b: MotionPiece) -> ContactDistance | None:
        root = most + radii[a.body] + radii[b.body]
        return ContactDistance.of(limit(a.body, b.body), root) if root else None

    reach = [most / 2 + r for r in radii]
    pieces = scene_pieces_if_linear(scene, enclosing_floats(most / 2)[1])
    if pieces is None:
        near: Iterable[tuple[int, int]] = near_at_start(scene, reach, np.not_equal)
    else:
        near = pieces.near_at_start(distance)
    at_start = [ij for ij, _ in within_at_start(scene, limit, near)]
    if at_start:
        return AlgebraicNumber(scene._start), at_start
    if pieces is None:
        found = ApproachSearch(scene, limit, reach).run()
    else:
        found = first_among_pieces(pieces, distance)
    if found is None:
        return None
    return found.number, [(min(t.body, t.other), max(t.body, t.other)) for t in found.touches]


def root_above(squared: QQ) -> QQ:
    """Return a number a little above a square root; 0 for 0."""
    n, d = squared.numerator, squared.denominator
    shift = max(0, BITS - (n * d).bit_length() // 2)
    return QQ(isqrt(n * d << 2 * shift) + 1, d << shift) if n else QQ(0)
