"""The harness of engines under test: planted engines, right and wrong, and the installed ones."""

import json
import os
import re
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

from benchmarks import engines
from benchmarks.engines import asking, engine
from benchmarks.engines.asking import WRONG, Finding, ask, questions
from benchmarks.engines.domain import as_asked
from benchmarks.engines.engine import (
    ADAPTERS,
    Crash,
    Engine,
    Missing,
    all_adapters,
    node_modules,
)
from benchmarks.tests.bench_help import Results, square
from exactpt.errors import InputError
from exactpt.testing import Moving, Question, Truth

ROOT = Path(__file__).parents[2]
PAGES = ROOT / "docs" / "engines"

ADAPTER = '''"""An engine that is planted: exactpt, and a mistake."""

import json
import os
import os
import signal
import time

ABOUT = {
    "name": "planted",
    "package": "numpy",
    "module": "numpy",
    "install": "pip install numpy",
    "asked": "As all.",
    "promises": [["It is planted.", "its docstring"]],
    "takes": {"shapes": ["convex", "simple", "chain", "segment", "point"], "motion": "polynomial"},
    "ways": {"": {"asked": "", "allows": ALLOWS}},
}


def truth(question):
    from exactpt import Body, Scene, Translation, first_contact

    bodies = [
        Body(k, question[k]["vertices"], Translation(question[k]["x"], question[k]["y"]),
             closed=question[k]["closed"])
        for k in "ab"
    ]
    contact = first_contact(Scene(bodies, (0, question["span"])))
    return None if contact is None else float(contact.time)


def answer(question, way):
    found, span = truth(question), question["span"]
    return MISTAKE
'''

MISTAKES = {
    "missed": "None if found and found > span / 4 else found",
    "invented": "span / 2 if found is None else found",
    "early": "found and found / 2",
    "late": "None if found is None else (found + span) / 2",
    "crashed": "1 / 0 if found else found",
}


@pytest.fixture
def planted(tmp_path):
    """A function that makes the adapter of a planted engine."""

    def make(mistake, allows="{}", name="with_planted.py"):
        path = tmp_path / name
        path.write_text(ADAPTER.replace("MISTAKE", mistake).replace("ALLOWS", allows))
        return path

    return make


@pytest.fixture(scope="module")
def asked():
    return questions(2, 0)


def asked_of(adapter, asked, seconds=2.0):
    with Engine(adapter) as started:
        return ask(started, "", asked, seconds=seconds)


MEETING = Question(square(0.0, 0.0), square(3.0, 0.0, x=(0.0, -1.0), y=(0.0, 0.0)), (0.0, 8.0))
"""Two squares that meet at t = 2."""


def test_a_right_engine_has_no_fault(planted, asked):
    result = asked_of(planted("found"), asked)
    assert result.total["right"] == len(asked)
    assert result.worst is None
    assert len(result.seconds) == len(asked)


@pytest.mark.parametrize("verdict, mistake", MISTAKES.items())
def test_a_wrong_engine_is_found(planted, asked, verdict, mistake):
    adapter = planted(mistake)
    result = asked_of(adapter, asked)
    wrong = {v: n for v, n in result.total.items() if n and v in WRONG}
    assert set(wrong) == {verdict}
    assert result.worst.verdict == verdict
    assert result.worst.clear
    assert result.worst.question.size <= 8
    program = engines.reproducer(result, result.worst, adapter)
    done = subprocess.run(
        [sys.executable, "-c", program], capture_output=True, text=True, check=True
    )
    assert done.stdout.startswith(f"answer: {result.worst.answer}\ntruth:  ")


def test_the_worst_finding_is_clear_then_missed_then_near_then_small():
    far = Question(square(1e6, 0.0), square(1e6 + 3, 0.0), (0.0, 8.0))
    tips = Question(Moving(TIP), square(3.0, 0.0), (0.0, 8.0))
    found = [
        ("early", 1, tips), ("missed", 0, tips), ("missed", 1, far), ("missed", 1, MEETING),
        ("missed", 1, tips),
    ]  # fmt: skip
    findings = [Finding(v, bool(clear), q, Truth(None), None) for v, clear, q in found]
    ordered = sorted(findings, key=lambda finding: finding.order)
    assert [findings.index(finding) for finding in ordered] == [4, 3, 2, 0, 1]


def test_a_process_that_dies_is_a_crash_and_begins_anew(planted):
    kill = "os.kill(os.getpid(), signal.SIGSEGV) if span == 8.0 else found"
    with Engine(planted(kill)) as started:
        asked = as_asked(MEETING)
        assert started.ask(asked, "").answer == Crash("the process ended: signal 11")
        assert started.ask({**asked, "span": 4.0}, "").answer == 2.0


def test_bug_an_engine_that_crashed_and_is_gone_ended_the_benchmark(planted, asked):
    adapter = planted("os._exit(1)")
    with Engine(adapter) as started:
        right = adapter.read_text()
        adapter.write_text("no adapter")
        first, second = (started.ask(as_asked(MEETING), "").answer for _ in range(2))
        adapter.write_text(right.replace("os._exit(1)", "found"))

        assert str(first).startswith("the process ended: exit code 1; it does not begin anew: ")
        assert str(second).startswith("it does not begin anew: ")
        assert started.ask(as_asked(MEETING), "").answer == 2.0


