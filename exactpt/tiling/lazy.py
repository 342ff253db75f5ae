"""Any pointed pseudo-triangulation: the fewest events, for those who only want the contact."""

from __future__ import annotations

from typing import final

from exactpt.certificates.at_time import PredicatesAt
from exactpt.pseudotriangulation.build import build_mesh
from exactpt.pseudotriangulation.mesh import Mesh
from exactpt.pseudotriangulation.plane_sweep import sweep_diagonals
from exactpt.pseudotriangulation.pointed import make_pointed
from exactpt.tiling.greedy.greedy import greedy_mesh
from exactpt.tiling.greedy.vertical import VerticalDecomposition
from exactpt.tiling.rules import Rules

__all__ = ["LazyRules"]


@final
class LazyRules(Rules):
    """Starts greedy and repairs corners and bends alone."""

    @staticmethod
    def build(instant: PredicatesAt) -> Mesh:
        """A tiling of an instant: of convex bodies by rotation, else by a plane sweep."""
        if instant.all_stay_convex():
            return greedy_mesh(instant, VerticalDecomposition.at(instant))[0]
        mesh = build_mesh(instant, sweep_diagonals(instant))
        make_pointed(mesh, instant)
        return mesh
