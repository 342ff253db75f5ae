"""``--max-seconds`` holds wherever the time goes: in one event, at start-up, in reading."""

import contextlib
import json
import signal
import subprocess
import sys
from fractions import Fraction

import pytest
from commands import code_of

from exactpt.cli.alarm import time_limit
from exactpt.errors import BudgetExceeded
from exactpt.scene.written import save
from exactpt.testing.scenes import generate
from exactpt.tiling.engine import Engine
from exactpt.tiling.isolated import LEFT, IsolatedEvents
from exactpt.tiling.tiling import Tiling

COMMANDS = {
    "collide": ["collide", "--method", "kinetic", "--json"],
    "collide in words": ["collide", "--method", "kinetic"],
    "collide pairs": ["collide", "--method", "pairs"],
    "simulate": ["simulate"],
    "tile": ["tile", "--at", "1"],
    "tile run": ["tile", "--run", "--at", "1"],
    "draw": ["draw", "-o", "picture.svg"],
    "film": ["draw", "-o", "film.html"],
    "check": ["check"],
}
FAST = [name for name in COMMANDS if name != "check"]


def for_ever(*args, **options):
    """Much work in many small steps; long after every deadline it gives up."""
    for _ in range(10**9):
        pass
    raise AssertionError("not interrupted")


