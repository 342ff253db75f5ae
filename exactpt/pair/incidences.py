"""Incidences as users see them: which vertex is on what, the point and the normal."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import final

from exactpt.brief import record_in_brief
from exactpt.kernel.algebraic import AlgebraicNumber
from exactpt.kernel.approximation import exponent, nearest_quotient
from exactpt.kernel.integer_polynomial import multiply, scale
from exactpt.kernel.numbers import QQ, ZZ, finite
from exactpt.motion.body import Body
from exactpt.motion.course import Piece
from exactpt.motion.outline import is_rigid
from exactpt.motion.track import Incidence, Track, orientation_polynomial, vector
from exactpt.scene.scene import Scene


@final
@dataclass(frozen=True, slots=True)
class ContactPoint:
    """An incidence: a vertex that lies on, or as a rounded one touches, an edge or a vertex.

    Attributes:
        kind: "vertex-edge" or "vertex-vertex".
        body, vertex: name of the body and number of its vertex, as in the scene.
        other: name of the body that is touched (``body`` itself in a self-contact).
        edge: the edge of ``other``, from vertex ``edge`` to the next; None for vertex-vertex.
        other_vertex: the vertex of ``other``; None for vertex-edge.
        point: the common point, each coordinate the nearest finite double.
        normal: the unit normal of the edge that points out of ``other``, by the even-odd rule
            just after the point on the edge (as it was just before, if ``other`` is ``body``,
            which touches itself); where both sides are outside or both inside (of a
            body without interior, or one that has crossed itself), to the side from which the
            vertex came, or to the right of the edge if it came along the line of that; None for
            vertex-vertex.

    Where a body is rounded, vertices and edges are those of the cores. Then the point is on both
    boundaries, and the normal, from the edge or the vertex of ``other`` to the vertex, is always
    given, each coordinate the nearest double.
    """

    kind: str
    body: str
    vertex: int
    other: str
    edge: int | None
    other_vertex: int | None
    point: tuple[float, float]
    normal: tuple[float, float] | None

    def __repr__(self) -> str:
        return record_in_brief(self)

    def to_json(self) -> dict[str, object]:
        """Return the pair as a JSON object, see docs/format.md."""
        if self.edge is None:
            b: dict[str, object] = {"body": self.other, "vertex": self.other_vertex}
        else:
            b = {"body": self.other, "edge": self.edge}
        return {
            "kind": self.kind,
            "a": {"body": self.body, "vertex": self.vertex},
            "b": b,
            "point": list(self.point),
            "normal": None if self.normal is None else list(self.normal),
        }


def tracks_just_before(body: Body, time: AlgebraicNumber, start: QQ) -> tuple[Track, ...]:
    """Return the trajectories of a body just before a time; just after it if it begins there."""
    return _piece_before(body, time, start).tracks


def _piece_before(body: Body, time: AlgebraicNumber, start: QQ) -> Piece:
    """Return the motion of a body just before a time; just after it if the body begins there."""
    return body.exact_piece_after(body.exact_last_breakpoint(time, start, before=True))


def details(
    scene: Scene, time: AlgebraicNumber, touches: Sequence[Incidence]
) -> tuple[AlgebraicNumber, tuple[ContactPoint, ...]]:
    """Return the time in the form that does not depend on the search, and the incidences."""
    involved = {i for touch in touches for i in (touch.body, touch.other)}
    pieces = {i: _piece_before(scene.bodies[i], time, scene.exact_start) for i in involved}
    number = _as_root(scene, time, pieces, touches)
    sides: dict[tuple[int, range], int] = {}
    pairs = []
    for touch in touches:
        ring = _touched_ring(scene, touch)
        if ring is None or any(scene.bodies[i].exact_radius for i in (touch.body, touch.other)):
            outward = 0
        elif _may_have_crossed_itself(scene, touch):
            from exactpt.pair.exterior import exterior_side

            outward = exterior_side(scene.bodies[touch.other], pieces, touch, number)
        else:
            outward = sides.get(ring) or sides.setdefault(ring, _outward(scene, *ring))
        pairs.append(_pair(scene, pieces, touch, number, outward))
    return number, tuple(pairs)


def _as_root(
    scene: Scene,
    time: AlgebraicNumber,
    pieces: Mapping[int, Piece],
    touches: Sequence[Incidence],
) -> AlgebraicNumber:
    """Return the time as a root of the first incidence's polynomial."""
    if time.simplified().is_rational or not touches:
        return time
    touch = touches[0]
    v, other = pieces[touch.body].track(touch.vertex), pieces[touch.other]
    reach = scene.bodies[touch.body].exact_radius + scene.bodies[touch.other].exact_radius
    from exactpt.pair.features import FeaturePair

    f = FeaturePair(touch, v, _ends(scene, touch, other)).at_distance(reach * reach)
    return time.exact_as_root_of(f) if f else time


