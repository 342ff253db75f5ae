"""No command replaces a file that nobody has named as its output."""

import hashlib
import json
import os
import sys

import pytest
from commands import code_of

from exactpt import Body, InputError, Scene, Simulation, Translation, certify, prove

SCENE = Scene([Body("a", [(0, 0)], Translation([0, 1])), Body("b", [(5, -1), (5, 1)])], time=(0, 9))


@pytest.fixture
def here(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    SCENE.save(tmp_path / "scene.json")
    return tmp_path


@pytest.mark.parametrize(
    "line",
    [
        "convert scene.json scene.json",
        "convert scene.json ./again.json",
        "draw scene.json -o drawing.svg",
        "tile scene.json -o scene.json",
        "simulate scene.json --events scene.json",
        "collide scene.json --proof scene.json",
        "collide scene.json --certificate again.json",
    ],
)
def test_output_that_is_the_input_is_refused(here, capsys, line):
    (here / "again.json").symlink_to("scene.json")
    os.link("scene.json", "drawing.svg")
    before = (here / "scene.json").read_bytes()

    assert code_of(*line.split()) == 2

    assert "is the input: choose another name" in capsys.readouterr().err
    assert (here / "scene.json").read_bytes() == before


OPTIONS = ("--proof", "--certificate")


@pytest.mark.parametrize("option", OPTIONS)
def test_file_beside_a_proof_is_left_alone(here, capsys, option):
    """Only the proof is named; its scene goes beside it, where another file may be."""
    (here / "found.scene.json").write_text("precious\n")
    write = {"--proof": prove, "--certificate": certify}[option]

    with pytest.raises(InputError, match=r"found\.scene\.json: not the scene of found: move"):
        write(SCENE).save(here / "found")
    if option == "--certificate":
        assert code_of("collide", "scene.json", option, "found") == 2
        assert capsys.readouterr().err.count("\n") == 1

    assert (here / "found.scene.json").read_text() == "precious\n"
    assert not (here / "found").exists()


@pytest.mark.parametrize("option", OPTIONS)
def test_scene_of_an_earlier_proof_is_replaced(here, option):
    """The proof that is replaced has its digest."""
    write = {"--proof": prove, "--certificate": certify}[option]
    write(SCENE).save(here / "found")
    other = Scene(SCENE.bodies, time=(0, 7))

    write(other).save(here / "found")

    beside = (here / "found.scene.json").read_bytes()
    assert json.loads(beside)["time"] == ["0", "7"]
    assert hashlib.sha256(beside).hexdigest() in (here / "found").read_text()


@pytest.mark.skipif(sys.platform == "win32", reason="links of a Unix")
def test_link_beside_a_proof_is_not_followed(here):
    (here / "target").write_text("precious\n")
    (here / "found.scene.json").symlink_to("target")

    with pytest.raises(InputError, match=r"found\.scene\.json: a link"):
        prove(SCENE).save(here / "found")
    assert (here / "target").read_text() == "precious\n"


@pytest.mark.parametrize("name", ["1.scene.json", "1.proof", "run.chain"])
def test_folder_with_files_of_a_proof_is_refused(here, name):
    (here / "proofs").mkdir()
    (here / "proofs" / name).write_text("precious\n")

    with pytest.raises(InputError, match="contains proofs"):
        Simulation(SCENE, proof=here / "proofs")
    assert [path.name for path in (here / "proofs").iterdir()] == [name]


@pytest.mark.parametrize("name", ["1.scene.json", "1.proof", "run.chain"])
def test_file_that_appears_in_a_folder_of_proofs_is_left_alone(here, name):
    (here / "proofs").mkdir()
    simulation = Simulation(SCENE, proof=here / "proofs")
    simulation.run(1)
    (here / "proofs" / name).write_text("precious\n")

    with pytest.raises(InputError, match=r"it exists"):
        list(simulation.run())
    assert (here / "proofs" / name).read_text() == "precious\n"
