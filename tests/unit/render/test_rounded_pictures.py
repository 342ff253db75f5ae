"""Pictures of rounded bodies: a pen as wide as the body, with round ends and joins."""

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

SCENE = Scene(
    [
        Body("disc", [(0, 0)], Translation([0, 1]), radius="1/2"),
        Body("pill", [(5, -1), (5, 1)], radius=1),
        Body("plate", [(8, 0), (9, 0), (9, 1)], radius="1/4"),
        Body("plain", [(8, 4), (9, 4), (9, 5)]),
    ],
    (0, 10),
)


def test_a_pen_as_wide_as_the_body():
    frame = frame_of(still(SCENE, QQ(0)))
    scale = float(frame.window.scale)
    text = svg_of(frame)

    assert [shape.radius for shape in frame.shapes] == [scale / 2, scale, scale / 4, 0]
    for radius in (scale / 2, scale, scale / 4):
        assert f"stroke-width:{2 * radius:.3f}".rstrip("0").rstrip(".") in text
    assert text.count('class="rounded"') == 3
    assert text.count("stroke-linejoin:round;stroke-linecap:round;vector-effect:none") == 6


def test_everything_is_in_the_window():
    frame = frame_of(still(SCENE, QQ(0)))

    for shape in frame.shapes:
        for x, y in shape.pixels:
            assert shape.radius <= x <= frame.window.width - shape.radius
            assert shape.radius <= y <= frame.window.height - shape.radius


def test_the_contact_is_marked_on_the_boundaries():
    frame = frame_of(still(SCENE, None))
    (mark,) = frame.marks

    assert mark.pixel == frame.window.pixel(QQ(4), QQ(0))
    assert mark.normal == (-1.0, 0.0)
    assert frame.caption == "first contact at t = 7/2"


def test_times_without_a_picture():
    with pytest.raises(TimeRangeError, match="the first contact is at"):
        still(SCENE, QQ(4))
    apart = Scene([SCENE.bodies[0]], (0, 10))
    with pytest.raises(InputError, match="no contact to draw"):
        still(apart, None)
    with pytest.raises(InputError, match="no tiling holds rounded bodies"):
        still(SCENE, QQ(0), tiling="greedy")


def test_the_animation_has_the_radii(tmp_path):
    film = film_of(SCENE)
    data = data_of(film)
    unit = 2.0 ** data["lengthUnit"]

    assert (film.tiling, film.edges, film.tiles, film.end) == ("no", (), (), QQ(7, 2))
    assert [body[4:] for body in data["bodies"]] == [[0.5 / unit], [1 / unit], [0.25 / unit], []]
    assert data["contact"]["pairs"][0]["shift"] == [0.5 / unit, 0.0]
    draw(SCENE, tmp_path / "scene.html")
    assert re.search(r'"pill"', (tmp_path / "scene.html").read_text())


def test_an_animation_without_a_contact():
    film = film_of(Scene(SCENE.bodies[:1], (0, 10)))

    assert (film.steps, film.contact, film.end) == ((), None, 10)
    assert data_of(film)["steps"] == []
