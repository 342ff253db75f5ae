"""Insertion and removal of bodies: the tiling changes only in the faces that they intersect.

The faces that a new body intersects, or the faces at the vertices of a removed one, are merged
into a region that is tiled again (`exactpt.pseudotriangulation.region`). Only new angles are
certified; the flips that make a canonical tiling canonical again start from these tiles, as
after any repair.
"""

from __future__ import annotations

from collections.abc import Iterable

from exactpt.errors import AuditError
from exactpt.indices import NO_HALF_EDGE, Ends
from exactpt.motion.vertices import Vertices
from exactpt.pseudotriangulation.conflict_zone import ConflictZone
from exactpt.pseudotriangulation.inside import tile_inside
from exactpt.pseudotriangulation.region import Region
from exactpt.tiling.angles import CertifiedMesh
from exactpt.tiling.events import Log
from exactpt.tiling.rules import Rules


def add_ring(certified: CertifiedMesh, rules: Rules, log: Log, i: int, zone: ConflictZone) -> bool:
    """Insert the ring of a new body into a tiling, and certify the new angles.

    Args:
        certified: the tiling; its moving vertices include those of the body.
        rules: the rules of the tiling.
        log: the record of events.
        i: the number of the body.
        zone: its conflict zone.

    Returns:
        Whether the region could be tiled; otherwise the tiling must be rebuilt.
    """
    moving = certified.vertices.bodies[i]
    region = rules.region_of_insertion(zone)
    if region is None:
        return False
    region.add_ring(certified.vertices, moving)
    if not _retile(certified, log, region):
        return False
    if moving.is_tiled:
        tile_inside(certified.mesh, certified.mesh.ring_edge[moving.ring[0]], certified.after())
        certified.recertify(certified.ring_angles(i))
    rules.enter(i)
    return True


def remove_ring(certified: CertifiedMesh, rules: Rules, log: Log, i: int) -> bool:
    """Remove the ring of a body, and certify the new angles; returns as `add_ring`."""
    ring = certified.vertices.bodies[i].ring
    region = rules.region_of_removal(i)
    if region is None:
        return False
    for v in ring:
        certified.mesh.ring_edge[v] = NO_HALF_EDGE
    if not _retile(certified, log, region):
        return False
    rules.leave(i)
    return True


def _retile(certified: CertifiedMesh, log: Log, region: Region) -> bool:
    """Tile a region, and certify its new angles; returns as `add_ring`."""
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
    vertices: Vertices, edges: Iterable[Ends]
) -> dict[frozenset[tuple[int, int]], Ends]:
    """Return edges by their ends in the scene, one for all its infinitesimal copies.

    Edges between copies of one vertex are left out.
    """
    v = vertices.all
    keys = {frozenset((v[i].body, v[i].index) for i in edge): edge for edge in edges}
    return {key: edge for key, edge in keys.items() if len(key) == 2}
