"""Bodies that come and go: the tiling changes in the faces that they touch.

A body that comes is put into the faces that it meets; one that goes leaves a hole, the
faces that it has touched. Either is a region that is tiled anew
(`exactpt.pseudotriangulation.region`). Only angles that are new are certified; what the canonical
tilings need besides, flips and their certificates, spreads from there as after any other repair.
"""

from __future__ import annotations

from collections.abc import Iterable

from exactpt.errors import AuditError
from exactpt.motion.vertices import Vertices
from exactpt.planar.halfedge import NOTHING
from exactpt.pseudotriangulation.conflict_zone import ConflictZone
from exactpt.pseudotriangulation.inside import tile_inside
from exactpt.pseudotriangulation.region import Region
from exactpt.tiling.angles import CertifiedMesh
from exactpt.tiling.events import Log

__all__ = ["add_ring", "remove_ring"]


def add_ring(certified: CertifiedMesh, log: Log, i: int, zone: ConflictZone) -> bool:
    """Put a new body into a tiling, and certify what is new; whether that was possible.

    Args:
        certified: the tiling; it has the moving vertices of the body.
        log: what is told.
        i: the number of the body.
        zone: where it lies.
    """
    moving = certified.vertices.bodies[i]
    region = certified.rules.region_met(zone)
    region.add_ring(certified.vertices, moving)
    if not _retile(certified, log, region):
        return False
    if moving.is_tiled:
        tile_inside(certified.mesh, certified.mesh.ring_edge[moving.ring[0]], certified.after())
        certified.recertify(certified.ring_angles(i))
    certified.rules.enter(i)
    return True


def remove_ring(certified: CertifiedMesh, log: Log, i: int) -> bool:
    """Take a body out of a tiling, and certify what is new; whether that was possible."""
    ring = certified.vertices.bodies[i].ring
    region = certified.rules.region_left(i)
    for v in ring:
        certified.mesh.ring_edge[v] = NOTHING
    if not _retile(certified, log, region):
        return False
    certified.rules.leave(i)
    return True


def _retile(certified: CertifiedMesh, log: Log, region: Region) -> bool:
    """Tile a region, and certify its new angles; whether that was possible."""
    try:
        retiled = region.tile(certified.after())
    except AuditError:
        return False
    for h in (*region.gone, *retiled.handles):
        certified.cancel_edge(h)
    removed = _by_scene_edge(certified.vertices, retiled.removed)
    added = _by_scene_edge(certified.vertices, retiled.added)
    log.record(
        "motion",
        tuple(sorted(edge for key, edge in removed.items() if key not in added)),
        tuple(sorted(edge for key, edge in added.items() if key not in removed)),
    )
    certified.recertify(retiled.angles)
    return True


def _by_scene_edge(
    vertices: Vertices, edges: Iterable[tuple[int, int]]
) -> dict[frozenset[tuple[int, int]], tuple[int, int]]:
    """Edges between different vertices of the scene, one for all of their copies."""
    v = vertices.all
    keys = {frozenset((v[i].body, v[i].index) for i in edge): edge for edge in edges}
    return {key: edge for key, edge in keys.items() if len(key) == 2}
