"""questions, oracle and judge: deterministic, in order, at once, and strict about their input."""

import json
import os
import subprocess
import sys
from pathlib import Path

import pytest
from commands import code_of, run
from folding import every

from exactpt import first_contact
from exactpt.testing import FAMILIES, make_question
from exactpt.testing.oracle import Refusals, answers

ROOT = Path(__file__).parents[3]
STILL = {"vertices": [[0, 0]]}


def asking():
    environment = os.environ | {"PYTHONPATH": str(ROOT)}
    return subprocess.Popen(
        [sys.executable, "-m", "exactpt", "oracle"], stdin=subprocess.PIPE,
        stdout=subprocess.PIPE, stderr=subprocess.PIPE, env=environment,
    )  # fmt: skip


def answered(*lines):
    refusals = Refusals()
    encoded = [line if isinstance(line, bytes) else json.dumps(line).encode() for line in lines]
    return [json.loads(line) for line in answers(encoded, 1, refusals)], refusals


def test_questions_are_dealt_from_all_families(tmp_path):
    printed = run("questions", "all", "-n", 2, "--seed", 7).stdout.splitlines()
    run("questions", "all", "-n", 2, "--seed", 7, "-o", tmp_path / "q.jsonl")

    assert (tmp_path / "q.jsonl").read_text().splitlines() == printed
    assert [json.loads(line)["id"] for line in printed] == [
        f"{family}:7:{number}" for number in range(2) for family in FAMILIES
    ]
    assert json.loads(printed[0]) == make_question("corner_to_corner", 7, 0).to_json()


def test_the_oracle_answers_in_order_and_the_judge_agrees(tmp_path):
    run("questions", "all", "-n", 3, "-o", tmp_path / "q.jsonl")
    asked = (tmp_path / "q.jsonl").read_bytes().splitlines()

    said, refusals = answered(*asked)
    lines = "\n".join(map(json.dumps, said))
    (tmp_path / "a.jsonl").write_text(lines)
    result = run("judge", tmp_path / "a.jsonl", "--questions", tmp_path / "q.jsonl", "--json")

    assert [a["id"] for a in said] == [json.loads(q)["id"] for q in asked]
    assert refusals.count == 0
    assert json.loads(result.stdout)["total"]["right"] == 3 * len(FAMILIES)
    assert code_of("judge", tmp_path / "a.jsonl") == 0


@pytest.mark.long
def test_the_oracle_answers_a_single_line_at_once():
    """In lockstep through a pipe: the answer comes before the next question is asked."""
    with asking() as process:
        for number in range(3):
            question = make_question("sliding", 0, number)
            process.stdin.write(json.dumps(question.to_json()).encode() + b"\n")
            process.stdin.flush()
            answer = json.loads(process.stdout.readline())
            assert answer["id"] == question.name
            assert answer["time"] == first_contact(question.scene).time.to_json()
        process.stdin.close()
        assert process.wait() == 0


@pytest.mark.long
def test_the_oracle_reads_half_a_line_and_a_last_one_without_end():
    with asking() as process:
        text = json.dumps({"time": [0, 1], "a": STILL, "b": STILL}).encode()
        process.stdin.write(text[:20])
        process.stdin.flush()
        process.stdin.write(text[20:] + b"\n\n" + text)
        said, complaint = process.communicate()

    assert [json.loads(line)["id"] for line in said.splitlines()] == [1, 3]
    assert (process.returncode, complaint) == (0, b"")


def test_numbers_are_doubles_decimal_or_hexadecimal():
    fast = {"vertices": [[0, 0]], "motion": {"x": [0, "0x1.999999999999ap-4"]}}
    slow = {"vertices": [[0, 0]], "motion": {"x": [0, 0.1]}}
    wall = {"vertices": [["0x1p+0", "-1"], [1, "1.0"]]}

    said, _ = answered(*({"time": [0, 20], "a": body, "b": wall} for body in (fast, slow)))

    assert said[0]["time"] == said[1]["time"]
    assert said[0]["time"]["low"] == "36028797018963968/3602879701896397"  # 1 / double(0.1)


