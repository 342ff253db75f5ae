"""Simultaneous repairs: the half-edges that each has changed, and whether repairs interact."""

from __future__ import annotations

from typing import final

from exactpt.indices import HalfEdge
from exactpt.kernel.budget import check_budget
from exactpt.pseudotriangulation.mesh import Mesh


@final
class FailureGroup:
    """The repairs at the current time.

    Repairs of different tiles are independent: their result is the same at one time as one
    after the other, as they happen in the perturbed scene (`exactpt.certificates.perturbation`).
    So each is correct by itself, and no check is needed. If a repair changes a tile that an
    earlier one has changed, then some face or half-edge has been touched by both, or a
    half-edge touched by one has been removed by the other.

    Attributes:
        touched: for each half-edge whose angle has changed, the first repair that changed it.
        has_new_motions: whether a body has changed its motion at this time. The signs just
            before it are then unknown, so every repair has to be checked.
    """

    def __init__(self) -> None:
        self.touched: dict[HalfEdge, int] = {}
        self.has_new_motions: bool = False
        self._interact: bool = False
        self._repair: int = 0

    def clear(self) -> None:
        """Begin a new time."""
        self.touched.clear()
        self.has_new_motions = self._interact = False
        self._repair = 0

    def begin_repair(self) -> None:
        """Begin the next repair, to which later `touch` calls refer, and check the budget.

        Repairs of a forged tiling may have no end. For the first repair at a time, the caller that
        advanced to it has checked it.
        """
        if self._repair > 0:
            check_budget()
        self._repair += 1

    def touch(self, half_edges: list[HalfEdge]) -> None:
        """Record that the angles of these half-edges have changed."""
        for h in half_edges:
            if self.touched.setdefault(h, self._repair) != self._repair:
                self._interact = True

    def require_check(self, half_edges: list[HalfEdge]) -> None:
        """Have the tiles of these half-edges checked in any case."""
        self.touch(half_edges)
        self._interact = True

    def needs_check(self, mesh: Mesh) -> bool:
        """Return True if repairs may interact, so that their result has to be checked."""
        if self.has_new_motions and self._repair > 0:
            return True
        return self._interact or (self._repair > 1 and self._share_faces(mesh))

    def _share_faces(self, mesh: Mesh) -> bool:
        """Return True if two repairs share a face, or one removed an edge of the other."""
        m, touched = mesh.map, self.touched
        return any(
            m.origin[h] < 0 or any(touched.get(g, repair) != repair for g in m.face(h))
            for h, repair in touched.items()
        )
