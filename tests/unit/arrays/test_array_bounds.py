"""The bounds of the filters, attacked by numbers that cancel, overflow and underflow."""

from fractions import Fraction
from itertools import pairwise, product

import numpy as np
import pytest

from exactpt.arrays import turning
from exactpt.arrays.candidates import all_candidates
from exactpt.arrays.motions import reaches, relative_motions
from exactpt.arrays.outlines import outlines_of
from exactpt.arrays.relative import Relative, orientations, sides
from exactpt.arrays.sharpening import ExactRelative, sharpened
from exactpt.arrays.spans import read_spans
from exactpt.filters.rounding import U
from exactpt.geometry import polygon
from exactpt.geometry.ragged import segments_meet, surely_simple
from exactpt.kernel.double_double import add2, exact_difference, exact_sum, multiply2
from exactpt.kernel.numbers import QQ
from exactpt.scene.body_arrays import BodyArrays


def exact(x):
    return Fraction(float(x))


def hostile(rng, shape):
    """Numbers that nearly are small integers, of one size or of many."""
    near = rng.integers(-3, 4, shape) * (1.0 + rng.integers(-2, 3, shape) * 2.0**-52)
    kind = rng.integers(0, 6, shape[-1])
    sizes = np.where(
        kind == 0, 2.0 ** rng.integers(-1000, 900, shape),
        np.where(kind == 1, 2.0 ** rng.integers(-40, 40, shape), 1.0),
    )  # fmt: skip
    return np.where(kind == 2, rng.uniform(-1.0, 1.0, shape), near * sizes)


def difference(a, b):
    with np.errstate(all="ignore"):
        return a - b


def relative(rows, *, turning):
    """From twelve rows: the relative vertices and edges, and the exact polynomials u and w."""
    px, py, ax, ay, bx, by, vx, vy, wx, wy, zx, zy = rows
    pairs = [((bx, ax), (by, ay)), ((zx, wx), (zy, wy)), ((px, ax), (py, ay)), ((vx, wx), (vy, wy))]
    u0, u1, w0, w1 = [tuple(difference(*pair) for pair in plane) for plane in pairs]
    r = Relative((u0, u1)[: 1 + turning], (w0, w1), (None,) * (1 + turning), (None, None), None)
    planes = [
        [tuple(exact(a[i]) - exact(b[i]) for a, b in plane) for plane in pairs]
        for i in range(rows.shape[1])
    ]
    return r, [(p[: 1 + turning], p[2:]) for p in planes]


def cross(u, w):
    """The coefficients of u x w."""
    found = [Fraction(0)] * (len(u) + len(w) - 1)
    for (i, a), (j, b) in product(enumerate(u), enumerate(w)):
        found[i + j] += a[0] * b[1] - a[1] * b[0]
    return found


def at(f, s):
    return tuple(sum(c[k] * s**n for n, c in enumerate(f)) for k in (0, 1))


@pytest.mark.long
@pytest.mark.parametrize("turning", [False, True])
def test_orientations_are_within_their_bounds(turning):
    r, truths = relative(hostile(np.random.default_rng(1), (12, 4000)), turning=turning)
    with np.errstate(all="ignore"):
        cs = orientations(r)
    closest = 0.0
    for i, truth in enumerate(truths):
        for (value, error), c in zip(cs, cross(*truth), strict=True):
            if np.isfinite(value[i]) and np.isfinite(error[i]):
                off = abs(exact(value[i]) - c)
                assert off <= exact(error[i])
                assert error[i] > 0.0 or c == 0
                if error[i] > 2.0**-400:
                    closest = max(closest, float(off / exact(error[i])))
    assert closest > 0.1


@pytest.mark.long
@pytest.mark.parametrize("turning", [False, True])
def test_a_vertex_is_on_the_side_that_is_sure(turning):
    rng = np.random.default_rng(2)
    rows = hostile(rng, (12, 4000))
    r, truths = relative(rows, turning=turning)
    low = rng.integers(0, 3, 4000) / 4.0
    high = low + rng.choice([0.0, 2.0**-50, 0.25, 1.0], 4000)
    with np.errstate(all="ignore"):
        inside, beside = sides(r, low, high)
    assert inside.sum() > 50
    assert beside.sum() > 500
    for i in np.flatnonzero(inside | beside).tolist():
        for s in (exact(low[i]), exact(high[i]), (exact(low[i]) + exact(high[i])) / 2):
            u, w = (at(f, s) for f in truths[i])
            g = u[0] * w[0] + u[1] * w[1]
            h = u[0] * u[0] + u[1] * u[1] - g
            assert (g > 0 and h > 0) if inside[i] else min(g, h) < 0


