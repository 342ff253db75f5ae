"""Shapely (GEOS): whether two geometries intersect, asked at 1001 times of the span."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

ABOUT: dict[str, Any] = {
    "name": "shapely",
    "package": "shapely",
    "module": "shapely",
    "install": "pip install shapely",
    "asked": "`shapely.intersects` of the two geometries, moved in doubles to 1001 equally spaced "
    "times. Shapely knows no motion: what a step skips is the asker's choice, not its fault.",
    "promises": [
        ["Return True if A and B share any portion of space.", "docstring of shapely.intersects"],
    ],
    "takes": {"shapes": ["convex", "simple", "chain", "segment", "point"], "motion": "polynomial"},
    "ways": {
        "steps": {
            "asked": "The first of these times at which they intersect.",
            "allows": {"of_coordinates": 2.0**-48, "late": 1 / 1000, "brief": 1 / 1000},
        },
        "bisection": {
            "asked": "The step before it is halved until two doubles are next to each other.",
            "allows": {"of_coordinates": 2.0**-48, "brief": 1 / 1000},
        },
    },
}

STEPS = 1000


def answer(question: dict[str, Any], way: str) -> float | None:
    """The first time at which the bodies intersect."""
    import numpy as np

    times = np.linspace(0.0, question["span"], STEPS + 1)
    hits = np.flatnonzero(meeting(question, times))
    if len(hits) == 0:
        return None
    high = float(times[hits[0]])
    if way == "steps" or hits[0] == 0:
        return high
    return halved(float(times[hits[0] - 1]), high, lambda t: meeting(question, np.array([t]))[0])


def halved(low: float, high: float, meets: Callable[[float], Any]) -> float:
    """The time at which bodies meet, between one at which they do not and one at which they do."""
    while low < (middle := 0.5 * (low + high)) < high:
        if meets(middle):
            high = middle
        else:
            low = middle
    return high


def meeting(question: dict[str, Any], times: Any) -> Any:  # noqa: ANN401 - arrays
    """Whether the bodies intersect at each of some times."""
    import shapely

    return shapely.intersects(geometries(question["a"], times), geometries(question["b"], times))


def geometries(body: dict[str, Any], times: Any) -> Any:  # noqa: ANN401 - arrays
    """The geometries of a body at some times."""
    import numpy as np
    import shapely

    path = np.stack([np.polyval(body[axis][::-1], times) for axis in "xy"], axis=-1)
    at = path[:, None, :] + np.array(body["vertices"])[None, :, :]
    if at.shape[1] == 1:
        return shapely.points(at[:, 0])
    if at.shape[1] == 2 or not body["closed"]:
        return shapely.linestrings(at)
    return shapely.polygons(at)


# Whole scenes


def touching(outlines: list[Any], closed: list[bool], deforms: list[bool]) -> list[int]:
    """The numbers of the geometries that intersect another one, or themselves if they deform.

    Geometries are made by array functions, and pairs come from one query of an STRtree.
    """
    import numpy as np
    import shapely

    made: list[Any] = [None] * len(outlines)
    kinds = [0 if len(o) == 1 else 2 if c else 1 for o, c in zip(outlines, closed, strict=True)]
    for kind, make in enumerate((shapely.points, shapely.linestrings, shapely.linearrings)):
        chosen = [k for k, other in enumerate(kinds) if other == kind]
        if chosen:
            parts = [outlines[k] for k in chosen]
            owner = np.repeat(np.arange(len(parts), dtype=np.int32), list(map(len, parts)))
            geometries = make(np.concatenate(parts), indices=owner)
            geometries = shapely.polygons(geometries) if kind == 2 else geometries
            for k, geometry in zip(chosen, geometries, strict=True):
                made[k] = geometry
    first, second = shapely.STRtree(made).query(made, predicate="intersects")
    own = [k for k, one in enumerate(deforms) if one]
    crossed = [k for k in own if not (shapely.is_valid(made[k]) and shapely.is_simple(made[k]))]
    return sorted({*first[first != second].tolist(), *crossed})


def triangles(outline: list[tuple[float, float]]) -> list[list[tuple[float, float]]]:
    """The triangles of a constrained Delaunay triangulation of a polygon."""
    import shapely

    cut = shapely.constrained_delaunay_triangles(shapely.Polygon(outline))
    return [list(triangle.exterior.coords)[:3] for triangle in cut.geoms]
