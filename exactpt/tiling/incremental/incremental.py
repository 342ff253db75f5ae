"""The kinetic incremental pseudo-triangulation of moving points (paper, section 3.2).

A queue holds when each of the 3n - 5 certificates of `exactpt.tiling.incremental.structure`
fails. A failure moves one edge, or two at an exchange in the x-order, and takes at most
seven new certificates.

**Contacts** are found by the x-order alone. Two points that coincide at a time have equal x
then, and so has every point between them in the order just before. So each pair of
neighbours from the one to the other either has equal x for ever, or a certificate that
vanishes at that time. (A zero without change of sign is scheduled too.) Where such pairs
form a run, its points of equal y are in contact.

**Events at one time** are processed one after the other, each judged by the signs just
after that time, edges before exchanges, until no certificate is violated. By the lemma
there, the result is then the structure of that moment, in whatever order it was reached.
If an event is not possible or there is no end of them, the structure is swept anew, with
the signs just after that time too.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from functools import cmp_to_key
from itertools import groupby, pairwise
from typing import Final, final

from exactpt.errors import AuditError, InputError
from exactpt.kernel.algebraic import AlgebraicNumber
from exactpt.kernel.numbers import QQ
from exactpt.kinetic.queue import EventTime
from exactpt.motion.body import Body
from exactpt.motion.incidence import Touch, difference
from exactpt.motion.vertices import Vertices
from exactpt.tiling.events import ContactFound, TilingEvent
from exactpt.tiling.incremental.mesh import mesh_of
from exactpt.tiling.incremental.structure import LOWER, UPPER, IncrementalStructure
from exactpt.tiling.instant import Instant
from exactpt.tiling.mesh import Mesh
from exactpt.tiling.moment import Moment
from exactpt.tiling.placement import coordinate_order
from exactpt.tiling.tiling import Tiling

__all__ = ["IncrementalTiling", "sweep_at"]

ORDER: Final = 2
MOTION: Final = 3
KINDS: Final = 4
"""A slot of the queue is ``KINDS * point + kind``.

