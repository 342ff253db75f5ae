"""`exactpt convert` and `exactpt generate` as a user meets them."""

import json

import pytest
from commands import code_of, run

from exactpt import Body, BudgetExceeded, Scene, Translation
from exactpt.pair import start as initial
from exactpt.testing.scenes import FAMILIES, POINTS
from exactpt.testing.scenes import generate as generated

TOUCHING = """
POLYGON ((0 0, 0.1 0, 0.1 0.1, 0 0))
POLYGON ((0.1 0, 1 0, 1 1, 0.1 0))
"""
TIE = "POLYGON ((0 0, 2 2, 2 0, 0 1, 0 0))\nPOINT (9 9)"


def refused(capsys, *arguments):
    assert code_of(*list(map(str, arguments))) == 2
    out, err = capsys.readouterr()
    assert out == ""
    assert err.startswith("exactpt: ")
    assert err.count("\n") == 1
    return err


@pytest.mark.parametrize(
    "option", [("--time", 0, 5), ("--tolerance", 2), ("--holes", "fill"), ("--skip-invalid",)]
)
def test_what_a_scene_has_no_use_for_is_refused(tmp_path, capsys, option):
    source, target = tmp_path / "scene.json", tmp_path / "other.json"
    generated("convex", 0).save(source)

    assert f"{option[0]}: {source} is a scene" in refused(
        capsys, "convert", source, target, *option
    )
    assert not target.exists()


def test_an_empty_span_is_the_option_s_fault(tmp_path, capsys):
    source = tmp_path / "parcels.wkt"
    source.write_text(TOUCHING)

    said = refused(capsys, "convert", source, tmp_path / "scene.json", "--time", 5, 1)

    assert "--time: the span from 5 to 1 is empty" in said


def test_shapes_become_a_scene_that_says_what_touches(tmp_path):
    source, scene = tmp_path / "parcels.wkt", tmp_path / "scene.json"
    source.write_text(TOUCHING)

    result = run("convert", source, scene, "--time", "-1", "7/2")

    assert result.exit_code == 0
    assert "2 bodies, 6 vertices" in result.stdout
    assert "bodies touch at the start" in result.stderr
    assert "body 0 and body 1" in result.stderr
    made = Scene.load(scene)
    assert (str(made.start), str(made.end)) == ("-1", "7/2")
    assert made.bodies[0].at(0)[1][0] * 10 == 1
    assert "kind initial" in run("collide", scene).output


@pytest.mark.parametrize("ending", ["geojson", "wkt", "svg"])
def test_a_scene_at_a_time_becomes_shapes_and_a_scene_again(tmp_path, ending):
    moving = Body("m", [(0, 0), (1, 0), (0, 1)], Translation(["0", "1/3"], [0, 0, 1]))
    Scene([moving, Body("far", [(50, 50)])], (0, 5)).save(tmp_path / "scene.json")

    then = tmp_path / f"then.{ending}"
    assert run("convert", tmp_path / "scene.json", then, "--at", "1/2").exit_code == 0
    assert run("convert", then, tmp_path / "again.json").exit_code == 0

    (again, _) = Scene.load(tmp_path / "again.json").bodies
    positions = [tuple(map(float, p)) for p in again.at(0)]
    assert positions == [(1 / 6, 0.25), (7 / 6, 0.25), (1 / 6, 1.25)]


def test_a_json_file_may_be_geojson(tmp_path):
    source = tmp_path / "point.json"
    source.write_text('{"type": "Point", "coordinates": [0.1, 2]}')

    assert run("convert", source, tmp_path / "scene.json").exit_code == 0
    assert str(Scene.load(tmp_path / "scene.json").bodies[0].at(0)[0][0]) == "1/10"


