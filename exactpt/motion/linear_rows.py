"""The coefficients of many polygons in linear translation at once, in numpy.

The results are bit for bit those of `exactpt.motion.enclosures`, `exactpt.motion.normalization` and
`exactpt.motion.ring_order` for one body. The computation is left to them if any body is of another
kind, or a number is out of range or close to a bound.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Final, NamedTuple, cast

import numpy as np

from exactpt.filters.rounding import LARGEST, SMALLEST, TINY, U
from exactpt.geometry.ragged import spread
from exactpt.kernel.budget import check_budget
from exactpt.kernel.double_double import exact_sum
from exactpt.kernel.doubles import Floats, Indices
from exactpt.kernel.numbers import QQ, nearest_float, of_double
from exactpt.motion.motions import Translation
from exactpt.motion.normalization import Normalization, normalization_for

if TYPE_CHECKING:
    from exactpt.motion.body import Body
    from exactpt.scene.body_arrays import BodyArrays

LEAST: Final = 2.0**-19
"""Least extent of a scene that certainly needs no scale, see `exactpt.motion.normalization`."""
MOST: Final = 2.0**19
"""Its largest one."""
FAR: Final = 8.0
"""Number of extents from the origin up to which a scene certainly needs no shift."""
BLUR: Final = 2.0**-30
"""Maximum error of rounded positions, in extents."""
K: Final = 8.0 * U
"""Relative bound on the rounding of a 2 x 2 determinant of differences of doubles."""


_ZEROS: Final = (QQ(0), QQ(0))


class LinearRows(NamedTuple):
    """The vertices of bodies, each body counter-clockwise, in a normalization that shifts nothing.

    Attributes:
        normalization: that of the coordinates.
        offsets: body k has the rows ``offsets[k]`` to ``offsets[k + 1]`` - 1.
        indices: of each row, its vertex in the body.
        coefficients: shape (N, 4): x0, y0, x1, y1.
        velocities: shape (n, 2), of each body, not normalised.
        error: the bound on the errors of x0 and y0; those of x1 and y1 are exact.
    """

    normalization: Normalization
    offsets: Indices
    indices: Indices
    coefficients: Floats
    velocities: Floats
    error: float


class _Given(NamedTuple):
    """Bodies in arrays: rest positions, offsets, and the shift and velocity of each body."""

    vertices: Floats
    offsets: Indices
    shifts: Floats
    velocities: Floats


@np.errstate(all="ignore")
def linear_rows(bodies: Sequence[Body], start: QQ, end: QQ) -> LinearRows | None:
    """Return the rows of bodies from a time on; None unless all are linear polygons."""
    is_arrays = hasattr(bodies, "offsets")
    given = _from_arrays(cast("BodyArrays", bodies)) if is_arrays else _read(bodies)
    if given is None or not len(bodies):
        return None
    counts = np.diff(given.offsets)
    owner, number = spread(counts)
    shifts = given.shifts[owner]
    places, lost = exact_sum(given.vertices, shifts)
    moves = given.velocities[owner] * nearest_float(start)
    near = places + moves
    # Each of the two terms errs by at most 2 U of its size, their sum by U of that of both.
    blur = 4.0 * U * (np.abs(places).max() + np.abs(moves).max())
    if not (np.isfinite(near).all() and np.isfinite(lost).all()):
        return None
    normalization = _normalization(
        near, start, end, 0.0 if start == 0 and not lost.any() else float(blur)
    )
    if normalization is None:
        return None
    units = np.array(normalization.scale)
    scaled, rates = (
        np.ldexp(places, -units),
        np.ldexp(given.velocities, normalization.time_scale - units),
    )
    if not (_in_range(scaled) and _in_range(rates)):
        return None
    first = given.offsets[:-1]
    if (given.vertices[first] == given.vertices[given.offsets[1:] - 1]).all(axis=1).any():
        return None  # `Shape` drops a last vertex that repeats the first
    largest = float(np.max(np.abs(scaled), where=lost != 0.0, initial=0.0))
    turns = _turns(given.vertices, given.offsets, owner)
    for k in np.flatnonzero(turns == 0).tolist():
        piece = bodies[k].exact_piece_after(start)
        turns[k] = 1 if piece.turns_left(range(int(counts[k])), start) else -1
    indices = np.where(turns[owner] > 0, number, counts[owner] - 1 - number)
    rows = first[owner] + indices
    coefficients = np.concatenate((scaled[rows], rates[owner]), axis=1)
    velocities = given.velocities + 0.0  # never -0.0
    return LinearRows(
        normalization, given.offsets, indices, coefficients, velocities, 2.0 * U * largest
    )


def _from_arrays(bodies: BodyArrays) -> _Given | None:
    given = bodies.coefficients
    if (
        not bodies.closed.all()
        or bodies.radii.any()
        or np.diff(bodies.offsets).min(initial=3) < 3
        or given[:, :, 2:].any()
    ):
        return None
    rates = given[:, :, 1] if given.shape[2] > 1 else np.zeros_like(given[:, :, 0])
    return _Given(bodies.vertices, bodies.offsets, given[:, :, 0], rates)


def _read(bodies: Sequence[Body]) -> _Given | None:
    """Return the arrays of bodies whose numbers are all doubles."""
    xs: list[float] = []
    ys: list[float] = []
    offsets = [0]
    paths: list[QQ | float] = []
    for body in bodies:
        check_budget()
        near, motion = body.exact_shape.near, body.motion
        if (
            near is None
            or not near.is_exact
            or not body.has_interior
            or body.has_rings
            or not isinstance(motion, Translation)
        ):
            return None
        x, y = (
            f.exact_coefficients if f.exact_doubles is None else f.exact_doubles
            for f in (motion.x, motion.y)
        )
        if len(x) > 2 or len(y) > 2:
            return None
        for path in (x, y):
            paths += path if len(path) == 2 else (*path, *_ZEROS)[:2]
        xs += near.xs
        ys += near.ys
        offsets.append(len(xs))
    rates = [c if isinstance(c, float) else nearest_float(c) for c in paths]
    if rates != paths:
        return None
    moves = np.array(rates).reshape(-1, 2, 2)
    return _Given(np.array([xs, ys]).T, np.array(offsets), moves[:, :, 0], moves[:, :, 1])


def _normalization(near: Floats, start: QQ, end: QQ, blur: float) -> Normalization | None:
    """Return the normalization of positions at the start; None if it shifts, or is not certain.

    Rounded positions, with errors of up to ``blur``, must certainly need neither a shift nor a
    scale: so it may be at most `BLUR` of their extents.
    """
    low, high = near.min(axis=0), near.max(axis=0)
    extent, far = high - low, np.maximum(abs(low), abs(high))
    if not blur:
        least = near[np.abs(near).argmin(axis=0), (0, 1)]
        points = [
            (of_double(x), of_double(y)) for x, y in (low.tolist(), high.tolist(), least.tolist())
        ]
    elif (
        (extent >= LEAST) & (extent <= MOST) & (far <= FAR * extent) & (blur <= BLUR * extent)
    ).all():
        points = [(QQ(0), QQ(0)), (QQ(1), QQ(1))]
    else:
        return None
    normalization = normalization_for(points, start, end)
    return normalization if normalization.only_scales else None


def _in_range(values: Floats) -> bool:
    size = np.abs(values)
    return bool(((values == 0.0) | ((size >= SMALLEST) & (size <= LARGEST))).all())


def _turns(vertices: Floats, offsets: Indices, owner: Indices) -> Indices:
    """1 for each simple polygon that is counter-clockwise, -1 if clockwise, 0 if not certain.

    By the turn at its leftmost vertex, the lowest of several, as `orientation_of_doubles`.
    """
    x, y = vertices.T
    first, last = offsets[:-1], offsets[1:] - 1
    at = np.lexsort((y, x, owner))[first]
    before, after = np.where(at == first, last, at - 1), np.where(at == last, first, at + 1)
    (ux, uy), (vx, vy) = (vertices[at] - vertices[before]).T, (vertices[after] - vertices[at]).T
    p, q = ux * vy, uy * vx
    det, bound = p - q, K * (abs(p) + abs(q)) + TINY
    return np.where(det > bound, 1, np.where(det < -bound, -1, 0))
