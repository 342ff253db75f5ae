"""What is asked for the wrong way is refused in one line, and changes nothing."""

import json
import math
from fractions import Fraction

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
    "a tiling, by pairs": lambda: first_contact(Scene([POINT]), method="pairs", tiling="lazy"),
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


@pytest.mark.parametrize("exponent", [-400, -200, 0, 200, 400])
def test_normals_have_length_one_at_any_size(exponent):
    size = Fraction(10) ** exponent
    contact = first_contact(fall(size=size))

    assert contact.time == 1
    assert [pair.normal for pair in contact.pairs] == [(0.0, 1.0)]
    json.dumps(contact.to_json(), allow_nan=False)


def test_a_time_beyond_all_doubles_is_told_as_the_largest():
    late = Scene([Body("a", [(0, 0)], Translation([0, Fraction(1, 10**350)])), Body("b", [(3, 0)])],
                 (0, 10**351))  # fmt: skip
    answer = first_contact(late).to_json()

    assert answer["time"]["approx"] == 1.7976931348623157e308
    json.dumps(answer, allow_nan=False)


def test_what_no_file_can_hold_is_not_written(tmp_path):
    long = Scene([Body("p", [(Fraction(1, 3**40_000), 0)])])

    for thing in (long, Simulation(long)):
        with pytest.raises(InputError, match=r"body 'p': more than 10000 digits .* file: 1/"):
            thing.save(tmp_path / "file.json")
    assert not list(tmp_path.iterdir())


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
