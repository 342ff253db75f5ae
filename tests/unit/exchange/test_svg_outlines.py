"""SVG in and out: shapes, transforms, holes, chords within the tolerance, refusals."""

import math
from itertools import pairwise

import numpy as np
import pytest
from folding import every
from hypothesis import given
from hypothesis import strategies as st

from exactpt import Body, InputError, Scene
from exactpt.exchange.bodies import scene_of
from exactpt.exchange.lengths import matrix_of
from exactpt.exchange.shapes import shapes_at
from exactpt.exchange.svg import shapes_of, svg_of
from exactpt.kernel.numbers import QQ


def drawing(inside, attributes=""):
    return f'<svg xmlns="http://www.w3.org/2000/svg" {attributes}>{inside}</svg>'


def shapes(inside, attributes="", tolerance=0.1):
    return list(shapes_of(drawing(inside, attributes), tolerance))


def points(inside, attributes="", tolerance=0.1):
    (shape,) = shapes(inside, attributes, tolerance)
    return [(float(x), float(y)) for x, y in shape.points]


def far(p, a, b):
    """The distance of p from the segment ab."""
    p, a, b = complex(*p), complex(*a), complex(*b)
    along = ((p - a) * (b - a).conjugate()).real / (abs(b - a) ** 2 or 1)
    return abs(p - a - min(max(along, 0), 1) * (b - a))


def farthest(curve, corners):
    """The largest distance of many points of a curve from a polyline."""
    pieces = list(pairwise(corners))
    return max(min(far(p, a, b) for a, b in pieces) for p in curve)


small = st.integers(-8, 8)
spots = st.tuples(small, small)
tolerances = st.sampled_from([2.0, 0.5, 0.1, 0.01])


@given(controls=st.lists(spots, min_size=3, max_size=4, unique=True), tolerance=tolerances)
def test_chords_of_a_bezier_curve_stay_within_the_tolerance(controls, tolerance):
    (x, y), *others = controls
    command = "Q" if len(others) == 2 else "C"
    path = f'<path d="M {x} {y} {command} {" ".join(f"{a} {b}" for a, b in others)}"/>'
    n = len(others)

    corners = points(path, tolerance=tolerance)

    def at(t):
        weights = [math.comb(n, k) * t**k * (1 - t) ** (n - k) for k in range(n + 1)]
        return tuple(
            sum(w * p[axis] for w, p in zip(weights, controls, strict=True)) for axis in (0, 1)
        )

    curve = [(a, -b) for a, b in (at(k / 200) for k in range(201))]
    assert farthest(curve, corners) <= tolerance * (1 + 1e-9)
    assert (corners[0], corners[-1]) == ((x, -y), (controls[-1][0], -controls[-1][1]))


@pytest.mark.long
@given(rx=st.integers(1, 9), ry=st.integers(1, 9), turn=st.integers(0, 90), tolerance=tolerances)
def test_chords_of_an_ellipse_stay_within_the_tolerance(rx, ry, turn, tolerance):
    shape = f'<ellipse rx="{rx}" ry="{ry}" transform="rotate({turn})"/>'

    corners = points(shape, tolerance=tolerance)

    around = [k * math.tau / 500 for k in range(500)]
    spin = complex(math.cos(math.radians(turn)), math.sin(math.radians(turn)))
    curve = [complex(rx * math.cos(a), ry * math.sin(a)) * spin for a in around]
    assert farthest([(z.real, -z.imag) for z in curve], [*corners, corners[0]]) <= tolerance * (
        1 + 1e-9
    )


@pytest.mark.parametrize("tolerance", [0.5, 0.1, 0.01, 0.001])
def test_a_circle_takes_as_many_chords_as_it_needs(tolerance):
    """Of radius 1, in quarters: a chord may span an angle of 2 acos(1 - tolerance)."""
    corners = points('<circle r="1"/>', tolerance=tolerance)

    needed = 4 * math.ceil(math.tau / 4 / (2 * math.acos(1 - tolerance)))
    assert len({(round(x, 9), round(y, 9)) for x, y in corners}) == needed


