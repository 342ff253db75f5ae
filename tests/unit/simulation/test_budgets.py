"""Budgets of time and memory hold in the library: at start-up, in an event, in any thread."""

import math
import mmap
import subprocess
import sys
import threading
import time as clock

import pytest
from commands import code_of

from exactpt.collision.detector import first_contact
from exactpt.errors import BudgetExceeded, InputError
from exactpt.kernel import budget
from exactpt.kernel.algebraic import AlgebraicNumber, rational_between
from exactpt.kernel.budget import check_budget, within
from exactpt.motion.body import Body
from exactpt.motion.motions import Translation
from exactpt.scene.scene import Scene
from exactpt.simulation.simulation import Simulation
from exactpt.testing.scenes import generate
from exactpt.tiling.simultaneous import FailureGroup


def of_degree(degree):
    """Triangles on polynomials of which one certificate takes minutes."""
    f = [(7 * i * i) % 19 - 9 for i in range(degree)]
    g = [(5 * i * i) % 17 - 8 for i in range(degree)]
    bodies = [
        Body(f"b{i}", [(9 * i, 0), (9 * i + 4, 0), (9 * i + 2, 3)],
             Translation([*f, i + 1], [*g, 3 - i]))
        for i in range(4)
    ]  # fmt: skip
    return Scene(bodies, (0, "3/2"))


def of_size(size):
    """A polygon of many vertices and a point."""
    turns = [2 * math.pi * i / size for i in range(size)]
    ring = [(round(10**9 * math.cos(a)), round(10**9 * math.sin(a))) for a in turns]
    return Scene([Body("a", ring, Translation([0, 1])), Body("b", [(5 * 10**9, 0)])], (0, 10))


def in_thread(work):
    """The result or exception of some work in a thread, and the seconds that it took."""
    results = []

    def run():
        began = clock.monotonic()
        try:
            results.append(work())
        except Exception as error:
            results.append(error)
        results.append(clock.monotonic() - began)

    thread = threading.Thread(target=run)
    thread.start()
    thread.join()
    return results


SEARCHES = {
    "kinetic": first_contact,
    "pairs": lambda scene, **most: first_contact(scene, method="pairs", **most),
    "simulation": lambda scene, **most: list(Simulation(scene, tiling="lazy", **most).run()),
}


@pytest.mark.long
@pytest.mark.parametrize("where", ["main", "thread"])
@pytest.mark.parametrize("search", SEARCHES)
def test_degree_2000(search, where):
    scene = of_degree(2000)

    if where == "main":
        with pytest.raises(BudgetExceeded, match="time limit exceeded"):
            SEARCHES[search](scene, max_seconds=0.5)
    else:
        error, seconds = in_thread(lambda: SEARCHES[search](scene, max_seconds=0.5))
        assert isinstance(error, BudgetExceeded)
        assert seconds < 10  # it would be hours


@pytest.mark.slow
@pytest.mark.parametrize("search", SEARCHES)
def test_a_hundred_thousand_vertices(search):
    error, _ = in_thread(lambda: SEARCHES[search](of_size(100_000), max_seconds=1))

    assert isinstance(error, BudgetExceeded)


