"""Turning at a constant rate, against mpmath at 200 digits."""

import json
import pickle
from itertools import pairwise
from random import Random

import mpmath
import pytest

import exactpt
from exactpt import Body, InputError, Pieces, Rigid, Scene, Spin, Translation
from exactpt.kernel.arctangents import atan_bounds, pi_bounds
from exactpt.kernel.numbers import QQ
from exactpt.motion import turned_angle
from exactpt.motion.turned_angle import is_within
from exactpt.scene.format import loads
from exactpt.scene.written import to_json

DIGITS = 200


def real(q):
    return mpmath.mpf(int(q.numerator)) / int(q.denominator)


def off(body, t):
    """By how much the angle at a time is off, from where a point of the body is."""
    (x, y), (px, py) = body.at(t)
    turned = mpmath.atan2(real(y - py), real(x - px))
    rest = (turned - real(body.motion.angle(t))) / (2 * mpmath.pi)
    return abs(rest - mpmath.nint(rest)) * 2 * mpmath.pi


def check(spin, rng, count):
    """At the ends of pieces, the ends of the span, and in between."""
    pivot = spin.motions[0].pivot
    body, ends = Body("b", [(pivot[0] + 1, pivot[1]), pivot], spin), spin.until
    start, end = ends[0], ends[-1]
    times = [start, end, *rng.sample(ends, min(count, len(ends)))]
    times += [start + (end - start) * QQ(rng.randint(0, 10**6), 10**6) for _ in range(count)]
    with mpmath.workdps(DIGITS):
        assert all(off(body, t) <= real(spin.error) for t in times)


@pytest.mark.long("1-1e-40-time5")
@pytest.mark.parametrize(
    "omega, error, time",
    [
        (2, "1/1000", (0, 10)),
        (-1, "1/10", (-7, 20)),
        ("22/7", "1e-6", ("1/3", 1)),
        ("-1/3", "1e-9", (-5, 5)),
        (5, "1e-15", (0, "1/2")),
        (1, "1e-40", (0, 1)),
        ("1/1000", 1, (0, 1)),
        (0, "1/10", (2, 3)),
    ],
)
def test_the_angle_is_within_the_error(omega, error, time):
    check(Spin(omega, ("1/2", 3), time=time, error=error), Random(1), 12)


@pytest.mark.slow
def test_the_angle_is_within_the_error_of_100_spins():
    rng = Random(2)
    for _ in range(100):
        duration = QQ(rng.randint(1, 99), rng.randint(1, 99))
        omega = QQ(rng.randint(-30, 30), rng.randint(1, 99)) / duration
        start = QQ(rng.randint(-(10**4), 10**4), rng.randint(1, 99))
        error = QQ(1, rng.randint(1, 9) * 10 ** rng.randint(1, 12))
        check(Spin(omega, time=(start, start + duration), error=error), rng, 6)


def test_errors_do_not_add_up():
    """After 10^9 turns the angle is as near as at the start."""
    check(Spin(7, time=(10**9, 10**9 + 1), error="1/1000"), Random(3), 12)


def test_pieces_turn_by_less_than_a_quarter():
    for error in (100, 1, "1/10"):
        spin = Spin(1, time=(0, 9), error=error)
        assert all(b - a <= 1.5 for a, b in pairwise(spin.until))


def test_a_spin_begins_and_ends_and_drifts():
    spin = Spin(1, (5, 5), time=(0, 1), error="1/100", x=[0, 2])
    body = Body("b", [(5, 5), (6, 5)], spin)

    assert body.at(-3) == [(-1, 5), (0, 5)]
    assert body.at(4)[0] == (13, 5)
    assert spin.pieces[0][0] == 0
    assert spin.pieces[-1][0] is None
    assert (spin.omega, spin.error) == (1, QQ(1, 100))


@pytest.mark.long
def test_a_mill_meets_a_post_when_it_should():
    """The true time is within error / omega of the one found: the blade has no width."""
    mill = Body("mill", [(0, 0), (5, 0)], Spin(2, time=(0, 4), error="1e-9"))
    contact = exactpt.first_contact(Scene([mill, Body("post", [(-3, -4)])], time=(0, 4)))
    with mpmath.workdps(DIGITS):
        truth = (mpmath.pi + mpmath.atan2(4, 3)) / 2
        assert abs(truth - mpmath.mpf(float(contact.time))) < 1e-9


def test_files_and_pickles_hold_a_spin():
    spin = Spin("1/2", (1, 2), time=(0, 6), error="1/1000", y=[0, 1])
    scene = Scene([Body("b", [(0, 0), (1, 0)], spin)], time=(0, 5))
    data = to_json(scene)
    again = loads(json.dumps(data))

    assert data["bodies"][0]["motion"]["spin"] == {"omega": "1/2", "error": "1/1000"}
    assert again == scene
    assert type(again.bodies[0].motion) is Spin
    assert pickle.loads(pickle.dumps(spin)) == spin
    assert "1/2" in repr(spin)


