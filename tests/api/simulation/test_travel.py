"""Values are pickled and copied by what they are: independent, and the same in every build."""

import copy
import io
import json
import multiprocessing
import pickle
from concurrent.futures import ProcessPoolExecutor
from fractions import Fraction

import pytest

import exactpt
from exactpt import (
    Affine,
    AlgebraicNumber,
    Body,
    Bounce,
    BudgetExceeded,
    InputError,
    Pieces,
    Polynomial,
    Rigid,
    Scene,
    Simulation,
    Translation,
)
from exactpt.testing.scenes import FAMILIES, generate

HUGE = 10**5000
MOTIONS = [
    Translation(),
    Translation([0, "1/3"], ["1/7", 0, -2]),
    Rigid([0, "1/7"], pivot=("1/2", HUGE), x=[0, "1/3"], y=[1]),
    Affine([[1, [0, "1/9"]], [0, 1]], x=[0, 1]),
    Pieces([("1/2", Translation([0, 1])), (2, Rigid(["1/4"])), (None, Translation([1]))]),
]
BODIES = [
    Body("box", [(0, 0), (2, 0), (2, 1), (0, "1.1")], Translation([0, 1], [0, 0, "-1/10"])),
    Body("mill", [(9, -6), (10, -6), (10, 2), (9, 2)], Rigid([0, "1/2"], pivot=("19/2", -2))),
    Body("jaw", [(-9, 0), {"x": [-8, "1/5"]}, (-9, 2)], closed=False),
    Body("jelly", keyframes=[("1/3", [(5, 5), (6, 5)]), (1, [(5, 5), ("13/2", 6)])]),
]
WAYS = {
    "pickle": lambda value: pickle.loads(pickle.dumps(value)),
    "pickle, first protocol": lambda value: pickle.loads(pickle.dumps(value, 0)),
    "copy": copy.copy,
    "deepcopy": copy.deepcopy,
}
ways = pytest.mark.parametrize("way", WAYS.values(), ids=WAYS)


class Orbit:
    """A motion of a caller's own."""

    def track(self, position):
        return Translation([0, 1]).track(position)


def scene():
    return Scene(BODIES, (0, "9.5"))


def log(simulation, **options):
    return [json.dumps(event.to_json()) for event in simulation.run(**options)]


class Named(pickle.Unpickler):
    """Notes the names of all that a pickle calls."""

    names: set[str]

    def find_class(self, module, name):
        self.names.add(f"{module}.{name}")
        return super().find_class(module, name)


@ways
def test_bug_polynomials_travel(way):
    for f in (Polynomial(), Polynomial([1, 0, "-3/7"]), Polynomial([HUGE, Fraction(1, HUGE)])):
        assert way(f) == f
        assert way(f).coefficients == f.coefficients
        assert (way(f) * way(f)).derivative() == (f * f).derivative()


@ways
@pytest.mark.parametrize("motion", MOTIONS, ids=repr)
def test_bug_motions_travel_and_are_equal_by_value(way, motion):
    other = way(motion)

    assert other == motion
    assert hash(other) == hash(motion)
    assert repr(other) == repr(motion)
    assert sum(other == m for m in MOTIONS) == 1
    position = Polynomial([1]), Polynomial([0, 2])
    if not isinstance(motion, Pieces):
        assert other.track(position).at("1/3") == motion.track(position).at("1/3")


@ways
@pytest.mark.parametrize("body", BODIES, ids=lambda body: body.name)
def test_bug_bodies_travel_and_are_equal_by_value(way, body):
    body.at(1)
    other = way(body)

    assert other == body
    assert hash(other) == hash(body)
    assert [other.at(t) for t in ("1/2", 3)] == [body.at(t) for t in ("1/2", 3)]
    assert sum(other == b for b in BODIES) == 1
    assert (other.closed, other.keyframes) == (body.closed, body.keyframes)


