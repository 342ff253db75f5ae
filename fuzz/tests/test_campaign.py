"""Campaigns: every case once, wherever it runs; failures found, shrunk and saved."""

import contextlib
import importlib
import os
import signal
import subprocess
import sys
import threading
import time
from pathlib import Path

import pytest

from exactpt import InputError, Scene, first_contact
from exactpt.testing.scenes import generate
from exactpt.tiling.start import tilings_for
from fuzz.__main__ import FAMILIES as FUZZED
from fuzz.__main__ import MIXED
from fuzz.campaign import Check, Counts, Finding, Item, Progress, Result, Step, _lost, campaign
from fuzz.cases import Case, Scenes, failure_of, run_case
from fuzz.laws import kept
from fuzz.laws.runner import cases_of, look
from fuzz.limits import TooSlow, limit
from fuzz.normals import wrong_normal
from fuzz.options import _report
from fuzz.planted import PLANTED
from fuzz.power.edits import Edit
from fuzz.questions import checks
from fuzz.questions.checks import QUESTIONS, Checked, checked
from fuzz.small_scope.scope import planned
from fuzz.witnesses import WITNESSES

pytestmark = pytest.mark.filterwarnings("ignore::pytest.PytestUnraisableExceptionWarning")
"""A signal that comes during a collection is handled in Hypothesis's callback of the collector,
which drops the exception, with a warning; the next signal ends the work."""

ROOT = Path(__file__).parents[2]
FAMILIES = ("row", "grazing", "clamps")
SMALL = Scenes(FAMILIES, ("reference",), seed=5)


def run(check, progress=None, report=lambda _: None, **limits):
    progress = progress or Progress()
    campaign(check, progress, report, **limits)
    return progress


class Numbers(Check):
    """Counts the numbers of the cases, two at a time; 5 is a finding, `stop` interrupts."""

    name = "numbers"
    chunk = 2

    def __init__(self, stop=None):
        self.stop = stop

    def run(self, item, *_):
        if self.stop in item.numbers:
            raise KeyboardInterrupt
        counts = Counts({("n", "sum"): sum(item.numbers), ("n", "first"): item.numbers[0]})
        counts["n", "slowest s"] = item.numbers[-1]
        found = [Finding("n", "five", f"case {n}") for n in item.numbers if n == 5]
        return Result(counts, found)

    def table(self, _):
        return []


def test_cases_take_the_families_in_turn():
    planned = [SMALL.case(number) for number in range(4)]

    assert [case.family for case in planned] == ["row", "grazing", "clamps", "row"]
    assert [case.seed for case in planned] == [5, 5, 5, 6]


@pytest.mark.parametrize("jobs", [0, 2])
def test_every_case_runs_once(jobs):
    progress = run(SMALL, count=12, jobs=jobs)

    assert (progress.next, progress.finished, progress.found) == (12, True, 0)
    assert SMALL.table(progress.counts)[-1].split()[:2] == ["all", "12"]


def test_counts_are_added_and_findings_reported():
    reported = []

    progress = run(Numbers(), Progress(3, 3), reported.append, count=6)

    assert progress.counts == {
        ("n", "sum"): sum(range(3, 9)), ("n", "first"): 3, ("n", "slowest s"): 8, ("n", "found"): 1
    }  # fmt: skip
    assert [finding.signature for finding in reported] == ["five"]
    assert progress.found == 1


@pytest.mark.parametrize("stop", [1, 7])
def test_a_campaign_goes_on_from_its_state(tmp_path, stop):
    state = tmp_path / "state.json"
    part = run(Numbers(stop), count=12, state=state)
    assert (part.finished, part.next) == (False, stop - 1)

    rest = run(Numbers(), Progress.load(state, Numbers()), count=12, state=state)

    assert (rest.finished, rest.next) == (True, 12)
    assert rest.counts == run(Numbers(), count=12).counts
    assert Progress.load(state, Numbers()).counts == rest.counts
    assert run(Numbers(), Progress.load(state, Numbers()), count=12).next == 12


def test_what_is_no_state_of_the_campaign_is_refused(tmp_path):
    state = tmp_path / "state.json"
    run(Numbers(), count=2, state=state)
    with pytest.raises(InputError, match="of another campaign: numbers null"):
        Progress.load(state, SMALL)
    for text in ("[", "{}", '{"next": 3}'):
        state.write_text(text)
        with pytest.raises(InputError, match="not the state of a campaign"):
            Progress.load(state, SMALL)


