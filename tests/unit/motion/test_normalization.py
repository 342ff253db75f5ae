"""Float tracks: every coefficient within its bound, in whatever normalization of the scene."""

import math
import random
from fractions import Fraction

from hypothesis import given
from hypothesis import strategies as st
from strategies import algebraics, as_rational, fractions

from exactpt import Polynomial, Rigid
from exactpt.kernel.numbers import QQ
from exactpt.motion.enclosures import Enclosures
from exactpt.motion.normalization import Normalization, normalization_for
from exactpt.motion.track import track
from fuzz.references.real_roots import compare_with_rational, exact, value

UNIT = Fraction(1, 2**53)
powers = st.one_of(st.just(0), st.integers(-60, 60), st.integers(-1100, 1100))
numbers = st.one_of(
    fractions,
    st.builds(lambda q, e: q * Fraction(2) ** e, fractions, powers),
    st.builds(Fraction, st.integers(-(10**20), 10**20), st.integers(1, 10**20)),
)
polys = st.lists(numbers, max_size=4)


@st.composite
def frames(draw):
    """Frames as scenes get them, from points and a time span."""
    points = draw(st.lists(st.tuples(numbers, numbers), min_size=1, max_size=3))
    start = draw(numbers)
    span = abs(draw(numbers)) or Fraction(1)
    exact_points = [(as_rational(x), as_rational(y)) for x, y in points]
    return normalization_for(exact_points, as_rational(start), as_rational(start + span))


def shifted(f, origin, step):
    """The coefficients of f(origin + step t), by evaluation at enough points and Newton's form."""
    result = [Fraction(0)]
    for c in reversed(f):
        moved = [Fraction(0)] * (len(result) + 1)
        for i, a in enumerate(result):
            moved[i] += a * origin
            moved[i + 1] += a * step
        moved[0] += c
        result = moved
    return result


def in_frame(normalization, f, axis):
    """The coordinate polynomial in normalised coordinates and time."""
    center, scale = exact(normalization.center[axis]), Fraction(2) ** -normalization.scale[axis]
    f = [*f, *[Fraction(0)] * (1 - len(f))]
    f[0] -= center
    origin, step = exact(normalization.origin), Fraction(2) ** normalization.time_scale
    return [c * scale for c in shifted(f, origin, step)]


def padded(f, size):
    f = list(f)
    while len(f) > size and f[-1] == 0:
        f.pop()
    return f + [Fraction(0)] * (size - len(f))


@given(normalization=frames(), x=polys, y=polys)
def test_images_of_translating_tracks_are_within_the_errors(normalization, x, y):
    path = track(Polynomial(x), Polynomial(y), None, None)
    enclosures = Enclosures(normalization)

    float_track = enclosures.float_tracks([path])[0]

    if math.isnan(float_track.x0):
        return
    for axis, (floats, f) in enumerate([(float_track.xs, x), (float_track.ys, y)]):
        true = padded(in_frame(normalization, f, axis), len(floats))
        assert len(true) == len(floats)
        for i, (a, c) in enumerate(zip(floats, true, strict=True)):
            if a or abs(c) > Fraction(2) ** -1074:  # (see the bug below)
                assert abs(Fraction(a) - c) <= Fraction(enclosures.errors[i])
                assert a == 0.0 or 2.0**-300 <= abs(a) <= 2.0**100


