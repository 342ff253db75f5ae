"""Whether a path can be deformed into another one without leaving the free space.

The order in which it passes a point of each body, above or below, tells.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from itertools import pairwise
from random import Random
from typing import Any

from exactpt.geometry.predicates import orient2d
from exactpt.kernel.numbers import QQ
from exactpt.testing.reference.shapes import is_on_segment
from exactpt.testing.reference.space import OpenChain, Places, Point, Rings, owner, rings_of

__all__ = ["anchors_beside", "crossing_word", "inner_point", "split_into_parts"]


def split_into_parts(scene: Places) -> dict[tuple[str, int], list[Point]]:
    """Return each part of each body as a body of its own, by its name and its number."""
    found = {}
    for name, points in scene.items():
        for i, part in enumerate(points.parts if isinstance(points, Rings) else [None]):
            if part is None:
                found[name, i] = points
            else:
                first = part[0].start
                own = points[first : part[-1].stop]
                shifted = [range(ring.start - first, ring.stop - first) for ring in part]
                found[name, i] = Rings(own, [shifted]) if len(part) > 1 else own
    return found


def inner_point(points: list[Point], rng: Random | None) -> Point:
    """Return a random point inside a polygon, the middle of the first edge of a chain, or a point.

    Args:
        points: the points of the body.
        rng: what chooses; None for a body that is no polygon.
    """
    n = len(points)
    if n < 3 or isinstance(points, OpenChain):
        ends = points[:2]
        return tuple(sum(c) * QQ(1, len(ends)) for c in zip(*ends, strict=True))
    assert rng is not None  # noqa: S101 - the caller's part
    while True:
        i = rng.randrange(n)
        ring = next(ring for ring, _ in rings_of(points) if i in ring)
        k = ring.index(i)
        a, b, c = (points[j] for j in (ring[k - 1], i, ring[(k + 1) % len(ring)]))
        u, v, w = (rng.randint(1, 997) for _ in range(3))
        s, far = u + v + w, rng.choice([1, 2, 4, 8, 64])
        m = tuple((a[k] * u + b[k] * v + c[k] * w) * QQ(1, s) for k in (0, 1))
        p = tuple(b[k] + (m[k] - b[k]) * QQ(1, far) for k in (0, 1))
        if owner(p, {"": points}) == ("", None, None):
            return p


def anchors_beside(
    path: Sequence[Point], scene: Mapping[Any, list[Point]], inner: Mapping[Any, Point]
) -> dict[Any, Point]:
    """Return a point of each body that a path does not pass, by name; some bodies have none.

    A taut path touches bodies, and where it runs along an open chain its points do not tell on
    which side of the chain it is: both classes have the same points there. Beside an anchor
    that is not on the path they do tell, since the path can be pushed off the bodies by less
    than its distance from the anchors. Leaving anchors out keeps equal words equal.

    Args:
        path: its vertices.
        scene: the points of each body.
        inner: of each body, the point to be preferred; else it is a vertex.
    """
    legs = list(pairwise(path))
    beside = {}
    for name, points in scene.items():
        for p in (inner[name], *points):
            if not any(is_on_segment(p, a, b) for a, b in legs):
                beside[name] = p
                break
    return beside


def crossing_word(path: Sequence[Point], anchors: Mapping[Any, Point]) -> list[tuple[Any, int]]:
    """Return how a path passes above each anchor, reduced.

    It is equal for two paths with the same ends if and only if one can be deformed into the other
    in the plane without the anchors.

    No anchor is on a path. Each is a little to the left of where it is given, of two in one
    column the one whose name is first the farther: so no two are passed at once, none is left or
    right of an end by chance, and a way back passes them in the opposite order.
    """
    columns = sorted(anchors.items(), key=lambda anchor: (anchor[1][0], anchor[0]))
    word: list[tuple[Any, int]] = []
    for p, q in pairwise(path):
        way = 1 if p[0] < q[0] else -1
        for name, (x, y) in columns[::way]:
            if (p[0] < x) != (q[0] < x) and way * orient2d(p, q, (x, y)) < 0:
                if word and word[-1] == (name, -way):
                    word.pop()
                else:
                    word.append((name, way))
    return word
