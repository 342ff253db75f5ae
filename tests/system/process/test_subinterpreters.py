"""In a subinterpreter the import is refused in one line, and the main interpreter goes on."""

import subprocess
import sys
from pathlib import Path

import pytest

import exactpt

pytestmark = pytest.mark.long

SEARCH = """
from exactpt import Body, Scene, Translation, first_contact
point = Body("p", [(0, 0)], Translation([0, 1]))
print(first_contact(Scene([point, Body("w", [(2, -1), (2, 1)])], time=(0, 5))).time)
"""
IN_ANOTHER = """
try:
    import exactpt
except ImportError as refusal:
    print(refusal)
"""


@pytest.mark.parametrize("before", ["", SEARCH])
def test_an_import_in_a_subinterpreter_is_refused(before):
    """Without the refusal the process crashed at its end, if exactpt was imported before."""
    script = f"""{before}
try:
    import _interpreters as interpreters
except ImportError:
    import _xxsubinterpreters as interpreters
other = interpreters.create()
interpreters.run_string(other, {IN_ANOTHER!r})
interpreters.destroy(other)
{SEARCH}"""
    root = str(Path(exactpt.__file__).parents[1])
    done = subprocess.run(
        [sys.executable, "-c", script], capture_output=True, text=True, check=False,
        env={"PYTHONPATH": root},
    )  # fmt: skip

    assert done.returncode == 0, done.stderr
    lines = done.stdout.splitlines()
    answers = [line for line in lines if line == "2"]
    refusals = [line for line in lines if line.startswith("exactpt does not support subinterp")]
    assert (len(answers), len(refusals)) == (2 if before else 1, 1)
