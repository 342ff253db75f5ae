"""Limits of events, time and memory hold everywhere: at the start, in an event, in any thread.

That a search or run which is ended at any look at the clock says only what is true are the laws
`budget/searches` and `budget/runs`.
"""

import math
import mmap
import os
import subprocess
import sys
import threading
import time as clock
from contextlib import suppress
from pathlib import Path

import pytest
from commands import code_of

from exactpt import (
    Body,
    Bounce,
    BudgetExceeded,
    InputError,
    Scene,
    Simulation,
    Translation,
    first_contact,
)
from exactpt.testing import ending_at
from exactpt.testing.scenes import generate

LITTLE, MUCH = 1, 10**12
"""Limits of memory: each process has more than a byte, and none has a terabyte."""

SEARCHES = {
    "auto": first_contact,
    "kinetic": lambda scene, **most: first_contact(scene, tiling="lazy", **most),
    "pairs": lambda scene, **most: first_contact(scene, method="pairs", **most),
    "simulation": lambda scene, **most: list(Simulation(scene, tiling="lazy", **most).run()),
}
searches = pytest.mark.parametrize("search", SEARCHES.values(), ids=SEARCHES)


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


def passing(number):
    """Triangles in straight motion, which pass each other."""
    shape = [(0, 0), (3, 0), (0, 3)]
    return Scene(
        [
            Body(f"b{i}", [(x + 10 * i, y) for x, y in shape], Translation([0], [0, 1 + i % 3]))
            for i in range(number)
        ],
        (0, 10),
    )


def in_thread(work):
    """The result or exception of some work in a thread."""
    results = []

    def run():
        try:
            results.append(work())
        except BudgetExceeded as error:
            results.append(error)

    thread = threading.Thread(target=run)
    thread.start()
    thread.join()
    return results[0]


# Time


@pytest.mark.long
@pytest.mark.parametrize("where", ["main", "thread"])
@searches
def test_time_is_over_in_the_middle_of_a_long_decision(search, where):
    """It would be hours."""
    scene, began = of_degree(2000), clock.monotonic()

    if where == "main":
        with pytest.raises(BudgetExceeded, match="time limit exceeded"):
            search(scene, max_seconds=0.5)
    else:
        error = in_thread(lambda: search(scene, max_seconds=0.5))
        assert isinstance(error, BudgetExceeded)
    assert clock.monotonic() - began < 10


@pytest.mark.slow
@searches
def test_time_is_over_among_a_hundred_thousand_vertices(search):
    error = in_thread(lambda: search(of_size(100_000), max_seconds=1))

    assert isinstance(error, BudgetExceeded)


@pytest.mark.parametrize("number", [3, 40])
def test_search_in_straight_motion_without_time_has_proved_the_start_at_most(number):
    scene = passing(number)

    assert first_contact(scene, max_memory=MUCH, max_seconds=60) is None
    with pytest.raises(BudgetExceeded, match="time limit exceeded") as spent:
        first_contact(scene, max_seconds=0)
    assert spent.value.reached in (None, 0)


def test_run_whose_time_is_over_between_two_events_is_saved():
    simulation = Simulation(generate("convex", 3), max_seconds=0)
    with pytest.raises(BudgetExceeded):
        simulation.step()

    assert simulation.to_json()


def refusal_of(simulation):
    """Why a run cannot be saved; None if it can."""
    try:
        simulation.to_json()
    except InputError as refusal:
        return str(refusal)
    return None


def test_run_whose_time_is_over_in_an_event_is_not_saved():
    """The clock strikes at looks after the start of the run; some of them are in an event."""
    scene, said = generate("turning", 3), set()
    with ending_at(None) as whole:
        simulation = Simulation(scene, tiling="greedy", max_seconds=1)
        begun = whole.looks
        list(simulation.run())
    for look in range(begun + 1, whole.looks, 5):
        with ending_at(look), suppress(BudgetExceeded):
            simulation = Simulation(scene, tiling="greedy", max_seconds=1)
            list(simulation.run())
        said.add(refusal_of(simulation))

    assert said == {None, "the run was interrupted in the middle of an event: it cannot go on"}


