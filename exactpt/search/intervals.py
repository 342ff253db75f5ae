"""The maximal intervals of time in which two bodies intersect; they may pass through each other.

Whether two bodies have a common point changes only at a time at which their boundaries touch
without crossing: then a vertex of one lies on an edge of the other, or if one is rounded, is at
the sum of the radii from it. The times of all incidences, together with one rational time between
any two consecutive ones, decide.
"""

from __future__ import annotations

from bisect import bisect_right
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from functools import cmp_to_key
from typing import Final, final

import numpy as np

from exactpt.brief import record_in_brief
from exactpt.kernel.algebraic import AlgebraicNumber, rational_between
from exactpt.kernel.budget import check_budget
from exactpt.kernel.doubles import Indices
from exactpt.kernel.numbers import QQ
from exactpt.kernel.roots import roots_after
from exactpt.motion.body import Body
from exactpt.motion.outline import is_rigid
from exactpt.motion.track import Track
from exactpt.pair.features import feature_pairs
from exactpt.pair.near_features import NearFeatures
from exactpt.pair.overlap import bodies_meet
from exactpt.pair.pieces_of_two import PiecePair, piece_pairs, two_bodies
from exactpt.scene.scene import Scene, a_scene, scene_of
from exactpt.search.candidate_pairs import Spans, candidate_pairs
from exactpt.search.query import Selection

FEW: Final = 100
"""Maximum number of pairs of vertices of two bodies whose features are compared exactly at once."""
PARTS_OF_FEW: Final = 8
"""Number of parts of a time interval in which boxes of few features are compared."""


@final
@dataclass(frozen=True, slots=True)
class ContactInterval:
    """A maximal closed interval of time in which two bodies have a point in common.

    Attributes:
        a, b: the names of the bodies, in the order of the scene.
        start, end: the exact ends; equal if the bodies only touch.
    """

    a: str
    b: str
    start: AlgebraicNumber
    end: AlgebraicNumber

    def __repr__(self) -> str:
        return record_in_brief(self)

    def to_json(self) -> dict[str, object]:
        """Return the interval as a JSON object, see docs/format.md."""
        return {"a": self.a, "b": self.b, "from": self.start.to_json(), "to": self.end.to_json()}


def contact_intervals(scene: Scene, a: str, b: str) -> list[ContactInterval]:
    """Return all maximal closed intervals of the time span in which two bodies intersect.

    The result does not depend on the order in which the bodies are named.

    >>> from exactpt import Body, Scene, Translation
    >>> ball = Body("ball", [(0, 0), (1, 0), (0, 1)], Translation([0, 2]))
    >>> scene = Scene([ball, Body("wall", [(9, -5), (9, 5)])], time=(0, 10))
    >>> [(float(i.start), float(i.end)) for i in contact_intervals(scene, "ball", "wall")]
    [(4.0, 4.5)]

    Args:
        scene: the bodies and the time span; bodies other than a and b are irrelevant.
        a: the name of a body.
        b: the name of another body.

    Raises:
        InputError: if a body does not exist, both are the same, or they ignore each other.
    """
    two_bodies(scene, a, b)
    bodies = [body for body in scene.bodies if body.name in (a, b)]
    near = candidate_pairs(scene_of(bodies, scene.exact_start, scene.exact_end), QQ(0))
    return _of_two(scene, bodies[0], bodies[1], near.get((0, 1), []))


def _of_two(scene: Scene, a: Body, b: Body, near: Spans) -> list[ContactInterval]:
    """Return the intervals of two bodies, given in the order of the scene."""
    return [
        ContactInterval(a.name, b.name, start.simplified(), end.simplified())
        for start, end in intervals(a, b, scene.exact_start, scene.exact_end, near)
    ]


def contacts(
    scene: Scene,
    *,
    between: Iterable[Sequence[str]] | None = None,
    ignoring: Iterable[Iterable[str]] = (),
) -> list[ContactInterval]:
    """Return the intervals in which two bodies intersect, in the order of their starts, then names.

    Contacts of a deforming body with itself are not included. A `Spin` or a `PosePath` counts as
    its pieces: docs/howto/motions.md has the bounds for the true motion.

    Args:
        scene: the bodies and the time span.
        between: pairs of names; contacts of other pairs do not count. All if not given.
        ignoring: groups of names and patterns as of a `Scene`, beside those of the scene;
            contacts of two bodies of one group do not count.

    Raises:
        InputError: if the scene is not a `Scene`, a name is unknown, a group is wrong, or a named
            pair is ignored.
    """
    a_scene(scene)
    selection = Selection(scene, between, ignoring)
    near = candidate_pairs(scene, QQ(0))
    found = [
        interval
        for i, j in selection.of(near)
        for interval in _of_two(scene, scene.bodies[i], scene.bodies[j], near[i, j])
    ]
    found.sort(key=lambda interval: (interval.a, interval.b))
    found.sort(key=lambda interval: _in_order(interval.start))
    return found


