"""Paths of poses, against mpmath at 60 digits."""

import copy
import json
import pickle
from fractions import Fraction
from itertools import pairwise
from random import Random
from types import SimpleNamespace

import mpmath
import numpy as np
import pytest

from exactpt import (
    Body,
    InputError,
    Pieces,
    PosePath,
    Rigid,
    Scene,
    first_contact_enclosed,
    proof_scene,
)
from exactpt.kernel.numbers import QQ
from exactpt.kernel.polynomial import Polynomial
from exactpt.motion.displacement import displacement
from exactpt.motion.path_error import angle_error, place_error_squared


def real(q):
    return mpmath.mpf(int(q.numerator)) / int(q.denominator)


def turned(motion, t):
    """The angle of a rigid motion at a time."""
    c, s = motion.orientation
    return mpmath.atan2(real(s), real(c)) + 2 * mpmath.atan(real(motion.half_turn(t)))


def away(angle, true):
    """The distance of two angles, but for full turns."""
    rest = (angle - true) / (2 * mpmath.pi)
    return abs(rest - mpmath.nint(rest)) * 2 * mpmath.pi


def random_path(rng, degree, pieces=3):
    """Times and poses that follow one upon the other."""
    times = [QQ(rng.randint(-20, 20), 7)]
    start, poses = [QQ(rng.randint(-50, 50), 3) for _ in range(3)], []
    for _ in range(pieces):
        rest = [[QQ(rng.randint(-20, 20), 10) for _ in range(degree)] for _ in range(3)]
        poses.append([Polynomial([c, *row]) for c, row in zip(start, rest, strict=True)])
        duration = QQ(rng.randint(1, 9), 6)
        times.append(times[-1] + duration)
        start = [f.exact_at(duration) for f in poses[-1]]
    return times, poses


def check(path, rng, count):
    times = [*path.times, path.times[0] - 1, path.times[-1] + 1]
    times += rng.sample(path.until, min(count, len(path.until)))
    for a, b in rng.choices(list(pairwise(path.until)), k=count):
        times.append(a + (b - a) * Fraction(rng.randint(0, 1000), 1000))
    with mpmath.workdps(60):
        for t in times:
            x, y, angle = path.pose(t)
            motion = next((m for end, m in path.pieces if end is None or t <= end), None)
            assert away(turned(motion, t), real(angle)) <= real(path.error)
            off = (motion.x(t) - x) ** 2 + (motion.y(t) - y) ** 2
            assert off <= path.place_error**2


@pytest.mark.parametrize("error", ["1/10", "1e-3", "1e-6", "1e-8"])
@pytest.mark.parametrize("degree", [0, 1, 2, 3])
def test_the_pose_is_within_the_errors(degree, error):
    rng = Random(f"{degree} {error}")
    check(PosePath(*random_path(rng, degree, 1), error=error), rng, 8)


@pytest.mark.slow
def test_the_pose_is_within_the_errors_of_many_paths():
    rng = Random(5)
    for _ in range(60):
        degree, digits = rng.randint(0, 5), rng.choice([1, 3, 6, 9])
        place = 0 if degree <= 3 and rng.random() < 0.5 else "1e-6"
        times, poses = random_path(rng, degree)
        check(PosePath(times, poses, error=f"1e-{digits}", place_error=place), rng, 40)


def test_errors_smaller_than_those_of_doubles():
    path = PosePath([0, "1/100"], [(0, 0, [1, 1])], error="1e-16")
    check(path, Random(1), 10)


