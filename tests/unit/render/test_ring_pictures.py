"""Pictures of bodies with holes and several parts: all rings in one outline, even-odd."""

import re

import pytest

from exactpt import Body, Scene, Translation
from exactpt.kernel.numbers import QQ
from exactpt.render.canvas import frame_of
from exactpt.render.data import data_of
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
