"""Numbers that leave the package are Python's own: int, Fraction and float, whatever is asked.

`limit_denominator` of gmpy2 2.3 frees the number that it is called on where it returns that: called
on one of ours, it broke a later run. So all that a caller can reach is walked through, by
reflection: a public attribute that is new is found, and a new method is called if it needs no
arguments, or has its arguments in `ARGUMENTS`.
"""

import inspect
import json
from fractions import Fraction

import pytest

import exactpt
from exactpt import (
    Affine,
    AlgebraicNumber,
    Body,
    BudgetExceeded,
    Pieces,
    Polynomial,
    PosePath,
    Rigid,
    Scene,
    Simulation,
    Spin,
    Translation,
)

PLAIN = {int, float, bool, str, bytes, type(None), Fraction, range}

THREE = [(0, Rigid(0)), (1, Rigid(0)), (None, Rigid(0))]

ARGUMENTS = {
    "PosePath.of_pieces": (THREE, [0, 1], [(0, 0, 0)], 1),
    "Spin.of_pieces": (THREE, 0, 1),
    "through": ([0, "1/3"], [(0, 0, 0), (1, 1, "1/9")]),
    "pose": ("1/3",),
    "at": ("1/3",),
    "body": ("box",),
    "canonical_interval": (),
    "end_of_edge": (0,),
    "halted": ("1/3",),
    "compare": (AlgebraicNumber(1),),
    "compare_rational": (Fraction(1, 3),),
    "first_contact": ([(0, 0)], Translation([0, "1/3"])),
    "first_contacts": ([(0, 0)], [Translation([0, "1/3"])]),
    "hull": (),
    "is_free": ((50, 50), (51, 51)),
    "locate": ((50, 50),),
    "below": ("1/3",),
    "nearest": ("1/3",),
    "to": ("mill",),
    "neighbours": ("box",),
    "path": ((-50, -50), (50, 50)),
    "shortest_path": ((-50, -50), (50, 50)),
    "since": ("1/3",),
    "ray_cast": ((-50, "1/4"), (1, 0)),
    "refine_to": (Fraction(1, 100),),
    "relative_hull": ("box",),
    "squared_with_radius": ("1/3",),
    "squared": ("1/3",),
    "shorten": ([(-50, -50), (50, -50), (50, 50)],),
    "sign_after": ((-1, 1),),
    "Polynomial.sign": ("1/3",),
    "Polynomial.sign_after": ("1/3",),
    "sign_before": ((-1, 1),),
    "sign_of": ((-1, 1),),
    "until": (8.75,),
    "velocity_at": ("1/3",),
    "with_place_error": ("1/3",),
    "with_radius": ("1/3",),
    "with_motion": (Translation([0, "1/3"]),),
}
"""The arguments of methods, those of one class first; without an entry, there are none."""

ELSEWHERE = {
    "add", "remove", "set_motion", "set_motions", "run", "run_to_contact", "step",  # below
    "from_shapely", "to_shapely", "from_sympy", "to_sympy",  # numbers of other libraries
    "from_arrays", "launched",  # class methods
    "of_curve",  # of a spline of SciPy
    "history",  # below
    "fan",  # of a tiling of points alone: positions of vertices
    "draw",  # writes a file
    "locate_many",  # arrays of numpy
    "roots",  # of any polynomial but 0: algebraic numbers
    "as_integer_ratio",  # of irrational numbers refused, see `tests/unit/kernel/test_numbers.py`
    "load", "save", "restore", "root", "surd", "going_on", "copy", "from_json",  # as these
    "track", "kinetic",  # the engine's, see `exactpt.motion.track.Track`
}  # fmt: skip
"""What is not called here, and why."""


