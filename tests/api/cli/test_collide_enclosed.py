"""collide --enclosed: bounds of the first contact, in words and as JSON."""

import json
import math

import pytest

from exactpt import Body, Scene, Spin
from exactpt.cli import main

BLADE = Body("blade", [(0, 0), (2, 0)], Spin(1, time=(0, 3), error="1/1000"))


@pytest.fixture
def scene(tmp_path):
    path = tmp_path / "scene.json"
    Scene([BLADE, Body("post", [(0, 1)]), Body("tip", [(-2, 0)])], time=(0, 4)).save(path)
    return path


def run(capsys, *words):
    with pytest.raises(SystemExit) as ended:
        main(["collide", *map(str, words)])
    reported = capsys.readouterr()
    return ended.value.code, reported.out, reported.err


def test_bounds_in_words_and_as_json(scene, capsys):
    code, out, _ = run(capsys, scene, "--enclosed")
    assert code == 0
    first, second, third = out.splitlines()
    assert first.startswith("first contact not before t = 1.56")
    assert second.startswith("  and not after t = 1.57")
    assert third == "  blade and post may meet first"

    answer = json.loads(run(capsys, scene, "--enclosed", "--json")[1])
    assert answer["until"] == "4"
    found = answer["enclosed"]
    assert found["low"]["approx"] < math.pi / 2 < found["high"]["approx"]
    assert found["pairs"] == [["blade", "post"]]


def test_no_contact_and_perhaps_one(scene, tmp_path, capsys):
    words = scene, "--enclosed", "--exit-code"
    assert run(capsys, *words, "--until", 1)[:2] == (0, "no contact from t = 0 to t = 1\n")
    other = tmp_path / "other.json"
    Scene([BLADE, Body("tip", [(0, 2)])], time=(0, 4)).save(other)
    code, out, _ = run(capsys, other, "--enclosed", "--exit-code")
    assert code == 1
    assert out.startswith("perhaps a contact, not before t = 1.5")
    assert json.loads(run(capsys, other, "--enclosed", "--json")[1])["enclosed"]["high"] is None


def test_options_about_the_first_contact_are_refused(scene, capsys):
    code, _, err = run(capsys, scene, "--enclosed", "--method", "pairs")
    assert code == 2
    assert err == "exactpt: --enclosed: --method is supported only for the first contact\n"
    assert run(capsys, scene, "--enclosed", "--all")[0] == 2
