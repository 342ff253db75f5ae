"""The exact check that a body is valid at the start of a scene.

A body is *simple* if its rings, or its chain, are simple and disjoint. It is *valid* if its rings
are simple, two rings have at most single points in common and do not cross there, the parts have no
inner point in common, and the inside of each part is connected: so a polygon or a multipolygon is
defined by the Open Geospatial Consortium (OGC). A valid body that is not simple must keep its
shape, so that its rings touch in the same points at all times.
"""

from __future__ import annotations

from collections.abc import Sequence

from exactpt.errors import InputError
from exactpt.geometry.polygon import contains, near_groups, signed_area2
from exactpt.geometry.predicates import Point
from exactpt.geometry.touching_rings import (
    EdgeFault,
    FaultKind,
    Passage,
    RingTouch,
    dividing_loop,
    ring_meetings,
)
from exactpt.kernel.numbers import QQ, shorten, show, show_points
from exactpt.motion.body import Body
from exactpt.motion.kept_shape import loss_of_shape
from exactpt.motion.motions import is_affine
from exactpt.motion.shape import are_constant
from exactpt.motion.spin import Spin


def check_exactly(body: Body, start: QQ, end: QQ) -> None:
    """Check that a body is valid at the start of a scene.

    Args:
        body: the body.
        start: the start of the scene.
        end: its end: until then a body whose rings touch keeps its shape.

    Raises:
        InputError: if it is not, with the vertices, edges and points at the start.
    """
    if isinstance(body.motion, Spin) and body.vertices and are_constant(body.vertices):
        at_rest = [(x.exact_at(QQ(0)), y.exact_at(QQ(0))) for x, y in body.vertices]
        try:
            _check(body, at_rest, start, end)  # a rigid motion changes nothing of it
        except InputError:
            pass  # it is found again, for a message with the places at the start
        else:
            return
    _check(body, body.exact_at(start), start, end)


def _check(body: Body, points: Sequence[Point], start: QQ, end: QQ) -> None:
    """Check that a body is valid with its vertices at these points."""
    meetings = ring_meetings(points, body.edges, body.rings)
    prefix = ""
    try:
        if meetings.fault is not None:
            if meetings.fault.kind is FaultKind.SAME_RING:
                prefix = f"not a simple {'polygon' if body.closed else 'chain'} and so "
            raise InputError(_fault_shown(body, points, meetings.fault))
        if body.has_interior:
            _check_areas(body, points)
        if body.has_rings:
            _check_nesting(body, points, meetings.touches)
        if meetings.touches:
            _check_connected(body, meetings.touches)
            _check_kept_shape(body, meetings.touches, start, end)
        elif is_affine(body.motion):  # a bijection, as rings have an area: disjoint at rest, too
            body._known_touches = ()  # noqa: SLF001 - so that nobody looks for them again
    except InputError as error:
        raise InputError(
            f"body {shorten(body.name)}: {prefix}not valid at the start, t = {show(start)}: {error}"
        ) from None


def _fault_shown(body: Body, points: Sequence[Point], fault: EdgeFault) -> str:
    """Return the words about two edges that cannot be edges of one body."""
    i, j, kind = fault
    if kind is FaultKind.NO_LENGTH:
        return f"vertex {i} and the next one are both at {show(*points[i])}"
    meet = f"edge {i} from {show(*points[i])} meets edge {j} from {show(*points[j])}"
    if kind is FaultKind.SAME_RING:
        return meet
    of_parts = {k for k, rings in enumerate(body.parts) for ring in rings if {i, j} & {*ring}}
    are_two_parts = len(of_parts) > 1
    joins = "; exactpt.union joins such parts" if are_two_parts else ""
    if kind is FaultKind.CROSSING:
        return f"two rings cross: {meet}{joins}"
    return f"two rings have a common piece: {meet}{joins or '; make one ring of the two'}"


def _check_areas(body: Body, points: Sequence[Point]) -> None:
    for ring in body.rings:
        if signed_area2(points[ring.start : ring.stop]) == 0:
            what = f"the ring of vertex {ring.start}" if body.has_rings else "the polygon"
            raise InputError(f"{what} has no area")