def test_a_record_that_is_false_is_refused():
    scene = Scene([Body("b", [(0, 0), (1, 0)], Spin(1, time=(0, 2), error="1/100"))], time=(0, 1))
    for key, value in [("omega", "1.1"), ("error", "1/10000"), ("error", "0"), ("omega", "1e9999")]:
        data = to_json(scene)
        data["bodies"][0]["motion"]["spin"][key] = value
        with pytest.raises(InputError, match="body 'b'"):
            loads(json.dumps(data))
    with pytest.raises(InputError, match="do not turn"):
        Spin.of_pieces([(0, Translation()), (1, Rigid(0)), (None, Rigid(0))], 0, 1)
    with pytest.raises(InputError, match="do not turn"):
        Spin.of_pieces([(0, Rigid(0)), (1, Rigid([0, 2])), (None, Rigid(2))], 0, 1)


@pytest.mark.parametrize(
    "options, what",
    [
        ({"time": (1, 1)}, "a span ends after it starts"),
        ({"time": 3}, "a start and an end"),
        ({"time": (0, 1), "error": 0}, "an error is positive"),
        ({"time": (0, 10**12)}, "more than 100000 pieces"),
        ({"time": (0, 1), "error": "1e-5000"}, "too small"),
        ({"time": (0, 1), "pivot": (1,)}, "pivot"),
    ],
)
def test_what_is_no_spin(options, what):
    with pytest.raises(InputError, match=what):
        Spin(1, **options)


def test_a_spin_that_goes_onward_has_pieces_alone():
    body = Body("b", [(0, 0), (1, 0)], Spin(1, time=(0, 2), error="1/100"))
    after = body.with_motion(exactpt.onward(body, 1, (3, 0)))

    assert type(after.motion) is Pieces
    assert after.at(1) == body.at(1)


def test_bounds_of_arc_tangents():
    with mpmath.workdps(DIGITS):
        for bits in (10, 64, 300):
            for x in (QQ(0), QQ(1), QQ(-1), QQ(1, 2), QQ(51, 100), QQ(-3, 7), QQ(1, 10**9)):
                low, high = atan_bounds(x, bits)
                assert real(low) <= mpmath.atan(real(x)) <= real(high)
                assert high - low <= QQ(1, 2**bits)
            low, high = pi_bounds(bits)
            assert real(low) < mpmath.pi < real(high)
            assert high - low <= QQ(1, 2**bits)


def test_pieces_of_the_default_error_have_half_turns_of_degree_3():
    """Of degree 1 they were 856; the angle is as near."""
    spin = Spin(1, time=(0, 20))

    assert len(spin.pieces) == 130
    assert {motion.half_turn.degree for _, motion in spin.pieces[1:-1]} == {3}
    assert is_within(spin, QQ(1), QQ(1, 10**6))
    assert not is_within(spin, QQ(1), QQ(1, 10**7))


def test_a_spin_has_half_turns_of_the_given_degree():
    spin = Spin(1, time=(0, 20), degree=1)

    assert len(spin.pieces) == 856
    assert {motion.half_turn.degree for _, motion in spin.pieces[1:-1]} == {1}
    for degree in (0, 2, -1, 33, True, "1", 10**5000):
        with pytest.raises(InputError, match="the degree of a half turn is odd, from 1 to 31"):
            Spin(1, time=(0, 20), degree=degree)


def test_pieces_of_one_duration_have_one_proof(monkeypatch):
    """Each piece had bounds of its own."""
    bounds, ranges = [], turned_angle._range_of
    monkeypatch.setattr(turned_angle, "_range_of", lambda *a: bounds.append(1) or ranges(*a))
    assert len(Spin(1, time=(0, 20)).pieces) == 130
    assert len(bounds) <= 4


def test_a_proof_of_many_pieces_is_one_of_each(monkeypatch):
    spins = [Spin("5/3", time=(-1, 1), error=error) for error in ("1/10", "1/500")]
    errors = [(spin, spin.exact_error * QQ(k, 16)) for spin in spins for k in range(8, 17)]
    many = [is_within(spin, QQ(5, 3), error) for spin, error in errors]
    within = turned_angle._are_within

    def each(group, starts, omega, error):
        return all(within(group, [start], omega, error) for start in starts)

    monkeypatch.setattr(turned_angle, "_are_within", each)
    assert many == [is_within(spin, QQ(5, 3), error) for spin, error in errors]
    assert len(set(many)) == 2


@pytest.mark.parametrize("by", [QQ(1, 10**4), QQ(-1, 10**4)])
def test_one_piece_that_differs_in_its_last_coefficient_is_refused(by):
    spin = Spin(1, time=(0, 3))
    pieces = list(spin.pieces)
    until, turn = pieces[7]
    begin = pieces[6][0]
    more = exactpt.Polynomial([-begin, 1]) ** 3 * (by / (until - begin) ** 3)
    pieces[7] = until, Rigid(turn.half_turn + more, orientation=turn.orientation)
    assert is_within(Pieces(spin.pieces), QQ(1), QQ(1, 10**6))
    assert not is_within(Pieces(pieces), QQ(1), QQ(1, 10**6))
