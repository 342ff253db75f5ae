"""Each public function leaves the process, and the thread that calls it, as they were."""

import contextlib
import decimal
import importlib
import json
import locale
import pickle
import signal
import subprocess
import sys
import threading
import time
import warnings
from pathlib import Path

import gmpy2
import numpy as np
import public_calls
import pytest
from folding import every
from process_state import changed, state_of_process, state_of_thread
from public_calls import CALLS, REFUSED, World

import exactpt
import exactpt.testing
from exactpt import check_apart, proof_check
from exactpt.cli import all_commands
from exactpt.cli.alarm import time_limit
from exactpt.testing.scenes import generate

pytestmark = pytest.mark.long

COMMANDS = {*all_commands(), "a command that is none"}
WITH_WORKERS = {"batch.run", "batch.Summary", "batch", "batch --jobs"}
TIMED = {"Simulation.max_seconds", *WITH_WORKERS}
"""Their results have addresses of objects, or seconds."""


@every("name", CALLS)
def test_a_call_changes_no_state(name, tmp_path):
    world = World(tmp_path)
    CALLS[name](world)  # imports are done now
    before = state_of_process()

    CALLS[name](world)

    assert changed(before, state_of_process()) == {}


@every("name", REFUSED)
def test_a_call_that_fails_changes_no_state(name, tmp_path):
    world = World(tmp_path)
    with pytest.raises(Exception):  # noqa: B017, PT011 - whatever it is
        REFUSED[name](world)
    before = state_of_process()

    with pytest.raises(Exception):  # noqa: B017, PT011
        REFUSED[name](world)

    assert changed(before, state_of_process()) == {}


SETTERS = [
    "sys.set_int_max_str_digits", "sys.setrecursionlimit", "sys.setswitchinterval",
    "locale.setlocale", "os.chdir", "os.umask", "os.putenv", "os.unsetenv", "random.seed",
    "numpy.random.seed", "numpy.set_printoptions", "warnings.simplefilter",
    "warnings.filterwarnings", "decimal.setcontext", "gmpy2.set_context", "gc.freeze",
    "gc.set_threshold", "signal.signal", "signal.setitimer", "gc.disable",
    "multiprocessing.set_start_method", "resource.setrlimit", "socket.setdefaulttimeout",
    "faulthandler.enable", "threading.stack_size", "logging.basicConfig",
]  # fmt: skip
"""Functions that change what all threads share, or what a call could forget to put back."""

HELD = {
    # the collector is at rest while something large is built, and a forked child has it on
    "gc.disable": None,
    # the process of a command belongs to it: it ends by SIGTERM, and within its time limit
    "signal.signal": "command",
    "signal.setitimer": "command",
}
"""Those that a call may use for a while, in commands alone or anywhere."""


@every("name", CALLS)
def test_a_call_sets_nothing_even_for_a_while(name, tmp_path, monkeypatch):
    """Two threads that set and put back the same thing would end with a wrong one."""
    world = World(tmp_path)
    CALLS[name](world)
    used = []
    with monkeypatch.context() as patches:
        for setter in SETTERS:
            module, _, function = setter.rpartition(".")
            original = getattr(importlib.import_module(module), function)

            def recorded(*values, original=original, setter=setter):
                used.append(setter)
                return original(*values)

            patches.setattr(setter, recorded)
        CALLS[name](world)

    is_command = "--" in name or name in COMMANDS
    held = {setter for setter, where in HELD.items() if where is None or is_command}
    starts_workers = {"signal.signal"} if name in WITH_WORKERS else set()
    assert {*used} <= held | starts_workers


@every("name", CALLS)
def test_a_call_in_a_thread_changes_no_state_of_it(name, tmp_path):
    world, found = World(tmp_path), []

    def call():
        before = state_of_thread()
        CALLS[name](world)
        found.append(changed(before, state_of_thread()))

    thread = threading.Thread(target=call)
    thread.start()
    thread.join()

    assert found == [{}]


@contextlib.contextmanager
def strange_state():
    """Everything that a caller may have set for itself, as unusual as it can be."""
    limit, locale_before = sys.get_int_max_str_digits(), locale.setlocale(locale.LC_ALL)
    decimals, gmp = decimal.getcontext().copy(), gmpy2.get_context().copy()
    errors, printing = np.geterr(), np.get_printoptions()
    try:
        sys.set_int_max_str_digits(640)
        decimal.setcontext(
            decimal.Context(prec=3, rounding=decimal.ROUND_UP, Emax=9, Emin=-9, capitals=0, clamp=1)
        )
        gmpy2.set_context(
            gmpy2.context(
                precision=5, round=gmpy2.RoundUp, rational_division=True, subnormalize=True
            )
        )
        np.seterr(all="raise")
        np.set_printoptions(precision=2)
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            yield
    finally:
        sys.set_int_max_str_digits(limit)
        locale.setlocale(locale.LC_ALL, locale_before)
        decimal.setcontext(decimals)
        gmpy2.set_context(gmp)
        np.seterr(**errors)
        np.set_printoptions(**printing)