class Enough(Numbers):
    def wanted(self, counts):
        return frozenset() if counts["n", "sum"] >= 6 else None


def test_a_campaign_ends_when_there_is_enough():
    assert run(Enough()).next == 4


def test_what_arrives_too_early_is_counted_later(monkeypatch):
    def shuffled(check, progress, *_):
        for k in (2, 0, 1, 4):
            item = Item(range(2 * k, 2 * k + 2))
            yield item, check.run(item, None, None)
            nexts.append(progress.next)

    nexts, reported = [], []
    monkeypatch.setattr("fuzz.campaign._results", shuffled)

    progress = run(Numbers(), None, reported.append)

    assert nexts == [0, 2, 6, 6]
    assert progress.counts["n", "sum"] == sum(range(6))
    assert len(reported) == 1


def test_time_is_up():
    progress = run(Scenes(FAMILIES, ("reference",)), seconds=0.5)

    assert progress.next
    assert progress.finished


def hang(*_):
    for _ in iter(int, 1):
        pass


def wait_for_ever(*_):
    threading.Event().wait()


@pytest.mark.parametrize("stuck", [hang, wait_for_ever])
@pytest.mark.parametrize("where", ["main", "thread"])
def test_a_hang_is_a_finding_wherever_it_runs(monkeypatch, stuck, where):
    """In the worker threads of a cluster there are no signals."""
    if where == "thread" and stuck is wait_for_ever:
        pytest.skip("nothing interrupts a thread that waits: its process is killed")
    monkeypatch.setattr("fuzz.limits.WAITING", 2.0)
    monkeypatch.setattr("fuzz.cases.patience_of", lambda _: 0.2)
    monkeypatch.setitem(WITNESSES, "reference", stuck)
    results = []

    def work():
        case = Case(0, "row", 1)
        results.append(run_case(case, witnesses=["reference"], shrink_seconds=0.5))

    if where == "main":
        work()
    else:
        thread = threading.Thread(target=work)
        thread.start()
        thread.join()

    assert [finding.signature for finding in results[0].findings] == ["hangs"]


def test_an_interrupt_that_becomes_an_error_of_c_code_is_one():
    """Bug: gmpy2, interrupted while it reads a `Fraction`, says that it is none."""

    def c_code():
        try:
            hang()
        except TooSlow:
            raise SystemError("Object does not appear to be Fraction") from None

    with pytest.raises(TooSlow), limit(0.01):
        c_code()
    with pytest.raises(SystemError), limit(60):
        raise SystemError


def test_a_limit_in_a_thread_is_over_when_it_is_left():
    def work():
        for _ in range(200):
            with contextlib.suppress(TooSlow), limit(0.0005):
                for _ in range(20_000):
                    pass
        done.append(True)

    done = []
    thread = threading.Thread(target=work)
    thread.start()
    thread.join()

    assert done == [True]


def test_bug_a_watch_that_was_not_withdrawn_ends_with_the_function_that_asked():
    """It went on, and killed whichever thread got the identifier next: a pool of processes hung."""
    kept, raised = [], []

    def ask():
        kept.append(limit(0.05))
        kept[0].__enter__()

    def work():
        ask()
        try:
            time.sleep(0.2)
            for _ in range(1000):
                pass
        except TooSlow as late:
            raised.append(late)

    before = set(threading.enumerate())
    thread = threading.Thread(target=work)
    thread.start()
    thread.join()
    for watcher in set(threading.enumerate()) - before:
        watcher.join(5)

    assert raised == []
    assert set(threading.enumerate()) <= before


@pytest.mark.parametrize("jobs", [0, 2])
def test_a_limit_of_time_holds_for_a_witness_that_hangs(monkeypatch, jobs):
    """Neither its patience nor the time for shrinking go beyond the end of the campaign."""
    if jobs == 0:
        monkeypatch.setitem(WITNESSES, "reference", hang)
    began = time.monotonic()

    progress = run(Scenes(("row",), ("reference",)), seconds=3.0, jobs=jobs)

    assert progress.finished
    assert jobs == 2 or not progress.next
    assert time.monotonic() - began < 6


