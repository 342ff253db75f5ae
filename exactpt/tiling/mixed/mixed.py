"""The kinetic mixed pseudo-triangulation of simple polygons (paper, section 5).

F1, the relative hulls of the polygons, is tiled by their geodesics, which are represented
by labels; F2, the rest of free space, is tiled greedily. Repairs are those of any
pseudo-triangulation; the labels (`exactpt.tiling.mixed.labels`) determine which edge is
replaced. The border between F1 and F2 needs no rule of its own: an edge that loses its last
label is a diagonal of F2 from then on, and one that gets a label no longer is. When a body is
added or removed, geodesics that change are recomputed (`exactpt.tiling.mixed.labelled_region`).

A hole is a ring as an outline is: the body is on the left of its half-edges, and the geodesics
along it lead through the free space in the hole. Its unpinned cycle is the shortest loop around
all that is in the hole; faces between the ring and this loop belong to F1 as well. Loops of
different rings do not cross, since the rings do not: so a half-edge has labels of one ring, in the
holes too, and the repairs, which are local, are those of outlines. Where nothing is in a hole, the
loops of `ROOT` and `TOP` are points, without an edge, and remain so: geodesics keep their homotopy
class. (Those of the two halves of the ring are then one path, in opposite directions.)
"""

from __future__ import annotations

from typing import cast, final

from exactpt.certificates.at_time import PredicatesAt
from exactpt.motion.vertices import Vertices
from exactpt.pseudotriangulation.conflict_zone import ConflictZone
from exactpt.pseudotriangulation.mesh import Mesh
from exactpt.pseudotriangulation.region import Region
from exactpt.tiling.greedy.flipping import FlippingRules
from exactpt.tiling.mixed.forest import Forest
from exactpt.tiling.mixed.labelled_region import region_of_insertion, region_of_removal
from exactpt.tiling.mixed.labels import LabelledMesh
from exactpt.tiling.mixed.static import mixed_mesh


@final
class MixedRules(FlippingRules):
    """The mixed tiling: O(kappa log n) certificates of rigid polygons, holes included."""

    @property
    def _labelled(self) -> LabelledMesh:
        return cast(LabelledMesh, self.certified.mesh)

    @staticmethod
    def build(instant: PredicatesAt) -> Mesh:
        """Return the mixed tiling of an instant."""
        return mixed_mesh(instant)

    def empty_mesh(self, vertices: Vertices) -> Mesh:
        """See `Rules.empty_mesh`."""
        return LabelledMesh(0, Forest(vertices))

    def region_of_insertion(self, zone: ConflictZone) -> Region | None:
        """See `Rules.region_of_insertion`."""
        return region_of_insertion(self._labelled, zone.faces)

    def region_of_removal(self, i: int) -> Region | None:
        """See `Rules.region_of_removal`."""
        return region_of_removal(self._labelled, i, self.certified.edges_at(i))

    def leave(self, i: int) -> None:
        """See `Rules.leave`."""
        self._labelled.forest.remove(i)
