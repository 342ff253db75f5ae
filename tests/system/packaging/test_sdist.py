"""The sdist holds the whole repository; it and the metadata are made without compiling."""

import subprocess
import sys
import tarfile

import checkout
import pytest


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