def test_a_point_is_surely_not_on_another_where_it_differs():
    zero, one = np.zeros(3), np.ones(3)
    w = (np.array([0.0, 0.0, 1e-30]), np.array([0.0, 2.0**-40, -1.0]))
    r = Relative(((zero, one),), (w,), (None,), (None,), zero)

    inside, beside = sides(r, zero, zero)

    assert not inside.any()
    assert beside.tolist() == [False, True, True]


def test_segments_meet_or_not_where_that_is_sure():
    rng = np.random.default_rng(3)
    ends = hostile(rng, (8, 6000))
    off = np.where(rng.integers(0, 2, 6000), 2.0**-30, 0.0)
    shake = off * rng.choice([-1.0, 0.0, 1.0], (2, 6000))
    ax, ay, bx, by, cx, cy, dx, dy = ends
    p = [difference(cx, ax) + shake[0], difference(cy, ay) + shake[1]]
    u, v = (difference(bx, ax), difference(by, ay)), (difference(dx, cx), difference(dy, cy))

    apart, crossing = segments_meet(u, v, tuple(p), off + np.abs(p[0] * U) + np.abs(p[1] * U))

    assert not (apart & crossing).any()
    assert min(apart.sum(), crossing.sum()) > 300
    for i in np.flatnonzero(apart | crossing).tolist():
        a, b, c, d = [(QQ(exact(x[i])), QQ(exact(y[i]))) for x, y in ends.reshape(4, 2, -1)]
        assert polygon.segments_meet(a, b, c, d) == crossing[i]


@pytest.mark.long
def test_sums_and_products_of_twice_the_precision():
    rng = np.random.default_rng(4)
    a, b, c, d = rng.uniform(-1.0, 1.0, (4, 3000)) * 2.0 ** rng.integers(-60, 60, (4, 3000))
    x, y = exact_sum(a, b * 2.0**-50), exact_difference(c, d * 2.0**-52)
    total, product_ = add2(x, y), multiply2(x, y)
    for i in range(3000):
        p, q = (exact(z[0][i]) + exact(z[1][i]) for z in (x, y))
        assert p == exact(a[i]) + exact(b[i] * 2.0**-50)
        assert q == exact(c[i]) - exact(d[i] * 2.0**-52)
        sum_, of_both = (exact(z[0][i]) + exact(z[1][i]) for z in (total, product_))
        assert abs(sum_ - (p + q)) <= 4 * exact(U) ** 2 * (abs(p) + abs(q))
        assert abs(of_both - p * q) <= 10 * exact(U) ** 2 * abs(p * q)


@pytest.mark.long
def test_motions_and_their_reach_are_within_their_bounds():
    rng = np.random.default_rng(5)
    n, m, degree = 60, 500, 3
    coefficients = hostile(rng, (n * 2, degree + 1)).reshape(n, 2, degree + 1)
    spans = read_spans(np.array([(t, t + 2.0) for t in rng.integers(-3, 4, m) / 3.0]), m)
    i, j = rng.integers(0, n, m), rng.integers(0, n, m)

    motions = relative_motions(coefficients, i, j, spans)
    with np.errstate(all="ignore"):
        least, most, error = reaches(motions, spans.length.high)

    for k in range(m):
        start, length = exact(spans.start[k]), exact(spans.end[k]) - exact(spans.start[k])
        for axis in (0, 1):
            both = coefficients[i[k], axis], coefficients[j[k], axis]
            c = [exact(x) - exact(y) for x, y in zip(*both, strict=True)]
            shifted = [
                sum(c[n] * _binomial(n, e) * start ** (n - e) for n in range(e, degree + 1))
                for e in range(degree + 1)
            ]
            for e in range(degree + 1):
                if np.isfinite(motions.off[k, e]):
                    off = abs(exact(motions.coefficients[k, axis, e]) - shifted[e])
                    assert off <= exact(motions.off[k, e])
            if np.isfinite(error[k, axis]):
                for s in (0, length / 3, length):
                    place = sum(f * s**e for e, f in enumerate(shifted))
                    assert exact(least[k, axis]) - exact(error[k, axis]) <= place
                    assert place <= exact(most[k, axis]) + exact(error[k, axis])