_in_order = cmp_to_key(AlgebraicNumber.compare)


def intervals(
    a: Body, b: Body, start: QQ, end: QQ, near: Spans | None = None
) -> Iterator[tuple[AlgebraicNumber, AlgebraicNumber]]:
    """Yield the maximal closed intervals in [start, end] in which two bodies intersect.

    Outside of the spans ``near``, if they are given, they do not.
    """
    times = incidence_times(a, b, start, end, near)
    begin = AlgebraicNumber(start) if bodies_meet(a, b, start) else None
    last = AlgebraicNumber(start)
    for time in times:
        if not bodies_meet(a, b, rational_between(last, time)):
            if begin is not None:
                yield begin, last
            begin = time
        last = time
    if last.compare_rational(end) < 0:
        stop = AlgebraicNumber(end)
        if begin is not None and not bodies_meet(a, b, rational_between(last, stop)):
            yield begin, last
            begin = None
        last = stop
    if begin is not None:
        yield begin, last


def incidence_times(
    a: Body, b: Body, start: QQ, end: QQ, near: Spans | None = None
) -> list[AlgebraicNumber]:
    """Return the times in (start, end] of incidences of a vertex and an edge of two bodies.

    In increasing order, each once. Where a vertex stays on the line of an edge, the times at
    which it passes an end of the edge, and that at which the motion ends, if it is on the edge.
    Of rounded bodies, likewise the times at which features come to the sum of the radii.
    """
    # Two vertices also lie on edges, unless there are none, or one has no length for a moment; they
    # have times of their own where a vertex moves along an edge.
    corners = not (a.edges or b.edges) or not (is_rigid(a) and is_rigid(b))
    begins = [start] if near is None else [begin for begin, _ in near]
    ends = [end] if near is None else [stop for _, stop in near]
    found: list[AlgebraicNumber] = []
    for piece_pair in piece_pairs(a, b, start, end):
        before = bisect_right(begins, piece_pair.end)
        if before and ends[before - 1] > piece_pair.begin:
            found += _times(a, b, piece_pair, corners=corners)
    return _distinct(found)


def _distinct(times: Iterable[AlgebraicNumber]) -> list[AlgebraicNumber]:
    distinct: list[AlgebraicNumber] = []
    for time in sorted(times, key=_in_order):
        if not distinct or distinct[-1].compare(time) < 0:
            distinct.append(time)
    return distinct


def _times(a: Body, b: Body, piece_pair: PiecePair, *, corners: bool) -> Iterator[AlgebraicNumber]:
    """Yield the times at which features of two bodies are at the sum of the radii.

    Where they stay at it, that at which the motion ends. (A foot that leaves its edge does so at
    a vertex, which is then at that distance.) If the sum is 0 and ``corners`` is false, those of
    two vertices where vertices move along edges alone.
    """
    squared = (a.exact_radius + b.exact_radius) ** 2
    begin, end = AlgebraicNumber(piece_pair.begin), AlgebraicNumber(piece_pair.end)
    for pair in feature_pairs(
        a, b, piece_pair.first, piece_pair.second, _near_pairs(a, b, piece_pair).tolist()
    ):
        check_budget()
        if not (squared or corners or pair.is_of_edge):
            return
        f = pair.at_distance(squared)
        corners |= not f
        times = (root.time for root in roots_after(f, begin, piece_pair.end)) if f else (end,)
        yield from (time for time in times if pair.holds(time))


def _near_pairs(a: Body, b: Body, piece_pair: PiecePair) -> Indices:
    """Return the numbers of the pairs of features that may come to the sum of the radii.

    All if they are few and no body turns: the roots of short polynomials take less time than
    boxes. Where a body turns, the times of a pair are roots of long polynomials. For each vertex
    its edges, if the sum is 0: equal times take the first one's form.
    """
    n, m, of_a, of_b = a.size, b.size, len(a.edges), len(b.edges)
    reach = a.exact_radius + b.exact_radius
    if n * m > FEW:
        order = NearFeatures(a, b, piece_pair).within(reach)
    elif _turns(piece_pair.first) or _turns(piece_pair.second):
        order = NearFeatures(a, b, piece_pair).within(reach, PARTS_OF_FEW)
    else:
        order = np.arange(n * m + of_a * m + n * of_b)
    if reach:
        return order
    corners, of_second = order < n * m, order >= (n + of_a) * m
    edges = order[~corners & ~of_second]
    edges = edges[np.lexsort((edges // m, edges % m))]
    return np.concatenate([order[of_second], edges, order[corners]])


def _turns(tracks: tuple[Track, ...]) -> bool:
    """Return True if the coordinates of vertices are rational functions, not polynomials."""
    return any(len(track.w) > 1 for track in tracks)
