"""The page that runs exactpt in the browser, without one: its files, and what its worker calls."""

import base64
import hashlib
import json
import re
import tomllib
import zipfile
from pathlib import Path

import pytest
from click.testing import CliRunner

from docs.make_page import PAGE, write
from exactpt.cli import browser, cli
from exactpt.errors import AuditError
from exactpt.search.first import METHODS
from exactpt.tiling import catalogue

ROOT = Path(__file__).parents[2]
SCENES = ["demo", "discs", "graze", "near-miss"]


def text_of(name):
    path = PAGE / "scenes" / f"{name}.json"
    return (path if path.is_file() else ROOT / "exactpt" / "data" / "demo.json").read_text()


@pytest.fixture
def run(tmp_path, monkeypatch):
    """Runs a command about a file scene.json; what it prints."""
    monkeypatch.chdir(tmp_path)

    def printed(line, scene):
        Path("scene.json").write_text(scene)
        return CliRunner().invoke(cli, line.split()).stdout

    return printed


def options(name):
    (select,) = re.findall(
        rf'<select id="{name}">(.*?)</select>', (PAGE / "index.html").read_text(), re.DOTALL
    )
    return re.findall(r"<option>(\w+)</option>", select)


def test_the_page_has_its_wheel_and_its_scenes(tmp_path):
    write(tmp_path)

    settings = json.loads((tmp_path / "settings.json").read_text())
    version = tomllib.loads((ROOT / "pyproject.toml").read_text())["project"]["version"]
    assert settings["wheel"] == f"exactpt-{version}-py3-none-any.whl"
    names = zipfile.ZipFile(tmp_path / settings["wheel"]).namelist()
    assert "exactpt/cli/browser.py" in names
    assert not [name for name in names if name.endswith((".so", ".pyd"))]
    found = re.findall(r'<option value="scenes/(.*).json"', (tmp_path / "index.html").read_text())
    assert sorted(found) == SCENES
    for name in found:
        assert (tmp_path / "scenes" / f"{name}.json").read_text() == text_of(name)


def test_nothing_is_loaded_from_elsewhere_but_pyodide():
    files = [path for path in PAGE.iterdir() if path.is_file()]
    addresses = [a for path in files for a in re.findall(r"\w+://[^\s\"'`;]+", path.read_text())]

    assert len(files) == 5
    (pyodide,) = [a for a in addresses if a.count("/") > 2]
    assert re.fullmatch(r"https://cdn\.jsdelivr\.net/pyodide/v[\d.]+/full/", pyodide)
    assert set(addresses) == {
        pyodide, "https://cdn.jsdelivr.net", "https://pypi.org", "https://files.pythonhosted.org"
    }  # fmt: skip


def test_the_policy_runs_the_script_of_animations_and_no_other_text():
    (policy,) = re.findall(
        r'http-equiv="Content-Security-Policy" content="(.*?)"', (PAGE / "index.html").read_text()
    )
    rules = {name: values.split() for name, _, values in
             (rule.strip().partition(" ") for rule in policy.split(";"))}  # fmt: skip
    page = json.loads(browser.picture(text_of("graze"), "auto"))["page"]
    (script,) = re.findall(r"<script>(.*?)</script>", page, re.DOTALL)
    found = base64.b64encode(hashlib.sha256(script.encode()).digest()).decode()

    assert rules["default-src"] == ["'none'"]
    assert rules["script-src"] == ["'self'", "blob:", "'wasm-unsafe-eval'", f"'sha256-{found}'"]
    assert rules["worker-src"] == ["'self'", "blob:"]
    assert rules["base-uri"] == rules["form-action"] == ["'none'"]


def test_each_file_of_the_core_of_pyodide_has_its_hash():
    hashes = json.loads((PAGE / "settings.json").read_text())["integrity"]

    assert set(hashes) == {
        "pyodide.mjs", "pyodide.asm.mjs", "pyodide.asm.wasm", "python_stdlib.zip",
        "pyodide-lock.json",
    }  # fmt: skip
    assert all(re.fullmatch(r"sha384-[A-Za-z0-9+/]{64}", value) for value in hashes.values())


def test_all_methods_and_tilings_can_be_chosen():
    assert sorted(options("method")) == sorted(METHODS)
    assert options("tiling") == catalogue.known()


@pytest.mark.parametrize("name", SCENES)
@pytest.mark.parametrize(
    "method, tiling", [("auto", "auto"), ("pairs", "auto"), ("kinetic", "lazy")]
)
def test_answers_are_those_of_the_command(run, name, method, tiling):
    scene = text_of(name)
    line = f"collide scene.json --method {method} --tiling {tiling}"

    answer = json.loads(browser.answer(scene, method, tiling))

    if "error" in answer:
        assert (name, method) == ("discs", "kinetic")
        assert answer["error"].startswith("exactpt: body 'sun' has a radius: no tiling")
    else:
        assert f"{answer['words']}\n" == run(line, scene)
        assert f"{answer['json']}\n" == run(f"{line} --json", scene)


def test_a_graze_and_a_near_miss_of_it():
    graze, miss = (json.loads(browser.answer(text_of(n), "auto", "auto")) for n in SCENES[2:])

    assert json.loads(graze["json"])["contact"]["time"]["polynomial"] == ["-3", "0", "1"]
    assert json.loads(miss["json"])["contact"] is None


@pytest.mark.parametrize("name", ["demo", "discs"])
def test_the_animation_is_that_of_the_command(run, name):
    scene = text_of(name)

    run("draw scene.json -o scene.html", scene)

    assert json.loads(browser.picture(scene, "auto")) == {"page": Path("scene.html").read_text()}


@pytest.mark.parametrize(
    "scene, says",
    [
        ("", "exactpt: not JSON: "),
        ("[1", "exactpt: not JSON: "),
        ("[" * 100_000, "exactpt: "),
        ('{"exactpt": 1, "time": [0, 1]}', 'exactpt: scene: the key "bodies" is missing'),
        ('{"exactpt": 1, "time": [1, 0], "bodies": []}', "exactpt: "),
        ('{"exactpt": 1, "time": [0, 1], "bodies": [{"name": "\\u001b"}]}', "exactpt: "),
    ],
)  # fmt: skip
def test_bad_input_gets_one_line(scene, says):
    for reported in (browser.answer(scene, "auto", "auto"), browser.picture(scene, "auto")):
        error = json.loads(reported)["error"]
        assert error.startswith(says)
        assert error.isprintable()


def test_a_bug_is_told_as_one(monkeypatch, capsys):
    def broken(*_):
        raise AuditError("the mesh is torn")

    monkeypatch.setattr(browser, "search_for", broken)

    error = json.loads(browser.answer(text_of("graze"), "auto", "auto"))["error"]

    assert error == (
        "exactpt: an invariant broke: the mesh is torn; "
        "this is a bug in exactpt; please report it with the scene"
    )
    assert "AuditError: the mesh is torn" in capsys.readouterr().err