def test_a_process_that_hangs_is_a_crash(planted, monkeypatch):
    monkeypatch.setattr(engine, "PATIENCE", 0.5)
    with Engine(planted("time.sleep(60)")) as started:
        assert started.ask(as_asked(MEETING), "").answer == Crash("no answer in 0.5 seconds")


@pytest.mark.parametrize("mistake", ["float('nan')", "'two'", "float('inf')"])
def test_what_is_no_time_is_a_crash(planted, asked, mistake):
    assert asked_of(planted(mistake), asked[:2]).total["crashed"] == 2


@pytest.mark.parametrize("printed", ["warning", "{", '{"a": 1}', "[1]", "3"])
def test_what_an_engine_prints_is_no_answer(planted, printed):
    with Engine(planted(f"print({printed!r}, flush=True) or found")) as started:
        for _ in range(3):
            assert started.ask(as_asked(MEETING), "").answer == 2.0


def test_a_promised_tolerance_is_no_fault(planted, asked):
    early = "found and max(0.0, found - 1e-3)"
    assert asked_of(planted(early), asked).total["early"] > 5
    result = asked_of(planted(early, "{'distance': 10.0}"), asked)
    assert result.total["early"] == 0
    assert result.total["within"] > 5


def test_an_engine_that_is_missing_is_named_with_what_installs_it(planted, tmp_path):
    adapter = planted("found")
    adapter.write_text(adapter.read_text().replace('"module": "numpy"', '"module": "no_such"'))
    with pytest.raises(Missing, match=r"planted is not installed \(pip install numpy\)"):
        Engine(adapter)
    results = Results(tmp_path / "out")
    engines.run(results.output, engines.QUICK, 0, folder=tmp_path)
    assert "skipped: planted is not installed (pip install numpy)" in results.said
    assert results.names() == []


def test_an_engine_of_another_package_has_no_version(planted):
    adapter = planted("found")
    adapter.write_text(adapter.read_text().replace('"package": "numpy"', '"package": "no_such"'))
    with Engine(adapter) as started:
        assert started.version == "unknown"


def test_a_file_that_is_no_adapter_is_refused(tmp_path):
    (tmp_path / "with_nothing.py").write_text("ABOUT = 1")
    with pytest.raises(InputError, match="does not begin as an adapter"):
        Engine(tmp_path / "with_nothing.py")


def test_the_page_the_table_and_the_reproducers(planted, tmp_path, monkeypatch):
    planted(MISTAKES["late"], name="with_late.py")
    planted("found", name="with_right.py")
    results = Results(tmp_path / "out")
    engines.run(results.output, engines.Sizes(1, 1.0), 3, folder=tmp_path)
    assert results.names() == ["engines.csv", "late_late.py", "README.md"]
    rows = results.rows("engines")
    assert len(rows) == 2 * 18
    late = [row for row in rows if int(row["late"])]
    page = (tmp_path / "out" / "README.md").read_text()
    assert f"| planted | {rows[0]['version']} | " in page
    assert "`python -m benchmarks engines -o docs/engines --seed 3`" in page
    assert "> It is planted. (its docstring)" in page
    assert f"Wrong: {late[0]['family']}: 1 late" in page
    assert "[late_late.py](late_late.py)" in page
    assert "No result is wrong." in page


# JavaScript

NODE = """// An engine that is planted.
export const about = {
  name: "planted", package: "planted", module: "planted", install: "npm install planted",
  asked: "As all.", promises: [["It adds.", "its page"]],
  takes: { shapes: ["convex"], motion: "linear" },
  ways: { "": { asked: "", allows: {} } },
};
export const load = () => import("planted");
export const answer = (engine, question) => engine.half(question.span);
"""


@pytest.fixture
def node(tmp_path):
    """An adapter in JavaScript, and a folder of npm packages with its engine."""
    if shutil.which("node") is None:
        pytest.skip("node is not installed")
    (tmp_path / "with_planted.mjs").write_text(NODE)
    package = tmp_path / "there" / "node_modules" / "planted"
    package.mkdir(parents=True)
    (package / "package.json").write_text(json.dumps({"version": "7.8", "main": "index.js"}))
    (package / "index.js").write_text("exports.half = (x) => { if (x === 4) throw 7; return x/2 };")
    return tmp_path / "with_planted.mjs", package.parent


def test_an_engine_in_javascript(node, asked):
    adapter, modules = node
    with Engine(adapter, modules) as started:
        assert started.version == "7.8"
        assert started.ask(as_asked(MEETING), "").answer == 4.0
        assert started.ask({**as_asked(MEETING), "span": 4.0}, "").answer == Crash("7")
        result = ask(started, "", asked, seconds=1.0)
    assert result.total["not asked"] > 0
    assert result.worst.verdict in ("missed", "late")
    program = modules.parent / "program.mjs"
    program.write_text(engines.reproducer(result, result.worst, adapter))
    done = subprocess.run(["node", program], capture_output=True, text=True, check=True)
    assert done.stdout.startswith(f"answer: {result.worst.answer:g}\ntruth:  ")