Kinds `UPPER` and `LOWER` are the edges on which the point hangs, `ORDER` is the point and
the next one in x-order, `MOTION` the end of its piece of motion.
"""


@final
class IncrementalTiling(Tiling):
    """The canonical tiling of points: at any time the one that the sweep builds.

    Attributes:
        structure: the tiling just after the current time.
    """

    name = "incremental"
    structure: IncrementalStructure

    def __init__(self, vertices: Vertices, start: QQ, end: QQ, *, exact_only: bool = False) -> None:
        super().__init__(vertices, start, end, exact_only=exact_only)
        self._after = Moment(self.certifier, before=False)
        self._due: tuple[set[int], set[int], set[int]] = (set(), set(), set())
        instant = Instant(vertices, start, exact_only=exact_only)
        self.structure = sweep_at(instant)
        self._certify_everything()
        if any(self._due):
            raise AuditError(f"violated at the start: {self._due}")
        for p in range(len(vertices.all)):
            self._schedule_piece(p)

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
        return Vertices(bodies, start, end, plain_points=True)

    @classmethod
    def mesh_at(cls, instant: Instant) -> Mesh:
        """The incremental tiling of an instant."""
        return mesh_of(sweep_at(instant))

    @property
    def mesh(self) -> Mesh:
        """The tiling just after the current time."""
        return mesh_of(self.structure)

    def mesh_now(self, time: QQ) -> Mesh:
        """The tiling at a rational time: the current one, or one before the next event.

        Where certificates vanish at that very time, the tiling is the one that the sweep
        builds then.

        Raises:
            AuditError: if a certificate is violated at that time.
        """
        instant = Instant(self.vertices, time, after=False)
        return mesh_of(self.structure if self._holds_at(instant) else sweep_at(instant))

    def _holds_at(self, instant: Instant) -> bool:
        """Whether all certificates hold, and none just so."""
        structure = self.structure
        holds = True
        for p, q in pairwise(structure.order):
            if not instant.left_of(p, q):
                if instant.positions[p][0] != instant.positions[q][0]:
                    raise AuditError(f"points {p} and {q} are in the wrong order")
                holds = False
        for side, wanted in ((UPPER, 1), (LOWER, -1)):
            for b in structure.order:
                certificate = structure.certificate(side, b)
                if certificate is not None:
                    *points, bends = certificate
                    s = instant.sign(*points)
                    if (s == wanted) != bends:
                        if s:
                            raise AuditError(f"points {points} bend the wrong way")
                        holds = False
        return holds

    # Certificates

    def _certify_everything(self) -> None:
        for slot in self.queue.slots():
            if slot % KINDS != MOTION:
                self.queue.cancel(slot)
        for p in range(len(self.structure.order)):
            self._certify_edge(UPPER, p)
            self._certify_edge(LOWER, p)
            self._certify_order(p)
        self._note_pending()

    def _note_pending(self) -> None:
        self.stats.most = max(self.stats.most, len(self.queue))

    def _certify_edge(self, side: int, b: int) -> None:
        """Certify the edge on which b hangs; note it as due if it is violated just after now."""
        slot = KINDS * b + side
        self._due[side].discard(b)
        certificate = self.structure.certificate(side, b)
        if certificate is None:
            self.queue.cancel(slot)
            return
        lo, mid, hi, bends = certificate
        certifier = self.certifier
        if certifier.rigid(lo, mid, hi):
            certifier.skipped += 1
            s, time = self._after.sign(lo, mid, hi), None
        else:
            s, time = certifier.orientation(lo, mid, hi)
        if (s == (1 if side == UPPER else -1)) != bends:
            self.queue.cancel(slot)
            self._due[side].add(b)
        elif time is None:
            self.queue.cancel(slot)
        else:
            self.queue.schedule(slot, time)

    def _certify_order(self, p: int) -> None:
        """Certify that p is left of the next point; note it as due if it is not just after now."""
        slot = KINDS * p + ORDER
        self._due[ORDER].discard(p)
        structure = self.structure
        i = structure.rank[p] + 1
        if i == len(structure.order):
            self.queue.cancel(slot)
            return
        q = structure.order[i]
        certifier = self.certifier
        time = None
        if certifier.keeps_x_order(p, q):
            certifier.skipped += 1
            right = self._after.left_of(p, q)
        else:
            s, time = certifier.x_order(p, q, touching=True)
            right = s > 0
        if not right:
            self._due[ORDER].add(p)
            time = None
        if time is None:
            self.queue.cancel(slot)
        else:
            self.queue.schedule(slot, time)

    def _certify_point(self, p: int) -> None:
        """Certify anew whatever depends on the motion of a point."""
        structure = self.structure
        i = structure.rank[p]
        for q in structure.order[max(i - 1, 0) : i + 1]:
            self._certify_order(q)
        for side in (UPPER, LOWER):
            tree = structure.trees[side]
            edges = {p, tree.before[p]}
            c = tree.first[p]
            while c >= 0:
                edges |= {c, tree.last[c]}
                c = tree.after[c]
            for b in sorted(edges):
                if b >= 0:
                    self._certify_edge(side, b)

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
        self.stats.batches += len(entries) > 1
        slots = [slot for slot, _ in entries]
        level = [slot // KINDS for slot in slots if slot % KINDS == ORDER]
        if level:
            self._report_touches(level)
        for slot in slots:
            p, kind = divmod(slot, KINDS)
            if kind == MOTION:
                self._change_motion(p)
            elif kind == ORDER:
                self._certify_order(p)
            else:
                self._certify_edge(kind, p)
        self._settle()
        self._note_pending()

    def _change_motion(self, p: int) -> None:
        moving = self.vertices.bodies[p]
        if moving.until is None:
            raise AuditError(f"body {p} has no next piece")
        self.vertices.enter_piece(p, moving.until)
        self._schedule_piece(p)
        self._record("motion", (), ())
        self._certify_point(p)

    def _settle(self) -> None:
        """Repair until nothing is violated just after now."""
        upper, lower, order = self._due
        rounds = 0
        while upper or lower or order:
            rounds += 1
            if rounds > 64 + 4 * len(self.structure.order):
                self._rebuild()
            elif upper:
                self._repair(UPPER, min(upper))
            elif lower:
                self._repair(LOWER, min(lower))
            elif not self._exchange(min(order)):
                self._rebuild()

    def _repair(self, side: int, b: int) -> None:
        """Move the edge whose certificate, that of b, is violated."""
        structure = self.structure
        kind = self._kind(side, b)
        p, old, new, changed = structure.repair(side, b)
        there = structure.trees[1 - side].parent[p]
        self._record(
            kind,
            () if there == old else ((p, old),),
            () if there == new else ((p, new),),
        )
        for c in changed:
            self._certify_edge(side, c)

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
        exchanged = structure.exchange(p, q, self._after)
        if exchanged is None:
            return False
        after = self._edges_of(p, q)
        self._record("x-order", tuple(sorted(before - after)), tuple(sorted(after - before)))
        for side, changed in enumerate(exchanged.edges):
            for c in changed:
                self._certify_edge(side, c)
        i = rank[q]
        for c in order[max(i - 1, 0) : i + 2]:
            self._certify_order(c)
        return True

    def _edges_of(self, *points: int) -> set[tuple[int, int]]:
        """The edges from some points to the left."""
        return {
            (p, tree.parent[p]) if p > tree.parent[p] else (tree.parent[p], p)
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
        """Sweep anew, with the signs just after now."""
        self.stats.rebuilds += 1
        before = self._edges_of(*self.structure.order)
        order = sorted(self.structure.order, key=cmp_to_key(self._x_comparison))
        kind = "reflex" if order == self.structure.order else "x-order"
        self.structure = IncrementalStructure.sweep(order, self._after)
        for due in self._due:
            due.clear()
        self._certify_everything()
        if any(self._due):
            raise AuditError(f"violated after a sweep: {self._due}")
        after = self._edges_of(*self.structure.order)
        self._record(kind, tuple(sorted(before - after)), tuple(sorted(after - before)))

    def _x_comparison(self, p: int, q: int) -> int:
        return 0 if p == q else -1 if self._after.left_of(p, q) else 1

    # Contacts

    def _report_touches(self, level: Iterable[int]) -> None:
        """Report the contacts of points that are level with the next one in x-order now.

        Raises:
            ContactFound: if there are any.
        """
        order, rank = self.structure.order, self.structure.rank
        found: list[Touch] = []
        done = -1
        for i in sorted(rank[p] for p in level):
            if i < done:
                continue
            low, high = i, i + 1
            while low > 0 and self._is_level(order[low - 1], order[low]):
                low -= 1
            while high + 1 < len(order) and self._is_level(order[high], order[high + 1]):
                high += 1
            done = high
            run = order[low : high + 1]

            height = cmp_to_key(self._height_order)
            for _, equal in groupby(sorted(run, key=height), key=height):
                group = sorted(equal)
                found += [Touch(p, 0, q, -1, 0) for j, q in enumerate(group) for p in group[:j]]
        if found:
            raise ContactFound(sorted(found))

    def _height_order(self, p: int, q: int) -> int:
        """The sign of y(p) - y(q) now."""
        vertices = self.vertices.all
        return coordinate_order(self.certifier, vertices[q], vertices[p], 1)

    def _is_level(self, p: int, q: int) -> bool:
        """Whether two neighbours in x-order have equal x now, or for ever."""
        if self.certifier.vanishes_now(p, q, -1):
            return True
        a, b = self.vertices.all[p], self.vertices.all[q]
        if not (a.image.ws or b.image.ws) and a.image.xs != b.image.xs:
            return False
        return not difference(a.track.x, a.track.w, b.track.x, b.track.w)


def sweep_at(instant: Instant) -> IncrementalStructure:
    """The incremental pseudo-triangulation of an instant: O(n log n)."""
    order = instant.sorted_by_x(list(range(len(instant.vertices.all))))
    return IncrementalStructure.sweep(order, instant)
