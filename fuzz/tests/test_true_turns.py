"""The true times of contact of bodies that turn, and what is found wrong by them."""

import mpmath
import pytest

from exactpt import AlgebraicNumber, Body, PosePath, Rigid, Scene, Spin, Translation
from exactpt.kernel.numbers import QQ
from fuzz.questions import spinning
from fuzz.questions.spinning import case_of
from fuzz.references.true_turns import DIGITS, Truth

BLADE = Body("blade", [(0, 0), (2, 0)], Spin(1, error="1/1000"))
WALL = Body("wall", [(-1, 1), (1, 1), (1, 2), (-1, 2)])


def true_time(*bodies, time=(0, 3)):
    return Truth(Scene(bodies, time=time)).first_contact()


def is_near(t, expected):
    with mpmath.workdps(DIGITS + 20):
        return abs(t - expected()) < mpmath.mpf(10) ** -DIGITS


def test_true_times_to_200_digits():
    post = Body("post", [(0, 1)])
    disc = Body("disc", [(0, 0)], Translation([0, "1/2"], [2]), radius="1/3")
    orbit = Body("orbit", [(2, 0)], Spin(2, (1, 0)), radius="2/3")

    assert is_near(true_time(BLADE, WALL), lambda: mpmath.pi / 4)
    assert is_near(true_time(BLADE, post), lambda: mpmath.pi / 2)
    assert is_near(
        true_time(orbit, Body("p", [(1, 1)])),
        lambda: (mpmath.pi / 2 - 2 * mpmath.asin(mpmath.mpf(1) / 3)) / 2,
    )
    t = true_time(BLADE, disc)
    with mpmath.workdps(DIGITS + 20):
        turn, centre = mpmath.expj(t), mpmath.mpc(t / 2, 2)
        along = turn.conjugate() * centre
        nearest = abs(along.imag) if along.real <= 2 else abs(centre - turn * 2)
        assert abs(nearest - mpmath.mpf(1) / 3) < mpmath.mpf(10) ** -DIGITS


def test_true_times_on_paths():
    """The blade turns by t, also in two pieces, and is carried up by t^2 / 4 in the second test."""
    turns = PosePath([0, "1/2", 3], [(0, 0, [0, 1]), (0, 0, ["1/2", 1])])
    rises = PosePath([0, 3], [(0, [0, 0, "1/4"], [0, 1])])
    ends = BLADE.vertices

    assert is_near(true_time(Body("b", ends, turns), WALL), lambda: mpmath.pi / 4)
    t = true_time(Body("b", ends, rises), Body("wall", [(-9, 1), (9, 1)]))
    with mpmath.workdps(DIGITS + 20):
        assert abs(2 * mpmath.sin(t) + t * t / 4 - 1) < mpmath.mpf(10) ** -DIGITS


def test_wrong_bounds_on_paths_are_found(monkeypatch):
    path = PosePath([0, 3], [(0, 0, [0, 1])], error="1/1000")
    scene = Scene([Body("b", BLADE.vertices, path), Body("post", [(0, 1)])], time=(0, 3))

    assert is_certain(case_of(scene))
    monkeypatch.setattr(spinning, "first_contact_enclosed", moved(low=0.01, high=0.02))
    assert case_of(scene).kind == "too late"


def test_true_contacts_at_the_start_and_none():
    inside = Body("b", [(0, 1.5)], Translation([0, 5]))

    assert true_time(WALL, inside) == 0
    assert true_time(BLADE, WALL, time=(0, "1/2")) is None
    assert true_time(BLADE, Body("post", [(0, 3)])) is None


def is_certain(case):
    """Bounds that contain the true time, of a width between twice E / v and what is allowed."""
    widths = [f"certain, at most {n / 4} E / v wide" for n in range(8, 17)]
    return case.fault is None and case.kind in widths


def moved(low=0.0, high=0.0):
    def bounds_of(scene):
        found = spinning_bounds(scene)
        ends = (found.low, found.high)
        return found.__class__(
            *(AlgebraicNumber(float(t) + by) for t, by in zip(ends, (low, high), strict=True)),
            found.pairs,
        )

    return bounds_of


spinning_bounds = spinning.first_contact_enclosed


@pytest.mark.parametrize(
    "bounds_of, kind",
    [
        (spinning_bounds, None),
        (lambda _: None, "never"),
        (moved(low=0.01, high=0.02), "too late"),
        (moved(high=-0.003), "too early"),
        (moved(high=0.02), "certain, and wide"),
        (lambda s: spinning_bounds(s).__class__(spinning_bounds(s).low, None, ()), "not certain"),
    ],
)
def test_wrong_bounds_are_found(bounds_of, kind, monkeypatch):
    """The blade sweeps over a point far from its ends: the bounds are to be near."""
    scene = Scene([BLADE, Body("post", [(0, 1)])], time=(0, 3))
    monkeypatch.setattr(spinning, "first_contact_enclosed", bounds_of)
    case = case_of(scene)

    if kind is None:
        assert is_certain(case)
    else:
        assert case.kind == kind
        assert case.fault is not None


def ahead(spin, error, by):
    """A path of the angle of a spin, within an error, whose pieces are turned by 2 arctan(by)."""
    pieces = spin.pieces_during(0, 3)
    cos, sin = (1 - by**2) / (1 + by**2), 2 * by / (1 + by**2)
    turned = []
    for until, piece in pieces.pieces:
        c, s = piece.exact_orientation
        orientation = c * cos - s * sin, s * cos + c * sin
        turned.append((until, Rigid(piece.half_turn, orientation=orientation)))
    poses = [(0, 0, [0, spin.omega])]
    return PosePath.of_pieces(turned, [0, pieces.until[-1]], poses, error)


def test_bodies_that_passed_within_both_errors_may_graze():
    """2 E apart in truth, the given bodies may be E apart.

    A segment passes the mill at 1.1 E long before it meets it; the given mill, which is ahead by
    nearly the error, is within E then, and the bounds begin there.
    """
    mill = ahead(Spin("-441/512", error="1/1000"), "1/50", by=QQ(-9, 1000))
    places = [("135/512", "6103/4096"), ("647/512", "22405/12288")]
    path = Translation([0, "61/128"], [0, "-283/256"])
    corner = Body("mill", [(3, 0), (0, 0), (0, 3)], mill, closed=False)

    case = case_of(Scene([corner, Body("segment", places, path)], time=(0, 3)))

    assert case == ("certain, and may graze", None)
