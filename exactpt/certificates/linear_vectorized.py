"""Orientations of many triples at once, in numpy: the filter of linear motions."""

from __future__ import annotations

from typing import Final

import numpy as np

from exactpt.certificates.coefficients import K
from exactpt.filters.rounding import SLACK
from exactpt.indices import VertexId
from exactpt.kernel.doubles import Floats, Indices, view
from exactpt.kernel.vectorized import Answers, quadratics
from exactpt.motion.vertices import HORIZON, MOTION, OTHER_MOTION, WIDTH, Vertices

BLOCK: Final = 1 << 13
"""Number of triples whose arrays are in a processor's cache together."""


def linear_orientations(
    vertices: Vertices, ids: Indices, now_low: float, now_high: float, end: float
) -> Answers:
    """Return the filter's results, up to the time ``end``, for orientations that do not vanish now.

    Unsure unless the three vertices of a row are linear, and not copies of one another.
    """
    places = view(vertices.places).reshape(-1, WIDTH)
    errors = vertices.enclosures.errors
    others = np.flatnonzero(places[:, MOTION] == OTHER_MOTION).tolist()
    nodes = np.arange(len(places)) if not others else np.array(vertices.nodes())
    if others:
        places = places.copy()
        for v in others:
            float_track = vertices.all[VertexId(v)].float_track
            places[v, MOTION] = (
                float_track.motion
                if float_track.degree <= 1 and not float_track.ws
                else OTHER_MOTION
            )
    blocks = [
        _orientations(places, nodes, errors, ids[first : first + BLOCK], now_low, now_high, end)
        for first in range(0, max(1, len(ids)), BLOCK)
    ]
    return Answers(*(np.concatenate(parts) for parts in zip(*blocks, strict=True)))


@np.errstate(all="ignore")
def _orientations(
    places: Floats,
    nodes: Indices,
    errors: list[float],
    ids: Indices,
    now_low: float,
    now_high: float,
    end: float,
) -> Answers:
    """Return the filter's results for rows of three ids, none of them at a root now.

    They are computed as in `exactpt.certificates.coefficients._three`. If two vertices of a
    triple translate together they become a and b, and the higher coefficient of their
    difference is 0 without error, as in `_pair` there.
    """
    given = places[ids]
    values, motions = given[:, :, :HORIZON], given[:, :, MOTION]
    rows = np.arange(len(ids))
    together = (motions == np.roll(motions, -1, axis=1)) & (motions >= 0)
    first = np.where(together.any(axis=1), together.argmax(axis=1), 0)
    a, b, c = (values[rows, (first + i) % 3] for i in range(3))
    ux0, uy0, ux1, uy1 = (b - a).T
    vx0, vy0, vx1, vy1 = (c - a).T
    linear = together.any(axis=1)
    ux1, uy1 = np.where(linear, 0.0, ux1), np.where(linear, 0.0, uy1)
    p, q = ux0 * vy0, uy0 * vx0
    c0, e0 = p - q, K * (abs(p) + abs(q))
    p, q, r, s = ux0 * vy1, uy0 * vx1, ux1 * vy0, uy1 * vx0
    c1, e1 = p - q + r - s, K * (abs(p) + abs(q) + abs(r) + abs(s))
    p, q = ux1 * vy1, uy1 * vx1
    c2, e2 = p - q, K * (abs(p) + abs(q))
    d0, d1 = 2.0 * errors[0], 2.0 * errors[1]
    t0 = abs(ux0) + abs(uy0) + abs(vx0) + abs(vy0)
    t1 = abs(ux1) + abs(uy1) + abs(vx1) + abs(vy1)
    e0 = (e0 + d0 * (t0 + 2.0 * d0)) * SLACK
    e1 = (e1 + d1 * t0 + d0 * (t1 + 4.0 * d1)) * SLACK
    e2 = np.where(linear, 0.0, (e2 + d1 * (t1 + 2.0 * d1)) * SLACK)
    at_root = np.zeros(len(ids), dtype=np.bool_)
    horizon = np.minimum(given[:, :, HORIZON].min(axis=1), end)
    answers = quadratics(c0, c1, c2, e0, e1, e2, now_low, now_high, horizon, at_root)
    u, v, w = nodes[ids].T
    is_known = (motions != OTHER_MOTION).all(axis=1) & (u != v) & (v != w) & (w != u)
    return answers._replace(signs=np.where(is_known, answers.signs, 0))