def test_y_points_up_and_a_unit_of_the_view_box_is_a_unit():
    box = 'width="400" height="300" viewBox="-10 5 40 30"'

    assert points('<polygon points="1,2 3,2 3,7"/>', box) == [(1, -2), (3, -2), (3, -7), (1, -2)]


def test_transforms_and_copies():
    inside = """
    <defs><path id="tooth" d="M0 0h1v2z"/></defs>
    <use href="#tooth" x="10"/>
    <g transform="translate(0 5) scale(2)"><use href="#tooth"/></g>
    """

    scene = scene_of(shapes(inside))

    assert [body.name for body in scene.bodies] == ["tooth", "tooth 2"]
    assert scene.bodies[0].at(0) == [(10, 0), (11, 0), (11, -2)]
    assert scene.bodies[1].at(0) == [(0, -5), (2, -5), (2, -9)]


def test_what_is_not_shown_is_no_body():
    inside = """
    <clipPath id="c"><rect width="1" height="1"/></clipPath>
    <defs><rect width="2" height="2"/></defs>
    <path display="none" d="M0 0h1v1z"/>
    <text x="3" y="3">words</text>
    <path id="seen" d="M0 0h1v1z M 5 5"/>
    """

    assert [shape.name for shape in shapes(inside)] == ["seen"]


def test_open_subpaths_are_lines_and_dots_are_points():
    found = shapes('<path id="p" d="M0 0h5 M0 1l1 1l1 -1 M9 9z M3 3 h1 v1 L3 3"/>')

    assert [(s.kind, len(s.points)) for s in found] == [
        ("polygon", 4),
        ("line", 2),
        ("line", 3),
        ("point", 1),
    ]


def test_subpaths_inside_are_holes_and_islands():
    path = '<path id="o" d="M0 0h9v9h-9z M1 1v7h7v-7z M2 2h5v5h-5z M20 0h1v1z"/>'

    found = shapes(path)

    assert [len(shape.holes) for shape in found] == [1, 0, 0]
    with pytest.raises(InputError, match=r"outline 0 \(id o\): polygon 'o' has 1 hole"):
        scene_of(found, holes="refuse")
    assert [len(body.rings) for body in scene_of(found).bodies] == [2, 1, 1]
    assert [body.name for body in scene_of(found, holes="fill").bodies] == ["o", "o 2", "o 3"]


@every(
    "text, message",
    [
        ("<svg", "not XML"),
        ("<html/>", "not a drawing: its first element is html"),
        (drawing('<path d="M 0 0 L 1"/>'), "not a drawing that can be read"),
        (drawing('<rect id="r" width="1e-9" height="1e400"/>'), "not a finite number"),
        (drawing('<circle r="1e9"/>'), "raise the tolerance"),
        (drawing('<path d="M0 0C0 1e9 1e9 0 5 5"/>'), "raise the tolerance"),
        (drawing('<path d="M0 0C0 1e200 1e300 0 5 5"/>'), "raise the tolerance"),
        (drawing('<path d="L0 0L9 0L0 9Z"/>'), "does not begin with a move"),
        (drawing('<rect width="1e300" height="1e308" rx="1e307"/>'), "raise the tolerance"),
        (
            drawing('<g transform="scale(1 2)"><rect width="-1e308" height="4" rx="1"/></g>'),
            "rect: width: it is negative",
        ),
    ],
)
def test_what_is_refused(text, message):
    with pytest.raises(InputError, match=message) as refused:
        scene_of(shapes_of(text, 1e-9))

    assert "\n" not in str(refused.value)


@pytest.mark.parametrize("tolerance", [0, -1, math.nan, math.inf])
def test_the_tolerance_is_positive(tolerance):
    with pytest.raises(InputError, match="the tolerance is a positive number"):
        shapes("", tolerance=tolerance)


