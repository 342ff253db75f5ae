"""The kinetic mixed pseudo-triangulation of simple polygons (paper, section 5).

F1, the relative hulls of the polygons, is tiled by their geodesics, told by labels; F2,
the rest of free space, is tiled greedily. The repairs are those of any pseudo-triangulation
and the rules for labels (`exactpt.tiling.mixed.labels`) say which edge gives way. So the
border between F1 and F2 moves by itself: an edge that loses its last label is a diagonal
of F2 from then on, and one that gets a label is none any more. When a body comes or goes,
the geodesics that change are looked for anew (`exactpt.tiling.mixed.region`).
"""

from __future__ import annotations

from typing import cast, final

from exactpt.certificates.at_time import PredicatesAt
from exactpt.motion.vertices import Vertices
from exactpt.pseudotriangulation.conflict_zone import ConflictZone
from exactpt.pseudotriangulation.mesh import Mesh
from exactpt.pseudotriangulation.region import Region
from exactpt.tiling.greedy.flipping import FlippingRules
from exactpt.tiling.mixed.labels import Forest, LabelledMesh
from exactpt.tiling.mixed.region import region_left, region_met
from exactpt.tiling.mixed.static import mixed_mesh

__all__ = ["MixedRules"]


@final
class MixedRules(FlippingRules):
    """The mixed tiling: O(kappa log n) certificates of rigid polygons."""

    @property
    def _labelled(self) -> LabelledMesh:
        return cast(LabelledMesh, self.certified.mesh)

    @staticmethod
    def build(instant: PredicatesAt) -> Mesh:
        """The mixed tiling of an instant."""
        return mixed_mesh(instant)

    def empty_mesh(self, vertices: Vertices) -> Mesh:
        """See `Rules.empty_mesh`."""
        return LabelledMesh(0, Forest(vertices))

    def region_met(self, zone: ConflictZone) -> Region:
        """See `Rules.region_met`."""
        return region_met(self._labelled, zone.faces)

    def region_left(self, i: int) -> Region:
        """See `Rules.region_left`."""
        return region_left(self._labelled, i, self.certified.edges_at(i))

    def leave(self, i: int) -> None:
        """See `Rules.leave`."""
        self._labelled.forest.remove(i)
