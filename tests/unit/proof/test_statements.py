"""What both checkers say: all incidences at T, and whether an answer is the one that is proved."""

import hashlib
import json
import subprocess
import sys
from fractions import Fraction

import pytest
from click.testing import CliRunner

from exactpt import (
    Body,
    Rigid,
    Scene,
    Translation,
    check_apart,
    first_contact,
    proof_check,
    proof_scene,
    prove,
)
from exactpt.cli import cli
from exactpt.proof.handout import checker_file
from exactpt.testing.scenes import FAMILIES, POINTS, RINGS, generate

pytestmark = pytest.mark.cgal


def incidences(scene, contact):
    """The numbers of vertices, and of the first vertices of edges, as `Proved` has them."""
    first, found = {}, set()
    for body in scene.bodies:
        first[body.name] = sum(b.size for b in scene.bodies[: len(first)])
    for p in contact.pairs:
        v = first[p.body] + p.vertex
        if p.edge is not None:
            found.add((v, 1, first[p.other] + p.edge))
        else:
            w = first[p.other] + p.other_vertex
            found.add((min(v, w), 0, max(v, w)))
    return found


@pytest.mark.parametrize("family", [*FAMILIES, *POINTS, *RINGS])
def test_all_incidences_are_proved(family, program, tmp_path):
    for seed in (11, 12):
        scene = generate(family, seed)
        if sum(body.size for body in scene.bodies) > 90:
            continue
        proved = prove(scene, tiling="lazy")
        proved.save(tmp_path / "p")
        found = proof_check.check(proved.scene, proved.text)
        command = [program, "proof", tmp_path / "p.scene.json", tmp_path / "p"]
        done = subprocess.run(command, capture_output=True, check=False, text=True)
        assert (done.returncode, done.stdout) == (0, found + "\n")
        if proved.contact is not None and proved.contact.kind != "initial":
            expected = first_contact(scene, method="pairs")
            assert found.incidences == incidences(scene, expected), seed


@pytest.fixture
def answered(tmp_path, program, capsys):
    """Runs both checkers with ``--expect`` on a proof; returns the exit code."""
    scene = generate("stars", 6)
    scene.save(tmp_path / "s.json")
    paths = [str(tmp_path / "s.json"), str(tmp_path / "p")]
    words = ["collide", paths[0], "--proof", paths[1], "--json"]
    answer = json.loads(CliRunner().invoke(cli, words, catch_exceptions=False).stdout)

    def run(change):
        data = json.loads(json.dumps(answer))
        change(data)
        file = tmp_path / "answer.json"
        file.write_text(data if isinstance(data, str) else json.dumps(data))
        call = [*paths, "--expect", str(file)]
        code = subprocess.run([program, "proof", *call], capture_output=True, check=False)
        assert proof_check.main(call) == code.returncode, (code.stdout, capsys.readouterr())
        return code.returncode

    return run


def test_an_answer_is_compared(answered):
    def at(**new):
        return lambda data: data["contact"]["time"].update(new)

    def pairs(change):
        return lambda data: change(data["contact"]["pairs"])

    assert answered(dict) == 0
    assert answered(lambda data: data.update(contact=None)) == 1
    assert answered(at(low="1", high="1", polynomial=["-1", "1"])) == 1
    assert answered(at(polynomial=["0", "-249", "155"], low="1", high="2")) == 0
    assert answered(lambda data: data["contact"].update(kind="initial")) == 1
    assert answered(pairs(lambda rows: rows.clear())) == 1
    assert answered(pairs(lambda rows: rows.append(rows[0]))) == 0
    assert answered(pairs(lambda rows: rows[0]["b"].update(edge=0))) == 1
    assert answered(pairs(lambda rows: rows[0]["b"].update(body="nobody"))) == 2
    assert answered(pairs(lambda rows: rows[0]["b"].update(edge=99))) == 2
    assert answered(at(polynomial=[])) == 2
    assert answered(at(polynomial=["x"])) == 2
    assert answered(lambda data: data.pop("contact")) == 2


