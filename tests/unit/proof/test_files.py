"""Proofs as files, written by the command and from Python; the checker stands alone."""

import json
import os
import re
import subprocess
import sys
from fractions import Fraction
from functools import partial
from pathlib import Path
from tempfile import TemporaryDirectory

import pytest
from click.testing import CliRunner
from folding import every
from proving import accepted, proof_of

import exactpt
from exactpt import InputError, proof_check, proof_scene
from exactpt.cli import cli
from exactpt.proof.emit import ProofRun
from exactpt.proof.handout import checker_file
from exactpt.testing.scenes import generate


@pytest.fixture
def scene():
    return generate("stars", 6)


def check(*paths):
    """Run the checker as it is handed out: one file, without the package."""
    with TemporaryDirectory() as folder:
        program = Path(folder) / "check.py"
        program.write_bytes(checker_file("proof_check"))
        command = [sys.executable, "-I", program, *map(str, paths)]
        done = subprocess.run(command, capture_output=True, text=True, check=False)
    return done.returncode, done.stdout + done.stderr


@pytest.mark.parametrize("name", ["proof_check", "check_apart"])
def test_a_checker_that_is_handed_out_is_one_file_with_the_words_of_both(name):
    joined = checker_file(name).decode()

    for module in (name, "proof_scene"):
        text = (Path(proof_check.__file__).parent / f"{module}.py").read_text(encoding="utf-8")
        code = text.split('"""\n', 1)[1]
        own = re.sub(r"from exactpt\.proof_scene import \([^)]*\)\n", "", code)
        assert all(line in joined for line in own.splitlines())
    assert "exactpt import" not in joined
    assert "import exactpt" not in joined


def test_the_checker_imports_nothing_but_the_standard_library():
    code = (
        "import sys; before = set(sys.modules); import exactpt.proof_check;"
        "print(*sorted(set(sys.modules) - before))"
    )
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    found = set(done.stdout.split())
    assert {m for m in found if m.startswith("exactpt")} == {
        "exactpt",
        "exactpt.extensions",  # of the package itself, as every import of one of its modules
        "exactpt.interpreters",
        "exactpt.proof_check",
        "exactpt.proof_scene",
    }
    built_in = {*sys.stdlib_module_names, "_xxsubinterpreters"}
    assert {m.split(".")[0] for m in found} <= {*built_in, "exactpt"}


def test_bug_a_line_is_measured_in_bytes(monkeypatch):
    """The checker in Python counted characters, the one in C++ bytes."""
    monkeypatch.setattr(proof_scene, "MAX_LINE_BYTES", 30)
    head = b"exactpt-proof 1\nscene sha256 x\nspan 0 1\n%s\nnone\n"
    read = partial(proof_scene.read, file_format=proof_check.FORMAT)
    read(head % b"# 2345678901234567890123456789")
    with pytest.raises(proof_scene.NoProofError, match="line 4 is too long"):
        read(head % "# äöüäöüäöüäöüäöüäöü".encode())


def test_bug_the_zeros_of_a_polynomial_were_cut_off_one_by_one():
    """Each made a copy: a list of 200,000 zeros took a minute."""
    lines = []

    def count(_frame, event, _argument):
        lines.append(event)
        return count

    before = sys.gettrace()
    sys.settrace(count)
    try:
        f = proof_scene.Poly([1, 2, *[0] * 5_000])
    finally:
        sys.settrace(before)

    assert f == (1, 2)
    assert 0 < lines.count("line") < 20


def test_first_contact_writes_the_proof_and_the_scene(scene, tmp_path):
    path = tmp_path / "answer.proof"
    contact = exactpt.first_contact(scene, proof=path)
    assert contact.time == exactpt.first_contact(scene).time
    code, answer = check(f"{path}.scene.json", path)
    assert code == 0
    assert answer[26:].startswith(" first contact at T = ")


def test_command(scene, tmp_path):
    file, path = tmp_path / "scene.json", tmp_path / "answer.proof"
    scene.save(file)
    arguments = ["collide", str(file), "--proof", str(path), "--json"]
    done = CliRunner().invoke(cli, arguments, catch_exceptions=False)
    plain = CliRunner().invoke(cli, ["collide", str(file), "--json"])
    assert json.loads(done.output)["contact"] == json.loads(plain.output)["contact"]
    assert json.loads(done.output)["stats"]["events"] > 0
    assert check(file, path)[0] == 0
    assert sorted(p.name for p in tmp_path.iterdir()) == ["answer.proof", "scene.json"]


