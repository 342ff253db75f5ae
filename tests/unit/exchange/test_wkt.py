"""Well-known text: structure by shapely, numbers by the text."""

import pytest
import shapely
from folding import every
from hypothesis import given
from hypothesis import strategies as st

from exactpt import Body, InputError, Scene
from exactpt.exchange.bodies import scene_of
from exactpt.exchange.shapes import shapes_at
from exactpt.exchange.wkt import shapes_of, wkt_of
from exactpt.kernel.numbers import QQ, parse_rational

decimals = st.decimals(min_value=-1000, max_value=1000, places=20).map(lambda d: f"{d:f}")


def scene(text, **options):
    return scene_of(shapes_of(text), **options)


@given(st.lists(st.tuples(decimals, decimals), min_size=1, max_size=5, unique=True), st.booleans())
def test_decimals_are_read_as_they_are_written(points, with_height):
    """Twenty decimals, more than the doubles that shapely hands over."""
    height = " 7.25" if with_height else ""
    text = ", ".join(f"({x} {y}{height})" for x, y in points)

    bodies = scene(f"MULTIPOINT {'Z ' if with_height else ''}({text})").bodies

    expected = [[(parse_rational(x), parse_rational(y))] for x, y in points]
    assert [body.at(0) for body in bodies] == expected


def test_several_geometries_of_all_kinds():
    text = """
    POINT (1 2)
    linestring(0 5, 1e0 6.,
               2 .5)
    MULTIPOLYGON (((9 9, 10 9, 9 10, 9 9)), ((20 20, 21 20, 20 21, 20 20)));
    GEOMETRYCOLLECTION (POINT M (30 1 5), LINESTRING M (31 0 5, 32 0 6))
    """

    bodies = scene(text).bodies

    assert [(body.name, body.size, body.closed) for body in bodies] == [
        ("body 0", 1, True),
        ("body 1", 3, False),
        ("body 2", 6, True),
        ("body 3", 1, True),
        ("body 3 2", 2, True),
    ]
    assert bodies[1].at(0) == [(0, 5), (1, 6), (2, QQ(1, 2))]
    assert bodies[4].at(0) == [(31, 0), (32, 0)]


def test_holes_keep_their_own_points():
    text = "MULTIPOLYGON (((0 0, 9 0, 9 9, 0 0), (5 1, 6 1, 6 2, 5 1)), ((20 0, 21 0, 20 1, 20 0)))"
    (whole,) = shapes_of(text)
    first, second = whole.parts

    assert first.holes == [[(5, 1), (6, 1), (6, 2), (5, 1)]]
    assert second.points[0] == (20, 0)
    with pytest.raises(InputError, match="geometry 0, part 0: polygon 'body 0' has 1 hole"):
        scene(text, holes="refuse")
    assert [body.parts for body in scene(text).bodies] == [
        ((range(3), range(3, 6)), (range(6, 9),))
    ]
    assert [body.size for body in scene(text, holes="fill", parts="split").bodies] == [3, 3]


@every(
    "text, message",
    [
        ("POINT EMPTY", "geometry 0: point 'body 0' is empty"),
        ("MULTIPOLYGON EMPTY", "geometry 0: polygon 'body 0' is empty"),
        ("POINT (1 2)\nMULTIPOINT EMPTY", "geometry 1: point 'body 1' is empty"),
        ("POINT (1 2)\nPOLYGON EMPTY", "geometry 1: polygon 'body 1' is empty"),
        ("POINT (1 2)\nCIRCLE (3)", "geometry 1: not well-known text: Unknown type: 'CIRCLE'"),
        ("POLYGON ((0 0, 1 1))", "not well-known text: .*LinearRing"),
        ("LINESTRING (1 2)", "not well-known text: point array"),
        ("CIRCULARSTRING (0 0, 1 1, 2 0)", "shapely reads no curves: 'CIRCULARSTRING'"),
        ("SRID=x;POINT (1 2)", "Unknown type: 'SRID=X;POINT'"),
        ("GEOMETRYCOLLECTION (POINT (1 2), POINT Z (1 2 3))", "points have different numbers"),
        ("POINT (NaN 1)", "a coordinate is not a decimal number"),
        ("POINT (Infinity 1)", "a coordinate is not a decimal number"),
        ("POINT (0x10 1)", "a coordinate is not a decimal number"),
        ("POINT (1e999999999 1)", "geometry 0: exponent beyond 100000: '1e999999999'"),
        ("", "not well-known text"),
    ],
)
def test_what_is_refused(text, message):
    with pytest.raises(InputError, match=message) as refused:
        scene(text)

    assert "\n" not in str(refused.value)


def test_a_number_that_no_double_can_hold():
    assert scene("POINT (1e400 1)").bodies[0].at(0) == [(QQ(10) ** 400, 1)]


def test_written_text_is_what_shapely_reads():
    bodies = [
        Body("a", [(0, 0), ("1/3", 0), (0, 1)]),
        Body("b", [(5, 5), (6, 7)]),
        Body("c", [(-1, "1/7")]),
    ]

    lines = wkt_of(shapes_at(Scene(bodies), QQ(0))).splitlines()

    assert [shapely.from_wkt(line) for line in lines] == [
        shapely.Polygon([(0, 0), (1 / 3, 0), (0, 1)]),
        shapely.LineString([(5, 5), (6, 7)]),
        shapely.Point(-1, 1 / 7),
    ]