@given(normalization=frames(), h=polys.filter(any), x=polys)
def test_images_of_turning_tracks_are_right_to_a_unit(normalization, h, x):
    """Numerators and denominator, which have a common factor: a power of two."""
    turn = Polynomial(h)
    w = Polynomial([1]) + turn * turn
    path = track(Polynomial(x), turn, w, ("turn", 1))
    enclosures = Enclosures(normalization)

    float_track = enclosures.float_tracks([path])[0]

    if math.isnan(float_track.x0) or not float_track.ws:
        return
    whole = [[exact(c) for c in part] for part in (path.x, path.y, path.w)]
    origin, step = exact(normalization.origin), Fraction(2) ** normalization.time_scale
    largest = max(map(abs, shifted(whole[2], origin, step)))
    ratio = largest / Fraction(max(map(abs, float_track.ws)))
    shift = round(math.log2(ratio.numerator) - math.log2(ratio.denominator))
    whole = [[c / Fraction(2) ** shift for c in part] for part in whole]
    assert Fraction(1, 2) < largest / Fraction(2) ** shift < 2
    for axis, floats in ((0, float_track.xs), (1, float_track.ys), (None, float_track.ws)):
        f = whole[2]
        if axis is not None:
            size = max(len(whole[axis]), len(f))
            center, scale = (
                exact(normalization.center[axis]),
                Fraction(2) ** -normalization.scale[axis],
            )
            f = [
                (a - center * b) * scale
                for a, b in zip(padded(whole[axis], size), padded(f, size), strict=True)
            ]
        true = padded(shifted(f, origin, step), len(floats))
        for a, c in zip(floats, true, strict=True):
            assert abs(Fraction(a) - c) <= UNIT * abs(c)


def test_bug_a_turning_track_of_doubles_is_moderate():
    """Its integers are beyond 2^100, but only their ratios matter."""
    normalization = Normalization((QQ(0), QQ(0)), (0, 0), QQ(0), 0)
    enclosures = Enclosures(normalization)
    motion = Rigid([0.1234567, 0.7654321], pivot=(0.9876543, -0.3456789), x=[0.1, 0.3])
    path = motion.track((Polynomial([1.2345678]), Polynomial([0.5678901])))

    float_track = enclosures.float_tracks([path])[0]

    assert path.bits > 150
    assert max(float_track.ws) < 2.0
    assert max(map(abs, float_track.xs + float_track.ys)) < 8.0


def test_a_center_near_the_points_keeps_doubles():
    """Far doubles less the one of least size are doubles again."""
    rng = random.Random(0)
    values = [QQ(*(1e9 + rng.uniform(-30, 30)).as_integer_ratio()) for _ in range(50)]
    for points in (values, [-v for v in values]):
        normalization = normalization_for([(v, v) for v in points], QQ(0), QQ(1))
        enclosures = Enclosures(normalization)
        tracks = [track(Polynomial([v]), Polynomial([v, 1]), None, None) for v in points]

        float_tracks = enclosures.float_tracks(tracks)

        assert max(abs(float_track.x0) for float_track in float_tracks) < 64.0
        assert not any(enclosures.errors)


def test_bug_a_coefficient_too_small_for_a_double_counts_as_zero():
    """1e-400 becomes 0.0, which passes for moderate and exact; the exact value must be tested."""
    normalization = Normalization((QQ(0), QQ(0)), (0, 0), QQ(0), 0)
    enclosures = Enclosures(normalization)
    tiny = Polynomial([1, Fraction(1, 10**400)])

    float_track = enclosures.float_tracks([track(tiny, Polynomial([1]), None, None)])[0]

    assert math.isnan(float_track.x0) or enclosures.errors[1] > 0.0


def test_bug_the_errors_are_shorter_than_an_image_of_nan():
    """A cubic of immoderate size left ``errors`` at two entries: an IndexError later."""
    normalization = Normalization((QQ(0), QQ(0)), (0, 0), QQ(0), 0)
    enclosures = Enclosures(normalization)

    path = track(Polynomial([0, 0, 0, 10**40]), Polynomial([1]), None, None)
    float_track = enclosures.float_tracks([path])[0]

    assert math.isnan(float_track.x0)
    assert len(enclosures.errors) >= len(float_track.xs)


@given(normalization=frames(), case=algebraics())
def test_times_are_enclosed(normalization, case):
    t, root = case
    origin, step = exact(normalization.origin), Fraction(2) ** normalization.time_scale

    lo, hi = normalization.enclosure(t)

    if math.isfinite(lo):
        assert compare_with_rational(root, origin + step * Fraction(lo)) >= 0
    if math.isfinite(hi):
        assert compare_with_rational(root, origin + step * Fraction(hi)) <= 0
    assert hi <= math.nextafter(math.nextafter(lo, math.inf), math.inf)


