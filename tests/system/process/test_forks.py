"""A child that is forked while another thread computes can compute, too."""

import ast
import gc
import os
import signal
import threading
import time
from pathlib import Path

import pytest
from folding import every
from public_calls import CALLS, World

import exactpt
from exactpt.kernel.collection import collector_at_rest

PACKAGE = Path(exactpt.__file__).parent
LIMIT = 20.0
"""Seconds that a child has."""

pytestmark = [
    pytest.mark.long,
    pytest.mark.skipif(not hasattr(os, "fork"), reason="there is no fork"),
]


def result_of_child(job):
    """Return the exit code of a forked child that does a job; None if it hangs."""
    child = os.fork()
    if not child:
        code = 1
        try:
            job()
            code = 0
        finally:
            os._exit(code)
    ends = time.monotonic() + LIMIT
    while time.monotonic() < ends:
        done, status = os.waitpid(child, os.WNOHANG)
        if done:
            return os.waitstatus_to_exitcode(status)
        time.sleep(0.005)
    os.kill(child, signal.SIGKILL)
    os.waitpid(child, 0)
    return None


QUESTIONS = [
    "first_contact", "Clearance", "Surroundings", "contacts", "certify", "ShortestPath", "prove",
    "arrays.first_contacts", "Simulation.tiling", "EnclosedContact",
]  # fmt: skip


@every("name", QUESTIONS)
def test_a_child_computes_while_threads_do_the_same(name, tmp_path):
    world, over = World(tmp_path), threading.Event()
    CALLS[name](world)

    def go_on():
        while not over.is_set():
            CALLS[name](world)

    threads = [threading.Thread(target=go_on) for _ in range(2)]
    for thread in threads:
        thread.start()
    try:
        codes = [result_of_child(lambda: CALLS[name](world)) for _ in range(5)]
    finally:
        over.set()
        for thread in threads:
            thread.join()

    assert codes == [0] * 5


def test_a_child_of_a_computation_without_the_collector_has_it():
    inside, over = threading.Event(), threading.Event()

    def build():
        with collector_at_rest():
            inside.set()
            over.wait()

    thread = threading.Thread(target=build)
    thread.start()
    inside.wait()
    try:
        assert not gc.isenabled()
        assert result_of_child(lambda: gc.isenabled() or os._exit(2)) == 0
    finally:
        over.set()
        thread.join()
    assert gc.isenabled()


def test_a_collector_that_a_caller_has_switched_off_stays_off():
    gc.disable()
    try:
        with collector_at_rest():
            assert result_of_child(lambda: gc.isenabled() and os._exit(2)) == 0
        assert not gc.isenabled()
    finally:
        gc.enable()


HELD_LOCKS = {"exactpt/simulation/running.py"}
"""Modules with a lock: of one simulation, which refuses a second thread and never waits."""


def test_no_module_has_a_lock_that_a_child_could_wait_for():
    """Neither one of its own, nor that of `functools.cached_property` before Python 3.12."""
    waiting = {"Lock", "RLock", "Condition", "Semaphore", "BoundedSemaphore", "Barrier", "Queue"}
    found = set()
    for path in sorted(PACKAGE.rglob("*.py")):
        for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
            if isinstance(node, ast.ImportFrom) and node.module in ("functools", "threading"):
                names = {alias.name for alias in node.names}
                if names & (waiting | {"cached_property", "singledispatch"}):
                    found.add(path.relative_to(PACKAGE.parent).as_posix())
            if isinstance(node, ast.Attribute) and node.attr in waiting | {"cached_property"}:
                found.add(path.relative_to(PACKAGE.parent).as_posix())

    assert found == HELD_LOCKS
