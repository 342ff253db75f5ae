"""The constraints of `make test-lowest` are the lower bounds of pyproject.toml."""

import re
import runpy
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[3]
PYPROJECT = (ROOT / "pyproject.toml").read_text(encoding="utf-8")
lowest = runpy.run_path(str(ROOT / ".ci" / "lowest.py"))["lowest"]


def project(*requirements, extra=(), group=()):
    lists = f"dependencies = {list(requirements)}\n[project.optional-dependencies]\n"
    groups = f"[dependency-groups]\nall = [{{include-group = 'own'}}]\nown = {list(group)}\n"
    start = '[build-system]\nrequires = ["backend>=3"]\n[project]\nname = "exactpt"\n'
    return f"{start}{lists}extra = {list(extra)}\n{groups}"


def test_every_lower_bound_is_a_constraint():
    named = set(re.findall(r'"([\w-]+)[>=]=([\d.]+)"', PYPROJECT))

    constraints = lowest(PYPROJECT)

    assert {f"{name}=={version}" for name, version in named} == set(constraints)
    assert {line.split("==")[0] for line in constraints} >= {"gmpy2", "numpy", "click", "pytest"}


def test_extras_and_groups_count_and_the_package_itself_does_not():
    given = project("A_b>=1.2", extra=["exactpt[more]", "c==4"], group=["d>=5", "exactpt[extra]"])

    assert lowest(given) == ["a-b==1.2", "backend==3", "c==4", "d==5"]


@pytest.mark.parametrize(
    "given, says",
    [
        (project("a>=1", extra=["a>=2"]), "a: the lower bounds 1 and 2"),
        (project("a>=1", group=["a>=2"]), "a: the lower bounds 1 and 2"),
        (project("a"), "a: not one lower bound"),
        (project("a<2"), "a<2: not one lower bound"),
    ],
)
def test_what_one_install_cannot_test_is_refused(given, says):
    with pytest.raises(ValueError, match=says):
        lowest(given)
