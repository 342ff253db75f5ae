"""Numbers of up to 10,000 digits, with the least limit on digits that Python allows."""

import json
import random
import subprocess
import sys
import time
from decimal import Decimal
from fractions import Fraction
from pathlib import Path

import gmpy2
import pytest
from folding import every
from public_calls import CALLS, command, long_world

import exactpt
from exactpt import (
    AlgebraicNumber,
    Body,
    Polynomial,
    Scene,
    Translation,
    proof_scene,
)
from exactpt.proof.handout import checker_file

pytestmark = pytest.mark.long

DIGITS = "7" * 9999 + "9"
"""10,000 digits: as many as a scene may have."""


@pytest.fixture
def limited():
    """Python's limit on digits is at its least."""
    limit = sys.get_int_max_str_digits()
    sys.set_int_max_str_digits(640)
    yield
    assert sys.get_int_max_str_digits() == 640
    sys.set_int_max_str_digits(limit)


@every("name", CALLS)
def test_a_call_with_long_numbers_needs_no_limit(name, tmp_path, limited):
    CALLS[name](long_world(tmp_path))


def test_a_scene_of_longest_numbers_is_saved_loaded_and_answered(tmp_path, limited):
    """The point is at (1 - 1/N) t and meets x = 2 at t = 2 N / (N - 1)."""
    n = int(gmpy2.mpz(DIGITS))
    point = Body("p", [(0, 0)], Translation([0, 1 - Fraction(1, n)]), properties={"id": n})
    scene = Scene([point, Body("w", [(2, -1), (2, 1)])], time=(0, 9))
    scene.save(tmp_path / "s.json")
    read = Scene.load(tmp_path / "s.json")
    assert read == scene
    assert read.bodies[0].properties == {"id": DIGITS}  # as a text, as any integer so long
    data = scene.to_json()
    data["time"] = [0, n]
    assert Scene.from_json(data).end == n

    contact = exactpt.first_contact(read)
    assert contact.time == Fraction(2 * n, n - 1)
    assert json.loads(json.dumps(contact.to_json()))["time"]["low"].startswith("7777")
    assert len(repr(contact)) <= 200
    for certified in (exactpt.prove(read), exactpt.certify(read)):
        assert certified.check().startswith("accepted: ")
        certified.save(tmp_path / "a.proof")
        code, out, err = command("check", tmp_path / "a.proof.scene.json", tmp_path / "a.proof")
        assert (code, out[:9]) == (0, "accepted:"), err
    code, out, _ = command("collide", tmp_path / "s.json", "--json")
    assert code == 0
    assert json.loads(out)["contact"]["time"]["high"].startswith("7777")


def test_texts_of_numbers_are_short_or_whole(limited):
    n = int(gmpy2.mpz(DIGITS))
    root = Polynomial([-n, 0, 1]).roots(0, 10**6000)[0]

    assert str(AlgebraicNumber(n)).startswith("7777")
    assert len(str(AlgebraicNumber(n))) <= 200
    assert AlgebraicNumber(DIGITS) == n
    assert AlgebraicNumber(Decimal(f"0.{DIGITS}")) == Fraction(n, 10**10000)
    # sqrt(7.777...e9999) = sqrt(700/9) 10^4999 = (10/3) sqrt(7) 10^4999, up to its last digits
    assert f"{root:.20e}" == "8.81917103688196863501e+4999"
    assert root.to_json()["polynomial"][0] == f"-{DIGITS}"
    assert repr(Polynomial([n])).startswith("Polynomial(['7777")


def test_integers_are_read_and_written_in_pieces(limited):
    rng = random.Random(1)
    for size in [1, 2, *range(600, 700, 7), 1279, 1280, 1281, 1920, 2559, 2560, 2561, 12345]:
        for sign in ("", "-", "+"):
            text = str(rng.randint(1, 9)) + "".join(rng.choices("0123456789", k=size - 1))
            value = proof_scene.integer(sign + text)
            assert value == int(gmpy2.mpz(sign.strip("+") + text))
            assert proof_scene.digits(value) == sign.strip("+") + text
        for value in (10**size, 10**size - 1, 2**size, 2**size - 1, -(10**size)):
            assert proof_scene.digits(value) == str(gmpy2.mpz(value))
            assert proof_scene.integer(proof_scene.digits(value)) == value
    assert proof_scene.integer("0" * 5000 + "7") == 7
    assert proof_scene.written(Fraction(-(10**700), 3)) == f"-1{'0' * 700}/3"


def test_long_integers_take_less_than_quadratic_time(limited):
    """Ten times the digits take a hundred times as long by digits one after the other."""

    def seconds(size):
        text = "7" * size
        begin = time.process_time()
        assert proof_scene.digits(proof_scene.integer(text)) == text
        return time.process_time() - begin

    seconds(10_000)
    assert min(seconds(300_000) for _ in range(2)) < 40 * max(seconds(30_000), 1e-3)


def test_the_checkers_never_touch_the_limit():
    package = Path(exactpt.__file__).parent
    for path in package.rglob("*.py"):
        assert "set_int_max_str_digits" not in path.read_text(encoding="utf-8"), path


def test_a_command_works_under_the_limit_of_the_environment(tmp_path):
    point = Body("p", [(0, 0)], Translation([0, Fraction(3**2000, 3**2000 + 1)]))
    Scene([point, Body("w", [(2, -1), (2, 1)])], time=(0, 9)).save(tmp_path / "s.json")
    environment = {
        "PYTHONINTMAXSTRDIGITS": "640",
        "PYTHONPATH": str(Path(exactpt.__file__).parents[1]),
    }
    done = subprocess.run(
        [sys.executable, "-m", "exactpt", "collide", "s.json", "--proof", "a.proof"],
        cwd=tmp_path, env=environment, capture_output=True, text=True, check=False,
    )  # fmt: skip
    assert done.returncode == 0, done.stderr
    (tmp_path / "check.py").write_bytes(checker_file("proof_check"))
    checked = subprocess.run(
        [sys.executable, "-I", "check.py", "s.json", "a.proof"],
        cwd=tmp_path, capture_output=True, text=True, check=False, env=environment,
    )  # fmt: skip
    assert checked.returncode == 0, checked.stdout
