"""Drawings of rings that cross, touch and overlap, and what fills them by the definition.

The reference shares no code with `exactpt.geometry.overlay`: it cuts the plane into slabs between
the abscissas of all vertices and crossings, in which edges do not cross, and counts upward.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from itertools import combinations, pairwise
from random import Random
from typing import Final, NamedTuple, TypeAlias

from exactpt.geometry.overlay import Part, evenodd, nonzero, union
from exactpt.geometry.polygon import first_self_touch, signed_area2
from exactpt.geometry.predicates import Point, between, orientation
from exactpt.kernel.numbers import QQ

__all__ = ["RULES", "Drawing", "Ring", "fault_of_drawing", "fault_of_parts", "random_drawing"]

Ring: TypeAlias = list[Point]
Rings: TypeAlias = Sequence[Sequence[Point]]
Edge: TypeAlias = tuple[Point, Point]
Heights: TypeAlias = list[tuple[QQ, QQ]]
"""Intervals of a vertical line, from below upward, that do not touch."""

RULES: Final[dict[str, tuple[Callable[[Rings], list[Part]], Callable[[int], bool]]]] = {
    "nonzero": (nonzero, lambda winding: winding != 0),
    "evenodd": (evenodd, lambda winding: winding % 2 == 1),
}
"""For each fill rule the function, and which winding numbers are filled."""

KINDS: Final = (
    "integers", "several", "framed", "degenerate", "fractions", "doubles", "far", "out of range",
)  # fmt: skip


class Drawing(NamedTuple):
    """Some closed rings of any kind."""

    kind: str
    rings: list[Ring]

    def to_json(self) -> object:
        """Return the rings as JSON data."""
        return [[[str(x), str(y)] for x, y in ring] for ring in self.rings]


def random_drawing(random: Random) -> Drawing:
    """Rings of small integers, of thirds and sevenths, of doubles, and with much degenerate."""
    kind = random.choice(KINDS)
    size = random.choice([2, 3, 5, 8])
    count = random.randint(1, 1 if kind == "integers" else 4)
    rings = [
        [(QQ(random.randint(0, size)), QQ(random.randint(0, size))) for _ in range(length)]
        for length in [random.randint(3, 10) for _ in range(count)]
    ]
    if kind == "framed":  # each ring in a frame: it is a hole there
        frames = [_square(-random.randint(0, 2), size + random.randint(0, 2)) for _ in rings]
        rings = [ring for pair in zip(frames, rings, strict=True) for ring in pair]
    if kind == "degenerate":
        rings = [_worse(random, ring) for ring in rings]
        rings += [random.choice(rings)[:: random.choice([1, -1])] for _ in range(2)]
    scale, shift = _placement(kind, random)
    return Drawing(kind, [[(x * scale + shift, y * scale - shift) for x, y in r] for r in rings])


def _square(low: int, high: int) -> Ring:
    corners = [(low, low), (high, low), (high, high), (low, high)]
    return [(QQ(x), QQ(y)) for x, y in corners]


def _placement(kind: str, random: Random) -> tuple[QQ, QQ]:
    """Return a factor and a shift of a drawing of some kind."""
    match kind:
        case "fractions":
            return QQ(1, random.choice([3, 7, 9, 13])), QQ(1, 21)
        case "doubles":
            return QQ(0.1), QQ(random.random())
        case "far":
            return QQ(1), QQ(10) ** random.choice([20, 60])
        case "out of range":
            return QQ(10) ** random.choice([400, -400]), QQ(0)
    return QQ(1), QQ(0)


def _worse(random: Random, ring: Ring) -> Ring:
    """Return a ring with repeated points, spikes, and points within edges."""
    found: Ring = []
    for p, q in zip(ring, ring[1:] + ring[:1], strict=True):
        found.append(p)
        match random.randrange(5):
            case 0:
                found.append(p)
            case 1:
                found += [q, p]
            case 2:
                found.append(((p[0] + q[0]) / 2, (p[1] + q[1]) / 2))
    return found


def fault_of_drawing(drawing: Drawing) -> str | None:
    """Return the difference of the filled parts of a drawing from the definition; None if none."""
    rings = drawing.rings
    for name, (fill, is_filled) in RULES.items():
        fault = fault_of_parts(fill(rings), rings, _of_sum(is_filled))
        if fault is not None:
            return f"{name}: {fault}"
    groups = [rings[k : k + 2] for k in range(0, len(rings), 2)]
    separate = [part for group in groups for part in evenodd(group)]
    fault = fault_of_parts(
        union(separate), [ring for part in separate for ring in part.rings], _is_in_any(separate)
    )
    return None if fault is None else f"union: {fault}"


def _of_sum(is_filled: Callable[[int], bool]) -> Callable[[Sequence[int]], bool]:
    return lambda numbers: is_filled(sum(numbers))


def _is_in_any(parts: Sequence[Part]) -> Callable[[Sequence[int]], bool]:
    """Return whether a point is in one of some parts, by its winding numbers around all rings."""

    def is_filled(numbers: Sequence[int]) -> bool:
        first = 0
        for part in parts:
            outline, *holes = numbers[first : first + len(part.rings)]
            if outline and not any(holes):
                return True
            first += len(part.rings)
        return False

    return is_filled


def fault_of_parts(
    parts: Sequence[Part], rings: Rings, is_filled: Callable[[Sequence[int]], bool]
) -> str | None:
    """Return the fault of parts that a rule makes of rings; None if they are right and valid.

    Args:
        parts: the result.
        rings: the rings given.
        is_filled: whether a point is filled, by its winding numbers with respect to each ring.
    """
    made = [ring for part in parts for ring in part.rings]
    abscissas = _abscissas(rings)
    area = QQ(0)
    for left, right in pairwise(abscissas):
        middle = (left + right) / 2
        expected = _filled(rings, middle, is_filled)
        found = _filled(made, middle, lambda numbers: sum(map(abs, numbers)) % 2 == 1)
        if found != expected:
            return f"at x = {middle} filled from {found}, not {expected}"
        area += (right - left) * sum((high - low for low, high in expected), QQ(0))
    if sum((signed_area2(ring) for ring in made), QQ(0)) != 2 * area:
        return "the area of the rings is another one"
    return _unknown_vertex(made, rings) or _invalid(parts)


def _edges(ring: Sequence[Point]) -> list[Edge]:
    return list(zip(ring, [*ring[1:], *ring[:1]], strict=True))


def _abscissas(rings: Rings) -> list[QQ]:
    edges = [edge for ring in rings for edge in _edges(ring)]
    found = {x for ring in rings for x, _ in ring}
    found |= {p[0] for e, f in combinations(edges, 2) if (p := _crossing(e, f)) is not None}
    return sorted(found)


def _crossing(e: Edge, f: Edge) -> Point | None:
    """Return the single common point of two edges that are not parallel, by Cramer's rule."""
    ((ax, ay), (bx, by)), ((cx, cy), (dx, dy)) = e, f
    a1, b1, c1 = by - ay, ax - bx, (by - ay) * ax + (ax - bx) * ay
    a2, b2, c2 = dy - cy, cx - dx, (dy - cy) * cx + (cx - dx) * cy
    determinant = a1 * b2 - a2 * b1
    if determinant == 0:
        return None
    p = ((c1 * b2 - c2 * b1) / determinant, (a1 * c2 - a2 * c1) / determinant)
    return p if between(*e, p) and between(*f, p) else None


