"""Proofs of simulations in which plans change: one for each part, each with its scene."""

from fractions import Fraction
from itertools import pairwise
from pathlib import Path

import proving
import pytest
from click.testing import CliRunner
from proving import by_both_checkers  # noqa: F401 - a fixture

from exactpt import (
    Body,
    Bounce,
    InputError,
    Scene,
    Simulation,
    Translation,
    proof_scene,
)
from exactpt.cli import cli
from exactpt.testing.scenes import generate

pytestmark = pytest.mark.usefixtures("by_both_checkers")


def verdicts(folder):
    """What the checker says of all parts, in order; each begins where the one before it ends."""
    paths = sorted(Path(folder).glob("*.proof"), key=lambda path: int(path.stem))
    assert [path.stem for path in paths] == [str(i + 1) for i in range(len(paths))]
    spans = [path.read_text().splitlines()[2].split()[1:] for path in paths]
    assert all(a[1] == b[0] for a, b in pairwise(spans))
    chain = Path(folder) / "run.chain"
    assert len(chain.read_text().splitlines()) >= len(paths)
    assert len(list(Path(folder).iterdir())) == 2 * len(paths) + 1
    return [
        proving.current[0](path.with_suffix(".scene.json").read_bytes(), path.read_bytes())
        for path in paths
    ]


def all_accepted(folder):
    found = verdicts(folder)
    assert all(line.startswith("accepted: ") for line in found), found
    return found


def box(name, x, y, motion=None):
    return Body(name, [(x, y), (x + 1, y), (x + 1, y + 1), (x, y + 1)], motion or Translation())


def crowd():
    moving = Translation([0, 1], [0, "1/3"])
    return [box("a", 0, 0, moving), box("b", 5, 1), box("c", 3, 6, Translation([0], [0, "-1/2"]))]


@pytest.mark.parametrize("tiling", ["auto", "lazy", "greedy", "mixed"])
def test_new_motions(tiling, tmp_path):
    simulation = Simulation(Scene(crowd(), time=(0, 12)), tiling=tiling, proof=tmp_path)
    list(simulation.run(2))
    simulation.set_motion("a", Translation([2], ["-4/3", 1]))
    simulation.set_motion("b", Translation([2, -1]))
    list(simulation.run())
    found = all_accepted(tmp_path)
    assert found[0].startswith("accepted: no contact in [0, 2]; the span of the scene is [0, 12]: ")
    assert len(found) == 2


@pytest.mark.parametrize("tiling", ["lazy", "greedy", "mixed"])
def test_bodies_come_and_go(tiling, tmp_path):
    simulation = Simulation(Scene(crowd(), time=(0, 4)), tiling=tiling, proof=tmp_path)
    list(simulation.run(1))
    simulation.add(Body("chain", [(-3, -3), (-3, 4), (-2, 6)], closed=False))
    list(simulation.run(2))
    simulation.remove("b")
    list(simulation.run("5/2"))
    simulation.remove("chain")
    simulation.add(Body("point", [(9, 9)], Translation([0, "-1/2"])))
    list(simulation.run())
    assert len(all_accepted(tmp_path)) == 4


def test_points_are_built_anew(tmp_path):
    points = [Body(f"p{i}", [(i, i * i % 7)], Translation([0, i % 3])) for i in range(6)]
    simulation = Simulation(Scene(points, time=(0, 3)), proof=tmp_path)
    list(simulation.run("1/2"))
    simulation.remove("p2")
    list(simulation.run(1))
    simulation.add(Body("square", [(20, 0), (22, 0), (22, 2), (20, 2)]))
    list(simulation.run())
    assert len(all_accepted(tmp_path)) >= 2


def test_bounces(tmp_path):
    walls = [Body(n, [(x, -9), (x, 9)]) for n, x in (("left", -5), ("right", 5))]
    ball = Body("ball", [(0, 0), (1, 0), (0, 1)], Translation([0, 3], [0, "1/7"]))
    simulation = Simulation(Scene([*walls, ball], time=(0, 9)), proof=tmp_path)
    events = list(simulation.run(on_contact=Bounce(fixed=["left", "right"])))
    bounces = sum(event.kind == "contact" for event in events)
    found = all_accepted(tmp_path)
    assert bounces > 2
    assert len(found) == bounces + 1
    assert found[-1].endswith(", 9], the whole span")


def test_a_response_that_changes_nothing(tmp_path):
    simulation = Simulation(generate("stars", 6), proof=tmp_path)
    list(simulation.run(on_contact=lambda *_: None))
    (line,) = all_accepted(tmp_path)
    assert "accepted: first contact at T = " in line