def test_the_bound_of_the_angle_covers_what_is_sampled_for_any_half_turn():
    """Against arc tangents: whatever the half turn, the largest error is within the bound."""
    rng = Random(3)
    near = 0
    with mpmath.workdps(60):
        for _ in range(15):
            h = Polynomial([QQ(rng.randint(-9, 9), 30) for _ in range(rng.randint(1, 4))])
            angle = 2 * h + Polynomial([QQ(rng.randint(-9, 9), 1000) for _ in range(3)])
            a = QQ(rng.randint(-5, 5), 7)
            b = a + QQ(rng.randint(1, 9), 9)
            turn = Rigid(h, orientation=("3/5", "4/5"))
            start = real(angle(a) - angle(0)) - turned(turn, a)
            angle += Polynomial([QQ(round(float(-start) * 10**6), 10**6)])
            bound = real(angle_error(turn, a, b, angle, QQ(1, 10**6)))
            times = [a + (b - a) * QQ(i, 10) for i in range(11)]
            # the continuous error: no full turn is lost in less than pi
            worst = max(away(turned(turn, t), real(angle.exact_at(t))) for t in times)
            assert worst <= bound
            near += worst > bound / 3
    assert near > 3  # the bound is no idle one


def test_the_bound_of_the_place():
    turn = Rigid(0, x=[0, 1], y=[1])
    assert place_error_squared(turn, QQ(0), QQ(2), Polynomial([0]), Polynomial([4])) == 4 + 9


def test_neighbours_agree_exactly():
    path = PosePath(*random_path(Random(2), 3), error="1e-4")
    Body("b", [(0, 0), (3, 1), (1, 5)], path)  # refuses jumps
    for t, (before, after) in zip(path.exact_until, pairwise(path.motions), strict=True):
        for position in [(1, 0), (0, 1)]:
            place = Polynomial([position[0]]), Polynomial([position[1]])
            assert before.track(place).at(t) == after.track(place).at(t)


@pytest.mark.parametrize(
    "times, poses, options, message",
    [
        (
            [0, 1, 2],
            [(0, 0, 0)],
            {},
            "at least one pose, and one pose fewer than times: 3 times, 1 poses",
        ),
        ([2, 2], [(0, 0, 0)], {}, "times increase: 2, then 2"),
        ([0, 1], [(0, 0)], {}, "piece 0: a pose is x, y and an angle"),
        ([0, 1], ["012"], {}, "piece 0: a pose is x, y and an angle: '012'"),
        ("01", [(0, 0, 0)], {}, "times: not a list: '01'"),
        ([0, 1], [(0, 0, 0)], {"error": 0}, "an error is positive: 0"),
        ([0, 1], [(0, 0, 0)], {"place_error": -1}, "a place_error is not negative: -1"),
        (
            [0, 1, 2],
            [(0, 0, [0, 1]), (0, 0, "9/8")],
            {},
            "piece 1: the angle jumps at t = 1 by 1/8",
        ),
        ([0, 1], [([0, 0, 0, 0, 1], 0, 0)], {}, "piece 0: x has degree 4: give a place_error"),
        ([0, 1], [(0, 0, [0, 1])], {"error": "1e-300"}, "too small for angles"),
        ([0, 10**9], [(0, 0, [0, 1])], {}, "more than 100000 pieces"),
    ],
)
def test_a_path_that_is_none_is_refused(times, poses, options, message):
    with pytest.raises(InputError, match=message):
        PosePath(times, poses, **options)


@pytest.mark.parametrize(
    "times, samples, message",
    [
        ("01", [(0, 0, 0), (1, 0, 0)], "times: not a list: '01'"),
        ({0: 5, 1: 6}, [(0, 0, 0), (1, 0, 0)], "times: not a list: {0: 5, 1: 6}"),
        ([0, 1], {(0, 0, 0): 0, (1, 0, 0): 1}, "samples: not a list: {"),
        ([0, 1], ["000", "100"], "row 0: a sample is x, y and the angle: '000'"),
    ],
)
def test_a_log_that_is_a_text_or_a_mapping_is_refused(times, samples, message):
    with pytest.raises(InputError, match=message):
        PosePath.through(times, samples)


def test_high_degrees_are_fitted_within_the_place_error():
    poses = [([0, 1, 0, -1, 2, 1], [0, 0, 3, 0, 0, -2], [0, 1])]
    path = PosePath([0, 1], poses, error="1e-3", place_error="1e-4")
    assert max(m.x.degree for m in path.motions) == 3
    check(path, Random(1), 20)


