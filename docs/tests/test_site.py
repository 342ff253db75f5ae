"""The site of `make docs`: built without a warning, so that every link leads somewhere."""

import json
import os
import re
import subprocess
import sys
from pathlib import Path

import pytest

import exactpt
from exactpt.cli import all_commands

pytestmark = [pytest.mark.slow, pytest.mark.xdist_group("site")]

ROOT = Path(__file__).parents[2]


@pytest.fixture(scope="module")
def site(tmp_path_factory):
    """The built site; mkdocs.yml is strict about links and anchors."""
    pytest.importorskip("material")
    pytest.importorskip("mkdocstrings")
    place = tmp_path_factory.mktemp("site")
    command = [sys.executable, "-m", "mkdocs", "build", "--site-dir", place]
    done = subprocess.run(
        command, cwd=ROOT, env={**os.environ, "PYTHONPATH": str(ROOT)},
        capture_output=True, text=True, check=False,
    )  # fmt: skip
    assert done.returncode == 0, done.stderr[-3000:]
    return place


def page(site, name):
    return (site / name).read_text(encoding="utf-8")


def test_every_public_name_is_documented_with_its_parameters(site):
    found = re.findall(
        r'href="([^"]+)"[^>]*><code>(\w+)</code>', page(site, "reference/index.html")
    )
    places = {name: link.partition("#") for link, name in found}

    assert set(places) == {*exactpt.__all__}
    for name, (file, _, anchor) in places.items():
        assert not anchor or f'id="{anchor}"' in page(site, f"reference/{file}"), name
    assert "max_memory" in page(site, "reference/simulation.html")


def test_every_room_has_a_page(site):
    rooms = {path.parent.name for path in (ROOT / "exactpt").glob("*/__init__.py")}

    assert {path.stem for path in (site / "reference").glob("*.html")} >= rooms


def test_every_command_has_its_help_on_the_page_of_commands(site):
    text = page(site, "reference/commands.html")

    assert [name for name in all_commands() if f"exactpt {name} [OPTIONS]" not in text] == []


def test_every_page_is_in_the_search_and_in_the_list_for_programs(site):
    index = json.loads(page(site, "search/search_index.json"))
    found = {entry["location"].partition("#")[0] for entry in index["docs"]}
    pages = {path.relative_to(site).as_posix() for path in site.rglob("*.html")}
    films = {name for name in pages if name.startswith(("gallery/", "browser/"))}

    assert pages - films - {"404.html"} <= found
    listed = set(re.findall(r"^- \[.*\]\((.*)\)$", page(site, "llms.txt"), re.MULTILINE))
    assert listed == pages - {"404.html"}


def test_the_scenes_of_the_gallery_move(site):
    frames = re.findall(r'<iframe src="(gallery/\w+\.html)"', page(site, "gallery.html"))

    assert len(frames) == len(set(frames)) > 5
    assert all('id="scrub"' in page(site, frame) for frame in frames)


def test_the_page_for_the_browser_has_its_wheel_and_its_scenes(site):
    settings = json.loads(page(site, "browser/settings.json"))

    assert (site / "browser" / settings["wheel"]).stat().st_size > 100_000
    options = re.findall(r'<option value="([^"]+)"', page(site, "browser/index.html"))
    assert len(options) == 4
    links = re.findall(r'href="(\.\.[^"]+)"', page(site, "browser/index.html"))
    assert len(links) == 2
    assert all((site / "browser" / path).is_file() for path in options + links)


def test_nothing_is_fetched_from_elsewhere(site):
    """No fonts, scripts or styles of other hosts."""
    for path in site.rglob("*.html"):
        text = path.read_text(encoding="utf-8")
        assert re.findall(r'<(?:script|img|iframe)[^>]*src="https?:', text) == [], path
        assert re.findall(r'<link[^>]*rel="(?:stylesheet|preload)"[^>]*href="https?:', text) == []
