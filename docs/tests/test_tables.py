"""Figures of the pages are those of the files that benchmarks have written (docs/data)."""

import re

import pytest
from folding import every

from docs.make_tables import DOCS, filled, main, named, pages

PAGES = [path for path in pages() if named(path.read_text("utf-8"))]


@every("page", PAGES)
def test_figures_of_a_page_are_those_of_its_files(page):
    text = page.read_text(encoding="utf-8")

    assert filled(text) == text, "run: python docs/make_tables.py"


def test_every_file_of_data_has_a_date_a_commit_and_a_page():
    files = set.union(*(named(page.read_text(encoding="utf-8")) for page in PAGES))

    machines = {path.with_name("machine.txt") for path in files}
    assert files | machines == set((DOCS / "data").glob("*/*"))
    for machine in machines:
        about = machine.read_text(encoding="utf-8")
        assert re.search(
            r"^measured on \d{4}-\d\d-\d\d at commit [0-9a-f]{7,}$", about, re.MULTILINE
        )
        assert "full sizes" in about


@pytest.mark.parametrize(
    "view, lines",
    [
        ("name, count", ["| name | count |", "| --- | ---: |", "| a | 1,234 |", "| b | 0.125 |"]),
        ("name = of, share % = part",
         ["| of | part |", "| --- | ---: |", "| a | 50.0 % |", "| b |  |"]),
        ("name; where count = 0.125 / 7; where name = b", ["| name |", "| --- |", "| b |"]),
        ("name across count, share %", ["| name | 1,234 | 0.125 |", "| --- | ---: | ---: |",
                                    "| a | 50.0 % |  |", "| b |  |  |"]),
        ("name & share across count & name, {count} / {zero}",
         ["| name | share | 1234, a | 0.125, b |", "| --- | ---: | ---: | ---: |",
          "| a | 0.5 | 1,234 / 0 |  |", "| b |  |  | 0.125 / 0 |"]),
        ("name across zero, {zero} / {zero}",
         ["| name | 0 |", "| --- | ---: |", "| a | 0 |", "| b | 0 |"]),
    ],
)  # fmt: skip
def test_a_table_is_made_anew(view, lines, tmp_path, monkeypatch):
    monkeypatch.setattr("docs.make_tables.DOCS", tmp_path)
    folder = tmp_path / "data" / "x"
    folder.mkdir(parents=True)
    (folder / "x.csv").write_text("name,count,share,zero\na,1234,0.5,0\nb,0.125,,0\n")
    (folder / "machine.txt").write_text("P, 2 processors\nbuild\nmeasured on D\nPython 3\nseed 0\n")

    page = filled(f"before\n<!-- table x/x.csv: {view} -->\nold\n<!-- end of table -->\nafter\n")

    assert page.splitlines() == [
        "before", f"<!-- table x/x.csv: {view} -->", *lines, "",
        "Measured on D; build, Python 3, P.", "<!-- end of table -->", "after",
    ]  # fmt: skip


def test_files_that_no_page_names_are_removed(tmp_path, monkeypatch):
    monkeypatch.setattr("docs.make_tables.DOCS", tmp_path / "docs")
    folder = tmp_path / "docs" / "data" / "x"
    folder.mkdir(parents=True)
    (folder / "x.csv").write_text("name,count\na,1234\nb,5\n")
    for name in ("machine.txt", "x.svg", "y.svg", "y.csv"):
        (folder / name).touch()
    begin, end = "<!-- rows x/x.csv: name, count; where name = a -->", "<!-- end of table -->"
    (tmp_path / "README.md").write_text(f"[P](docs/data/x/x.svg)\n{begin}\nold\n{end}\n")

    main()

    text = (tmp_path / "README.md").read_text()
    table = "| name | count |\n| --- | ---: |\n| a | 1,234 |"
    assert text == f"[P](docs/data/x/x.svg)\n{begin}\n{table}\n{end}\n"
    assert {path.name for path in folder.iterdir()} == {"machine.txt", "x.svg", "x.csv"}
