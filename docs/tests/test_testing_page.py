"""docs/testing.md: its code prints what it says, and its adapters run."""

import json
import re
import shutil
import subprocess
from pathlib import Path

import pytest
from click.testing import CliRunner

from exactpt.cli import cli
from exactpt.testing import Question, make_question, truths

PAGE = (Path(__file__).parents[2] / "docs" / "testing.md").read_text(encoding="utf-8")


def blocks(language):
    return re.findall(rf"```{language}\n(.*?)```", PAGE, re.DOTALL)


def test_the_tutorial_prints_what_it_says(capsys):
    names = {"__name__": "__main__"}
    printed = []
    for code in blocks("python"):
        exec(code, names)
        if out := capsys.readouterr().out:
            printed.append(out.rstrip() + "\n")

    assert printed == blocks("text")


def test_the_question_and_the_answer_are_those_of_the_family():
    question, answer = map(json.loads, blocks("json")[:2])

    made = make_question("sliding", 0, 1)
    (truth,) = truths([made])
    assert Question.from_json(question).scene == made.scene
    assert answer == {"id": made.name, **truth.to_json()}


NEVER = {
    "toi.js": "module.exports = (a, b, start, end) => null;\n",
    "toi.hpp": (
        "#include <optional>\n"
        "inline std::optional<double> toi(const nlohmann::json&, const nlohmann::json&, double,"
        " double) { return {}; }\n"
    ),
}


def judged(command, folder):
    """The table of a program that never finds a contact."""
    run = CliRunner()
    asked = run.invoke(cli, ["questions", "sliding", "-n", "3"]).stdout
    said = subprocess.run(
        command, cwd=folder, input=asked, capture_output=True, text=True, check=True
    )
    (folder / "answers.jsonl").write_text(said.stdout)
    result = run.invoke(cli, ["judge", str(folder / "answers.jsonl"), "--json"])
    return json.loads(result.stdout)["total"]["missed"]


def test_the_adapter_in_javascript(tmp_path):
    if shutil.which("node") is None:
        pytest.skip("node is not installed")
    (tmp_path / "toi.js").write_text(NEVER["toi.js"])
    (tmp_path / "adapter.js").write_text(blocks("js")[0])

    assert judged(["node", "adapter.js"], tmp_path) == 3


@pytest.mark.cgal  # it needs what cgal_check is built with
def test_the_adapter_in_cpp(tmp_path):
    (tmp_path / "toi.hpp").write_text(NEVER["toi.hpp"])
    (tmp_path / "adapter.cpp").write_text(blocks("cpp")[0])
    build = ["g++", "-std=c++17", "-O0", "adapter.cpp", "-o", "adapter"]
    subprocess.run(build, cwd=tmp_path, check=True)

    assert judged(["./adapter"], tmp_path) == 3
