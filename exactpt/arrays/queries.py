"""Moving points against moving segments, all with linear motion: millions of bare queries."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Final

import numpy as np
from numpy.typing import ArrayLike

from exactpt.arrays.answers import record, record_edges
from exactpt.arrays.contacts import Contacts, Errors, masks
from exactpt.arrays.incidence_times import INFINITY, Span, first_incidences
from exactpt.arrays.relative import Relative, orientations
from exactpt.arrays.sharpening import ExactRelative, sharpened
from exactpt.arrays.spans import Spans, read_spans
from exactpt.errors import InputError
from exactpt.filters.rounding import SLACK, TINY, U
from exactpt.kernel.algebraic import AlgebraicNumber
from exactpt.kernel.double_double import exact_difference
from exactpt.kernel.doubles import Flags, Floats, Indices, doubles, finite_rows
from exactpt.kernel.numbers import QQ, of_double, show
from exactpt.motion.body import Body
from exactpt.motion.track import Incidence, coincide, lies_on, translated
from exactpt.pair.features import FeaturePair
from exactpt.pair.straight import Earliest
from exactpt.scene.scene import Scene

CHUNK: Final = 1 << 14
"""Number of queries at a time: their arrays fit a cache."""
APART: Final = np.array([0.0, 1.0, 0.0, 0.0, 1.0, 0.0, *([0.0] * 6)])
"""A query without a contact, instead of one that is refused."""


def point_segment_contacts(
    points: ArrayLike,
    firsts: ArrayLike,
    lasts: ArrayLike,
    *,
    velocities: Sequence[ArrayLike | None] = (None, None, None),
    time: ArrayLike = (0.0, 1.0),
    errors: Errors = "raise",
) -> Contacts:
    """Return the first contacts of moving points with moving segments, of each pair for itself.

    Each result equals that of `exactpt.first_contact` for a scene of the point (body 0) and the
    segment (body 1); so a segment that shrinks to a point touches itself.

    >>> found = point_segment_contacts(
    ...     [(0, 1), (5, 5)], [(2, 0), (2, 0)], [(2, 4), (2, 4)],
    ...     velocities=([(1, 0), (1, 0)], None, None), time=(0, 10))
    >>> found.found.tolist(), found.contact(0).time
    ([True, False], AlgebraicNumber('2'))

    Args:
        points: shape (m, 2), at time 0.
        firsts: shape (m, 2), the first vertices of the segments at time 0.
        lasts: shape (m, 2), their last vertices.
        velocities: those of the points, the firsts and the lasts, each of shape (m, 2), or None
            for vertices at rest.
        time: the start and the end of the closed time span, or of shape (m, 2) one for each.
        errors: "mask" leaves queries whose segment is a point at the start, or with a number that
            is not finite, without a result (`Contacts.refused`, `Contacts.reasons`); "raise"
            raises an error for the first one.

    Raises:
        InputError: if the shapes do not match, a span is empty, or, unless errors are masked, a
            value is not a finite double or a segment is a point at the start.
    """
    masked = masks(errors)
    given, faults = _read(points, firsts, lasts, velocities, masked=masked)
    m = given.shape[1]
    spans = read_spans(time, m)
    contacts = Contacts(m, lambda i: _scene(given[:, i], spans, i))
    given[:, list(faults)] = APART[:, None]
    for first in range(0, m, CHUNK):
        last = min(first + CHUNK, m)
        hits, low, high, unsure = _filtered(given[:, first:last], spans.part(first, last))
        record_edges(contacts, hits + first, low, high)
        for i in (np.flatnonzero(unsure) + first).tolist():
            try:
                _decide(contacts, i, given[:, i], spans)
            except InputError as error:
                if not masked:
                    raise
                contacts.refuse(i, str(error))
    for i, why in faults.items():
        contacts.refuse(i, why)
    return contacts


def _read(
    points: ArrayLike,
    firsts: ArrayLike,
    lasts: ArrayLike,
    velocities: Sequence[ArrayLike | None],
    *,
    masked: bool,
) -> tuple[Floats, dict[int, str]]:
    """Return twelve rows: x and y of the point and the segment's ends, and of their velocities.

    The second value has the queries with numbers that are not finite, if they are masked.
    """
    if len(velocities) != 3:
        raise InputError(f"velocities: three arrays are needed, not {len(velocities)}")
    names = ("points", "firsts", "lasts", *(f"velocities[{k}]" for k in range(3)))
    arrays = (points, firsts, lasts, *velocities)
    faults: dict[int, str] = {}

    def rows(array: ArrayLike, name: str) -> Floats:
        if not masked:
            return doubles(array, name)
        read, wrong = finite_rows(array, name)
        faults.update({k: why for k, why in wrong.items() if k not in faults})
        return read

    read = [None if a is None else rows(a, n) for a, n in zip(arrays, names, strict=True)]
    m = len(read[0]) if read[0] is not None and read[0].ndim else 0
    given = np.zeros((12, m))
    for k, (array, name) in enumerate(zip(read, names, strict=True)):
        if array is not None:
            if array.shape != (m, 2):
                raise InputError(f"{name}: shape ({m}, 2) is needed, not {array.shape}")
            given[2 * k : 2 * k + 2] = array.T
        elif k < 3:
            raise InputError(f"{name}: shape ({m}, 2) is needed, not None")
    return given, faults


@np.errstate(all="ignore")
def _filtered(g: Floats, spans: Spans) -> tuple[Indices, Floats, Floats, Flags]:
    """Return the contacts with enclosures of their times, and the undecided queries."""
    px, py, ax, ay, bx, by, vpx, vpy, vax, vay, vbx, vby = g
    u = (bx - ax, by - ay), (vbx - vax, vby - vay)
    w = (px - ax, py - ay), (vpx - vax, vpy - vay)
    turning = (u[1][0] != 0.0) | (u[1][1] != 0.0)
    off_u = off_w = None
    if spans.shifted:
        (u0, off_u), (w0, off_w) = _moved(*u, spans.start), _moved(*w, spans.start)
        u, w = (u0, u[1]), (w0, w[1])
    if turning.any():
        r = Relative(u, w, (off_u, None), (off_w, None), None)
    else:
        r = Relative(u[:1], w, (off_u,), (off_w, None), None)
    low, high = first_incidences(r, spans.length)
    unsure = (low < INFINITY) & (high == INFINITY)
    unsure |= ~turning & (u[0][0] == 0.0) & (u[0][1] == 0.0)
    if len(r.u) == 2:
        turns = np.flatnonzero(turning)
        some = r if len(turns) == len(turning) else r.take(turns)
        unsure[turns[_may_shrink(some, spans.length.take(turns))]] = True
    hits = np.flatnonzero((high < INFINITY) & ~unsure)
    cs = orientations(r.take(hits))
    precise = _exact_relative(g[:, hits], turning=len(r.u) == 2)
    low, high = sharpened(precise, cs, spans.start[hits], low[hits], high[hits])
    return hits, low, high, unsure


def _exact_relative(g: Floats, *, turning: bool) -> ExactRelative:
    """Return the given queries without rounding."""
    p, a, b, vp, va, vb = ((g[k], g[k + 1]) for k in range(0, 12, 2))
    u, w, du, dw = (
        (exact_difference(f[0], h[0]), exact_difference(f[1], h[1]))
        for f, h in ((b, a), (p, a), (vb, va), (vp, va))
    )
    return ExactRelative((u, du) if turning else (u,), (w, dw), None)


def _moved(
    f0: tuple[Floats, Floats], f1: tuple[Floats, Floats], t: Floats
) -> tuple[tuple[Floats, Floats], Floats]:
    """f0 + f1 t, and a bound on the absolute error in x and in y; 0 where f1 is 0.

    The relative errors of f0 and f1 are at most U, so that of the product at most 2 U, and that
    of the sum one more.
    """
    x, y = f1[0] * t, f1[1] * t
    size = np.abs(f0[0]) + np.abs(f0[1]) + (np.abs(x) + np.abs(y))
    still = (t == 0.0) | ((f1[0] == 0.0) & (f1[1] == 0.0))
    return (f0[0] + x, f0[1] + y), np.where(still, 0.0, 4.0 * U * size * SLACK + TINY)


def _may_shrink(r: Relative, span: Span) -> Flags:
    """Return True if a segment that turns may be a point at some time.

    If b - a vanishes at a time, then u0 x u1 = 0. Otherwise it does not if one of its coordinates
    keeps its sign.
    """
    (ux, uy), (vx, vy) = r.u
    off = r.off_u[0]
    error = 0.0 if off is None else off
    p, q = ux * vy, uy * vx
    bound = 8.0 * U * (np.abs(p) + np.abs(q)) + error * (np.abs(vx) + np.abs(vy)) * SLACK + TINY
    may: Flags = ~(np.abs(p - q) > bound)
    left = np.flatnonzero(may)
    if len(left):
        steady = np.zeros(len(left), dtype=np.bool_)
        off_left = error if off is None else off[left]
        for c, v in ((ux[left], vx[left]), (uy[left], vy[left])):
            size = np.abs(c) * (1.0 - 4.0 * U) - off_left
            moved = np.abs(v) * span.high[left] * (1.0 + 4.0 * U) + TINY
            steady |= (size > moved) | ((size > 0.0) & ((c > 0.0) == (v > 0.0)))
        may[left[steady]] = False
    return may


def _points(row: Floats) -> list[tuple[tuple[QQ, QQ], tuple[QQ, QQ]]]:
    """Return the coefficients in x and in y of the point and of the segment's ends."""
    q = [of_double(c) for c in row.tolist()]
    return [((q[k], q[k + 6]), (q[k + 1], q[k + 7])) for k in (0, 2, 4)]


