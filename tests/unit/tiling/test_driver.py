"""One driver for all tilings, whose observers receive what they listen to and cost nothing else."""

import ast
from functools import partial
from itertools import islice
from pathlib import Path

import pytest

from exactpt import Body, BudgetExceeded, Scene, Simulation, Translation, first_contact
from exactpt.kernel.budget import Budget
from exactpt.kernel.numbers import QQ
from exactpt.testing.scenes import generate
from exactpt.tiling.driver import CHANGES, EVENTS, NOTHING, TIMES, Driver, Observer
from exactpt.tiling.tiling import Tiling

ROOT = Path(__file__).parents[3]
DRIVER = ROOT / "exactpt" / "tiling" / "driver.py"
ASKED = {
    NOTHING: {"advance_many"},
    TIMES: {"advance_many"},
    EVENTS: {"advance"},
    CHANGES: {"advance", "changes"},
}


METHODS = (
    "on_initial_contact",
    "on_advance",
    "on_changed_edges",
    "on_events",
    "on_event_time",
    "on_end",
    "on_contact",
)


class Listener(Observer):
    """Records the methods that the driver calls."""

    def __init__(self, listens_to):
        self.listens_to = listens_to
        self.heard, self.times, self.kinds = [], [], []
        for name in METHODS:
            setattr(self, name, partial(self.hear, name))

    def hear(self, name, *args):
        self.heard.append(name)
        if name == "on_event_time":
            self.times.append(args[0].now)
        if name == "on_events":
            self.kinds += [event.kind for event in args[1]]


def receivers(path):
    """The last names before ``.advance`` and ``.advance_many`` in a file."""
    text = path.read_text(encoding="utf-8")
    for node in ast.walk(ast.parse(text)) if ".advance" in text else ():
        if isinstance(node, ast.Attribute) and node.attr in ("advance", "advance_many"):
            yield getattr(node.value, "attr", getattr(node.value, "id", "?"))


def test_only_the_driver_advances_a_tiling():
    """A tiling is advanced in driver.py; else ``advance`` is a driver's, or a public one."""
    paths = [p for room in ("exactpt", "fuzz", "benchmarks") for p in (ROOT / room).rglob("*.py")]
    others = [(p.name, name) for p in paths if p != DRIVER for name in receivers(p)]

    assert set(receivers(DRIVER)) == {"self", "tiling"}
    assert {name for _, name in others} <= {"driver", "certificate_queue"}, others


@pytest.mark.plain
@pytest.mark.parametrize("levels", [(), (NOTHING,), (TIMES,), (EVENTS,), (CHANGES,), (0, 3, 1)])
def test_the_tiling_is_asked_for_no_more_than_observers_listen_to(levels, monkeypatch):
    asked = set()

    def watched(name, right):
        def call(tiling, *args):
            asked.add(name)
            return right(tiling, *args)

        return call

    for name in ("advance", "advance_many", "changes"):
        monkeypatch.setattr(Tiling, name, watched(name, getattr(Tiling, name)))
    listeners = [Listener(level) for level in levels]
    scene = generate("convex", 3)
    driver = Driver(scene, observers=listeners)

    assert driver.start("lazy") is None
    contact = driver.run(scene.end)

    assert asked == ASKED[max(levels, default=NOTHING)]
    assert contact == first_contact(scene, method="pairs")
    for listener in listeners:
        level = listener.listens_to
        assert ("on_event_time" in listener.heard) == (level >= TIMES)
        assert ("on_events" in listener.heard) == (level >= EVENTS)
        assert ("on_changed_edges" in listener.heard) == (level >= CHANGES)
        assert (listener.heard[-1] == "on_contact") == (contact is not None)


def test_all_levels_receive_the_same_times_and_events():
    listeners = [Listener(level) for level in (TIMES, EVENTS, CHANGES)]
    scene = generate("convex", 3)
    for listener in listeners:
        driver = Driver(scene, observers=[listener])
        driver.start("greedy")
        driver.run(scene.end)
    together = [Listener(level) for level in (TIMES, EVENTS, CHANGES)]
    driver = Driver(scene, observers=together)
    driver.start("greedy")
    driver.run(scene.end)

    assert listeners[0].times == listeners[1].times == listeners[2].times != []
    assert listeners[1].kinds == listeners[2].kinds != []
    assert [x.heard for x in together] == [x.heard for x in listeners]


def test_a_contact_at_the_start_has_no_tiling():
    p = Body("p", [(0, 0)], Translation([0, 1]))
    scene = Scene([p, Body("q", [(0, 0), (1, 0)])], time=(0, 1))
    listener = Listener(CHANGES)
    driver = Driver(scene, observers=[listener])

    assert driver.start("lazy") == first_contact(scene)
    assert (driver.tiled.tiling, driver.contact_free_until(), listener.heard) == (
        None,
        None,
        ["on_initial_contact"],
    )


def test_a_time_without_events_is_reached_and_the_run_goes_on():
    scene = Scene([Body("p", [(0, 0)], Translation([0, 1])), Body("q", [(3, 0)])], time=(0, 9))
    listener = Listener(TIMES)
    driver = Driver(scene, observers=[listener])
    driver.start("lazy")

    assert driver.run(scene.start + 1) is None
    assert (listener.heard[-1], driver.reached(), driver.contact_free_until() <= 1) == (
        "on_end",
        1,
        True,
    )
    assert driver.run(scene.end) == first_contact(scene)
    assert listener.heard[-1] == "on_contact"
    assert driver.contact_free_until() < 3


@pytest.mark.parametrize("level", [None, NOTHING, CHANGES])
def test_a_budget_of_events_holds_whoever_listens(level):
    scene = generate("stars", 6)
    listeners = [] if level is None else [Listener(level)]
    driver = Driver(scene, observers=listeners, budget=Budget(2, None))
    driver.start("greedy")

    with pytest.raises(BudgetExceeded, match="limit of events exceeded") as spent:
        driver.run(scene.end)
    assert spent.value.reached == driver.reached() > scene.start


def test_times_just_after_now_do_not_depend_on_how_far_it_is_refined():
    """A tiling is built anew at such a time, and has its half-edges in an order of that time."""
    run, refined = (Simulation(generate("turning", 0), tiling="lazy") for _ in range(2))
    irrational = 0
    while run.step() and refined.step() and run.contact is None:
        refined.now.refine_to(QQ(1, 10**60))
        irrational += not run.now.is_rational
        times, times_refined = (
            list(islice(one.kinetic.clock.times_just_after(), 7)) for one in (run, refined)
        )
        assert times == times_refined
        assert all(refined.now < t for t in times)

    assert irrational > 3
