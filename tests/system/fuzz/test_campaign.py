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

from exactpt.errors import InputError
from exactpt.scene.generate import generate
from exactpt.scene.scene import Scene
from exactpt.workers.processes import results_of
from exactpt.workers.work import Work
from fuzz import corpus
from fuzz.__main__ import FAMILIES as FUZZED
from fuzz.__main__ import MIXED
from fuzz.campaign import Campaign, Summary, cases, run
from fuzz.cases import Case, Failure, Step, failure_of, left_by, run_case, stopped
from fuzz.limits import TooSlow, limit
from fuzz.planted import PLANTED, hunt, table
from fuzz.questions.checks import QUESTIONS, Checked, checked
from fuzz.witnesses import WITNESSES

pytestmark = pytest.mark.filterwarnings("ignore::pytest.PytestUnraisableExceptionWarning")
"""A signal that comes during a collection is handled in Hypothesis's callback of the collector,
which drops the exception, with a warning; the next signal ends the work."""

ROOT = Path(__file__).parents[3]
FAMILIES = ("row", "grazing", "clamps")
SMALL = Campaign(FAMILIES, ("reference",), seed=5, count=12)


def test_cases_take_the_families_in_turn():
    planned = list(cases(SMALL))

    assert [case.family for case in planned[:4]] == ["row", "grazing", "clamps", "row"]
    assert [case.seed for case in planned[:4]] == [5, 5, 5, 6]
    rest = list(cases(Campaign(FAMILIES, ("reference",), seed=5, start=7, count=5)))
    assert planned == [*planned[:7], *rest]


@pytest.mark.parametrize("jobs", [1, 2])
def test_every_case_runs_once(jobs):
    reported = []

    summary = run(SMALL, reported.append, jobs=jobs)

    assert sorted(summary.outcomes) == list(range(12))
    assert len(reported) == 12
    assert summary.finished
    assert not summary.failed
    assert summary.next_start(0) == 12
    assert summary.table()[-1].split()[:2] == ["all", "12"]


def test_time_is_up():
    endless = Campaign(FAMILIES, ("reference",), seconds=0.5)

    summary = run(endless, lambda _: None)

    assert summary.outcomes
    assert summary.seconds < 10


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
    outcomes = []

    def work():
        case = Case(0, "row", 1)
        outcomes.append(run_case(case, witnesses=["reference"], shrink_seconds=0.5))

    if where == "main":
        work()
    else:
        thread = threading.Thread(target=work)
        thread.start()
        thread.join()

    assert [failure.signature for failure in outcomes[0].failures] == ["hangs"]


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


@pytest.mark.parametrize("jobs", [1, 2])
def test_a_limit_of_time_holds_for_a_witness_that_hangs(monkeypatch, jobs):
    """Neither its patience nor the time for shrinking go beyond the end of the campaign."""
    campaign = Campaign(("row",), ("reference",), seconds=3.0)
    if jobs == 1:
        monkeypatch.setitem(WITNESSES, "reference", hang)

    summary = run(campaign, lambda _: None, jobs=jobs)

    assert summary.finished
    assert jobs == 2 or not summary.outcomes
    assert summary.seconds < 6


DEADLY = ("case.number == 3 and os.kill(os.getpid(), 9)", "ends its process")
STUCK = ("case.number == 3 and __import__('re').match('(a+)+b', 'a' * 60)", "hangs")


def job_of(kind, folder):
    """A job for worker processes, which import it."""
    wound, _ = {"deadly": DEADLY, "stuck": STUCK, "once": ("once(case)", "")}[kind]
    (folder / f"wounded_{kind}.py").write_text(
        "import os, pathlib\n"
        "from fuzz.cases import Outcome, Step\n"
        f"mark = pathlib.Path({str(folder / 'mark')!r})\n"
        "def once(case):\n"
        "    if case.number == 3 and not mark.exists():\n"
        "        mark.touch()\n"
        "        os.kill(os.getpid(), 9)\n"
        "def job(case, tell):\n"
        "    tell(Step('reference', 0.1, '{}'))\n"
        f"    {wound}\n"
        "    return Outcome(case, {}, ())\n"
    )
    return importlib.import_module(f"wounded_{kind}").job