def test_a_spline_of_scipy_with_pieces_of_no_duration():
    ends = [0.1 + 0.5, 0.2 + 1.0, 0.3 + 0.05]
    c = [[[1.0, 2.0, 0.1]] * 3, [[0.1, 0.2, 0.3], [0.1, 0.2, 0.3], ends]]
    curve = SimpleNamespace(c=_Rows(c), x=[0.0, 0.0, 0.5, 2.0])
    path = PosePath.of_curve(curve, error="1e-3")
    assert path.times == (0, Fraction(1, 2), 2)
    with pytest.raises(InputError, match="three columns x, y, angle"):
        PosePath.of_curve(SimpleNamespace(c=_Rows([[[1.0, 2.0]]]), x=[0, 1]))


class _Rows:
    """An array of three axes, as far as paths use one."""

    def __init__(self, rows):
        self.rows, self.shape = rows, (len(rows), len(rows[0]), len(rows[0][0]))

    def __getitem__(self, key):
        powers, piece, *column = key
        if isinstance(powers, slice):
            return [row[piece][column[0]] for row in self.rows[powers]]
        return self.rows[powers][piece]


def test_samples_and_trapezoidal_profiles():
    samples = [(0, 0, 0), (4, 2, 1), (4, 0, 0)]
    line = PosePath.through([0, 2, 5], samples, error="1/10")
    assert line.pose(1) == (2, 1, Fraction(1, 2))
    ramps = PosePath.through([0, 2, 5], samples, ramp="1/4", error="1/10")
    assert [ramps.pose(t) for t in (0, 2, 5)] == samples
    assert ramps.pose("1/2")[0] == Fraction(2, 3)  # half of the speed 8/3 for half a unit of time
    steep = PosePath.through([0, 2], samples[:2], ramp="1/2", error="1/10")
    assert steep.pose(1)[0] == 2
    assert len(steep.times) == 3
    with pytest.raises(InputError, match="a ramp is between 0 and 1/2: 1"):
        PosePath.through([0, 2], samples[:2], ramp=1)
    with pytest.raises(InputError, match="x, y and the angle for each time"):
        PosePath.through([0, 2], samples)


def test_headings_that_wrap_are_refused_or_unwrapped():
    """A log between -pi and pi: 3.13, -3.13, -3, then around the other way, twice."""
    times = [0, 1, 2, 3, 4, 5]
    headings = [3.13, -3.13, -3, 2, -2, 2]
    samples = [(0, 0, heading) for heading in headings]
    with pytest.raises(InputError, match=r"row 1: the angle changes by -6\.26, more than pi"):
        PosePath.through(times, samples)

    path = PosePath.through(times, samples, unwrap=True, error="1/1000")

    assert path.error == Fraction(1, 1000)
    assert 0 < path.assumed_angle_error <= Fraction(1, 10**6)
    for t, full_turns in zip(times, [0, 1, 1, 0, 1, 0], strict=True):
        with mpmath.workdps(40):
            true = real(Fraction(headings[t])) + 2 * mpmath.pi * full_turns
            assert abs(real(path.pose(t)[2]) - true) <= real(path.assumed_angle_error)
    assert pickle.loads(pickle.dumps(path)) == path
    scene = Scene([Body("b", [(0, 0)], path)], time=(0, 5))
    assert Scene.from_json(scene.to_json()).bodies[0].motion == path
    read_by_the_checker(scene.to_json())


def test_headings_by_almost_half_a_turn_are_decided_exactly():
    """355/113 is more than pi, 103993/33102 is less, by about 10^-7 and 10^-9."""
    turn = PosePath.through([0, 1], [(0, 0, 0), (0, 0, "103993/33102")], error="1/100")
    assert turn.pose(1)[2] == Fraction(103993, 33102)
    with pytest.raises(InputError, match="row 1"):
        PosePath.through([0, 1], [(0, 0, 0), (0, 0, "355/113")])
    near_pi = "31415926535897932384626433832795028841971693993751058209749/1" + "0" * 58
    assert PosePath.through([0, 1], [(0, 0, 0), (0, 0, near_pi)], error="1/100")
    above = near_pi.replace("9749/", "9750/")
    with pytest.raises(InputError, match="row 1"):
        PosePath.through([0, 1], [(0, 0, 0), (0, 0, above)])
    back = PosePath.through([0, 1], [(0, 0, 0), (0, 0, above)], error="1/100", unwrap=True)
    assert back.pose(1)[2] < -3