def _filled(rings: Rings, x: QQ, is_filled: Callable[[Sequence[int]], bool]) -> Heights:
    """Return the filled intervals of the vertical line at x, on which there is no vertex."""
    crossed: list[tuple[QQ, int, int]] = []
    for number, ring in enumerate(rings):
        for (ax, ay), (bx, by) in _edges(ring):
            if (ax < x) != (bx < x):
                height = ay + (by - ay) * (x - ax) / (bx - ax)
                crossed.append((height, number, 1 if ax < bx else -1))
    crossed.sort()
    numbers = [0] * len(rings)
    found: Heights = []
    for k, (height, number, turn) in enumerate(crossed):
        numbers[number] += turn
        if k + 1 < len(crossed) and height < crossed[k + 1][0] and is_filled(numbers):
            if found and found[-1][1] == height:
                found[-1] = (found[-1][0], crossed[k + 1][0])
            else:
                found.append((height, crossed[k + 1][0]))
    return found


def _unknown_vertex(made: Rings, rings: Rings) -> str | None:
    """Return a vertex that should not be there, or one that is left out."""
    given = {p for ring in rings for p in ring}
    edges = [edge for ring in rings for edge in _edges(ring)]
    for ring in made:
        for p in set(ring) - given:
            on = [e for e in edges if orientation(*e, p) == 0 and between(*e, p)]
            if not any(_crossing(e, f) == p for e, f in combinations(on, 2)):
                return f"the vertex {p} is neither given nor a crossing"
        for a, b in _edges(ring):
            for p in given - {a, b}:
                if orientation(a, b, p) == 0 and between(a, b, p) and _bounds(p, a, b, edges):
                    return f"the vertex {p} is left out of the edge {a}, {b}"
        for (a, p), (_, b) in pairwise([*_edges(ring), _edges(ring)[0]]):
            if orientation(a, p, b) == 0 and not _bounds(p, a, b, edges):
                return f"the vertex {p} is within an edge from {a} to {b}"
    return None


