"""collide with --all and with --enclosed: in words and as JSON."""

import json
import math

import pytest
from commands import code_of, run

from exactpt import Body, Scene, Spin, Translation


@pytest.fixture
def scene(tmp_path):
    bodies = [
        Body("box", [(0, 0), (2, 0), (2, 1), (0, 1)], Translation([0, 1])),
        Body("wall", [(9, -5), (9, 5)]),
        Body("spot", [(4, 1)], Translation([0], [9, -6, 1])),
    ]
    Scene(bodies, (0, 20)).save(tmp_path / "scene.json")
    return tmp_path / "scene.json"


def test_in_words(scene):
    assert run("collide", scene, "--all").stdout.splitlines() == [
        "box and spot meet at t = 3.0 (3)",
        "box and wall meet from t = 7.0 (7) to t = 9.0 (9)",
    ]
    assert run("collide", scene, "--all", "--until", 1).stdout == "no contact from t = 0 to t = 1\n"


def test_as_json(scene):
    answer = json.loads(run("collide", scene, "--all", "--json", "--until", "8").stdout)

    assert answer["until"] == "8"
    assert [(i["a"], i["b"], i["from"]["approx"], i["to"]["low"]) for i in answer["intervals"]] == [
        ("box", "spot", 3.0, "3"),
        ("box", "wall", 7.0, "8"),
    ]


def test_exit_code(scene):
    for until, code in (("20", 1), ("1", 0)):
        assert code_of("collide", scene, "--all", "--exit-code", "--until", until) == code


@pytest.mark.parametrize("option", [["--proof", "x"], ["--tiling", "lazy"], ["--stats"]])
def test_options_of_the_first_contact_are_refused(scene, option, capsys):
    assert code_of("collide", scene, "--all", *option) == 2
    assert capsys.readouterr().err == (
        f"exactpt: --all: {option[0]} is supported only for the first contact\n"
    )


def test_a_bound_on_the_size_of_the_file_holds(scene, capsys):
    assert code_of("collide", scene, "--all", "--max-bytes", "100") == 2
    assert "more than 100 bytes" in capsys.readouterr().err


# collide --enclosed: bounds of the first contact, in words and as JSON

BLADE = Body("blade", [(0, 0), (2, 0)], Spin(1, error="1/1000"))


@pytest.fixture
def turning(tmp_path):
    path = tmp_path / "scene.json"
    Scene([BLADE, Body("post", [(0, 1)]), Body("tip", [(-2, 0)])], time=(0, 4)).save(path)
    return path


def collide(capsys, *words):
    code = code_of("collide", *words)
    reported = capsys.readouterr()
    return code, reported.out, reported.err


def test_bounds_in_words_and_as_json(turning, capsys):
    code, out, _ = collide(capsys, turning, "--enclosed")
    assert code == 0
    first, second, third = out.splitlines()
    assert first.startswith("first contact not before t = 1.56")
    assert second.startswith("  and not after t = 1.57")
    assert third == "  blade and post may meet first"

    answer = json.loads(collide(capsys, turning, "--enclosed", "--json")[1])
    assert answer["until"] == "4"
    found = answer["enclosed"]
    assert found["low"]["approx"] < math.pi / 2 < found["high"]["approx"]
    assert found["pairs"] == [["blade", "post"]]


def test_no_contact_and_perhaps_one(turning, tmp_path, capsys):
    words = turning, "--enclosed", "--exit-code"
    assert collide(capsys, *words, "--until", 1)[:2] == (0, "no contact from t = 0 to t = 1\n")
    other = tmp_path / "other.json"
    Scene([BLADE, Body("tip", [(0, 2)])], time=(0, 4)).save(other)
    code, out, _ = collide(capsys, other, "--enclosed", "--exit-code")
    assert code == 1
    assert out.startswith("perhaps a contact, not before t = 1.5")
    assert json.loads(collide(capsys, other, "--enclosed", "--json")[1])["enclosed"]["high"] is None


def test_options_about_the_first_contact_are_refused(turning, capsys):
    code, _, err = collide(capsys, turning, "--enclosed", "--method", "pairs")
    assert code == 2
    assert err == "exactpt: --enclosed: --method is supported only for the first contact\n"
    assert collide(capsys, turning, "--enclosed", "--all")[0] == 2
