"""Shapely geometries and numpy arrays in Python."""

import numpy
import pytest
import shapely

import exactpt
from exactpt.kernel.numbers import QQ


def test_a_body_from_a_geometry_has_the_exact_values_of_its_doubles():
    triangle = shapely.Polygon([(0.1, 0), (1, 0), (0, 1)])

    body = exactpt.Body.from_shapely(triangle, "t", exactpt.Translation([0, 1]))

    assert body.at(2) == [(QQ(*(0.1).as_integer_ratio()) + 2, 0), (3, 0), (2, 1)]


def test_a_body_has_one_part():
    points = shapely.MultiPoint([(0, 0), (1, 1)])

    with pytest.raises(exactpt.InputError, match=r"'m' has 2 parts.*see Scene.from_shapely"):
        exactpt.Body.from_shapely(points, "m")
    with pytest.raises(exactpt.InputError, match="not a shapely geometry: 'POINT"):
        exactpt.Body.from_shapely("POINT (0 0)", "m")


def test_a_scene_from_geometries_and_back():
    ring = shapely.Point(0, 0).buffer(3).difference(shapely.Point(0, 0).buffer(1))
    given = {"ring": ring, "dots": shapely.MultiPoint([(5, 5), (7, 7)])}

    with pytest.raises(exactpt.InputError, match="geometry 0: polygon 'ring' has 1 hole"):
        exactpt.Scene.from_shapely(given, holes="refuse")
    assert exactpt.Scene.from_shapely(given).to_shapely(0)["ring"].equals(ring)
    scene = exactpt.Scene.from_shapely(given, time=(0, 5), holes="fill")
    back = scene.to_shapely(4)

    assert list(back) == ["ring", "dots", "dots 2"]
    assert back["ring"].equals(shapely.Polygon(ring.exterior))
    assert back["dots 2"] == shapely.Point(7, 7)
    assert scene.end == 5


def test_geometries_in_order_are_numbered():
    scene = exactpt.Scene.from_shapely(
        [shapely.box(0, 0, 1, 1), shapely.LineString([(3, 0), (4, 1)])]
    )

    assert [body.name for body in scene.bodies] == ["body 0", "body 1"]
    with pytest.raises(exactpt.InputError, match="t = 2 is outside the time span from 0 to 1"):
        scene.to_shapely(2)


@pytest.mark.parametrize("kind", [float, numpy.float32, int, numpy.int16, object])
def test_vertices_as_an_array(kind):
    array = numpy.array([[0, 0], [1, 0], [1, 3]], dtype=kind)

    assert exactpt.Body("b", array).at(0) == [(0, 0), (1, 0), (1, 3)]


def test_an_array_of_singles_is_exact():
    """A numpy.float32 is no Python float, but it has an exact value all the same."""
    array = numpy.array([[0.1, 0.2]], dtype=numpy.float32)

    (point,) = exactpt.Body("b", array).at(0)

    assert point == tuple(QQ(*float(c).as_integer_ratio()) for c in array[0])