@pytest.mark.long
def test_until(scene, tmp_path):
    file, path = tmp_path / "scene.json", tmp_path / "answer.proof"
    scene.save(file)
    end = (scene.start + exactpt.first_contact(scene).time.low) / 2
    CliRunner().invoke(cli, ["collide", str(file), "--until", str(end), "--proof", str(path)])
    assert check(file, path) == (1, f"rejected: proved up to {end} only (see --until, --partial)\n")
    assert check(file, path, "--until", scene.end)[0] == 1
    for options in (["--partial"], ["--until", end], ["--until", scene.start]):
        code, answer = check(file, path, *options)
        assert code == 0
        assert f" no contact in [{scene.start}, {end}]; the span of the scene is " in answer
    for options in (["--until", "x"], ["--until"], ["--partial", "--until", end], ["--whole"]):
        assert check(file, path, *options)[0] == 2


@pytest.mark.long
@pytest.mark.parametrize("name", ["__future__", "fractions", "hashlib", "json"])
def test_modules_planted_nearby_do_not_run(scene, tmp_path, name):
    proved = exactpt.prove(scene)
    proved.save(tmp_path / "p")
    program = tmp_path / "check.py"
    program.write_bytes(checker_file("proof_check"))
    (tmp_path / f"{name}.py").write_text("import os; print('planted'); os._exit(0)\n")
    for options, code in ((["-I"], 0), ([], 2), (["-s"], 2)):
        command = [sys.executable, *options, program, "p.scene.json", "p"]
        done = subprocess.run(command, capture_output=True, text=True, check=False, cwd=tmp_path)
        assert done.returncode == code, done.stderr
        assert "planted" not in done.stdout + done.stderr


@pytest.mark.long
def test_exit_codes(scene, tmp_path):
    file, path = tmp_path / "scene.json", tmp_path / "answer.proof"
    scene.save(file)
    lines, _ = proof_of(scene)
    path.write_text("\n".join([*lines[:-1], "none"]) + "\n")
    code, answer = check(file, path)
    assert (code, answer.count("\n")) == (1, 1)
    assert answer.startswith("rejected: line ")
    for wrong in ("", "no proof\n", "\n".join(lines).replace("sha256 ", "sha256 0")):
        path.write_text(wrong)
        code, answer = check(file, path)
        assert (code, answer.count("\n")) == (2, 1)
    assert check(file)[0] == check(file, tmp_path / "none")[0] == 2


def test_what_no_tiling_takes_is_refused(scene, tmp_path):
    path = tmp_path / "answer.proof"
    group = [body.name for body in scene.bodies[:2]]
    for options in ({"method": "pairs"}, {"method": "auto", "ignoring": [group]}):
        with pytest.raises(InputError, match="a proof needs a tiling"):
            exactpt.first_contact(scene, proof=path, **options)
    assert not list(tmp_path.iterdir())


def test_degrees_that_no_checker_takes_are_refused(tmp_path):
    high = [0] * 64 + [1]
    matrix = [[high, 0], [0, 1]]
    point, line = [(0, 0)], [([0, 1], 0)]
    right = [
        (point, exactpt.Translation(high)),
        (point, exactpt.Rigid([0] * 32 + [1])),
        (point, exactpt.Affine(matrix)),
        (line, exactpt.Rigid([0] * 31 + [1], x=[0, 0, 1])),
    ]
    wrong = [
        (point, exactpt.Translation([0, *high])),
        (point, exactpt.Rigid([0] * 33 + [1])),
        (line, exactpt.Affine(matrix)),
        (line, exactpt.Rigid([0] * 32 + [1])),
    ]
    for vertices, motion in right:
        scene = exactpt.Scene([exactpt.Body("a", vertices, motion)], time=(0, 1))
        assert exactpt.prove(scene).check().whole
    for vertices, motion in wrong:
        scene = exactpt.Scene([exactpt.Body("a", vertices, motion)], time=(0, 1))
        with pytest.raises(InputError, match=r"a' has coordinates of degree 6[5-9]: proofs"):
            exactpt.first_contact(scene, proof=tmp_path / "p")
        with pytest.raises(InputError, match="proofs are checked up to degree 64"):
            list(exactpt.Simulation(scene, proof=tmp_path / "folder").run())
        with pytest.raises(proof_scene.NoProofError, match="degree above 64"):
            proof_scene.Scene(json.dumps(exactpt.scene.written.to_json(scene)))
    assert list(tmp_path.iterdir()) == []


def test_out_of_budget_nothing_is_left(scene, tmp_path):
    search = ProofRun(scene, tmp_path / "p", scene_file=b"{}", max_events=1)
    with pytest.raises(exactpt.BudgetExceeded) as spent:
        search.run_to_contact()
    assert scene.start <= spent.value.reached <= exactpt.first_contact(scene).time.high
    assert not list(tmp_path.iterdir())


