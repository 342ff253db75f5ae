"""Tables of the pages from the files that benchmarks write: ``python docs/make_tables.py``.

A page has, on a line of its own, ``<!-- table FOLDER/FILE.csv: VIEW -->``; FOLDER is in docs/data
and was the output of ``python -m benchmarks NAME -o docs/data/FOLDER``. The lines from there to
``<!-- end of table -->`` are replaced by the table, and by the date, the commit and the machine of
FOLDER/machine.txt. VIEW names columns, or is ``ROWS by COLUMNS, VALUE``: one line for each value of
the column ROWS, one column for each of COLUMNS. A column with `` %`` after its name is a share.
"""

from __future__ import annotations

import csv
import re
from pathlib import Path
from typing import Final

DOCS: Final = Path(__file__).parent
MARKED: Final = re.compile(
    r"(<!-- table ([^:\n]+): ([^\n]+) -->\n).*?(<!-- end of table -->)", re.DOTALL
)


def filled(page: str) -> str:
    """Return a page with its marked tables made anew."""
    return MARKED.sub(lambda m: f"{m[1]}{_table(m[2], m[3])}\n{m[4]}", page)


def _table(name: str, view: str) -> str:
    path = DOCS / "data" / name
    with path.open(encoding="utf-8", newline="") as file:
        found = list(csv.DictReader(file))
    if " by " in view:
        index, rest = view.split(" by ")
        across, value = rest.split(", ")
        share = value.endswith(" %")
        columns = [index, *dict.fromkeys(row[across] for row in found)]
        lines: dict[str, dict[str, str]] = {}
        for row in found:
            cell = _percent(row[value[:-2]]) if share else row[value]
            lines.setdefault(row[index], {index: row[index]})[row[across]] = cell
        rows = list(lines.values())
    else:
        columns, rows = view.split(", "), found
    cells = [columns, *([_shown(row.get(column, "")) for column in columns] for row in rows)]
    words = [
        any(cell and not cell[0].isdigit() for cell in line[1:])
        for line in zip(*cells, strict=True)
    ]
    rule = ["---" if left else "---:" for left in words]
    text = [f"| {' | '.join(line)} |" for line in (cells[0], rule, *cells[1:])]
    return "\n".join([*text, "", _measured(path.parent / "machine.txt")])


def _measured(path: Path) -> str:
    """Return the sentence about the run that has written a folder."""
    processor, build, commit, *rest = path.read_text(encoding="utf-8").splitlines()
    python = next(line for line in rest if line.startswith("Python")).split(",")[0]
    return f"{commit[0].upper()}{commit[1:]}; {build}, {python}, {processor.split(', ')[0]}."


def _percent(cell: str) -> str:
    return f"{100 * float(cell):.1f} %" if cell else ""


def _shown(cell: str) -> str:
    """Return a number in three digits, an integer in groups of three, or a text as it is."""
    if re.fullmatch(r"\d+", cell):
        return f"{int(cell):,}"
    try:
        return f"{float(cell):.3g}"
    except ValueError:
        return cell


def main() -> None:
    """Fill the tables of all pages."""
    for path in sorted(DOCS.rglob("*.md")):
        page = path.read_text(encoding="utf-8")
        if (new := filled(page)) != page:
            path.write_text(new, encoding="utf-8")


if __name__ == "__main__":
    main()
