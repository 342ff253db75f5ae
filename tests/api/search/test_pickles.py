"""Results and the functions of the package can be pickled."""

import pickle
from dataclasses import replace
from fractions import Fraction
from types import FunctionType

import exactpt
from exactpt import (
    Affine,
    AlgebraicNumber,
    Body,
    Bounce,
    Pieces,
    Planner,
    Polynomial,
    Rigid,
    Scene,
    Simulation,
    Spin,
    Translation,
    clearance,
    contacts,
    distance,
    first_contact,
    first_contact_enclosed,
    first_within,
    prove,
)

BALL = Body("ball", [(0, 0), (1, 0), (0, 1)], Translation([0, 2]))
SCENE = Scene([BALL, Body("wall", [(9, -5), (9, 5)])], time=(0, 10))
THREE = Scene(
    [
        Body("p", [(0, 0), (1, 0), (0, 1)], Translation([0, 1], [0, "1/3"])),
        Body("q", [(9, 2), (9, 8), (8, 5)]),
        Body("r", [(3, 5), (4, 6), (2, 7)]),
    ],
    time=(0, 9),
)
SQUARE, HOLE = [(0, 0), (4, 0), (4, 4), (0, 4)], [(1, 1), (2, 1), (2, 2)]


def first_event():
    simulation = Simulation(THREE)
    while not (events := simulation.step()):
        pass
    return events[0]


def history():
    simulation = Simulation(SCENE, record=True)
    simulation.run_to_contact()
    return simulation.history()


def public_functions():
    found = [getattr(exactpt, name) for name in exactpt.__all__]
    found += [getattr(exactpt.batch, name) for name in exactpt.batch.__all__]
    found += [getattr(exactpt.arrays, name) for name in exactpt.arrays.__all__]
    return [value for value in found if isinstance(value, FunctionType)]


ANSWERS = {
    "contact": lambda: first_contact(SCENE),
    "pair": lambda: first_contact(SCENE).pairs[0],
    "approach": lambda: first_within(SCENE, distance=1),
    "interval": lambda: contacts(SCENE)[0],
    "distance": lambda: distance(SCENE, "ball", "wall", 0),
    "clearance": lambda: clearance(SCENE, "ball", "wall"),
    "minimum": lambda: clearance(SCENE, "ball", "wall").minimum,
    "enclosed": lambda: first_contact_enclosed(SCENE),
    "Affine": lambda: Affine([[1, [0, 1]], [0, 1]], x=[1, 2]),
    "AlgebraicNumber": lambda: AlgebraicNumber.root([-2, 0, 0, 1], 1, 2),
    "Body": lambda: Body("ring", SQUARE, Translation([0, 1]), radius="1/2", holes=[HOLE]),
    "Bounce": lambda: Bounce(["wall"], restitution="1/2", masses={"ball": 2}),
    "BudgetExceeded": lambda: exactpt.BudgetExceeded("a bound", Fraction(1, 3)),
    "InputError": lambda: exactpt.InputError("a fault"),
    "UnreachableError": lambda: exactpt.UnreachableError("no path"),
    "AuditError": lambda: exactpt.AuditError("an invariant"),
    "ExactPTError": lambda: exactpt.ExactPTError("an error"),
    "RunEvent": first_event,
    "History": history,
    "Hit": lambda: Simulation(SCENE).space().ray_cast((3, 0), (1, 0)),
    "ShortestPath": lambda: Simulation(SCENE).space().shortest_path((3, 0), (2, 3)),
    "Place": lambda: replace(
        Simulation(SCENE).space().locate((3, 0)), crossed=1
    ),  # a count of steps
    "Pieces": lambda: Pieces([(3, Translation([0, 1])), (None, Translation([3]))]),
    "Polynomial": lambda: Polynomial([1, "2/3", 4]),
    "Proof": lambda: prove(SCENE),
    "Rigid": lambda: Rigid([0, 1], pivot=(1, 2), x=[0, 3]),
    "Scene": lambda: SCENE,
    "Simulation": lambda: Simulation(SCENE),
    "Spin": lambda: Spin(1, (1, 2)),
    "Translation": lambda: Translation([0, 1], "1/3"),
    "Units": lambda: exactpt.Units(length="mm"),
    "Velocity": lambda: exactpt.Velocity(1, 2),
    "Options": lambda: exactpt.batch.Options(every=True),
    "Summary": lambda: exactpt.batch.Summary(2, 1, "2: x"),
    "functions": public_functions,
}


def shown(value):
    """The part of a value that differs from others: its repr, else its events or its attributes."""
    if isinstance(value, Simulation):
        return repr([*value.copy().run()])
    return repr(value) if type(value).__repr__ is not object.__repr__ else repr(vars(value))


def test_fresh_answers_can_be_pickled():
    for answer in ANSWERS.values():
        fresh = answer()
        assert shown(pickle.loads(pickle.dumps(fresh))) == shown(fresh)


def test_pickled_planner_has_the_same_contacts():
    planner = Planner([SCENE.bodies[1]], time=(1, 9))

    copied = pickle.loads(pickle.dumps(planner))

    assert repr(copied.first_contact(BALL, BALL.motion)) == repr(
        planner.first_contact(BALL, BALL.motion)
    )
