"""Proofs before the checker in C++: it agrees with that in Python, and survives any file."""

import hashlib
import subprocess
from fractions import Fraction
from random import Random

import pytest

from exactpt import BudgetExceeded, InputError, proof_check, proof_scene, prove
from exactpt.cgal import check_proof
from exactpt.check import check_scene
from exactpt.testing.scenes import FAMILIES, POINTS, generate
from fuzz.laws.kept import kept, names
from fuzz.witnesses import tilings_of

pytestmark = pytest.mark.cgal

TILINGS = ("lazy", "greedy", "mixed")


@pytest.fixture
def in_cpp(program, tmp_path):
    """The exit code and the line of an answer; the files are those given, byte for byte."""

    def run(scene, proof, *options):
        (tmp_path / "scene.json").write_bytes(scene)
        (tmp_path / "proof").write_bytes(proof)
        command = [program, "proof", tmp_path / "scene.json", tmp_path / "proof", *options]
        done = subprocess.run(command, capture_output=True, check=False, timeout=60)
        assert done.stdout.endswith(b"\n")
        assert done.stdout.count(b"\n") == 1
        assert done.stderr == b""
        return done.returncode, done.stdout.decode().rstrip("\n")

    return run


def in_python(scene, proof):
    """The exit code, and the line."""
    try:
        return 0, proof_check.check(scene, proof)
    except proof_scene.Rejected as rejected:
        return 1, str(rejected)
    except proof_scene.NoProofError as refused:
        return 2, str(refused)


def text(lines):
    return ("\n".join(lines) + "\n").encode()


def nudged(words, random):
    """An event at a time next to its own, or just after it."""
    k = next((k for k, word in enumerate(words) if word in "-+="), len(words))
    by = random.choice([Fraction(999, 1000), Fraction(1001, 1000), 1 + Fraction(1, 2**60)])
    time = str(Fraction(words[1]) * by)
    return ["event", time, time, *words[k:]]


def without_an_item(words, random):
    at = [k for k, word in enumerate(words) if word in "-+="]
    i = random.choice(at)
    return words[:i] + words[min([k for k in at if k > i], default=len(words)) :]


def another_number(words, random):
    k = random.randrange(1, len(words))
    if words[k].lstrip("-").isdigit():
        return [*words[:k], str(int(words[k]) + random.choice([-2, -1, 1, 2])), *words[k + 1 :]]
    return [*words[:k], random.choice("-+=@"), *words[k + 1 :]]


def mutant(lines, random):
    """A proof of which one line, or the order of two, is another one."""
    i, j = random.randrange(2, len(lines)), random.randrange(2, len(lines))
    words = lines[i].split()
    is_event = words[0] == "event"
    kind = random.randrange(8)
    if kind == 0:
        return lines[:i] + lines[i + 1 :]
    if kind == 1:
        return lines[: i + 1] + lines[i:]
    if kind == 2:
        swapped = lines[:]
        swapped[i], swapped[j] = lines[j], lines[i]
        return swapped
    if kind == 3:
        return [*lines[:-1], "none"]
    if kind == 4 and lines[-1] != "none":
        last = lines[-1].split()
        return [*lines[:-1], " ".join([*last[:-1], str(int(last[-1]) ^ 1)])]
    if kind == 5 and is_event:
        words = nudged(words, random)
    elif kind == 6 and is_event:
        words = without_an_item(words, random)
    elif len(words) > 1:
        words = another_number(words, random)
    return [*lines[:i], " ".join(words), *lines[i + 1 :]]


@pytest.mark.parametrize("family", [*FAMILIES, *POINTS])
def test_both_checkers_agree(in_cpp, family):
    random, wrong = Random(family), 0
    tilings = [*TILINGS, *(["incremental"] if family in POINTS else [])]
    for seed in (5, 6):
        scene = generate(family, seed)
        for tiling in tilings:
            _, file, proof = prove(scene, tiling=tiling)
            code, answer = in_cpp(file, proof)
            other = in_python(file, proof)[1]
            assert code == 0
            assert answer == other
            lines = proof.decode().splitlines()
            for _ in range(4):
                mutated = text(mutant(lines, random))
                codes = in_cpp(file, mutated, "--partial")[0], in_python(file, mutated)[0]
                assert codes[0] == codes[1], mutated.decode()
                assert codes[0] in (0, 1, 2)
                wrong += codes[0] != 0
    assert wrong > 4


PIECES = [
    *(b"- + = @ # none contact event face inside outer vertex edge 0 00 -0 1/2 2/02 1/0".split()),
    *(b"+1 1_0 1.0 0x1 1/-2 -1/2 999999999 1000000000 \xd9\xa3 1\xc2\xa02".split()),
    *(b" ", b"\t", b"\r", b"\n", b"\x0b", b"\x0c", b"\x1c", b"\xe2\x80\xa8", b"\xc2\x85", b"\0"),
    *(b"# \xed\xa0\x80", b"# \xe0\x80\x80", b"# \xf4\x90\x80\x80", b" # 1", b"\n# 1\n", b"\xff"),
]