def test_bug_an_answer_is_read_strictly(answered):
    """Without "kind" the checker in Python ended with a traceback; it took -1 for the last vertex,
    "0" for 0 and 5/2 for 2, and the one in C++ an edge for a vertex."""

    def in_first(side, **new):
        return lambda data: data["contact"]["pairs"][0][side].update(new)

    def in_time(**new):
        return lambda data: data["contact"]["time"].update(new)

    assert answered(lambda data: data["contact"].pop("kind")) == 2
    assert answered(lambda data: data["contact"].update(pairs={})) == 2
    for vertex in (-1, "0", 0.0, True, None, [0], "0_0"):
        assert answered(in_first("a", vertex=vertex)) == 2, vertex
    assert answered(lambda data: data["contact"]["pairs"][0]["a"].pop("vertex")) == 2
    for polynomial in (["-249/1", "155"], ["-249.5", "155"], ["+249", "155"], "1", [[1]]):
        assert answered(in_time(polynomial=polynomial)) == 2, polynomial
    assert answered(in_time(low=[1])) == 2
    assert answered(in_first("a", body=5)) == 2


def test_bug_an_answer_is_json_as_a_scene_is(program, tmp_path, capsys):
    proved = prove(Scene([Body("a", [(0, 0)])], (0, 10)))
    proved.save(tmp_path / "p")
    answer = tmp_path / "answer.json"
    call = [str(tmp_path / "p.scene.json"), str(tmp_path / "p"), "--expect", str(answer)]
    right = b'{"contact": null, "until": "10"}'
    wrong = [right.replace(b"}", b', "x": %s}' % x) for x in (b"NaN", b"[" * 32 + b"]" * 32)]
    wrong += [right.replace(b"}", b', "until": "10"}'), right.replace(b"}", b', "x": "\\ud800"}')]
    wrong += [right.decode().encode("utf-16"), b""]
    deep = right.replace(b"}", b', "x": %s}' % (b"[" * 31 + b"]" * 31))
    for content, code in ((right, 0), (deep, 0), *((content, 2) for content in wrong)):
        answer.write_bytes(content)
        done = subprocess.run([program, "proof", *call], capture_output=True, check=False)
        assert proof_check.main(call) == done.returncode == code, capsys.readouterr()


def test_bug_an_answer_that_is_missing_is_bad_input_of_a_wrong_proof_too(program, tmp_path):
    scene = Scene([Body("a", [(0, 0)]), Body("b", [(1, 0)])], (0, 10))
    lines = ["proof", "span 0 10", "outer 0 1", "contact 1 1 vertex 0 vertex 1"]
    missing = str(tmp_path / "answer.json")
    assert run_both(program, tmp_path, scene, lines, "--expect", missing) == (2, 2)


def test_bug_until_has_the_bounds_of_a_number_in_a_proof(program, tmp_path):
    """With more than 4,300 digits the checker in Python refused it, the one in C++ any number."""
    scene = Scene([Body("a", [(0, 0)])], (0, 10))
    lines = ["proof", f"span 0 {'9' * 5000}/{'9' * 4999}1", "outer 0", "none"]
    for until, code in ((f"1/{'1' * 5000}", 0), (f"1/{'1' * 10001}", 2), ("0" * 10001, 2)):
        in_cpp = run_both(program, tmp_path, scene, lines, "--until", until)[1]
        file = tmp_path / "check.py"
        file.write_bytes(checker_file("proof_check"))
        call = [sys.executable, "-I", file, tmp_path / "s.json", tmp_path / "p", "--until", until]
        in_python = subprocess.run(call, capture_output=True, check=False).returncode
        assert (in_python, in_cpp) == (code, code), until