def test_unwrapped_headings_that_do_not_wrap_are_as_they_are():
    samples = [(0, 0, 0), (0, 0, 3), (0, 0, 6), (0, 0, 9)]
    plain, same = (
        PosePath.through(range(4), samples, unwrap=u, error="1/100") for u in (False, True)
    )
    assert plain == same
    assert same.assumed_angle_error == 0


@pytest.mark.parametrize(
    "times, samples, message",
    [
        ([0, 1], [(0, 0, 0), (0, 0, 90)], "row 1: the angle changes by 90, .*radians"),
        ([0, 0], [(0, 0, 0)] * 2, "row 1: times increase, got 0 after 0"),
        ([1, 0], [(0, 0, 0)] * 2, "row 1: times increase, got 0 after 1"),
        ([0, float("nan")], [(0, 0, 0)] * 2, "row 1: not a finite number"),
        ([0, 1], [(0, 0, 0), (0, float("inf"), 0)], "row 1: not a finite number: inf"),
        ([0, 1], ["000", "123"], "row 0: a sample is x, y and the angle"),
        ([0, 1], [(0, 0, 0), (0, 0)], "row 1: a sample is x, y and the angle"),
    ],
)
def test_a_log_that_is_none_is_refused_with_its_row(times, samples, message):
    with pytest.raises(InputError, match=message):
        PosePath.through(times, samples)


def test_the_assumed_part_of_a_place_error_is_what_fitting_leaves():
    still = PosePath([0, 1], [(1, 0, 0)], place_error="1/10")
    assert still.assumed_place_error == Fraction(1, 10)
    assert PosePath([0, 1], [([0, 1], 0, 0)]).assumed_place_error == 0
    fitted = PosePath([0, 1], [([0, 0, 0, 0, 0, 1], 0, 0)], place_error="1/1000")
    assert 0 <= fitted.assumed_place_error < Fraction(1, 1000)
    stated = fitted.with_place_error("1/7").assumed_place_error
    assert stated == fitted.assumed_place_error + Fraction(1, 7)


@pytest.mark.parametrize("assumed", ["-1/1000", "1/100", 1])
def test_an_assumed_error_that_is_no_part_of_the_error_is_refused(assumed):
    path = PosePath([0, 1], [(0, 0, 0)], error="1/100")
    with pytest.raises(InputError, match="must be at least 0 and less than the error, 1/100, got"):
        PosePath.of_pieces(path.pieces, [0, 1], [(0, 0, 0)], "1/100", 0, assumed)


@pytest.mark.long
def test_pickles_and_tampered_pieces():
    path = PosePath([0, 1, 2], [(0, [1, 1], [0, 1]), ([0, 1], 2, 1)], error="1e-4")
    assert pickle.loads(pickle.dumps(path)) == path
    assert hash(pickle.loads(pickle.dumps(path))) == hash(path)
    (pieces,), _ = Pieces._given(path)
    given = path.times, path.exact_poses, path.error
    assert PosePath.of_pieces(pieces, *given) == path
    for i, (end, motion) in enumerate(pieces):
        for change in [
            {"half_turn": motion.half_turn + Polynomial([0, QQ(1, 1000)])},
            {"half_turn": motion.half_turn + QQ(1, 1000)},
            {"x": motion.x + QQ(1, 10**9)},
            {"y": motion.y + Polynomial([0, QQ(1, 10**9)])},
            {"pivot": (0, 1)},
        ]:
            wrong_pivot = "pivot" in change
            half = change.pop("half_turn", motion.half_turn)
            kept = {"x": motion.x, "y": motion.y, "orientation": motion.orientation} | change
            wrong = [*pieces[:i], (end, Rigid(half, **kept)), *pieces[i + 1 :]]
            words = "turn about its pivot" if wrong_pivot else "do not follow the path"
            with pytest.raises(InputError, match=rf"{words}.* \(piece {i}\)"):
                PosePath.of_pieces(wrong, *given)
    with pytest.raises(InputError, match="do not follow"):
        PosePath.of_pieces(pieces[1:], *given)
    with pytest.raises(InputError, match="do not follow"):
        PosePath.of_pieces(pieces, path.times, path.exact_poses, path.error / 1000)