def test_limit_of_a_search_in_a_response_leaves_that_of_the_run():
    """The response of a run with a limit asks a question with none left."""
    ball = Body("ball", [(0, 0), (1, 0), (0, 1)], Translation([0, 1]))
    scene = Scene([ball, Body("wall", [(5, -9), (5, 9)])], (0, 20))
    bounce, asked = Bounce(["wall"]), []

    def respond(run, contact):
        with pytest.raises(BudgetExceeded):
            first_contact(scene, max_seconds=0)
        asked.append(contact.time)
        bounce(run, contact)

    simulation = Simulation(scene, max_seconds=100)
    list(simulation.run(on_contact=respond))

    assert asked == [4]
    assert simulation.now == 20


# Events


@pytest.mark.parametrize("most", [0, 1, 5, 20])
def test_number_of_events_is_bounded(most):
    scene = generate("mixed_shapes", 0)
    simulation, events = Simulation(scene, max_events=most), []

    with pytest.raises(BudgetExceeded) as spent:
        events.extend(simulation.run())

    assert len(events) == 0 if most == 0 else len(events) <= most
    assert scene.start <= spent.value.reached <= scene.end
    contact = first_contact(scene)
    assert contact is None or contact.time > spent.value.reached


# Memory


@searches
def test_memory_is_bounded(search):
    search(generate("row", 3), max_memory=MUCH)
    with pytest.raises(BudgetExceeded, match="memory limit exceeded"):
        search(generate("convex", 3), max_memory=LITTLE)


def resident():
    """The memory of this process, in bytes."""
    pages = Path("/proc/self/statm").read_text().split()[1]
    return int(pages) * os.sysconf("SC_PAGE_SIZE")


@pytest.mark.skipif(not Path("/proc/self/statm").exists(), reason="asks Linux for its memory")
def test_memory_is_that_of_the_process():
    """50 MB of pages that are written to are above a limit of 25 MB more than now."""
    scene = passing(3)
    limit = resident() + 25_000_000

    assert first_contact(scene, max_memory=limit) is None
    with mmap.mmap(-1, 50_000_000) as ballast:  # not a bytearray: malloc may reuse freed pages
        for page in range(0, len(ballast), mmap.PAGESIZE):
            ballast[page] = 1
        with pytest.raises(BudgetExceeded, match="memory limit exceeded"):
            first_contact(scene, max_memory=limit)


def test_restored_run_and_copy_have_the_limit_of_memory(tmp_path):
    simulation = Simulation(generate("convex", 3), max_memory=MUCH)
    simulation.save(tmp_path / "run.json")

    assert list(simulation.copy().run())
    with pytest.raises(BudgetExceeded, match="memory limit exceeded"):
        list(Simulation.restore(tmp_path / "run.json", max_memory=LITTLE).run())


# Bad limits, and commands


@pytest.mark.parametrize("option", ["max_seconds", "max_memory"])
@pytest.mark.parametrize("bound", ["1", [1], -1, math.nan, 1j, pytest.param(10**5000, id="long")])
def test_limit_that_is_no_number_from_0_on_is_refused(option, bound):
    scene = Scene([Body("a", [(0, 0)])])
    for ask in (Simulation, first_contact):
        with pytest.raises(InputError, match=f"{option}: not a number from 0 on"):
            ask(scene, **{option: bound})


@pytest.mark.parametrize(
    "words", [["collide"], ["collide", "--all"], ["simulate"], ["tile"]], ids=" ".join
)
def test_command_with_little_memory_ends_with_code_4(tmp_path, capsys, words):
    scene = tmp_path / "scene.json"
    generate("turning", 3).save(scene)

    assert code_of(words[0], scene, "--max-memory", "1", *words[1:]) == 4
    assert "exactpt: memory limit exceeded" in capsys.readouterr().err


def test_ctrl_c_while_modules_are_imported_ends_in_one_line():
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


@pytest.mark.parametrize("scene", ["before", "at the start"])
def test_run_that_has_ended_with_a_contact_is_free_of_contacts_before_it(scene):
    """It claimed the time of the contact itself; so did its copy."""
    x = 3 if scene == "before" else 0
    bodies = [Body("p", [(0, 0)], Translation([0, 1])), Body("q", [(x, -1), (x, 1), (4, 0)])]
    simulation = Simulation(Scene(bodies, (0, 9)))
    copied = simulation.copy()
    for run in (simulation, copied):
        assert run.run_to_contact().time == x
        for proved in (run.passed(), run.reached()):
            assert proved is None if x == 0 else 0 <= proved < 3
