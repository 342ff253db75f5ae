"""The hooks of .pre-commit-config.yaml pass on the whole repository, and find a bad file."""

import os
import shutil
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
    shutil.copytree(checkout.ROOT / ".mypy_cache", tmp_path / "copy" / ".mypy_cache")
    for command in ("init --quiet", "add --all -- . :!.venv"):
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
    assert done.stdout.count("Passed") == 6


def test_a_bad_file_and_a_bad_workflow_are_found(repository):
    (repository / "exactpt" / "bad.py").write_text("import exactpt.cli\nx:int = 'a'\n")
    (repository / ".github" / "workflows" / "bad.yml").write_text("on: push\njobs: 3\n")
    subprocess.run(["git", "add", "exactpt", ".github"], cwd=repository, check=True)

    done = hooks(repository)

    assert done.returncode == 1
    assert done.stdout.count("Failed") == 6, done.stdout
