"""Exact orientation and x-order of moving vertices, under a symbolic perturbation.

**One symbolic perturbation** resolves all permanent degeneracies (functions that are zero
for all times). It is infinitesimal and has two steps, the second smaller than every positive
power of the first:

1. The plane is turned clockwise by rho. So of two vertices with equal x for all times the
   upper one is the left one: points are ordered by (x, -y), and a vertical direction is
   the steepest descent, not the steepest ascent.
2. Every vertex v of the scene is inflated to a disc of radius eps * (1 - kappa |v|^2),
   kappa infinitesimal again, and every body to the hull of its discs. So points and
   segments have an interior too. (The rings of degenerate bodies have several copies of a
   vertex, see `exactpt.motion.infinitesimal`: its disc is divided among them, by direction.)

Proof that step 2 decides three vertices a, m, b of the scene that are collinear for all times, m
between a and b: the radius is a strictly concave function along the line, so the disc of
m sticks out of the hull of the discs of a and b on either side. So the free edge from a
to b is hit by m, whichever sides its ends are tangent to; an angle of exactly pi at m in a
free face is reflex; and a corner of angle 0 at a, between m and b, has collapsed. In each
of these cases the orientation (previous, here, next) around a free face counts as
*negative*: **zero counts as -1**. The code uses nothing else of step 2.

**Properties that the perturbation preserves.** Let g be the function of a
certificate, and g + eps h + ... that of the perturbed vertices.

- Where g is not identically zero, the sign just after a time is that of g, and likewise just
  before: eps is smaller than every time step. So the tilings just before and just after a
  time are those of the scene itself.
- At a zero at which g changes sign, the perturbed function changes sign an odd number of
  times infinitesimally near: once, if the zero is simple. All of it is one event.
- At a zero at which g does *not* change sign, the perturbed function changes sign an even
  number of times infinitesimally near, perhaps never; in between it has the opposite sign.
  Just before and just after, the sign is the same, so the tiling needs no repair. But it is
  not preserved *at* the zero: there the perturbed tiling may differ for an infinitesimal
  time, and the perturbed bodies, which contain the bodies, may overlap.

Hence a zero without a change of sign may be ignored where only the tilings just before and
just after matter (x-orders). It may not be where contacts are sought: the certificates of
the angles of a tiling have an event at *every* zero, those of copies included, and a contact
itself is decided on the unperturbed vertices (`exactpt.certificates.incidences`,
`exactpt.motion.track`).
"""

from __future__ import annotations

from collections.abc import Iterator

from exactpt.kernel.algebraic import AlgebraicNumber
from exactpt.kernel.integer_polynomial import (
    IntPoly,
    add,
    coefficient_bits,
    multiply,
    negate,
    pack,
    scale,
    subtract,
    unpack,
    width_for,
)
from exactpt.kernel.numbers import ZZ
from exactpt.motion.track import Track, difference
from exactpt.motion.track import orientation_polynomial as base_orientation
from exactpt.motion.vertex import Vertex


def cross(a: Track, b: Track, c: Track, d: Track) -> IntPoly:
    """Return a positive multiple of (b - a) x (d - c)."""
    length = a.length + b.length + c.length + d.length - 3
    width = width_for(a.bits + b.bits + c.bits + d.bits, length, 4)
    ax, ay, aw = a.packed(width)
    bx, by, bw = b.packed(width)
    cx, cy, cw = c.packed(width)
    dx, dy, dw = d.packed(width)
    f = (bx * aw - ax * bw) * (dy * cw - cy * dw) - (by * aw - ay * bw) * (dx * cw - cx * dw)
    return unpack(f, width, length)


def copies_first(a: Vertex, b: Vertex, c: Vertex) -> tuple[Vertex, Vertex, Vertex]:
    """Three vertices, rotated so that the first two are copies of one, if any two are."""
    if a.is_copy_of(c) and not b.is_copy_of(c):
        return c, a, b
    if b.is_copy_of(c) and not a.is_copy_of(c):
        return b, c, a
    return a, b, c


