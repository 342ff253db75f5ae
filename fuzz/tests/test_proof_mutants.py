"""Wrong proofs are rejected, or true; both checkers say the same about damaged ones."""

import hashlib
import json
import re
from random import Random

import pytest
from click.testing import CliRunner

import exactpt
from exactpt import AuditError, Scene, check_apart, proof_check, proof_scene, prove
from exactpt.testing.scenes import EVERY, generate
from fuzz.campaign import Item, Progress, campaign
from fuzz.limits import TooSlow
from fuzz.proofs import apart, both, checking
from fuzz.proofs import run as mutants_run
from fuzz.proofs.checking import checker, is_geometric
from fuzz.proofs.command import certificates, proof_both, proof_mutants
from fuzz.proofs.run import KINDS, Mutant, Mutants, is_true, mutants
from fuzz.small_scope.look import looks_at_proofs
from fuzz.small_scope.scope import planned
from fuzz.witnesses import Difference, check_proof

pytestmark = pytest.mark.cgal


@pytest.fixture(autouse=True)
def _program(program, monkeypatch):
    monkeypatch.setenv("EXACTPT_CGAL_CHECK", str(program))


def in_python(mutant):
    try:
        return proof_check.check(mutant.scene, mutant.proof)
    except (proof_scene.Rejected, proof_scene.NoProofError) as error:
        return str(error)


def test_each_kind_gets_past_the_map():
    past = set()
    for number in range(4):
        for mutant in mutants(number, set(KINDS)):
            answer = checker().verdict(mutant.scene, mutant.proof)
            is_accepted = answer.startswith("accepted: ")
            assert is_accepted == in_python(mutant).startswith("accepted: "), mutant
            assert not is_accepted or is_true(mutant, answer)
            if is_geometric(answer):
                past.add(mutant.kind)
    assert past == set(KINDS)


def test_the_same_mutants_again():
    assert list(mutants(3, set(KINDS))) == list(mutants(3, set(KINDS)))


def test_a_campaign_that_is_resumed(tmp_path):
    state, keep = tmp_path / "state.json", tmp_path / "found"
    words = ["--cases", "33", "--past", "1", "--keep", str(keep), "--state", str(state)]
    words += ["--jobs", "0"]
    done = CliRunner().invoke(proof_mutants, [*words, "--seconds", "0"])
    assert (done.exit_code, json.loads(state.read_text())["next"]) == (0, 0)
    done = CliRunner().invoke(proof_mutants, words)
    assert done.output.endswith(": 0 differences\n")
    counts = Progress.load(state, Mutants(3, 1, keep)).counts
    assert all(counts[kind, "mutants"] >= 3 and counts[kind, "past"] >= 1 for kind in KINDS)
    again = CliRunner().invoke(proof_mutants, words).output
    assert again.splitlines()[1:-1] == done.output.splitlines()[1:-1]
    state.write_text("{}")
    assert CliRunner().invoke(proof_mutants, words).exit_code == 2


def test_what_is_accepted_and_wrong_is_found(tmp_path, monkeypatch):
    class Blind:
        def verdict(self, *_):
            return "accepted: 0123456789abcdef no contact in [0, 1], the whole span"

    monkeypatch.setattr(mutants_run, "checker", Blind)
    found = []
    progress = Progress()
    campaign(Mutants(3, 1, tmp_path), progress, found.append, seconds=5.0)
    assert len(found) == progress.found > 0
    assert all(
        [path.name.split(".", 2)[2] for path in finding.files] == ["scene.json", "proof"]
        for finding in found
    )


def test_the_checker_is_started_again():
    answers = []
    for _ in range(2):
        answers.append(checker().verdict(b"{}", b"no proof"))
        checker().close()
    assert answers[0] == answers[1]
    assert answers[0].startswith("no proof: ")


def test_proofs_of_the_small_scope():
    for look in looks_at_proofs([planned(number) for number in range(0, 96, 32)]):
        (answer,) = look.answers
        assert answer.method.startswith("proof ")
        assert answer.fault is None


