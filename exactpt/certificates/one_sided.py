"""Predicates just after, or just before, the current time of a run."""

from __future__ import annotations

from typing import TYPE_CHECKING, final

from exactpt.certificates.certifier import X_ORDER
from exactpt.certificates.coincidence import nearer, nearer_copy
from exactpt.certificates.perturbation import cross, orientation_polynomial, x_order
from exactpt.certificates.predicates import Predicates
from exactpt.certificates.reasons import reason
from exactpt.indices import VertexId

if TYPE_CHECKING:
    from exactpt.certificates.certifier import Certifier
    from exactpt.kernel.integer_polynomial import IntPoly
    from exactpt.motion.vertex import Vertex, VertexList


@final
class OneSided(Predicates):
    """Signs just after now (t+) or just before it (t-); they differ only at zeros now."""

    def __init__(self, certifier: Certifier, *, before: bool) -> None:
        self._certifier = certifier
        self._all: VertexList = certifier.all
        self._before: bool = before

    def orientation(self, a: VertexId, b: VertexId, c: VertexId) -> int:
        """1 if a, b, c turn left, -1 if they turn right, 0 if always collinear (counts as -1)."""
        certifier, v = self._certifier, self._all
        va, vb, vc = v[a], v[b], v[c]
        if not certifier.exact_only:
            s = certifier.positions.orientation(va, vb, vc)
            if s:
                certifier.counters.filtered += 1
                return s
            s = self._filtered_sign(a, b, c)
            if s:
                certifier.counters.filtered += 1
                return s
        return self._exact(orientation_polynomial(va, vb, vc), va, vb, vc)

    def _filtered_sign(self, a: VertexId, b: VertexId, c: VertexId) -> int:
        """Return the sign of the orientation, also if it vanishes now; 0 if undecided."""
        certifier, v = self._certifier, self._all
        va, vb, vc = v[a], v[b], v[c]
        if va.is_copy_of(vb) or vb.is_copy_of(vc) or va.is_copy_of(vc):
            return 0
        vanishes = certifier.vanishes_now(a, b, c)
        if vanishes and self._before:
            return 0
        s, _, _ = certifier.filter_orientation(a, b, c, self._horizon(), vanishes)
        return s

    def left_of(self, a: VertexId, b: VertexId) -> bool:
        """Return True if a is left of b."""
        certifier = self._certifier
        va, vb = self._all[a], self._all[b]
        if not certifier.exact_only:
            s = certifier.positions.order(va, vb, 0)
            if s:
                certifier.counters.filtered += 1
                return s > 0
        vanishes = certifier.vanishes_now(a, b, X_ORDER)
        copies = va.is_copy_of(vb)
        if not (certifier.exact_only or copies or (vanishes and self._before)):
            s, _, _ = certifier.filter_x_difference(a, b, self._horizon(), vanishes)
            if s:
                certifier.counters.filtered += 1
                return s > 0
        return self._exact(x_order(va, vb), va, vb) > 0

    def cross_sign(self, a: VertexId, b: VertexId, c: VertexId, d: VertexId) -> int:
        """1 if the direction from a to b turns left to that from c to d, -1 if right."""
        certifier = self._certifier
        v = self._all
        p, q, r, t = v[a], v[b], v[c], v[d]
        if not certifier.exact_only:
            s = certifier.positions.cross_sign(p, q, r, t) or self._cross_sign_at_end(a, b, c, d)
            if s:
                certifier.counters.filtered += 1
                return s
        return self._exact(cross(p.track, q.track, r.track, t.track), p, q, r, t)

    def _cross_sign_at_end(self, a: VertexId, b: VertexId, c: VertexId, d: VertexId) -> int:
        """Return the turn of two segments with a common end; 0 if undecided, or without one.

        (b - a) x (d - c) is then an orientation of the three vertices. It vanishes at each event at
        which a diagonal passes its shadow.
        """
        if a == c:
            return self._filtered_sign(a, b, d)
        if b == d:
            return self._filtered_sign(b, a, c)
        if a == d:
            return self._filtered_sign(a, c, b)
        if b == c:
            return self._filtered_sign(a, b, d)
        return 0

    def nearer(self, p: VertexId, a: VertexId, b: VertexId) -> bool:
        """Return True if a is nearer to p than b is, for a and b in the same direction from p."""
        certifier = self._certifier
        o, u, v = (certifier.all[i] for i in (p, a, b))
        return (nearer(certifier, o, u, v) or nearer_copy(certifier, o, u, v)) > 0

    def _horizon(self) -> float:
        # No root is needed, but the filter requires a nonempty interval.
        high = self._certifier.now_high
        return high + 1e-12 * (1.0 + abs(high))

    def _exact(self, f: IntPoly, *vertices: Vertex) -> int:
        now, exact_only = self._certifier.exact_now, self._certifier.exact_only
        s = now.sign_of(f) if f else 0
        why = reason(*vertices, is_zero=s == 0, exact_only=exact_only)
        self._certifier.counters.count_exact("sign", why)
        if s:
            return s
        return now.sign_before(f) if self._before else now.sign_after(f)
