"""The certificates of an incremental pseudo-triangulation, pending or violated.

Their kinds are those of `exactpt.certificates.certificate.PointKind`.
"""

from __future__ import annotations

from typing import cast, final

from exactpt.certificates.certificate import POINT_ORDER, pack_point
from exactpt.certificates.certifier import Certifier
from exactpt.certificates.one_sided import OneSided
from exactpt.certificates.table import CertificateTable
from exactpt.indices import VertexId
from exactpt.tiling.incremental.structure import LOWER, UPPER, IncrementalStructure


@final
class CertifiedTrees:
    """The two trees of a structure at the current time, with their certificates.

    Attributes:
        now: the structure.
        after: predicates just after the current time.
        violated: for each kind, the points whose certificate is violated just after now.
    """

    __slots__ = ("_certifier", "_table", "after", "now", "violated")

    def __init__(
        self, structure: IncrementalStructure, certifier: Certifier, table: CertificateTable
    ) -> None:
        self.now = structure
        self._certifier = certifier
        self._table = table
        self.after = OneSided(certifier, before=False)
        self.violated: list[set[VertexId]] = [
            cast("set[VertexId]", table.violated[kind]) for kind in (UPPER, LOWER, POINT_ORDER)
        ]

    def certify_everything(self) -> None:
        """Certify all edges and all neighbours in the x-order."""
        for p in self.now.order:
            self.certify_edge(UPPER, p)
            self.certify_edge(LOWER, p)
            self.certify_order(p)

    def certify_edge(self, side: int, b: VertexId) -> None:
        """Certify the edge from b to its parent in a tree."""
        certificate_id = pack_point(side, b)
        violated = self.violated[side]
        violated.discard(b)
        certificate = self.now.certificate(side, b)
        if certificate is None:
            self._table.schedule(certificate_id, None)
            return
        lo, mid, hi, turns_away = certificate
        certifier = self._certifier
        if certifier.rigid(lo, mid, hi):
            # A sign that cannot change may be wrong in the midst of simultaneous repairs.
            certifier.skipped += 1
            s, time = self.after.orientation(lo, mid, hi), None
        else:
            s, time = certifier.orientation(lo, mid, hi)
        if (s == (1 if side == UPPER else -1)) != turns_away:
            violated.add(b)
            time = None
        self._table.schedule(certificate_id, time)

    def certify_order(self, p: VertexId) -> None:
        """Certify that p is left of the next point."""
        certificate_id = pack_point(POINT_ORDER, p)
        violated = self.violated[POINT_ORDER]
        violated.discard(p)
        order = self.now.order
        i = self.now.rank[p] + 1
        if i == len(order):
            self._table.schedule(certificate_id, None)
            return
        q = order[i]
        certifier = self._certifier
        time = None
        if certifier.keeps_x_order(p, q):
            certifier.skipped += 1
            is_left = self.after.left_of(p, q)
        else:
            s, time = certifier.x_order(p, q, touching=True)
            is_left = s > 0
        if not is_left:
            violated.add(p)
            time = None
        self._table.schedule(certificate_id, time)

    def certify_point(self, p: VertexId) -> None:
        """Certify again whatever depends on the motion of a point."""
        i = self.now.rank[p]
        for q in self.now.order[max(i - 1, 0) : i + 1]:
            self.certify_order(q)
        for side in (UPPER, LOWER):
            tree = self.now.trees[side]
            edges = {p, tree.before[p]}
            c = tree.first[p]
            while c >= 0:
                edges |= {c, tree.last[c]}
                c = tree.after[c]
            for b in sorted(edges):
                if b >= 0:
                    self.certify_edge(side, b)

    def replace(self, new: IncrementalStructure) -> None:
        """Replace the structure by a new one; certificates common to both are kept."""
        old, self.now = self.now, new
        for side in (UPPER, LOWER):
            for b in new.order:
                if b in self.violated[side] or new.certificate(side, b) != old.certificate(side, b):
                    self.certify_edge(side, b)
        for i, p in enumerate(new.order):
            j = old.rank[p]
            if (
                p in self.violated[POINT_ORDER]
                or new.order[i + 1 : i + 2] != old.order[j + 1 : j + 2]
            ):
                self.certify_order(p)
