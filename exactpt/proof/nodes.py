"""The vertices of a scene with consecutive numbers, and exact functions of their motions."""

from __future__ import annotations

from bisect import bisect_right
from itertools import accumulate
from typing import TYPE_CHECKING, final

from exactpt.geometry.polygon import is_counter_clockwise
from exactpt.kernel.algebraic import AlgebraicNumber
from exactpt.kernel.integer_polynomial import (
    IntPoly,
    add,
    evaluate,
    multiply,
    scale,
    subtract,
)
from exactpt.kernel.numbers import QQ, ZZ
from exactpt.kernel.roots import roots_after
from exactpt.motion.spin import Spin
from exactpt.motion.track import difference, orientation_polynomial

if TYPE_CHECKING:
    from exactpt.motion.body import Body
    from exactpt.motion.track import Track
    from exactpt.scene.scene import Scene


@final
class Nodes:
    """The vertices of a scene, numbered body by body.

    Attributes:
        scene: the scene.
        first: for each body, the number of its first vertex.
        body_of: for each vertex, the number of its body.
        rigid: for each body, whether it keeps its shape during the scene.
    """

    def __init__(self, scene: Scene) -> None:
        self.scene = scene
        self.first = list(accumulate((body.size for body in scene.bodies), initial=0))
        self.body_of = [i for i, body in enumerate(scene.bodies) for _ in range(body.size)]
        self.rigid = [
            _deforms_from(body, scene.exact_start, scene.exact_end) is None for body in scene.bodies
        ]

    def solid_faces(self) -> list[list[int]]:
        """Return the rings of the rigid closed bodies, each with the body on its left."""
        faces = []
        for first, body, rigid in zip(self.first, self.scene.bodies, self.rigid, strict=False):
            if not (rigid and body.has_interior):
                continue
            points = body.exact_at(self.scene.exact_start)
            for rings in body.parts:
                for k, ring in enumerate(rings):
                    nodes = [first + i for i in ring]
                    turns_left = is_counter_clockwise(points[ring.start : ring.stop])
                    faces.append(nodes if turns_left == (k == 0) else nodes[::-1])
        return faces

    def track(self, v: int, after: QQ) -> Track:
        """Return the trajectory of a vertex just after a rational time."""
        i = self.body_of[v]
        return self.scene.bodies[i].exact_piece_after(after).track(v - self.first[i])

    def last_break(self, i: int, time: AlgebraicNumber) -> QQ:
        """Return the last breakpoint of a body not after a time, or the start of the scene."""
        return self.scene.bodies[i].exact_last_breakpoint(time, self.scene.exact_start)

    def orientation(self, a: int, b: int, c: int, after: QQ) -> IntPoly:
        """Return the orientation of three vertices after a rational time; () if always 0."""
        return orientation_polynomial(
            self.track(a, after), self.track(b, after), self.track(c, after)
        )

    def vanishing(self, name: tuple[int, ...], after: QQ) -> IntPoly:
        """Return the orientation of three vertices, or the difference of the abscissas of two."""
        if len(name) == 3:
            return self.orientation(name[0], name[1], name[2], after)
        p, q = self.track(name[0], after), self.track(name[1], after)
        return difference(p.x, p.w, q.x, q.w)

    def breaks(self, vertices: tuple[int, ...]) -> list[QQ]:
        """Return breakpoints of some vertices, in order.

        Between two of them the formulas in a file do not change.
        """
        times: set[QQ] = set()
        for i in {self.body_of[v] for v in vertices}:
            body = self.scene.bodies[i]
            if isinstance(body.motion, Spin):
                # A file has the pieces that cover the span: others begin beyond its ends.
                span = self.scene.exact_start, self.scene.exact_end
                times.update(span, body.exact_breakpoints_between(*span))
            else:
                times.update(body.exact_breakpoints)
        return sorted(times)

    def fails(self, angle: tuple[int, int, int], now: AlgebraicNumber) -> AlgebraicNumber | None:
        """Return the time at which a new angle vanishes or ceases to be flat; None if never.

        A flat angle vanishes where two of its vertices coincide; that is a contact, and is not
        considered here.
        """
        a, p, b = angle
        i = self.body_of[p]
        if a == b or (self.rigid[i] and self.body_of[a] == i == self.body_of[b]):
            return None
        scene = self.scene
        breaks = [b for b in self.breaks(angle) if scene.exact_start < b < scene.exact_end]
        k = bisect_right(breaks, now.exact_low)
        while k < len(breaks) and now.compare_rational(breaks[k]) >= 0:
            k += 1
        begin = breaks[k - 1] if k else scene.exact_start
        time = now
        straight: bool | None = None
        for end in [*breaks[k:], scene.exact_end]:
            f = self.orientation(a, p, b, begin)
            if straight is None:
                straight = not f
            if (not f) != straight:
                return AlgebraicNumber(begin)
            root = next(roots_after(f, time, end), None) if f else None
            if root is not None:
                return root.time
            begin, time = end, AlgebraicNumber(end)
        return None


def rigid_until(scene: Scene) -> QQ:
    """Return the first time at which a body that was rigid deforms, or the end."""
    times = [_deforms_from(body, scene.exact_start, scene.exact_end) for body in scene.bodies]
    return min(
        (t for t in times if t is not None and t > scene.exact_start), default=scene.exact_end
    )


def _deforms_from(body: Body, start: QQ, end: QQ) -> QQ | None:
    """Return the start of the first piece that changes lengths or angles, or None."""
    times = [start, *body.exact_breakpoints_between(start, end)]
    for t in times:
        tracks = body.exact_piece_after(t).tracks
        motion = tracks[0].motion
        if motion is not None and all(track.motion == motion for track in tracks):
            continue
        n = len(tracks)
        last = n if body.closed and n > 2 else n - 1
        for k in range(last):
            a, v, b = tracks[k], tracks[(k + 1) % n], tracks[(k + 2) % n]
            if not _is_constant(_product(a, v, a), t) or (
                (body.closed or k + 2 < n)
                and not (_is_constant(_product(a, v, b), t) and _is_constant(_area(a, v, b), t))
            ):
                return t
    return None


def _product(a: Track, v: Track, b: Track) -> tuple[IntPoly, IntPoly]:
    """Return (a - v) . (b - v), as numerator and denominator."""
    f = multiply(difference(v.x, v.w, a.x, a.w), difference(v.x, v.w, b.x, b.w))
    g = multiply(difference(v.y, v.w, a.y, a.w), difference(v.y, v.w, b.y, b.w))
    return add(f, g), multiply(multiply(v.w, a.w), multiply(v.w, b.w))


def _area(a: Track, v: Track, b: Track) -> tuple[IntPoly, IntPoly]:
    return orientation_polynomial(a, v, b), multiply(multiply(a.w, v.w), b.w)


def _is_constant(quotient: tuple[IntPoly, IntPoly], t: QQ) -> bool:
    f, g = quotient
    c = evaluate(f, t) / evaluate(g, t)
    return not subtract(scale(f, ZZ(c.denominator)), scale(g, ZZ(c.numerator)))
