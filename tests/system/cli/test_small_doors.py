"""Small things that a user meets first: names, versions, messages, and what they advise."""

import json
import subprocess
import sys
from pathlib import Path

import pytest
from commands import code_of, run
from folding import every

import exactpt
import exactpt.testing
from exactpt import AlgebraicNumber, Body, InputError, Scene, Simulation, Translation
from exactpt.cli import all_commands

ROOT = Path(__file__).parents[3]


def rising():
    """A point on the parabola (t, t^2 / 2) among four others: it crosses lines through two.

    The line through (1, 5) and (3, 1) is y = 7 - 2 x: t^2 / 2 + 2 t - 7 = 0 at sqrt(18) - 2.
    """
    point = Body("p", [(0, 0)], Translation([0, 1], [0, 0, "1/2"]))
    places = {"q": (-1, 3), "r": (1, 5), "s": (7, 4), "t": (3, 1)}
    return Scene([point, *(Body(name, [place]) for name, place in places.items())], time=(0, 4))


def touching():
    return Scene([Body("a", [(0, 0), (2, 0), (0, 2)]), Body("b", [(1, 1), (2, 2)])], time=(0, 1))


def test_all_names_hide_no_class_of_the_standard_library():
    names = {}
    exec("from pathlib import Path\nfrom threading import Event\nfrom exactpt import *", names)

    assert names["Path"].__module__.startswith("pathlib")
    assert names["Event"].__module__ == "threading"
    assert {"ContactPoint", "RunEvent", "ShortestPath"} <= {*names}


def test_the_version_says_whether_the_package_is_compiled():
    from importlib.metadata import version

    assert exactpt.__version__ == version("exactpt")
    kind = "compiled" if exactpt.__compiled__ else "plain"
    assert exactpt.__compiled__ is not sys.modules["exactpt.planar.halfedge"].__file__.endswith(
        ".py"
    )
    assert run("--version").output == f"exactpt, version {exactpt.__version__}, {kind}\n"


@pytest.mark.long
def test_subpackages_are_attributes_without_an_import():
    code = "import exactpt.testing as t; print(t.space.__name__, t.strategies.__name__)"
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)

    assert done.stdout == "exactpt.testing.space exactpt.testing.strategies\n"


def test_places_at_an_irrational_time_name_the_digits():
    time = AlgebraicNumber.exact_root((-2, 0, 1), 1, 2)

    with pytest.raises(InputError, match=r"an irrational number, .*at\(time, digits=30\)"):
        rising().at(time)


def test_the_tiling_at_each_event_exists_also_at_irrational_times():
    simulation, irrational = Simulation(rising()), 0
    while simulation.step():
        tiling = simulation.tiling
        assert tiling.at == simulation.now
        assert len(tiling.faces) == 3
        p = tiling.nodes[0]
        assert p.x == simulation.now
        assert abs(float(p.y) - float(p.x) ** 2 / 2) < 1e-12
        assert (tiling.nodes[1].x, tiling.nodes[1].y) == (-1, 3)
        if not simulation.now.is_rational:
            irrational += 1
            assert isinstance(tiling.at, AlgebraicNumber)
            data = tiling.to_json()
            assert data["at"]["polynomial"] == data["vertices"][0]["x"]["polynomial"]
            later = simulation.space(at=simulation.now.high).snapshot
            assert [face.nodes for face in later.faces] == [face.nodes for face in tiling.faces]

    assert irrational == 3


def test_a_run_that_begins_in_contact_says_which_bodies_and_what_helps():
    simulation = Simulation(touching())

    for question in (lambda: simulation.tiling, lambda: simulation.locate((9, 9))):
        with pytest.raises(InputError) as refusal:
            question()
        message = str(refusal.value)
        assert message.startswith("no tiling: bodies 'a' and 'b' touch at the start, t = 0.0")
        assert "exactpt.union" in message
        assert "ignoring" in message


def test_a_picture_shows_decimals_before_a_long_fraction(tmp_path):
    """(1/7 + t) (3) = 5 at t = 32/21."""
    runner = Body("p", [("3/7", 0)], Translation([0, 3]))
    scene = Scene([runner, Body("w", [(5, -1), (5, 1)])], time=(0, 9))
    scene.draw(tmp_path / "a.svg", at="contact")

    assert "first contact at t ≈ 1.52380952381 (32/21)" in (tmp_path / "a.svg").read_text()


