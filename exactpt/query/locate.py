"""Point location and ray shooting, by walks from face to face."""

from __future__ import annotations

from fractions import Fraction

from exactpt.geometry.predicates import Point
from exactpt.indices import HalfEdge, VertexId
from exactpt.kernel.numbers import fraction
from exactpt.kernel.numbers import place as in_fractions
from exactpt.query.answers import PLACES, Hit, Place
from exactpt.query.ray import On, Ray, Spot
from exactpt.query.subdivision import OUTSIDE, Subdivision
from exactpt.query.walk import follow


def find(plane: Subdivision, p: Point) -> tuple[Spot, int]:
    """Point location by a straight walk from a node near the point (jump-and-walk).

    Returns:
        The face, edge or node that contains the point; number of edges and nodes passed.
    """
    if not plane.points:
        return Spot(On.FACE, OUTSIDE), 0
    node = plane.nodes.near(p)
    start = plane.points[node]
    if p == start:
        return Spot(On.NODE, node), 0
    if plane.out[node] < 0:  # the only one
        return Spot(On.FACE, OUTSIDE), 0
    ray = Ray.between(plane, start, p)
    step, passed = follow(plane, ray, Spot(On.NODE, node), through_bodies=True)
    if step.end is None or ray.beyond_goal(step.end) > 0:
        return step.through, passed
    return step.end, passed


def place_of(plane: Subdivision, spot: Spot, crossed: int = 0) -> Place:
    """Return the location of a spot in terms of the scene's bodies."""
    handle = spot.handle
    if spot.on is On.NODE:
        body, vertex = plane.node_name(handle)
        return Place("vertex", body, vertex, crossed=crossed)
    if spot.on is On.EDGE:
        ends = plane.map.origin[handle], plane.map.origin[handle ^ 1]
        if plane.boundary[handle >> 1]:
            name = plane.names[plane.body[ends[0]]]
            return Place("edge", name, edge=plane.edge_number(HalfEdge(handle)), crossed=crossed)
        names = plane.node_name(min(ends)), plane.node_name(max(ends))
        return Place("diagonal", diagonal=names, crossed=crossed)
    if handle == OUTSIDE:
        return Place("outside", crossed=crossed)
    if handle >= 0:
        return Place("tile", tile=handle, crossed=crossed)
    return Place("body", plane.names[-2 - handle], crossed=crossed)


def codes_of(plane: Subdivision, spot: Spot) -> tuple[int, int, int]:
    """Return the location of a spot as the numbers of a row of `Located`."""
    place = place_of(plane, spot)
    kind = PLACES.index(place.kind)
    if place.tile is not None:
        return kind, place.tile, -1
    if place.body is None:
        return kind, -1, -1
    node = plane.map.origin[spot.handle] if spot.on is On.EDGE else spot.handle
    body = -2 - spot.handle if spot.on is On.FACE else plane.body[node]
    feature = place.edge if place.vertex is None else place.vertex
    return kind, body, -1 if feature is None else feature


def cast(plane: Subdivision, ray: Ray) -> Hit | None:
    """Return the first point of a ray in a body; None if there is none, up to its goal.

    Every node belongs to a body, so a ray can only cross the interior of a diagonal without
    hitting a body.
    """
    spot = Spot(On.FACE, OUTSIDE)
    if not ray.begins_outside():
        spot, _ = find(plane, ray.origin)
        place = place_of(plane, spot)
        if place.body is not None:
            start = in_fractions(ray.origin)
            return Hit(place.body, place.vertex, place.edge, start, Fraction(0), 0)
    if not plane.points:
        return None
    if OUTSIDE not in plane.cycles:
        return _cast_at_point(plane, ray)
    step, crossed = follow(plane, ray, spot, through_bodies=False)
    if step.end is None or ray.beyond_goal(step.end) > 0:
        return None
    place = place_of(plane, step.end)
    if place.body is None:  # the goal is on a diagonal
        return None
    at = ray.parameter(step.end)
    return Hit(
        place.body, place.vertex, place.edge, in_fractions(ray.point(at)), fraction(at), crossed
    )


def _cast_at_point(plane: Subdivision, ray: Ray) -> Hit | None:
    """`cast` in a scene that consists of a single point."""
    node = VertexId(0)
    at = ray.reaches(node)
    if ray.side(node) != 0 or at < 0 or (ray.goal is not None and at > 1):
        return None
    return Hit(plane.names[0], 0, None, in_fractions(plane.points[0]), fraction(at), 0)