def _check_nesting(body: Body, points: Sequence[Point], touches: Sequence[RingTouch]) -> None:
    """Check that rings that do not cross are outlines and holes of parts without common inside.

    Such rings are inside or outside of each other as a whole, so a point of each that is on no
    other ring decides.
    """
    rings = [ring for rings in body.parts for ring in rings]
    parts = [k for k, rings in enumerate(body.parts) for _ in rings]
    outlines = [k for k, part in enumerate(parts) if k == 0 or parts[k - 1] != part]
    # A ring is inside another ring only if their boxes, rounded outward, intersect.
    near: list[list[int]] = [[] for _ in rings]
    for i, j in near_groups([points[ring.start : ring.stop] for ring in rings]):
        near[i].append(j)
        near[j].append(i)
    ways: list[list[tuple[Point, Passage]]] = [[] for _ in rings]
    for touch in touches:
        for number, way in touch.passages.items():
            ways[number].append((touch.point, way))
    own_point = [_point_on_no_other(*one, points) for one in zip(rings, ways, strict=True)]

    def around(i: int) -> set[int]:
        """Return the rings in which a ring is."""
        p = own_point[i]
        return {j for j in near[i] if contains(points[rings[j].start : rings[j].stop], p)}

    def fault(ring: range, what: str, remedy: str = "") -> InputError:
        return InputError(f"{what}: vertex {ring.start} at {show(*points[ring.start])}{remedy}")

    for outline in outlines:
        k = parts[outline]
        for i in range(outline + 1, outline + len(body.parts[k])):
            outer = around(i)
            if outline not in outer:
                raise fault(rings[i], "a hole is outside of its outline")
            if any(parts[j] == k and j != outline for j in outer):
                raise fault(rings[i], "a hole is inside another hole")
        outer = around(outline)
        for other in sorted(outer.intersection(outlines)):
            if not any(parts[j] == parts[other] and j != other for j in outer):
                raise fault(
                    rings[outline],
                    "a part is inside another part",
                    remedy="; exactpt.union joins such parts",
                )


def _point_on_no_other(
    ring: range, ways: Sequence[tuple[Point, Passage]], points: Sequence[Point]
) -> Point:
    """Return a point of a ring that is on no other ring.

    It is a vertex in which no other ring touches this one; without such a vertex, it is half way
    from the first vertex to the next point of a touch on the edge that begins there.

    Args:
        ring: the vertices of the ring.
        ways: the points in which other rings touch it, and how it passes through them.
        points: the positions of all vertices.
    """
    touched = {way.vertex for _, way in ways}
    for vertex in ring:
        if vertex not in touched:
            return points[vertex]
    first, end = points[ring.start], points[ring.start + 1]
    on_edge = [p for p, way in ways if way.vertex is None and way.before == ring.start]
    after = min([*on_edge, end], key=lambda p: abs(p[0] - first[0]) + abs(p[1] - first[1]))
    return (first[0] + after[0]) / 2, (first[1] + after[1]) / 2


def _check_connected(body: Body, touches: Sequence[RingTouch]) -> None:
    """Check that the inside of each part is connected."""
    part_of = [k for k, rings in enumerate(body.parts) for _ in rings]
    of_part: list[list[RingTouch]] = [[] for _ in body.parts]
    for touch in touches:
        for k in {part_of[ring] for ring in touch.passages}:
            of_part[k].append(touch)
    first = 0
    for k, rings in enumerate(body.parts):
        loop = dividing_loop(of_part[k], range(first, first + len(rings)))
        first += len(rings)
        if loop:
            which = f"the inside of part {k}" if len(body.parts) > 1 else "the inside"
            raise InputError(
                f"{which} is not connected: its rings touch at {show_points(loop)}; make each "
                "piece of it a part of its own"
            )


def _check_kept_shape(body: Body, touches: Sequence[RingTouch], start: QQ, end: QQ) -> None:
    loss = loss_of_shape(body, start, end)
    if loss is not None:
        raise InputError(
            f"its rings touch at {show_points([touch.point for touch in touches])}, and {loss}: "
            "rings may touch only of a body that keeps its shape"
        )
