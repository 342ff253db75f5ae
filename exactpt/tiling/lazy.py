"""The lazy tiling: a pointed pseudo-triangulation, not canonical, with the fewest events."""

from __future__ import annotations

from typing import ClassVar, final

from exactpt.certificates.at_time import PredicatesAt
from exactpt.certificates.convex_bodies import all_stay_convex
from exactpt.pseudotriangulation.build import build_mesh
from exactpt.pseudotriangulation.mesh import Mesh
from exactpt.pseudotriangulation.plane_sweep import sweep_diagonals
from exactpt.pseudotriangulation.pointed import make_pointed
from exactpt.tiling.greedy.greedy import greedy_mesh
from exactpt.tiling.greedy.vertical import VerticalDecomposition
from exactpt.tiling.rules import Rules


@final
class LazyRules(Rules):
    """The rules of a tiling that only repairs violated angles and never flips."""

    slides_are_plain: ClassVar[bool] = True
    only_angles: ClassVar[bool] = True

    @staticmethod
    def build(instant: PredicatesAt) -> Mesh:
        """Return a tiling of an instant: greedy for convex bodies, else by a plane sweep."""
        if all_stay_convex(instant):
            return greedy_mesh(instant, VerticalDecomposition.at(instant))[0]
        mesh = build_mesh(instant, sweep_diagonals(instant))
        make_pointed(mesh, instant)
        return mesh