def _decide(contacts: Contacts, i: int, row: Floats, spans: Spans) -> None:
    """Decide one query exactly: when the point is on the segment, or on it shrunken to a point."""
    p, a, b = (translated(x, y) for x, y in _points(row))
    start, end = (of_double(float(s[i])) for s in (spans.start, spans.end))
    begin = AlgebraicNumber(start)
    if coincide(a, b, begin):
        raise InputError(f"query {i}: the segment is a point at the start, t = {show(start)}")
    first: Earliest[Incidence] = Earliest()
    shrunk = FeaturePair(Incidence(1, 0, 1, -1, 1), a, (b,))
    if lies_on(p, a, b, begin):
        first.add(begin, ())
    else:
        for pair in (FeaturePair(Incidence(0, 0, 1, 0, -1), p, (a, b)), shrunk):
            time = pair.first_time(QQ(0), begin, end)
            if time is not None:
                first.add(time, ())
    time, touches = first.number, []
    if time is not None and lies_on(p, a, b, time):
        ends = [Incidence(0, 0, 1, -1, k) for k, c in enumerate((a, b)) if coincide(p, c, time)]
        touches += ends or [Incidence(0, 0, 1, 0, -1)]
    if time is not None and coincide(a, b, time):
        touches.append(shrunk.touch)
    record(contacts, i, time, touches, initial=time is begin)


def _scene(row: Floats, spans: Spans, i: int) -> Scene:
    """Return the scene of a query."""
    p, *ends = ({"x": x, "y": y} for x, y in _points(row))
    point, segment = Body("point", [p]), Body("segment", ends)
    return Scene([point, segment], (float(spans.start[i]), float(spans.end[i])))