def _binomial(n, k):
    return 1 if k in (0, n) else _binomial(n - 1, k - 1) + _binomial(n - 1, k)


@pytest.mark.long
@pytest.mark.parametrize("turning", [False, True])
@pytest.mark.parametrize("start", [0.0, 2.5])
def test_sharpened_enclosures_hold_the_zero(turning, start):
    """From wide enclosures around planted zeros, whatever the conditioning."""
    rng = np.random.default_rng(6)
    m = 1500
    rows = rng.uniform(-1.0, 1.0, (12, m))
    rows[:2] = rows[2:4] + (rows[4:6] - rows[2:4]) * rng.uniform(0.1, 0.9, m)
    rows[10:] = rows[10:] if turning else rows[8:10]
    zero = rng.uniform(0.1, 0.9, m)
    rows[:6] -= rows[6:] * (zero + start)
    _, truths = relative(rows, turning=turning)
    polynomials = [cross(*(_from(f, exact(start)) for f in truth)) for truth in truths]
    values = [np.array([float(f[k]) for f in polynomials]) for k in range(2 + turning)]
    wide = zero * rng.uniform(2.0**-45, 2.0**-30, m)
    p, a, b, vp, va, vb = rows.reshape(6, 2, m)
    u, du, w, dw = (
        (exact_difference(x[0], y[0]), exact_difference(x[1], y[1]))
        for x, y in ((b, a), (vb, va), (p, a), (vp, va))
    )
    precise = ExactRelative((u, du)[: 1 + turning], (w, dw), None)
    cs = [(value, np.abs(value) * 2.0**-40) for value in values]

    low, high = sharpened(precise, cs, np.full(m, start), zero - wide, zero + wide)

    tight = 0
    for i, f in enumerate(polynomials):
        ends = [exact(low[i]) - exact(start), exact(high[i]) - exact(start)]
        outer = [exact(zero[i] - wide[i]), exact(zero[i] + wide[i])]
        if sign_change(f, outer) < 0:  # there is one zero in the wide enclosure
            assert sign_change(f, ends) <= 0
            tight += high[i] <= np.nextafter(np.nextafter(low[i], 9.0), 9.0)
    assert tight > 0.9 * m


def _from(f, start):
    """The polynomials in s = t - start."""
    return [tuple(x + start * y for x, y in zip(*f, strict=True)), f[1]] if len(f) == 2 else f


def sign_change(f, ends):
    a, b = (sum(c * s**n for n, c in enumerate(f)) for s in ends)
    return (a * b > 0) - (a * b < 0)


@pytest.mark.long
def test_what_surely_is_simple_is_simple():
    rng = np.random.default_rng(7)
    sure = simple = 0
    for _ in range(3000):
        k, closed = int(rng.integers(1, 8)), bool(rng.integers(0, 3))
        points = rng.integers(-3, 4, (k, 2)) / 1.0 if rng.integers(0, 2) else rng.random((k, 2))
        found = surely_simple(points, np.array([0, k]), np.array([closed]))[0]
        places = [(QQ(exact(x)), QQ(exact(y))) for x, y in points]
        truth = polygon.first_self_touch(places, closed=closed)
        assert truth is None or not found
        sure += bool(found)
        simple += truth is None
    assert 0.95 * simple < sure <= simple


def test_a_star_that_turns_twice_is_not_convex():
    turns = np.exp(4j * np.pi * np.arange(5) / 5)
    star = np.stack((turns.real, turns.imag), axis=1)

    assert surely_simple(star, np.array([0, 5]), np.array([True])).tolist() == [False]
    assert surely_simple(star[::2], np.array([0, 3]), np.array([True])).tolist() == [True]


def times(x, y):
    """The product of two complex numbers."""
    return x[0] * y[0] - x[1] * y[1], x[0] * y[1] + x[1] * y[0]


def minus(x, y):
    return x[0] - y[0], x[1] - y[1]


def conjugate(x):
    return x[0], -x[1]


def at_time(turn, path, t):
    """a, and the place of the pivot."""
    h0, h1, px, py = turn[:4]
    x, y = (sum(c * t**k for k, c in enumerate(axis)) for axis in path)
    return (Fraction(1), h0 + h1 * t), (px + x, py + y)


