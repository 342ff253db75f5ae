"""Interrupted at any check of the budget, a search for a contact claims only what is proved."""

import sys
from random import Random

import pytest

from benchmarks.shapes import clamp
from exactpt import (
    Body,
    BudgetExceeded,
    InputError,
    Scene,
    Simulation,
    Translation,
    first_contact,
)
from exactpt.collision.searches import ContactQuery, search_for
from exactpt.errors import ExactPTError
from exactpt.kernel import budget as kernel_budget
from exactpt.kernel.budget import check_budget
from exactpt.proof.emit import ProofRun

P = Body("p", [(0, 0)], Translation([0, 1]))
Q = Body("q", [(3, -1), (3, 1), (4, 0)])
FAR = Body("far", [(-9, 5), (-8, 5)], Translation([0, 2], [0, -1]))


def tiny(seed):
    """Three triangles on their way to each other."""
    random = Random(f"interrupted {seed}")
    bodies = []
    for i, (x, y) in enumerate([(0, 0), (9, 1), (4, 8)]):
        shape = [(x, y), (x + random.randint(1, 3), y), (x, y + random.randint(1, 3))]
        to = (4 - x + random.randint(-1, 1), 3 - y + random.randint(-1, 1))
        path = Translation([0, to[0]], [0, to[1], random.choice([0, 1, -1])])
        bodies.append(Body(f"b{i}", shape, path))
    return Scene(bodies, time=(0, 2))


SCENES = {
    "rational": Scene([P, Q], time=(0, 9)),
    "more bodies": Scene([P, Q, FAR], time=(0, 9)),
    "at the start": Scene([P, Body("q", [(0, -1), (0, 1), (4, 0)]), FAR], time=(0, 9)),
    "late start": Scene([P, Q, FAR], time=(2, 9)),
    "at the end": Scene([P, Q, FAR], time=(0, 3)),
    "self": clamp(3, Random(1)),
    **{f"tiny {seed}": tiny(seed) for seed in range(3)},
    "disc": Scene([P, Body("disc", [(5, 0)], radius=2), FAR], time=(0, 9)),
}


def searches(scene, folder):
    """A function that makes a search, by the name of the method."""

    def ask_for(method, **options):
        return lambda: search_for(scene, ContactQuery(method, "auto", **options))

    found = {"pairs": ask_for("pairs"), "auto": ask_for("auto")}
    if not scene.has_radius:
        found["kinetic"] = ask_for("kinetic")
        found["proof"] = ask_for("auto", proof=folder / "a.proof")
        found["simulation"] = lambda: Simulation(scene)
    return found


class Interrupting:
    """A budget that is used up at a given call."""

    def __init__(self, monkeypatch):
        self.now = self.last = 0
        for module in list(sys.modules.values()):
            if module is kernel_budget:  # modules imported meanwhile take the real one from it
                continue
            if (
                module.__name__.startswith("exactpt")
                and getattr(module, "check_budget", None) is check_budget
            ):
                monkeypatch.setattr(module, "check_budget", self)

    def __call__(self):
        self.now += 1
        if self.now == self.last:
            raise BudgetExceeded("memory limit exceeded", None)

    def at(self, last):
        self.now, self.last = 0, last


def claims(make, budget, last):
    """The times up to which an interrupted search and its error say that there is no contact."""
    budget.at(last)
    search = None
    try:
        search = make()
        contact = search.run_to_contact()
        contact.to_json()
    except BudgetExceeded as spent:
        budget.at(0)
        yield spent.reached
        if search is not None:
            yield proved(search)
            if isinstance(search, Simulation):
                yield search.reached()
        return
    raise AssertionError("not interrupted")


def proved(search):
    """The time up to which a search, or a run, has proved that bodies are apart."""
    return (search.passed if isinstance(search, Simulation) else search.contact_free_until)()


def is_before(time, contact):
    return time is None or contact.time > time


@pytest.mark.long
@pytest.mark.parametrize("name", SCENES)
def test_interrupted_at_every_check_before_a_contact(name, tmp_path, monkeypatch):
    scene = SCENES[name]
    contact = first_contact(scene, method="pairs", exact_only=True)
    budget = Interrupting(monkeypatch)
    known = 0
    for method, make in searches(scene, tmp_path).items():
        for _ in range(2):  # the second time with what the scene remembers
            budget.at(0)
            make().run_to_contact().to_json()
        for last in range(1, budget.now + 1):
            found = list(claims(make, budget, last))
            assert all(is_before(time, contact) for time in found), (method, last, found)
            known += any(time is not None for time in found)

    assert known > 5 or name == "at the start"


@pytest.mark.parametrize("name", SCENES)
def test_bug_a_simulation_that_has_met_claimed_the_time_of_the_contact(name):
    scene = SCENES[name]
    if scene.has_radius:
        return
    simulation = Simulation(scene)
    contact = simulation.run_to_contact()
    restored = simulation.copy()

    for run in (simulation, restored):
        assert is_before(run.reached(), contact)
        assert is_before(run.passed(), contact)
        assert (run.passed() is None) == (name == "at the start")


def late(*args, **options):
    raise BudgetExceeded("memory limit exceeded", None)


@pytest.mark.plain
@pytest.mark.parametrize("what", ["kinetic", "proof", "simulation"])
def test_bug_interrupted_inside_the_event_of_a_contact_at_3(what, tmp_path, monkeypatch):
    search = searches(SCENES["rational"], tmp_path)[what]()
    monkeypatch.setattr("exactpt.tiling.touching.touches", late)

    with pytest.raises(BudgetExceeded) as spent:
        search.run_to_contact()

    assert 0 <= spent.value.reached < 3
    assert 0 <= proved(search) < 3


def test_bug_while_the_contact_is_written_a_proof_claimed_its_time():
    run = ProofRun(SCENES["rational"], tiling="lazy")
    passed = [run.contact_free_until() for _ in run.lines()]
    header, reached = passed[:3], passed[3:]

    assert header == [None] * 3  # nothing is proved before the touches at the start are known
    assert reached == sorted(reached)
    assert reached[-1] < 3


@pytest.mark.plain
@pytest.mark.parametrize("method", ["auto", "kinetic"])
def test_bug_a_proof_out_of_time_claimed_nothing(method, tmp_path, monkeypatch):
    monkeypatch.setattr("exactpt.tiling.touching.touches", late)

    with pytest.raises(ExactPTError) as spent:
        first_contact(SCENES["rational"], method=method, proof=tmp_path / "p", max_seconds=99)
    assert 0 <= spent.value.reached < 3


def ctrl_c(*args, **options):
    raise KeyboardInterrupt


@pytest.mark.plain
def test_bug_interrupted_before_the_response_to_a_contact_a_run_passed_it(monkeypatch):
    simulation = Simulation(SCENES["rational"])
    with monkeypatch.context() as patch:
        patch.setattr("exactpt.simulation.running.with_motions_of", ctrl_c)
        with pytest.raises(KeyboardInterrupt):
            list(simulation.run(on_contact=lambda *_: None))

    with pytest.raises(InputError, match="it cannot go on"):
        list(simulation.run())
    assert simulation.reached() < 3
