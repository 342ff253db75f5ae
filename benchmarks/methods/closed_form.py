"""All pairs of a vertex and an edge in doubles: roots of quadratics in closed form.

The obvious fast implementation in numpy, without tolerances and without guarantees.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Final

import numpy as np
from numpy.typing import NDArray

from benchmarks.methods.method import Answer, Method, UnsuitableScene
from benchmarks.methods.moving import Floats, Moving
from exactpt.scene.scene import Scene

__all__ = ["CLOSED_FORM"]

BLOCK: Final = 1 << 18
"""Maximum number of pairs processed at once."""


def _prepare(scene: Scene) -> Callable[[], Answer]:
    moving = Moving(scene)
    vertices = len(moving.body)

    def ask() -> Answer:
        best = np.inf
        step = max(1, BLOCK // max(1, vertices))
        for i in range(0, len(moving.edges), step):
            best = min(best, _first_of(moving, moving.edges[i : i + step]))
        return None if best == np.inf else best

    return ask


def _first_of(moving: Moving, some: NDArray[np.int32]) -> float:
    """The first contact of any vertex with one of some edges."""
    a, b = some[:, 0], some[:, 1]
    deforms = np.array([shape.deforms for shape in moving.shapes])
    others = (moving.body[:, None] != moving.body[a]) | deforms[moving.body][:, None]
    vertex = np.arange(len(moving.body))[:, None]
    v, e = np.nonzero(others & (vertex != a) & (vertex != b))
    if not len(v):
        return np.inf
    edge_x, edge_y = moving.x[b[e]] - moving.x[a[e]], moving.y[b[e]] - moving.y[a[e]]
    to_x, to_y = moving.x[v] - moving.x[a[e]], moving.y[v] - moving.y[a[e]]
    f = _product(edge_x, to_y) - _product(edge_y, to_x)
    if f.shape[1] > 3 and np.any(f[:, 3:]):
        raise UnsuitableScene("orientations of degree above 2")
    best = np.inf
    for t in _roots(f):
        # Comparisons with NaN, where there is no root, are false.
        span = (t >= moving.start) & (t <= moving.end)
        px, py = _value(to_x, t), _value(to_y, t)
        qx, qy = _value(edge_x, t), _value(edge_y, t)
        along = px * qx + py * qy
        on = span & (along >= 0.0) & (along <= qx * qx + qy * qy)
        if on.any():
            best = min(best, float(t[on].min()))
    return best


def _product(p: Floats, q: Floats) -> Floats:
    total = np.zeros((len(p), p.shape[1] + q.shape[1] - 1))
    for i in range(p.shape[1]):
        total[:, i : i + q.shape[1]] += p[:, i : i + 1] * q
    return total


@np.errstate(all="ignore")
def _roots(f: Floats) -> tuple[Floats, Floats]:
    """Both roots of each quadratic, without cancellation; of a linear polynomial its root."""
    c0, c1 = f[:, 0], f[:, 1] if f.shape[1] > 1 else np.zeros(len(f))
    c2 = f[:, 2] if f.shape[1] > 2 else np.zeros(len(f))
    root = np.sqrt(c1 * c1 - 4.0 * c2 * c0)
    q = -0.5 * (c1 + np.where(c1 >= 0.0, root, -root))
    return c0 / q, q / c2


@np.errstate(all="ignore")
def _value(f: Floats, t: Floats) -> Floats:
    value = f[:, -1].copy()
    for i in range(f.shape[1] - 2, -1, -1):
        value = value * t + f[:, i]
    return value


CLOSED_FORM = Method("all pairs, doubles", "closed form", _prepare)
"""The exact search with doubles in place of exact arithmetic."""