def beside(vertex, edge, mine, other, t):
    """f, g and h of a vertex at a time, by the definition of the motions."""
    (turn, path), (turned, course) = mine, other
    (a, c), (b, d) = at_time(turn, path, t), at_time(turned, course, t)

    def placed(p, turn):
        return times(minus(p, turn[2:4]), turn[4:])

    weight = times(a, conjugate(a))[0], times(b, conjugate(b))[0]
    q = times(times(a, a), placed(vertex, turn))
    out = (q[0] / weight[0] + c[0] - d[0], q[1] / weight[0] + c[1] - d[1])
    seen = times(times(conjugate(b), conjugate(b)), out)
    p, end = (placed(e, turned) for e in edge)
    u = minus(end, p)
    along, across = times(conjugate(u), minus((seen[0] / weight[1], seen[1] / weight[1]), p))
    w = weight[0] * weight[1]
    return w * across, w * along, w * ((u[0] ** 2 + u[1] ** 2) - along)


def bernstein(f, s):
    """The value at s of the polynomial with these Bernstein coefficients."""
    while len(f) > 1:
        f = [(1 - s) * a + s * b for a, b in pairwise(f)]
    return f[0]


@pytest.mark.parametrize("seed", range(4))
def test_polynomials_of_bodies_that_turn_are_within_their_bounds(seed):
    """The exact numbers are off the doubles by half a distance of doubles; time is halved often."""
    rng = np.random.default_rng(seed)
    n = 4
    points, turns, coefficients = (
        rng.integers(-3, 4, shape) * 2.0 ** rng.integers(-3, 4, shape)
        + rng.integers(-2, 3, shape) * 2.0**-49
        for shape in ((4 * n, 2), (2 * n, 6), (2 * n, 2, 3))
    )
    turns[:, 4:] = [[(1, 0), (0, -1), (-1, 0)][k] for k in rng.integers(0, 3, 2 * n)]
    bodies = BodyArrays(points, 2 * np.arange(2 * n + 1), coefficients=coefficients)
    starts = rng.choice([0.0, -1.0, 0.3], n)
    spans = read_spans(np.stack((starts, starts + rng.choice([1.0, 9.0], n)), axis=1), n)
    outlines, (places, radii) = outlines_of(bodies), turning._places_of(bodies, turns)
    poses = turning._poses_of(bodies, turns, spans)
    candidates, _ = all_candidates(outlines, *np.arange(2 * n).reshape(-1, 2).T)
    found, error = turning._polynomials(outlines, poses, candidates, places, radii)

    off = [1 + Fraction(int(k), 2**54) for k in rng.integers(-1, 2, 7)]
    moved = [[exact(c) * off[k % 7] for k, c in enumerate(row)] for row in turns[:, :4].tolist()]
    moved = [[*row, *map(exact, of)] for row, of in zip(moved, turns[:, 4:].tolist(), strict=True)]
    paths = [[[exact(c) * off[4] for c in axis] for axis in body] for body in coefficients.tolist()]
    at = [tuple(exact(c) * off[k % 7] for c in row) for k, row in enumerate(points.tolist())]
    parts = [(found, Fraction(0), Fraction(1))]
    for k in range(8):
        halves, low, width = parts[-1]
        halves = turning._halved(halves)
        second = k % 3 == 0
        kept = halves[:, :, len(error) :] if second else halves[:, :, : len(error)]
        parts.append((kept, low + second * width / 2, width / 2))
    large = 0
    for r, (pair, second, v, e, _) in enumerate(
        zip(*map(np.ndarray.tolist, candidates), strict=True)
    ):
        mine, other = (2 * pair + (second ^ k) for k in (0, 1))
        edge = [at[outlines.edges.first[e]], at[outlines.edges.last[e]]]
        sides_of = [(moved[k], paths[k]) for k in (mine, other)]
        end = exact(poses.start[pair] + poses.length[pair])
        for f, low, width in (parts[0], parts[-1]):
            for s in (Fraction(0), Fraction(1, 3), Fraction(1)):
                t = exact(poses.start[pair]) + (low + s * width) * (end - exact(poses.start[pair]))
                truth = beside(at[v], edge, *sides_of, t)
                near = [bernstein(list(map(exact, row)), s) for row in f[:, :, r].T]
                assert all(abs(a - b) <= exact(error[r]) for a, b in zip(near, truth, strict=True))
                large += any(abs(a) > error[r] for a in truth)
    assert large > 2 * len(error)
