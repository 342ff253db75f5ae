"""What is asked for the wrong way is refused in one line, and changes nothing."""

import json
import math

import pytest
from folding import every

from exactpt import (
    Affine,
    Body,
    Bounce,
    InputError,
    Pieces,
    Polynomial,
    Rigid,
    Scene,
    Simulation,
    Translation,
    first_contact,
    onward,
)
from exactpt.kernel.numbers import QQ
from exactpt.query.space import FreeSpace
from exactpt.testing.scenes import generate
from exactpt.tiling.start import start_tiling

POINT = Body("p", [(0, 0)])


def pieces():
    return Pieces([(1, Translation()), (None, Translation())])


WRONG = {
    "a scene of no bodies": lambda: Scene([1]),
    "no time span": lambda: Scene([POINT], None),
    "half a time span": lambda: Scene([POINT], (0,)),
    "a number for a name": lambda: Body(5, [(0, 0)]),
    "half a letter for a name": lambda: Body("\ud800", [(0, 0)]),
    "no motion": lambda: Body("p", [(0, 0)], 3),
    "pieces in pieces": lambda: Pieces([(1, Translation()), (None, pieces())]),
    "a number for a pivot": lambda: Rigid([0, 1], pivot=3),
    "a number for a matrix": lambda: Affine(3),
    "a row for a matrix": lambda: Affine([[1, 0]]),
    "a text for coefficients": lambda: Polynomial("12"),
    "a number for coefficients": lambda: Polynomial(12),
    "half a velocity": lambda: onward(POINT, 0, (1,)),
    "a grid of width 0": lambda: onward(POINT, 0, (1, 1), grid=0),
    "a bounce on no grid": lambda: Bounce(grid=0),
    "a bounce at rest": lambda: Bounce(slowest=0),
    "a text for names": lambda: Bounce(fixed="wall"),
    "no tiling, by pairs": lambda: first_contact(Scene([POINT]), method="pairs", tiling="x"),
    "fewer events than none": lambda: Simulation(Scene([POINT]), max_events=-1),
    "no number of seconds": lambda: Simulation(Scene([POINT]), max_seconds=math.nan),
    "a plan that is none": lambda: Simulation(Scene([POINT])).set_motion("p", None),
}


@every("name", WRONG)
def test_what_is_wrong_is_refused_in_one_line(name):
    with pytest.raises(InputError) as refusal:
        WRONG[name]()

    assert len(str(refusal.value).splitlines()) == 1


def test_a_text_is_a_number_where_a_polynomial_may_be_one():
    assert Translation("12").x == Polynomial([12])


def fall(*more, size=1):
    ball = Body(
        "ball", [(0, size), (size, 2 * size), (-size, 2 * size)], Translation(0, [0, -size])
    )
    floor = Body("floor", [(-5 * size, 0), (5 * size, 0)])
    return Scene([ball, floor, *more], (0, 4))


def test_time_does_not_go_back():
    simulation = Simulation(fall(Body("far", [(90, 0)])))
    assert list(simulation.run("1/2")) == []

    with pytest.raises(InputError, match="is over"):
        list(simulation.run("1/4"))
    assert simulation.now == QQ(1, 2)
    assert list(simulation.run("1/2")) == []


def test_a_plan_of_another_body_does_not_keep_a_contact_away():
    simulation = Simulation(fall(Body("far", [(90, 0)])))
    met = []

    def look_elsewhere(sim, contact):
        met.append(contact)
        sim.set_motion("far", Translation())

    list(simulation.run(on_contact=look_elsewhere))

    assert len(met) == 1
    assert simulation.contact.time == 1
    assert simulation.contacts == 1


def test_a_body_can_be_read_after_a_contact():
    simulation = Simulation(fall())
    list(simulation.run())

    assert simulation.contact is not None
    assert simulation.body("ball").name == "ball"
    with pytest.raises(InputError, match="no body 'owl'"):
        simulation.body("owl")


def test_a_body_can_be_read_where_all_touch():
    simulation = Simulation(Scene([POINT, Body("q", [(0, 0)])]))
    assert simulation.body("q").size == 1


@pytest.mark.parametrize("exponent", [-400, -200, 0, 200, 400])
def test_normals_have_length_one_at_any_size(exponent):
    size = QQ(10) ** exponent
    contact = first_contact(fall(size=size))

    assert contact.time == 1
    assert [pair.normal for pair in contact.pairs] == [(0.0, 1.0)]
    json.dumps(contact.to_json(), allow_nan=False)


@pytest.mark.parametrize("exponent", [-200, 200])
def test_bounces_at_sizes_whose_squares_are_no_doubles(exponent):
    size = QQ(10) ** exponent
    simulation = Simulation(fall(size=size))
    bounce = Bounce(fixed=["floor"], slowest=size / 16, grid=size / 2**20)

    events = list(simulation.run(on_contact=bounce))

    assert [event.kind for event in events] == ["contact", "motion"]
    assert simulation.body("ball").motion.y.derivative()(2) > 0


