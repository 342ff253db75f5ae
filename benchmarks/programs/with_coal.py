"""Coal (formerly hpp-fcl): distances of two prisms in 3D, by which they are advanced."""

from __future__ import annotations

from typing import Any

ABOUT: dict[str, Any] = {
    "name": "coal",
    "package": "coal",
    "module": "coal",
    "install": "pip install coal",
    "asked": "Its Python module has no continuous collision. `coal.distance` of the polygons as "
    "convex prisms about their first vertices, one higher than the other, with the default "
    "request (gjk_tolerance 1e-6), and conservative "
    "advancement by the asker: ahead by the distance over the closing speed along the normal "
    "of the result, until the distance is at most 1e-6; no contact once they do not close in.",
    "promises": [
        ["dedicated and efficient implementations of the GJK and the EPA algorithms",
         "README of Coal, new features"],
        ["gjk_tolerance: 1e-06", "coal.DistanceRequest, its default"],
    ],
    "takes": {"shapes": ["convex"], "motion": "linear"},
    "ways": {
        "": {
            "asked": "",
            "allows": {"distance": 2e-6, "of_extent": 2e-6, "of_coordinates": 2.0**-48},
        },
    },
}  # fmt: skip

NEAR = 1e-6
ROUNDS = 1000


def answer(question: dict[str, Any], way: str) -> float | None:  # noqa: ARG001
    """The time at which the distance is at most `NEAR`."""
    import coal
    import numpy as np

    a, b = question["a"], question["b"]
    shapes = [prism(a["vertices"], 1.0), prism(b["vertices"], 2.0)]
    starts = [np.array([*body["vertices"][0], 0.0]) for body in (a, b)]
    speeds = [np.array([body["x"][1], body["y"][1], 0.0]) for body in (a, b)]
    time = 0.0
    for _ in range(ROUNDS):
        places = [
            coal.Transform3s(np.eye(3), start + speed * time)
            for start, speed in zip(starts, speeds, strict=True)
        ]
        result = coal.DistanceResult()
        gap = coal.distance(
            shapes[0], places[0], shapes[1], places[1], coal.DistanceRequest(), result
        )
        if gap <= NEAR:
            return time
        closing = float(result.normal @ (speeds[0] - speeds[1]))
        if closing <= 0.0 or time + gap / closing > question["span"]:
            return None
        time += gap / closing
    raise RuntimeError(f"not at a contact after {ROUNDS} distances")


def prism(vertices: list[list[float]], height: float) -> Any:  # noqa: ANN401 - of coal
    """A convex prism about its first vertex."""
    import coal
    import numpy as np

    n = len(vertices)
    points = coal.StdVec_Vec3s()
    left, low = vertices[0]
    for z in (-height, height):
        for x, y in vertices:
            points.append(np.array([x - left, y - low, z]))
    faces = [list(range(n))[::-1], list(range(n, 2 * n))]
    faces += [[i, (i + 1) % n, n + (i + 1) % n, n + i] for i in range(n)]
    triangles = coal.StdVec_Triangle()
    for f in faces:
        for i in range(1, len(f) - 1):
            triangles.append(coal.Triangle(f[0], f[i], f[i + 1]))
    return coal.Convex(points, triangles)
