"""Certified shadow edges: of each diagonal, what its six certificates are about.

A shadow edge s' of a diagonal s remains the same as long as it is tangent at both ends
(`exactpt.pseudotriangulation.shadow.is_tangent`), whatever else changes: which diagonal s is,
where the two faces have corners, or other vertices. So the ends certified last are tried first.
Signs decide whether s' is tangent there; none are needed where both neighbours and the kind of
angle are as certified.

theta(s) < theta(s') needs no test if both edges are as at the last test, and neither has been
vertical since (`exactpt.tiling.greedy.flipping`).
"""

from __future__ import annotations

from typing import Final, final

from mypy_extensions import i64, mypyc_attr

from exactpt.certificates.certificate import SHADOW, kind_of, pack, part_of
from exactpt.certificates.predicates import Predicates
from exactpt.indices import NO_HALF_EDGE, NO_VERTEX, CertificateId, HalfEdge, VertexId
from exactpt.planar.halfedge import twin
from exactpt.pseudotriangulation.flip import Shadows
from exactpt.pseudotriangulation.mesh import Mesh
from exactpt.pseudotriangulation.shadow import (
    has_visits,
    is_corner_without,
    is_tangent,
    shadow,
    visit_before,
)
from exactpt.tiling.angles import CertifiedMesh

COUNT: Final = 6
"""Number of certificates of a diagonal; bit k of a set of them is that of kind SHADOW + k: the
x-orders of s and s', then at each end of s' the neighbour after it and that before it."""

ALL: Final = (1 << COUNT) - 1
DIAGONAL: Final = 1
CROSSING: Final = 2
TANGENCIES: Final = ALL - DIAGONAL - CROSSING

SAME: Final = 0
OTHER_NEIGHBOUR: Final = 1
OTHER_ANGLE: Final = 2


@final
@mypyc_attr(acyclic=True)
class _End:
    """One end of a shadow edge.

    Attributes:
        visit: the half-edge that the shadow edge joins there.
        vertex, after, before, is_corner: the certified vertex, its neighbours around both faces
            of the diagonal, and whether it is at a corner of these together.
    """

    __slots__ = ("after", "before", "is_corner", "vertex", "visit")

    def __init__(self) -> None:
        self.visit: HalfEdge = NO_HALF_EDGE
        self.vertex: VertexId = NO_VERTEX
        self.after: VertexId = NO_VERTEX
        self.before: VertexId = NO_VERTEX
        self.is_corner: bool = False


@final
@mypyc_attr(acyclic=True)
class _Shadow:
    """A diagonal and its shadow edge.

    Attributes:
        u, v: the certified ends of the diagonal.
        first, second: the ends of the shadow edge.
        failed: the set of its certificates that have failed, or have not been computed.
        is_found: whether it has been found since it was certified.
    """

    __slots__ = ("failed", "first", "is_found", "second", "u", "v")

    def __init__(self) -> None:
        self.u: VertexId = NO_VERTEX
        self.v: VertexId = NO_VERTEX
        self.first: _End = _End()
        self.second: _End = _End()
        self.failed: i64 = ALL
        self.is_found: bool = False


