"""Curves of SciPy: which jumps are refused, and what closing up the others changes."""

import math
import pickle
from fractions import Fraction
from types import SimpleNamespace

import numpy as np
import pytest

from exactpt import Body, InputError, Pieces, PosePath, Scene, first_contact_enclosed, spline

ULP = math.ulp(1.0)


def curve(pieces, times=None, **attributes):
    """A curve as SciPy has it: of each piece and column the coefficients, constants first."""
    c = np.array(pieces, float).transpose(2, 0, 1)[::-1]
    return SimpleNamespace(c=c, x=list(range(len(pieces) + 1)) if times is None else times,
                           **attributes)  # fmt: skip


def rises_by(jump, columns=2):
    """Along x from 3/2 to 5/2, then from 5/2 and a jump on, by 1 in each unit of time."""
    rest = [[0.0, 0.0]] * (columns - 1)
    return curve([[[1.5, 1.0], *rest], [[2.5 + jump, 1.0], *rest]])


LARGEST = math.ulp(2.5)
"""The largest term where `rises_by` may jump is about 5/2."""


@pytest.mark.parametrize("ulps", [-8, -1, 0, 1, 8])
def test_a_jump_of_up_to_8_ulps_is_closed_and_is_the_error(ulps):
    motion = spline(rises_by(ulps * LARGEST))

    assert isinstance(motion, Pieces)
    assert motion.error == Fraction(abs(ulps) * LARGEST)
    assert Body("b", [(0, 0)], motion).at(2) == [(Fraction(7, 2), 0)]
    path = PosePath.of_curve(rises_by(ulps * LARGEST, columns=3))
    assert path.place_error == path.assumed_place_error == motion.error
    assert (path.error, path.assumed_angle_error) == (Fraction(1, 10**6), 0)


@pytest.mark.parametrize("ulps", [-9, 9, 1e9])
@pytest.mark.parametrize("columns", [2, 3])
def test_a_larger_jump_is_refused_with_the_piece_the_time_and_the_jump(ulps, columns):
    make = spline if columns == 2 else PosePath.of_curve
    jump = f"{ulps * LARGEST:.6g}"
    with pytest.raises(InputError, match=rf"piece 1 jumps at t = 1: x by {jump}, more than 8 ulps"):
        make(rises_by(ulps * LARGEST, columns))


def test_the_term_that_allows_a_jump_may_cancel_others():
    """10^6 - 10^6 s + s is 1 at s = 1: the terms there are of the size 10^6."""
    large = [[[1e6, -1e6 + 1], [0.0, 0.0]], [[1.0 + 1e-10, 0.0], [0.0, 0.0]]]

    assert float(spline(curve(large)).error) == pytest.approx(1e-10, rel=1e-5)
    large[1][0][0] += 1e-8
    with pytest.raises(InputError, match="piece 1 jumps"):
        spline(curve(large))


def test_jumps_add_up_and_the_largest_sum_counts():
    """Jumps of x by 3, -2 and 4 ulps: sums 3, 1, 5; those of y by 0, 4, 0: sums 0, 4, 4."""
    x, y = [1.0, 1.0 + 3 * ULP, 1.0 + ULP, 1.0 + 5 * ULP], [1.0, 1.0, 1.0 + 4 * ULP, 1.0 + 4 * ULP]
    steps = [[[a], [b]] for a, b in zip(x, y, strict=True)]

    error = spline(curve(steps)).error

    assert Fraction(41) <= (error / Fraction(ULP)) ** 2 < Fraction(41.0001)
    assert spline(curve([[[a], [1.0]] for a in x])).error == 5 * Fraction(ULP)


@pytest.mark.long
def test_jumps_of_the_angle_are_taken_out_of_the_error():
    still = [0.0, 0.0]
    turning = [[still, still, [0.25, 1.0]], [still, still, [1.25 + 4 * ULP, 1.0]]]
    path = PosePath.of_curve(curve(turning), error="1e-12")

    assert path.error == Fraction(1, 10**12)
    assert path.assumed_angle_error == 4 * Fraction(ULP)
    assert path.place_error == 0
    tight = 8 * Fraction(ULP)
    assert PosePath.of_curve(curve(turning), error=tight).error == tight  # just half of it
    with pytest.raises(InputError, match=r"jumps of the angle add up to 8\.88e-16, more than half"):
        PosePath.of_curve(curve(turning), error=tight - Fraction(1, 10**30))


def test_pieces_of_no_duration_are_left_out_with_what_they_say():
    """As `PPoly.from_spline` makes them; the jump is that between the pieces beside them."""
    pieces = [[[9.0], [9.0]], [[1.0], [0.0]], [[math.nan], [7.0]], [[1.0], [0.0]]]
    motion = spline(curve(pieces, times=[0, 0, 1, 1, 2]))

    assert motion.until == (0, 1, 2)
    assert motion.error == 0
    pieces[3][0][0] = 2.0
    with pytest.raises(InputError, match="piece 3 jumps at t = 1: x by 1, "):
        spline(curve(pieces, times=[0, 0, 1, 1, 2]))


