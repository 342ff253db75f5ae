"""Documents: what is typed works, and what is pointed to is there."""

import re
import runpy
import tomllib
from pathlib import Path

import pytest
from folding import every

import exactpt
from docs.draw_gallery import blocks, run

ROOT = Path(__file__).parents[2]
README = (ROOT / "README.md").read_text(encoding="utf-8")
ARCHITECTURE = (ROOT / "ARCHITECTURE.md").read_text(encoding="utf-8")
PAGES = [*sorted(ROOT.glob("*.md")), *sorted((ROOT / "docs").rglob("*.md"))]


@pytest.mark.parametrize("block", blocks())
def test_a_scene_of_the_gallery(block, tmp_path):
    """The commands run, and draw a picture that the gallery has (`make pictures` draws it anew)."""
    picture = run(block, tmp_path)

    assert picture.read_text(encoding="utf-8").startswith("<svg")
    assert (ROOT / "docs" / "gallery" / picture.name).is_file()


def test_the_code_of_the_readme_runs(capsys):
    (code,) = re.findall(r"```python\n(.*?)```", README, re.DOTALL)

    exec(code, {})

    (shown,) = re.findall(r"```text\n(.*?)```", README, re.DOTALL)
    assert capsys.readouterr().out == shown


@every("page", PAGES)
def test_links_lead_somewhere(page):
    for target in re.findall(r"\]\(([^)#]+)\)", page.read_text(encoding="utf-8")):
        if "://" not in target:
            assert (page.parent / target).exists(), target


def test_the_packages_of_the_architecture_are_those_of_the_linter():
    contracts = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))
    layers = contracts["tool"]["importlinter"]["contracts"][0]["layers"]
    rows = re.findall(r"^\| ((?:`\w+` ?)+)\|", ARCHITECTURE, re.MULTILINE)
    drawn = [set(re.findall(r"\w+", row)) for row in rows]

    assert drawn == [set(re.findall(r"exactpt\.(\w+)", layer)) for layer in layers]
    packages = {p.parent.name for p in (ROOT / "exactpt").glob("*/__init__.py")}
    assert packages <= set.union(*drawn)


@every("page", [page for page in PAGES if page.name != "CHANGELOG.md"])
def test_paths_of_the_repository_on_pages_exist(page):
    """A page may name files that a diff on it creates, and a folder that the reader chooses."""
    text = page.read_text(encoding="utf-8")
    new = re.findall(r"^--- /dev/null\n\+\+\+ b/(.*)$", text, re.MULTILINE)
    new.append("docs/data/NAME")
    named = re.findall(r"(?<![\w/.-])(?:benchmarks|docs|exactpt|fuzz|tests)/[\w/.-]*\w", text)

    assert [path for path in named if path not in new and not (ROOT / path).exists()] == []


def test_what_the_architecture_names_is_there():
    """Every path is in the repository; every function, class and constant is in some module."""
    path = r"`([\w/]+\.(?:py|md|toml)|(?:exactpt|fuzz|tests)/[\w/]+)`"
    paths = re.findall(path, ARCHITECTURE)
    rest = re.sub(path, "", ARCHITECTURE)
    names = set(re.findall(r"`(?:\w+\.)?(_?[a-zA-Z]\w*)`", rest))
    modules = [*(ROOT / "exactpt").rglob("*.py"), *(ROOT / "fuzz").rglob("*.py")]
    source = "\n".join(module.read_text(encoding="utf-8") for module in modules)

    assert [path for path in paths if not (ROOT / path).exists()] == []
    defined = set(re.findall(r"(?:def |class |^|self\.)(\w+)(?=[(:]| *[:=])", source, re.MULTILINE))
    imported = set(re.findall(r"^from \w+ import (\w+)$", source, re.MULTILINE))
    folders = {p.stem for p in [*ROOT.iterdir(), *(ROOT / "exactpt").iterdir()]}
    assert sorted(names - defined - imported - folders) == []


def test_the_picture_of_a_proof_is_drawn_from_one_that_is_accepted():
    script = runpy.run_path(str(ROOT / "docs" / "draw_proof.py"))
    assert exactpt.prove(script["SCENE"], tiling="lazy").check().startswith("accepted: ")
    assert script["picture"]().startswith("<svg")