@final
class CertifiedShadows(Shadows):
    """The shadow edges of all flippable diagonals, with their certificates."""

    def __init__(self, certified: CertifiedMesh) -> None:
        self._certified: CertifiedMesh = certified
        self._of: list[_Shadow | None] = []  # by edge: half of the handle
        self._found: list[HalfEdge] = []

    def clear(self) -> None:
        """Forget all, without their certificates."""
        self._of.clear()
        self._found.clear()

    def _get(self, h: HalfEdge) -> _Shadow | None:
        k = h >> 1
        return self._of[k] if k < len(self._of) else None

    def fail(self, certificate: CertificateId) -> None:
        """Note that a certificate has failed."""
        known = self._get(HalfEdge(part_of(certificate)))
        if known is not None:
            known.failed |= 1 << (kind_of(certificate) - SHADOW)

    def fail_all(self, h: HalfEdge) -> None:
        """Note that a body at the tiles of a diagonal moves anew."""
        known = self._get(h)
        if known is not None:
            known.failed = ALL

    def cancel(self, h: HalfEdge) -> None:
        """Forget the shadow edge of a diagonal, if there is one, with its certificates."""
        if self._get(h) is not None:
            self._of[h >> 1] = None
            for i in range(COUNT):
                self._certified.table.pending.cancel(pack(SHADOW + i, h))

    # Called by `flip_until_greedy`

    def is_greedy(self, h: HalfEdge) -> bool:
        """See `Shadows.is_greedy`: whether all is as certified, but for neighbours and angles."""
        known, mesh = self._get(h), self._certified.mesh
        if known is None or known.failed != 0:
            return False
        i, j, origin = known.first.visit, known.second.visit, mesh.map.origin
        if not (
            origin[h] == known.u
            and origin[h ^ 1] == known.v
            and origin[i] == known.first.vertex
            and origin[j] == known.second.vertex
            and has_visits(mesh, h, i, j)
        ):
            return False
        first, second = self._change(h, known.first), self._change(h, known.second)
        if first == SAME and second == SAME:
            return True
        if OTHER_ANGLE in (first, second):
            return False
        after = self._certified.after()
        if first != SAME and not is_tangent(mesh, h, i, j, after):
            return False
        if second != SAME and not is_tangent(mesh, h, j, i, after):
            return False
        self._note(h, known)
        return True

    def find(
        self, mesh: Mesh, h: HalfEdge, predicates: Predicates
    ) -> tuple[HalfEdge, HalfEdge] | None:
        """See `Shadows.find`: the ends certified last, if the segment between them is tangent.

        Not after a failed tangency, which would be tried in vain; and only if none is an end of h,
        so that the first is in the face of h, as after a walk.
        """
        known = self._get(h)
        if known is not None and known.failed & TANGENCIES == 0:
            i, j = _visit_in_face(mesh, h, known.first), _visit_in_face(mesh, twin(h), known.second)
            if (
                i >= 0 <= j
                and is_tangent(mesh, h, i, j, predicates)
                and is_tangent(mesh, h, j, i, predicates)
            ):
                return i, j
        return shadow(mesh, h, predicates)

    def keep(self, h: HalfEdge, visits: tuple[HalfEdge, HalfEdge]) -> None:
        """See `Shadows.keep`."""
        known = self._get(h)
        if known is None:
            known = _Shadow()
            k = h >> 1
            if k >= len(self._of):
                self._of += [None] * (k + 1 - len(self._of))
            self._of[k] = known
        known.first.visit, known.second.visit = visits
        self._note(h, known)

    def _note(self, h: HalfEdge, known: _Shadow) -> None:
        if not known.is_found:
            known.is_found = True
            self._found.append(h)

    def _change(self, h: HalfEdge, end: _End) -> i64:
        """Return the difference of an end from its certified state, the vertex ignored."""
        mesh, visit = self._certified.mesh, end.visit
        origin = mesh.map.origin
        if is_corner_without(mesh, h, visit, self._certified.after()) != end.is_corner:
            return OTHER_ANGLE
        before = origin[visit_before(mesh, h, visit)]
        return SAME if origin[visit ^ 1] == end.after and before == end.before else OTHER_NEIGHBOUR

    # Certificates

    def certify(self) -> None:
        """Certify the shadow edges found since the last time, as far as they have changed."""
        self._found.sort()
        for h in self._found:
            known = self._get(h)
            if known is not None:
                known.is_found = False
                changed = self._update(h, known)
                if changed != 0:
                    self._schedule(h, known, changed)
        self._found.clear()

    def resume(self, h: HalfEdge, visits: tuple[HalfEdge, HalfEdge]) -> None:
        """Remember a shadow edge whose certificates are pending already."""
        self.keep(h, visits)
        known = self._get(h)
        if known is not None:
            known.is_found = False
            self._update(h, known)
        self._found.clear()

    def _update(self, h: HalfEdge, known: _Shadow) -> i64:
        """Make everything as it is in the mesh; returns the set of certificates to compute.

        A certificate of the same vertices as before that has not failed is pending still.
        """
        origin, x, y = self._certified.mesh.map.origin, known.first, known.second
        u, v, changed = origin[h], origin[h ^ 1], known.failed
        if u != known.u or v != known.v:
            changed |= DIAGONAL
        if origin[x.visit] != x.vertex or origin[y.visit] != y.vertex:
            changed |= CROSSING | TANGENCIES
        changed |= self._update_end(h, x) << 2 | self._update_end(h, y) << 4
        known.u, known.v, known.failed = u, v, 0
        return changed

    def _update_end(self, h: HalfEdge, end: _End) -> i64:
        """As `_update` for one end: 1 if it has another neighbour after it, 2 if before it."""
        mesh, visit = self._certified.mesh, end.visit
        origin = mesh.map.origin
        after, before = origin[visit ^ 1], origin[visit_before(mesh, h, visit)]
        changed: i64 = 0
        if after != end.after:
            changed += 1
        if before != end.before:
            changed += 2
        end.vertex, end.after, end.before = origin[visit], after, before
        end.is_corner = is_corner_without(mesh, h, visit, self._certified.after())
        return changed

    def _schedule(self, h: HalfEdge, known: _Shadow, changed: i64) -> None:
        """Compute a set of certificates: that s < s' by theta, and that s' is tangent."""
        x, y = known.first, known.second
        if changed & DIAGONAL:
            self._certify_x_order(pack(SHADOW, h), known.u, known.v)
        if changed & CROSSING:
            self._certify_x_order(pack(SHADOW + 1, h), x.vertex, y.vertex)
        if changed & 4:
            self._certify_tangency(pack(SHADOW + 2, h), x.vertex, x.after, y.vertex)
        if changed & 8:
            self._certify_tangency(pack(SHADOW + 3, h), x.vertex, y.vertex, x.before)
        if changed & 16:
            self._certify_tangency(pack(SHADOW + 4, h), y.vertex, y.after, x.vertex)
        if changed & 32:
            self._certify_tangency(pack(SHADOW + 5, h), y.vertex, x.vertex, y.before)

    def _certify_x_order(self, certificate: CertificateId, u: VertexId, v: VertexId) -> None:
        table = self._certified.table
        if not self._certified.after().left_of(u, v):
            u, v = v, u
        if self._certified.certifier.keeps_x_order(u, v):
            table.pending.cancel(certificate)
        else:
            table.watch_x_order(certificate, u, v)

    def _certify_tangency(
        self, certificate: CertificateId, a: VertexId, b: VertexId, c: VertexId
    ) -> None:
        table = self._certified.table
        if a in (b, c) or b == c or self._certified.certifier.rigid(a, b, c):
            table.pending.cancel(certificate)
        else:
            table.watch_orientation(certificate, a, b, c)


def _visit_in_face(mesh: Mesh, h: HalfEdge, end: _End) -> HalfEdge:
    """Return a visit of an end's vertex in the face of h, the last one if still valid.

    `NO_HALF_EDGE` if there is none, and at an end of h.
    """
    origin, following = mesh.map.origin, mesh.map.following
    vertex, found = end.vertex, NO_HALF_EDGE
    if vertex not in (origin[h], origin[h ^ 1]):
        g = following[h]
        while g != h:
            if origin[g] == vertex:
                found = g
                if g == end.visit:
                    break
            g = following[g]
    return found