@pytest.mark.parametrize("kind", ["once", "deadly", "stuck"])
def test_a_worker_that_is_killed_or_stuck_loses_no_case(tmp_path, monkeypatch, kind):
    monkeypatch.syspath_prepend(str(tmp_path))
    monkeypatch.setattr("exactpt.workers.processes.GRACE", 1.0)
    todo = iter(Case(i, "row", i) for i in range(12))

    outcomes = list(results_of(Work(job_of(kind, tmp_path), left_by), todo, 2))

    assert sorted(outcome.case.number for outcome in outcomes) == list(range(12))
    found = [f.signature for o in outcomes for f in o.failures]
    assert found == {"once": [], "deadly": [DEADLY[1]], "stuck": [STUCK[1]]}[kind]


def test_what_was_being_shrunk_is_reported_unshrunk():
    failure = failure_of_text("{}")
    step = Step("reference", 1.0, "{}", failure)

    assert stopped(Case(3, "row", 3), step, "hangs").failures == (failure,)


def failure_of_text(text):
    return Failure("reference", "Difference", "why", text)


def test_an_interrupted_campaign_says_where_to_go_on():
    def interrupt(outcome):
        if outcome.case.number == 4:
            raise KeyboardInterrupt

    summary = run(SMALL, interrupt)

    assert not summary.finished
    assert summary.next_start(0) == 5


def test_nothing_is_a_summary_too():
    assert not Summary().failed
    assert len(Summary().table()) == 2


def test_a_failure_is_shrunk_and_saved(tmp_path):
    with PLANTED["even roots ignored"]():
        outcomes = (
            run_case(Case(i, "grazing", i), witnesses=["reference"], shrink_seconds=3.0)
            for i in range(64)
        )
        failure, case = next((f, o.case) for o in outcomes for f in o.failures)
        path = corpus.save(failure, case, tmp_path)
        again = failure_of("reference", Scene.load(path))

    assert again is not None
    assert again.signature == failure.signature
    assert corpus.files(tmp_path) == [path]
    assert path.name.startswith("reference-")
    assert f"grazing {case.seed}" in path.with_suffix(".txt").read_text()
    assert len(Scene.load(path).bodies) == 2
    assert failure_of("reference", Scene.load(path)) is None


def test_a_generator_that_breaks_is_a_failure_of_its_case(monkeypatch):
    def broken(family, seed):
        raise InputError(f"{family} {seed} is none")

    monkeypatch.setattr("fuzz.cases.scene_of", broken)

    (failure,) = run_case(Case(7, "chains", 5), witnesses=["reference"]).failures

    assert (failure.witness, failure.why) == ("generator", "chains 5 is none")


def test_chains_that_are_not_simple_are_left_out():
    """Once, in 390 seeds, the family refused its own scene."""
    assert len(generate("chains", 50247).bodies) == 5


