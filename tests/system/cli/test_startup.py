"""Processes of commands: what they import, PYTHONOPTIMIZE, signals to workers."""

import json
import os
import pkgutil
import signal
import subprocess
import sys
from pathlib import Path

import pytest

import exactpt
from exactpt import Body, Scene, Translation

SCENE = Path(__file__).parents[2] / "data" / "scenes" / "convex_k100.json"
HEAVY = {"sympy", "matplotlib", "shapely", "dask", "scipy", "pandas", "PIL", "hypothesis", "flint"}


def test_collide_imports_nothing_heavy():
    code = (
        "import json, sys\n"
        "from exactpt.cli import main\n"
        "try:\n"
        f"    main(['collide', {str(SCENE)!r}])\n"
        "except SystemExit as end:\n"
        "    print(json.dumps([end.code, sorted(sys.modules)]))\n"
    )
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    status, modules = json.loads(done.stdout.splitlines()[-1])
    assert status == 0
    assert "gmpy2" in modules
    assert not HEAVY & {name.split(".")[0] for name in modules}
    unasked = ("exactpt.query", "exactpt.tiling.mixed", "exactpt.simulation.saved")
    assert [name for name in modules if name.startswith(unasked)] == []


def test_collide_imports_only_what_the_method_needs():
    code = (
        "import sys, exactpt\n"
        f"exactpt.first_contact(exactpt.Scene.load({str(SCENE)!r}), method='pairs')\n"
        "print([m for m in sys.modules if m.startswith(('exactpt.render', 'exactpt.tiling.mixed',"
        " 'exactpt.tiling.incremental', 'exactpt.cgal', 'exactpt.check', 'numpy.ma.'))])\n"
    )
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert done.stdout.strip() == "[]"


def test_collide_of_two_straight_bodies_imports_neither_numpy_nor_rooms_it_does_not_enter(tmp_path):
    one = Body("one", [(0, 0), (1, 0), (0, 1)], Translation([0, 1]))
    other = Body("other", [(5, -1), (6, -1), (5, 1)])
    path = tmp_path / "two.json"
    path.write_text(json.dumps(Scene([one, other], time=(0, 10)).to_json()), encoding="utf-8")

    code = (
        "import sys\n"
        "from exactpt.cli import main\n"
        "try:\n"
        f"    main(['collide', {str(path)!r}])\n"
        "except SystemExit as end:\n"
        "    print(end.code, *{module.__name__ for module in list(sys.modules.values())})\n"
    )
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)

    status, *modules = done.stdout.splitlines()[-1].split()
    assert status == "0"
    assert "numpy" not in modules
    entered = {name.split(".")[1] for name in modules if name.startswith("exactpt.")}
    rooms = {name for _, name, is_package in pkgutil.iter_modules(exactpt.__path__) if is_package}
    needed = {"cli", "filters", "geometry", "kernel", "motion", "pair", "planar", "scene", "search"}
    assert entered & rooms <= needed


# PYTHONOPTIMIZE, which removes assertions (1) and docstrings (2), changes no answer


def run(level, folder, *arguments):
    done = subprocess.run(
        [sys.executable, "-m", "exactpt", *arguments],
        cwd=folder,
        env={**os.environ, "PYTHONOPTIMIZE": level},
        capture_output=True,
        text=True,
        check=False,
    )
    return done.returncode, done.stdout, done.stderr


@pytest.fixture(scope="module")
def plain(tmp_path_factory):
    folder = tmp_path_factory.mktemp("plain")
    return run("", folder, "demo"), (folder / "exactpt-demo.html").read_bytes()


@pytest.mark.parametrize("level", ["1", "2"])
def test_the_demo_is_the_same(level, plain, tmp_path):
    done = run(level, tmp_path, "demo")

    assert done[0] == 0
    assert (done, (tmp_path / "exactpt-demo.html").read_bytes()) == plain


@pytest.mark.parametrize("level", ["1", "2"])
def test_a_bad_scene_is_refused_in_one_line(level, tmp_path):
    (tmp_path / "bad.json").write_text('{"bodies": [{"outer": [[0, "x"]]}]}')

    status, out, said = run(level, tmp_path, "collide", "bad.json")

    assert (status, out, said.count("\n")) == (2, "", 1)


def test_help_without_docstrings_has_the_options(tmp_path):
    assert "--tiling" in run("2", tmp_path, "collide", "--help")[1]


# Workers never receive Ctrl-C, not even while they import what they need

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