def _bounds(p: Point, a: Point, b: Point, edges: Sequence[Edge]) -> bool:
    """Return True if one of the edges begins or ends at p and is along the line ab."""
    return any(
        p in e and e[0] != e[1] and not any(orientation(a, b, end) for end in e) for e in edges
    )


def _invalid(parts: Sequence[Part]) -> str | None:
    """Return what is not valid in the sense of OGC; None if nothing."""
    for part in parts:
        for ring in part.rings:
            if len(ring) < 3 or first_self_touch(ring, closed=True) is not None:
                return f"a ring is not simple: {ring}"
        if signed_area2(part.outline) <= 0 or any(signed_area2(hole) >= 0 for hole in part.holes):
            return "a ring turns the wrong way"
    rings = [ring for part in parts for ring in part.rings]
    for one, other in combinations(rings, 2):
        for e in _edges(one):
            for f in _edges(other):
                if _cross_or_overlap(e, f):
                    return f"edges of two rings have more than a point in common: {e}, {f}"
    for part in parts:
        if not _is_connected(part):
            return f"the inside of the part of {part.outline[0]} is not connected"
    return None


def _cross_or_overlap(e: Edge, f: Edge) -> bool:
    """Return True if two edges have more in common than an end of one of them."""
    (a, b), (c, d) = sorted(e), sorted(f)
    if b < c or d < a:  # in the order of x, then of y
        return False
    of_f = [orientation(*e, p) for p in f]
    of_e = [orientation(*f, p) for p in e]
    if of_f[0] * of_f[1] < 0 and of_e[0] * of_e[1] < 0:
        return True
    common = {p for p in f if orientation(*e, p) == 0 and between(*e, p)}
    common |= {p for p in e if orientation(*f, p) == 0 and between(*f, p)}
    return len(common) > 1


def _is_connected(part: Part) -> bool:
    """Return True if rings that meet in single points leave the inside connected.

    They do if and only if the graph of rings and of points in which they meet has no cycle.
    """
    leader: dict[object, object] = {}

    def root(node: object) -> object:
        while node in leader:
            node = leader[node]
        return node

    for number, ring in enumerate(part.rings):
        others = [other for k, other in enumerate(part.rings) if k != number]
        common = {
            p
            for other in others
            for e in _edges(ring)
            for f in _edges(other)
            for p in (*e, *f)
            if orientation(*e, p) == 0 == orientation(*f, p) and between(*e, p) and between(*f, p)
        }
        for p in common:
            a, b = root(number), root(p)
            if a == b:
                return False
            leader[a] = b
    return True
