"""Pickles, a save and a journal of version 0.2.0 (tests/data) load, though modules moved."""

import base64
import importlib
import json
import pickle
from dataclasses import replace
from fractions import Fraction
from pathlib import Path

import pytest

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
from exactpt.extensions import MOVED

DATA = Path(__file__).parents[2] / "data"
PICKLES = json.loads((DATA / "pickles.json").read_text())
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
    found = [getattr(exactpt, name) for name in OF_0_2.split()]
    found += [getattr(exactpt.batch, name) for name in ("Options", "Summary", "answers", "run")]
    names = ("Contacts", "first_contacts", "point_segment_contacts")
    return found + [getattr(exactpt.arrays, name) for name in names]


OF_0_2 = (
    "contact_intervals contacts distance first_contact first_contact_enclosed first_within "
    "in_local_time onward prove read_shapes spline stop write_shapes"
)
ANSWERS = {
    "contact": lambda: first_contact(SCENE),
    "pair": lambda: first_contact(SCENE).pairs[0],
    "approach": lambda: first_within(SCENE, distance=1, norm="euclidean"),
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
    "Event": first_event,
    "History": history,
    "Hit": lambda: Simulation(SCENE).space().ray_cast((3, 0), (1, 0)),
    "Path": lambda: Simulation(SCENE).space().shortest_path((3, 0), (2, 3)),
    "Place": lambda: replace(
        Simulation(SCENE).space().locate((3, 0)), crossed=1
    ),  # a count of steps
    "Pieces": lambda: Pieces([(3, Translation([0, 1])), (None, Translation([3]))]),
    "Polynomial": lambda: Polynomial([1, "2/3", 4]),
    "Proof": lambda: prove(SCENE),
    "Rigid": lambda: Rigid([0, 1], pivot=(1, 2), x=[0, 3]),
    "Scene": lambda: SCENE,
    "Simulation": lambda: Simulation(SCENE),
    "Spin": lambda: Spin(1, (1, 2), time=(0, "1/100")),
    "Translation": lambda: Translation([0, 1], "1/3"),
    "Velocity": lambda: exactpt.Velocity(1, 2),
    "Question": lambda: exactpt.batch.Options(every=True),
    "Summary": lambda: exactpt.batch.Summary(2, 1, "2: x"),
    "functions": public_functions,
}


def shown(value):
    """The part of a value that differs from others: its repr, else its events or its attributes."""
    if isinstance(value, Simulation):
        return repr([*value.copy().run()])
    return repr(value) if type(value).__repr__ is not object.__repr__ else repr(vars(value))


@pytest.mark.parametrize("name", ANSWERS)
def test_pickled_answer_loads_as_the_fresh_answer(name):
    loaded = pickle.loads(base64.b64decode(PICKLES[name]))

    fresh = ANSWERS[name]()
    assert type(loaded) is type(fresh)
    assert shown(loaded) == shown(fresh)


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


def test_moved_modules_keep_their_own_names():
    for old, new in MOVED.items():
        module = importlib.import_module(old)
        assert module is importlib.import_module(new)
        assert (module.__name__, module.__spec__.name) == (new, new)


def test_simulation_saved_by_0_2_goes_on_with_the_same_events():
    simulation = Simulation.restore(DATA / "saved_0_2.json")

    events = [(event.kind, str(event.time)) for event in simulation.run()]

    assert events == EVENTS


EVENTS = [
    ("reflex", "641747969027706868974773652685/79228143624798406114963095552"),
    ("diagonal", "81224703505357897675571/9444732965739290427392"),
    ("reflex", "1521180867611709547328971158323/158456343917994606665668755456"),
    ("hull", "17286131154218194971961308551/1800638339918195719982284800"),
    ("hull", "1509296348558901365624078650573/138649265510496659310121058304"),
    ("diagonal", "109558902402575768957747/9444732965739290427392"),
    ("diagonal", "119003635368315059385139/9444732965739290427392"),
    ("hull", "128448368334054349812531/9444732965739290427392"),
    ("diagonal", "137893101299793640239923/9444732965739290427392"),
]


def test_batch_that_0_2_began_goes_on_from_its_journal(tmp_path):
    files = json.loads((DATA / "journal_0_2.json").read_text())
    out = tmp_path / "answers.jsonl"
    out.with_name("answers.jsonl.journal").write_text(files["journal"])
    marked = files["part"].replace('"point": [9.0, 0.0]', '"point": [9.0, 7.0]', 1)
    out.with_name("answers.jsonl.part").write_text(marked)
    motions = [{"x": ["0", str(k)]} for k in range(30)]
    ball, wall = ([["0", "0"], ["1", "0"], ["0", "1"]], [["9", "-5"], ["9", "5"]])
    lines = [
        json.dumps(
            {
                "exactpt": 1,
                "time": ["0", "9"],
                "bodies": [
                    {"name": "ball", "vertices": ball, "motion": motion},
                    {"name": "wall", "vertices": wall},
                ],
            }
        )
        for motion in motions
    ]
    (tmp_path / "scenes.jsonl").write_text("\n".join(lines) + "\n")

    summary = exactpt.batch.run(tmp_path / "scenes.jsonl", out)

    assert (summary.scenes, summary.failures) == (30, 0)
    assert out.read_text().startswith(marked)  # not computed again: the mark is still there
    assert len(out.read_text().splitlines()) == 30
