"""The hooks of .pre-commit-config.yaml pass on the whole repository, and find a bad file."""

import os
import subprocess

import checkout
import pytest

pytestmark = pytest.mark.slow  # they check all types


@pytest.fixture
def repository(tmp_path):
    """A copy of the checkout in git, with the environment that the hooks start programs of."""
    if not (checkout.ROOT / ".venv" / "bin" / "pre-commit").exists():
        pytest.skip("no .venv in the checkout: the hooks run its programs")
    checkout.copy_to(tmp_path / "copy")
    (tmp_path / "copy" / ".venv").symlink_to(checkout.ROOT / ".venv")
    for command in ("init --quiet", "add --all"):
        subprocess.run(["git", *command.split()], cwd=tmp_path / "copy", check=True)
    return tmp_path / "copy"


def hooks(repository):
    return subprocess.run(
        [".venv/bin/pre-commit", "run", "--all-files"],
        cwd=repository,
        env={**os.environ, "PRE_COMMIT_HOME": str(repository.parent / "home")},
        capture_output=True,
        text=True,
        check=False,
    )


def test_all_hooks_pass_on_all_files(repository):
    done = hooks(repository)

    assert done.returncode == 0, done.stdout
    assert done.stdout.count("Passed") == 7


def test_bad_files_are_found(repository):
    """A module: unformatted, below its import, of a wrong type; two workflows; a misspelt word."""
    bad = {
        "exactpt/kernel/bad.py": "import exactpt.scene\nx:int = 'teh'\n",
        ".github/workflows/bad.yml": "on: push\njobs: 3\n",
        ".github/workflows/unpinned.yml": "on: push\npermissions: {}\njobs:\n  a:\n"
        "    runs-on: ubuntu-latest\n    steps:\n      - uses: actions/checkout@main\n",
    }
    for name, text in bad.items():
        (repository / name).write_text(text)
    subprocess.run(["git", "add", *bad], cwd=repository, check=True)

    done = hooks(repository)

    assert done.returncode == 1
    assert done.stdout.count("Failed\n") == 7, done.stdout
