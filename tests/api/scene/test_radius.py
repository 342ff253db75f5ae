"""Radii of bodies: in files, arrays, pickles, shapely geometries."""

import copy
import json
import pickle
from fractions import Fraction

import numpy as np
import pytest
import shapely
from commands import code_of

from exactpt import Body, InputError, Scene, Translation
from exactpt.testing.scenes import ROUNDED, generate

PILL = {"name": "pill", "vertices": [["0", "0"], ["2", "0"]], "radius": "1/2"}


def data(**more):
    return {"exactpt": 1, "time": ["0", "1"], "bodies": [PILL | more]}


def test_a_radius_is_read_and_written():
    scene = Scene.from_json(data())

    assert scene.bodies[0].radius == Fraction(1, 2)
    assert scene.has_radius
    assert scene.to_json()["bodies"][0]["radius"] == "1/2"
    assert Scene.from_json(scene.to_json()) == scene


@pytest.mark.parametrize("zero", ["0", 0, 0.0, "0/3"])
def test_no_radius_is_written_where_it_is_zero(zero):
    scene = Scene.from_json(data(radius=zero))

    assert "radius" not in scene.to_json()["bodies"][0]
    assert not scene.has_radius


@pytest.mark.parametrize(
    "radius, why",
    [
        ("-1/2", '"radius": it is negative: -1/2'),
        (-1, '"radius": it is negative: -1'),
        ("wide", "\"radius\": not a number: 'wide'"),
        (None, '"radius": not a number: null'),
        ([1], "\"radius\": not a number: ['1']"),
        (True, '"radius": not a number: true'),
        ("1/0", "\"radius\": denominator is zero: '1/0'"),
    ],
)
def test_what_is_no_radius_is_refused_in_one_line(tmp_path, capsys, radius, why):
    path = tmp_path / "scene.json"
    path.write_text(json.dumps(data(radius=radius)))
    assert code_of("collide", path) == 2
    assert capsys.readouterr().err == f"exactpt: {path}: body 'pill': {why}\n"


@pytest.mark.parametrize("radius", [-1, "-1/3", float("nan"), "x", None, True, [1]])
def test_what_python_refuses(radius):
    with pytest.raises(InputError, match=r"^body 'b': radius: "):
        Body("b", [(0, 0)], radius=radius)


def test_bodies_with_radii_are_values():
    round_one = Body("b", [(0, 0)], Translation([0, 1]), radius="1/3")

    assert round_one != Body("b", [(0, 0)], Translation([0, 1]))
    assert round_one == Body("b", [(0, 0)], Translation([0, 1]), radius=Fraction(1, 3))
    for twin in (pickle.loads(pickle.dumps(round_one)), copy.deepcopy(round_one)):
        assert twin == round_one
        assert twin.radius == Fraction(1, 3)
    assert round_one.with_motion(Translation()).radius == Fraction(1, 3)
    assert repr(round_one) == "<Body 'b': point of 1 vertex, radius 1/3>"
    assert Scene([round_one]) != Scene([Body("b", [(0, 0)], Translation([0, 1]))])


@pytest.mark.parametrize("family", sorted(ROUNDED))
def test_families_survive_files_and_pickles(family):
    scene = generate(family, 1)

    assert scene.has_radius
    assert Scene.from_json(scene.to_json()) == scene
    assert pickle.loads(pickle.dumps(scene)) == scene


def test_arrays_of_radii():
    corners, offsets = [(0, 0), (5, 0), (7, 0)], [0, 1, 3]
    scene = Scene.from_arrays(corners, offsets, radii=[0.5, 0.0])

    assert [body.radius for body in scene.bodies] == [Fraction(1, 2), 0]
    assert scene.has_radius
    assert pickle.loads(pickle.dumps(scene)) == scene
    assert Scene.from_arrays(corners, offsets, radii=2).bodies[1].radius == 2
    assert not Scene.from_arrays(corners, offsets).has_radius


@pytest.mark.parametrize(
    "radii, why",
    [
        ([1.0], "radii: a number or 2 of them are needed"),
        ([0.0, -1.0], r"radii\[1\]: it is negative: -1.0"),
        (-2, "radii.*: it is negative: -2"),
        ([1.0, np.nan], "radii"),
    ],
)
def test_arrays_that_are_no_radii(radii, why):
    with pytest.raises(InputError, match=why):
        Scene.from_arrays([(0, 0), (5, 0), (7, 0)], [0, 1, 3], radii=radii)


def test_geometries_take_a_radius():
    line = shapely.LineString([(0, 0), (1, 0)])

    assert Body.from_shapely(line, "line", radius="1/7").radius == Fraction(1, 7)
    assert [b.radius for b in Scene.from_shapely([line], radius=2).bodies] == [2]
    assert Body.from_shapely(line, "line").radius == 0
