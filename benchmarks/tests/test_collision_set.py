"""The Exact 2D collision set: the sample again, the answers by another way, and the proofs."""

import gzip
import hashlib
import json
import subprocess
import sys
import tarfile
from collections import Counter
from fractions import Fraction
from pathlib import Path

import numpy as np
import pytest

from benchmarks.collision_set import passages, writing
from benchmarks.collision_set.__main__ import collision_set
from benchmarks.collision_set.answers import answers, coordinates
from benchmarks.collision_set.passages import (
    FAMILIES,
    make_passage,
    polynomial,
)
from benchmarks.collision_set.writing import planned, write_set
from exactpt import InputError, proof_check
from exactpt.cli import main
from exactpt.testing import families
from exactpt.testing.oracle import Refusals
from exactpt.testing.oracle import answers as oracle_answers

SAMPLE = Path(__file__).with_name("collision-set")
SIZES = {"questions": 76, "scenes": 36}


@pytest.fixture(scope="module")
def small(tmp_path_factory):
    folder = tmp_path_factory.mktemp("set") / "small"
    write_set(folder, planned(**SIZES))
    return folder


def content(folder, name):
    path = folder / f"{name}.gz"
    return gzip.decompress(path.read_bytes()) if path.exists() else (folder / name).read_bytes()


def lines(folder, name):
    return content(folder, name).splitlines()


@pytest.mark.long
@pytest.mark.parametrize(
    "name",
    sorted(path.relative_to(SAMPLE).as_posix() for path in SAMPLE.glob("*/*.*") if path.is_file()),
)
def test_questions_and_truths_are_those_of_the_published_set(small, name):
    assert content(small, name) == (SAMPLE / name).read_bytes()


@pytest.mark.long
def test_two_processes_write_the_same(small, tmp_path):
    summary = write_set(tmp_path / "again", planned(**SIZES), jobs=2)

    assert summary.files == 3 * (len(passages.FAMILIES) + len(families.FAMILIES)) + 2
    for path in small.rglob("*"):
        assert (
            path.is_dir()
            or path.read_bytes() == (tmp_path / "again" / path.relative_to(small)).read_bytes()
        )


def test_the_manifest_has_the_checksums_of_all_contents(small):
    sums = dict(
        reversed(line.split("  ")) for line in (small / "SHA256SUMS").read_text().splitlines()
    )

    written = {path.relative_to(small).as_posix() for path in small.rglob("*") if path.is_file()}
    assert {name.removesuffix(".gz") for name in written} - set(sums) == {"SHA256SUMS"}
    for name, checksum in sums.items():
        assert hashlib.sha256(content(small, name)).hexdigest() == checksum


@pytest.mark.parametrize("family", passages.FAMILIES)
def test_the_oracle_answers_as_the_set_says(small, family):
    """The set's answers come from arrays; those of the oracle about such bodies do not."""
    asked = lines(small, f"point-segment/{family}.jsonl")

    said = list(oracle_answers(asked, 1, Refusals()))

    assert len(said) == 4
    assert [s.encode() for s in said] == lines(small, f"point-segment/{family}.truths.jsonl")


@pytest.mark.parametrize("family", families.FAMILIES)
def test_scenes_have_the_oracles_answer_and_a_proof(small, family):
    asked = lines(small, f"scenes/{family}.jsonl")
    truths = [json.loads(line) for line in lines(small, f"scenes/{family}.truths.jsonl")]
    with tarfile.open(small / f"scenes/{family}.proofs.tar.gz") as archive:
        files = {m.name: archive.extractfile(m).read() for m in archive.getmembers()}

    found = zip(oracle_answers(asked, 1, Refusals()), truths, strict=True)
    for number, (said, truth) in enumerate(found):
        oracle, place = json.loads(said), f"{family}/{number}"
        pairs = truth.pop("pairs", [oracle.get("pair")])
        proved = proof_check.check(files[f"{place}.json"], files[f"{place}.proof"])
        assert oracle == truth
        assert truth.get("pair") == pairs[0]
        assert (truth["time"] is None) == (" no contact in [" in proved), proved


def queries(rows):
    """The edge-edge queries of lines, as readers of the benchmark's files read them."""
    assert len(rows) % 8 == 0
    for first in range(0, len(rows), 8):
        numbers = [[int(n) for n in row.split(b",")] for row in rows[first : first + 8]]
        assert all(len(n) == 7 and n[6] == numbers[0][6] for n in numbers)
        yield [[Fraction(n[i], n[i + 1]) for i in (0, 2, 4)] for n in numbers], numbers[0][6]


@pytest.mark.parametrize("family", passages.FAMILIES)
def test_queries_are_the_questions_lifted(small, family):
    asked = [json.loads(line) for line in lines(small, f"point-segment/{family}.jsonl")]
    truths = [json.loads(line) for line in lines(small, f"point-segment/{family}.truths.jsonl")]
    read = queries(lines(small, f"point-segment/{family}.csv"))

    for question, truth, (corners, result) in zip(asked, truths, read, strict=True):
        (x, y), motion = question["a"]["vertices"][0], question["a"]["motion"]
        point = [[x, motion["x"][1]], [y, motion["y"][1]]]
        ways = [point, point, *([v["x"], v["y"]] for v in question["b"]["vertices"])]
        for k, (way, height) in enumerate(zip(ways, (-1, 1, 0, 0), strict=True)):
            start = [Fraction(c[0]) for c in way]
            end = [Fraction(c[0]) + Fraction(c[1]) for c in way]
            assert (corners[k], corners[4 + k]) == ([*start, height], [*end, height])
            assert all(Fraction(float(c)) == c for c in corners[k] + corners[4 + k])
        assert result == (truth["time"] is not None)
        if result and truth["time"]["low"] == truth["time"]["high"]:
            t = Fraction(truth["time"]["low"])
            p, _, a, b = (
                [(1 - t) * f + t * g for f, g in zip(corners[k], corners[4 + k], strict=True)]
                for k in range(4)
            )
            assert (b[0] - a[0]) * (p[1] - a[1]) == (b[1] - a[1]) * (p[0] - a[0])
            assert all(min(a[i], b[i]) <= p[i] <= max(a[i], b[i]) for i in (0, 1))