def test_other_motions_are_answered_too():
    turning = {"vertices": [[2, 0]], "motion": {"rigid": {"half_turn": [0, 0.5]}}}
    wall = {"vertices": [[-1, 2], [1, 2]]}

    (said,), _ = answered({"time": [0, 9], "a": turning, "b": wall})

    assert said["time"]["approx"] == 2.0


def test_roots_of_quadratics_and_their_canonical_form():
    questions = [make_question(f, 3, n) for f in ("apex", "thrown_pairs") for n in range(8)]

    said, _ = answered(*(question.to_json() for question in questions))

    for question, answer in zip(questions, said, strict=True):
        contact = first_contact(question.scene)
        assert answer["time"] == (contact.time.to_json() if contact else None)


@every(
    "line, says",
    [
        (b"{", "not JSON: '{'"),
        (b"[1]", "not a JSON object"),
        (b'{"a": 1, "a": 2}', "a key is there twice"),
        ({"time": [0, 1], "a": STILL}, 'the key "b" is missing'),
        ({"time": [0, 1], "a": STILL, "b": STILL, "c": 1}, "unknown key 'c'"),
        ({"time": [0, 1], "a": STILL, "b": STILL, "id": []}, '"id": neither a text nor an integer'),
        ({"time": [1, 0], "a": STILL, "b": STILL}, "time"),
        ({"time": [0], "a": STILL, "b": STILL}, "not a start and an end"),
        ({"time": [0, 1], "a": STILL, "b": {"vertices": []}}, "at least one is needed"),
        ({"time": [0, 1], "a": STILL, "b": {"vertices": [[1]]}}, "a vertex has two coordinates"),
        ({"time": [0, 1], "a": STILL, "b": {"vertices": [[1, "x"]]}}, "not a finite double: 'x'"),
        ({"time": [0, 1], "a": STILL, "b": {"vertices": [[1, True]]}}, "not a finite double: True"),
        ({"time": [0, 1], "a": STILL, "b": {**STILL, "closed": 1}}, "not true or false: 1"),
        ({"time": [0, 1], "a": STILL, "b": {**STILL, "shape": 1}}, "shape"),
        ({"time": [0, 1], "a": STILL, "b": 3}, "not a body: 3"),
        (b'{"time": [0, 1e999], "a": 1, "b": 2}', "not a finite double: inf"),
        (b'{"time": [0, NaN], "a": 1, "b": 2}', "not a finite number: NaN"),
        (
            {"time": [0, 1], "a": STILL, "b": {"vertices": [[0, 0], [1, 1], [1, 0], [0, 1]]}},
            "simple",
        ),
    ],
)
def test_what_is_no_question_is_refused_and_the_others_are_answered(line, says):
    good = {"time": [0, 1], "a": STILL, "b": STILL}

    said, refusals = answered(good, line, good)

    assert [answer["id"] for answer in said] == [1, None, 3]
    assert said[1]["line"] == 2
    assert says in said[1]["error"]
    assert "time" in said[0]
    assert "time" in said[2]
    assert refusals.count == 1
    assert refusals.first.startswith("line 2: ")


def test_the_id_of_a_refused_line_is_its_own_or_null():
    """Bug: an unnamed bad line 2 and a question of the id 2 had one id."""
    good = {"id": 2, "time": [0, 1], "a": STILL, "b": STILL}

    said, _ = answered(good, b"{", {"id": "mine", "time": [0, 1]})

    assert [(answer["id"], answer.get("line")) for answer in said] == [
        (2, None), (None, 2), ("mine", None),
    ]  # fmt: skip


def test_the_oracle_ends_with_code_2_after_a_refusal(tmp_path, capsys):
    (tmp_path / "q.jsonl").write_text("nothing\n")

    assert code_of("oracle", str(tmp_path / "q.jsonl")) == 2

    out, err = capsys.readouterr()
    assert json.loads(out) == {"id": None, "line": 1, "error": "not JSON: 'nothing'"}
    assert err == "exactpt: 1 of 1 lines refused; line 1: not JSON: 'nothing'\n"


