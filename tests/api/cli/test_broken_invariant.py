"""A broken invariant: the command saves the scene, an error in Python has it, no file is left."""

import pickle
from functools import partial
from pathlib import Path

import pytest

from exactpt import AuditError, Scene, Simulation, cli, first_contact

DEMO = Path(cli.__file__).parents[1] / "data" / "demo.json"


def test_the_command_line_saves_the_scene_of_a_broken_invariant(tmp_path, monkeypatch, capsys):
    def broken(*_):
        raise AuditError("broken on purpose")

    monkeypatch.setattr("exactpt.tiling.driver.initial_touches", broken)
    monkeypatch.setattr("tempfile.tempdir", str(tmp_path))
    with pytest.raises(SystemExit) as ended:
        cli.main(["collide", str(DEMO), "--method", "kinetic"])

    (saved,) = tmp_path.iterdir()
    assert ended.value.code == 3
    assert str(saved) in capsys.readouterr().err
    assert saved.read_bytes() == DEMO.read_bytes()


@pytest.mark.parametrize("how", ["simulation", "kinetic", "pairs", "running"])
def test_an_error_raised_in_python_has_its_scene(tmp_path, monkeypatch, how):
    scene = Scene.load(DEMO)

    def broken(*_, **__):
        raise AuditError("broken on purpose")

    monkeypatch.setattr("exactpt.search.sweep_search.SweepSearch.run_to_contact", broken)
    calls = {
        "simulation": partial(Simulation, scene),
        "kinetic": partial(first_contact, scene, method="kinetic"),
        "pairs": partial(first_contact, scene, method="pairs"),
        "running": Simulation(scene).step,
    }
    place = "advance" if how == "running" else "begin"
    monkeypatch.setattr(f"exactpt.tiling.engine.Engine.{place}", broken)
    with pytest.raises(AuditError) as caught:
        calls[how]()
    (pickle.loads(pickle.dumps(caught.value)).scene or scene).save(tmp_path / "bug.json")

    assert caught.value.__notes__ == ['To report it, save the scene: error.scene.save("bug.json")']
    assert Scene.load(tmp_path / "bug.json") == scene == caught.value.scene


def test_the_library_saves_nothing(tmp_path, monkeypatch):
    """It raises; the scene is the caller's."""
    scene = Scene.load(DEMO)
    monkeypatch.setattr("tempfile.tempdir", str(tmp_path))
    monkeypatch.setattr("exactpt.tiling.driver.initial_touches", lambda *_: 1 // 0)

    with pytest.raises(ZeroDivisionError):
        Simulation(scene)

    assert list(tmp_path.iterdir()) == []
