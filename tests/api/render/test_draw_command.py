"""`exactpt draw` and `exactpt demo` as a user meets them; numbers of many digits."""

import click
import pytest
from commands import code_of, run
from render_scenes import demo, small

from exactpt import Body, Scene, Simulation, Translation, first_contact


@pytest.fixture
def scene(tmp_path):
    small().save(tmp_path / "scene.json")
    return tmp_path / "scene.json"


@pytest.mark.long
def test_demo(tmp_path):
    page = tmp_path / "demo.html"
    result = run("demo", "--out", page)
    assert result.exit_code == 0
    assert "first contact at t = 8.693879580404362" in result.output
    assert "root of 1099 t^2 + 6750 t - 141750" in result.output
    assert "vertex 0 of boat on edge 6 of harbour" in result.output
    assert str(page) in result.output
    last = result.output.splitlines()[-1]
    assert " first contact at T = 8.6938" in last
    assert page.read_text(encoding="utf-8").startswith("<!DOCTYPE html>")


def test_simulate_says_what_the_film_shows(tmp_path):
    demo().save(tmp_path / "demo.json")
    result = run("simulate", tmp_path / "demo.json")
    assert "vertex 0 of boat on edge 6 of harbour at (14.349458584473656, 5.2021" in result.output


@pytest.mark.parametrize("at", ["0", "5/2", "2.5", "contact"])
@pytest.mark.parametrize("ending", ["svg", "html"])
def test_draw(scene, at, ending):
    picture = scene.with_name(f"picture.{ending}")
    assert run("draw", scene, "--at", at, "-o", picture).exit_code == 0
    assert picture.stat().st_size > 1000


@pytest.mark.parametrize(
    "arguments, message",
    [
        (["-o", "x.jpg"], "ends in one of .svg, .png, .html, .gif, .mp4"),
        (["-o", "x.svg", "--at", "4"], "the first contact is at t = 3.0"),
        (["-o", "x.html", "--at", "4"], "the animation runs from t = 0 to t = 3.0"),
        (["-o", "x.svg", "--at", "soon"], "not a number: 'soon'"),
        (["-o", "nowhere/x.svg"], "cannot be written"),
        (["-o", "x.svg", "--seconds", "2"], "seconds and fps are for a film, .gif or .mp4"),
        (["-o", "x.html", "--fps", "20"], "seconds and fps are for a film, .gif or .mp4"),
        ([], "Missing option '-o'"),
    ],
)
def test_bad_calls(scene, monkeypatch, capsys, arguments, message):
    monkeypatch.chdir(scene.parent)
    assert code_of("draw", scene, *arguments) == 2
    said = capsys.readouterr().err
    assert message in said
    assert said.count("\n") == 1
    assert [path.name for path in scene.parent.iterdir()] == ["scene.json"]


def test_help_has_examples():
    assert "exactpt draw scene.json --at contact -o contact.svg" in run("draw", "--help").output


def test_bug_a_start_beyond_the_doubles_is_drawn(tmp_path):
    """The hostile fuzzer found an OverflowError in the title."""
    Scene([Body("a", [(0, 0), (1, 0), (0, 1)])], (-(10**400), 4)).save(tmp_path / "far.json")

    result = run("draw", tmp_path / "far.json", "-o", tmp_path / "far.svg")

    assert result.exit_code == 0
    assert "t ≈ -inf" in (tmp_path / "far.svg").read_text(encoding="utf-8")


def test_without_arguments_there_are_three_commands_to_try(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    result = run()
    tries = [line.split("   ")[0].split() for line in result.output.splitlines()]
    commands = [words[1:] for words in tries if words[:1] == ["exactpt"]]

    assert result.exit_code == 0
    assert [words[0] for words in commands] == ["demo", "generate", "collide"]
    for words in commands[1:]:
        assert not run(*words).exit_code


@pytest.mark.long
def test_the_demo_opens_a_browser(tmp_path, monkeypatch, capsys):
    opened = []
    monkeypatch.setattr(click, "launch", lambda place: opened.append(place) or 0)
    page = tmp_path / "demo.html"
    assert code_of("demo", "--open", "-o", page) == 0
    assert opened == [str(page)]
    monkeypatch.setattr(click, "launch", lambda _: 1)
    assert code_of("demo", "--open", "-o", page) == 2
    assert "no browser" in capsys.readouterr().err


# Numbers of more digits than Python writes as a decimal number, in pictures and in words

FAR = 10**5000 + 1


@pytest.fixture
def far():
    ball = Body("ball", [(0, 0)], Translation([0, 1]))
    return Scene([ball, Body("wall", [(FAR, -1), (FAR, 1)])], time=(0, 2 * FAR))


def test_bug_a_contact_at_a_long_time_has_a_table(far):
    assert "First contact at t ≈ " in first_contact(far)._repr_html_()


def test_bug_a_scene_with_a_long_time_is_drawn(far, tmp_path):
    far.draw(tmp_path / "contact.svg", at="contact")
    far.draw(tmp_path / "film.html")
    far.draw(tmp_path / "gap.svg", gap=("ball", "wall"))
    simulation = Simulation(far, record=True)
    list(simulation.run())
    simulation.draw(tmp_path / "run.html")

    assert len(list(tmp_path.iterdir())) == 4
