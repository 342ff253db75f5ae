"""Names that are commands to a terminal: no command writes them raw."""

import json
import subprocess
import sys

import pytest
from commands import code_of

from exactpt import Body, InputError, Scene, Translation, proof_check, read_shapes, write_shapes
from exactpt.errors import printable

EVIL = {
    "escape": "a\x1b]0;owned\x07",
    "C1": "b\x9b31m",
    "DEL": "c\x7f",
    "override": "d\u202etxt.exe",
    "isolate": "e\u2067",
    "return": "f\rok",
    "separator": "g\u2028h",
    "null": "h\x00",
    "noncharacter": "i\ufffe",
}


def is_harmless(text):
    return text.replace("\n", "").isprintable()


@pytest.fixture(params=EVIL)
def name(request):
    return EVIL[request.param]


@pytest.fixture
def folder(tmp_path, monkeypatch, name):
    monkeypatch.chdir(tmp_path)
    moving = Body(name, [(0, 0), (1, 0), (0, 1)], Translation([0, 1]))
    spot = Body("spot", [(3, 5)], Translation([0], [0, "-1/9"]))
    Scene([moving, Body(f"wall {name}", [(9, -5), (9, 5)]), spot], (0, 20)).save("scene.json")
    return tmp_path


@pytest.mark.parametrize(
    "line",
    [
        "collide scene.json --stats",
        "collide scene.json --json",
        "collide scene.json --proof a.proof",
        "simulate scene.json --verbose",
        "simulate scene.json --events /dev/stdout",
        "tile scene.json",
        "draw scene.json -o film.html",
        "convert scene.json out.geojson",
        "convert scene.json out.json",
    ],
)
def test_answers(folder, capfd, line):
    assert code_of(*line.split()) == 0

    out, err = capfd.readouterr()
    assert is_harmless(out)
    assert is_harmless(err)


def test_refusals(folder, capsys, name):
    data = json.loads((folder / "scene.json").read_text())
    wounds = [
        {"name": name},
        {"name": name, "vertices": [[0, 0]], "closed": name},
        {"name": name, "vertices": [[0, name]]},
        {"name": name, "vertices": [[0, 0]], name: 1},
        {"name": name, "vertices": [[0, 0], [0, 0]]},
        {"name": name, "vertices": [[0, 0]]},
    ]
    for body in wounds:
        (folder / "bad.json").write_text(json.dumps(data | {"bodies": [*data["bodies"], body]}))
        assert code_of("collide", "bad.json") == 2
    lines = [
        ("collide", f"no{name}".replace("\x00", "")),
        ("collide", "scene.json", "--ignore", f"{name},nobody", "--method", "pairs"),
        ("collide", "scene.json", "--tiling", name),
        ("collide", "scene.json", f"--{name}"),
        ("tile", "scene.json", "--at", name),
        ("generate", name),
        (name,),
    ]
    reported = [code_of(*line) for line in lines]

    out, err = capsys.readouterr()
    assert (out, set(reported)) == ("", {2})
    assert is_harmless(err)
    assert len(err.splitlines()) == len(wounds) + len(lines)


def test_a_proof_that_is_checked(folder, capfd):
    assert code_of("collide", "scene.json", "--proof", "a.proof") == 0
    assert proof_check.main(["scene.json", "a.proof"]) == 0
    assert proof_check.main(["scene.json", "scene.json"]) == 2

    assert is_harmless("".join(capfd.readouterr()))


@pytest.mark.parametrize("ending", ["geojson", "svg", "wkt"])
def test_what_is_converted_can_be_read(folder, ending):
    scene = Scene.load("scene.json")
    write_shapes(scene, f"then.{ending}")

    again = read_shapes(f"then.{ending}")

    assert [body.size for body in again.bodies] == [body.size for body in scene.bodies]


def doubles(body):
    return [tuple(map(float, point)) for point in body.at(0)]


@pytest.mark.parametrize("ending", ["geojson", "svg", "wkt"])
def test_nothing_and_the_largest_numbers_are_converted_and_read(tmp_path, ending):
    huge = [(1e308, 0.0), (-1e308, 1e-308), (-0.0, -5e-324)]
    for bodies in ([], [Body("a", huge)], [Body("b", [(1e-320, 1e308)])]):
        scene = Scene(bodies)
        write_shapes(scene, tmp_path / f"then.{ending}")
        again = read_shapes(tmp_path / f"then.{ending}")
        assert list(map(doubles, again.bodies)) == list(map(doubles, bodies))


def test_a_bug_is_told_without_raw_names(folder, capsys, monkeypatch, name):
    def broken(_):
        raise ZeroDivisionError(f"with {name}")

    monkeypatch.setattr("exactpt.search.sweep_search.SweepSearch.run_to_contact", broken)
    monkeypatch.setattr("tempfile.tempdir", str(folder))

    assert code_of("collide", "scene.json") == 3
    assert is_harmless(capsys.readouterr().err)


def test_shapes_that_are_refused_or_touch(folder, capsys, name):
    features = [
        {"type": "Feature", "properties": {"name": name}, "geometry": {"type": kind,
         "coordinates": at}}
        for kind, at in [("Point", [0, 0]), ("Point", [0, 0]), ("LineString", [[0, 0]])]
    ]  # fmt: skip
    text = json.dumps({"type": "FeatureCollection", "features": features})
    (folder / "shapes.geojson").write_text(text)

    assert code_of("convert", "shapes.geojson", "out.json", "--skip-invalid") == 0
    assert code_of("convert", "shapes.geojson", "out.json") == 2

    out, err = capsys.readouterr()
    assert "touch" in err
    assert is_harmless(out + err)


@pytest.mark.long
def test_a_name_that_the_terminal_cannot_show(tmp_path):
    """A stream that cannot encode it: once a broken invariant, now an escape."""
    bodies = [Body("бокс", [(0, 0)], Translation([0, 1])), Body("壁", [(5, 0)])]
    Scene(bodies, (0, 9)).save(tmp_path / "scene.json")
    command = "import sys; from exactpt.cli import main; main()"

    done = subprocess.run(
        [sys.executable, "-c", command, "collide", str(tmp_path / "scene.json")],
        env={"PYTHONIOENCODING": "latin-1", "PYTHONPATH": ":".join(sys.path)},
        capture_output=True, text=True, check=False,
    )  # fmt: skip

    assert (done.returncode, done.stderr) == (0, "")
    assert r"vertex 0 of \u0431\u043e\u043a\u0441 on vertex 0 of \u58c1" in done.stdout


def test_messages_are_one_printable_line():
    assert str(InputError("a\nb\x1b")) == r"a\nb\x1b"
    assert printable("höhe 壁") == "höhe 壁"