def run(*arguments):
    """Run the command; its exit code."""
    with pytest.raises(SystemExit) as ended:
        main([str(a) for a in arguments], command=collision_set, name="collision_set")
    return ended.value.code


def test_a_folder_that_is_not_empty_is_refused(tmp_path, capsys):
    (tmp_path / "mine").write_text("")

    assert run(tmp_path, "--questions", 0, "--scenes", 0) == 2

    assert capsys.readouterr().err == f"exactpt: {tmp_path}: it is there; name a new folder\n"
    assert [path.name for path in tmp_path.iterdir()] == ["mine"]


def test_a_set_whose_readme_would_lack_its_descriptions_is_refused(tmp_path):
    """With PYTHONOPTIMIZE=2 the README said "None" of each family."""
    command = [sys.executable, "-OO", "-m", "benchmarks.collision_set", tmp_path / "set"]
    root = Path(__file__).parents[2]

    done = subprocess.run(
        [*command, "--questions", "0"], cwd=root, capture_output=True, text=True, check=False
    )

    assert (done.returncode, done.stdout) == (2, "")
    assert done.stderr == (
        "exactpt: PYTHONOPTIMIZE=2 removes the descriptions that the README of a set quotes\n"
    )
    assert not (tmp_path / "set").exists()


def test_nothing_is_left_of_a_set_that_ends_early(tmp_path, monkeypatch):
    def breaks(folder, part):
        if part.kind == "scenes":
            raise KeyboardInterrupt
        (folder / part.family).write_text("half")
        return []

    monkeypatch.setattr(writing, "write_part", breaks)

    with pytest.raises(KeyboardInterrupt):
        write_set(tmp_path / "set", planned(19, 18))

    assert list(tmp_path.iterdir()) == []


def test_a_folder_that_cannot_be_written_is_refused(tmp_path):
    with pytest.raises(InputError, match="cannot be written: No such file"):
        write_set(tmp_path / "none" / "set", planned(0, 0))


def test_the_command_names_the_checksum_of_the_manifest(tmp_path, capsys):
    code = run(tmp_path / "s", "--questions", 19, "--scenes", 0)

    manifest = (tmp_path / "s" / "SHA256SUMS").read_bytes()
    assert code == 0
    assert hashlib.sha256(manifest).hexdigest() in capsys.readouterr().out


# Families of a point and a segment: exact as doubles, and what their names say


def some(family, count=60):
    return [make_passage(family, number) for number in range(count)]


@pytest.mark.parametrize("family", FAMILIES)
def test_nothing_is_rounded_and_no_segment_is_a_point(family):
    for passage in some(family):
        numbers = coordinates(passage)
        for k, (first, last) in enumerate(
            zip(sum(passage.start, ()), sum(passage.end, ()), strict=True)
        ):
            unit = Fraction(1, 2**passage.bits)
            assert Fraction(numbers[k]) == first * unit
            assert Fraction(numbers[6 + k]) == (last - first) * unit
            assert Fraction(float(last * unit)) == last * unit
        (_, a, b), (_, c, d) = passage.start, passage.end
        t = [
            Fraction(f - g, (f - g) - (h - i))
            for f, g, h, i in zip(a, b, c, d, strict=True)
            if f - g != h - i
        ]
        shrinks = [s for s in t if 0 <= s <= 1 and all(
            (f - g) * (1 - s) + (h - i) * s == 0 for f, g, h, i in zip(a, b, c, d, strict=True)
        )]  # fmt: skip
        assert a != b
        assert not shrinks


def test_single_precision_holds_its_family():
    for passage in some("single_precision"):
        for place in passage.start + passage.end:
            values = [c / 2**passage.bits for c in place]
            assert [float(np.float32(v)) for v in values] == values


def test_tangents_have_double_roots_and_their_neighbours_have_not():
    discriminants = {
        family: [c1 * c1 - 4 * c0 * c2 for c0, c1, c2 in map(polynomial, some(family)) if c2]
        for family in ("tangent", "nearly_tangent")
    }

    assert len(discriminants["tangent"]) > 40
    assert set(discriminants["tangent"]) == {0}
    assert {d > 0 for d in discriminants["nearly_tangent"] if d} == {True, False}
    assert all(t.time is not None for t in answers(some("tangent")))


def test_level_polynomials_have_no_leading_coefficient():
    assert {polynomial(passage)[2] for passage in some("level")} == {0}


def test_times_are_where_the_families_put_them():
    times = {f: [t.time for t in answers(some(f))] for f in ("at_start", "at_end", "onto_end")}

    assert sum(t is not None and t == 0 for t in times["at_start"]) > 30
    assert sum(t is not None and t == 1 for t in times["at_end"]) > 20
    assert None in times["at_end"]
    assert all(8 * t.low == int(8 * t.low) for t in times["onto_end"])


def test_hairs_decide():
    kinds = Counter(truth.kind for truth in answers(some("past_end")))

    assert kinds[None] > 10
    assert kinds["vertex-edge"] > 10


def test_other_names_are_refused():
    with pytest.raises(InputError, match="no family 'circle'; there are: onto_end"):
        make_passage("circle", 0)