def test_a_time_beyond_all_doubles_is_told_as_the_largest():
    late = Scene([Body("a", [(0, 0)], Translation([0, QQ(1, 10**350)])), Body("b", [(3, 0)])],
                 (0, 10**351))  # fmt: skip
    answer = first_contact(late).to_json()

    assert answer["time"]["approx"] == 1.7976931348623157e308
    json.dumps(answer, allow_nan=False)


def test_what_no_file_can_hold_is_not_written(tmp_path):
    long = Scene([Body("p", [(QQ(1, 3**40_000), 0)])])

    for thing in (long, Simulation(long)):
        with pytest.raises(InputError, match=r"body 'p': more than 10000 digits .* file: 1/"):
            thing.save(tmp_path / "file.json")
    assert not list(tmp_path.iterdir())


@pytest.mark.parametrize("tiling", ["lazy", "mixed"])
def test_a_space_is_of_its_time_or_says_that_it_cannot_be(tiling):
    cup = [(0, 0), (9, 0), (9, 8), (8, 8), (8, 1), (1, 1), (1, 8), (0, 8)]
    jump = Pieces([(2, Translation()), (None, Translation(0, [-80, 40]))])
    box = Body("box", [(4, 3), (5, 3), (5, 4), (4, 4)], jump)
    simulation = Simulation(Scene([Body("cup", cup), box], (0, 3)), tiling=tiling)
    list(simulation.run(1))
    asked, kept = (FreeSpace(simulation.kinetic, QQ(1)) for _ in range(2))
    hull = asked.relative_hull("cup")
    list(simulation.run("5/2"))

    assert simulation.space("5/2").relative_hull("cup") != hull
    assert asked.relative_hull("cup") == hull
    if tiling == "mixed":
        assert kept.relative_hull("cup") == hull
    else:
        with pytest.raises(InputError, match="make the space anew"):
            kept.relative_hull("cup")


def test_what_is_proved_is_not_more_than_is_so():
    points = Scene([Body(str(i), [(i, i * i)]) for i in range(9)], (0, 100))
    simulation = Simulation(points)
    list(simulation.run(99))
    simulation.add(Body("more", [(50, -50)]))

    assert simulation.passed() <= simulation.now.low == 99


def test_a_contact_that_was_met_is_known_after_the_run_is_restored(tmp_path):
    def look_elsewhere(sim, _):
        sim.set_motion("far", Translation())

    def kinds(run):
        return [event.kind for event in run.run(on_contact=look_elsewhere)]

    whole = Simulation(fall(Body("far", [(90, 0)])))
    expected = kinds(whole)
    cut = Simulation(fall(Body("far", [(90, 0)])))
    events = cut.run(on_contact=look_elsewhere)
    reported = [next(events).kind for _ in range(1 + expected.index("contact"))]
    cut.save(tmp_path / "run.json")
    restored = Simulation.restore(tmp_path / "run.json")

    assert reported + kinds(restored) == expected
    assert restored.contacts == whole.contacts == 1


@pytest.mark.parametrize("far", [(500, -9000), (9000, 70), (-3, 4)])
def test_a_path_does_not_depend_on_what_was_asked_before(far):
    scene = generate("stars", 5)
    spots = [(x, y) for x in range(-40, 41, 20) for y in range(-40, 41, 20)]
    fresh, asked = (FreeSpace(start_tiling(scene, "lazy", scene.start), QQ(0)) for _ in range(2))
    free = [p for p in spots if fresh.locate(p).is_free]
    if asked.locate(far).is_free:
        asked.path(far, free[0])

    assert len(free) > 5
    for p, q in zip(free, free[3:], strict=False):
        assert asked.path(p, q) == fresh.path(p, q)


def test_the_push_on_an_edge_far_away_is_where_it_touches():
    """A board that tilts, at 10^20, where doubles are 16384 apart: hit at three quarters."""
    far = QQ(10) ** 20
    board = Body("board", [(far, 0), {"x": [far + 4], "y": [0, -1]}])
    ball = Body("ball", [(far + 3, 3), (far + 4, 4), (far + 2, 4)], Translation(0, [0, -2]))
    simulation = Simulation(Scene([board, ball], (0, 9)))

    list(simulation.run("5/2", on_contact=Bounce(fixed=["board"])))

    assert simulation.contacts == 1  # at t = 12/5, the edge as (4, -12/5)
    motion = simulation.body("ball").motion
    vx, vy = (float(f.derivative()(3)) for f in (motion.x, motion.y))
    nx, ny = 2.4 / math.hypot(4, 2.4), 4 / math.hypot(4, 2.4)
    assert nx * vx + ny * (vy + 0.75) == pytest.approx(ny * 1.25, rel=1e-4)
