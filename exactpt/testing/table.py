"""Verdicts, counted by family."""

from __future__ import annotations

from typing import final

from exactpt.brief import counted
from exactpt.testing.comparing import VERDICTS


@final
class Table:
    """How many answers are right, missed, invented, early, late and crashed, by family.

    ``str(table)`` has a line for each family and one for all.

    Attributes:
        rows: by family, the number of answers of each verdict.
    """

    __slots__ = ("rows",)

    def __init__(self) -> None:
        self.rows: dict[str, dict[str, int]] = {}

    def count(self, family: str, verdict: str) -> None:
        """Count one answer."""
        self.rows.setdefault(family, dict.fromkeys(VERDICTS, 0))[verdict] += 1

    @property
    def total(self) -> dict[str, int]:
        """The number of answers of each verdict, in all families."""
        return {v: sum(row[v] for row in self.rows.values()) for v in VERDICTS}

    @property
    def ok(self) -> bool:
        """True if all answers are right."""
        return all(row["right"] == sum(row.values()) for row in self.rows.values())

    def to_json(self) -> dict[str, object]:
        """Return the table as a JSON object."""
        return {"families": {f: dict(row) for f, row in self.rows.items()}, "total": self.total}

    def __repr__(self) -> str:
        total = sum(self.total.values())
        families = counted(len(self.rows), "family")
        return f"<Table: {self.total['right']} of {counted(total, 'answer')} right, {families}>"

    def __str__(self) -> str:
        rows = {**self.rows, "total": self.total}
        width = max(map(len, rows)) + 2
        lines = ["family".ljust(width) + "".join(f"{v:>10}" for v in VERDICTS)]
        for family, row in rows.items():
            lines.append(family.ljust(width) + "".join(f"{row[v]:>10}" for v in VERDICTS))
        return "\n".join(lines)
