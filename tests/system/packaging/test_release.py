"""What is written about a release agrees with itself; the sdist holds the repository."""

import json
import re
import runpy
import subprocess
import sys
import tarfile
import tomllib
from pathlib import Path

import checkout
import pytest
from packaging.requirements import Requirement
from packaging.utils import canonicalize_name

ROOT = Path(__file__).parents[3]
PROJECT = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))


def test_one_version_and_one_licence():
    project = PROJECT["project"]
    citation = (ROOT / "CITATION.cff").read_text(encoding="utf-8")

    assert re.search(r"^version: (.*)$", citation, re.MULTILINE)[1] == project["version"]
    assert re.search(r"^license: (.*)$", citation, re.MULTILINE)[1] == project["license"]


def test_wheels_are_built_for_the_pythons_that_are_named():
    """Of a Python that is built but not named, the tests have not run on a machine here."""
    named = {
        line.rpartition(" ")[2]
        for line in PROJECT["project"]["classifiers"]
        if re.search(r":: 3\.\d+$", line)
    }
    built = re.findall(r"cp3(\d+)-", PROJECT["tool"]["cibuildwheel"]["build"])

    assert {f"3.{minor}" for minor in built} >= named


def test_fuzzer_is_in_the_repository_and_not_in_the_wheel():
    assert PROJECT["tool"]["setuptools"]["packages"]["find"]["include"] == ["exactpt*"]
    assert (ROOT / "fuzz" / "__main__.py").is_file()
    assert not (ROOT / "exactpt" / "fuzz").exists()


def requirements(*groups):
    """Return the requirements of the package and of groups, the included ones too."""
    found = PROJECT["project"]["dependencies"][:]
    for group in groups:
        for entry in PROJECT["dependency-groups"][group]:
            if isinstance(entry, str):
                found.append(entry)
            else:
                found += requirements(entry["include-group"])
    return found


def test_the_lock_file_has_a_version_that_each_bound_allows():
    lines = (ROOT / ".ci" / "locked.txt").read_text(encoding="utf-8").splitlines()
    locked = dict(line.split("==") for line in lines)

    needed = [r for r in map(Requirement, requirements("dev")) if r.name != "exactpt"]
    assert {"gmpy2", "pytest", "ruff", "mkdocs"} <= {r.name for r in needed}
    for requirement in needed:
        assert locked[canonicalize_name(requirement.name)] in requirement.specifier, requirement
    assert list(locked) == sorted(locked)
    assert "exactpt" not in locked


def test_a_lock_file_is_made_of_a_report_of_pip():
    """The package itself is in a folder, and not locked."""
    given = [("B_b", "2", False), ("exactpt", "0.2.0", True), ("a", "1.0", False)]
    report = {
        "install": [
            {"is_direct": direct, "metadata": {"name": name, "version": version}}
            for name, version, direct in given
        ]
    }
    locked = runpy.run_path(str(ROOT / ".ci" / "lock.py"))["locked"]

    assert locked(json.dumps(report)) == ["a==1.0", "b-b==2"]


WORKFLOWS = sorted((ROOT / ".github" / "workflows").glob("*.yml"))
TARGETS = set(
    re.findall(r"^([a-z-]+):", (ROOT / "Makefile").read_text(encoding="utf-8"), re.MULTILINE)
)


@pytest.mark.parametrize("workflow", WORKFLOWS, ids=lambda path: path.stem)
def test_workflows_run_make_targets_that_there_are(workflow):
    text = workflow.read_text(encoding="utf-8")
    runs = re.findall(r"run: (.*)", text)

    named = {run.split()[1] for run in runs}
    assert all(re.fullmatch(r'make ([a-z-]+|"\$TARGET") PYTHON=python', run) for run in runs)
    if '"$TARGET"' in named:
        lists = re.findall(r"target: \[?([a-z-]+(?:, [a-z-]+)*)", text)
        named = {target for listed in lists for target in listed.split(", ")}
    assert named
    assert named <= TARGETS


def test_workflows_name_all_pythons_for_which_wheels_are_built():
    text = (ROOT / ".github" / "workflows" / "tests.yml").read_text(encoding="utf-8")
    built = re.findall(r"cp3(\d+)-", PROJECT["tool"]["cibuildwheel"]["build"])

    (pythons,) = re.findall(r"python: \[(.*)\]", text)
    assert pythons.replace('"', "").split(", ") == [f"3.{minor}" for minor in built]


# The sdist holds the whole repository; it and the metadata are made without compiling


@pytest.fixture(scope="module")
def source(tmp_path_factory):
    """A copy of the checkout that was compiled, beside a mypyc that cannot be imported."""
    home = tmp_path_factory.mktemp("sdist")
    checkout.copy_to(home / "source")
    (home / "source" / "exactpt" / "compiled.txt").write_text("")
    (home / "source" / "exactpt" / "indices.so").write_text("")
    (home / "path" / "mypyc").mkdir(parents=True)
    (home / "path" / "mypyc" / "__init__.py").write_text("raise SystemExit('compiles')")
    return home


def make(home, *commands):
    return subprocess.run(
        [sys.executable, "-c", "import setup", *commands],
        cwd=home / "source",
        env={"PYTHONPATH": str(home / "path")},
        capture_output=True,
        text=True,
        check=False,
    )


def test_the_sdist_is_the_repository(source):
    done = make(source, "--quiet", "sdist", "--dist-dir", "..")

    assert (done.returncode, done.stdout) == (0, "")
    (made,) = source.glob("*.tar.gz")
    with tarfile.open(made) as archive:
        names = {m.name.partition("/")[2] for m in archive.getmembers() if m.isfile()}
    added = {name for name in names if name.startswith("exactpt.egg-info/")}
    names -= added | {"PKG-INFO", "setup.cfg"}
    assert names >= {
        "Makefile",
        "CHANGELOG.md",
        "benchmarks/__main__.py",
        "fuzz/__main__.py",
        "cgal_check/CMakeLists.txt",
    }
    tracked = checkout.tracked()
    assert tracked is None or names == tracked


def test_metadata_is_made_without_compiling(source):
    done = make(source, "--quiet", "dist_info", "--output-dir", "..")

    assert (done.returncode, done.stdout) == (0, "")
    assert len(list(source.glob("*.dist-info/METADATA"))) == 1


def test_a_wheel_is_not(source):
    assert "compiles" in make(source, "--quiet", "bdist_wheel").stderr
