"""Trajectories of vertices that turn: their common part is computed once a motion.

With h the tangent of half the angle and w = 1 + h^2, the cosine is (1 - h^2) / w and the sine
2 h / w. A vertex at (dx, dy) from the pivot, which is at (p, q), is at

    x = ((1 - h^2) dx - 2 h dy + w p) / w,    y = (2 h dx + (1 - h^2) dy + w q) / w.
"""

from __future__ import annotations

from typing import NamedTuple

from exactpt.kernel.numbers import QQ
from exactpt.kernel.polynomial import ONE, Polynomial
from exactpt.motion.track import Track, Turning, track


class Turn(NamedTuple):
    """A turn: polynomials, and coefficients of polynomials, all of one length.

    Attributes:
        w: the denominator.
        cosine, sine: of the angle, times w.
        x, y: the path of the pivot, times w.
        pivot: in the rest frame.
        orientation: the cosine and the sine of the angle by which a vertex is turned first.
        identity: of the motion.
    """

    w: Polynomial
    cosine: tuple[QQ, ...]
    sine: tuple[QQ, ...]
    x: tuple[QQ, ...]
    y: tuple[QQ, ...]
    pivot: tuple[QQ, QQ]
    orientation: tuple[QQ, QQ]
    identity: Turning

    def track(self, position: tuple[Polynomial, Polynomial]) -> Track:
        """Return the trajectory of the vertex with this position in the rest frame."""
        u, v = position
        rigid = u.degree <= 0 and v.degree <= 0
        x, y = (
            self._resting(u.exact_at(QQ(0)), v.exact_at(QQ(0))) if rigid else self._deforming(u, v)
        )
        if self.w.degree <= 0:
            scale = Polynomial([1 / self.w.exact_at(QQ(0))])
            return track(x * scale, y * scale, None, None)
        return track(x, y, self.w, self.identity if rigid else None)

    def _resting(self, u: QQ, v: QQ) -> tuple[Polynomial, Polynomial]:
        """Return the trajectory of a vertex at rest in the rest frame, times w."""
        dx, dy = u - self.pivot[0], v - self.pivot[1]
        c, s = self.orientation
        if c != 1:
            dx, dy = c * dx - s * dy, s * dx + c * dy
        terms = list(zip(self.cosine, self.sine, self.x, self.y, strict=True))
        return (
            Polynomial.exact_from([cosine * dx - sine * dy + x for cosine, sine, x, _ in terms]),
            Polynomial.exact_from([sine * dx + cosine * dy + y for cosine, sine, _, y in terms]),
        )

    def _deforming(self, u: Polynomial, v: Polynomial) -> tuple[Polynomial, Polynomial]:
        """Return the trajectory of a vertex that moves in the rest frame, times w."""
        cosine, sine, x, y = (
            Polynomial.exact_from(list(f)) for f in (self.cosine, self.sine, self.x, self.y)
        )
        dx, dy = u - Polynomial([self.pivot[0]]), v - Polynomial([self.pivot[1]])
        if self.orientation[0] != 1:
            c, s = (Polynomial([part]) for part in self.orientation)
            dx, dy = c * dx - s * dy, s * dx + c * dy
        return cosine * dx - sine * dy + x, sine * dx + cosine * dy + y


def turn_of(
    half_turn: Polynomial,
    pivot: tuple[QQ, QQ],
    path: tuple[Polynomial, Polynomial],
    orientation: tuple[QQ, QQ],
) -> Turn:
    """Return the turn with this tangent of half the angle, about a pivot that takes a path."""
    h, (x, y) = half_turn, path
    w = ONE + h * h
    parts = [f.exact_coefficients for f in (ONE - h * h, h + h, w * x, w * y)]
    size = max(map(len, parts))
    cosine, sine, path_x, path_y = ((*f, *[QQ(0)] * (size - len(f))) for f in parts)
    return Turn(w, cosine, sine, path_x, path_y, pivot, orientation, Turning(h, x, y))
