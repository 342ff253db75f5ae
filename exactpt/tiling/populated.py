"""Bodies that come and go: the tiling changes in the faces that they touch.

A body that comes is put into the faces that it meets; one that goes leaves a hole, the
faces that it has touched. Either is a region that is tiled anew
(`exactpt.pseudotriangulation.region`). Only angles that are new are certified; what the canonical
tilings need besides, flips and their certificates, spreads from there as after any other repair.
"""

from __future__ import annotations

from collections.abc import Iterable

from exactpt.certificates.certificate import MOTION, SHRINK, pack
from exactpt.certificates.one_sided import OneSided
from exactpt.errors import AuditError
from exactpt.kernel.numbers import QQ
from exactpt.motion.body import Body
from exactpt.planar.halfedge import NOTHING
from exactpt.pseudotriangulation.conflict_zone import ConflictZone
from exactpt.pseudotriangulation.inside import tile_inside
from exactpt.pseudotriangulation.region import Region
from exactpt.tiling.events import TilingEvent
from exactpt.tiling.kinetic import KineticTiling
from exactpt.tiling.repairs import RebuildNeeded

__all__ = ["PopulatedTiling"]


class PopulatedTiling(KineticTiling):
    """A tiling to which bodies can be added, and from which they can be removed."""

    def takes(self, body: Body, t: QQ) -> bool:  # noqa: ARG002 - kinds of tilings do
        """Whether a body can be added at a time without building another tiling."""
        return True

    def add_body(self, body: Body, t: QQ, site: ConflictZone) -> list[TilingEvent]:
        """Add a body as the last one; work for the faces that it meets.

        Args:
            body: apart from all others now.
            t: now.
            site: where it lies.

        Returns:
            What changes at once.
        """
        self._pause(t)
        i = self.vertices.add(body, t)
        moving = self.vertices.bodies[i]
        self._schedule_piece(i)
        region = self._region_met(site)
        region.add_ring(self.vertices, moving)
        is_whole = self._retile(region)
        if is_whole:
            if moving.is_tiled:
                first = self.mesh.ring_edge[moving.ring[0]]
                tile_inside(self.mesh, first, OneSided(self.certifier, before=False))
                self._recertify(self._ring_angles(moving.ring))
            self._enter_body(i)
        return self._resume(is_whole=is_whole)

    def remove_body(self, i: int, t: QQ) -> list[TilingEvent]:
        """Remove a body; work for the faces that it touches. The last body gets its number.

        Args:
            i: the number of the body.
            t: now.

        Returns:
            What changes at once; the ids of the body may stand in it.
        """
        self._pause(t)
        ring = self.vertices.bodies[i].ring
        region = self._region_left(i)
        for v in ring:
            self.mesh.ring_edge[v] = NOTHING
        is_whole = self._retile(region)
        if is_whole:
            self._leave_body(i)
        last = len(self.vertices.bodies) - 1
        for kind in (MOTION, SHRINK):
            self._move_slot(pack(kind, last), pack(kind, i))
        self.vertices.remove(i)
        return self._resume(is_whole=is_whole)

    def _pause(self, t: QQ) -> None:
        """Let a rational time be now; nothing is violated then."""
        self._move_to(t)
        self._due.clear()
        self._batch.clear()
        self._careful = True

    def _resume(self, *, is_whole: bool) -> list[TilingEvent]:
        """Repair what is violated; or build the tiling anew if it is not whole."""
        try:
            if not is_whole:
                raise RebuildNeeded
            self._settle()
            self._check_batch(sorted(self._batch.touched))
        except RebuildNeeded:
            self._rebuild()
        self._careful = False
        self.stats.most = max(self.stats.most, len(self.queue))
        return self._reported()

    def _region_met(self, site: ConflictZone) -> Region:
        """What is tiled anew when a body comes: the faces that it meets."""
        return Region(self.mesh, site.faces, site.crossed)

    def _region_left(self, i: int) -> Region:
        """What is tiled anew when a body goes: the faces that it has touched."""
        gone = self._edges_at(i)
        return Region(self.mesh, [g for h in gone for g in (h, h ^ 1)], gone)

    def _edges_at(self, i: int) -> list[int]:
        """The edges at the vertices of a body."""
        angles = self._ring_angles(self.vertices.bodies[i].ring)
        return list(dict.fromkeys(min(h, h ^ 1) for h in angles))

    def _ring_angles(self, ring: Iterable[int]) -> list[int]:
        """The half-edges out of the vertices of a ring."""
        return [h for v in ring for h in self.mesh.map.fan(self.mesh.ring_edge[v])]

    def _retile(self, region: Region) -> bool:
        """Tile a region, and certify its new angles; whether that was possible."""
        try:
            retiled = region.tile(OneSided(self.certifier, before=False))
        except AuditError:
            return False
        for h in (*region.gone, *retiled.handles):
            self._cancel_edge(h)
        removed, added = self._by_scene_edge(retiled.removed), self._by_scene_edge(retiled.added)
        self._record(
            "motion",
            tuple(sorted(edge for key, edge in removed.items() if key not in added)),
            tuple(sorted(edge for key, edge in added.items() if key not in removed)),
        )
        self._recertify(retiled.angles)
        return True

    def _by_scene_edge(
        self, edges: Iterable[tuple[int, int]]
    ) -> dict[frozenset[tuple[int, int]], tuple[int, int]]:
        """Edges between different vertices of the scene, one for all of their copies."""
        v = self.vertices.all
        keys = {frozenset((v[i].body, v[i].index) for i in edge): edge for edge in edges}
        return {key: edge for key, edge in keys.items() if len(key) == 2}

    def _enter_body(self, i: int) -> None:
        """Certify what is none of the angles of a new body."""

    def _leave_body(self, i: int) -> None:
        """Forget what is none of the angles of a body, and let the last one have its number."""

    def _move_slot(self, old: int, new: int) -> None:
        """Forget what is pending in a slot; it gets what another one has."""
        time = self.queue.pending(old)
        self.queue.cancel(old)
        self.queue.cancel(new)
        if time is not None and old != new:
            self.queue.schedule(new, time)