@given(normalization=frames(), t=st.floats(-(2.0**60), 2.0**60))
def test_a_double_of_the_frame_stands_for_one_time(normalization, t):
    assert normalization.time(normalization.exact_time(t)) == (t, t)


@given(
    points=st.lists(st.tuples(fractions, fractions), min_size=1, max_size=3),
    x=st.lists(st.integers(-(2**52), 2**52), max_size=3),
    end=st.integers(1, 1000),
)
def test_ordinary_scenes_keep_their_integers(points, x, end):
    exact_points = [(as_rational(p), as_rational(q)) for p, q in [(0, 0), (1, 1), *points]]
    normalization = normalization_for(exact_points, QQ(0), QQ(end))
    enclosures = Enclosures(normalization)

    float_track = enclosures.float_tracks([track(Polynomial(x), Polynomial([7]), None, None)])[0]

    assert [value(x, Fraction(1))] == [sum(map(Fraction, float_track.xs), Fraction(0))]
    assert not any(enclosures.errors)
    assert normalization.time(QQ(end)) == (float(end), float(end))


def test_integers_are_exact_as_far_as_doubles_are():
    normalization = Normalization((QQ(0), QQ(0)), (0, 0), QQ(0), 0)
    enclosures = Enclosures(normalization)

    exact_ones = enclosures.float_tracks(
        [track(Polynomial([2**53 - 1, -(2**53)]), Polynomial([]), None, None)]
    )[0]
    errors = list(enclosures.errors)
    rounded = enclosures.float_tracks(
        [track(Polynomial([2**53 + 1]), Polynomial([1]), None, None)]
    )[0]
    huge = enclosures.float_tracks([track(Polynomial([10**400]), Polynomial([1]), None, None)])[0]

    assert exact_ones.xs == [2.0**53 - 1, -(2.0**53)]
    assert exact_ones.ys == [0.0, 0.0]
    assert errors == [0.0, 0.0]
    assert rounded.xs == [2.0**53]
    assert enclosures.errors[0] >= 1.0
    assert math.isnan(huge.x0)


def test_tracks_of_one_body_have_one_motion():
    normalization = Normalization((QQ(0), QQ(0)), (0, 0), QQ(0), 0)
    enclosures = Enclosures(normalization)
    path, other, rest = Polynomial([1, 2]), Polynomial([7, 2]), Polynomial([1])
    tracks = [track(x, rest, None, None) for x in (path, other, rest, path)]

    first, second, third, fourth = (
        float_track.motion for float_track in enclosures.float_tracks(tracks)
    )

    assert first == second == fourth != third
    assert enclosures.float_tracks(tracks[:1])[0].motion == first


def test_integer_vertices_among_others_of_one_body():
    """Tracks of one motion whose denominators differ have different numerators."""
    normalization = Normalization((QQ(0), QQ(0)), (0, 0), QQ(0), 0)
    enclosures = Enclosures(normalization)
    xs = (3, QQ(1, 2), 0, 2**60, -5)
    tracks = [track(Polynomial([x, 7]), Polynomial([0, 0, 1]), None, None) for x in xs]

    float_tracks = enclosures.float_tracks(tracks)

    assert [float_track.xs for float_track in float_tracks] == [[float(x), 7.0, 0.0] for x in xs]
    assert [float_track.ys for float_track in float_tracks] == [[0.0, 0.0, 1.0]] * 5
    assert not any(enclosures.errors)


def test_the_bound_is_at_most_twice_the_largest_error():
    """Cut to a quarter it would be wrong; scenes hardly ever show that, as few vertices are so."""
    worst = 1 + UNIT * (1 - Fraction(1, 2**30))
    normalization = Normalization((QQ(0), QQ(0)), (0, 0), QQ(0), 0)
    enclosures = Enclosures(normalization)

    float_track = enclosures.float_tracks(
        [track(Polynomial([worst]), Polynomial([0]), None, None)]
    )[0]

    error = abs(Fraction(float_track.x0) - worst)
    assert Fraction(enclosures.errors[0]) / 4 < error <= Fraction(enclosures.errors[0])
    assert Fraction(enclosures.errors[0]) < Fraction(2001, 1000) * error
