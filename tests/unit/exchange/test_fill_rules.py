"""Fill rules of drawings: which closed subpaths are solid, and which are holes."""

from fractions import Fraction

import pytest

from exactpt import InputError, Scene, Simulation, read_shapes, write_shapes

TWO_ALIKE = "M0 0L100 100L0 100Z M10 30L30 60L10 60Z"
"""Two triangles that turn alike, one in the other: areas 5000 and 300."""
CROSS = "M4 0H6V10H4Z M0 4H10V6H0Z"
"""Two overlapping strokes: of area 20 each, 4 of which they have in common."""
STAR = "M0 -30L18 24L-28 -9H28L-18 24Z"


def drawn(tmp_path, inside):
    file = tmp_path / "drawing.svg"
    file.write_text(f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 100 100">{inside}</svg>')
    return file


def area(tmp_path, inside):
    """The area of all bodies of a drawing, which do not overlap."""
    scene = read_shapes(drawn(tmp_path, inside))
    return sum(shape.area for shape in scene.to_shapely(0).values())


@pytest.mark.parametrize(
    "inside, expected",
    [
        (f'<path d="{TWO_ALIKE}"/>', 5000),
        (f'<path fill-rule="nonzero" d="{TWO_ALIKE}"/>', 5000),
        (f'<path fill-rule="evenodd" d="{TWO_ALIKE}"/>', 4700),
        (f'<path fill-rule=" EvenOdd " d="{TWO_ALIKE}"/>', 4700),
        (f'<path style="fill-rule:evenodd" d="{TWO_ALIKE}"/>', 4700),
        (f'<path style="stroke:red; fill-rule : evenodd ;" d="{TWO_ALIKE}"/>', 4700),
        (f'<path fill-rule="evenodd" style="fill-rule:nonzero" d="{TWO_ALIKE}"/>', 5000),
        (f'<g fill-rule="evenodd"><g><path d="{TWO_ALIKE}"/></g></g>', 4700),
        (f'<g style="fill-rule:evenodd"><path d="{TWO_ALIKE}"/></g>', 4700),
        (f'<g fill-rule="evenodd"><path fill-rule="nonzero" d="{TWO_ALIKE}"/></g>', 5000),
        (f'<style>.o {{fill-rule: evenodd}}</style><path class="o" d="{TWO_ALIKE}"/>', 4700),
        (f'<style>path {{fill-rule: evenodd}}</style><path d="{TWO_ALIKE}"/>', 4700),
        (f'<defs><path id="p" d="{TWO_ALIKE}"/></defs><use href="#p" fill-rule="evenodd"/>', 4700),
        (f'<g fill-rule="evenodd"><path fill-rule="inherit" d="{TWO_ALIKE}"/></g>', 4700),
        (f'<g fill-rule="evenodd"><path style="fill-rule:inherit" d="{TWO_ALIKE}"/></g>', 4700),
        (f'<g fill-rule="evenodd"><path style="fill-rule:initial" d="{TWO_ALIKE}"/></g>', 5000),
        (f'<path style="fill-rule:evenodd!important" d="{TWO_ALIKE}"/>', 4700),
        (f'<path d="{CROSS}"/>', 36),
        (f'<path fill-rule="evenodd" d="{CROSS}"/>', 32),
        ('<polygon points="0,0 4,4 4,0 0,4"/>', 8),
        ('<path d="M0 0L0 100L100 100Z M10 30L30 60L10 60Z" transform="scale(1 -1)"/>', 4700),
    ],
)
def test_area_of_a_path_is_that_of_its_fill_rule(tmp_path, inside, expected):
    """The last one has loops that turn in opposite directions, mirrored: a hole by both rules."""
    assert area(tmp_path, inside) == expected


def test_crossings_of_a_drawing_with_physical_units_are_exact(tmp_path):
    """A unit is 1/3 mm: the strokes of the cross begin at 4/3 mm and end at 2 mm."""
    file = tmp_path / "drawing.svg"
    file.write_text(
        '<svg xmlns="http://www.w3.org/2000/svg" width="10mm" height="10mm" viewBox="0 0 30 30">'
        f'<path d="{CROSS}"/></svg>'
    )

    (body,) = read_shapes(file).bodies

    assert (body.size, body.at(0)[0]) == (12, (Fraction(4, 3), 0))
    assert {x for x, _ in body.at(0)} == {0, Fraction(4, 3), 2, Fraction(10, 3)}


def test_parts_of_one_path_are_bodies_each(tmp_path):
    """By evenodd, the five points of a star meet in single points, and the middle is left out."""
    solid = read_shapes(drawn(tmp_path, f'<path id="star" d="{STAR}"/>')).bodies
    points = read_shapes(drawn(tmp_path, f'<path fill-rule="evenodd" d="{STAR}"/>')).bodies

    assert [body.size for body in solid] == [10]
    assert [body.size for body in points] == [3] * 5


def test_overlapping_elements_stay_bodies_each(tmp_path):
    inside = '<rect width="4" height="4"/><rect x="2" width="4" height="4"/>'

    assert [body.size for body in read_shapes(drawn(tmp_path, inside)).bodies] == [4, 4]


@pytest.mark.parametrize("ring", ["0,0 5,0 5,5 0,5", "5,5 5,0 0,0 0,5", "0,0 2,0 5,0 5,5 0,5"])
@pytest.mark.parametrize("more", ["", "M20 0h3v3z", "M1 1h1v2z M20 0h3v3z"])
def test_an_outline_that_does_not_change_keeps_its_vertices(tmp_path, ring, more):
    """Its first vertex, its orientation and collinear vertices, whatever else the path has."""
    path = f'<path fill-rule="evenodd" d="M{ring.replace(" ", "L")}Z {more}"/>'

    body = read_shapes(drawn(tmp_path, path)).bodies[0]

    given = [tuple(map(int, p.split(","))) for p in ring.split()]
    outline = body.parts[0][0]
    assert [(int(x), -int(y)) for x, y in body.at(0)[outline.start : outline.stop]] == given


def test_a_body_with_parts_and_holes_survives_a_round_trip(tmp_path):
    """As pieces: a hole that touches the outline, an island in a hole."""
    file, back = tmp_path / "a.svg", tmp_path / "b.svg"
    first = drawn(tmp_path, f'<path d="{TWO_ALIKE} M4 12v8l4 -3z" fill-rule="evenodd"/>')
    scene = read_shapes(first)
    write_shapes(scene, file)
    again = read_shapes(file)
    write_shapes(again, back)

    assert [body.at(0) for body in again.bodies] == [body.at(0) for body in scene.bodies]
    assert file.read_text() == back.read_text()


@pytest.mark.parametrize("value", ["even-odd", "odd", "1"])
def test_another_fill_rule_is_refused(tmp_path, value):
    with pytest.raises(InputError, match="fill-rule"):
        read_shapes(drawn(tmp_path, f'<path style="fill-rule:{value}" d="{CROSS}"/>'))


@pytest.mark.parametrize("rule", ["nonzero", "evenodd"])
def test_fill_rule_inherit_is_that_of_the_group(tmp_path, rule):
    own = f'<path fill-rule="{rule}" d="{TWO_ALIKE}"/>'
    inherited = f'<g fill-rule="{rule}"><path fill-rule="inherit" d="{TWO_ALIKE}"/></g>'

    (right,), (found,) = (read_shapes(drawn(tmp_path, d)).bodies for d in (own, inherited))

    assert found.at(0) == right.at(0)


@pytest.mark.parametrize(
    "path, message",
    [
        ("M0 0H5Z", "has no area: remove it"),
        ("M0 0H5H2Z M0 0H9V9Z", "has no area: remove it"),
        ("M0 0H9V9Z M0 0V9H9Z M9 9V0H0Z", None),
        ("M0 0H9V9Z M9 9V0H0Z", "common piece"),
    ],
)
def test_rings_that_fill_nothing_are_refused(tmp_path, path, message):
    """A flat one; not those that cancel out only in part; all that cancel out."""
    file = drawn(tmp_path, f'<path d="{path}"/>')
    if message is None:
        assert len(read_shapes(file).bodies) == 1
        return
    with pytest.raises(InputError, match=message):
        read_shapes(file)
    left = read_shapes(file, skip_invalid=True).bodies
    assert len(left) == path.count("Z") - 1 - ("common" in message)


@pytest.mark.long
def test_many_subpaths_of_one_path_are_read(tmp_path):
    """A thousand rings in each other, by both rules."""
    rings = " ".join(f"M{k} {k}H{2000 - k}V{2000 - k}H{k}Z" for k in range(1000))

    odd = read_shapes(drawn(tmp_path, f'<path fill-rule="evenodd" d="{rings}"/>'))
    solid = read_shapes(drawn(tmp_path, f'<path d="{rings}"/>'))

    assert [len(body.rings) for body in odd.bodies] == [2] * 500
    assert [body.size for body in solid.bodies] == [4]


def test_strokes_that_overlap_are_one_outline(tmp_path):
    """The strokes of a cross have 12 corners together, and no common edges: a tiling exists."""
    (cross,) = read_shapes(drawn(tmp_path, f'<path d="{CROSS}"/>')).bodies

    assert (cross.size, cross.has_rings) == (12, False)
    assert Simulation(Scene([cross], (0, 1))).locate((5, -5)).body == cross.name