def test_what_breaks_and_what_hangs_is_a_failure(monkeypatch):
    scene = Scene([], (0, 1))
    monkeypatch.setitem(WITNESSES, "reference", lambda *_: 1 // 0)
    assert failure_of("reference", scene).signature == "ZeroDivisionError in <lambda>"
    monkeypatch.setitem(WITNESSES, "reference", lambda *_: any(0 for _ in iter(int, 1)))
    assert failure_of("reference", scene, patience=0.2).signature == "hangs"


@pytest.mark.plain
@pytest.mark.parametrize("bug", ["the wrong diagonal gives way", "vertical bitangents ignored"])
def test_a_planted_bug_is_found(bug):
    found = hunt(bug, 60, ("static",))

    assert found.failure is not None
    assert bug in table([found])[1]


@pytest.mark.plain
@pytest.mark.slow
@pytest.mark.parametrize("bug", PLANTED)
def test_every_planted_bug_is_found(bug):
    assert hunt(bug).failure is not None


def test_by_default_scenes_and_questions_take_turns():
    assert MIXED[::2] == FUZZED
    assert {name.removeprefix("questions/") for name in MIXED[1:30:2]} == set(QUESTIONS)


def test_a_question_with_a_wrong_answer_is_a_failure(monkeypatch):
    def wrong(random):
        return Checked(Scene([], (0, 1)), "never", "wrong" if random.random() < 0.5 else None)

    monkeypatch.setitem(QUESTIONS, "distance", wrong)
    outcome = run_case(Case(4, "questions/distance", 7), witnesses=["reference"])

    numbers = [n for n in range(32, 40) if checked("distance", 7, n).fault]
    again = "wrong\n  again: python -m fuzz questions --question distance --seed 7 --start"
    assert 0 < len(numbers) < 8
    assert [f.why for f in outcome.failures] == [f"{again} {n} --cases 1" for n in numbers]
    assert list(outcome.seconds) == ["questions"]


def test_a_question_that_raises_is_a_failure(monkeypatch):
    monkeypatch.setitem(QUESTIONS, "spin", lambda _: 1 / 0)
    outcome = run_case(Case(0, "questions/spin", 0), witnesses=[])

    assert [failure.signature for failure in outcome.failures] == ["ZeroDivisionError in <lambda>"]


def test_a_mistake_in_a_filter_is_found_by_questions(monkeypatch):
    """The rounding of a discriminant without its bound, as a stranger planted it."""
    monkeypatch.setattr("exactpt.kernel.filters.U4", 2.0**-60)
    outcomes = [run_case(Case(number, "questions/filters", 0), witnesses=[]) for number in range(4)]

    assert any(outcome.failures for outcome in outcomes)


def test_a_run_restored_without_its_last_contact_is_found(monkeypatch):
    monkeypatch.setattr("exactpt.simulation.saved_run._met_from_json", lambda *_: None)

    assert run_case(Case(0, "questions/restored", 0), witnesses=[]).failures


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
    assert done.stdout.startswith("seed 9, from case 0 on, witnesses reference\n")
    assert "3 cases in" in done.stdout
    assert fuzz("no-such-family").returncode == 2
    assert fuzz("--cases", "0").returncode == 2


def test_the_command_line_asks_for_cgal():
    done = fuzz("row", "--cases", "1", env={**os.environ, "EXACTPT_CGAL_CHECK": "/nowhere"})

    assert done.returncode == 2
    assert "--witness" in done.stderr


@pytest.mark.plain
def test_planted_from_the_command_line():
    done = fuzz("planted", "wrong diagonal")

    assert done.returncode == 0
    assert done.stdout.endswith("0 escaped\n")


@pytest.mark.filterwarnings("default")
@pytest.mark.parametrize("jobs", ["1", "2"])
@pytest.mark.parametrize("how", [signal.SIGINT, signal.SIGTERM])
def test_ctrl_c_and_kill_stop_cleanly(how, jobs):
    """Killed, a campaign once left its worker processes behind."""
    # What a shell runs in the background ignores Ctrl-C, and so do its children.
    here = signal.signal(signal.SIGINT, signal.default_int_handler)
    process = subprocess.Popen(
        [
            sys.executable,
            "-m",
            "fuzz",
            "convex",
            "--seconds",
            "60",
            "--witness",
            "reference",
            "--jobs",
            jobs,
        ],
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
        cwd=ROOT,
    )
    signal.signal(signal.SIGINT, here)
    process.stdout.readline()
    time.sleep(3)
    process.send_signal(how)
    process.send_signal(how)  # the table is printed, however impatient one is
    out, err = process.communicate(timeout=20)

    assert process.returncode == 130
    assert "family" in out
    assert "cases in" in out
    assert "to go on: --seed 0 --start" in err
    assert "Traceback" not in err


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
        reported = []

        def report(outcome):
            reported.append(outcome.case.number)
            if len(reported) == 5:
                os.kill(pids[0], signal.SIGKILL)

        campaign = Campaign(FAMILIES, ("reference",), count=60)
        summary = run(campaign, report, scheduler=cluster.scheduler_address)

    assert sorted(reported) == sorted(summary.outcomes) == list(range(60))
    assert not summary.failed
