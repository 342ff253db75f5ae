"""The Flexible Collision Library by python-fcl: continuous collision of two prisms in 3D."""

from __future__ import annotations

from typing import Any

ABOUT: dict[str, Any] = {
    "name": "fcl",
    "package": "python-fcl",
    "module": "fcl",
    "install": "pip install python-fcl",
    "asked": "`continuousCollide` of the polygons as convex prisms, one higher than the other "
    "so that no caps "
    "meet, each about its first vertex, translated from start to end, with ccd_motion_type "
    "CCDM_TRANS and num_max_iterations 1000.",
    "promises": [
        ["continous collision checking between two objects", "fcl::continuousCollide"],
        ["error in first contact time; time of contact in [0, 1]",
         "ContinuousCollisionRequest::toc_err, ContinuousCollisionResult::time_of_contact"],
    ],
    "takes": {"shapes": ["convex"], "motion": "linear"},
    "ways": {
        "naive": {
            "asked": "CCDC_NAIVE, the default: at 1000 times; the default toc_err 1e-4. A "
            "contact is seen at the next of these times.",
            "allows": {"distance": 1e-6, "of_coordinates": 2.0**-48,
                       "late": 1 / 999, "brief": 1 / 999},
        },
        "conservative advancement": {
            "asked": "CCDC_CONSERVATIVE_ADVANCEMENT; the default toc_err 1e-4 is taken as a "
            "share of the span.",
            "allows": {"distance": 1e-4, "of_coordinates": 2.0**-48, "of_extent": 1e-4,
                       "late": 1e-4},
        },
    },
}  # fmt: skip


def answer(question: dict[str, Any], way: str) -> float | None:
    """The time of contact, as a share of the span, times the span."""
    import fcl
    import numpy as np

    kind = fcl.CCDSolverType
    solver = {
        "naive": kind.CCDC_NAIVE,
        "conservative advancement": kind.CCDC_CONSERVATIVE_ADVANCEMENT,
    }[way]
    objects, ends = [], []
    for body, height in ((question["a"], 1.0), (question["b"], 2.0)):
        start = np.array([*body["vertices"][0], 0.0])
        step = np.array([body["x"][1], body["y"][1], 0.0]) * question["span"]
        objects.append(fcl.CollisionObject(convex(body["vertices"], height), fcl.Transform(start)))
        ends.append(fcl.Transform(start + step))
    request = fcl.ContinuousCollisionRequest(
        num_max_iterations=1000,
        ccd_motion_type=fcl.CCDMotionType.CCDM_TRANS,
        ccd_solver_type=solver,
    )
    result = fcl.ContinuousCollisionResult()
    fcl.continuousCollide(objects[0], ends[0], objects[1], ends[1], request, result)
    if not result.is_collide:
        return None
    time: float = result.time_of_contact * question["span"]
    return time


def prism(vertices: list[list[float]], height: float) -> tuple[Any, list[list[int]]]:
    """The points, about the first one, and faces, counter-clockwise from outside, of a prism."""
    import numpy as np

    n = len(vertices)
    left, low = vertices[0]
    points = np.array([[x - left, y - low, z] for z in (-height, height) for x, y in vertices])
    sides = [[i, (i + 1) % n, n + (i + 1) % n, n + i] for i in range(n)]
    return points, [list(range(n))[::-1], list(range(n, 2 * n)), *sides]


def convex(vertices: list[list[float]], height: float) -> Any:  # noqa: ANN401 - of FCL
    """A prism as a convex shape."""
    import fcl
    import numpy as np

    points, faces = prism(vertices, height)
    flat = [number for face in faces for number in (len(face), *face)]
    return fcl.Convex(points, len(faces), np.array(flat))
