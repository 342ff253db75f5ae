"""Which files of tests reach a line, according to recorded coverage with contexts."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from functools import cache
from pathlib import Path

import coverage

from exactpt.errors import InputError
from fuzz.power.edits import Lines

__all__ = ["Reached"]


class Reached:
    """Coverage databases, with a context for each test, or each file of tests.

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
            raise InputError(f"{paths[0]}: no contexts; record with --cov-context=test")
        self._owners = cache(self._owners_by_line)

    def _owners_by_line(self, file: str) -> dict[int, set[str]]:
        """Return the files of tests that run each line of a file."""
        found: dict[int, set[str]] = {}
        for data in self._read:
            for path in data.measured_files():
                if not path.endswith(f"/{file}"):
                    continue
                for line, names in data.contexts_by_lineno(path).items():
                    found.setdefault(line, set()).update(map(_owner, names))
        return found

    def among(self, files: Iterable[str], lines: Lines) -> list[str]:
        """Return those of some files of tests that reach a line, or may reach it.

        One that is not in the databases may reach everything.
        """
        owners = self._owners(lines.file)
        reaching = set[str]().union(
            *(owners.get(line, ()) for line in range(lines.first, lines.last + 1))
        )
        return [file for file in files if file in reaching or file not in self.known]


def _read(path: Path) -> coverage.CoverageData:
    if not path.exists():
        raise InputError(
            f"{path}: no such coverage database; record it by pytest --cov-context=test"
        )
    data = coverage.CoverageData(str(path))
    try:
        data.read()
    except coverage.CoverageException as error:
        raise InputError(f"{path}: no coverage database: {error}") from None
    return data


def _owner(context: str) -> str:
    """Return the file of tests of a context: pytest-cov has the test and its phase."""
    return context.split("::", maxsplit=1)[0]
