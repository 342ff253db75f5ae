"""A ray through a subdivision, from face to face.

A point of the ray is in a face, on an edge or at a node, and each of the three cases determines
how the ray continues. Rays through vertices, along edges and along straight chains are thus no
exceptions; every decision is the sign of a rational, which doubles decide within a bound. A face
of which they leave one node or one order open is decided by exact arithmetic.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from typing import NamedTuple

from exactpt.indices import NO_HALF_EDGE, HalfEdge, VertexId
from exactpt.planar.halfedge import twin
from exactpt.query.ray import Ray
from exactpt.query.subdivision import BEYOND, OUTSIDE, On, Spot, Subdivision, cross


class RayStep(NamedTuple):
    """A maximal part of a ray within one face or along one edge.

    Attributes:
        through: the face, or the half-edge in the direction of the ray, that contains the
            interior of the step.
        end: the edge or the node that contains its end; None if the step is unbounded. Of an
            edge, the half-edge with the face on its left.
    """

    through: Spot
    end: Spot | None


def steps_of(plane: Subdivision, ray: Ray, spot: Spot) -> Iterator[RayStep]:
    """Yield the steps of a ray from a spot of it on; in a face, from its origin on."""
    step = _step_from(plane, ray, spot)
    while True:
        yield step
        end = step.end
        if end is None:
            return
        if end.on is On.EDGE:
            h = twin(HalfEdge(end.handle))
            step = _through_face(plane, ray, plane.face[h], end, h)
        else:
            step = _step_from(plane, ray, end)


def follow(
    plane: Subdivision, ray: Ray, spot: Spot, *, through_bodies: bool
) -> tuple[RayStep, int]:
    """Return the last step of a ray, and the number of edges and nodes passed before.

    Its end is at or beyond the goal of the ray, or in a body, unless the ray goes through bodies;
    or it has none.
    """
    step, passed = _step_from(plane, ray, spot), 0
    while (end := step.end) is not None and ray.beyond_goal(end) < 0:
        if end.on is On.NODE:
            if not through_bodies:
                break
            step = _step_from(plane, ray, end)
        elif plane.boundary[end.handle >> 1] and not through_bodies:
            break
        else:
            h = twin(HalfEdge(end.handle))
            step, more = _across_faces(plane, ray, h, through_bodies=through_bodies)
            passed += more
            if step.end is not None and step.end.on is On.EDGE:
                return step, passed + 1
        passed += 1
    return step, passed


def _across_faces(
    plane: Subdivision, ray: Ray, entry: HalfEdge, *, through_bodies: bool
) -> tuple[RayStep, int]:
    """Follow a ray from edge to edge, up to a node or to an edge at which `follow` ends.

    Around a face from its entry edge on, which the ray crosses from left to right, corners are to
    the right of it up to the end, and then to the left, the last one certainly: most often. Without
    the difference, v is off by 8 U M S, and c + off or c - off by less than 2 U M S more (`Ray`).

    Returns:
        The last step; the number of edges crossed after the entry edge.
    """
    (dx, dy, c), crossed = ray.line, 0
    right, left = c - ray.off, c + ray.off
    has_goal, faces, boundary, ahead = ray.goal is not None, plane.face, plane.boundary, plane.ahead
    while True:
        corners, beyond = ahead[entry] or plane.look_ahead(entry)
        others = iter(corners)
        for x, y, h in others:
            value = dx * y - dy * x
            if not value < right:
                beyond = h if value > left else NO_HALF_EDGE
                for u, v, _ in others:
                    if not dx * v - dy * u > left:
                        beyond = NO_HALF_EDGE
                        break
                break
        if beyond == NO_HALF_EDGE:
            step = _through_face(plane, ray, faces[entry], Spot(On.EDGE, entry), entry)
            if step.end is None or step.end.on is On.NODE:
                return step, crossed
            beyond = twin(HalfEdge(step.end.handle))
        is_wall = boundary[beyond >> 1] and not through_bodies
        if is_wall or (has_goal and ray.beyond_at_edge(twin(beyond)) >= 0):
            return RayStep(Spot(On.FACE, faces[entry]), Spot(On.EDGE, twin(beyond))), crossed
        entry, crossed = beyond, crossed + 1


def _step_from(plane: Subdivision, ray: Ray, spot: Spot) -> RayStep:
    """Return the step that starts at a spot."""
    if spot.on is On.FACE:
        step = _into_hull(plane, ray) if spot.handle == OUTSIDE else None
        return step or _through_face(plane, ray, spot.handle, spot)
    if spot.on is On.EDGE:
        h = HalfEdge(spot.handle)
        # The ray has a point of the edge, whose target is on the side `side` of it.
        turn = -ray.side(plane.map.target(h))
        if turn == 0:
            return _along(plane, h if _ahead(plane, ray, h) else twin(h))
        h = h if turn > 0 else twin(h)
        return _through_face(plane, ray, plane.face[h], spot, h)
    h, along = _sector(plane, ray, VertexId(spot.handle))
    if along:
        return _along(plane, h)
    return _through_face(plane, ray, plane.face[h], spot)


def _into_hull(plane: Subdivision, ray: Ray) -> RayStep | None:
    """Return the step outside of the hull from an origin there on; None if doubles do not decide.

    The line enters the hull ahead of the origin if this is on the outer side of the edge.
    """
    edge = None if plane.hull is None else plane.hull.entered(ray.line, ray.off)
    if edge is None:
        return None
    is_ahead = edge != NO_HALF_EDGE and ray.begins_before(edge)
    return RayStep(BEYOND, Spot(On.EDGE, edge) if is_ahead else None)


def _ahead(plane: Subdivision, ray: Ray, h: HalfEdge) -> bool:
    """Return True if a half-edge on the line of the ray has the direction of the ray."""
    (x, y), (dx, dy) = plane.direction(h), ray.direction
    return x * dx + y * dy > 0


def _along(plane: Subdivision, h: HalfEdge) -> RayStep:
    return RayStep(Spot(On.EDGE, h), Spot(On.NODE, plane.map.target(h)))


def _sector(plane: Subdivision, ray: Ray, node: VertexId) -> tuple[HalfEdge, bool]:
    """Return the half-edge whose sector contains the direction, and if it is parallel.

    The sector of h lies between h and the next half-edge counter-clockwise: the corner of the
    face on the left of h.
    """
    star = plane.map.star(plane.out[node])
    turns = [-ray.side(plane.map.target(h)) for h in star]  # the ray contains the node
    for h, turn in zip(star, turns, strict=True):
        if turn == 0 and _ahead(plane, ray, h):
            return h, True
    for i, turn in enumerate(turns):
        # The direction is left of one half-edge and right of the next one.
        if turn < 0 and turns[i - 1] > 0:
            return star[i - 1], False
    for i, h in enumerate(star):
        # Or it is so of one of them, in a sector wider than pi.
        g, after = star[(i + 1) % len(star)], turns[(i + 1) % len(star)]
        if (turns[i] > 0 or after < 0) and cross(plane.direction(h), plane.direction(g)) <= 0:
            return h, False
    return star[0], False


def _through_face(
    plane: Subdivision, ray: Ray, face: int, since: Spot, entry: HalfEdge = NO_HALF_EDGE
) -> RayStep:
    """Return the step through a face from a spot on, perhaps from its entry edge.

    The line of the ray leaves the face across edges whose origin is on its right. If there is one,
    and the face is bounded, it is the end; otherwise places along the ray are compared. From a node
    or an edge of the hull to the outside a ray is without end, since the hull is convex.
    """
    if face == OUTSIDE and since.on is not On.FACE:
        return RayStep(BEYOND, None)
    (dx, dy, c), off = ray.line, ray.off
    starts_here = since.on is On.NODE and ray.origin == plane.points[since.handle]
    ends: list[HalfEdge] = []
    for corners in plane.outline(face):
        side = 0
        for x, y, h in corners:
            value = dx * y - dy * x - c
            if value > off:
                if side < 0:
                    ends.append(h)
                side = 1
            elif value < -off:
                side = -1
            elif starts_here and plane.map.origin[h ^ 1] == since.handle:
                side = 0
            else:
                return _exactly_through_face(plane, ray, face, since, entry)
    if len(ends) > 1 or (ends and face == OUTSIDE):
        first = _first_ahead(ray, ends, entry)
        if first is None:
            return _exactly_through_face(plane, ray, face, since, entry)
        ends = first
    return RayStep(Spot(On.FACE, face), Spot(On.EDGE, ends[0]) if ends else None)


def _first_ahead(ray: Ray, ends: Sequence[HalfEdge], entry: HalfEdge) -> list[HalfEdge] | None:
    """Return the first of some edges that the ray crosses, or none; None if that is not certain.

    It starts at the entry edge, or at its origin if there is none.
    """
    low, high = (0.0, 0.0) if entry == NO_HALF_EDGE else ray.place_of(entry)
    best: list[HalfEdge] = []
    start = stop = math.inf
    for h in ends:
        first, last = ray.place_of(h)
        if last < low or stop < first:
            continue
        if not high < first or not last < start:
            return None
        best, start, stop = [h], first, last
    return best


def _exactly_through_face(
    plane: Subdivision, ray: Ray, face: int, since: Spot, entry: HalfEdge
) -> RayStep:
    """Return the same as `_through_face`, by exact parameters of the nodes and edges of a face."""
    origin = plane.map.origin
    ends: list[Spot] = []
    for corners in plane.outline(face):
        for _, _, h in corners[1:]:
            s, t = ray.side(origin[h]), ray.side(origin[h ^ 1])
            if s == 0:
                ends.append(Spot(On.NODE, origin[h]))
            elif s < 0 < t:  # not an edge on whose left the ray comes into the face
                ends.append(Spot(On.EDGE, h))
    through = Spot(On.FACE, face)
    if len(ends) == 1 and entry != NO_HALF_EDGE and face != OUTSIDE:
        return RayStep(through, ends[0])
    at = ray.parameter(since)
    later = [(when, k) for k, end in enumerate(ends) if (when := ray.parameter(end)) > at]
    return RayStep(through, ends[min(later)[1]] if later else None)
