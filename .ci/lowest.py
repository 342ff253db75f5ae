"""The lowest versions that pyproject.toml allows, as constraints for pip, a line each.

python .ci/lowest.py >constraints.txt
pip install --constraint constraints.txt --editable . --group test
"""

from __future__ import annotations

import tomllib
from itertools import chain
from pathlib import Path

from packaging.requirements import Requirement
from packaging.utils import canonicalize_name
from packaging.version import Version

PYPROJECT = Path(__file__).parents[1] / "pyproject.toml"


def lowest(pyproject: str) -> list[str]:
    """Return ``name==version`` of each package with a lower bound, the same one everywhere.

    Raises:
        ValueError: if a package has two lower bounds (one install could not test both), or
            none at all.
    """
    data = tomllib.loads(pyproject)
    project = data["project"]
    groups = [
        data["build-system"]["requires"],
        project["dependencies"],
        *project["optional-dependencies"].values(),
        *data["dependency-groups"].values(),
    ]
    named = (entry for entry in chain.from_iterable(groups) if isinstance(entry, str))
    bounds: dict[str, Version] = {}
    for requirement in map(Requirement, named):
        name = canonicalize_name(requirement.name)
        if name == canonicalize_name(project["name"]):
            continue
        low = [s.version for s in requirement.specifier if s.operator in (">=", "==")]
        if len(low) != 1:
            raise ValueError(f"{requirement}: not one lower bound")
        if bounds.setdefault(name, Version(low[0])) != Version(low[0]):
            raise ValueError(f"{name}: the lower bounds {bounds[name]} and {low[0]}")
    return [f"{name}=={version}" for name, version in sorted(bounds.items())]


if __name__ == "__main__":
    print("\n".join(lowest(PYPROJECT.read_text(encoding="utf-8"))))
