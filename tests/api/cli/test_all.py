"""collide --all: intervals of contact, in words and as JSON."""

import json

import pytest
from click.testing import CliRunner

from exactpt.cli import cli, main
from exactpt.motion.body import Body
from exactpt.motion.motions import Translation
from exactpt.scene.scene import Scene


@pytest.fixture
def scene(tmp_path):
    bodies = [
        Body("box", [(0, 0), (2, 0), (2, 1), (0, 1)], Translation([0, 1])),
        Body("wall", [(9, -5), (9, 5)]),
        Body("spot", [(4, 1)], Translation([0], [9, -6, 1])),
    ]
    Scene(bodies, (0, 20)).save(tmp_path / "scene.json")
    return tmp_path / "scene.json"


def run(*arguments):
    return CliRunner().invoke(cli, list(map(str, arguments)), catch_exceptions=False)


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
        with pytest.raises(SystemExit) as ended:
            main(["collide", str(scene), "--all", "--exit-code", "--until", until])
        assert ended.value.code == code


@pytest.mark.parametrize("option", [["--proof", "x"], ["--tiling", "lazy"], ["--stats"]])
def test_options_of_the_first_contact_are_refused(scene, option, capsys):
    with pytest.raises(SystemExit) as ended:
        main(["collide", str(scene), "--all", *option])

    assert ended.value.code == 2
    assert capsys.readouterr().err == (
        f"exactpt: --all: {option[0]} is supported only for the first contact\n"
    )


def test_a_bound_on_the_size_of_the_file_holds(scene, capsys):
    with pytest.raises(SystemExit) as left:
        main(["collide", str(scene), "--all", "--max-bytes", "100"])

    assert left.value.code == 2
    assert "more than 100 bytes" in capsys.readouterr().err