def copy_orientation(a: Vertex, b: Vertex, c: Vertex) -> IntPoly:
    """Return the orientation of three vertices of which two or all are copies of one.

    With two copies it is (offset(b) - offset(a)) x (c - a), in the limit of small
    displacements; with three, the orientation of their displacements.
    """
    a, b, c = copies_first(a, b, c)
    p, q = a.track, c.track
    dx, dy = _offset_difference(a, b)
    if a.is_copy_of(c):
        ex, ey = _offset_difference(a, c)
        return subtract(multiply(dx, ey), multiply(dy, ex))
    length = max(len(dx), len(dy), 1) + p.length + q.length - 2
    width = width_for(coefficient_bits(dx, dy) + p.bits + q.bits, length, 3)
    px, py, pw = p.packed(width)
    qx, qy, qw = q.packed(width)
    f = pack(dx, width) * (qy * pw - py * qw) - pack(dy, width) * (qx * pw - px * qw)
    return unpack(f, width, length)


def _offset_difference(a: Vertex, b: Vertex) -> tuple[IntPoly, IntPoly]:
    zero: tuple[IntPoly, IntPoly] = ((), ())
    (ax, ay), (bx, by) = a.offset or zero, b.offset or zero
    return subtract(bx, ax), subtract(by, ay)


def orientation_polynomial(a: Vertex, b: Vertex, c: Vertex) -> IntPoly:
    """Return a function with the sign of the orientation; ``()``, if always 0, counts as -1."""
    if a.is_copy_of(b) or b.is_copy_of(c) or c.is_copy_of(a):
        return copy_orientation(a, b, c)
    return base_orientation(a.track, b.track, c.track)


def x_order_terms(a: Vertex, b: Vertex) -> Iterator[IntPoly]:
    """Yield the terms of a function that is positive while a is left of b, the largest first.

    They are x(b) - x(a); then y(a) - y(b), by step 1; then the same for the displacements.
    """
    yield difference(a.track.x, a.track.w, b.track.x, b.track.w)
    yield difference(b.track.y, b.track.w, a.track.y, a.track.w)
    dx, dy = _offset_difference(a, b)
    yield dx
    yield negate(dy)


def x_order(a: Vertex, b: Vertex) -> IntPoly:
    """Return the first of the `x_order_terms` that is not identically zero."""
    return next((f for f in x_order_terms(a, b) if f), ())


def comes_first(
    p: tuple[Vertex, Vertex, Vertex],
    sign_p: int,
    q: tuple[Vertex, Vertex, Vertex],
    sign_q: int,
    t: AlgebraicNumber,
) -> bool:
    """Return True if the copies p become collinear before the copies q do.

    Both are copies of the same three vertices of the scene, in orders that may differ; their
    orientation F vanishes at t and changes to sign_p and sign_q. With the displacements it is
    F + eta g + ..., which vanishes where sign * F, increasing, equals -sign * eta * g: the
    copies with the smaller -sign * g come first.
    """
    f = scale(_offset_term(*p), ZZ(sign_p))
    g = scale(_offset_term(*q), ZZ(sign_q))
    return t.sign_of(subtract(f, g)) > 0


def _offset_term(a: Vertex, b: Vertex, c: Vertex) -> IntPoly:
    """Return the coefficient of eta in the orientation of three vertices displaced by eta * offset.

    Row (x, y, w) of the determinant becomes (x + eta dx w, y + eta dy w, w).
    """
    total: IntPoly = ()
    for u, v, w in ((a, b, c), (b, c, a), (c, a, b)):
        if u.offset is not None:
            (dx, dy), p, q = u.offset, v.track, w.track
            along_x = multiply(dx, difference(q.y, q.w, p.y, p.w))
            along_y = multiply(dy, difference(q.x, q.w, p.x, p.w))
            total = add(total, multiply(subtract(along_x, along_y), u.track.w))
    return total