def blade(**options):
    path = PosePath([0, 2], [(0, 0, [0, 1])], error="1/1000", **options)
    return Body("blade", [(0, 0), (2, 0)], path)


POST = Body("post", [(-1, 1), (1, 1), (1, 2), (-1, 2)])


def test_the_first_contact_of_the_true_path_is_enclosed():
    bounds = first_contact_enclosed(Scene([blade(), POST], time=(0, 2)))
    assert float(bounds.low) < 0.7853981633974483 < float(bounds.high)
    assert float(bounds.high) - float(bounds.low) < 0.01
    assert bounds.pairs == (("blade", "post"),)


def test_a_place_error_widens_the_bounds():
    exact, fitted = (
        first_contact_enclosed(Scene([blade(place_error=e), POST], time=(0, 2)))
        for e in (0, "1/50")
    )
    assert fitted.low < exact.low < exact.high < fitted.high


def test_between_and_ignoring_of_enclosed_contacts():
    near = Body("near", [("1/2", "1/10"), (1, "1/10"), (1, "1/5")])
    scene = Scene([near, blade(), POST], time=(0, 2))
    assert first_contact_enclosed(scene).pairs == (("near", "blade"),)
    for options in ({"between": [("post", "blade")]}, {"ignoring": [["near", "blade"]]}):
        bounds = first_contact_enclosed(scene, **options)
        assert bounds.pairs == (("blade", "post"),)
        assert float(bounds.low) < 0.7853981633974483 < float(bounds.high)
    assert first_contact_enclosed(scene, ignoring=[["near", "blade", "post"]]) is None
    assert first_contact_enclosed(scene, between=[("near", "post")]) is None
    with pytest.raises(InputError, match="no body"):
        first_contact_enclosed(scene, between=[("near", "none")])


def test_bodies_that_touch_at_the_start_are_ignored_there_too():
    hub = Body("hub", [(0, 0), (0, -1), (-1, -1)])
    scene = Scene([hub, blade(), POST], time=(0, 2))
    assert first_contact_enclosed(scene).low == 0
    bounds = first_contact_enclosed(scene, ignoring=[["hub", "blade"]])
    assert bounds.pairs == (("blade", "post"),)


def read_by_the_checker(data):
    return proof_scene.Scene(json.dumps(data))


def in_a_file():
    path = PosePath([0, 1, 2], [(0, [1, 1], [0, 1]), ([0, 1], 2, 1)], error="1e-2")
    return Scene([Body("b", [(0, 0), (2, 0)], path)], time=(0, 2))


def test_a_path_goes_to_a_file_and_back():
    scene = in_a_file()
    data = json.loads(json.dumps(scene.to_json()))
    assert Scene.from_json(data).bodies[0].motion == scene.bodies[0].motion
    read_by_the_checker(data)


TAMPERED = {
    "error": "1/100000",
    "place_error": "-1",
    "times": ["0", "1", "3"],
    "poses": [{"x": ["0"], "y": ["1", "1"], "angle": ["0", "1"]}] * 2,
}


@pytest.mark.parametrize("key", TAMPERED)
def test_a_path_that_its_pieces_do_not_follow_is_refused(key):
    data = in_a_file().to_json()
    data["bodies"][0]["motion"]["path"][key] = TAMPERED[key]
    with pytest.raises(InputError, match="motion"):
        Scene.from_json(data)
    with pytest.raises(proof_scene.NoProofError, match=r"not such a path|a negative place_error"):
        read_by_the_checker(data)


