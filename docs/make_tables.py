"""Figures of the pages from the files that benchmarks write: ``python docs/make_tables.py``.

To measure anew: ``python -m benchmarks NAME -o docs/data/NAME``, then this script, in a checkout
without changes of the package. Where machine.txt says "compiled", ``make compiled`` was before;
benchmarks that are shown in both builds have a second folder NAME-compiled.

A page, or README, has on a line of its own ``<!-- table FOLDER/FILE.csv: VIEW -->``; FOLDER is in
docs/data. The lines from there to ``<!-- end of table -->`` are replaced by the table, and by the
date, the commit and the machine of FOLDER/machine.txt (but with ``rows`` for ``table``: where the
page links to a table that has them). Pictures are shown where benchmarks write them. A file of
docs/data that no page names is removed.

VIEW is ``COLUMNS``, separated by commas, or ``ROWS across COLUMNS, CELL``: one line for each value
of the columns ROWS, one column for each value of COLUMNS (each of them one name, or some joined by
``&``). CELL is a column, or a template as ``{seconds}, {error}``. A column with `` %`` after its
name is a share; ``NAME = TITLE`` is a column with a title of its own. ``; where NAME = VALUE /
VALUE`` after a view or a cell selects rows, as often as needed.
"""

from __future__ import annotations

import csv
import re
from pathlib import Path
from typing import Final, TypeAlias

DOCS: Final = Path(__file__).parent
Row: TypeAlias = dict[str, str]

TABLE: Final = re.compile(
    r"(<!-- (table|rows) ([^:\n]+): ([^\n]+) -->\n).*?(<!-- end of table -->)", re.DOTALL
)
PICTURE: Final = re.compile(r"\]\((?:docs/)?data/([^)]+)\)")


def pages() -> list[Path]:
    """Return the pages that may have figures."""
    return [DOCS.parent / "README.md", *sorted(DOCS.rglob("*.md"))]


def filled(page: str) -> str:
    """Return a page with its marked tables made anew."""
    return TABLE.sub(lambda m: f"{m[1]}{_table(m[3], m[4], dated=m[2] == 'table')}\n{m[5]}", page)


def named(page: str) -> set[Path]:
    """Return the files of docs/data that a page names."""
    marked = {m[3] for m in TABLE.finditer(page)}
    return {DOCS / "data" / name for name in (*marked, *PICTURE.findall(page))}


def _selected(path: Path, view: str) -> tuple[str, list[Row]]:
    """Return a view without its conditions, and the rows of a file that satisfy them."""
    with path.open(encoding="utf-8", newline="") as file:
        found = list(csv.DictReader(file))
    view, *conditions = view.split("; where ")
    for condition in conditions:
        column, values = condition.split(" = ")
        found = [row for row in found if row[column] in values.split(" / ")]
    return view, found


def _table(name: str, view: str, *, dated: bool) -> str:
    path = DOCS / "data" / name
    view, found = _selected(path, view)
    lines = _pivot(view, found) if " across " in view else _columns(view, found)
    words = [
        any(cell and not cell[0].isdigit() for cell in line[1:])
        for line in zip(*lines, strict=True)
    ]
    rule = ["---" if left else "---:" for left in words]
    text = [f"| {' | '.join(line)} |" for line in (lines[0], rule, *lines[1:])]
    if dated:
        text += ["", _measured(path.parent / "machine.txt")]
    return "\n".join(text)


def _columns(view: str, found: list[Row]) -> list[list[str]]:
    """Return the title and the cells of each line, one for each row of the file."""
    columns = [column.split(" = ") for column in re.split(r", (?![^{]*\})", view)]
    return [
        [column[-1].removesuffix(" %") for column in columns],
        *([_cell(column[0], row) for column in columns] for row in found),
    ]


def _pivot(view: str, found: list[Row]) -> list[list[str]]:
    """Return the title and the cells of each line, one for each value of some columns."""
    rows, rest = view.split(" across ")
    columns, cell = rest.split(", ", 1)
    index, across = rows.split(" & "), columns.split(" & ")
    lines: dict[tuple[str, ...], dict[str, str]] = {}
    for row in found:
        head = ", ".join(filter(None, (row[name] for name in across)))
        key = tuple(_cell(name, row) for name in index)
        lines.setdefault(key, {})[head] = _cell(cell, row)
    heads = list(dict.fromkeys(head for line in lines.values() for head in line))
    return [
        [*index, *map(_shown, heads)],
        *([*key, *(line.get(head, "") for head in heads)] for key, line in lines.items()),
    ]


def _cell(view: str, row: Row) -> str:
    """Return the text for a column, a share or a template; one 0 where a template has only such."""
    if "{" in view:
        text = re.sub(r"\{([^}]+)\}", lambda m: _cell(m[1], row), view).rstrip(", ")
        return "0" if re.fullmatch(r"0( / 0)*|0.0 %( / 0.0 %)*", text) else text
    return _shown(row[view]) if view in row else _percent(row[view.removesuffix(" %")])


def _measured(path: Path) -> str:
    """Return the sentence about the run that has written a folder."""
    processor, build, commit, *rest = path.read_text(encoding="utf-8").splitlines()
    python = next(line for line in rest if line.startswith("Python")).split(",")[0]
    return f"{commit[0].upper()}{commit[1:]}; {build}, {python}, {processor.split(', ')[0]}."


def _percent(cell: str) -> str:
    return f"{100 * float(cell):.1f} %" if cell else ""


def _shown(cell: str) -> str:
    """Return a number in three digits, one above 1,000 in groups of three, or a text as it is."""
    if re.fullmatch(r"\d+", cell):
        return f"{int(cell):,}"
    try:
        text = f"{float(cell):.3g}"
        return f"{float(text):,.0f}" if abs(float(text)) >= 1000 else text
    except ValueError:
        return cell


def main() -> None:
    """Fill all pages, and remove the files that none of them names."""
    kept = set[Path]()
    for path in pages():
        page = path.read_text(encoding="utf-8")
        if (new := filled(page)) != page:
            path.write_text(new, encoding="utf-8")
        kept |= named(page)
    for path in (DOCS / "data").glob("*/*"):
        if path not in kept and path.name != "machine.txt":
            path.unlink()


if __name__ == "__main__":
    main()