@pytest.mark.long("turning-lazy", "turning-greedy", "turning-mixed")
@pytest.mark.parametrize("tiling", ["lazy", "greedy", "mixed"])
@pytest.mark.parametrize("family", ["convex", "stars", "turning", "deforming"])
def test_the_limit_is_asked_for_everywhere(monkeypatch, family, tiling):
    """At whatever call the time is over, a run ends with a time that is proved, or with none."""
    scene = generate(family, 3)
    calls = {"now": 0, "last": 0}

    def count():
        calls["now"] += 1
        if calls["now"] == calls["last"]:
            raise BudgetExceeded("time limit exceeded", None)

    for module in list(sys.modules.values()):
        if module is budget:  # modules that are imported while this test runs keep the real one
            continue
        if (
            module.__name__.startswith("exactpt")
            and getattr(module, "check_budget", None) is check_budget
        ):
            monkeypatch.setattr(module, "check_budget", count)
    simulation = Simulation(scene, tiling=tiling)
    contact = simulation.run_to_contact()
    end = scene.end if contact is None else contact.time.canonical_interval()[1]
    total, reached = calls["now"], []
    for last in range(1, total, max(1, total // 25)):
        simulation = None
        calls.update(now=0, last=last)
        try:
            simulation = Simulation(scene, tiling=tiling)
            simulation.run_to_contact()
        except BudgetExceeded as spent:
            reached.append(spent.reached)
            if simulation is not None:
                with pytest.raises(InputError, match="interrupted in the middle of an event"):
                    list(simulation.run())
                with pytest.raises(InputError, match="interrupted in the middle of an event"):
                    simulation.to_json()

    assert total > 20
    known = [time for time in reached if time is not None]
    assert len(known) > 3
    assert known == sorted(known)
    assert known[-1] <= end


def test_between_two_events_a_run_can_go_on():
    simulation = Simulation(generate("convex", 3), max_seconds=0)
    with pytest.raises(BudgetExceeded):
        simulation.step()

    assert simulation.to_json()


def test_memory(monkeypatch):
    monkeypatch.setattr(budget, "resident_memory", lambda: 2 * 10**9)

    for search in SEARCHES.values():
        with pytest.raises(BudgetExceeded, match="memory limit exceeded"):
            search(generate("convex", 3), max_memory=10**9)
        search(generate("row", 3), max_memory=3 * 10**9)


def test_memory_is_that_of_the_process():
    before = budget.resident_memory()
    with mmap.mmap(-1, 50_000_000) as ballast:  # not a bytearray: malloc may reuse freed pages
        for page in range(0, len(ballast), mmap.PAGESIZE):
            ballast[page] = 1
        grown = budget.resident_memory() - before

    assert 40_000_000 < grown < 200_000_000


@pytest.mark.parametrize("option", ["max_seconds", "max_memory"])
@pytest.mark.parametrize("value", [-1, math.nan])
def test_bounds_that_are_none(option, value):
    with pytest.raises(InputError, match=option):
        first_contact(generate("row", 0), **{option: value})
    with pytest.raises(InputError, match=option):
        Simulation(generate("row", 0), **{option: value})


def test_budgets_in_budgets():
    with within(clock.monotonic() + 100), within(None, 10**12):
        check_budget()
        with pytest.raises(BudgetExceeded), within(clock.monotonic()):
            check_budget()
        check_budget()
    check_budget()


@pytest.mark.parametrize("command", ["collide", "simulate", "tile"])
def test_a_command_with_little_memory(tmp_path, capsys, command):
    generate("convex", 3).save(tmp_path / "scene.json")

    assert code_of(command, tmp_path / "scene.json", "--max-memory", "1") == 4
    assert "exactpt: memory limit exceeded" in capsys.readouterr().err


def test_ctrl_c_while_modules_are_imported():
    command = (
        "import sys, runpy\n"
        "class Finder:\n"
        "    def find_spec(self, name, path, target=None):\n"
        "        if name == 'exactpt.cli': raise KeyboardInterrupt\n"
        "sys.meta_path.insert(0, Finder())\n"
        "runpy.run_module('exactpt', run_name='__main__')"
    )

    done = subprocess.run([sys.executable, "-c", command], capture_output=True, check=False)

    assert (done.returncode, done.stdout) == (130, b"")
    assert done.stderr == b"exactpt: interrupted\n"


@pytest.mark.long
def test_between_two_times_of_a_forged_state():
    """Numbers in a wrong order have nothing between them: the search asks for the time."""
    with pytest.raises(BudgetExceeded), within(clock.monotonic() + 0.2):
        rational_between(AlgebraicNumber(2), AlgebraicNumber(1))


def many_moving(number):
    """Triangles in straight motion, which pass each other."""
    shape = [(0, 0), (3, 0), (0, 3)]
    return Scene(
        [
            Body(f"b{i}", [(x + 10 * i, y) for x, y in shape], Translation([0], [0, 1 + i % 3]))
            for i in range(number)
        ],
        (0, 10),
    )


@pytest.mark.parametrize("number", [3, 40])
def test_straight_motion_asks_too(monkeypatch, number):
    monkeypatch.setattr(budget, "resident_memory", lambda: 2 * 10**9)
    scene = many_moving(number)

    assert first_contact(scene, max_memory=3 * 10**9, max_seconds=60) is None
    with pytest.raises(BudgetExceeded, match="memory limit exceeded"):
        first_contact(scene, max_memory=10**9)
    with pytest.raises(BudgetExceeded, match="time limit exceeded"):
        first_contact(scene, max_seconds=0)


def test_in_the_search_of_straight_motion_the_start_is_proved(monkeypatch):
    def stop():
        raise BudgetExceeded("time limit exceeded", None)

    monkeypatch.setattr("exactpt.motion.slabs.check_budget", stop)

    with pytest.raises(BudgetExceeded) as spent:
        first_contact(many_moving(40))
    assert spent.value.reached == 0


def test_a_restored_run_and_a_copy_have_little_memory(tmp_path, monkeypatch):
    simulation = Simulation(generate("convex", 3), max_memory=10**12)
    simulation.save(tmp_path / "run.json")
    restored = Simulation.restore(tmp_path / "run.json", max_memory=10**12)
    monkeypatch.setattr(budget, "resident_memory", lambda: 2 * 10**12)

    for run in (simulation.copy, restored.copy, lambda: restored):
        with pytest.raises(BudgetExceeded, match="memory limit exceeded"):
            list(run().run())


@pytest.mark.parametrize("all_of_them", [[], ["--all"]])
def test_collide_with_little_memory(tmp_path, capsys, all_of_them):
    generate("turning", 3).save(tmp_path / "scene.json")

    assert code_of("collide", tmp_path / "scene.json", "--max-memory", "1", *all_of_them) == 4
    assert "exactpt: memory limit exceeded" in capsys.readouterr().err


def test_bug_repairs_without_end_are_ended_by_the_budget():
    """The exchanges of a forged vertical decomposition went on for ever."""
    batch = FailureGroup()

    def repair():
        while True:
            batch.begin_repair()

    with pytest.raises(BudgetExceeded), within(clock.monotonic() + 0.1):
        repair()


@pytest.mark.parametrize("bound", ["1", [1], -1, math.nan, 1j, pytest.param(10**5000, id="long")])
def test_what_is_no_bound(bound):
    scene = Scene([Body("a", [(0, 0)])])
    for name in ("max_seconds", "max_memory"):
        with pytest.raises(InputError, match=f"{name}: not a number from 0 on"):
            Simulation(scene, **{name: bound})
        with pytest.raises(InputError, match=f"{name}: not a number from 0 on"):
            first_contact(scene, **{name: bound})