def damaged(proof, random):
    """A proof of which a word or a byte is another one, missing, or there twice."""
    if random.random() < 0.3:
        i = random.randrange(len(proof))
        return proof[:i] + random.choice([b"", *PIECES, proof[i : i + 1] * 2]) + proof[i + 1 :]
    lines = proof.split(b"\n")
    i = random.randrange(len(lines))
    words = lines[i].split(b" ")
    k = random.randrange(len(words))
    words[k : k + 1] = random.choice([[], [words[k]] * 2, [random.choice(PIECES)]])
    lines[i] = b" ".join(words)
    return b"\n".join(lines)


def test_both_checkers_agree_on_what_is_malformed(in_cpp):
    random, codes = Random(9), []
    for family in ("stars", "turning", "deforming", "points_in_line", "flat"):
        _, file, proof = prove(generate(family, 3))
        for _ in range(120):
            wrong = damaged(proof, random)
            codes.append(in_cpp(file, wrong, "--partial")[0])
            assert codes[-1] == in_python(file, wrong)[0], wrong
    assert min(codes.count(code) for code in (0, 1, 2)) > 5


JUMPS = '{"pieces": [{"until": "1/2", "motion": {}}, {"motion": {"x": [1]}}]}'
WRONG_FROM_THE_START = [
    ('{"name": "a", "vertices": [[0, 0]]}, {"name": "a", "vertices": [[1, 1]]}', 2),
    ('{"name": "a", "vertices": [[0, 0], [1, 1], [2, 2]]}', 2),
    ('{"name": "a", "vertices": [[0, 0], [3, 3], [3, 0], [0, 1]]}', 2),
    (f'{{"name": "a", "vertices": [[0, 0]], "motion": {JUMPS}}}', 2),
]


@pytest.mark.parametrize("bodies, code", WRONG_FROM_THE_START)
def test_what_is_wrong_with_a_scene(in_cpp, bodies, code):
    scene = f'{{"exactpt": 1, "time": [0, 1], "bodies": [{bodies}]}}'.encode()
    lines = ["exactpt-proof 1", f"scene sha256 {hashlib.sha256(scene).hexdigest()}", "span 0 1"]
    for rest in (["none"], ["outer 0", "none"], ["outer 0 1 2", "face 0 2 1", "none"]):
        proof = text([*lines, *rest])
        assert in_cpp(scene, proof)[0] == in_python(scene, proof)[0] == code


def test_a_rational_time_has_its_name(in_cpp):
    body = '{"name": "%s", "vertices": [[%s, 0]], "motion": {"x": [0, %s]}}'
    bodies = ", ".join(body % row for row in (("p", 0, 1), ("q", 3, 0)))
    scene = f'{{"exactpt": 1, "time": [0, 9], "bodies": [{bodies}]}}'.encode()
    lines = ["exactpt-proof 1", f"scene sha256 {hashlib.sha256(scene).hexdigest()}"]
    lines += ["span 0 9", "outer 0 1"]
    for name, code in {"": 0, " @ 0 1": 0, " -3 1": 0, " 9 -6 1": 0, " 1 1": 1, " 0": 1}.items():
        proof = text([*lines, f"contact 3 3{name} vertex 0 vertex 1"])
        assert in_cpp(scene, proof)[0] == in_python(scene, proof)[0] == code, name


@pytest.mark.parametrize("name", names())
def test_proofs_of_a_kept_case_are_accepted(in_cpp, name):
    scene = kept(name).scene
    for tiling in tilings_of(scene):
        _, file, proof = prove(scene, tiling=tiling)
        code, answer = in_cpp(file, proof)
        assert (code, answer.split(": ")[0]) == (0, "accepted")


def test_the_number_of_processes_changes_no_answer(in_cpp):
    random = Random(3)
    for family in ("convex", "turning_stars", "ballistic_points"):
        _, file, proof = prove(generate(family, 7))
        lines = proof.decode().splitlines()
        for proof in (text(lines), *(text(mutant(lines, random)) for _ in range(12))):
            answers = {in_cpp(file, proof, "--jobs", str(jobs)) for jobs in (1, 2, 5)}
            assert len(answers) == 1


@pytest.fixture
def proved():
    _, file, proof = prove(generate("stars", 6))
    return file, proof


def test_truncated_files_are_no_proofs(in_cpp, proved):
    file, proof = proved
    for length in range(0, len(proof) - 1, 7):
        assert in_cpp(file, proof[:length])[0] == 2