def test_an_engine_in_javascript_that_is_missing(node):
    adapter, _ = node
    with pytest.raises(Missing, match=r"planted is not installed \(npm install planted\)"):
        Engine(adapter)


def test_without_node_its_engines_are_skipped(node, monkeypatch):
    monkeypatch.setattr(engine.shutil, "which", lambda _: None)
    with pytest.raises(Missing, match="with_planted: node is not installed"):
        Engine(node[0])


def test_packages_are_sought_as_node_does(tmp_path):
    below = tmp_path / "project" / "src"
    below.mkdir(parents=True)
    modules = tmp_path / "project" / "node_modules"
    modules.mkdir()
    assert node_modules(None, below) == modules
    assert node_modules(str(modules), tmp_path) == modules
    assert node_modules(str(modules.parent), tmp_path) == modules
    with pytest.raises(InputError, match="no folder node_modules"):
        node_modules(str(below), tmp_path)


# The engines that are installed

NEAR = {"shapely": 0.01, "pymunk": 0.01, "fcl": 0.01, "Box2D 2.3": 0.01, "Box2D 3": 0.01,
        "planck": 0.01, "ipctk": 0.01, "coal": 1e-5, "rapier": 1e-5}  # fmt: skip
TIP = ((3.0, 0.25), (4.0, -0.5), (4.0, 1.5))
PLAIN, APART = (
    Question(
        MEETING.a, Moving(tuple((x, y + up) for x, y in TIP), (0.0, -1.0), (0.0, 0.0)), (0.0, 8.0)
    )
    for up in (0.0, 4.0)
)
"""A tip that meets an edge at t = 2, and one that passes."""


@pytest.mark.parametrize("adapter", all_adapters(), ids=lambda path: path.stem)
def test_an_installed_engine_finds_a_plain_contact(adapter):
    try:
        started = Engine(adapter, node_modules(os.environ.get(engines.MODULES), ROOT))
    except Missing as missing:
        pytest.skip(str(missing))
    with started:
        for way in started.about["ways"]:
            found = started.ask(as_asked(PLAIN), way).answer
            assert found == pytest.approx(2.0, abs=NEAR[started.about["name"]])
            assert started.ask(as_asked(APART), way).answer is None


PROGRAMS = sorted(p for p in PAGES.glob("*") if p.suffix in (".py", ".mjs"))


@pytest.mark.parametrize("program", PROGRAMS, ids=lambda path: path.name)
def test_a_reproducer_says_what_its_head_says(program, tmp_path):
    """With the version of the engine that it was written for; with another one it runs."""
    text = program.read_text(encoding="utf-8")
    stem = next(
        a
        for a in all_adapters()
        if program.stem.startswith(a.stem.removeprefix("with_") + "_")
        and a.suffix == program.suffix
    )
    try:
        with Engine(stem, node_modules(os.environ.get(engines.MODULES), ROOT)) as started:
            version, package = started.version, started.about["package"]
    except Missing as missing:
        pytest.skip(str(missing))
    if program.suffix == ".mjs":
        (tmp_path / "node_modules").symlink_to(node_modules(os.environ.get(engines.MODULES), ROOT))
    copy = shutil.copy(program, tmp_path)
    command = sys.executable if program.suffix == ".py" else "node"
    done = subprocess.run([command, copy], capture_output=True, text=True, timeout=60, check=False)
    said = re.search(r"answer: (.*)\ntruth:  ", done.stdout)
    head = " ".join(re.findall(r"^(?:#|//) (.*)", text, re.MULTILINE))
    if f"({package} {version})" in head:
        reported = "no contact" if said.group(1) in ("None", "null") else said.group(1)
        assert f": {reported}; the truth is" in head
    else:
        assert said or done.returncode != 0


def test_the_page_names_each_reproducer_and_eight_engines():
    page = (PAGES / "README.md").read_text(encoding="utf-8")
    assert set(re.findall(r"\]\(([\w.]+\.(?:py|mjs))\)", page)) == {p.name for p in PROGRAMS}
    (table,) = re.findall(r"^\| engine \|.*?\n\n", page, re.MULTILINE | re.DOTALL)
    assert len({line.split("|")[1].split(",")[0] for line in table.split("\n")[2:-2]}) >= 8


def test_every_adapter_says_what_it_promises_in_words():
    for path in all_adapters():
        text = path.read_text(encoding="utf-8")
        for key in ("name", "package", "module", "install", "asked", "promises", "takes", "ways"):
            assert re.search(rf'["\s]{key}"?:', text), (path.name, key)
    assert all_adapters() == sorted(ADAPTERS.glob("with_*"))
    assert asking.COLUMNS[:2] == ("right", "within")
