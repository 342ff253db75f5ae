"""What reaches a line: tests and laws, according to recorded coverage with contexts."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from functools import cache
from pathlib import Path

import coverage

from exactpt.errors import InputError
from fuzz.laws.runner import cases_of, count_of, look
from fuzz.power.edits import Lines

__all__ = ["Reached", "record"]


class Reached:
    """Coverage databases, with a context for each file of tests, each test, or each law.

    They are of the present text of the package: of another one, lines have other numbers.
    """

    def __init__(self, paths: Sequence[Path]) -> None:
        """Read the databases.

        Raises:
            InputError: if one has no contexts.
        """
        self._read = [_read(path) for path in paths]
        self.known = {_owner(name) for data in self._read for name in data.measured_contexts()}
        if paths and self.known <= {""}:
            raise InputError(
                f"{paths[0]}: no contexts; record with --cov-context=test, or --record"
            )
        self._owners = cache(self._owners_by_line)

    def _owners_by_line(self, file: str) -> dict[int, set[str]]:
        """Return the files of tests and the laws that run each line of a file."""
        found: dict[int, set[str]] = {}
        for data in self._read:
            for path in data.measured_files():
                if not path.endswith(f"/{file}"):
                    continue
                for line, names in data.contexts_by_lineno(path).items():
                    found.setdefault(line, set()).update(map(_owner, names))
        return found

    def among(self, names: Iterable[str], lines: Lines) -> list[str]:
        """Return those of some files of tests, or laws, that reach a line, or may reach it.

        One that is not in the databases may reach everything.
        """
        owners = self._owners(lines.file)
        reaching = set[str]().union(
            *(owners.get(line, ()) for line in range(lines.first, lines.last + 1))
        )
        return [name for name in names if name in reaching or name not in self.known]


def _read(path: Path) -> coverage.CoverageData:
    if not path.exists():
        raise InputError(f"{path}: no such coverage database; record it with --record")
    data = coverage.CoverageData(str(path))
    try:
        data.read()
    except coverage.CoverageException as error:
        raise InputError(f"{path}: no coverage database: {error}") from None
    return data


def _owner(context: str) -> str:
    """Return the file of tests, or the law, of a context: pytest-cov has the test and its phase."""
    return context.split("::", maxsplit=1)[0]


def record(laws: Sequence[str], path: Path, tier: str = "full") -> None:
    """Run the cases of a tier of each law under coverage, with a context for each law.

    Args:
        laws: the laws.
        path: the database, which is replaced.
        tier: the tier, of `fuzz.laws.runner.TIERS`.
    """
    measured = coverage.Coverage(data_file=str(path), branch=True, source_pkgs=["exactpt"])
    measured.erase()
    measured.start()
    for law in laws:
        measured.switch_context(law)
        for case in cases_of(law, 0, count_of(law, tier)):
            look(case)
    measured.stop()
    measured.save()