def test_there_and_back():
    bodies = [
        Body("a & b", [(0.1, 0.2), (1.7, 0.3), (0.5, 2.9)]),
        Body("open", [(5, 5), (6.1, 7), (8, 7.2)], closed=False),
        Body("dot", [(-1, -1)]),
    ]
    scene = Scene(bodies)

    again = scene_of(shapes_of(svg_of(shapes_at(scene, QQ(0))), 0.1))

    assert again.at(0) == scene.at(0)
    assert [body.closed for body in again.bodies] == [True, False, True]


@pytest.mark.parametrize(
    "transform", ["skewX(-20)", "scale(1 3) rotate(40)", "matrix(2 1 0 1 5 5)"]
)
@pytest.mark.parametrize("turn", [0, 25])
def test_an_ellipse_that_is_sheared_stays_within_the_tolerance(transform, turn):
    """A point p of the image is M q with |q| = 1; chords add an error of at most the tolerance.

    svgelements maps the axes of the ellipse, whose images are not perpendicular: the image had
    a wrong area.
    """
    matrix = np.array(matrix_of(transform, "g")).reshape(3, 2).T
    linear, moved = matrix[:, :2], matrix[:, 2]
    arcs = f'<path d="M1 0A1 1 {turn} 0 1 -1 0A1 1 {turn} 0 1 1 0z" transform="{transform}"/>'

    corners = np.array(points(arcs, tolerance=1e-3)) * (1, -1)

    before = np.linalg.solve(linear, (corners - moved).T)
    assert np.hypot(*before) == pytest.approx(np.ones(len(corners)))
    around = np.array([(math.cos(k / 500), math.sin(k / 500)) for k in range(3142)])
    curve = (around @ linear.T + moved).tolist()
    assert farthest(curve, [*corners.tolist(), corners[0].tolist()]) <= 1e-3 * (1 + 1e-6)


@every(
    "outline, right",
    [
        ('<circle cx="5" cy="5" r="3"/>', [(8, -5), (5, -8), (2, -5), (5, -2)]),
        ('<ellipse cx="0.1" cy="0.7" rx="0.3" ry="0.2"/>',
         [(0.4, -0.7), (0.1, -0.9), (-0.2, -0.7), (0.1, -0.5)]),
        ('<path d="m .1 .2 l .3 0 0 .7 -.3 0 0 -.7 z"/>',
         [(0.1, -0.2), (0.4, -0.2), (0.4, -0.9), (0.1, -0.9)]),
        ('<path transform="rotate(90)" d="m .1 .2 l .3 0 0 .7 -.3 0 0 -.7"/>',
         [(-0.2, -0.1), (-0.2, -0.4), (-0.9, -0.4), (-0.9, -0.1)]),
    ],
)  # fmt: skip
def test_outline_that_returns_to_its_start_has_no_edge_of_rounding(outline, right):
    """By the decimals the last point is the first; in doubles it is beside it by some 1e-16."""
    (body,) = scene_of(shapes_of(drawing(outline), 4.0)).bodies

    assert body.closed
    assert np.array(body.at(0), dtype=float) == pytest.approx(np.array(right), abs=1e-12)


def test_outline_that_ends_near_its_start_keeps_the_edge():
    """The gap of 1e-13 is more than rounding: 3 * 6 * 2**-53 is 2e-15."""
    (body,) = scene_of(shapes_of(drawing('<path d="M0 0H1V1H0V1e-13z"/>'), 0.1)).bodies

    assert [float(y) for _, y in body.at(0)] == [0, 0, -1, -1, -1e-13]


@pytest.mark.parametrize("tolerance", ["wide", None, -(10**1000), [1], object()])
def test_tolerance_that_is_no_positive_number_is_named_in_brief(tolerance):
    with pytest.raises(InputError, match="the tolerance is a positive number") as refused:
        shapes("", tolerance=tolerance)

    assert len(str(refused.value)) < 120


@pytest.mark.parametrize("tolerance", [10**1000, QQ(10**1000, 3), "1e400", 9])
def test_tolerance_beyond_the_doubles_is_a_wide_one(tolerance):
    """Of a circle of radius 3, every chord is within 9: the ends of its four arcs are left."""
    (shape,) = shapes('<circle r="3"/>', tolerance=tolerance)

    assert len(set(shape.points)) == 4