def _ends(scene: Scene, touch: Incidence, other: Piece) -> tuple[Track] | tuple[Track, Track]:
    """Return the vertex that is touched, or the ends of the edge."""
    if touch.edge < 0:
        return (other.track(touch.other_vertex),)
    end = scene.bodies[touch.other].end_of_edge(touch.edge)
    return other.track(touch.edge), other.track(end)


def _pair(
    scene: Scene,
    pieces: Mapping[int, Piece],
    touch: Incidence,
    time: AlgebraicNumber,
    outward: int,
) -> ContactPoint:
    v, ends = pieces[touch.body].track(touch.vertex), _ends(scene, touch, pieces[touch.other])
    normal = None
    x, y, w = v.x, v.y, v.w
    radii = scene.bodies[touch.body].exact_radius, scene.bodies[touch.other].exact_radius
    if any(radii):
        from exactpt.pair.radius_touch import touch_point

        x, y, w, n_x, n_y, n_w = touch_point(v, ends, *radii)
        normal = nearest_quotient(n_x, n_w, time), nearest_quotient(n_y, n_w, time)
    elif len(ends) == 2:
        normal = _normal(outward, v, *ends, time)
    return ContactPoint(
        kind="vertex-edge" if touch.edge >= 0 else "vertex-vertex",
        body=scene.bodies[touch.body].name,
        vertex=touch.vertex,
        other=scene.bodies[touch.other].name,
        edge=touch.edge if touch.edge >= 0 else None,
        other_vertex=touch.other_vertex if touch.edge < 0 else None,
        point=(finite(nearest_quotient(x, w, time)), finite(nearest_quotient(y, w, time))),
        normal=normal,
    )


def _touched_ring(scene: Scene, touch: Incidence) -> tuple[int, range] | None:
    """Return the body and the ring of the edge that is touched; None if a vertex or a chain is."""
    if touch.edge < 0 or not scene.bodies[touch.other].has_interior:
        return None
    return touch.other, next(r for r in scene.bodies[touch.other].rings if touch.edge in r)


def _may_have_crossed_itself(scene: Scene, touch: Incidence) -> bool:
    """Return True unless a touched polygon is certainly simple: otherwise it may touch itself.

    Where contacts of a body with itself do not count, it goes on after them. One that touches
    itself does so for the first time.
    """
    return touch.body != touch.other and not is_rigid(scene.bodies[touch.other])


def _outward(scene: Scene, number: int, ring: range) -> int:
    """Return the side of the edges of a ring on which the exterior of its body lies.

    That is 1 for the right one, -1 for the left one.
    """
    body = scene.bodies[number]
    is_outline = ring in [outline for outline, *_ in body.parts]
    turns_left = body.exact_piece_after(scene.exact_start).turns_left(ring, scene.exact_start)
    return 1 if turns_left == is_outline else -1


def _normal(
    outward: int, v: Track, a: Track, b: Track, time: AlgebraicNumber
) -> tuple[float, float]:
    w = multiply(a.w, b.w)
    dx, dy = vector(a, b)
    # The unit vector does not depend on the scale; at this scale no double under- or overflows.
    size = max(exponent(f, w, time) for f in (dx, dy))
    grown, shrunk = ZZ(1) << max(0, -size), ZZ(1) << max(0, size)
    w = scale(w, shrunk)
    x, y = (nearest_quotient(scale(f, grown), w, time) for f in (dx, dy))
    # A body without interior: towards the side from which the vertex came; to the right if it
    # came along the line.
    out = outward or -time.sign_before(orientation_polynomial(a, b, v)) or 1
    length = math.hypot(x, y)
    return (out * y / length + 0.0, -out * x / length + 0.0)