def described(value):
    """Return a value as text that shows all of it."""
    if hasattr(value, "to_json"):
        return json.dumps(value.to_json())
    if isinstance(value, (list, tuple)):
        return [described(item) for item in value]
    return pickle.dumps(value) if type(value).__module__ == "numpy" else repr(value)


@every("name", [name for name in CALLS if name not in TIMED])
def test_a_call_does_not_depend_on_the_state_of_its_caller(name, tmp_path):
    world = World(tmp_path)
    expected = described(CALLS[name](world))

    with strange_state():
        found = described(CALLS[name](world))

    assert found == expected


def test_numbers_do_not_depend_on_the_state_of_their_caller():
    third, root = exactpt.AlgebraicNumber("1/3"), exactpt.Polynomial([-2, 0, 1]).roots(0, 2)[0]

    def texts():
        return [
            f"{third:.30f}", f"{root:.40g}", f"{root:.50%}", f"{root:.3f}", str(root), float(root),
            round(root, 30), third / 7, third.decimal(20) if hasattr(third, "decimal") else None,
            exactpt.Body("a", [("1/3", 0)]).at(third, digits=25),
            root + third, -root, root.compare_rational("1.4142"), exactpt.to_datetime("1/3"),
        ]  # fmt: skip

    expected = [repr(text) for text in texts()]
    with strange_state():
        found = [repr(text) for text in texts()]

    assert found == expected


@pytest.mark.parametrize("kind", ["prove", "certify"])
def test_checks_in_threads_have_budgets_of_their_own(kind):
    """Each needs about the same work; a common budget of one and a half is not enough for both."""
    proof = getattr(exactpt, kind)(generate("turning", 3))
    checker = proof_check if kind == "prove" else check_apart
    enough = 10**9
    with checker.budget(enough) as work:
        checker.Scene(proof.scene.decode())
    assert 0 <= work.left < enough
    needed = next(work for work in (10**k for k in range(3, 12)) if accepts(checker, proof, work))
    verdicts = []

    def check():
        verdicts.append(accepts(checker, proof, needed))

    threads = [threading.Thread(target=check) for _ in range(8)]
    limit = sys.get_int_max_str_digits()
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()

    assert verdicts == [True] * 8
    assert sys.get_int_max_str_digits() == limit
    assert not accepts(checker, proof, needed // 10)  # nothing is left of the checks before


def accepts(checker, proof, work):
    """Return True if a checker accepts a proof within a budget, False if that is used up."""
    try:
        return checker.check(proof.scene, proof.text, work).startswith("accepted")
    except checker.Exhausted:
        return False


def test_workers_leave_the_signals_blocked_that_a_caller_has_blocked(tmp_path):
    """The first start of `multiprocessing`'s tracker of resources unblocks SIGINT and SIGTERM."""
    script = f"""
import signal, sys
from pathlib import Path
sys.path[:0] = {[str(Path(public_calls.__file__).parent)]!r}
import public_calls
if __name__ == "__main__":
    blocked = {{signal.SIGINT, signal.SIGTERM}}
    signal.pthread_sigmask(signal.SIG_BLOCK, blocked)
    public_calls.CALLS["batch.run"](public_calls.World(Path({str(tmp_path)!r})))
    print(signal.pthread_sigmask(signal.SIG_BLOCK, []) == blocked)
"""
    (tmp_path / "script.py").write_text(script)
    root = str(Path(exactpt.__file__).parents[1])
    done = subprocess.run(
        [sys.executable, tmp_path / "script.py"], capture_output=True, text=True, check=False,
        env={"PYTHONPATH": root},
    )  # fmt: skip

    assert done.stdout == "True\n", done.stderr


@pytest.mark.skipif(not hasattr(signal, "setitimer"), reason="there are no timers")
def test_a_time_limit_delays_no_timer_of_the_caller():
    """The caller's timer goes on meanwhile; if it is due at the end, it rings at once."""
    rung = []
    before = signal.signal(signal.SIGALRM, lambda *_: rung.append(time.monotonic()))
    try:
        signal.setitimer(signal.ITIMER_REAL, 100)
        with time_limit(50):
            time.sleep(0.2)
        assert 99 < signal.getitimer(signal.ITIMER_REAL)[0] < 99.85

        signal.setitimer(signal.ITIMER_REAL, 0.1)
        with time_limit(50):
            time.sleep(0.3)
            assert rung == []
        time.sleep(0.05)
        assert len(rung) == 1
    finally:
        signal.setitimer(signal.ITIMER_REAL, 0)
        signal.signal(signal.SIGALRM, before)