def test_the_judge_says_what_is_wrong(tmp_path, capsys):
    ids = [f"sliding:0:{n}" for n in range(4)]
    times = [first_contact(make_question("sliding", 0, n).scene).time.low for n in range(4)]
    said = [
        {"id": ids[0], "time": None},
        {"id": ids[1], "time": float(times[1]) + 1},
        {"id": ids[2], "time": (float(times[2]) - 1).hex()},
        {"id": ids[3], "error": "no"},
    ]
    (tmp_path / "a.jsonl").write_text("\n".join(map(json.dumps, said)))

    assert code_of("judge", tmp_path / "a.jsonl") == 1

    out, err = capsys.readouterr()
    assert out.splitlines()[1].split() == ["sliding", "0", "1", "0", "1", "1", "1"]
    assert err.splitlines()[0] == "sliding:0:0: missed"


@pytest.mark.parametrize(
    "text, says",
    [
        ('{"id": "circles:0:1", "time": 1}', "no question of a family: 'circles:0:1'"),
        ('{"id": "sliding:0:x", "time": 1}', "no question of a family: 'sliding:0:x'"),
        ('{"id": "sliding:0:1"}', 'line 1: the key "time" is missing'),
        ('{"time": 1}', 'line 1: "id": neither a text nor an integer: None'),
        ('{"id": 1, "time": 1}\n{"id": 1, "time": 1}', "line 2: a second answer to 1"),
        ('{"id": 1, "time": {}}', 'line 1: "time": not a finite double: None'),
    ],
)
def test_what_is_no_answer_is_refused(tmp_path, capsys, text, says):
    (tmp_path / "a.jsonl").write_text(text)

    assert code_of("judge", tmp_path / "a.jsonl") == 2

    err = capsys.readouterr().err
    assert says in err
    assert err.count("\n") == 1


def test_a_question_without_an_answer_counts_as_crashed(tmp_path):
    lines = [json.dumps({"id": n, "time": [0, 1], "a": STILL, "b": STILL}) for n in (1, 2)]
    (tmp_path / "q.jsonl").write_text("\n".join(lines))
    (tmp_path / "a.jsonl").write_text('{"id": 1, "time": 0}')

    result = run("judge", tmp_path / "a.jsonl", "--questions", tmp_path / "q.jsonl")

    assert result.stdout.splitlines()[1].split() == ["others", "1", "0", "0", "0", "0", "1"]


def test_a_question_that_has_no_truth_is_named(tmp_path, capsys):
    bow = {"vertices": [[0, 0], [1, 1], [1, 0], [0, 1]]}
    line = json.dumps({"id": 1, "time": [0, 1], "a": STILL, "b": bow})
    (tmp_path / "q.jsonl").write_text(line)
    (tmp_path / "a.jsonl").write_text('{"id": 1, "time": 0}')

    assert code_of("judge", tmp_path / "a.jsonl", "--questions", tmp_path / "q.jsonl") == 2
    assert "a.jsonl: among its questions: body " in capsys.readouterr().err


def test_a_wrong_family_is_refused(capsys):
    assert code_of("questions", "circles") == 2

    assert "no family 'circles'; there are: all, corner_to_corner" in capsys.readouterr().err


def test_the_oracle_has_the_limits_of_the_other_commands(tmp_path, capsys):
    short = json.dumps({"time": [0, 1], "a": STILL, "b": STILL})
    (tmp_path / "q.jsonl").write_text(f"{short}\n{short}{' ' * 50}\n{short}\n")

    code = code_of("oracle", tmp_path / "q.jsonl", "--max-bytes", len(short))

    out, err = capsys.readouterr()
    assert code == 2
    assert [json.loads(line)["id"] for line in out.splitlines()] == [1]
    assert f"a line of more than {len(short)} bytes: allow more by --max-bytes" in err
    assert code_of("oracle", tmp_path / "q.jsonl", "--max-bytes", 1000) == 0
    assert code_of("oracle", tmp_path / "q.jsonl", "--max-memory", 1) == 4
