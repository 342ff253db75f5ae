"""What the documents tell a reader to type works, and what they point to is there."""

import re
import shlex
import subprocess
import sys
from pathlib import Path

import pytest

from exactpt.cli import main

ROOT = Path(__file__).parents[2]
GALLERY = (ROOT / "docs" / "gallery.md").read_text(encoding="utf-8")
README = (ROOT / "README.md").read_text(encoding="utf-8")


def run(line):
    command, *arguments = shlex.split(line)
    if command == "python":
        done = subprocess.run(
            [sys.executable, *arguments], env={"PYTHONPATH": str(ROOT)}, check=False
        )
        assert done.returncode == 0, line
        return
    with pytest.raises(SystemExit) as left:
        main(arguments)
    assert left.value.code == 0, line


@pytest.mark.parametrize("block", re.findall(r"```sh\n(.*?)```", GALLERY, re.DOTALL))
def test_a_scene_of_the_gallery(block, tmp_path, monkeypatch):
    """The commands run; what they draw of a generated scene is the picture in the gallery.

    (What libraries make of the shapes in files may differ in the last digit.)
    """
    monkeypatch.chdir(tmp_path)
    (tmp_path / "examples").symlink_to(ROOT / "examples")

    for line in block.splitlines():
        run(line)

    (picture,) = tmp_path.glob("*.svg")
    drawn = ROOT / "docs" / "gallery" / picture.name
    same = picture.read_text(encoding="utf-8") == drawn.read_text(encoding="utf-8")
    assert same or "exactpt generate" not in block


def test_the_code_of_the_readme_runs(capsys):
    (code,) = re.findall(r"```python\n(.*?)```", README, re.DOTALL)

    exec(code, {})

    assert capsys.readouterr().out.startswith("5.798402006228018 (")


@pytest.mark.parametrize("page", [ROOT / "README.md", *sorted((ROOT / "docs").glob("*.md"))])
def test_links_lead_somewhere(page):
    for target in re.findall(r"\]\(([^)#]+)\)", page.read_text(encoding="utf-8")):
        if "://" not in target:
            assert (page.parent / target).exists(), target


def test_the_rooms_of_the_readme_are_the_rooms():
    rooms = {p.parent.name for p in (ROOT / "exactpt").glob("*/__init__.py")}

    named = set(re.findall(r"^\| `exactpt/(\w+)` \|", README, re.MULTILINE))

    assert named == rooms
