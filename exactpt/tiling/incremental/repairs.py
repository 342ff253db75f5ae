"""Repairs of the incremental pseudo-triangulation at the time of an event.

A failure moves one edge, or two at an exchange in the x-order, and takes at most four new
certificates of edges and three of the x-order.

**Events at one time** are processed one after the other, each judged by the signs just
after that time, until no certificate is violated. By the lemma of
`exactpt.tiling.incremental.structure`, the result is then the structure of that moment, in
whatever order it was reached. Exchanges come first, where they are possible: what stands in
a vertical line then has its trees as they were just before. If nothing is possible, or there
are many, points of one x are put in order together (`exactpt.tiling.incremental.columns`).
If that does not help, or more has happened than a sweep costs, the structure is swept anew,
with the signs just after that time too.
"""

from __future__ import annotations

from functools import cmp_to_key

from exactpt.certificates.certificate import POINT_ORDER
from exactpt.certificates.certifier import Certifier
from exactpt.errors import AuditError
from exactpt.motion.vertices import Vertices
from exactpt.planar.halfedge import edge_key
from exactpt.pseudotriangulation.mesh import Mesh
from exactpt.tiling.catalogue import Entry
from exactpt.tiling.events import Stats
from exactpt.tiling.incremental.certified import CertifiedStructure
from exactpt.tiling.incremental.chains import PATIENCE, ChainKind, Chains
from exactpt.tiling.incremental.columns import resweep
from exactpt.tiling.incremental.contacts import column_around
from exactpt.tiling.incremental.fan import changes_of_exchange, fan_edges
from exactpt.tiling.incremental.structure import LOWER, UPPER, IncrementalStructure
from exactpt.tiling.tiling import Tiling

__all__ = ["RepairedStructure"]