@pytest.fixture
def scene(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    monkeypatch.setattr("exactpt.cli.alarm.GRACE", 0.01)
    path = tmp_path / "scene.json"
    save(generate("convex", 3), path)
    return path


def run(name, scene, seconds):
    command, *options = COMMANDS[name]
    return code_of(command, scene, *options, "--max-seconds", seconds)


def left_behind(folder):
    return sorted(path.name for path in folder.iterdir() if path.name != "scene.json")


@pytest.mark.parametrize("name", FAST)
@pytest.mark.parametrize(
    "patched",
    ["exactpt.scene.scene.Scene.load", "exactpt.motion.vertices.Vertices.__init__"],
    ids=["reading", "start-up"],
)
def test_what_never_ends_is_interrupted(scene, monkeypatch, capsys, name, patched):
    monkeypatch.setattr(patched, for_ever)
    monkeypatch.setattr("exactpt.search.sweep.Scan.compare", for_ever)

    assert run(name, scene, 0.05) == 4
    assert "time limit exceeded" in capsys.readouterr().err
    assert left_behind(scene.parent) == []


@pytest.mark.cgal
def test_a_check_is_interrupted(scene, monkeypatch, program):
    monkeypatch.setenv("EXACTPT_CGAL_CHECK", str(program))
    monkeypatch.setattr(Tiling, "advance", for_ever)

    assert run("check", scene, 0.5) == 4


@pytest.mark.parametrize("name", ["collide", "simulate"])
def test_an_event_that_never_ends_leaves_the_time_before_it(scene, monkeypatch, capsys, name):
    times = []
    process = Engine._process

    def stuck(self, time, entries):
        times.append(self.certifier.resolve(time))
        if len(times) == 5:
            self.certifier.move_to(time, [])
            for_ever()
        process(self, time, entries)

    monkeypatch.setattr(Engine, "_process", stuck)
    monkeypatch.setattr(IsolatedEvents, "step", lambda *_: LEFT)  # all events are the engine's

    assert run(name, scene, 1) == 4

    said = capsys.readouterr()
    reported = json.loads(said.out)["reached"] if name == "collide" else said.err.split()[-1]
    assert len(times) == 5
    assert float(times[2]) < float(Fraction(reported)) < float(times[4])


def test_before_anything_is_proved_no_time_is_told(scene, monkeypatch, capsys):
    monkeypatch.setattr("exactpt.tiling.driver.initial_touches", for_ever)

    assert run("collide", scene, 0.05) == 4

    said = capsys.readouterr()
    assert json.loads(said.out)["reached"] is None
    assert said.err == "exactpt: time limit exceeded\n"


@pytest.mark.parametrize("name", ["collide", "collide in words", "collide pairs"])
def test_at_start_up_the_start_is_told(scene, monkeypatch, capsys, name):
    monkeypatch.setattr("exactpt.search.sweep.Scan.compare", for_ever)
    monkeypatch.setattr(Tiling, "__init__", for_ever)

    assert run(name, scene, 0.05) == 4

    out = capsys.readouterr().out
    assert json.loads(out)["reached"] == "0" if name == "collide" else out.endswith("t = 0\n")


def test_without_a_limit_there_is_no_alarm():
    with time_limit(None):
        assert signal.getitimer(signal.ITIMER_REAL) == (0.0, 0.0)


def test_what_was_set_is_set_again():
    rung = []
    old = signal.signal(signal.SIGALRM, lambda *args: rung.append(args))
    signal.setitimer(signal.ITIMER_REAL, 1000)
    try:
        with contextlib.suppress(ZeroDivisionError), time_limit(1):
            assert signal.getitimer(signal.ITIMER_REAL)[0] < 2
            raise ZeroDivisionError
        assert signal.getitimer(signal.ITIMER_REAL)[0] > 900
        signal.raise_signal(signal.SIGALRM)
        assert len(rung) == 1
    finally:
        signal.setitimer(signal.ITIMER_REAL, 0)
        signal.signal(signal.SIGALRM, old)


def test_what_c_code_makes_an_error_of_is_a_time_limit(monkeypatch):
    """Bug: gmpy2, interrupted while it reads a `Fraction`, says that it is none."""
    monkeypatch.setattr("exactpt.cli.alarm.GRACE", 0.01)

    def c_code():
        try:
            for_ever()
        except BudgetExceeded:
            raise SystemError("Object does not appear to be Fraction") from None

    with pytest.raises(BudgetExceeded), time_limit(0.01):
        c_code()
    with pytest.raises(SystemError), time_limit(60):
        raise SystemError


def test_what_a_finalizer_swallows_is_raised_again(monkeypatch):
    """Python prints and drops an exception in ``__del__``; the alarm rings again."""
    monkeypatch.setattr("exactpt.cli.alarm.AGAIN", 0.02)
    monkeypatch.setattr(sys, "unraisablehook", lambda report: swallowed.append(report.exc_type))
    swallowed = []

    class Last:
        def __del__(self):
            for_ever()

    def finalized_and_on():
        Last()
        for_ever()

    with pytest.raises(BudgetExceeded), time_limit(0.0):
        finalized_and_on()

    assert swallowed == [BudgetExceeded]


DIGITS = "7" * 5000


@pytest.mark.slow
@pytest.mark.parametrize(
    "name",
    [
        *(name for name in FAST if name != "collide pairs"),
        pytest.param("check", marks=pytest.mark.cgal),
    ],
)
def test_coordinates_of_5000_digits_that_turn(tmp_path, name):
    """Thirty such bodies take minutes before the first event; the budget of a second holds.

    By pairs they take no longer: boxes tell that they never come near each other.
    """
    turning = {"pivot": ["0", "5"], "half_turn": ["0", "1/4"], "x": ["0", f"0.{DIGITS}"]}
    bodies = [
        {"name": f"b{i}", "vertices": [[9 * i, 5], [9 * i + 4, 5], [9 * i + 4, f"6.{DIGITS}{i}"]],
         "motion": {"rigid": turning | {"half_turn": ["0", f"1/{3 + i}"]}}}
        for i in range(30)
    ]  # fmt: skip
    path = tmp_path / "scene.json"
    path.write_text(json.dumps({"exactpt": 1, "time": ["0", "2"], "bodies": bodies}))
    command, *options = COMMANDS[name]

    ended = subprocess.run(
        [sys.executable, "-m", "exactpt", command, path, *options, "--max-seconds", "1"],
        capture_output=True, text=True, timeout=60, check=False,
    )  # fmt: skip

    assert ended.returncode == 4
    assert ended.stderr.startswith("exactpt: time limit exceeded")