def test_a_path_excludes_a_spin():
    data = in_a_file().to_json()
    data["bodies"][0]["motion"]["spin"] = {"omega": "1", "error": "1"}
    with pytest.raises(InputError, match="exclude"):
        Scene.from_json(data)
    with pytest.raises(proof_scene.NoProofError, match="both a spin and a path"):
        read_by_the_checker(data)


def test_a_path_that_is_known_less_well_has_wider_bounds():
    path = PosePath([0, 2], [([0, 1], 0, [0, 1])], error="1/1000")
    wide = path.with_place_error("1/100")
    wall = Body("wall", [(2, -9), (2, 9)])
    low, far = (
        first_contact_enclosed(Scene([Body("b", [(0, 0), (1, 0)], p), wall], time=(0, 2))).low
        for p in (path, wide)
    )

    assert (wide.place_error, wide.error, wide.pieces) == (
        Fraction(1, 100), path.error, path.pieces,
    )  # fmt: skip
    assert wide.with_place_error("1/100").place_error == Fraction(1, 50)
    assert low > far
    with pytest.raises(InputError, match="a place_error is not negative: -1"):
        path.with_place_error(-1)


def test_a_path_about_a_pivot_moves_a_body_as_one_about_the_origin_moves_it_shifted():
    # R (p - pivot) + pivot + (x, y): shifted by -pivot, moved about the origin, shifted back.
    px, py = Fraction(7, 3), Fraction(-5)
    poses = [([0, 1], [0, 0, 1], [0, "1/2"]), ([1, 2], [1, 1], "1/2")]
    path = PosePath([0, 1, 2], poses, error="1/1000", pivot=(px, py))
    about_origin = PosePath([0, 1, 2], poses, error="1/1000")
    square = [(0, 0), (4, 0), (4, 1), (0, 1)]
    shifted = [(x - px, y - py) for x, y in square]
    for t in (-1, 0, Fraction(1, 3), 1, Fraction(7, 5), 2, 9):
        expected = [(x + px, y + py) for x, y in Body("b", shifted, about_origin).at(t)]
        assert Body("b", square, path).at(t) == expected
    assert path.pivot == (px, py)
    assert path.pose(1) == about_origin.pose(1)


def test_a_pivot_is_kept_by_every_way_to_make_a_path():
    pivot = (Fraction(1, 3), Fraction(2))
    curve = SimpleNamespace(c=np.array([[[1.0, 0, 0.1]], [[0, 0, 0.2]]]), x=[0, 1])
    through = PosePath.through([0, 1], [(0, 0, 0), (1, 0, 1)], pivot=pivot)
    for path in (through, PosePath.of_curve(curve, pivot=pivot)):
        further = path.with_place_error("1/7")
        copies = (path, further, pickle.loads(pickle.dumps(path)), copy.deepcopy(path))
        assert {one.pivot for one in copies} == {pivot}
        assert pickle.loads(pickle.dumps(further)) == further
    other = PosePath.through([0, 1], [(0, 0, 0), (1, 0, 1)])
    assert through != other


@pytest.mark.parametrize("pivot", [(1,), (1, 2, 3), "12", 5, None, (True, 0), ("nan", 0)])
def test_a_pivot_that_is_no_point_is_refused(pivot):
    with pytest.raises(InputError):
        PosePath([0, 1], [(0, 0, 0)], pivot=pivot)


def test_a_displacement_by_an_angle_error_is_measured_from_the_pivot():
    # The corners of the square are sqrt(2) from its middle, and the middle is 1000 from the origin.
    square = [(999, -1), (1001, -1), (1001, 1), (999, 1)]
    poses = [(0, 0, [0, 1])]
    near = Body("b", square, PosePath([0, 1], poses, error="1/1000", pivot=(1000, 0)))
    far = Body("b", square, PosePath([0, 1], poses, error="1/1000"))
    assert QQ(14, 10**4) < displacement(near, QQ(0), QQ(1)) < QQ(15, 10**4)
    assert displacement(far, QQ(0), QQ(1)) > 1
