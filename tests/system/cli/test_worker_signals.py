"""Workers never receive Ctrl-C, not even while they import what they need."""

import os
import signal
import subprocess
import sys

import pytest

PROGRAM = """
import signal
from exactpt.workers.processes import results_of
from exactpt.workers.work import Work

def job(item, tell):
    return signal.SIGINT in signal.pthread_sigmask(signal.SIG_BLOCK, [])

def lost(item, step, why):
    return why

if __name__ == "__main__":
    print(list(results_of(Work(job, lost), iter([1, 2]), 2)))
"""


@pytest.mark.skipif(not hasattr(signal, "pthread_sigmask"), reason="Windows has no masks")
def test_bug_the_first_worker_blocks_interrupts_from_its_start(tmp_path):
    """Python's tracker of resources, started with the first worker, cleared the mask."""
    program = tmp_path / "masks.py"
    program.write_text(PROGRAM)
    done = subprocess.run(
        [sys.executable, program], env=os.environ, capture_output=True, text=True, check=True
    )
    assert done.stdout.strip() == "[True, True]"