@ways
@pytest.mark.parametrize("family", sorted(FAMILIES))
def test_bug_scenes_travel_and_are_equal_by_value(way, family):
    given = generate(family, 1)
    other = way(given)

    assert other == given
    assert hash(other) == hash(given)
    assert other.to_json() == given.to_json()
    assert Scene.from_json(json.loads(json.dumps(given.to_json()))) == given
    assert other != generate(family, 2)
    assert other != other.until((other.start + other.end) / 2)


def test_scenes_that_differ_a_little_are_not_equal():
    a, b = Body("a", [(0, 0)]), Body("b", [(1, 0)])
    given = Scene([a, b], (0, 1))

    assert given == Scene([Body("a", [("0", 0.0)], Translation(0)), b], ("0", 1.0))
    assert given != Scene([b, a], (0, 1))
    assert given != Scene([a], (0, 1))
    assert given != Scene([a, Body("b", [(1, 0)], Translation([0, 1]))], (0, 1))
    assert given != Scene([a, Body("b", [{"x": [1, 1]}])], (0, 1))
    assert given != "scene"
    assert Body("c", [(0, 0), (1, 0)]) != Body("c", [(0, 0), (1, 0)], closed=False)
    assert Body("c", [(0, 0)]) != Body("c", keyframes=[(0, [(0, 0)])])


def test_a_scene_of_json_data_has_the_decimals_that_are_written():
    data = {"exactpt": 1, "time": [0, 1], "bodies": [{"name": "a", "vertices": [[0.1, "1/3"]]}]}

    assert Scene.from_json(data).body("a").at(0) == [(Fraction(1, 10), Fraction(1, 3))]


@pytest.mark.parametrize(
    "data, message",
    [
        ({}, 'scene: the key "exactpt" is missing'),
        ({"exactpt": 1, "time": [0, float("nan")], "bodies": []}, '"time"[1]: '),
        (
            {"exactpt": 1, "time": [0, Fraction(1, 2)], "bodies": []},
            "not JSON data: Object of type",
        ),
        ([], "scene: not an object: []"),
    ],
)
def test_what_is_no_scene_is_refused(data, message):
    with pytest.raises(InputError) as refused:
        Scene.from_json(data)
    assert message in str(refused.value)
    assert "\n" not in str(refused.value)


@ways
def test_bug_algebraic_numbers_travel_and_are_refined_alone(way):
    for number in (AlgebraicNumber("-3/7"), AlgebraicNumber.root((-2, 0, 0, 0, 0, 1), 0, 4)):
        other = way(number)
        assert other == number
        assert (other.low, other.high) == (number.low, number.high)
        before = number.low, number.high
        other.refine_to(Fraction(1, 10**50))
        assert (number.low, number.high) == before
        assert number == other
        assert float(number) == float(other)


@ways
def test_bug_contacts_travel(way):
    contact = exactpt.first_contact(scene())
    other = way(contact)

    assert not contact.time.is_rational
    assert other.time == contact.time
    assert other.pairs == contact.pairs
    assert other.to_json() == contact.to_json()


def test_a_copy_has_new_plans_of_its_own():
    simulation = Simulation(scene())
    list(simulation.run(1))
    other = simulation.copy()
    other.remove("box")
    other.set_motion("mill", exactpt.onward(other.body("mill"), 1, (0, 1)))

    assert simulation.body("box") == BODIES[0]
    assert simulation.body("mill") == BODIES[1] != other.body("mill")
    assert len(other.scene.bodies) == 3


def test_a_copy_in_a_callback_bounces_as_the_original_does():
    """Also with a motion of the caller's own, which no file has."""
    ball = Body("ball", [(0, 0), (1, 0), (0, 1)], Translation([0, 1]))
    walls = [Body("left", [(-5, -9), (-5, 9)]), Body("right", [(5, -9), (5, 9)])]
    room = Scene([ball, *walls, Body("moon", [(0, 90)], Orbit())], (0, 25))
    bounce, copies = Bounce(["left", "right"], grid="1/1024", fastest=3), []

    def keep(simulation, contact):
        before = simulation.copy()
        bounce(simulation, contact)
        bounce(before, contact)
        copies.extend([before, simulation.copy()])

    whole = log(Simulation(room), on_contact=keep)
    assert len(copies) == 6
    for other in copies:
        rest = log(pickle.loads(pickle.dumps(other)), on_contact=copy.deepcopy(bounce))
        assert whole[-len(rest) :] == rest
        assert len(rest) > 1