def test_a_wrong_proof_is_a_difference(monkeypatch):
    from exactpt.proof.lines import Lines

    monkeypatch.setattr(Lines, "none", lambda *_: iter(["none"]))
    monkeypatch.setattr(Lines, "contact", lambda *_: iter(["none"]))
    with pytest.raises(Difference, match="proof"):
        check_proof(generate("stars", 6), "lazy", in_python=False)


def test_states_of_both_kinds_of_runs(tmp_path):
    from fuzz.small_scope.command import small_scope

    state = str(tmp_path / "state.json")
    words = ["--count", "3", "--start", "0", "--state", state, "--proofs", "--jobs", "0"]
    done = CliRunner().invoke(small_scope, words)
    assert done.exit_code == 0
    assert "proof " in done.output
    wrong = CliRunner().invoke(small_scope, ["--count", "1", "--state", state])
    assert wrong.exit_code == 2
    assert "with --proofs" in wrong.output


def test_a_body_that_is_not_simple_is_refused():
    crossed = [[0, 0], [3, 3], [3, 0], [0, 1]]
    bodies = [{"name": "c", "closed": False, "vertices": crossed}]
    bodies.append({"name": "p", "vertices": [[0, 0]]})
    scene = json.dumps({"exactpt": 1, "time": [0, 1], "bodies": bodies}).encode()
    head = f"exactpt-proof 1\nscene sha256 {hashlib.sha256(scene).hexdigest()}\nspan 0 1\n"
    at_start = Mutant("", scene, f"{head}contact 0 0 vertex 0 vertex 4\n".encode())
    answer = checker().verdict(scene, at_start.proof)
    assert answer == "no proof: the body c is not simple at the start"
    assert not is_true(at_start, "accepted: 0 contact at the start t = 0: b0.0 at b1.0")


def test_bug_a_checker_that_was_killed_between_two_proofs():
    proof = prove(generate("convex", 1))
    running = checker()
    running.verdict(proof.scene, proof.text)
    running._process.kill()
    running._process.wait()

    assert running.verdict(proof.scene, proof.text).startswith("accepted: ")


def test_a_checker_that_does_not_answer_is_ended(monkeypatch, tmp_path):
    silent = tmp_path / "silent"
    silent.write_text("#!/bin/sh\nexec sleep 60\n")
    silent.chmod(0o755)
    monkeypatch.setattr(checking, "find_program", lambda: silent)
    monkeypatch.setattr(checking, "PATIENCE", 0.1)
    running = checking.Checker()

    with pytest.raises(AuditError, match=r"no answer in 0\.1 seconds"):
        running.verdict(b"", b"")

    assert running._process is None
    running._folder.cleanup()


def test_both_checkers_agree_on_what_is_damaged(program, monkeypatch, tmp_path):
    monkeypatch.setenv("EXACTPT_CGAL_CHECK", str(program))
    words = ["--cases", "60", "--seed", "7", "--keep", str(tmp_path / "found"), "--jobs", "0"]
    done = CliRunner().invoke(proof_both, words, catch_exceptions=False)
    assert done.exit_code == 0, done.output
    assert done.output.endswith(": 0 differences\n")
    assert sum(int(n) for n in re.findall(r": (\d+) proofs", done.output)) == 60
    assert not (tmp_path / "found").exists()


def test_another_statement_is_a_disagreement(program, monkeypatch, tmp_path):
    monkeypatch.setenv("EXACTPT_CGAL_CHECK", str(program))
    verdicts = [
        ((0, "accepted: 1"), (0, "accepted: 2")),
        ((1, "a"), (2, "b")),
        ((1, "a"), (1, "b")),
    ]
    found = iter(verdicts)
    monkeypatch.setattr(both, "verdicts", lambda *_: next(found))
    words = ["--cases", "3", "--keep", str(tmp_path / "found"), "--jobs", "0"]
    done = CliRunner().invoke(proof_both, words)
    assert done.exit_code == 1
    assert ": 2 differences" in done.output
    assert len(list((tmp_path / "found").iterdir())) == 4


