"""Turning at a constant rate, against mpmath at 256 bits."""

import json
import pickle
from fractions import Fraction
from itertools import pairwise
from random import Random

import mpmath
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import exactpt
from exactpt import (
    AlgebraicNumber,
    Body,
    InputError,
    Pieces,
    PosePath,
    Rigid,
    Scene,
    Spin,
    Translation,
)
from exactpt.kernel.arctangents import atan_bounds, pi_bounds
from exactpt.kernel.numbers import QQ
from exactpt.motion.path_error import angle_error
from exactpt.motion.pose_pieces import PieceMaker
from exactpt.scene.format import loads
from exactpt.scene.written import to_json

BITS = 256
SQUARE = [(0, 0), (2, 0), (2, 2), (0, 2)]


def real(q):
    return mpmath.mpf(int(q.numerator)) / int(q.denominator)


def off(body, t):
    """By how much the angle at a time is off, from where a point of the body is."""
    (x, y), (px, py) = body.exact_at(t)
    turned = mpmath.atan2(real(y - py), real(x - px))
    rest = (turned - real(body.motion.angle.exact_at(t))) / (2 * mpmath.pi)
    return abs(rest - mpmath.nint(rest)) * 2 * mpmath.pi


def check(spin, rng, span, count):
    """At the ends of pieces and in between."""
    (px, py), (start, end) = spin.exact_pivot, map(QQ, span)
    body = Body("b", [(px + 1, py), (px, py)], spin)
    times = [start + (end - start) * QQ(rng.randint(0, 10**6), 10**6) for _ in range(count)]
    if spin.exact_step:
        times += [(t // spin.exact_step) * spin.exact_step for t in times]
    with mpmath.workprec(BITS + 700):
        assert all(off(body, t) <= real(spin.exact_error) for t in times)


@pytest.mark.parametrize(
    "omega, error, span",
    [
        (2, "1/1000", (0, 10)),
        (-1, "1/10", (-7, 20)),
        ("22/7", "1e-6", (Fraction(1, 3), 1)),
        ("-1/3", "1e-9", (-5, 5)),
        (5, "1e-15", (0, Fraction(1, 2))),
        (1, "1e-40", (0, 1)),
        (1, "1e-100", (-1, 1)),
        ("1/1000", 1, (0, 1)),
        (3, 1000, (-9, 9)),
        (0, "1/10", (2, 3)),
        ("1e-30", "1e-3", (-(10**31), 10**31)),
        ("1e30", "1e-3", (-1, 1)),
        ("1e-300", "1e-9", (0, 10**300)),
        (7, "1e-3", (10**9, 10**9 + 1)),
        (7, "1e-6", (-(10**60), 10**60)),
    ],
)
def test_angle_is_within_the_error_at_any_time(omega, error, span):
    check(Spin(omega, ("1/2", 3), error=error), Random(1), span, 12)


@pytest.mark.slow
def test_angle_of_100_random_spins_is_within_the_error():
    rng = Random(2)
    for _ in range(100):
        omega = QQ(rng.randint(-3000, 3000), rng.randint(1, 99))
        start = QQ(rng.randint(-(10**4), 10**4), rng.randint(1, 99))
        error = QQ(1, rng.randint(1, 9) * 10 ** rng.randint(1, 12))
        check(Spin(omega, error=error), rng, (start, start + 5), 6)


@pytest.mark.parametrize(
    "omega, error, step",
    [
        (1, 1, QQ(1, 4)),  # a = 1/4
        (1, "1e-6", QQ(1, 4)),  # 4^-5 < 0.00098 <= 1200 10^-6
        (-1, "1e-6", QQ(1, 4)),
        (2, "1e-6", QQ(1, 8)),
        (3, "1e-6", QQ(10, 128)),  # 3 * 11/128 > 1/4
        (1, "1e-9", QQ(8, 128)),  # 0.0625^5 < 0.96 10^-6 <= 1.2 10^-6 < 0.07^5, 9/128 > 0.07
        ("1e-300", 1, None),
        (0, 1, None),
    ],
)
def test_step_is_the_longest_that_the_error_allows(omega, error, step):
    spin = Spin(omega, (5, 5), error=error, x=[1, 2])
    if step is not None:
        assert spin.exact_step == step
    if spin.exact_step is None:
        assert spin.exact_omega == 0
        return
    turned = abs(spin.exact_omega) * spin.exact_step
    assert turned <= QQ(1, 4)
    assert turned**5 <= 1200 * spin.exact_error
    longer = turned * QQ(9, 8)
    assert longer > QQ(1, 4) or longer**5 > 1200 * spin.exact_error


@pytest.mark.parametrize("error", ["100", "1", "1/10", "1e-3", "1e-6", "1e-9", "1e-20", "1e-100"])
def test_bound_of_a_piece_is_at_most_87_hundredths_of_the_error(error):
    """As the docstring of the module derives it; a proof that failed would be an assertion."""
    rng = Random(3)
    for _ in range(20):
        omega = QQ(rng.randint(1, 10**6), rng.randint(1, 10**4)) * rng.choice([1, -1])
        spin, k = Spin(omega, error=error), rng.randint(-(10**12), 10**12)
        start = k * spin.exact_step
        turn, end = spin.exact_formula_after(start)
        assert end == start + spin.exact_step
        bound = angle_error(turn, start, end, spin.angle, spin.exact_error)
        assert bound <= spin.exact_error * QQ(87, 100)


def test_pieces_meet_exactly_at_the_grid():
    rng = Random(4)
    for _ in range(50):
        spin = Spin(
            QQ(rng.randint(1, 999), 100), (rng.randint(0, 9), 1), error="1e-6", y=[0, 1, "1/2"]
        )
        t = rng.randint(-(10**6), 10**6) * spin.exact_step
        before, end = spin.exact_formula_after(t - spin.exact_step / 2)
        after, _ = spin.exact_formula_after(t)
        assert end == t
        assert before.exact_map_at(t) == after.exact_map_at(t)


rationals = st.fractions(-4, 4, max_denominator=12)
spans = st.tuples(rationals, rationals).filter(lambda span: span[0] != span[1]).map(sorted)


@settings(max_examples=25, deadline=None)
@given(
    st.sampled_from(["1/2", "-1", "22/7"]),
    st.sampled_from(["1", "1/1000", "1e-6"]),
    st.lists(spans, max_size=3),
    spans,
)
def test_pieces_are_the_same_whatever_was_asked_before(omega, error, asked, span):
    fresh, used = (Spin(omega, (1, 2), error=error, x=[0, 1]) for _ in range(2))
    body = Body("b", SQUARE, used)
    for start, end in asked:
        used.pieces_during(start, end)
        body.at(start)
        body.breakpoints_between(start, end)
    texts = [json.dumps(to_json(Scene([Body("b", SQUARE, one)], span))) for one in (fresh, used)]
    assert texts[0] == texts[1]
    start, end = span
    scene = Scene([body], span)
    assert scene.to_json() == scene.until(end).to_json()
    wide = fresh.pieces_during(start - 1, end + 1)
    part = used.pieces_during(start, end)
    assert part.pieces[1:-1] == tuple(
        piece for piece in wide.pieces[1:-1] if part.until[0] < piece[0] <= part.until[-1]
    )


def test_pieces_cover_a_span_from_grid_to_grid():
    pieces = Spin(1).pieces_during("1/3", "4/3")

    assert pieces.until == (QQ(1, 4), QQ(1, 2), QQ(3, 4), 1, QQ(5, 4), QQ(3, 2))
    assert pieces.motions[0].half_turn == pieces.motions[-1].half_turn == exactpt.Polynomial()
    assert Spin(1).pieces_during(0, 1).until == (0, QQ(1, 4), QQ(1, 2), QQ(3, 4), 1)


def test_a_body_and_a_scene_make_no_piece(monkeypatch):
    made = []
    make = PieceMaker.piece
    monkeypatch.setattr(PieceMaker, "piece", lambda *given: made.append(1) or make(*given))
    spin = Spin(1, (1, 1))
    bodies = [
        Body("square", SQUARE, spin),
        Body("chain", [(9, 0), (9, 1), (10, 1)], spin, closed=False),
        Body("ring", [(x * 5, y * 5) for x, y in SQUARE], spin, holes=[[(1, 1), (2, 1), (1, 2)]]),
        Body("wide", SQUARE, spin, place_error=1, angle_error="1/9"),
    ]
    scene = Scene(bodies, (0, 10))
    assert bodies[0].breakpoints_between(0, 1) == (QQ(1, 4), QQ(1, 2), QQ(3, 4))
    assert not made
    assert scene.body("square").at("1/3")
    assert len(made) == 1
    assert scene.body("ring").at("1/3")
    assert len(made) == 1
    with pytest.raises(InputError, match="not valid at the start"):
        Scene([Body("knot", [(0, 0), (1, 1), (1, 0), (0, 1)], spin)], (1, 2))


def test_a_spin_turns_at_all_times_and_drifts():
    spin = Spin(1, (5, 5), error="1/100", x=[0, 2])
    body = Body("b", [(5, 5), (6, 5)], spin)

    assert body.at(0) == [(5, 5), (6, 5)]
    assert body.at(-3)[0] == (-1, 5)
    assert body.at(4)[0] == (13, 5)
    x, y = body.at(-3)[1]
    assert abs(float(x) + 1 - float(mpmath.cos(3))) < 0.01
    assert abs(float(y) - 5 + float(mpmath.sin(3))) < 0.01
    assert (spin.omega, spin.error, spin.pivot) == (1, QQ(1, 100), (5, 5))


@pytest.mark.long
def test_a_mill_meets_a_post_when_it_should():
    """The true time is within error / omega of the one found: the blade has no width."""
    mill = Body("mill", [(0, 0), (5, 0)], Spin(2, error="1e-9"))
    contact = exactpt.first_contact(Scene([mill, Body("post", [(-3, -4)])], time=(0, 4)))
    with mpmath.workprec(BITS):
        truth = (mpmath.pi + mpmath.atan2(4, 3)) / 2
        assert abs(truth - mpmath.mpf(float(contact.time))) < 1e-9


def test_a_spin_without_a_rate_is_one_piece():
    spin = Spin(0, (1, 1), x=[0, 1])
    body = Body("b", SQUARE, spin)
    scene = Scene([body], (0, 4))

    assert body.breakpoints == ()
    assert body.at(7) == [(x + 7, y) for x, y in SQUARE]
    assert len(spin.pieces_during(0, 4).motions) == 3
    assert loads(json.dumps(to_json(scene))) == scene


def test_files_and_pickles_hold_a_spin():
    spin = Spin("1/2", (1, 2), error="1/1000", y=[0, 1])
    scene = Scene([Body("b", [(0, 0), (1, 0)], spin)], time=(0, 5))
    data = to_json(scene)
    again = loads(json.dumps(data))

    assert data["bodies"][0]["motion"]["spin"] == {
        "omega": "1/2",
        "error": "1/1000",
        "pivot": ["1", "2"],
    }
    halves = [str(QQ(k, 2)) for k in range(11)]
    assert [piece.get("until") for piece in data["bodies"][0]["motion"]["pieces"]] == [
        *halves,
        None,
    ]
    assert again == scene
    assert type(again.bodies[0].motion) is Spin
    assert again.bodies[0].motion == spin
    assert pickle.loads(pickle.dumps(spin)) == spin
    assert hash(pickle.loads(pickle.dumps(spin))) == hash(spin)
    assert spin != Spin("1/2", (1, 2), error="1/1001", y=[0, 1])
    assert repr(spin) == "Spin('1/2', ('1', '2'), error='1/1000', y=Polynomial(['0', '1']))"
    shorter = data | {"time": ["1", "2"]}
    assert loads(json.dumps(shorter)).bodies[0].motion == spin


def test_a_record_that_is_false_is_refused():
    scene = Scene([Body("b", [(0, 0), (1, 0)], Spin(1, error="1/100"))], time=(0, 1))
    for key, value in [
        ("omega", "1.1"),
        ("error", "1/10000000"),
        ("error", "0"),
        ("omega", "1e9999"),
    ]:
        data = to_json(scene)
        data["bodies"][0]["motion"]["spin"][key] = value
        with pytest.raises(InputError, match="body 'b'"):
            loads(json.dumps(data))


def file_of(pieces, span, omega="1", error="1/100"):
    """A scene file with pieces that another program made."""
    scene = Scene([Body("b", [(0, 0), (1, 0)], Pieces(pieces))], span)
    data = to_json(scene)
    data["bodies"][0]["motion"]["spin"] = {"omega": omega, "error": error}
    return json.dumps(data)


def other_pieces(x=0):
    """Half turns of degree 1, from 1 to 2, with rest before and after."""
    ends = [QQ(k, 8) for k in range(8, 17)]
    vectors = [Spin(1, error="1e-6").exact_formula_after(t)[0].exact_orientation for t in ends[::2]]
    pieces = [(1, Rigid(0, x=x, orientation=vectors[0]))]
    for (a, u), (b, v) in pairwise(zip(ends[::2], vectors, strict=True)):
        h = (u[0] * v[1] - u[1] * v[0]) / (1 + u[0] * v[0] + u[1] * v[1])
        pieces.append((b, Rigid([-a * h / (b - a), h / (b - a)], x=x, orientation=u)))
    return [*pieces, (None, Rigid(0, x=x, orientation=vectors[-1]))]


@pytest.mark.parametrize("x", [0, [0, 1], [1, 0, "1/8"]])
@pytest.mark.parametrize("span", [(1, 2), ("5/4", "3/2"), (0, 3), ("3/2", 3), (0, "3/2"), (5, 6)])
def test_pieces_of_another_program_are_a_path(x, span):
    """They turn as their record says, from 1 to 2, and are translated at all times."""
    pieces = Pieces(other_pieces(x))
    scene = loads(file_of(pieces.pieces, span))
    motion = scene.bodies[0].motion

    assert type(motion) is PosePath
    assert (motion.error, motion.assumed_angle_error, motion.place_error) == (QQ(1, 100), 0, 0)
    body, start, end = scene.bodies[0], scene.exact_start, scene.exact_end
    given = Body("b", [(0, 0), (1, 0)], pieces)
    for k in range(9):
        t = start + (end - start) * QQ(k, 8)
        assert body.exact_at(t) == given.exact_at(t)
        assert motion.pose(t)[2] == min(max(t, 1), 2)
    assert Scene.from_json(scene.to_json()) == scene


@pytest.mark.parametrize(
    "pieces, what",
    [
        ([(0, Translation()), (1, Rigid(0)), (None, Rigid(0))], "at least three rigid motions"),
        ([(1, Rigid(0)), (None, Rigid(0))], "at least three rigid motions"),
        ([(0, Rigid(0)), (1, Rigid([0, 2])), (None, Rigid(2))], "within 1/100"),
        ([(0, Rigid([0, 1])), (1, Rigid([0, 1])), (None, Rigid(1))], "must not turn"),
    ],
)
def test_pieces_that_do_not_turn_so_are_refused(pieces, what):
    with pytest.raises(InputError, match=what):
        loads(file_of(pieces, (0, 1)))


def test_half_a_spin_of_this_program_is_a_path():
    """A file whose span was made longer than its pieces: after them the body does not turn."""
    scene = Scene([Body("b", [(0, 0), (1, 0)], Spin(1, error="1/100"))], time=(0, 1))
    data = to_json(scene) | {"time": ["0", "2"]}
    motion = loads(json.dumps(data)).bodies[0].motion

    assert type(motion) is PosePath
    assert motion.pose(2)[2] == 1


def test_breakpoints_are_those_of_the_turn_and_the_shape():
    frames = [(0, [(0, 0), (1, 0)]), ("1/3", [(0, 0), (2, 0)])]
    body = Body("b", keyframes=frames, motion=Spin(1))

    expected = (QQ(-1, 4), 0, QQ(1, 4), QQ(1, 3), QQ(1, 2))
    assert body.breakpoints_between("-1/2", "3/4") == expected
    assert body.breakpoints_between(0, "1/4") == ()
    twelfths = [n for n in (0, 1, 3, 4, 5, 6) if body.exact_is_breakpoint(QQ(n, 12))]
    assert twelfths == [0, 3, 4, 6]
    assert body.exact_piece_after(QQ(1, 4)).until == QQ(1, 3)
    assert body.exact_piece_after(QQ(1, 3)).until == QQ(1, 2)


QUARTERS = Pieces([*((QQ(k, 4), Rigid(0)) for k in range(1, 9)), (None, Rigid(0))])


@pytest.mark.parametrize("motion", [Spin(1), QUARTERS], ids=["spin", "pieces"])
def test_last_breakpoint_before_a_time_and_at_it(motion):
    """Both change each quarter; the root of 1/2 is between 1/2 and 3/4."""
    body, root = (
        Body("b", [(0, 0), (1, 0)], motion),
        AlgebraicNumber.exact_root((-1, 0, 2), QQ(0), QQ(1)),
    )
    half, start = AlgebraicNumber("1/2"), QQ(1, 3)

    assert body.exact_last_breakpoint(root, start) == QQ(1, 2)
    assert body.exact_last_breakpoint(root, start, before=True) == QQ(1, 2)
    assert body.exact_last_breakpoint(half, start) == QQ(1, 2)
    assert body.exact_last_breakpoint(half, start, before=True) == start
    assert body.exact_last_breakpoint(half, QQ(1, 4), before=True) == QQ(1, 4)
    assert body.exact_last_breakpoint(half, QQ(1, 8), before=True) == QQ(1, 4)
    assert body.exact_last_breakpoint(half, QQ(1, 2)) == QQ(1, 2)


@pytest.mark.parametrize(
    "options, what",
    [
        ({"error": 0}, "an error is positive"),
        ({"error": "1e-5000"}, "too small"),
        ({"pivot": (1,)}, "pivot"),
        ({"x": "abc"}, "number"),
    ],
)
def test_what_is_no_spin(options, what):
    with pytest.raises(InputError, match=what):
        Spin(1, **options)


def test_pieces_without_end_are_refused():
    body = Body("b", [(0, 0), (1, 0)], Spin(1))
    with pytest.raises(InputError, match="no end of the pieces of Spin"):
        _ = body.breakpoints
    with pytest.raises(InputError, match="more than 100000 pieces"):
        body.breakpoints_between(0, 10**12)
    with pytest.raises(InputError, match="more than 100000 pieces"):
        Scene([body], (0, 10**12)).to_json()
    with pytest.raises(InputError, match="a span ends after it starts"):
        body.motion.pieces_during(1, 1)
    with pytest.raises(InputError, match="too small for angles"):
        body.at(2**600)


def test_a_spin_that_goes_onward_turns_on():
    body = Body("b", [(0, 0), (1, 0)], Spin(1, error="1/100"))
    after = body.with_motion(exactpt.onward(body, 1, (3, 0)))

    assert after.motion == Spin(1, error="1/100", x=[-3, 3])
    assert after.at(1) == body.at(1)


def test_bounds_of_arc_tangents():
    with mpmath.workprec(2 * BITS + 200):
        for bits in (10, 64, 300):
            for x in (QQ(0), QQ(1), QQ(-1), QQ(1, 2), QQ(51, 100), QQ(-3, 7), QQ(1, 10**9)):
                low, high = atan_bounds(x, bits)
                assert real(low) <= mpmath.atan(real(x)) <= real(high)
                assert high - low <= QQ(1, 2**bits)
            low, high = pi_bounds(bits)
            assert real(low) < mpmath.pi < real(high)
            assert high - low <= QQ(1, 2**bits)


def test_half_turns_are_of_degree_3():
    pieces = Spin(1).pieces_during(0, 20)

    assert len(pieces.pieces) == 82
    assert {motion.half_turn.degree for motion in pieces.motions[1:-1]} == {3}
