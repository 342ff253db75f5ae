"""The kinetic incremental pseudo-triangulation of moving points (paper, section 3.2).

A queue holds when each of the 3n - 5 certificates of `exactpt.tiling.incremental.structure`
fails. A failure moves one edge, or two at an exchange in the x-order, and takes at most
four new certificates of edges and three of the x-order.

**Events at one time** are processed one after the other, each judged by the signs just
after that time, until no certificate is violated. By the lemma there, the result is then
the structure of that moment, in whatever order it was reached. Exchanges come first, where
they are possible: what stands in a vertical line then has its trees as they were just
before. If nothing is possible, or more has happened than a sweep costs, the structure is
swept anew, with the signs just after that time too.
"""

from __future__ import annotations

from collections.abc import Sequence
from functools import cmp_to_key
from typing import Final, Literal, final

from exactpt.errors import AuditError, InputError
from exactpt.kernel.algebraic import AlgebraicNumber
from exactpt.kernel.numbers import QQ
from exactpt.kinetic.queue import EventTime
from exactpt.motion.body import Body
from exactpt.motion.vertices import Vertices
from exactpt.tiling.certificates import Certifier
from exactpt.tiling.events import ContactFound, Stats, TilingEvent
from exactpt.tiling.incremental.certified import KINDS, MOTION, ORDER, CertifiedStructure
from exactpt.tiling.incremental.contacts import coinciding
from exactpt.tiling.incremental.fan import changes_of_exchange, fan_edges
from exactpt.tiling.incremental.mesh import mesh_of
from exactpt.tiling.incremental.static import holds_at, sweep_at
from exactpt.tiling.incremental.structure import LOWER, UPPER, IncrementalStructure
from exactpt.tiling.instant import Instant
from exactpt.tiling.mesh import Mesh
from exactpt.tiling.tiling import Tiling

__all__ = ["IncrementalTiling"]

PATIENCE: Final = 8
"""Steps along chains for each event, and each point, before chains are made searchable."""