def test_what_is_left_out_is_said(tmp_path):
    source = tmp_path / "tie.wkt"
    source.write_text(TIE)

    result = run("convert", source, tmp_path / "scene.json", "--skip-invalid")

    assert result.exit_code == 0
    assert f"left out: {source}: geometry 0: body 'body 0': not a simple" in result.stderr
    assert [body.name for body in Scene.load(tmp_path / "scene.json").bodies] == ["body 1"]


@pytest.mark.parametrize(
    "arguments, message",
    [
        (["none.wkt", "out.json"], "none.wkt: cannot be read: No such file"),
        (
            ["tie.txt", "out.json"],
            "a file of shapes ends in one of .geojson, .mfjson, .wkt, .svg, .json",
        ),
        (
            ["dot.wkt", "out.txt"],
            "a file of shapes ends in one of .geojson, .mfjson, .wkt, .svg, .json",
        ),
        (["tie.wkt", "out.json"], "tie.wkt: geometry 0: body 'body 0': not a simple polygon"),
        (["dot.wkt", "out.json", "--at", "0"], "a scene has all times"),
        (["dot.wkt", "out.wkt", "--at", "2"], "t = 2 is outside the time span from 0 to 1"),
        (["dot.wkt", "out.json", "--time", "1", "1"], "the span from 1 to 1 is empty"),
        (["dot.wkt", "out.json", "--time", "1", "x"], "not a number: 'x'"),
        (["dot.wkt", "nowhere/out.json"], "cannot be written"),
        (["drawing.svg", "out.json", "--tolerance", "0"], "the tolerance is a positive number"),
    ],
)
def test_bad_calls_write_nothing(tmp_path, monkeypatch, capsys, arguments, message):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "tie.wkt").write_text(TIE)
    (tmp_path / "dot.wkt").write_text("POINT (1 2)")
    (tmp_path / "drawing.svg").write_text("<svg/>")

    assert message in refused(capsys, "convert", *arguments)

    assert not list(tmp_path.glob("out.*"))


@pytest.mark.parametrize("family", [*FAMILIES, *POINTS])
def test_generate_is_listed_and_writes_the_family(family, tmp_path):
    result = run("generate", family, "--seed", "3", "-o", tmp_path / "scene.json")

    assert result.exit_code == 0
    made, expected = Scene.load(tmp_path / "scene.json"), generated(family, 3)
    assert (made.start, made.end) == (expected.start, expected.end)
    assert made.at(made.end) == expected.at(expected.end)
    assert f"  {family}  " in run("generate", "--help").output


def test_generate_prints_a_scene():
    assert json.loads(run("generate", "row").output)["exactpt"] == 1


def test_generate_guesses_what_was_meant(capsys):
    assert "no family 'staers': perhaps stars" in refused(capsys, "generate", "staers")
    assert "perhaps convex (all: --help)" in refused(capsys, "generate", "zzz")


def test_a_refusal_is_one_line_though_an_outline_was_left_out(tmp_path, capsys):
    """The hostile fuzzer found the line about the outline before the one about the error."""
    source = tmp_path / "two.wkt"
    source.write_text("POLYGON ((0 0, 2 2, 2 0, 0 2, 0 0))\nPOLPOLYGON\n")

    code_of("convert", source, tmp_path / "two.json", "--skip-invalid")

    error = capsys.readouterr().err
    assert error.count("\n") == 1
    assert "not well-known text" in error


def test_nothing_is_written_if_the_time_is_used_up_by_what_touches(tmp_path, monkeypatch, capsys):
    """The hostile fuzzer found the file, and exit code 4."""

    def slow(scene):
        raise BudgetExceeded("time limit exceeded", scene.start)

    monkeypatch.setattr(initial, "initial_touches", slow)
    (tmp_path / "two.wkt").write_text(TOUCHING)

    assert code_of("convert", tmp_path / "two.wkt", tmp_path / "two.json") == 4
    assert capsys.readouterr().out == ""
    assert [file.name for file in tmp_path.iterdir()] == ["two.wkt"]