def test_random_bytes_are_no_proofs(in_cpp, proved):
    file, proof = proved
    random = Random(8)
    for _ in range(60):
        length = random.randrange(200)
        assert in_cpp(file, random.randbytes(length))[0] == 2
        begin = proof[: proof.index(b"span")]
        assert in_cpp(file, begin + random.randbytes(length))[0] == 2
        i = random.randrange(len(proof))
        damaged = proof[:i] + random.randbytes(1) + proof[i + 1 :]
        assert in_cpp(file, damaged)[0] in (0, 1, 2)


SCENES = [
    b"",
    b"[]",
    b"{}",
    b"{" * 100_000,
    b"[" * 100_000 + b"]" * 100_000,
    b'{"exactpt": 1, "time": [0, 1], "bodies": [',
    b'{"exactpt": 2, "time": [0, 1], "bodies": []}',
    b'{"exactpt": 1.0, "time": [0, 1], "bodies": []}',
    b'{"exactpt": 1, "time": [1, 1], "bodies": []}',
    b'{"exactpt": 1, "time": [0, NaN], "bodies": []}',
    b'{"exactpt": 1, "time": [0, 01], "bodies": []}',
    b'{"exactpt": 1, "time": [0, 1e200000], "bodies": []}',
    b'{"exactpt": 1, "time": [0, 1], "bodies": [], "bodies": []}',
    b'{"exactpt": 1, "time": [0, 1], "bodies": [{"name": "a", "vertices": []}]}',
    b'{"exactpt": 1, "time": [0, 1], "bodies": [{"name": "a", "vertices": [["1/0", 1]]}]}',
    b'{"exactpt": 1, "time": [0, 1], "bodies": [{"name": "a", "keyframes": []}]}',
    b'{"exactpt": 1, "time": [0, 1], "bodies": [{"name": "a", "vertices": [[0, 0]], "radius": 1}]}',
    b'{"exactpt": 1, "time": [0, 1], "bodies": [{"name": "\xff", "vertices": [[0, 0]]}]}',
]


@pytest.mark.parametrize("scene", SCENES, ids=range(len(SCENES)))
def test_what_is_no_scene(in_cpp, scene):
    lines = ["exactpt-proof 1", f"scene sha256 {hashlib.sha256(scene).hexdigest()}", "span 0 1"]
    code, answer = in_cpp(scene, text([*lines, "none"]))
    assert (code, answer.split(":")[0]) == (2, "no proof")


def test_numbers_of_scenes_are_exact(in_cpp):
    scene = (
        b'{"exactpt": 1, "time": [-1e0, 2.5e0], "bodies": ['
        b'{"name": "a", "vertices": [[0.1, "1/3"]], "motion": {"x": [0, 1]}},'
        b'{"name": "b", "vertices": [["+1.1", "333333e-6"]], "motion": {"y": ["1/3000000"]}}]}'
    )
    lines = ["exactpt-proof 1", f"scene sha256 {hashlib.sha256(scene).hexdigest()}"]
    lines += ["span -1 5/2", "outer 0 1", "contact 1 1 vertex 0 vertex 1"]
    answer = f"accepted: {hashlib.sha256(scene).hexdigest()[:16]} first contact at T = 1: "
    answer += "incidences exactly b0.0 at b1.0 (b0 is 'a', b1 is 'b')"
    assert in_cpp(scene, text(lines)) == (0, answer)
    assert in_python(scene, text(lines)) == (0, answer)


FAST = b"""{"exactpt": 1, "time": [0, 1], "bodies": [
    {"name": "a", "vertices": [[-1, 5], [-1, -5]], "motion": {"x": [0, -1152921504606846976]}},
    {"name": "b", "vertices": [[0, -1], ["1e19", -1], ["1e19", 1], [0, 1]]}]}"""


@pytest.mark.parametrize("claim", ["vertex 0 inside 1", "edge 0 1 edge 2 3", "vertex 0 edge 2 3"])
def test_a_false_contact_at_the_start_whose_time_is_a_root(in_cpp, claim):
    """The body is far to the right of the start at every time of the interval but the root."""
    hashed = f"scene sha256 {hashlib.sha256(FAST).hexdigest()}"
    proof = text(["exactpt-proof 1", hashed, "span 0 1", f"contact -1 2 0 1 {claim}"])
    assert in_cpp(FAST, proof)[0] == in_python(FAST, proof)[0] == 1


def test_a_motion_of_no_pieces(in_cpp):
    for motion in (b'{"pieces": []}', b'{"pieces": [], "spin": 1}'):
        scene = b'{"exactpt": 1, "time": [0, 1], "bodies": [{"name": "a", "vertices": [[0, 0]], '
        scene += b'"motion": ' + motion + b"}]}"
        hashed = f"scene sha256 {hashlib.sha256(scene).hexdigest()}"
        proof = text(["exactpt-proof 1", hashed, "span 0 1", "outer 0", "none"])
        assert in_cpp(scene, proof)[0] == in_python(scene, proof)[0] == 2