def test_a_budget_of_work(program, tmp_path, capsys):
    proved = prove(generate("stars", 6))
    proved.save(tmp_path / "p")
    call = [str(tmp_path / "p.scene.json"), str(tmp_path / "p"), "--work"]
    for work, code in (("10", 4), ("99999999999", 0), ("-1", 2), ("x", 2)):
        done = subprocess.run([program, "proof", *call, work], capture_output=True, check=False)
        assert done.returncode == proof_check.main([*call, work]) == code, capsys.readouterr()
    with pytest.raises(proof_scene.Exhausted):
        proof_check.check(proved.scene, proved.text, 10)


def test_bug_isolating_roots_is_counted_as_work(program, tmp_path):
    """(a t - 1)^2 + t^40, a = 2^60 + 1, has two roots 10^-379 from the real axis."""
    a = 2**60 + 1
    y = [1, -2 * a, a * a, *[0] * 37, 1]
    bodies = [Body("a", [(0, 0)]), Body("b", [(1, 0)]), Body("c", [([], y)])]
    scene, proof = tmp_path / "s.json", tmp_path / "p"
    Scene(bodies, (0, "1/2")).save(scene)
    digest = hashlib.sha256(scene.read_bytes()).hexdigest()
    lines = ["span 0 1/2", "face 0 1 2", "outer 0 2 1", "none"]
    proof.write_text("\n".join(["exactpt-proof 1", f"scene sha256 {digest}", *lines]) + "\n")
    call = [str(scene), str(proof), "--work", "3000000"]
    done = subprocess.run([program, "proof", *call], capture_output=True, check=False)
    assert (proof_check.main(call), done.returncode) == (4, 4)


def run_both(program, folder, scene, lines, *options):
    """The exit codes of both checkers on a proof, or a certificate, of a scene."""
    scene.save(folder / "s.json")
    digest = hashlib.sha256((folder / "s.json").read_bytes()).hexdigest()
    head = [f"exactpt-{lines[0]} 1", f"scene sha256 {digest}"]
    (folder / "p").write_text("\n".join([*head, *lines[1:]]) + "\n")
    call = [str(folder / "s.json"), str(folder / "p"), *options]
    checker = check_apart if lines[0] == "apart" else proof_check
    done = subprocess.run([program, "proof", *call], capture_output=True, check=False)
    return checker.main(call), done.returncode


def test_bug_a_root_that_is_there_twice_takes_little_work(program, tmp_path):
    """Both times were halved 2,048 times; now a common divisor tells that they are one."""
    scene = Scene([Body("a", [(0, 0)]), Body("b", [(1, 0)])], (0, 10))
    event = f"event 1 2 -2 {'0 ' * 95}1"
    lines = ["proof", "span 0 10", "outer 0 1", event, event, "none"]
    assert run_both(program, tmp_path, scene, lines, "--work", "30000000") == (1, 1)


def test_bug_long_times_and_high_degrees_are_counted(program, tmp_path):
    """C++ took a minute: numbers of 9,000 digits counted as if they were one word each."""
    body = Body("a", [([0, *[1] * 64], [0, *[3] * 64])])
    scene = Scene([body, Body("b", [(1, 0)]), Body("c", [(0, 1)])], (0, 1))
    lines = ["apart", "span 0 1", f"t 1{'0' * 8999}7/1{'0' * 9000}9", "c 1 0 5", "c 1 0 5", "none"]
    assert run_both(program, tmp_path, scene, lines) == (4, 4)


def test_bug_values_at_long_times_are_counted(program, tmp_path):
    """The scene begins at a long time: with 9,000 digits, its reader in C++ took 19 s."""
    start, end = Fraction(10**4199 + 7, 10**4200 + 9), 1
    bodies = [
        Body("a", [(0, 0), (1, 0), (0, 1)], Rigid([1, *[0] * 31, 10**4199])),
        Body("b", [(9, 0), (10, 0), (9, 1)]),
    ]
    lines = ["apart", f"span {start} 1", "c 1 0 5", "none"]
    assert run_both(program, tmp_path, Scene(bodies, (start, end)), lines) == (4, 4)


