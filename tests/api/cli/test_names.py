"""Names with commas in options, and names of files as long as they may be."""

import json

import pytest
from commands import code_of

from exactpt import Body, Bounce, InputError, Scene, Simulation, Translation


@pytest.fixture
def folder(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    return tmp_path


@pytest.mark.parametrize(
    "first, second, option",
    [
        ("a", "b", "a,b"),
        ("hull, port", "sail", '"hull, port",sail'),
        ("hull, port", 'the "sail"', '"hull, port","the ""sail"""'),
        (",", ",,", '",",",,"'),
        ('6" gun', "b", '6" gun,b'),
        ("two\nlines", "b", '"two\nlines",b'),
    ],
)
def test_bodies_with_commas_are_ignored(folder, capsys, first, second, option):
    bodies = [Body(first, [(0, 0)], Translation([0, 1])), Body(second, [(2, 0)])]
    Scene([*bodies, Body("wall", [(5, -1), (5, 1)])], (0, 9)).save("scene.json")

    assert code_of("collide", "scene.json", "--method", "pairs", "--ignore", option, "--json") == 0

    assert json.loads(capsys.readouterr().out)["contact"]["time"]["low"] == "5"


@pytest.mark.parametrize("option", ['"a,b', '"a"b,c'])
def test_quotes_that_do_not_match(folder, capsys, option):
    Scene([Body("a", [(0, 0)])]).save("scene.json")

    assert code_of("collide", "scene.json", "--method", "pairs", "--ignore", option) == 2
    assert "--ignore: quotes that do not match" in capsys.readouterr().err


@pytest.mark.parametrize(
    "line",
    [
        "simulate scene.json --events {}.jsonl",
        "tile scene.json -o {}.json",
        "draw scene.json -o {}.html",
        "draw scene.json -o {}.svg",
        "convert scene.json {}.wkt",
        "convert scene.json {}.json",
        "collide scene.json --proof {}.proof",
        "generate convex -o {}.json",
    ],
)
def test_outputs_with_names_of_250_characters(folder, line):
    Scene([Body("a", [(0, 0)])]).save("scene.json")
    name = "x" * (250 - len(line.rpartition("{}")[2]))

    assert code_of(*line.format(name).split()) == 0

    assert sorted(len(path.name) for path in folder.iterdir()) == [10, 250]


def test_a_name_that_is_too_long_is_refused_in_one_line(folder, capsys):
    Scene([Body("a", [(0, 0)])]).save("scene.json")

    assert code_of("tile", "scene.json", "-o", "x" * 300) == 2

    assert capsys.readouterr().err.endswith("x: cannot be written: File name too long\n")


def bouncing():
    ball = Body("ball", [(0, 0), (1, 0), (0, 1)], Translation([0, 1]))
    walls = [Body("west", [(-5, -9), (-5, 9)]), Body("east", [(5, -9), (5, 9)])]
    return Simulation(Scene([ball, *walls], (0, 100)))


def test_a_misspelt_name_that_is_to_be_fixed_is_refused():
    """It was no body, so that the body meant was pushed away."""
    with pytest.raises(InputError, match="Bounce: fixed: there is no body 'esat'"):
        list(bouncing().run(on_contact=Bounce(fixed=["west", "esat"])))


def test_a_fixed_body_may_be_removed_after_a_contact():
    simulation, bounce = bouncing(), Bounce(fixed=["west", "east"])
    list(simulation.run(14, on_contact=bounce))
    contacts = simulation.contacts
    simulation.remove("west")
    simulation.add(Body("far west", [(-50, -9), (-50, 9)]))
    list(simulation.run(on_contact=bounce))

    assert 0 < contacts < simulation.contacts
