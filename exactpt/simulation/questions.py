"""Queries that a simulation answers about the free space at its current time."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Sequence
from typing import TYPE_CHECKING

from exactpt.errors import InputError
from exactpt.kernel.numbers import QQ, Rational, rational

if TYPE_CHECKING:
    from exactpt.pseudotriangulation.snapshot import Snapshot
    from exactpt.query.answers import Hit, Path, Place, VertexName
    from exactpt.query.space import FreeSpace, PointLike
    from exactpt.tiling.tiling import Tiling

__all__ = ["Questions"]


class Questions(ABC):
    """Base of classes that answer queries about the free space of a tiling."""

    _space: FreeSpace | None

    @abstractmethod
    def _asked(self) -> Tiling:
        """The tiling to query.

        Raises:
            InputError: if there is none.
        """

    def _forget_space(self) -> None:
        """Discard the cached space, after time has passed or bodies have changed."""
        self._space = None

    def space(self, at: Rational | None = None) -> FreeSpace:
        """The free space at a time, for any number of queries; built in O(n log n).

        Args:
            at: a rational time, from now to before the next event; by default now.

        Raises:
            InputError: if no time is given and now is not rational, if the time is not between
                now and the next event, or if the run has ended with a contact.
        """
        kinetic = self._asked()
        if at is None:
            now = kinetic.now.simplified()
            if not now.is_rational:
                raise InputError(f"now, t = {float(now)!r}, is not rational: give a time")
            t = now._low
        else:
            t = rational(at)
            _check_between(kinetic, t)
        if self._space is None or self._space._at != t:
            from exactpt.query.space import FreeSpace

            self._space = FreeSpace(kinetic, t)
        return self._space

    def snapshot(self) -> Snapshot:
        """The tiling at the current time, which must be rational.

        Raises:
            InputError: see `space`.
        """
        return self.space().snapshot

    @property
    def tiling(self) -> Snapshot:
        """Same as `snapshot`: ``simulation.tiling.faces``, ``simulation.tiling.diagonals``."""
        return self.snapshot()

    def locate(self, point: PointLike) -> Place:
        """The location of a point now, see `FreeSpace.locate`."""
        return self.space().locate(point)

    def ray_cast(self, origin: PointLike, direction: PointLike) -> Hit | None:
        """The first point of a ray that belongs to a body now, see `FreeSpace.ray_cast`."""
        return self.space().ray_cast(origin, direction)

    def is_free(self, p: PointLike, q: PointLike) -> bool:
        """Whether no body meets a segment now, see `FreeSpace.is_free`."""
        return self.space().is_free(p, q)

    def path(self, start: PointLike, goal: PointLike) -> Path:
        """A shortest path of its homotopy class now, see `FreeSpace.path`."""
        return self.space().path(start, goal)

    def shorten(self, walk: Sequence[PointLike]) -> Path:
        """The shortest path homotopic to a polyline now, see `FreeSpace.shorten`."""
        return self.space().shorten(walk)

    def hull(self) -> list[VertexName]:
        """The vertices on the convex hull of all bodies now, see `FreeSpace.hull`."""
        return self.space().hull()

    def relative_hull(self, body: str) -> list[VertexName]:
        """The shortest loop around a body now, see `FreeSpace.relative_hull`."""
        return self.space().relative_hull(body)

    def neighbours(self, body: str) -> list[str]:
        """The bodies connected to a body by a diagonal now, see `FreeSpace.neighbours`."""
        return self.space().neighbours(body)


def _check_between(kinetic: Tiling, t: QQ) -> None:
    following = kinetic.next_number()
    late = t > kinetic.certifier.end or (
        following is not None and following.compare_rational(t) <= 0
    )
    if late or kinetic.now.compare_rational(t) > 0:
        raise InputError(
            f"t = {t} is not between now, t = {float(kinetic.now)!r}, and the next event"
        )