DEADLY = ("number == 3 and os.kill(os.getpid(), 9)", "ends its process")
STUCK = ("number == 3 and __import__('re').match('(a+)+b', 'a' * 60)", "hangs")


def check_of(kind, folder):
    """A check for worker processes, which import it."""
    wound, _ = {"deadly": DEADLY, "stuck": STUCK, "once": ("once(number)", "")}[kind]
    (folder / f"wounded_{kind}.py").write_text(
        "import os, pathlib\n"
        "from fuzz.campaign import Check, Counts, Finding, Result, Step\n"
        f"mark = pathlib.Path({str(folder / 'mark')!r})\n"
        "def once(number):\n"
        "    if number == 3 and not mark.exists():\n"
        "        mark.touch()\n"
        "        os.kill(os.getpid(), 9)\n"
        "class Wounded(Check):\n"
        "    name = 'wounded'\n"
        "    def run(self, item, tell, ends):\n"
        "        number = item.numbers.start\n"
        "        tell(Step(0.1, Finding('row', 'none', f'case {number}')))\n"
        f"        {wound}\n"
        "        return Result(Counts({('row', 'cases'): 1}))\n"
    )
    return importlib.import_module(f"wounded_{kind}").Wounded()


@pytest.mark.parametrize("kind", ["once", "deadly", "stuck"])
def test_a_worker_that_is_killed_or_stuck_loses_no_case(tmp_path, monkeypatch, kind):
    monkeypatch.syspath_prepend(str(tmp_path))
    monkeypatch.setattr("exactpt.workers.processes.GRACE", 1.0)
    reported = []

    progress = run(check_of(kind, tmp_path), None, reported.append, count=12, jobs=2)

    expected = {"once": [], "deadly": [DEADLY[1]], "stuck": [STUCK[1]]}[kind]
    assert progress.next == 12
    assert progress.counts["row", "cases"] == 12 - len(expected)
    assert [finding.signature for finding in reported] == expected


ITEM = Item(range(3, 4))


def test_what_was_being_shrunk_is_reported_unshrunk():
    finding = Finding("row", "Difference", "why")

    for why in ("hangs", "is not finished"):
        assert _lost(ITEM, Step(1.0, finding, is_found=True), why)[1].findings == (finding,)


def test_what_is_not_finished_is_no_finding():
    assert _lost(ITEM, Step(1.0, Finding("row", "", "case 3")), "is not finished") is None
    assert _lost(ITEM, None, "is not finished") is None
    (found,) = _lost(ITEM, None, "hangs")[1].findings
    assert found.why == "case 3: hangs before the first step: hangs, where no limit interrupts it"


def test_nothing_has_a_table_too():
    assert Progress().found == 0
    assert len(SMALL.table(Counts())) == 2


def test_a_failure_is_shrunk_and_saved(tmp_path, monkeypatch):
    monkeypatch.setattr(kept, "FOLDER", tmp_path)
    with PLANTED["even roots ignored"].made():
        found = (
            finding
            for i in range(64)
            for finding in run_case(
                Case(i, "grazing", i), witnesses=["reference"], shrink_seconds=3.0
            ).findings
        )
        finding = next(found)
        _report(finding)
        (name,) = kept.names()
        case = kept.kept(name)
        again = failure_of("reference", case.scene)

    assert again is not None
    assert again.signature == finding.signature
    assert name.startswith("reference-")
    family = finding.why.split(": ")[0].split(", ")[1]
    assert case.note.startswith(f"fuzz reference, {family}: ")
    assert len(case.scene.bodies) == 2
    assert failure_of("reference", case.scene) is None


def test_a_generator_that_breaks_is_a_failure_of_its_case(monkeypatch):
    def broken(family, seed):
        raise InputError(f"{family} {seed} is none")

    monkeypatch.setattr("fuzz.cases.scene_of", broken)

    (found,) = run_case(Case(7, "chains", 5), witnesses=["reference"]).findings

    assert found.why == "case 7, chains 5: chains 5 is none"
    assert all(path.name.startswith("generator-") for path in found.files)


def test_chains_that_are_not_simple_are_left_out():
    """Once, in 390 seeds, the family refused its own scene."""
    assert len(generate("chains", 50247).bodies) == 5


