"""What commands say while they run: events in words, silence, a bar on terminals alone."""

import pytest
from commands import run
from terminals import Bar, Terminal

from exactpt import AlgebraicNumber, Body, Scene, Simulation, Translation
from exactpt.cli import cli
from exactpt.cli.progress import estimating, progress


@pytest.fixture
def scene(tmp_path):
    bodies = [
        Body("box", [(0, 0), (2, 0), (2, 1), (0, 1)], Translation([0, 1])),
        Body("wall", [(9, -5), (9, 5)]),
        Body("spot", [(4, 3)], Translation([0], [0, "-1/9"])),
    ]
    Scene(bodies, (0, 20)).save(tmp_path / "scene.json")
    return tmp_path / "scene.json"


def test_verbose_prints_every_event(scene):
    events = list(Simulation(Scene.load(scene)).run())

    lines = run("simulate", scene, "--verbose").stdout.splitlines()

    kinds = [line.split()[3] for line in lines if line.startswith("t = ")]
    assert kinds == [event.kind for event in events]
    assert lines[len(kinds) - 1] == "t = 7.0 contact"
    changed = next(event for event in events if event.added)
    assert f"+{'~'.join(changed.added[0])}" in lines[events.index(changed)]


@pytest.mark.parametrize("command", ["simulate", "draw"])
def test_quiet_prints_nothing(scene, command):
    more = ["-o", scene.with_name("film.html")] if command == "draw" else []

    result = run(command, scene, "--quiet", *more)

    assert (result.exit_code, result.stdout, result.stderr) == (0, "", "")


def test_no_bar_where_nobody_looks_on(scene):
    assert run("simulate", scene).stderr == ""


def test_a_bar_on_a_terminal(scene, monkeypatch):
    """It follows the time: a quarter of it is done at a quarter of the span."""
    screen = Terminal()
    monkeypatch.setattr("sys.stderr", screen)

    with progress(Scene.load(scene), "simulating") as reached:
        reached(AlgebraicNumber(5))

    assert "simulating" in screen.getvalue()
    assert "25%" in screen.getvalue()
    with progress(Scene.load(scene), "simulating", quiet=True) as silent:
        assert silent is None


@pytest.mark.parametrize("command", ["simulate", "draw"])
def test_the_runs_tell_the_bar(scene, monkeypatch, command):
    screen = Terminal()
    reported = []
    monkeypatch.setattr("exactpt.cli.progress.sys.stderr", screen)
    monkeypatch.setattr("exactpt.cli.progress.click.progressbar", lambda **_: Bar(reported))
    more = ["-o", str(scene.with_name("film.html"))] if command == "draw" else []

    cli.main([command, str(scene), *more], standalone_mode=False)

    assert reported == sorted(reported)
    assert reported[-1] == 350  # the contact, at t = 7 of 20


def test_lines_with_an_estimate_where_there_is_no_terminal(monkeypatch, capsys):
    now = [100.0]
    monkeypatch.setattr("exactpt.cli.progress.clock.monotonic", lambda: now[0])

    with estimating("answering") as report:
        for done in (500, 510, 520, 600, 601):  # the first half was there before
            report(done, 1000)
            now[0] += 20

    assert capsys.readouterr().err.splitlines() == [
        "answering: 52%, about 16 min left",  # 480 more, 20 in 40 s
        "answering: 60%, about 6 min left",  # 399 more, 101 in 80 s
    ]


def test_a_bar_with_an_estimate_on_a_terminal(monkeypatch):
    screen, now = Terminal(), [100.0]
    monkeypatch.setattr("sys.stderr", screen)
    monkeypatch.setattr("exactpt.cli.progress.clock.monotonic", lambda: now[0])

    with estimating("answering") as report:
        report(0, 100)
        now[0] += 5
        report(25, 100)

    assert "answering" in screen.getvalue()
    assert "25%  about 15 s left" in screen.getvalue()
    assert "None" not in screen.getvalue()
    with estimating("answering", quiet=True) as silent:
        silent(1, 2)
