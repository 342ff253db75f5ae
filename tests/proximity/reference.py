"""When bodies meet, and how near they are, from the definition.

It shares nothing with `exactpt.proximity` but the kernel, the trajectories and orientations.
"""

from functools import cmp_to_key
from itertools import combinations, pairwise, product

from exactpt.kernel.algebraic import AlgebraicNumber, rational_between
from exactpt.kernel.integer_polynomial import add, multiply, scale, subtract
from exactpt.kernel.numbers import ZZ
from exactpt.kernel.roots import roots_after
from exactpt.motion.incidence import difference, orientation


def pieces(a, b, start, end):
    cuts = {t for body in (a, b) for t in body._breakpoints if start < t < end}
    times = [start, *sorted(cuts), end]
    for begin, until in pairwise(times):
        yield begin, until, a._piece_after(begin).tracks, b._piece_after(begin).tracks


def critical_times(polynomials, begin, until):
    """The distinct roots in (begin, until] of any of the polynomials, and the end."""
    found = [AlgebraicNumber(until)]
    for f in polynomials:
        if f:
            found += [r.time for r in roots_after(f, AlgebraicNumber(begin), until)]
    found.sort(key=cmp_to_key(AlgebraicNumber.compare))
    return [t for k, t in enumerate(found) if not k or found[k - 1].compare(t) < 0]


def edges_of(body):
    return body.edges or [(0, 0)]


def within_box(t, a, b, v):
    """Whether v, on the line ab, is between a and b."""
    for axis in ("x", "y"):
        to_a = t.sign_of(difference(getattr(v, axis), v.w, getattr(a, axis), a.w))
        to_b = t.sign_of(difference(getattr(v, axis), v.w, getattr(b, axis), b.w))
        if to_a * to_b > 0:
            return False
    return True


def on_segment(t, a, b, v):
    return t.sign_of(orientation(a, b, v)) == 0 and within_box(t, a, b, v)


def segments_meet(t, a, b, c, d):
    signs = [t.sign_of(orientation(*o)) for o in ((a, b, c), (a, b, d), (c, d, a), (c, d, b))]
    if signs[0] * signs[1] < 0 and signs[2] * signs[3] < 0:
        return True
    return (
        on_segment(t, a, b, c)
        or on_segment(t, a, b, d)
        or on_segment(t, c, d, a)
        or on_segment(t, c, d, b)
    )


def contains(t, ring, v):
    """By the crossings of a ray to the right; v is on no edge."""
    inside = False
    for a, b in zip(ring, [*ring[1:], ring[0]], strict=True):
        above = [t.sign_of(difference(v.y, v.w, p.y, p.w)) > 0 for p in (a, b)]
        if above[0] != above[1]:
            left = t.sign_of(orientation(a, b, v)) > 0
            inside ^= left == above[1]
    return inside


def meet_at(t, a, b, p, q):
    return (
        any(
            segments_meet(t, p[i], p[j], q[k], q[l])
            for (i, j), (k, l) in product(edges_of(a), edges_of(b))
        )
        or (a.has_interior and contains(t, p, q[0]))
        or (b.has_interior and contains(t, q, p[0]))
    )


def contact_intervals(a, b, start, end):
    """The maximal intervals as pairs of algebraic numbers."""
    states = [(AlgebraicNumber(start), meet_at(AlgebraicNumber(start), a, b, *tracks(a, b, start)))]
    for begin, until, p, q in pieces(a, b, start, end):
        orientations = [orientation(*triple) for triple in combinations([*p, *q], 3)]
        gaps = [
            difference(getattr(u, axis), u.w, getattr(v, axis), v.w)
            for u, v in product(p, q)
            for axis in ("x", "y")
        ]
        for time in critical_times(orientations + gaps, begin, until):
            between = AlgebraicNumber(rational_between(states[-1][0], time))
            states.append((None, meet_at(between, a, b, p, q)))
            states.append((time, meet_at(time, a, b, p, q)))
    found, since, last = [], None, None
    for time, meets in states:
        if time is not None:
            if meets:
                since = since or time
                last = time
        elif not meets and since is not None:
            found.append((since, last))
            since = None
    if since is not None:
        found.append((since, last))
    return found


def tracks(a, b, t):
    return a._piece_after(t).tracks, b._piece_after(t).tracks


def gap(u, v):
    """(x, y) of v - u, times w_u w_v."""
    return difference(u.x, u.w, v.x, v.w), difference(u.y, u.w, v.y, v.w)


def dot(e, f):
    return add(multiply(e[0], f[0]), multiply(e[1], f[1]))


def cross(e, f):
    return subtract(multiply(e[0], f[1]), multiply(e[1], f[0]))


def excess_of_vertices(u, v, s):
    """Positive where the squared distance of u and v is more than s."""
    w = multiply(u.w, v.w)
    return less(dot(gap(u, v), gap(u, v)), multiply(w, w), s)


def excess_of_line(v, a, b, s):
    """Positive where the squared distance of v from the line ab is more than s."""
    e, f = gap(a, b), gap(a, v)
    w = multiply(a.w, v.w)
    return less(multiply(cross(e, f), cross(e, f)), multiply(multiply(w, w), dot(e, e)), s)


def less(n, d, s):
    return subtract(scale(n, ZZ(s.denominator)), scale(d, ZZ(s.numerator)))


def is_within(t, a, b, p, q, s):
    """Whether the squared distance is at most s at an algebraic time."""
    if meet_at(t, a, b, p, q):
        return True
    if any(t.sign_of(excess_of_vertices(u, v, s)) <= 0 for u, v in product(p, q)):
        return True
    corners = [(v, p[k], p[l]) for v in q for k, l in a.edges]
    corners += [(v, q[k], q[l]) for v in p for k, l in b.edges]
    return any(
        t.sign_of(excess_of_line(v, c, d, s)) <= 0
        and t.sign_of(dot(gap(c, d), gap(c, v))) > 0
        and t.sign_of(dot(gap(d, c), gap(d, v))) > 0
        for v, c, d in corners
    )


def first_within(a, b, start, end, s):
    """The first time at which the squared distance is at most s."""
    now = AlgebraicNumber(start)
    if is_within(now, a, b, *tracks(a, b, start), s):
        return now
    for begin, until, p, q in pieces(a, b, start, end):
        corners = [(v, p[k], p[l]) for v in q for k, l in a.edges]
        corners += [(v, q[k], q[l]) for v in p for k, l in b.edges]
        polynomials = [excess_of_vertices(u, v, s) for u, v in product(p, q)]
        polynomials += [excess_of_line(v, c, d, s) for v, c, d in corners]
        for time in critical_times(polynomials, begin, until):
            if is_within(time, a, b, p, q, s):
                return time
    return None