def test_bug_places_of_long_numbers_are_counted():
    """Many small vertices with one long translation: whether edges meet took minutes in Python."""
    long = Fraction(3**9000, 7**5000)
    for closed in (True, False):
        body = Body("a", [(k, k * k) for k in range(60)], Translation([long]), closed=closed)
        scene = json.dumps(Scene([body], (0, 1)).to_json())
        with proof_scene.budget(20_000_000), pytest.raises(proof_scene.Exhausted):
            proof_scene.Scene(scene)


def test_bug_short_products_of_long_numbers_are_counted():
    track = tuple(proof_scene.Poly([n]) for n in (3**9000, 5**9000, 1))
    other = tuple(proof_scene.Poly([n]) for n in (7**9000, 2**9000, 1))
    with proof_scene.budget(1_000_000), pytest.raises(proof_scene.Exhausted):
        proof_scene.orientation_of(track, other, track)


def test_bug_a_long_rate_of_a_spin_is_counted():
    """2,000 such pieces took 16 seconds before the budget was used up."""
    turn = proof_scene.Motion({"rigid": {"half_turn": []}}, 0)
    ends = [Fraction(k) for k in range(100)]
    spin = proof_scene.SpinRecord(omega=Fraction(1, 3**20000), error=Fraction(1, 3))
    with proof_scene.budget(100_000_000), pytest.raises(proof_scene.Exhausted):
        proof_scene.turns_by(ends, [turn] * 101, spin)


def test_bug_frames_that_are_translated_need_no_tracks_of_all_vertices(monkeypatch):
    """2,000 frames of 100 vertices took 10 seconds: each vertex had a polynomial in each frame."""
    frames = [
        {"t": str(t), "vertices": [[str(x + t * t), str(x * x)] for x in range(20)]}
        for t in range(50)
    ]
    text = json.dumps({
        "exactpt": 1, "time": ["0", "49"],
        "bodies": [{"name": "a", "closed": False, "keyframes": frames}],
    })  # fmt: skip
    scene, made = proof_scene.Scene(text), []
    cleared = proof_scene.cleared
    monkeypatch.setattr(proof_scene, "cleared", lambda *f: made.append(f) or cleared(*f))

    assert scene.is_rigid(scene.bodies[0], Fraction(49))
    assert not made


@pytest.mark.parametrize("last, is_rigid", [("3", False), ("2", True)])
def test_frames_that_change_a_length_are_not_rigid(last, is_rigid):
    corners = [[["0", "0"], ["2", "0"], ["0", "2"]], [["1", "0"], ["3", "0"], ["1", last]]]
    frames = [{"t": str(t), "vertices": v} for t, v in enumerate(corners)]
    scene = proof_scene.Scene(json.dumps(
        {"exactpt": 1, "time": ["0", "1"], "bodies": [{"name": "a", "keyframes": frames}]}
    ))  # fmt: skip

    assert scene.is_rigid(scene.bodies[0], Fraction(1)) == is_rigid


def test_bug_pieces_of_many_vertices_are_counted(program, tmp_path):
    """Each piece of a motion has a track of each vertex."""
    polygon = [[k, k * k] for k in range(1500)]
    pieces = [*({"until": k, "motion": {}} for k in range(1500)), {"motion": {}}]
    body = {"name": "a", "vertices": polygon, "motion": {"pieces": pieces}}
    scene = tmp_path / "s.json"
    scene.write_text(json.dumps({"exactpt": 1, "time": [0, 1], "bodies": [body]}))
    digest = hashlib.sha256(scene.read_bytes()).hexdigest()
    lines = ["exactpt-proof 1", f"scene sha256 {digest}", "span 0 1", "outer 0", "none", ""]
    (tmp_path / "p").write_text("\n".join(lines))
    done = subprocess.run(
        [program, "proof", scene, tmp_path / "p"], capture_output=True, check=False
    )
    assert done.returncode == 4
