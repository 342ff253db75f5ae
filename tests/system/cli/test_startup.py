"""Nothing is paid for that is not used."""

import json
import subprocess
import sys
from pathlib import Path

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


def test_collide_of_two_straight_bodies_imports_neither_numpy_nor_most_of_the_package(tmp_path):
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
    assert len([name for name in modules if name.split(".")[0] == "exactpt"]) <= 50