def test_damages_are_of_every_class():
    pairs = [pair for number in range(200) if (pair := both.damaged(3, number))]
    assert len(pairs) > 40
    codes = [both.verdicts(*pair)[0][0] for pair in pairs[:40]]
    assert {0, 1, 2} <= set(codes)


def test_bug_a_line_that_a_damage_had_emptied_ended_the_campaign():
    random = Random(0)
    for _ in range(400):  # every damage of a line without words
        assert both._lines(["exactpt-proof 1", "scene", "span 0 1", "", ""], random)


# The campaign of certificates: right ones are accepted, wrong ones rejected, or true


def run(folder, count, start=0):
    words = ["--cases", count, "--start", start, "--jobs", 0, "--keep", folder / "found"]
    return CliRunner().invoke(certificates, list(map(str, words)))


def test_a_few_families(tmp_path):
    done = run(tmp_path, 3, start=4)
    assert done.exit_code == 0, done.output
    assert "a node left out: " in done.output
    assert "3 cases in" in done.output


@pytest.mark.parametrize("check", ["check_apart", "check_outside"])
def test_a_checker_without_a_check_is_found(tmp_path, monkeypatch, check):
    monkeypatch.setattr(check_apart.Checker, check, lambda _: None)
    numbers = {"check_apart": 4, "check_outside": 8}
    if check == "check_outside":  # a point inside a body from the start on
        inner = exactpt.Body("b", [(1, 1)])
        scene = exactpt.Scene([exactpt.Body("a", [(0, 0), (3, 0), (0, 3)]), inner], time=(0, 1))
        monkeypatch.setattr(apart, "generate", lambda *_: scene)
        monkeypatch.setattr(apart, "first_contact", lambda *_, **__: None)
    done = run(tmp_path, 1, start=numbers[check])
    assert done.exit_code == 1, done.output
    assert list((tmp_path / "found").iterdir())


@pytest.mark.parametrize("slow, rows", [("generate", []), ("is_true", ["convoy"])])
def test_bug_a_slow_reference_ended_the_worker_of_a_campaign(slow, rows, tmp_path, monkeypatch):
    """Only a certificate that does not come is a finding."""

    def take_too_long(*_):
        raise TooSlow

    monkeypatch.setattr(apart, slow, take_too_long)
    number = sorted(EVERY).index("convoy")
    item = Item(range(number, number + 1))

    result = apart.Apart(0, tmp_path).run(item, lambda _: None, None)

    assert [name for name, column in result.counts if column == "not compared to the end"] == rows
    assert [finding.signature for finding in result.findings] == ["hangs"] * (not rows)


def test_truth_by_all_pairs():
    box = [(0, 0), (1, 0), (1, 1), (0, 1)]
    fast = exactpt.Body("b", [(x + 5, y) for x, y in box], exactpt.Translation([0, -1]))
    scene = exactpt.Scene([exactpt.Body("a", box), fast], time=(0, 8))
    made = Scene.from_json(json.loads(exactpt.certify(scene).scene))
    lines = ["exactpt-apart 1", "scene sha256 0", "span 0 3"]
    assert apart.is_true(made, [*lines, "none"])
    assert apart.is_true(made, [*lines, "distance 1/2", "none"])
    assert not apart.is_true(made, [*lines, "distance 2", "none"])
    assert apart.is_true(made, [*lines, "meet 4 0 0"])
    assert not apart.is_true(made, [*lines, "meet 7/2 0 0"])
    assert not apart.is_true(made, [*lines[:2], "span 0 5", "none"])
    assert apart.is_true(made, [*lines[:2], "span 0 5", "between 0 0", "none"])
    assert apart.is_true(made, [*lines[:2], "span 0 5", "ignoring 0 1", "none"])
