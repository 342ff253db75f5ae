"""Campaigns: every case once, wherever it runs; failures found, shrunk and saved."""

import os
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest

from exactpt.errors import InputError
from exactpt.scene.generate import generate
from exactpt.scene.scene import Scene
from fuzz import corpus
from fuzz.campaign import Campaign, Summary, cases, run
from fuzz.cases import Case, failure_of, run_case
from fuzz.planted import PLANTED, hunt, table
from fuzz.witnesses import WITNESSES

ROOT = Path(__file__).parents[2]
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
        outcomes = (run_case(Case(i, "grazing", i), ["reference"], 3.0) for i in range(64))
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

    (failure,) = run_case(Case(7, "chains", 5), ["reference"]).failures

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
    _, err = process.communicate(timeout=20)

    assert process.returncode == 130
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
