"""The IPC Toolkit: continuous collision detection of each vertex and each edge in 2D."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

ABOUT: dict[str, Any] = {
    "name": "ipctk",
    "package": "ipctk",
    "module": "ipctk",
    "install": "pip install ipctk",
    "asked": "`point_edge_ccd` of each vertex of one body and each edge of the other, with "
    "min_distance 0 (`point_point_ccd` if there is no edge); the least time of impact. A step of "
    "IPC begins without intersections: bodies in contact at the start are left out.",
    "takes": {
        "shapes": ["convex", "simple", "chain", "segment", "point"],
        "motion": "linear",
        "start": "apart",
    },
    "ways": {
        "tight inclusion": {
            "promises": [
                ["A conservative CCD method with support for minimum separation.",
                 "README of Tight-Inclusion"],
                [("We adjust the conservative_rescaling parameter to get a more accurate time of "
                  "impact (TOI), but in practice, this is not needed as a more conservative "
                  "estimate of the TOI is sufficient to avoid penetrations."),
                 "tutorial of the IPC Toolkit, nonlinear CCD"],
            ],
            "asked": "TightInclusionCCD(tolerance=1e-6, max_iterations=10**5, "
            "conservative_rescaling=1 - 1e-6): early is what it promises, late or missed is not. A "
            "distance of 1e-3 is taken as kept, for the limit of iterations widens the tolerance.",
            "allows": {"distance": 1e-3, "of_extent": 2e-6, "of_coordinates": 2.0**-48},
        },
        "additive": {
            "promises": [
                [("In compairson to Tight Inclusion CCD, this CCD method is not provably "
                  "conservative and so can potentially produce false negatives (i.e., miss "
                  "collisions) due to floating-point rounding error. However, it is much faster "
                  "than Tight Inclusion CCD [...] and very robust due to the gaps and "
                  "conservative rescaling used."),
                 "source of additive CCD, ipc/ccd/additive_ccd.cpp"],
            ],
            "asked": "AdditiveCCD(max_iterations=10**6, conservative_rescaling=0.9999): it goes "
            "on by this share of the distance of a vertex and an edge, and stops one step before "
            "1e-4 of the first distance is left: that is at most sqrt(1e-4), 1/100 of it.",
            "allows": {"distance": 2e-6, "of_extent": 1e-2, "of_coordinates": 2.0**-48},
        },
    },
}  # fmt: skip


OPTIONS = {
    "tight inclusion": {
        "tolerance": 1e-6,
        "max_iterations": 10**5,
        "conservative_rescaling": 1 - 1e-6,
    },
    "additive": {"max_iterations": 10**6, "conservative_rescaling": 0.9999},
}


def answer(question: dict[str, Any], way: str) -> float | None:
    """The least time of impact of a vertex and an edge."""
    method = method_of(way, **OPTIONS[way])
    a, b = (ends(question[key], question["span"]) for key in "ab")
    least = None
    for points, others in ((a, b), (b, a)):
        edges = edges_of(others, closed=question["b" if others is b else "a"]["closed"])
        for p in points:
            for edge in edges:
                ccd = method.point_edge_ccd if len(edge) == 2 else method.point_point_ccd
                first, last = zip(p, *(others[i] for i in edge), strict=True)
                hit, share = ccd(*first, *last, min_distance=0.0)
                if hit and (least is None or share < least):
                    least = share
    return None if least is None else least * question["span"]


def method_of(way: str, **options: float) -> Any:  # noqa: ANN401 - of ipctk
    """One of its methods, with options in place of its defaults."""
    import ipctk

    ipctk.set_logger_level(ipctk.LoggerLevel.off)
    return {"tight inclusion": ipctk.TightInclusionCCD, "additive": ipctk.AdditiveCCD}[way](
        **options
    )


def ends(body: dict[str, Any], span: float) -> list[tuple[Any, Any]]:
    """The positions of each vertex at the start and at the end."""
    import numpy as np

    step = np.array([body["x"][1], body["y"][1]]) * span
    return [(np.array(v), np.array(v) + step) for v in body["vertices"]]


def edges_of(points: list[Any], *, closed: bool) -> list[tuple[int, ...]]:
    """The edges as pairs of vertices; of a point, the vertex alone."""
    n = len(points)
    if n == 1:
        return [(0,)]
    return [(i, (i + 1) % n) for i in range(n if closed and n > 2 else n - 1)]


# Whole scenes


def mesh_of(places: Any, edges: Any, patches: Any) -> Any:  # noqa: ANN401 - of ipctk
    """A mesh of vertices and edges; vertices of one patch do not collide."""
    import ipctk

    mesh = ipctk.CollisionMesh(places, edges)
    mesh.can_collide = ipctk.make_vertex_patches_filter(patches)
    return mesh


def first_step(
    mesh: Any,  # noqa: ANN401 - of ipctk
    places: Callable[[int], Any],
    method: Any,  # noqa: ANN401
    pieces: int,
) -> float | None:
    """The first contact in linear pieces of motion, in pieces from the start; None if none.

    In each piece the sweep-and-prune of ipctk finds candidates and the narrow phase a
    collision-free step, on one thread, so that processor times can be compared.

    Args:
        mesh: see `mesh_of`.
        places: from a number of pieces to the positions of all vertices after them.
        method: see `method_of`.
        pieces: number of pieces.
    """
    import ipctk

    ipctk.set_num_threads(1)
    here = places(0)
    broad = ipctk.SweepAndPrune()
    candidates = ipctk.Candidates()
    for i in range(pieces):
        there = places(i + 1)
        candidates.build(mesh, here, there, 0.0, broad)
        free: float = candidates.compute_collision_free_stepsize(mesh, here, there, 0.0, method)
        if free < 1.0:
            return i + free
        here = there
    return None