@every("count, words", [(0, "0 bodies, 0 vertices"), (1, "1 body, 1 vertex"),
                        (2, "2 bodies, 2 vertices")])  # fmt: skip
def test_one_is_singular(count, words):
    scene = Scene([Body(f"b{i}", [(i, 0)]) for i in range(count)], time=(0, 1))

    assert repr(scene).startswith(f"<Scene: {words}, ")


def test_a_batch_of_one_scene_is_singular(tmp_path, capsys):
    (tmp_path / "in.jsonl").write_text(json.dumps(rising().to_json()) + "\n")

    assert code_of("batch", tmp_path / "in.jsonl", "-o", tmp_path / "out.jsonl") == 0
    assert "1 scene processed, 0 failed" in capsys.readouterr().err


@pytest.fixture
def proved(tmp_path, monkeypatch):
    """A scene with its proof and its certificate in the current folder."""
    monkeypatch.chdir(tmp_path)
    a = Body("a", [(0, 0), (1, 0), (0, 1)], Translation([0, 1]))
    Scene([a, Body("w", [(4, -5), (4, 5)])], time=(0, 9)).save("scene.json")
    assert code_of("collide", "scene.json", "--proof", "a.proof") == 0
    assert code_of("collide", "scene.json", "--certificate", "c.apart") == 0


def test_a_proof_without_its_scene_says_how_to_call(proved, capsys):
    assert code_of("check", "a.proof") == 2
    message = capsys.readouterr().err
    assert message == (
        "exactpt: a.proof: a proof needs its scene, and a.proof.scene.json is not beside it: "
        "exactpt check SCENE a.proof\n"
    )


@every("arguments", [["scene.json", "a.proof"], ["scene.json", "c.apart"], ["c.apart"]])
def test_a_proof_is_checked_and_its_verdict_is_json(arguments, proved, capsys):
    capsys.readouterr()
    assert code_of("check", *arguments, "--json") == 0
    verdict = json.loads(capsys.readouterr().out)
    assert verdict["ok"] is True
    assert verdict["statement"].startswith("accepted: ")
    assert verdict["cgal_check"] in ("agrees", None)


def test_a_proof_that_is_rejected_has_exit_code_1(proved, capsys):
    lines = Path("a.proof").read_text().splitlines()
    Path("a.proof").write_text("\n".join(lines[:4] + lines[5:]))

    assert code_of("check", "scene.json", "a.proof", "--json") == 1
    assert json.loads(capsys.readouterr().out.splitlines()[-1])["ok"] is False


def test_the_first_scene_of_a_user_has_a_contact(tmp_path, capsys):
    assert code_of("generate", "stars", "-o", tmp_path / "s.json") == 0
    assert code_of("collide", tmp_path / "s.json") == 0
    assert capsys.readouterr().out.startswith("first contact at t = 0.494")


@every("name", all_commands())
def test_help_is_complete_without_another_page(name):
    text = run(name, "--help").output

    assert "As of" not in text
    if name not in ("bench", "judge", "oracle", "questions"):  # about tests of engines
        assert "answer" not in text.lower()


SCRIPTS = sorted((ROOT / "examples").glob("*.py"))
WITHOUT_ARGUMENTS = {"bouncing_box", "game_engine", "robot_arm", "robot_cell"}
NEEDS = {"outline_of_text": "fontTools", "million_pairs": "pyarrow", "robot_arm": "scipy",
         "robot_cell": "scipy"}  # fmt: skip


@pytest.mark.long
@every("script", SCRIPTS)
def test_each_script_is_listed_and_asks_for_its_arguments(script):
    listed = (ROOT / "docs" / "examples" / "README.md").read_text()
    assert f"| `{script.name}` | " in listed
    try:
        __import__(NEEDS.get(script.stem, "sys"))
    except ImportError:
        return
    if script.stem in WITHOUT_ARGUMENTS:
        return
    done = subprocess.run([sys.executable, script], capture_output=True, text=True, check=False)
    assert done.returncode == 2, done.stderr
    assert done.stderr.startswith(f"usage: {script.name} ")
