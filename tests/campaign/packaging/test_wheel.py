"""The wheel and the sdist: built, installed into an empty environment, and used there."""

import importlib.util
import os
import re
import subprocess
import sys
import tarfile
import venv
import zipfile

import checkout
import pytest

pytestmark = [
    pytest.mark.slow,  # it downloads gmpy2, numpy and click, and compiles
    pytest.mark.xdist_group("wheel"),  # built once
]

ROOT = checkout.ROOT


@pytest.fixture(scope="module")
def built(tmp_path_factory):
    """The wheel and the sdist of this checkout, and the files of the package."""
    source = tmp_path_factory.mktemp("source") / "checkout"
    checkout.copy_to(source)
    files = {
        path.relative_to(source).as_posix()
        for path in (source / "exactpt").rglob("*")
        if path.is_file()
    }
    (source / "exactpt" / "compiled.txt").write_text("of a checkout that was compiled")
    subprocess.run([sys.executable, "-m", "build", "-o", source / "dist", source], check=True)
    (wheel,) = source.glob("dist/*.whl")
    (sdist,) = source.glob("dist/*.tar.gz")
    return wheel, sdist, files


def test_nothing_is_left_out(built):
    wheel, sdist, files = built

    with zipfile.ZipFile(wheel) as archive:
        inside = set(archive.namelist())
    with tarfile.open(sdist) as archive:
        names = {name.partition("/")[2] for name in archive.getnames()}

    assert "exactpt/py.typed" in files
    assert files - inside == set()
    assert files - names == set()
    assert not any(name.startswith(("benchmarks/", "fuzz/", "tests/")) for name in inside)
    assert not {"exactpt/compiled.txt"} & (inside | names)
    shipped = {
        path.relative_to(ROOT / "cgal_check").as_posix()
        for path in (ROOT / "cgal_check").rglob("*")
        if path.suffix in {".cpp", ".hpp", ".txt"} and "build" not in path.parts
    }
    assert "proof/verify.cpp" in shipped
    assert {f"exactpt/cgal/sources/{name}" for name in shipped} - inside == set()
    assert {f"cgal_check/{name}" for name in shipped} - names == set()


def test_the_verdict_of_auditwheel(built):
    """The wheel needs nothing but what a manylinux tag promises."""
    if sys.platform != "linux" or built[0].name.endswith("none-any.whl"):
        pytest.skip("no compiled wheel for Linux")
    if importlib.util.find_spec("auditwheel") is None:
        pytest.skip("auditwheel is not installed: pip install --editable . --group release")
    command = [sys.executable, "-m", "auditwheel", "show", built[0]]
    done = subprocess.run(command, capture_output=True, text=True, check=True)
    said = " ".join(done.stdout.split())

    assert re.search(r'consistent with the following platform tag: "manylinux_2_(\d+)_', said), said


@pytest.fixture(scope="module")
def empty(built, tmp_path_factory):
    """A fresh environment with the wheel alone: runs a command of it, beside two scene files."""
    home = tmp_path_factory.mktemp("empty")
    venv.create(home, with_pip=True)
    subprocess.run([home / "bin/python", "-m", "pip", "install", "-q", built[0]], check=True)
    own = ("PYTHON", "EXACTPT_")
    clean = {key: value for key, value in os.environ.items() if not key.startswith(own)}

    def run(*arguments):
        return subprocess.run(
            [home / "bin" / arguments[0], *arguments[1:]],
            cwd=home, env=clean, capture_output=True, text=True, check=False,
        )  # fmt: skip

    run("exactpt", "generate", "row", "-o", "row.json")
    run("exactpt", "convert", "row.json", "row.geojson")
    return run