@final
class IncrementalTiling(Tiling):
    """The canonical tiling of points: at any time the one that the sweep builds."""

    name = "incremental"

    def __init__(
        self,
        vertices: Vertices,
        certifier: Certifier,
        structure: IncrementalStructure,
        *,
        chains: Literal["auto", "linked", "searchable"],
        fan: bool,
    ) -> None:
        super().__init__(vertices, certifier, Stats())
        self._chains: str = chains
        self._fan: bool = fan
        self._mesh: Mesh | None = None
        self._allowed: int = PATIENCE * len(vertices.all)
        self._certified = CertifiedStructure(structure, certifier, self.queue)
        if any(self._certified.due):
            raise AuditError(f"violated at the start: {self._certified.due}")
        self.stats.most = len(self.queue)
        for p in range(len(vertices.all)):
            self._schedule_piece(p)

    @classmethod
    def begin(
        cls,
        vertices: Vertices,
        start: QQ,
        end: QQ,
        *,
        exact_only: bool = False,
        chains: Literal["auto", "linked", "searchable"] = "auto",
        fan: bool = False,
    ) -> IncrementalTiling:
        """The tiling of points just after a time at which no two are in one place.

        Args:
            vertices: the points.
            start: the current time.
            end: the last time of interest.
            exact_only: decide everything by exact arithmetic.
            chains: "linked" walks along chains, "searchable" searches them in O(log n);
                "auto" walks until the steps of all walks exceed `PATIENCE` an event.
            fan: count the changes of the fan triangulation too, in ``stats.fan``.
        """
        structure = sweep_at(Instant(vertices, start, exact_only=exact_only))
        if chains == "searchable":
            structure.make_searchable()
        certifier = Certifier(vertices, start, end, exact_only=exact_only)
        return cls(vertices, certifier, structure, chains=chains, fan=fan)

    @classmethod
    def vertices_of(cls, bodies: Sequence[Body], start: QQ, end: QQ) -> Vertices:
        """One vertex a point.

        Raises:
            InputError: if a body is no point.
        """
        for body in bodies:
            if body.size > 1:
                raise InputError(
                    f"body {body.name!r}: has {body.size} vertices: "
                    "the incremental tiling is for points"
                )
        return Vertices.of(bodies, start, end, plain_points=True)

    @classmethod
    def mesh_at(cls, instant: Instant) -> Mesh:
        """The incremental tiling of an instant."""
        return mesh_of(sweep_at(instant))

    @property
    def structure(self) -> IncrementalStructure:
        """The tiling just after the current time, as trees."""
        return self._certified.now

    def mesh_after(self) -> Mesh:
        """The tiling just after the current time; made anew after every event."""
        if self._mesh is None:
            self._mesh = mesh_of(self.structure)
        return self._mesh

    def mesh_now(self, time: QQ) -> Mesh:
        """The tiling at a rational time: the current one, or one before the next event.

        Where certificates vanish at that very time, the tiling is the one that the sweep
        builds then.

        Raises:
            AuditError: if a certificate is violated at that time.
        """
        instant = Instant(self.vertices, time, after=False)
        structure = self.structure
        return mesh_of(structure if holds_at(structure, instant) else sweep_at(instant))

    def _schedule_piece(self, p: int) -> None:
        """Schedule the end of the current piece of a point's motion."""
        moving = self.vertices.bodies[p]
        slot = KINDS * p + MOTION
        if moving.until is None or moving.until > self.certifier.end:
            self.queue.cancel(slot)
            return
        low, high = self.vertices.frame.time(moving.until)
        time = EventTime(low, high, -1, -1, -1, AlgebraicNumber(moving.until))
        self.queue.schedule(slot, time)

    # Events

    def _process(self, time: EventTime, entries: list[tuple[int, EventTime]]) -> None:
        self.certifier.move_to(time, [(t.a, t.b, t.c) for _, t in entries])
        self._mesh = None
        slots = [slot for slot, _ in entries]
        level = [slot // KINDS for slot in slots if slot % KINDS == ORDER]
        if level and (touches := coinciding(self.certifier, self.structure, level)):
            raise ContactFound(touches)
        if len(slots) > 1:
            self.stats.batches += 1
        alone = len(slots) == 1 and time.crossing
        certified = self._certified
        for slot in slots:
            p, kind = divmod(slot, KINDS)
            if kind == MOTION:
                self._change_motion(p)
            elif alone:
                certified.due[kind].add(p)
            elif kind == ORDER:
                certified.certify_order(p)
            else:
                certified.certify_edge(kind, p)
        self._settle()
        self.stats.most = max(self.stats.most, len(self.queue))
        if self._chains == "auto":
            self._judge_chains()

    def _judge_chains(self) -> None:
        """Make chains searchable if they have turned out to be long."""
        self._allowed += PATIENCE
        upper, lower = self.structure.trees
        if upper.steps + lower.steps > self._allowed:
            self._chains = "searchable"
            self.structure.make_searchable()

    def _change_motion(self, p: int) -> None:
        moving = self.vertices.bodies[p]
        if moving.until is None:
            raise AuditError(f"body {p} has no next piece")
        self.vertices.enter_piece(p, moving.until)
        self._schedule_piece(p)
        self._record("motion", (), ())
        self._certified.certify_point(p)

    def _settle(self) -> None:
        """Repair until nothing is violated just after now."""
        upper, lower, order = self._certified.due
        most = 16 + len(self.structure.order) // 4
        rounds = 0
        while upper or lower or order:
            rounds += 1
            if rounds > most:
                self._rebuild()
            elif any(self._exchange(p) for p in sorted(order)):
                continue
            elif upper:
                self._repair(UPPER, min(upper))
            elif lower:
                self._repair(LOWER, min(lower))
            else:
                self._rebuild()

    def _repair(self, side: int, b: int) -> None:
        """Move the edge whose certificate, that of b, is violated."""
        structure = self.structure
        kind = self._kind(side, b)
        p, old, new, changed = structure.repair(side, b)
        there = structure.trees[1 - side].parent[p]
        removed = () if there == old else (_edge(p, old),)
        added = () if there == new else (_edge(p, new),)
        self._record(kind, removed, added)
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
        self._record("x-order", tuple(sorted(before - after)), tuple(sorted(after - before)))
        for side, changed in enumerate(exchanged.edges):
            for c in changed:
                self._certified.certify_edge(side, c)
        i = rank[q]
        for c in order[max(i - 1, 0) : i + 2]:
            self._certified.certify_order(c)
        return True

    def _edges_of(self, *points: int) -> set[tuple[int, int]]:
        """The edges from some points to the left."""
        return {
            _edge(p, tree.parent[p])
            for tree in self.structure.trees
            for p in points
            if tree.parent[p] >= 0
        }

    def _record(
        self,
        kind: str,
        removed: tuple[tuple[int, int], ...],
        added: tuple[tuple[int, int], ...],
    ) -> None:
        self.stats.count(kind)
        self._events.append(TilingEvent(self.certifier.now, kind, removed, added))

    def _rebuild(self) -> None:
        """Sweep anew, with the signs just after now; keep the certificates that stand."""
        self.stats.rebuilds += 1
        old = self.structure
        edges, fan = self._edges_of(*old.order), self._fan_edges()
        order = sorted(old.order, key=cmp_to_key(self._x_comparison))
        new = IncrementalStructure.sweep(order, self._certified.after)
        if self._chains == "searchable":
            new.make_searchable()
        self._certified.replace(new)
        if any(self._certified.due):
            raise AuditError(f"violated after a sweep: {self._certified.due}")
        after = self._edges_of(*order)
        kind = "reflex" if order == old.order else "x-order"
        self._record(kind, tuple(sorted(edges - after)), tuple(sorted(after - edges)))
        self.stats.fan += len(fan ^ self._fan_edges())

    def _fan_edges(self) -> set[frozenset[int]]:
        """The edges of the fan triangulation, if its changes are counted."""
        return {frozenset(edge) for edge in fan_edges(self.structure)} if self._fan else set()

    def _x_comparison(self, p: int, q: int) -> int:
        return 0 if p == q else -1 if self._certified.after.left_of(p, q) else 1


def _edge(u: int, v: int) -> tuple[int, int]:
    return (u, v) if u < v else (v, u)