def leaks(value, path, seen):
    """Where in a value there are numbers of other kinds."""
    if type(value) in PLAIN:
        return []
    if id(value) in seen:
        return []
    seen[id(value)] = value
    if isinstance(value, dict):
        pairs = [(f"{path}[{key!r}]", part) for key, part in value.items()]
        return [leak for where, part in pairs for leak in leaks(part, where, seen)] + leaks(
            list(value), f"{path}.keys()", seen
        )
    found = []
    if isinstance(value, (tuple, list, set, frozenset)):
        for i, part in enumerate(value):
            found += leaks(part, f"{path}[{i}]", seen)
        if type(value) in {tuple, list, set, frozenset}:
            return found
    elif not type(value).__module__.startswith("exactpt"):
        return [f"{path}: {type(value).__name__}"]
    for name in dir(value):
        if name.startswith(("_", "exact_")) or name in ELSEWHERE or hasattr(tuple, name):
            continue
        if f".{name}" in path:  # `f.derivative().derivative()` has no end
            continue
        found += leaks(answer(value, name), f"{path}.{name}", seen)
    if isinstance(value, Polynomial):
        found += leaks([*value, value("1/3")], f"{path}()", seen)
    return found


def answer(value, name):
    attribute = getattr(value, name)
    if not inspect.isroutine(attribute):
        return attribute
    arguments = ARGUMENTS.get(f"{type(value).__name__}.{name}", ARGUMENTS.get(name))
    if arguments is not None:
        return attribute(*arguments)
    return attribute() if can_be_called_without_arguments(attribute) else None


def can_be_called_without_arguments(function):
    try:
        inspect.signature(function).bind()
    except (TypeError, ValueError):  # arguments are missing, or the signature is unknown
        return False
    return True


def no_leaks(**objects):
    seen = {}
    assert [leak for name, value in objects.items() for leak in leaks(value, name, seen)] == []
    return len(seen)


def scene_of_every_kind():
    turning = Rigid([0, "1/7"], pivot=("1/2", "1/2"), x=[0, "1/3"])
    pieces = Pieces([("1/2", Translation([0, 1])), (None, Translation(["1/2"]))])
    return Scene(
        [
            Body("box", [(0, 0), (2, 0), (2, 1), (0, "1.1")], Translation([0, "1/3"], [0, 0, 0.1])),
            Body("mill", [(9, -3), (10, -3), (10, 2), (9, 2)], turning),
            Body("shear", [(0, 9), (1, 9), (1, 10)], Affine([[1, [0, "1/9"]], [0, 1]])),
            Body("dot", [(-5, "1/3")], pieces),
            Body("jaw", [(-9, 0), {"x": [-8, "1/5"]}, (-9, 2)], closed=False),
            Body("jelly", keyframes=[("1/3", [(5, 5), (6, 5)]), (1, [(5, 5), ("13/2", 6)])]),
        ],
        time=("-1/3", 9),
    )


def test_bug_numbers_of_scenes_and_motions_are_pythons_own():
    scene = scene_of_every_kind()

    assert no_leaks(scene=scene) > 100
    assert no_leaks(spin=Spin("1/9", (-20, 0), error="1/9")) > 3
    assert no_leaks(path=PosePath([0, "1/3", 2], [(0, 1, ["1/9", 1]), (0, 1, "4/9")])) > 3
    assert type(scene.start) is type(scene.body("mill").motion.pivot[0]) is Fraction
    assert json.dumps(Polynomial([1, 2, "1/3"]).degree) == "2"


@pytest.mark.long
@pytest.mark.parametrize("tiling", ["greedy", "mixed", "lazy"])
def test_bug_numbers_of_a_run_are_pythons_own(tiling):
    """A simulation, its events, its answers about the space, and its contact."""
    simulation = Simulation(scene_of_every_kind(), tiling=tiling)
    assert no_leaks(simulation=simulation, snapshot=simulation.tiling) > 100
    contacts = []

    def bounce(running, contact):
        contacts.append(contact)
        assert no_leaks(running=running, contact=contact) > 10
        exactpt.Bounce()(running, contact)

    events = [event for event, _ in zip(simulation.run(on_contact=bounce), range(40), strict=False)]
    assert contacts
    assert no_leaks(events=events, simulation=simulation, passed=simulation.passed()) > 40