@pytest.mark.parametrize(
    "line, says",
    [
        ("exactpt --version", "exactpt, version "),
        ("exactpt demo -o demo.html", "first contact at t = 8.693879580404362"),
        ("exactpt generate row -o generated.json", ""),
        ("exactpt collide row.json --json", '"contact"'),
        ("exactpt convert row.json converted.geojson", ""),
        ("exactpt convert row.geojson again.json", "bodies"),
        ("exactpt draw row.json -o row.svg", ""),
        ("python -m exactpt tile row.json", '"faces"'),
    ],
)
def test_it_runs_in_an_empty_environment(empty, line, says):
    done = empty(*line.split())

    assert (done.returncode, done.stderr) == (0, "")
    assert says in done.stdout


@pytest.mark.parametrize(
    "line, extra",
    [
        ("exactpt draw row.json -o row.png", "draw"),
        ("exactpt convert dot.wkt dot.json", "shapely"),
        ("exactpt convert dot.svg dot.json", "svg"),
        ("exactpt draw row.json -o row.gif", "film"),
    ],
)
def test_what_is_missing_is_named(empty, line, extra):
    empty("python", "-c", "open('dot.wkt', 'w').write('POINT (1 2)')")
    empty("python", "-c", "open('dot.svg', 'w').write('<svg/>')")

    done = empty(*line.split())

    assert done.returncode == 2
    assert done.stderr.count("\n") == 1
    assert f"pip install 'exactpt[{extra}]'" in done.stderr


def test_the_missing_checker_is_explained_and_its_sources_are_there(empty):
    done = empty("exactpt", "check", "row.json")
    where = empty("python", "-c", "from exactpt.cgal.build import sources; print(sources())")

    assert done.returncode == 2
    assert "exactpt check --build" in done.stderr
    assert "apt-get install g++ cmake make libcgal-dev nlohmann-json3-dev" in done.stderr
    assert where.stdout.strip().endswith("site-packages/exactpt/cgal/sources")


def test_everything_but_the_optional_can_be_imported(empty):
    code = (
        "import exactpt, pkgutil, importlib\n"
        "for name in exactpt.__all__: getattr(exactpt, name)\n"
        "adapters = {'exactpt.kernel.sympy_adapter', 'exactpt.exchange.shapely_adapter',\n"
        "    'exactpt.testing.strategies'}\n"
        "for m in pkgutil.walk_packages(exactpt.__path__, 'exactpt.'):\n"
        "    if m.name not in adapters | {'exactpt.__main__'}: importlib.import_module(m.name)\n"
    )
    done = empty("python", "-c", code)

    assert (done.returncode, done.stderr) == (0, "")


def test_the_compiled_engine_takes_rules_in_plain_python(empty):
    """tests/helpers/ranked.py, as docs/extending.md promises."""
    code = (
        "import sys\n"
        f"sys.path.append({str(ROOT / 'tests' / 'helpers')!r})\n"
        "from ranked import RANKED, RankedRules\n"
        "from exactpt import Simulation, first_contact\n"
        "from exactpt.testing.scenes import generate\n"
        "from exactpt.tiling import catalogue\n"
        "catalogue.ENTRIES.append(RANKED)\n"
        "ranks = 0\n"
        "for seed in range(5):\n"
        "    scene = generate('stars', seed)\n"
        "    expected, found = (first_contact(scene, tiling=t) for t in ('lazy', 'ranked'))\n"
        "    assert (expected and expected.time) == (found and found.time)\n"
        "    simulation = Simulation(scene, tiling='ranked')\n"
        "    assert type(simulation.kinetic.rules) is RankedRules\n"
        "    for _ in simulation.run():\n"
        "        pass\n"
        "    ranks += simulation.kinetic.stats.events.get('rank', 0)\n"
        "print(ranks > 0)\n"
    )
    done = empty("python", "-c", code)

    assert (done.returncode, done.stdout, done.stderr) == (0, "True\n", "")


def test_newer_sources_are_no_matter_to_an_installed_wheel(empty):
    code = (
        "import exactpt, pathlib\n"
        "for p in pathlib.Path(exactpt.__file__).parent.rglob('*.py'): p.touch()"
    )
    empty("python", "-c", code)

    done = empty("exactpt", "--version")

    assert (done.returncode, done.stderr) == (0, "")