def test_what_is_left_of_a_budget_is_taken_along():
    simulation = Simulation(scene(), max_events=3, max_seconds=1000)
    simulation.step()
    other = simulation.copy()
    for run in (simulation, other):
        with pytest.raises(BudgetExceeded):
            list(run.run())
    assert simulation.now == other.now
    with pytest.raises(BudgetExceeded):
        list(Simulation(scene(), max_seconds=0).copy().run())


@ways
def test_bug_snapshots_and_answers_travel(way):
    simulation = Simulation(scene(), tiling="mixed")
    given = [simulation.tiling, *simulation.run(1), simulation.ray_cast((-50, "1/4"), (1, 0)),
             simulation.path((-50, -50), (50, 50)), simulation.locate((50, 50))]  # fmt: skip
    for value in given:
        other = way(value)
        if hasattr(value, "to_json"):
            assert other.to_json() == value.to_json()
        else:
            assert other == value
    assert way(given[0]) == given[0]
    assert way(given[0]).nodes[0].x == given[0].nodes[0].x


@ways
def test_bug_a_spent_budget_travels(way):
    """It was an error without its second argument: a process that raised it broke its pool."""
    spent = way(BudgetExceeded("time limit exceeded", Fraction(1, 3)))

    assert spent.reached == Fraction(1, 3)
    assert str(spent) == "time limit exceeded at t = 0.3333333333333333"


@ways
def test_what_cannot_travel_says_so(way):
    simulation = Simulation(scene())

    with pytest.raises(TypeError, match="a FreeSpace is of its run: copy the simulation"):
        way(simulation.space())
    with pytest.raises(TypeError, match="generator"):
        way(simulation.run())
    with pytest.raises(TypeError, match="the tiling of a run"):
        way(simulation.kinetic)


def test_bug_a_pickle_tells_of_nothing_that_depends_on_the_build():
    simulation = Simulation(scene(), tiling="mixed")
    list(simulation.run(1))
    values = [MOTIONS, scene(), simulation, simulation.tiling, exactpt.first_contact(scene())]

    unpickler = Named(io.BytesIO(pickle.dumps(values)))
    unpickler.names = set()
    unpickler.load()
    assert unpickler.names == {
        "builtins.getattr",
        "exactpt.pair.contact.Contact",
        "exactpt.pair.incidences.ContactPoint",
        "exactpt.kernel.algebraic.AlgebraicNumber",
        "exactpt.kernel.polynomial.Polynomial",
        "exactpt.motion.body.Body",
        "exactpt.motion.motions.Affine",
        "exactpt.motion.motions.Pieces",
        "exactpt.motion.motions.Rigid",
        "exactpt.motion.motions.Translation",
        "exactpt.motion.motions.made",
        "exactpt.scene.scene._valid_scene",
        "exactpt.simulation.simulation._resumed",
        "exactpt.pseudotriangulation.snapshot.Edge",
        "exactpt.pseudotriangulation.snapshot.Face",
        "exactpt.pseudotriangulation.snapshot.node_of",
        "exactpt.pseudotriangulation.snapshot.snapshot_of",
    }


@pytest.mark.long
def test_bug_values_travel_to_other_processes():
    simulation = Simulation(scene())
    simulation.step()
    here = exactpt.first_contact(scene()).to_json()
    with ProcessPoolExecutor(1, multiprocessing.get_context("spawn")) as pool:
        contact = pool.submit(exactpt.first_contact, scene()).result()
        assert contact.to_json() == here
        assert pool.submit(Simulation.run_to_contact, simulation).result().to_json() == here
        assert pool.submit(Simulation.copy, simulation).result().to_json() == simulation.to_json()
        spent = pool.submit(Simulation.run_to_contact, Simulation(scene(), max_events=0))
        with pytest.raises(BudgetExceeded):
            spent.result()
