"""Shapely in time steps: at each step an STRtree finds the geometries that intersect.

Geometries are made by its array functions, pairs come from one query of the tree, and bodies
that deform are tested for simplicity. With bisection, the first step with an intersection is
halved down to the resolution of doubles, for the bodies involved alone.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any, Final, final

import numpy as np

from benchmarks.methods.method import Answer, Method
from benchmarks.methods.moving import Floats, Indices, Moving, Shape
from exactpt.scene.scene import Scene

__all__ = ["with_shapely"]

HALVINGS: Final = 60


@final
class _Stepper:
    """The geometries of a scene at any time."""

    def __init__(self, scene: Scene) -> None:
        self._moving = moving = Moving(scene)
        self._all = list(range(len(moving.shapes)))
        self._deforming = [i for i in self._all if moving.shapes[i].deforms]

    def geometries(self, t: float, bodies: Sequence[int]) -> list[Any]:
        """The geometries at a time, one for each body."""
        shapes = [self._moving.shapes[i] for i in bodies]
        if len(bodies) == len(self._all):
            at = self._moving.at(t)
            parts = [at[shape.range] for shape in shapes]
        else:
            parts = [self._moving.at(t, shape.range) for shape in shapes]
        made: list[Any] = [None] * len(bodies)
        for kind, make in ((_is_polygon, _polygons), (_is_line, _lines), (_is_point, _points)):
            chosen = [k for k, shape in enumerate(shapes) if kind(shape)]
            if chosen:
                coordinates = np.concatenate([parts[k] for k in chosen])
                owner = np.repeat(
                    np.arange(len(chosen), dtype=np.int32), [len(parts[k]) for k in chosen]
                )
                for k, geometry in zip(chosen, make(coordinates, owner), strict=True):
                    made[k] = geometry
        return made

    def touching(self, t: float, bodies: Sequence[int] | None = None) -> list[int]:
        """The bodies that touch another body, or themselves, at a time."""
        import shapely

        numbers = self._all if bodies is None else bodies
        made = self.geometries(t, numbers)
        first, second = shapely.STRtree(made).query(made, predicate="intersects")
        found = {numbers[i] for i in first[first != second].tolist()}
        for k, i in enumerate(numbers):
            if i in self._deforming and not (shapely.is_valid(made[k]) and _is_simple(made[k])):
                found.add(i)
        return sorted(found)

    def first(self, steps: int, *, bisect: bool) -> float | None:
        """The first time step with a contact, bisected on demand; None if there is none."""
        start, end = self._moving.start, self._moving.end
        before = start
        for i in range(1, steps + 1):
            now = start + (end - start) * i / steps
            bodies = self.touching(now)
            if bodies:
                return self._halve(before, now, bodies) if bisect else now
            before = now
        return None

    def _halve(self, low: float, high: float, bodies: Sequence[int]) -> float:
        for _ in range(HALVINGS):
            middle = 0.5 * (low + high)
            if not low < middle < high:
                break
            if self.touching(middle, bodies):
                high = middle
            else:
                low = middle
        return high


def _is_polygon(shape: Shape) -> bool:
    return shape.closed


def _is_line(shape: Shape) -> bool:
    return shape.size > 1 and not shape.closed


def _is_point(shape: Shape) -> bool:
    return shape.size == 1


def _polygons(coordinates: Floats, owner: Indices) -> Any:  # noqa: ANN401
    import shapely

    return shapely.polygons(shapely.linearrings(coordinates, indices=owner))


def _lines(coordinates: Floats, owner: Indices) -> Any:  # noqa: ANN401
    import shapely

    return shapely.linestrings(coordinates, indices=owner)


def _points(coordinates: Floats, _: Indices) -> Any:  # noqa: ANN401
    import shapely

    return shapely.points(coordinates)


def _is_simple(geometry: Any) -> bool:  # noqa: ANN401 - shapely is optional
    import shapely

    return bool(shapely.is_simple(geometry))


def with_shapely(steps: int, *, bisect: bool) -> Method:
    """Shapely with a number of steps."""

    def prepare(scene: Scene) -> Callable[[], Answer]:
        stepper = _Stepper(scene)
        return lambda: stepper.first(steps, bisect=bisect)

    name = "shapely, bisection" if bisect else "shapely"
    return Method(name, f"{steps} steps", prepare, "shapely")