def test_a_proof_of_less_than_the_span(in_cpp, proved):
    scene = b'{"exactpt": 1, "time": [0, 9], "bodies": [{"name": "a", "vertices": [[0, 0]]}]}'
    hashed = f"scene sha256 {hashlib.sha256(scene).hexdigest()}"
    proof = text(["exactpt-proof 1", hashed, "span 0 7/2", "outer 0", "none"])
    assert in_cpp(scene, proof) == (1, "rejected: proved up to 7/2 only (see --until, --partial)")
    said = "no contact in [0, 7/2]; the span of the scene is [0, 9]: nothing is said of (7/2, 9]"
    accepted = (0, f"accepted: {hashlib.sha256(scene).hexdigest()[:16]} {said}")
    assert in_cpp(scene, proof, "--partial") == accepted
    assert in_cpp(scene, proof, "--until", "7/2") == accepted
    assert in_cpp(scene, proof, "--until", "4")[0] == 1
    found = proof_check.check(scene, proof)
    assert (found.until, found.whole) == (3.5, False)
    assert proof_check.check(*proved).whole


def test_calls(program, proved, tmp_path):
    file, proof = proved
    (tmp_path / "s").write_bytes(file)
    (tmp_path / "p").write_bytes(proof)
    for words in (
        ["proof"],
        ["proof", "s"],
        ["proof", "s", "p", "p"],
        ["proof", "s", "none"],
        ["proof", ".", "p"],
        ["proof", "s", "p", "--jobs"],
        ["proof", "s", "p", "--jobs", "0"],
        ["proof", "s", "p", "--until", "x"],
        ["proof", "s", "p", "--until", "1", "--partial"],
        ["proof", "p", "s"],
        ["prove", "s", "p"],
    ):
        done = subprocess.run([program, *words], capture_output=True, cwd=tmp_path, check=False)
        assert (done.returncode, done.stdout.count(b"\n")) == (2, 1), words


def test_many_proofs_in_one_process(program, proved, tmp_path):
    file, proof = proved
    wrong = proof.replace(b"span 0", b"span 1")
    contents = {"scene": file, "right": proof, "wrong": wrong, "none": b"no proof"}
    for name, content in contents.items():
        (tmp_path / name).write_bytes(content)
    calls = "".join(f"scene\n{name}\n" for name in ("right", "wrong", "none", "missing", "right"))
    done = subprocess.run(
        [program, "proofs"], input=calls.encode(), capture_output=True, cwd=tmp_path, check=True
    )
    said = [line.split(": ")[0] for line in done.stdout.decode().splitlines()]
    assert said == ["accepted", "rejected", "no proof", "no proof", "accepted"]


def test_client(program, proved, tmp_path):
    scene, path = tmp_path / "scene.json", tmp_path / "proof"
    scene.write_bytes(proved[0])
    path.write_bytes(proved[1])
    verdict = check_proof(scene, path, program=program, jobs=2)
    assert verdict == (True, in_python(*proved)[1])
    lines = proved[1].decode().splitlines()
    path.write_bytes(text([*lines[:-1], "none"]))
    verdict = check_proof(str(scene), str(path), program=program)
    assert not verdict.accepted
    assert verdict.line.startswith("rejected: line ")
    with pytest.raises(BudgetExceeded):
        check_proof(scene, path, program=program, max_seconds=0.0)
    path.write_bytes(b"no proof\n")
    with pytest.raises(InputError, match="the file is no proof"):
        check_proof(scene, path, program=program)
    with pytest.raises(InputError, match="cannot start"):
        check_proof(scene, path, program=tmp_path / "none")
    with pytest.raises(InputError, match="is not cgal_check"):
        check_proof(scene, path, program="/bin/false")


def test_a_check_verifies_the_proof_first(program, monkeypatch):
    monkeypatch.setenv("EXACTPT_CGAL_CHECK", str(program))
    scene = generate("convex", 3)
    report = check_scene(scene)
    assert report.proof
    assert report.to_json()["proof"] is True
    assert report.lines()[0].startswith("CGAL agrees: the proof is accepted; ")
    monkeypatch.setattr("exactpt.proof.lines.Lines.is_body_edge", lambda *_: True)
    monkeypatch.setattr("exactpt.proof.lines.change", lambda *_: ["- 0 1"])
    report = check_scene(scene)
    assert report.proof is False
    assert not report.ok
    assert report.failures[0].startswith("proof rejected: line ")
    assert "the proof is REJECTED" in report.lines()[0]
