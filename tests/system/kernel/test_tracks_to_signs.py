"""Certificates of any motion, from trajectories through a normalization to the result of a filter.

Judged by exact arithmetic: whatever is decided must hold for the true trajectories, at times
chosen next to the roots of the true polynomial.
"""

import random
from collections import Counter

import pytest

from exactpt import AlgebraicNumber, Polynomial
from exactpt.certificates import coefficients
from exactpt.kernel.integer_polynomial import primitive
from exactpt.kernel.numbers import QQ, nearest_float, power_of_two, rational
from exactpt.kernel.roots import roots_after
from exactpt.motion.enclosures import Enclosures
from exactpt.motion.normalization import normalization_for
from exactpt.motion.track import difference, orientation_polynomial, track
from fuzz.filter_attacks import asked, judge
from fuzz.general import MOTIONS, NUMBERS, SETTINGS, lanes, random_scene

STYLES = ["free", "collinear", "near", "lanes"]


def hostile_tracks(rng):
    """Three trajectories of a random scene, and its normalization; also of three nearly in line."""
    style, motion, numbers = rng.choice(STYLES), rng.choice(sorted(MOTIONS)), rng.choice(NUMBERS)
    if style == "lanes":
        motion = "linear"
        scene = lanes(numbers, rng.random(), bodies=4)
    else:
        setting = SETTINGS[rng.choice(sorted(SETTINGS))]
        scene = random_scene(motion, numbers, rng.random(), setting=setting, side=2)
    places = [p for body in scene.bodies for p in body.exact_at(scene.exact_start)]
    normalization = normalization_for(places, scene.exact_start, scene.exact_end)
    tracks = [t for body in scene.bodies for t in body.exact_piece_after(scene.exact_start).tracks]
    a, b, c = rng.sample(tracks, 3)
    if style in ("collinear", "near"):
        grain = power_of_two(-rng.choice([40, 52, 60])) * (places[0][1] - places[-1][1])
        c = through(a, b, QQ(rng.randint(-4, 4), 3), grain if style == "near" else QQ(0))
    return style, motion, rng.sample([a, b, c], 3), normalization, scene


def through(a, b, k, grain):
    """The trajectory a + k (b - a), and a grain upwards: collinear with a and b, or nearly."""
    v, w = Polynomial(a.w), Polynomial(b.w)
    x, y = (
        Polynomial(p) * w * Polynomial([1 - k]) + Polynomial(q) * v * Polynomial([k])
        for p, q in ((a.x, b.x), (a.y, b.y))
    )
    y += v * w * Polynomial([grain])
    if v.degree == w.degree == 0:
        scale = Polynomial([1 / (a.w[0] * QQ(b.w[0]))])
        return track(x * scale, y * scale, None, None)
    return track(x, y, v * w, ("through", a.motion, b.motion, k, grain))


def in_frame(normalization, f):
    """A polynomial in the scene's time, as one in normalised time."""
    step, result = power_of_two(normalization.time_scale), Polynomial()
    for c in reversed(f):
        result = result * Polynomial([normalization.origin, step]) + Polynomial([c])
    return list(result.exact_coefficients)


def near_roots(rng, true, end):
    """Times next to which the question is asked: roots of the polynomial, or any."""
    f = primitive(tuple((q * _common(true)).numerator for q in true))
    found = [r.time for r in roots_after(f, AlgebraicNumber(-abs(end)), 2 * abs(end))][:4]
    return [rational(nearest_float(r.exact_low)) for r in found] or [end * QQ(rng.randint(0, 8), 8)]


def _common(values):
    common = QQ(1)
    for q in values:
        common *= (q * common).denominator
    return common


def attack(seed, cases):
    """What was decided wrongly; how many were asked and decided, by style and motion."""
    rng, wrong, seen, decided = random.Random(seed), [], Counter(), Counter()
    for _ in range(cases):
        style, motion, tracks, normalization, scene = hostile_tracks(rng)
        enclosures = Enclosures(normalization)
        float_tracks, errors = enclosures.float_tracks(tracks), enclosures.errors
        if rng.random() < 0.7:
            function, ask = orientation_polynomial(*tracks), coefficients.orientation
        else:
            a, b = tracks[:2]
            function, ask = difference(a.x, a.w, b.x, b.w), coefficients.x_difference
            float_tracks = float_tracks[:2]
        true, end = (
            in_frame(normalization, function),
            rational(normalization.time(scene.exact_end)[1]),
        )
        if not any(true):
            now = *normalization.time(scene.exact_start), float(end)
            assert ask(*float_tracks, errors, *now, at_root=False)[0] == 0
            continue
        case = asked(rng, true, near_roots(rng, true, end), (), ())
        said = ask(*float_tracks, errors, case.now_low, case.now_high, case.horizon, case.at_root)
        for key in (style, motion):
            seen[key] += 1
            decided[key] += said[0] != 0
        if fault := judge(case, said):
            wrong.append((fault, style, motion, case, said))
    return wrong, seen, decided


@pytest.mark.parametrize("seed", range(4))
def test_no_certificate_is_decided_wrongly(seed):
    wrong, seen, decided = attack(seed, 400)

    assert wrong == []
    assert all(decided[motion] > seen[motion] / 4 for motion in MOTIONS)
    assert decided["free"] > seen["free"] / 3


@pytest.mark.slow
@pytest.mark.parametrize("seed", range(100, 105))
def test_none_of_10_000_certificates_is_decided_wrongly(seed):
    wrong, _, decided = attack(seed, 2_000)

    assert wrong == []
    assert decided["free"] > 150