FLAT = [[[1.0], [0.0]], [[1.0], [0.0]]]


@pytest.mark.parametrize(
    "given, message",
    [
        (curve(FLAT, [0, 2, 1]), "breakpoint 2: times increase, got 1 after 2"),
        (curve(FLAT, [0, 1]), "one breakpoint more than pieces: 2 breakpoints, 2 pieces"),
        (curve(FLAT, [0, 1, 2, 3]), "4 breakpoints, 2 pieces"),
        (curve(FLAT, [0, math.inf, 3]), "breakpoint 1: not a finite number: inf"),
        (curve(FLAT, [1, 1, 1]), "all pieces of the curve have no duration"),
        (curve([FLAT[0], [[math.nan], [0.0]]]), "piece 1: a coefficient of x: not a finite number"),
        (curve(FLAT, extrapolate="periodic"), "repeats itself, extrapolate = 'periodic'"),
        (SimpleNamespace(c=np.zeros((0, 2, 2)), x=[0, 1, 2]), "not a piecewise polynomial"),
        (SimpleNamespace(c=np.zeros((3, 1, 2)), t=[0, 1, 2]), "without breakpoints x"),
        (SimpleNamespace(c=np.ones((1, 2, 2)) * 1j, x=[0, 1, 2]), "piece 0: a coefficient of x"),
    ],
    ids=lambda value: value if isinstance(value, str) else "",
)
def test_a_curve_that_would_be_read_as_another_one_is_refused(given, message):
    with pytest.raises(InputError, match=message):
        spline(given)


def test_a_curve_in_the_bernstein_basis_is_refused():
    """BPoly has the attributes c and x, too, with another meaning."""
    interpolate = pytest.importorskip("scipy.interpolate")
    bernstein = interpolate.BPoly(np.array([[[0.0, 0.0]], [[1.0, 2.0]]]), [0, 1])

    with pytest.raises(InputError, match="Bernstein"):
        spline(bernstein)
    power = interpolate.PPoly.from_bernstein_basis(bernstein)
    assert Body("b", [(0, 0)], spline(power)).at(1) == [(1, 2)]


@pytest.mark.parametrize("name", ["CubicSpline", "PchipInterpolator", "Akima1DInterpolator"])
def test_curves_of_scipy_are_taken(name):
    interpolate = pytest.importorskip("scipy.interpolate")
    rng = np.random.default_rng(5)
    for _ in range(20):
        times = np.cumsum(rng.uniform(0.1, 2, 8)) + rng.choice([0, 1e6])
        places = rng.normal(size=(8, 3)) * [10.0 ** rng.integers(-3, 4), 1.0, 0.1]
        given = getattr(interpolate, name)(times, places)
        path = PosePath.of_curve(given, error="1/1000")
        assert path.error == Fraction(1, 1000)
        assert path.place_error < 1e-11


def test_numbers_of_other_kinds_have_their_values():
    given = curve(FLAT)
    given.c = given.c.astype(np.float32)
    assert spline(given).error == 0
    given.c, given.x = given.c.astype(int), np.array([0, 1, 2], np.int32)
    assert Body("b", [(0, 0)], spline(given)).at(2) == [(1, 0)]


def test_a_spline_keeps_its_error_in_files_and_pickles():
    motion = spline(rises_by(3 * LARGEST))
    scene = Scene([Body("b", [(0, 0)], motion)], time=(0, 2))

    assert Scene.from_json(scene.to_json()).bodies[0].motion == motion
    assert pickle.loads(pickle.dumps(motion)) == motion
    assert motion != spline(rises_by(0))
    assert len(repr(motion)) < 200
    with pytest.raises(AttributeError):
        motion.error = 0


@pytest.mark.parametrize("record", [{"error": "-1"}, {}, {"error": "0", "x": "0"}, "0"])
def test_a_spline_in_a_file_that_is_none_is_refused(record):
    data = Scene([Body("b", [(0, 0)], spline(rises_by(0)))], time=(0, 2)).to_json()
    data["bodies"][0]["motion"]["spline"] = record
    with pytest.raises(InputError, match=r"motion.*(spline|error)"):
        Scene.from_json(data)


def test_the_error_of_a_spline_widens_the_bounds_of_a_contact():
    """x = 3/2 + t to t = 1, then 3/2 + t + j with a jump j: the wall at 3 is met at 3/2 - j."""
    wall = Body("wall", [(3, -1), (3, 1)])
    given = rises_by(8 * LARGEST)

    found = first_contact_enclosed(Scene([Body("b", [(0, 0)], spline(given)), wall], time=(0, 2)))
    exact = first_contact_enclosed(
        Scene([Body("b", [(0, 0)], spline(rises_by(0))), wall], time=(0, 2))
    )

    true = Fraction(3, 2) - 8 * Fraction(LARGEST)
    assert found.low <= true < Fraction(3, 2) < found.high
    assert found.high.high - found.low.low < Fraction(1, 10**12)
    assert exact.low == exact.high == Fraction(3, 2)
