"""The repairs of one time: which half-edges each of them has changed, and whether they meet."""

from __future__ import annotations

from typing import final

from exactpt.pseudotriangulation.mesh import Mesh

__all__ = ["Batch"]


@final
class Batch:
    """What has been repaired at the current time.

    Repairs that change different tiles cannot tell whether they happen at one time or one
    after the other, as in the perturbed scene (`exactpt.certificates.perturbation`): each is right
    by itself, and nothing has to be checked. A later repair of a tile that an earlier one has
    changed leaves marks of both on one face, or on one half-edge, or removes one with a
    mark of the other.

    Attributes:
        touched: of the half-edges whose angles have changed, the repair that did so first.
        has_new_motions: whether bodies have changed their motions at this time. What was so
            just before it can then not be told any more, and any repair has to be checked.
    """

    def __init__(self) -> None:
        self.touched: dict[int, int] = {}
        self.has_new_motions: bool = False
        self._is_tangled: bool = False
        self._repair: int = 0

    def clear(self) -> None:
        """A new time."""
        self.touched.clear()
        self.has_new_motions = self._is_tangled = False
        self._repair = 0

    def begin_repair(self) -> None:
        """What is touched from now on is by another repair."""
        self._repair += 1

    def touch(self, half_edges: list[int]) -> None:
        """Note that the angles of these have changed."""
        for h in half_edges:
            if self.touched.setdefault(h, self._repair) != self._repair:
                self._is_tangled = True

    def doubt(self, half_edges: list[int]) -> None:
        """Note that the tiles of these have to be checked, whatever else is repaired."""
        self.touch(half_edges)
        self._is_tangled = True

    def needs_check(self, mesh: Mesh) -> bool:
        """Whether a repair may not be right by itself."""
        if self.has_new_motions and self._repair > 0:
            return True
        return self._is_tangled or (self._repair > 1 and self._meet(mesh))

    def _meet(self, mesh: Mesh) -> bool:
        m, touched = mesh.map, self.touched
        return any(
            m.origin[h] < 0 or any(touched.get(g, repair) != repair for g in m.face(h))
            for h, repair in touched.items()
        )