def test_bug_the_contact_after_a_change_of_no_motion_had_no_proof(tmp_path):
    simulation = Simulation(generate("stars", 6), proof=tmp_path)
    list(simulation.run(on_contact=lambda run, _: run.set_motions({})))
    before, line = all_accepted(tmp_path)
    assert "accepted: no contact in " in before
    assert "accepted: first contact at T = " in line


@pytest.mark.long("python-keyframed")
@pytest.mark.parametrize("family", ["stars", "deforming", "keyframed", "pieces", "clamps", "row"])
def test_the_last_part_ends_with_the_contact(family, tmp_path):
    for seed in (1, 2):
        scene = generate(family, seed)
        simulation = Simulation(scene, proof=tmp_path / str(seed))
        contact = simulation.run_to_contact()
        *_, last = all_accepted(tmp_path / str(seed))
        assert (" contact at T = " in last) == (contact is not None)


def test_contact_at_the_start(tmp_path):
    Simulation(Scene([box("a", 0, 0), box("b", 1, 0)]), proof=tmp_path)
    (line,) = all_accepted(tmp_path)
    assert line.startswith("accepted: contact at the start t = 0: ")


def test_a_body_that_deforms_later(tmp_path):
    # Rigid up to t = 1: there is a part up to then in which it is solid.
    star = [(0, 0), (4, 0), (2, 1), (2, 4)]
    bent = [(0, 0), (4, 0), (3, 1), (2, 5)]
    frames = [(0, star), (1, star), (2, bent), (3, bent)]
    bodies = [Body("s", keyframes=frames), Body("p", [(9, 1)], Translation([0, -1]))]
    simulation = Simulation(Scene(bodies, time=(0, 4)), proof=tmp_path)
    list(simulation.run())
    found = all_accepted(tmp_path)
    assert found[0].startswith("accepted: no contact in [0, 1]; the span ")
    inside = ["inside " in path.read_text() for path in sorted(tmp_path.glob("*.proof"))]
    assert inside == [False, True]


def test_the_end_of_a_proof(tmp_path):
    simulation = Simulation(generate("stars", 6), proof=tmp_path / "rational")
    list(simulation.run(Fraction(1, 100)))
    simulation.end_proof()
    list(simulation.run())
    (line,) = all_accepted(tmp_path / "rational")
    assert line.startswith("accepted: no contact in [0, 1/100]; the span of the scene is [0, 4]: ")
    simulation = Simulation(generate("stars", 6), proof=tmp_path / "irrational")
    while simulation.now.simplified().is_rational:
        assert simulation.step()
    simulation.end_proof()
    (line,) = all_accepted(tmp_path / "irrational")
    proved = line.split("[0, ")[1].split("]")[0]
    assert simulation.now.compare_rational(proof_scene.Fraction(proved)) > 0
    simulation.end_proof()


def test_command(tmp_path):
    file, folder = tmp_path / "scene.json", tmp_path / "proofs"
    generate("stars", 6).save(file)
    arguments = ["simulate", str(file), "--proof", str(folder)]
    done = CliRunner().invoke(cli, arguments, catch_exceptions=False)
    assert done.exit_code == 0
    assert "first contact at T = 249/155: incidences exactly b2.0" in all_accepted(folder)[0]
    with pytest.raises(InputError, match="contains proofs"):
        CliRunner().invoke(cli, arguments, catch_exceptions=False)


def test_a_refused_scene_leaves_no_folder(tmp_path):
    """The folder was made, and stayed empty; one that was there before stays as it was."""
    round_ = Scene([Body("ball", [(0, 0)], radius=1)])
    (tmp_path / "old").mkdir()
    for folder in (tmp_path / "new", tmp_path / "old"):
        with pytest.raises(InputError, match="'ball' has a radius"):
            Simulation(round_, proof=folder)
    assert [path.name for path in tmp_path.iterdir()] == ["old"]


def test_where_no_folder_can_be(tmp_path):
    (tmp_path / "file").write_text("")
    for path in (tmp_path / "file", tmp_path / "none" / "folder", "\0"):
        with pytest.raises(InputError, match="cannot be written"):
            Simulation(Scene([]), proof=path)


def test_a_copy_writes_nothing(tmp_path):
    simulation = Simulation(generate("stars", 6), proof=tmp_path)
    list(simulation.copy().run())
    assert not list(tmp_path.iterdir())


def test_no_bodies(tmp_path):
    list(Simulation(Scene([], time=(0, 1)), proof=tmp_path).run())
    assert all_accepted(tmp_path) == ["accepted: no contact in [0, 1], the whole span"]