@pytest.mark.parametrize("tiling", ["greedy", "mixed", "lazy"])
def test_bug_numbers_of_new_plans_are_pythons_own(tiling):
    simulation = Simulation(scene_of_every_kind(), tiling=tiling)
    simulation.set_motion("dot", exactpt.onward(simulation.body("dot"), "-1/3", ("1/3", 0)))
    simulation.add(Body("new", [(200, "1/3")]))
    simulation.remove("new")
    assert no_leaks(step=simulation.step(), contact=simulation.run_to_contact()) > 1


def test_bug_numbers_of_a_simulation_of_points_are_pythons_own():
    bodies = [Body(f"p{i}", [(i, i * i)], Translation([0, -i], [0, 2])) for i in range(6)]
    simulation = Simulation(Scene([Body("box", [(-7, "1/3")]), *bodies], (0, 3)))

    assert simulation.name == "incremental"
    assert no_leaks(simulation=simulation, events=simulation.step(), after=simulation.tiling) > 40


@pytest.mark.long
@pytest.mark.parametrize("method", ["kinetic", "pairs"])
def test_bug_numbers_of_a_contact_are_pythons_own(method):
    scene = scene_of_every_kind()
    contact = exactpt.first_contact(scene, method=method)

    assert no_leaks(contact=contact) > 5
    assert json.loads(json.dumps(contact.time.polynomial)) == list(contact.time.polynomial)
    assert not contact.time.is_rational
    assert no_leaks(near=exactpt.first_within(scene, "box", "mill", "1/3"))
    assert no_leaks(first=exactpt.first_within(scene, distance="1/3")) > 1
    assert no_leaks(there=exactpt.distance(scene, "box", "mill", at=1)) > 1
    assert no_leaks(gap=exactpt.clearance(scene, "box", "mill")) > 5
    assert no_leaks(around=exactpt.clearance(scene, "box")) > 5
    assert no_leaks(meeting=exactpt.contacts(scene)) > 5
    assert exactpt.contact_intervals(scene, "box", "mill")
    assert no_leaks(planner=exactpt.Planner([Body("wall", [(1, -1), (1, 1)])], (0, 9))) > 5


def test_bug_the_time_that_a_spent_budget_has_reached_is_a_fraction():
    run = Simulation(scene_of_every_kind(), max_events=1)
    with pytest.raises(BudgetExceeded) as spent:
        run.run_to_contact()
    for number in (spent.value.reached, run.passed(), run.reached()):
        assert type(number) is Fraction


def test_numbers_far_too_long_for_a_double_are_no_trouble():
    huge = 10**5000
    simulation = Simulation(
        Scene([Body("a", [(huge, 0)]), Body("b", [(0, 0)])], (huge, huge + 1)), max_events=0
    )

    assert simulation.now.low == huge
    assert "inf" in str(BudgetExceeded("spent", simulation.reached()))
    assert json.dumps(simulation.to_json())


def test_bug_an_interval_with_ends_of_a_callers_integers_stays_exact():
    root = AlgebraicNumber.root((-2, 0, 0, 1), 0, 4)
    assert [root.compare_rational(1), root.compare_rational(2)] == [1, -1]
    root.refine()

    assert no_leaks(root=root)
    assert root.low**3 < 2 < root.high**3


@pytest.mark.long
def test_numbers_of_a_history_are_pythons_own():
    simulation = Simulation(scene_of_every_kind(), record=True)
    for _ in simulation.run("2/5", on_contact=exactpt.Bounce()):
        pass
    simulation.set_motion("dot", exactpt.onward(simulation.body("dot"), "2/5", ("1/3", 0)))

    assert no_leaks(history=simulation.history()) > 20