def test_scenes_are_read_as_the_format_says():
    text = """{"exactpt": 1, "time": [-1, 2.5e0], "bodies": [
        {"name": "a", "vertices": [["0","0"], [1, "1/2"], {"x": [0.5], "y": ["-3e-2", 1]}]},
        {"name": "b", "keyframes": [{"t": 0, "vertices": [[5, 5]]}, {"t": 2, "vertices": [[6, 7]]}]}
    ]}"""
    scene = proof_scene.Scene(text)
    assert (scene.start, scene.end) == (-1, 2.5)
    assert scene.at(2, scene.end) == (0.5, proof_scene.Fraction("2.47"))
    assert [scene.at(3, t) for t in map(proof_scene.Fraction, (-1, 1, 2))] == [
        (5, 5),
        (5.5, 6),
        (6, 7),
    ]


@every(
    "text",
    [
        "[]",
        '{"exactpt": 2, "time": [0, 1], "bodies": []}',
        '{"exactpt": "1", "time": [0, 1], "bodies": []}',
        '{"exactpt": 1, "time": [1, 1], "bodies": []}',
        '{"exactpt": 1, "time": [0, NaN], "bodies": []}',
        '{"exactpt": 1, "time": [0, 1], "bodies": [{"name": "a", "vertices": []}]}',
        '{"exactpt": 1, "time": [0, 1], "bodies": [{"name": "a", "keyframes": [], "radius": 1}]}',
        '{"exactpt": 1, "time": [0, 1], "bodies": [], "bodies": []}',
        '{"exactpt": 1, "time": [0, 1], "bodies": [{"name": "a", "vertices": [["1/0", 1]]}]}',
    ],
)
def test_what_is_no_scene(text):
    with pytest.raises(proof_scene.NoProofError):
        proof_scene.Scene(text)


@pytest.mark.parametrize("family", ["turning", "keyframed", "pieces", "deforming", "clamps"])
def test_tracks_are_those_of_the_package(family):
    from exactpt.scene.written import scene_bytes

    scene = generate(family, 5)
    read = proof_scene.Scene(scene_bytes(scene).decode())
    for k in range(9):
        t = scene.start + (scene.end - scene.start) * k / 8
        places = [p for body in scene.bodies for p in body.at(t)]
        at = proof_scene.Fraction(str(t))
        assert [tuple(map(str, p)) for p in places] == [
            tuple(map(str, read.at(v, at))) for v in range(len(places))
        ]


@pytest.mark.long
def test_nothing_that_is_malformed_crashes_the_checker(scene):
    from random import Random

    lines, _ = proof_of(scene)
    random = Random(5)
    words = ["-", "+", "=", "@", "-1", "9999", "1/0", "x", "vertex", "edge", "inside", "none", "1"]
    for _ in range(300):
        i = random.randrange(2, len(lines))
        line = lines[i].split()
        line[random.randrange(len(line))] = random.choice(words)
        line = line[: random.randint(1, len(line))]
        accepted(scene, [*lines[:i], " ".join(line), *lines[i + 1 :]])
    for last in ("contact", "contact 0 0", "contact 0 0 vertex", "contact 0 0 vertex 1 inside 99"):
        assert not accepted(scene, [*lines[:3], last])
        assert not accepted(scene, [*lines[:-1], last])
    assert not accepted(scene, lines[:-1])
    assert not accepted(scene, [*lines, lines[-1]])


@pytest.mark.long
def test_a_proof_is_the_same_in_every_process():
    code = (
        "from exactpt.proof import prove; from exactpt.testing.scenes import generate;"
        "print(*(prove(generate(f, 1), tiling='lazy').text for f in ('pieces', 'flat')))"
    )
    proofs = {
        subprocess.run(
            [sys.executable, "-c", code],
            capture_output=True,
            check=True,
            env={**os.environ, "PYTHONHASHSEED": seed},
        ).stdout
        for seed in ("1", "2", "3")
    }
    assert len(proofs) == 1


def test_bug_a_part_that_lasts_no_time_left_its_file_open(tmp_path):
    bodies = [exactpt.Body("a", [(0, 0)]), exactpt.Body("b", [(5, 0)])]
    simulation = exactpt.Simulation(exactpt.Scene(bodies, time=(0, 6)), proof=tmp_path / "run")
    (folder,) = simulation._run.driver.observers

    list(simulation.run(0))
    file = folder._file
    simulation.set_motions({"a": exactpt.Velocity(0, 1)})

    assert file.closed
    assert list((tmp_path / "run").glob("*.proof")) == []


def test_bug_three_roots_in_a_row_are_three_times():
    """The middle root was between the intervals of the others, and taken for a root in both."""
    unit = Fraction(1, 2**proof_scene.APART)
    middle = Fraction(1, 2)
    roots = [middle + k * unit * Fraction(3, 2) for k in (-1, 0, 1)]
    f = proof_scene.Poly([1])
    for root in roots:
        f = f * proof_scene.Poly([-root.numerator, root.denominator])
    a = proof_scene.Time(middle - 2 * unit, middle - unit / 4, f)
    b = proof_scene.Time(middle + unit / 4, middle + 2 * unit, f)
    assert roots[0] < proof_scene.between(a, b, Fraction(0), unit) < roots[2]