def test_what_breaks_and_what_hangs_is_a_failure(monkeypatch):
    scene = Scene([], (0, 1))
    monkeypatch.setitem(WITNESSES, "reference", lambda *_: 1 // 0)
    assert failure_of("reference", scene).signature == "ZeroDivisionError in <lambda>"
    monkeypatch.setitem(WITNESSES, "reference", lambda *_: any(0 for _ in iter(int, 1)))
    assert failure_of("reference", scene, patience=0.2).signature == "hangs"


def test_by_default_scenes_and_questions_take_turns():
    assert MIXED[::2] == (*FUZZED, *(f"{name}/awkward" for name in FUZZED))
    assert {name.removeprefix("questions/") for name in MIXED[1 : 2 * len(QUESTIONS) : 2]} == set(
        QUESTIONS
    )


def test_a_question_with_a_wrong_answer_is_a_failure(monkeypatch):
    def wrong(random):
        return Checked(Scene([], (0, 1)), "never", "wrong" if random.random() < 0.5 else None)

    monkeypatch.setitem(QUESTIONS, "convoy", wrong)
    result = run_case(Case(4, "questions/convoy", 7), witnesses=["reference"])

    numbers = [n for n in range(32, 40) if checked("convoy", 7, n).fault]
    again = "wrong\n  again: python -m fuzz questions --question convoy --seed 7 --start"
    assert 0 < len(numbers) < 8
    assert [f.why for f in result.findings] == [
        f"convoy, case {n}: {again} {n} --cases 1" for n in numbers
    ]
    assert {column for _, column in result.counts} == {"cases", "questions"}


def test_a_question_that_raises_is_a_failure(monkeypatch):
    monkeypatch.setitem(QUESTIONS, "spin", lambda _: 1 / 0)
    result = run_case(Case(0, "questions/spin", 0), witnesses=[])

    assert [finding.signature for finding in result.findings] == ["ZeroDivisionError in <lambda>"]


@pytest.mark.parametrize("bound", [2.0**-60, 2.0**-53])
def test_a_mistake_in_a_filter_is_found_by_questions(monkeypatch, bound):
    """The rounding of a discriminant without its bound, or with a fourth, as a stranger planted it.

    With a fourth all answers are right: squares and products have one rounding each, at most U of
    them, and differences of near numbers none; the square root has half of the error of D over
    itself. But they are not those of the filter in arrays.
    """
    monkeypatch.setattr("exactpt.certificates.first_root.U4", bound)
    results = [run_case(Case(number, "questions/filters", 0), witnesses=[]) for number in range(4)]

    assert any(result.findings for result in results)


def test_a_run_restored_without_its_last_contact_is_found(monkeypatch):
    monkeypatch.setattr("exactpt.simulation.saved_run._reported_from_json", lambda *_: None)

    found = [look(case).fault for case in cases_of("simulation/restored", 0, 20)]

    assert any(found)


@pytest.mark.plain
def test_a_flip_that_leaves_angles_without_certificates_is_found():
    """As a stranger planted it: one run in a thousand shows it, if certificates are not compared.

    Where the shadow edge ends at an end of the diagonal, the third angle of a triangle stays as it
    is, but had the certificate of another angle; `recertify` adds it to faces of four edges alone.
    """
    with Edit(checks, "flip", "if was_triangle:", "if was_triangle and not changed:").made():
        results = [run_case(Case(number, "questions/flips", 0), witnesses=[]) for number in (0, 1)]

    assert any("certificates missing" in f.why for result in results for f in result.findings)


@pytest.mark.plain
def test_shadows_kept_after_a_rebuild_are_found(monkeypatch):
    """Mistake: what is known of shadow edges outlives their certificates."""
    monkeypatch.setattr("exactpt.tiling.greedy.shadows.CertifiedShadows.clear", lambda _: None)

    scene = generate("ballistic", 0)
    failure = failure_of("static", scene, tilings_for(scene).index("mixed"))

    assert "certificates missing" in failure.why


@pytest.mark.plain
def test_a_normal_from_the_piece_after_a_breakpoint_is_found(monkeypatch):
    """Mistake: a vertex that turns back at a chain gets the normal of the other side."""
    assert wrong_normals() == set()

    def after(body, time, start):
        return body.exact_piece_after(
            max((b for b in body.exact_breakpoints if time >= b), default=start)
        )

    monkeypatch.setattr("exactpt.pair.incidences._piece_before", after)
    assert wrong_normals() == {"normal"}


def wrong_normals():
    scene = planned(214_857).scene
    contact = first_contact(scene, exact_only=True)
    return {fault for fault in [wrong_normal(scene, contact)] if fault}


def fuzz(*arguments, **options):
    return subprocess.run(
        [sys.executable, "-m", "fuzz", *arguments],
        capture_output=True,
        text=True,
        cwd=ROOT,
        check=False,
        **options,
    )


def test_the_command_line():
    done = fuzz("row", "--cases", "3", "--seed", "9", "--witness", "reference")

    assert done.returncode == 0
    assert done.stdout.startswith("seed 9, witnesses reference\nfrom case 0 on\n")
    assert "3 cases in" in done.stdout
    assert fuzz("no-such-family").returncode == 2
    assert fuzz("--cases", "0").returncode == 2


def test_the_command_line_asks_for_cgal():
    done = fuzz("row", "--cases", "1", env={**os.environ, "EXACTPT_CGAL_CHECK": "/nowhere"})

    assert done.returncode == 2
    assert "--witness" in done.stderr


COMMANDS = {
    "scenes": ["convex", "--witness", "reference"],
    "hostile": ["hostile", "--cases", "100000"],
    "small scope": ["small-scope"],
}


@pytest.mark.filterwarnings("default")
@pytest.mark.parametrize(
    "command, jobs, how",
    [
        ("hostile", "1", signal.SIGINT),
        ("small scope", "1", signal.SIGINT),
        ("scenes", "2", signal.SIGINT),
        ("scenes", "1", signal.SIGTERM),
        ("scenes", "0", signal.SIGTERM),
    ],
)
def test_ctrl_c_and_kill_stop_cleanly(how, command, jobs, tmp_path):
    """Killed, a campaign once left its worker processes behind."""
    # What a shell runs in the background ignores Ctrl-C, and so do its children.
    here = signal.signal(signal.SIGINT, signal.default_int_handler)
    process = subprocess.Popen(
        [sys.executable, "-m", "fuzz", *COMMANDS[command], "--seconds", "60", "--jobs", jobs],
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
        cwd=ROOT,
        env={**os.environ, "TMPDIR": str(tmp_path)},
    )
    signal.signal(signal.SIGINT, here)
    while not process.stdout.readline().startswith("from case"):
        pass
    time.sleep(1)
    process.send_signal(how)
    process.send_signal(how)  # the table is printed, however impatient one is
    out, err = process.communicate(timeout=20)

    assert process.returncode == 130
    assert " cases in " in out
    assert "interrupted; to go on: " in err
    assert " --start " in f" {err}"
    assert "Traceback" not in err
    assert list(tmp_path.iterdir()) == []


@pytest.mark.slow
@pytest.mark.filterwarnings("default")
def test_a_cluster_loses_a_worker_but_no_case():
    """Two worker processes, one of them killed in mid-run."""
    distributed = pytest.importorskip("distributed")
    with (
        distributed.LocalCluster(
            n_workers=2, threads_per_worker=1, processes=True, dashboard_address=None
        ) as cluster,
        distributed.Client(cluster) as client,
    ):
        pids = list(client.run(os.getpid).values())
        timer = threading.Timer(2.0, os.kill, (pids[0], signal.SIGKILL))
        timer.start()
        progress = run(
            Scenes(FAMILIES, ("reference",)), count=300, scheduler=cluster.scheduler_address
        )
        timer.join()

    assert (progress.next, progress.found) == (300, 0)
    assert sum(n for key, n in progress.counts.items() if key[-1] == "cases") == 300


TRACED = """
import sys, threading
from fuzz.limits import limit

def work():
    with limit(60):
        pass

thread = threading.Thread(target=work)
thread.start()
thread.join()

def call(x):
    return (lambda: x)()

sys.settrace(lambda frame, event, arg: None)
print(sum(map(call, range(9))))
"""


def test_bug_a_traced_call_after_a_limit_in_a_thread_returns():
    """The limit left a flag of CPython 3.11 behind, at which traced calls waited without end."""
    done = subprocess.run(
        [sys.executable, "-c", TRACED], capture_output=True, text=True, timeout=60, check=False
    )

    assert (done.stdout, done.stderr) == ("36\n", "")