class RepairedStructure(Tiling):
    """A structure of points whose violated certificates are mended.

    Args:
        entry: its line in the catalogue.
        vertices: the points.
        certifier: at the current time.
        stats: counts.
        chains: how chains are kept; see `Chains`.
        fan: count the changes of the fan triangulation too, in ``stats.fan``.

    Attributes:
        chains: how chains are kept at present.
    """

    def __init__(
        self,
        entry: Entry,
        vertices: Vertices,
        certifier: Certifier,
        stats: Stats,
        *,
        chains: ChainKind = "auto",
        fan: bool = False,
    ) -> None:
        super().__init__(entry, vertices, certifier, stats)
        self.chains: Chains = Chains(chains, PATIENCE * len(vertices.all))
        self._fan: bool = fan
        self._mesh: Mesh | None = None
        self._certified: CertifiedStructure

    def _keep(self, structure: IncrementalStructure) -> None:
        """Have this structure, of which nothing is certified."""
        if self.chains.kind == "searchable":
            structure.make_searchable()
        self._certified = CertifiedStructure(structure, self.certifier, self.table)

    @property
    def structure(self) -> IncrementalStructure:
        """The tiling just after the current time, as trees."""
        return self._certified.now

    def _settle(self) -> None:
        """Repair until nothing is violated just after now."""
        n = len(self.structure.order)
        rounds = 0
        while any(self._certified.due):
            rounds += 1
            if rounds <= 16 + n // 4 and self._mend():
                continue
            if self._sweep_columns():
                rounds = 0
            elif rounds > 64 + n or not self._mend():
                self._rebuild()

    def _mend(self) -> bool:
        """Let the event of one violated certificate happen; whether one was possible."""
        upper, lower, order = self._certified.due
        if any(self._exchange(p) for p in sorted(order)):
            return True
        if upper:
            self._repair(UPPER, min(upper))
        elif lower:
            self._repair(LOWER, min(lower))
        else:
            return False
        return True

    def _repair(self, side: int, b: int) -> None:
        """Move the edge whose certificate, that of b, is violated."""
        structure = self.structure
        kind = self._kind(side, b)
        p, old, new, changed = structure.repair(side, b)
        there = structure.trees[1 - side].parent[p]
        removed = () if there == old else (edge_key(p, old),)
        added = () if there == new else (edge_key(p, new),)
        self.log.record(kind, removed, added)
        if self._fan:
            # The edge past the middle point goes or comes; and so, if a tile lies beyond
            # the edge, does the one from the middle point to the tip of that tile.
            past = new if p == b else old
            self.stats.fan += (there != past) + (kind != "hull")
        for c in changed:
            self._certified.certify_edge(side, c)

    def _kind(self, side: int, b: int) -> str:
        """What the failure of the certificate of b is."""
        structure = self.structure
        tree = structure.trees[side]
        n = tree.after[b]
        edge = n if n >= 0 else b
        on_hull = tree.after[edge] < 0 and tree.top(edge) == structure.order[0]
        return "hull" if on_hull else "corner" if n >= 0 else "reflex"

    def _exchange(self, p: int) -> bool:
        """Let p and the next point exchange their places; whether that is possible."""
        structure = self.structure
        order, rank = structure.order, structure.rank
        q = order[rank[p] + 1]
        before = self._edges_of(p, q)
        exchanged = structure.exchange(p, q, self._certified.after)
        if exchanged is None:
            return False
        if self._fan:
            self.stats.fan += changes_of_exchange(structure, exchanged, q)
        after = self._edges_of(p, q)
        self.log.record("x-order", tuple(sorted(before - after)), tuple(sorted(after - before)))
        for side, changed in enumerate(exchanged.edges):
            for c in changed:
                self._certified.certify_edge(side, c)
        i = rank[q]
        for c in order[max(i - 1, 0) : i + 2]:
            self._certified.certify_order(c)
        return True

    def _sweep_columns(self) -> bool:
        """Put all points of one x that are in the wrong order into theirs; whether any could."""
        structure, certified = self.structure, self._certified
        order, found = structure.order, False
        for p in sorted(certified.due[POINT_ORDER], key=structure.rank.__getitem__):
            if p not in certified.due[POINT_ORDER]:
                continue  # of a column that has been swept
            i, end = column_around(self.certifier, structure, p)
            old = order[i:end]
            new = sorted(old, key=cmp_to_key(self._x_comparison))
            before, fan = self._edges_of(*old), self._fan_edges()
            changed = resweep(structure, new, certified.after)
            if changed is None:
                continue
            found = True
            after = self._edges_of(*new)
            self.log.record("x-order", tuple(sorted(before - after)), tuple(sorted(after - before)))
            self.stats.fan += len(fan ^ self._fan_edges())
            for side, edges in enumerate(changed):
                for c in sorted(edges):
                    certified.certify_edge(side, c)
            for c in order[max(i - 1, 0) : end]:
                certified.certify_order(c)
        return found

    def _edges_of(self, *points: int) -> set[tuple[int, int]]:
        """The edges from some points to the left."""
        return {
            edge_key(p, tree.parent[p])
            for tree in self.structure.trees
            for p in points
            if tree.parent[p] >= 0
        }

    def _rebuild(self) -> None:
        """Sweep anew, with the signs just after now; keep the certificates that stand."""
        self.stats.rebuilds += 1
        old = self.structure
        edges, fan = self._edges_of(*old.order), self._fan_edges()
        order = sorted(old.order, key=cmp_to_key(self._x_comparison))
        new = IncrementalStructure.sweep(order, self._certified.after)
        if self.chains.kind == "searchable":
            new.make_searchable()
        self._certified.replace(new)
        if any(self._certified.due):
            raise AuditError(f"violated after a sweep: {self._certified.due}")
        after = self._edges_of(*order)
        kind = "reflex" if order == old.order else "x-order"
        self.log.record(kind, tuple(sorted(edges - after)), tuple(sorted(after - edges)))
        self.stats.fan += len(fan ^ self._fan_edges())

    def _fan_edges(self) -> set[frozenset[int]]:
        """The edges of the fan triangulation, if its changes are counted."""
        return {frozenset(edge) for edge in fan_edges(self.structure)} if self._fan else set()

    def _x_comparison(self, p: int, q: int) -> int:
        return 0 if p == q else -1 if self._certified.after.left_of(p, q) else 1
