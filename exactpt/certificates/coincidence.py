"""Positions at the current time itself: order along a line, coincidence.

They are unperturbed, and those at the time of an event, not just after it: they decide
which vertex lies between which, and whether there is a contact.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np

from exactpt.certificates.reasons import reason
from exactpt.filters.rounding import U
from exactpt.geometry.boxes import Boxes, widen_unknown
from exactpt.kernel.integer_polynomial import add, multiply, subtract
from exactpt.motion import track
from exactpt.motion.track import difference

if TYPE_CHECKING:
    from exactpt.certificates.certifier import Certifier
    from exactpt.motion.vertex import Vertex


def coordinate_order(certifier: Certifier, a: Vertex, b: Vertex, axis: int) -> int:
    """Return the sign of x(b) - x(a) (axis 0) or of y(b) - y(a) (axis 1) at the current time."""
    if a.is_copy_of(b):
        return 0
    s = _filtered_order(certifier, a, b, axis)
    if s:
        return s
    p, q = a.track, b.track
    f = difference(p.y, p.w, q.y, q.w) if axis else difference(p.x, p.w, q.x, q.w)
    s = certifier.exact_now.sign_of(f) if f else 0
    why = reason(a, b, is_zero=s == 0, exact_only=certifier.exact_only)
    certifier.counters.count_exact("place", why)
    return s


def _filtered_order(certifier: Certifier, a: Vertex, b: Vertex, axis: int) -> int:
    """`coordinate_order` if doubles decide that it is not 0; else 0."""
    if certifier.exact_only:
        return 0
    s = certifier.positions.order(a, b, axis)
    certifier.counters.filtered += s != 0
    return s


def boxes_now(certifier: Certifier, vertices: Sequence[Vertex]) -> Boxes:
    """Boxes that contain the positions now, normalised."""
    boxes = np.empty((len(vertices), 4))
    for i, vertex in enumerate(vertices):
        certifier.positions.find(vertex)
        x, y, error = vertex.x, vertex.y, vertex.error
        dx, dy = error + 4.0 * U * abs(x), error + 4.0 * U * abs(y)
        boxes[i] = (x - dx, x + dx, y - dy, y + dy)
    widen_unknown(boxes)  # those of positions out of the range of doubles
    return boxes


def coincide(certifier: Certifier, a: Vertex, b: Vertex) -> bool:
    """Return True if two vertices coincide now."""
    if a.is_copy_of(b):
        return True
    # Doubles are tried on both axes first, as in `nearer`.
    if _filtered_order(certifier, a, b, 0) or _filtered_order(certifier, a, b, 1):
        return False
    return coordinate_order(certifier, a, b, 0) == 0 and coordinate_order(certifier, a, b, 1) == 0


def nearer(certifier: Certifier, p: Vertex, a: Vertex, b: Vertex) -> int:
    """For a and b in the same direction from p: 1 if a is nearer, -1 if b is, 0 if they coincide.

    Infinitesimal copies of one vertex coincide here, p included.
    """
    # Any axis decides to which the line is not perpendicular. Doubles are tried on both axes
    # first: on a vertical line, equal x coordinates would be proved by exact arithmetic.
    for axis in (0, 1):
        pa = _filtered_order(certifier, p, a, axis)
        ab = _filtered_order(certifier, a, b, axis) if pa else 0
        if ab:
            return 1 if pa == ab else -1
    for axis in (0, 1):
        pa = coordinate_order(certifier, p, a, axis)
        ab = coordinate_order(certifier, a, b, axis)
        if pa and ab:
            return 1 if pa == ab else -1
        if ab:  # a coincides with p: nothing is nearer
            return 1
    return 0


def nearer_copy(certifier: Certifier, p: Vertex, a: Vertex, b: Vertex) -> int:
    """Return the order of `nearer` for two infinitesimal copies a and b of one vertex."""
    if a.offset is None or b.offset is None or not a.is_copy_of(b):
        return 0
    (ax, ay), (bx, by) = a.offset, b.offset
    t, o = a.track, p.track
    # (a - b) . (p - a) > 0: a is displaced further towards p.
    f = add(
        multiply(subtract(ax, bx), difference(t.x, t.w, o.x, o.w)),
        multiply(subtract(ay, by), difference(t.y, t.w, o.y, o.w)),
    )
    return certifier.exact_now.sign_of(f)


def strictly_between(certifier: Certifier, a: Vertex, p: Vertex, b: Vertex) -> bool:
    """Return True if p lies strictly between a and b, for three collinear vertices.

    Of two infinitesimal copies of one vertex, the one displaced towards the third vertex
    lies between.
    """
    if a.is_copy_of(p):
        return nearer_copy(certifier, b, p, a) > 0
    if p.is_copy_of(b):
        return nearer_copy(certifier, a, p, b) > 0
    for axis in (0, 1):  # by doubles first, as in `nearer`
        ap = _filtered_order(certifier, a, p, axis)
        pb = _filtered_order(certifier, p, b, axis) if ap else 0
        if pb:
            return ap == pb
    for axis in (0, 1):
        ap = coordinate_order(certifier, a, p, axis)
        if ap:
            return ap == coordinate_order(certifier, p, b, axis)
    return False


def lies_on(certifier: Certifier, v: Vertex, a: Vertex, b: Vertex) -> bool:
    """Return True if v lies in the closed segment ab now."""
    for order in (_filtered_order, coordinate_order):  # by doubles first, as in `nearer`
        for axis in (0, 1):
            if order(certifier, a, v, axis) * order(certifier, v, b, axis) < 0:
                return False
    if coincide(certifier, v, a) or coincide(certifier, v, b):
        return True
    is_on = track.lies_on(v.track, a.track, b.track, certifier.exact_now)
    why = reason(v, a, b, is_zero=is_on, exact_only=certifier.exact_only)
    certifier.counters.count_exact("contact", why)
    return is_on
