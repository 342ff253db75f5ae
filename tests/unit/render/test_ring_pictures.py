"""Pictures of bodies with holes and parts, and of rounded bodies."""

import re

import pytest

from exactpt import Body, InputError, Scene, Translation
from exactpt.errors import TimeRangeError
from exactpt.kernel.numbers import QQ
from exactpt.render.canvas import frame_of
from exactpt.render.data import data_of
from exactpt.render.draw import draw
from exactpt.render.film import film_of
from exactpt.render.still import still
from exactpt.render.svg import svg_of
from exactpt.tiling.start import TILINGS

HOLE = [(1, 1), (9, 1), (9, 9), (1, 9)]
SCENE = Scene(
    [
        Body("frame", parts=[{"vertices": [(0, 0), (10, 0), (10, 10), (0, 10)], "holes": [HOLE]},
                             [(20, 0), (21, 0), (20, 1)]]),
        Body("ball", [(5, 5), (6, 5), (5, 6)], Translation([0, 1])),
        Body("soft", [(30, 0), (40, 0), (40, 9)], holes=[[(36, 1), (39, 1), (39, 3)]],
             radius="1/2"),
    ],
    (0, 10),
)  # fmt: skip


def test_one_path_with_all_rings():
    frame = frame_of(still(SCENE, QQ(0)))
    picture = svg_of(frame)
    outlines = re.findall(r'<path fill="\S+" fill-rule="evenodd" d="(\S+)">', picture)
    assert [(path.count("M"), path.count("L"), path.count("Z")) for path in outlines] == [(3, 8, 3)]
    corners = [tuple(map(float, p.split(","))) for p in re.findall(r"[\d.]+,[\d.]+", outlines[0])]
    assert corners == [pytest.approx(p, abs=0.001) for p in frame.shapes[0].pixels]
    assert picture.count('fill-rule="evenodd"') == 3  # that of the frame, and twice the core


def test_a_name_is_on_the_body_and_not_in_its_hole():
    frame = frame_of(still(SCENE, QQ(0)))
    label, pixels = frame.shapes[0].label, frame.shapes[0].pixels
    (left, _), (right, _) = pixels[4], pixels[5]
    ys = sorted((pixels[4][1], pixels[7][1]))
    assert not (left < label[0] < right and ys[0] < label[1] < ys[1])
    xs = [x for x, _ in pixels]
    assert min(xs) < label[0] < max(xs)


def test_the_edge_that_is_touched_is_marked():
    scene = Scene([SCENE.bodies[0], Body("dot", [(5, 5)], Translation([0], [0, 1]))], (0, 10))
    frame = frame_of(still(scene, None))
    pixels = frame.shapes[0].pixels
    assert frame.marks[0].edge == (pixels[6], pixels[7])
    scene = Scene([SCENE.bodies[0], Body("dot", [(5, 5)], Translation([0, -1]))], (0, 10))
    frame = frame_of(still(scene, None))
    assert frame.marks[0].edge == (frame.shapes[0].pixels[7], frame.shapes[0].pixels[4])


def test_the_animation_knows_the_first_vertex_of_each_ring():
    film = film_of(SCENE)
    data = data_of(film)
    assert [body[5:] for body in data["bodies"]] == [[[0, 4, 8]], [], [[0, 3]]]
    assert film.contact.time == 3
    assert data["contact"]["pairs"][0]["edge"] == [5, 6]


@pytest.mark.parametrize("tiling", TILINGS)
def test_the_tiling_is_drawn_in_the_hole_too(tiling):
    scene = Scene(SCENE.bodies[:2], (0, 10))
    film = film_of(scene, tiling=tiling)
    in_hole = [tile for tile in film.tiles if {4, 5, 6, 7} & {*tile.nodes}]
    assert all({*tile.nodes} <= {4, 5, 6, 7, 11, 12, 13} for tile in in_hole)
    assert {node for tile in in_hole for node in tile.nodes} == {4, 5, 6, 7, 11, 12, 13}
    picture = svg_of(frame_of(still(scene, QQ(1), tiling=tiling)))
    assert picture.count('class="diagonal"') > 4


# Pictures of rounded bodies: a pen as wide as the body, with round ends and joins

ROUNDED = Scene(
    [
        Body("disc", [(0, 0)], Translation([0, 1]), radius="1/2"),
        Body("pill", [(5, -1), (5, 1)], radius=1),
        Body("plate", [(8, 0), (9, 0), (9, 1)], radius="1/4"),
        Body("plain", [(8, 4), (9, 4), (9, 5)]),
    ],
    (0, 10),
)


def test_a_pen_as_wide_as_the_body():
    frame = frame_of(still(ROUNDED, QQ(0)))
    scale = float(frame.window.scale)
    text = svg_of(frame)

    assert [shape.radius for shape in frame.shapes] == [scale / 2, scale, scale / 4, 0]
    for radius in (scale / 2, scale, scale / 4):
        assert f"stroke-width:{2 * radius:.3f}".rstrip("0").rstrip(".") in text
    assert text.count('class="rounded"') == 3
    assert text.count("stroke-linejoin:round;stroke-linecap:round;vector-effect:none") == 6


def test_everything_is_in_the_window():
    frame = frame_of(still(ROUNDED, QQ(0)))

    for shape in frame.shapes:
        for x, y in shape.pixels:
            assert shape.radius <= x <= frame.window.width - shape.radius
            assert shape.radius <= y <= frame.window.height - shape.radius


def test_the_contact_is_marked_on_the_boundaries():
    frame = frame_of(still(ROUNDED, None))
    (mark,) = frame.marks

    assert mark.pixel == frame.window.pixel(QQ(4), QQ(0))
    assert mark.normal == (-1.0, 0.0)
    assert frame.caption == "first contact at t = 3.5"


def test_times_without_a_picture():
    with pytest.raises(TimeRangeError, match="the first contact is at"):
        still(ROUNDED, QQ(4))
    apart = Scene([ROUNDED.bodies[0]], (0, 10))
    with pytest.raises(InputError, match="no contact to draw"):
        still(apart, None)
    with pytest.raises(InputError, match="no tiling holds rounded bodies"):
        still(ROUNDED, QQ(0), tiling="greedy")


def test_the_animation_has_the_radii(tmp_path):
    film = film_of(ROUNDED)
    data = data_of(film)
    unit = 2.0 ** data["lengthUnit"]

    assert (film.tiling, film.edges, film.tiles, film.end) == ("no", (), (), QQ(7, 2))
    assert [body[4:] for body in data["bodies"]] == [[0.5 / unit], [1 / unit], [0.25 / unit], []]
    assert data["contact"]["pairs"][0]["shift"] == [0.5 / unit, 0.0]
    draw(ROUNDED, tmp_path / "scene.html")
    assert re.search(r'"pill"', (tmp_path / "scene.html").read_text())


def test_an_animation_without_a_contact():
    film = film_of(Scene(ROUNDED.bodies[:1], (0, 10)))

    assert (film.steps, film.contact, film.end) == ((), None, 10)
    assert data_of(film)["steps"] == []
