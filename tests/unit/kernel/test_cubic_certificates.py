"""Certificates of cubic motion, from the float tracks of three points to the result."""

import math
import random
from collections import Counter

import pytest

from exactpt.certificates import coefficients
from exactpt.kernel.numbers import QQ, enclosing_floats, nearest_float, power_of_two, rational
from exactpt.motion.float_track import FloatTrack
from fuzz.filter_attacks import asked, judge, times

STYLES = ["free", "collinear", "together", "falling", "sparse", "near"]


def hostile_points(rng):
    """Three paths of degree 2 or 3, their float tracks, and bounds on the errors of these."""
    d, grid = rng.choice([2, 3, 3]), rng.choice([2, 4, 1000, 2**26])
    thirds = rng.choice([[1], [1, 1, 3]])

    def path():
        return [QQ(rng.randint(-grid, grid), rng.choice(thirds)) for _ in range(d + 1)]

    style, motions = rng.choice(STYLES), [0, 1, 2]
    a, b, c = points = [(path(), path()) for _ in range(3)]
    if style == "collinear":  # c = a + k (b - a), and a grain
        k = QQ(rng.randint(-3, 3), 2)
        for i in (0, 1):
            c[i][:] = [p + k * (q - p) for p, q in zip(a[i], b[i], strict=True)]
        c[0][0] += rng.choice([QQ(0), power_of_two(-40), power_of_two(-52)])
    elif style == "together":
        for i in (0, 1):
            b[i][1:] = a[i][1:]
        motions[1] = 0
    elif style == "falling":
        for i in (0, 1):
            b[i][2:] = c[i][2:] = a[i][2:]
    elif style == "sparse":
        for coordinates in (a, b, c):
            for f in coordinates:
                f[rng.randint(0, d)] = QQ(0)
    elif style == "near":  # differences far smaller than coordinates
        for i in (0, 1):
            for k in range(d + 1):
                b[i][k] = a[i][k] + b[i][k] * power_of_two(-30)
                c[i][k] = a[i][k] + c[i][k] * power_of_two(-30)
    order = rng.sample(range(3), 3)
    points, motions = [points[i] for i in order], [motions[i] for i in order]
    size = power_of_two(rng.choice([0, 0, rng.randint(-60, 60)]))
    points = [tuple([x * size for x in f] for f in point) for point in points]
    float_tracks, errors = [], [0.0, 0.0, *[0.0] * (d - 1)]
    for point, motion in zip(points, motions, strict=True):
        floats = [[nearest_float(x) for x in f] for f in point]
        float_tracks.append(FloatTrack(*floats, [], motion))
        for f, xs in zip(point, floats, strict=True):
            for i, (q, x) in enumerate(zip(f, xs, strict=True)):
                errors[i] = max(errors[i], enclosing_floats(abs(q - rational(x)))[1])
    return style, points, float_tracks, errors


def orientation(points):
    u, v = (
        [[q - p for p, q in zip(points[0][i], point[i], strict=True)] for i in (0, 1)]
        for point in points[1:]
    )
    return [p - q for p, q in zip(times(u[0], v[1]), times(u[1], v[0]), strict=True)]


def attack(seed, cases):
    """What was decided wrongly; how many were decided, by style and question."""
    rng, wrong, decided = random.Random(seed), [], Counter()
    for _ in range(cases):
        style, points, float_tracks, errors = hostile_points(rng)
        roots = [QQ(rng.randint(-4, 4), rng.randint(1, 4))]
        if rng.random() < 0.7:
            function, ask = orientation(points), coefficients.orientation
        else:
            points, float_tracks = points[:2], float_tracks[:2]
            function = [q - p for p, q in zip(points[0][0], points[1][0], strict=True)]
            ask = coefficients.x_difference
        case = asked(rng, function, roots, (), ())
        now = case.now_low, case.now_high, case.horizon, case.at_root
        said = ask(*float_tracks, errors, *now)
        decided[style, len(float_tracks)] += said[0] != 0
        if said[0] and (not any(function) or judge(case, said)):
            wrong.append((points, case, said))
    return wrong, decided


@pytest.mark.long
@pytest.mark.parametrize("seed", range(4))
def test_no_certificate_is_decided_wrongly(seed):
    wrong, decided = attack(seed, 1_000)

    assert wrong == []
    assert all(decided[style, 2] > 5 for style in STYLES)
    assert all(decided[style, 3] > 10 for style in STYLES)


@pytest.mark.slow
@pytest.mark.parametrize("seed", range(100, 105))
def test_none_of_50_000_certificates_is_decided_wrongly(seed):
    wrong, decided = attack(seed, 10_000)

    assert wrong == []
    assert decided.total() > 4_000


def test_points_in_free_fall_are_asked_a_quadratic_equation():
    """One acceleration for all three: 11 - 21 t + 9 t^2."""
    a = FloatTrack([0.0, 1.0, 0.0], [0.0, 2.0, -5.0], [], 0)
    b = FloatTrack([3.0, -1.0, 0.0], [1.0, 1.0, -5.0], [], 1)
    c = FloatTrack([1.0, 0.0, 0.0], [4.0, -3.0, -5.0], [], 2)

    s, low, high = coefficients.orientation(a, b, c, [0.0] * 3, 0.0, 0.0, 10.0, at_root=False)

    assert s == 1
    assert low < (21.0 - math.sqrt(45.0)) / 18.0 < high
    assert coefficients.orientation(a, b, c, [0.0] * 3, low, high, 10.0, at_root=True)[0] == -1
