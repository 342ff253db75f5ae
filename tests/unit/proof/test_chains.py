"""Proofs of the parts of one run: both checkers verify them and their seams."""

import json
import re
import subprocess
import sys

import pytest
from click.testing import CliRunner

from exactpt import Body, Scene, Simulation, Translation, proof_check, prove
from exactpt.cli import cli

pytestmark = pytest.mark.cgal


@pytest.fixture
def chain(tmp_path):
    """Three parts: b turns away at t = 2, c enters at t = 3."""
    a = Body("a", [(0, 0), (1, 0), (0, 1)], Translation([0, 1]))
    b = Body("b", [(9, 0), (10, 0), (10, 1)])
    simulation = Simulation(Scene([a, b], time=(0, 6)), proof=tmp_path / "run")
    list(simulation.run(2))
    simulation.set_motion("b", Translation([0], [-4, 2]))
    list(simulation.run(3))
    simulation.add(Body("c", [(-5, -5)]))
    list(simulation.run())
    return tmp_path / "run"


@pytest.fixture
def both(program, capsys):
    """The exit code and the line, the same from both checkers."""

    def run(folder, *options):
        command = [str(program), "proof", str(folder), *options]
        done = subprocess.run(command, capture_output=True, check=False, text=True)
        code = proof_check.main([str(folder), *options])
        said = capsys.readouterr()
        assert code == done.returncode, (said, done.stdout)
        if code == 0:
            assert said.out == done.stdout
        return code, done.stdout

    return run


def numbers(folder):
    return sorted(int(path.stem) for path in folder.glob("*.proof"))


def test_a_run_is_accepted(chain, both):
    assert numbers(chain) == [1, 2, 3]
    code, line = both(chain)
    assert code == 0
    said = "along 3 parts from t = 0: no contact in [0, 6], the whole span; at t = 3 enters 'c'\n"
    assert line.endswith(said)
    lines = (chain / "run.chain").read_text().splitlines()
    assert [line.split()[0] for line in lines] == ["exactpt-chain", "1", "2", "3"]
    (chain / "run.chain").unlink()
    assert both(chain) == (0, line)


def test_exactpt_check_of_a_folder(chain, program, monkeypatch):
    monkeypatch.setenv("EXACTPT_CGAL_CHECK", str(program))
    done = CliRunner().invoke(cli, ["check", str(chain)], catch_exceptions=False)
    assert done.exit_code == 0, done.output
    assert done.output.endswith("cgal_check agrees\n")
    (chain / "2.proof").unlink()
    assert CliRunner().invoke(cli, ["check", str(chain)], standalone_mode=False).return_value == 1


def test_a_gap_an_exchange_and_a_cut(chain, both, tmp_path):
    def again(change):
        files = {path: path.read_bytes() for path in chain.iterdir()}
        change()
        code, line = both(chain)
        for path in chain.iterdir():
            path.unlink()
        for path, content in files.items():
            path.write_bytes(content)
        return code, re.sub(r"rejected: ", "", line).strip()

    def remove(*parts):
        for k in parts:
            (chain / f"{k}.proof").unlink()
            (chain / f"{k}.scene.json").unlink()

    def exchange():
        for end in ("proof", "scene.json"):
            one, two = chain / f"1.{end}", chain / f"2.{end}"
            content = one.read_bytes()
            one.write_bytes(two.read_bytes())
            two.write_bytes(content)

    def cut_with_the_manifest():
        remove(3)
        lines = (chain / "run.chain").read_text().splitlines()[:3]
        (chain / "run.chain").write_text("\n".join(lines) + "\n")

    assert again(lambda: remove(2)) == (1, "the numbers of the parts have a gap")
    assert again(lambda: remove(1))[0] == 2
    assert again(exchange)[0] == 1
    assert again(lambda: remove(3))[0] == 1
    assert again(cut_with_the_manifest) == (1, "proved up to 3 only (see --until, --partial)")
    assert again(lambda: (chain / "run.chain").write_text("exactpt-chain 1\n"))[0] == 1


@pytest.mark.parametrize(
    "change",
    [
        lambda body: body["vertices"][0].__setitem__(0, "1/1000"),
        lambda body: body["vertices"].append(["-1/8", "1/2"]),
        lambda body: body.update(closed=False),
    ],
    ids=["jumps", "has another vertex", "opens"],
)
def test_a_body_that_changes_at_a_seam(chain, both, change):
    data = json.loads((chain / "2.scene.json").read_text())
    change(data["bodies"][0])
    scene = Scene.from_json(data)
    proved = prove(scene.until(3))
    content = json.dumps(data).encode()
    text = prove(scene.until(3), scene_file=content).text
    (chain / "2.scene.json").write_bytes(content)
    (chain / "2.proof").write_bytes(text)
    (chain / "run.chain").unlink()
    assert proof_check.check(content, text).until == 3
    assert proved.contact is None
    code, line = both(chain)
    assert code == 1
    assert "part 2: 'a' is not what or where it was" in line


def test_the_checker_is_written(tmp_path, chain):
    file = tmp_path / "check.py"
    done = CliRunner().invoke(cli, ["check", "--write-checker", str(file)], catch_exceptions=False)
    assert done.exit_code == 0
    command = [sys.executable, "-I", str(file)]
    version = subprocess.run([*command, "--version"], capture_output=True, check=True, text=True)
    assert done.stdout.startswith(version.stdout.strip())
    found = subprocess.run([*command, str(chain)], capture_output=True, check=False, text=True)
    assert (found.returncode, found.stdout[:10]) == (0, "accepted: ")
