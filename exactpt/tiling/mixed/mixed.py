"""The kinetic mixed pseudo-triangulation of simple polygons (paper, section 5).

F1, the relative hulls of the polygons, is tiled by their geodesics, told by labels; F2,
the rest of free space, is tiled greedily. The repairs are those of any pseudo-triangulation
and the rules for labels (`exactpt.tiling.mixed.labels`) say which edge gives way. So the
border between F1 and F2 moves by itself: an edge that loses its last label is a diagonal
of F2 from then on, and one that gets a label is none any more.
"""

from __future__ import annotations

from typing import final

from exactpt.tiling.greedy.flipping import FlippingTiling
from exactpt.tiling.instant import Instant
from exactpt.tiling.mesh import Mesh
from exactpt.tiling.mixed.static import mixed_mesh

__all__ = ["MixedTiling"]


@final
class MixedTiling(FlippingTiling):
    """The mixed tiling: O(kappa log n) certificates of rigid polygons."""

    name = "mixed"

    @property
    def can_change_bodies(self) -> bool:
        """Not here: the geodesics around all other bodies may change."""
        return False

    @classmethod
    def mesh_at(cls, instant: Instant) -> Mesh:
        """The mixed tiling of an instant."""
        return mixed_mesh(instant)
