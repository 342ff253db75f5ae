"""Repairs of the incremental pseudo-triangulation at the time of an event.

A failure moves one edge, or two at an exchange in the x-order, and at most four certificates
of edges and three of the x-order are new.

**Events at one time** are processed one after the other, each by the signs just after that
time, until no certificate is violated. By the lemma of
`exactpt.tiling.incremental.structure`, the result is then the structure just after that time,
whatever the order of the repairs. Possible exchanges come first, so that the points on a
vertical line still have their trees from just before. If no repair is possible, or there are
many, columns of points with equal x are sorted as a whole
(`exactpt.tiling.incremental.columns`). If that does not help either, or if the repairs have
taken longer than a sweep, the structure is swept from scratch, also by the signs just after
that time.
"""

from __future__ import annotations

from functools import cmp_to_key
from typing import final

from exactpt.certificates.certificate import POINT_ORDER
from exactpt.certificates.certifier import Certifier
from exactpt.errors import AuditError
from exactpt.indices import Ends, VertexId
from exactpt.kernel.budget import check_budget
from exactpt.planar.halfedge import edge_key
from exactpt.tiling.events import Log
from exactpt.tiling.incremental.certified_trees import CertifiedTrees
from exactpt.tiling.incremental.chains import Chains
from exactpt.tiling.incremental.columns import column_around, resweep
from exactpt.tiling.incremental.fan import Fan
from exactpt.tiling.incremental.structure import LOWER, UPPER, IncrementalStructure


@final
class TreeRepairs:
    """Repairs the violated certificates of a structure of points.

    Args:
        certified: the structure with its certificates.
        certifier: certificates and the current time.
        log: the record of events.
        chains: the representation of chains.
        fan: the fan triangulation, if it is maintained.
    """

    def __init__(
        self,
        certified: CertifiedTrees,
        certifier: Certifier,
        log: Log,
        chains: Chains,
        fan: Fan | None,
    ) -> None:
        self._certified: CertifiedTrees = certified
        self._certifier: Certifier = certifier
        self._log: Log = log
        self._chains: Chains = chains
        self._fan: Fan | None = fan
        self._is_alone: bool = True  # whether the event is the only one at its time, so far

    def repair_all(self) -> None:
        """Repair until nothing is violated just after now."""
        n = len(self._certified.now.order)
        rounds = 0
        self._is_alone = sum(map(len, self._certified.violated)) == 1
        while any(self._certified.violated):
            check_budget()  # repairs of a forged tree may have no end
            rounds += 1
            if rounds <= 16 + n // 4 and self._repair_one():
                self._is_alone &= not any(self._certified.violated)
                continue
            self._is_alone = False
            if self._sort_columns():
                rounds = 0
            elif rounds > 64 + n or not self._repair_one():
                self._rebuild()
        if self._fan is not None and not self._is_alone:
            self._fan.derive(self._certified.now)

    def _repair_one(self) -> bool:
        """Repair one violated certificate; returns whether a repair was possible."""
        upper, lower, order = self._certified.violated
        if any(self._exchange(p) for p in sorted(order)):
            return True
        if upper:
            self._repair_edge(UPPER, min(upper))
        elif lower:
            self._repair_edge(LOWER, min(lower))
        else:
            return False
        return True

    def _repair_edge(self, side: int, b: VertexId) -> None:
        """Move the edge on which b hangs, whose certificate is violated."""
        structure = self._certified.now
        kind = self._kind(side, b)
        p, old, new, changed = structure.repair(side, b)
        there = structure.trees[1 - side].parent[p]
        removed = () if there == old else (edge_key(p, old),)
        added = () if there == new else (edge_key(p, new),)
        self._log.record(kind, removed, added)
        if self._fan is not None and self._is_alone:
            past, middle = (new, old) if p == b else (old, new)
            self._fan.repair(structure, side, (p, past), middle)
        for c in changed:
            self._certified.certify_edge(side, c)

    def _kind(self, side: int, b: VertexId) -> str:
        """Return the kind of event at which the certificate of b fails."""
        structure = self._certified.now
        tree = structure.trees[side]
        n = tree.after[b]
        edge = n if n >= 0 else b
        on_hull = tree.after[edge] < 0 and tree.top(edge) == structure.order[0]
        return "hull" if on_hull else "corner" if n >= 0 else "reflex"

    def _exchange(self, p: VertexId) -> bool:
        """Exchange p and the next point in the x-order; returns whether that was possible."""
        structure = self._certified.now
        order, rank = structure.order, structure.rank
        q = order[rank[p] + 1]
        before = self._edges_of(p, q)
        exchanged = structure.exchange(p, q, self._certified.after)
        if exchanged is None:
            return False
        if self._fan is not None and self._is_alone:
            self._fan.exchange(structure, exchanged, q)
        after = self._edges_of(p, q)
        self._log.record("x-order", tuple(sorted(before - after)), tuple(sorted(after - before)))
        for side, changed in enumerate(exchanged.edges):
            for c in changed:
                self._certified.certify_edge(side, c)
        i = rank[q]
        for c in order[max(i - 1, 0) : i + 2]:
            self._certified.certify_order(c)
        return True

    def _sort_columns(self) -> bool:
        """Sort the columns with points in the wrong order; returns whether one could be sorted."""
        structure, certified = self._certified.now, self._certified
        order, found = structure.order, False
        for p in sorted(certified.violated[POINT_ORDER], key=structure.rank.__getitem__):
            if p not in certified.violated[POINT_ORDER]:
                continue  # of a column that has been sorted
            i, end = column_around(self._certifier, structure, p)
            old = order[i:end]
            new = sorted(old, key=cmp_to_key(self._x_comparison))
            before = self._edges_of(*old)
            changed = resweep(structure, new, certified.after)
            if changed is None:
                continue
            found = True
            after = self._edges_of(*new)
            self._log.record(
                "x-order", tuple(sorted(before - after)), tuple(sorted(after - before))
            )
            for side, edges in enumerate(changed):
                for c in sorted(edges):
                    certified.certify_edge(side, c)
            for c in order[max(i - 1, 0) : end]:
                certified.certify_order(c)
        return found

    def _edges_of(self, *points: VertexId) -> set[Ends]:
        """Return the edges from some points to the left."""
        return {
            edge_key(p, tree.parent[p])
            for tree in self._certified.now.trees
            for p in points
            if tree.parent[p] >= 0
        }

    def _rebuild(self) -> None:
        """Sweep from scratch, by the signs just after now; unchanged certificates are kept."""
        self._log.stats.rebuilds += 1
        old = self._certified.now
        edges = self._edges_of(*old.order)
        order = sorted(old.order, key=cmp_to_key(self._x_comparison))
        new = IncrementalStructure.sweep(order, self._certified.after)
        if self._chains.kind == "searchable":
            new.make_searchable()
        self._certified.replace(new)
        if any(self._certified.violated):
            raise AuditError(f"violated after a sweep: {self._certified.violated}")
        after = self._edges_of(*order)
        kind = "reflex" if order == old.order else "x-order"
        self._log.record(kind, tuple(sorted(edges - after)), tuple(sorted(after - edges)))

    def _x_comparison(self, p: VertexId, q: VertexId) -> int:
        return 0 if p == q else -1 if self._certified.after.left_of(p, q) else 1
