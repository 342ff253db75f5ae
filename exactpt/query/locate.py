"""Point location and ray shooting, by walks from face to face."""

from __future__ import annotations

from collections.abc import Sequence
from functools import partial

from mypy_extensions import i64

from exactpt.geometry.predicates import Point
from exactpt.indices import VertexId
from exactpt.query.answers import PLACES, Hit, Place, hit_later
from exactpt.query.nodes import Given
from exactpt.query.ray import Ray, reach
from exactpt.query.subdivision import BEYOND, OUTSIDE, On, Spot, Subdivision
from exactpt.query.walk import follow

_TILE, _DIAGONAL, _OUTSIDE, _BODY, _EDGE, _VERTEX = range(len(PLACES))


def find(plane: Subdivision, p: Given) -> tuple[Spot, int]:
    """Point location by a straight walk from a place near the point (jump-and-walk).

    Returns:
        The face, edge or node that contains the point; number of edges and nodes passed.
    """
    if not plane.face:  # at most one point
        is_node = plane.points == [p]
        return Spot(On.NODE, 0) if is_node else BEYOND, 0
    cell = plane.nodes.cell(*plane.nodes.of(p))
    start = plane.starts.get(cell)
    if start is None:
        start = plane.starts[cell] = _start(plane, plane.nodes.middle(cell))
    return _walk(plane, *start, p)


def _start(plane: Subdivision, middle: tuple[float, float]) -> tuple[Given, Spot]:
    """Return the middle of a cell with its face; a node near it if it has none in the hull."""
    node = plane.nodes.near(middle)
    at_node = plane.points[node], Spot(On.NODE, node)
    spot, _ = _walk(plane, *at_node, middle)
    return (middle, spot) if spot.on is On.FACE and spot.handle != OUTSIDE else at_node


def _walk(plane: Subdivision, start: Given, spot: Spot, p: Given) -> tuple[Spot, int]:
    """Return the result of `find` by a walk from a point, whose spot is given."""
    if p == start:
        return spot, 0
    ray = Ray(plane, start, goal=p)
    step, passed = follow(plane, ray, spot, through_bodies=True)
    if step.end is None or ray.beyond_goal(step.end) > 0:
        return step.through, passed
    return step.end, passed


def place_of(plane: Subdivision, spot: Spot, crossed: int = 0) -> Place:
    """Return the location of a spot in terms of the scene's bodies."""
    kind, owner, feature = codes_of(plane, spot)
    ends = None
    if kind == _DIAGONAL:
        h, origin = spot.handle, plane.map.origin
        u, v = plane.node_name(origin[h]), plane.node_name(origin[h ^ 1])
        ends = (u, v) if origin[h] < origin[h ^ 1] else (v, u)
    return Place(
        PLACES[kind],
        plane.names[owner] if kind >= _BODY else None,
        feature if kind == _VERTEX else None,
        feature if kind == _EDGE else None,
        owner if kind == _TILE else None,
        ends,
        crossed,
    )


def codes_of(plane: Subdivision, spot: Spot) -> tuple[int, i64, i64]:
    """Return the location of a spot as the numbers of a row of `Located`."""
    on, h = spot
    if on is On.EDGE:
        if not plane.boundary[h >> 1]:
            return _DIAGONAL, -1, -1
        u, v = plane.map.origin[h], plane.map.origin[h ^ 1]
        body = plane.body[u]
        # From a vertex to the next one, or from the last one of a ring to its first.
        return _EDGE, body, (min(u, v) if u - v in {1, -1} else max(u, v)) - plane.first[body]
    if on is On.NODE:
        return _VERTEX, plane.body[h], h - plane.first[plane.body[h]]
    if h >= 0:
        return _TILE, h, -1
    return (_OUTSIDE, -1, -1) if h == OUTSIDE else (_BODY, -2 - h, -1)


def cast(plane: Subdivision, ray: Ray) -> Hit | None:
    """Return the first point of a ray in a body; None if there is none, up to its goal.

    Every node belongs to a body, so a ray can only cross the interior of a diagonal without
    hitting a body.
    """
    spot = BEYOND
    if not ray.begins_outside():
        spot, _ = find(plane, ray.given)
        hit = _hit(plane, ray, spot, (), 0)
        if hit is not None:
            return hit
    if not plane.points:
        return None
    if OUTSIDE not in plane.cycles:
        return _cast_at_point(plane, ray)
    step, crossed = follow(plane, ray, spot, through_bodies=False)
    if step.end is None or ray.beyond_goal(step.end) > 0:
        return None
    return _hit(plane, ray, step.end, ray.ends(step.end), crossed)


def _hit(
    plane: Subdivision, ray: Ray, spot: Spot, ends: Sequence[Point], crossed: int
) -> Hit | None:
    """Return the hit of a ray at a spot and its ends; None in free space, where a goal may be."""
    kind, body, feature = codes_of(plane, spot)
    if kind < _BODY:
        return None
    vertex, edge = feature if kind == _VERTEX else None, feature if kind == _EDGE else None
    return hit_later(
        plane.names[body],
        vertex,
        edge,
        crossed,
        partial(reach, ray.given, ray.along or ray.direction, ends),
    )


def _cast_at_point(plane: Subdivision, ray: Ray) -> Hit | None:
    """`cast` in a scene that consists of a single point."""
    node = VertexId(0)
    spot = Spot(On.NODE, node)
    at = ray.parameter(spot)
    if ray.side(node) != 0 or at < 0 or (ray.goal is not None and at > 1):
        return None
    return _hit(plane, ray, spot, ray.ends(spot), 0)
