"""A still as SVG: well-formed, with every body and every tile where it is."""

import re
import xml.etree.ElementTree as ET
from dataclasses import replace
from itertools import pairwise
from pathlib import Path

import pytest
from render_scenes import apart, demo, overlapping, small

from exactpt import Body, InputError, Scene, Translation
from exactpt.kernel.numbers import QQ
from exactpt.render.canvas import arrow_boxes, frame_of
from exactpt.render.draw import draw
from exactpt.render.film import film_of
from exactpt.render.page import page_of
from exactpt.render.still import still
from exactpt.render.svg import svg_of
from exactpt.simulation.tile import tile_at

SVG = "{http://www.w3.org/2000/svg}"


def group(root, name):
    return next(g for g in root.iter(f"{SVG}g") if g.get("class") == name)


def points(element):
    return [tuple(map(float, p.split(","))) for p in element.get("points").split()]


def drawn(scene, at, *, tiling="auto", theme="auto"):
    frame = frame_of(still(scene, at, tiling=tiling))
    return frame, ET.fromstring(svg_of(frame, theme=theme))


@pytest.mark.parametrize("scene, tiling", [(small(), "auto"), (apart(), "auto"), (demo(), "lazy")])
@pytest.mark.parametrize("at", [QQ(0), QQ(5, 2)])
def test_bodies_and_tiles_are_where_they_are(scene, tiling, at):
    frame, root = drawn(scene, at, tiling=tiling)
    snapshot = tile_at(scene, at, tiling=tiling, by_running=True)
    pixels = [frame.window.pixel(node.x, node.y) for node in snapshot.nodes]

    shapes = list(group(root, "bodies"))
    assert [shape.find(f"{SVG}title").text for shape in shapes] == [b.name for b in scene.bodies]
    where = iter(pixels)
    for shape, body in zip(shapes, scene.bodies, strict=True):
        here = [next(where) for _ in range(body.size)]
        found = (
            [(float(shape.get("cx")), float(shape.get("cy")))]
            if body.size == 1
            else (points(shape))
        )
        assert found == [pytest.approx(p, abs=1e-3) for p in here]

    tiles = [points(tile) for tile in group(root, "tiles")]
    assert len(tiles) == len(snapshot.faces)
    for tile, face in zip(tiles, snapshot.faces, strict=True):
        assert tile == [pytest.approx(pixels[v], abs=1e-3) for v in face.nodes]

    lines = [e for e in snapshot.edges if e.hull or e.kind == "diagonal"]
    assert len(list(group(root, "lines"))) == len(lines)
    assert len(list(group(root, "contact"))) == 0


def test_everything_is_inside_the_picture():
    frame, _ = drawn(demo(), QQ(7))
    for shape in frame.shapes:
        for x, y in (*shape.pixels, *([shape.label] if shape.label else [])):
            assert 0 < x < frame.window.width
            assert 0 < y < frame.window.height


def test_no_name_is_larger_than_its_body():
    """Squares of 26 and of 13 pixels: names of three letters fit into the former at most."""
    squares = [
        Body(name, [(x, 0), (x + side, 0), (x + side, side), (x, side)])
        for name, x, side in (("s00", 0, 26), ("longer", 60, 26), ("m00", 120, 10))
    ]
    points = [Body("over", [(200, 2)]), Body("lone", [(300, 0)]), Body("beside", [(205, 10)])]
    frame, root = drawn(Scene([*squares, *points, Body("end", [(760, 0)])], (0, 1)), QQ(0))

    shown = {shape.name for shape in frame.shapes if shape.label is not None}
    assert shown == {"s00", "lone", "beside", "end"}
    assert {text.text for text in group(root, "names")} == shown


def test_a_name_stands_on_its_body():
    frame, _ = drawn(demo(), QQ(0))
    harbour = frame.shapes[0]
    x, y = harbour.label
    ring = [*harbour.pixels, harbour.pixels[0]]
    crossed = [
        (py <= y) != (qy <= y) and px + (y - py) * (qx - px) / (qy - py) < x
        for (px, py), (qx, qy) in pairwise(ring)
    ]
    assert sum(crossed) % 2 == 1


def test_the_contact_is_said_and_marked():
    frame, root = drawn(small(), None)
    assert frame.caption == "first contact at t = 3"
    # The corners of the box meet the inside of an edge of the wall.
    assert frame.news == "vertex 1 of box on edge 3 of wall, vertex 2 of box on edge 3 of wall"
    assert len(group(root, "contact").findall(f"{SVG}circle")) == 4
    assert frame.marks[0].pixel == frame.shapes[0].pixels[1]
    assert frame.marks[0].normal == (-1.0, 0.0)


def test_two_edges_in_one_place_are_marked():
    square = [(0, 0), (1, 0), (1, 1), (0, 1)]
    right = [(5, 0), (6, 0), (6, 1), (5, 1)]
    corner = [(9, 1), (9, 2), (8, 1)]  # its edges from (9, 1) lie on none
    bodies = [Body("a", square, Translation([0, 1], [0])), Body("b", right), Body("c", corner)]
    bodies.append(Body("d", [(13, -1), (13, 1), (14, 0)], Translation([0, -1], [0])))
    frame = frame_of(still(Scene(bodies, time=(0, 9)), None))

    (x, low), (_, high) = (frame.shapes[1].pixels[i] for i in (0, 3))
    marked = [tuple(sorted(mark.edge)) if mark.edge else None for mark in frame.marks]
    assert marked == [((x, high), (x, low))] * 2 + [None]


def test_the_contact_at_an_irrational_time():
    frame, root = drawn(demo(), None)
    assert frame.news == "vertex 0 of boat on edge 6 of harbour"
    (mark,) = frame.marks
    (x1, y1), (x2, y2) = mark.edge
    x, y = mark.pixel
    assert (x2 - x1) * (y - y1) - (y2 - y1) * (x - x1) == pytest.approx(0, abs=1e-9)
    assert len(list(group(root, "tiles"))) > 0


def test_bodies_that_overlap_at_the_start():
    frame, root = drawn(overlapping(), None)
    assert frame.caption == "first contact at t = 0"
    assert len(list(group(root, "bodies"))) == 2
    assert len(list(group(root, "tiles"))) == 0


def test_tiles_of_f1_have_the_colour_of_their_body_by_level():
    picture = still(small(), QQ(0))
    first, *others = picture.tiling.faces
    face = replace(first, region="F1", body="wall", level=2)
    tiling = replace(picture.tiling, faces=(face, *others))
    frame = frame_of(replace(picture, tiling=tiling))
    tile, *rest = group(ET.fromstring(svg_of(frame)), "tiles")
    assert tile.get("fill") == frame.shapes[1].colour
    assert tile.get("fill-opacity") == "0.4"
    assert all(other.get("class").startswith("t") for other in rest)


@pytest.mark.parametrize("theme", ["auto", "light", "dark"])
def test_themes_do_not_meet_in_one_document(theme):
    _, root = drawn(small(), QQ(0), theme=theme)
    assert root.get("class") == f"exactpt-{theme}"
    style = root.find(f"{SVG}style").text.replace("@media (prefers-color-scheme:dark){", "")
    rules = [rule for rule in style.split("}") if rule]
    assert all(rule.startswith(f".exactpt-{theme} ") for rule in rules)


@pytest.mark.parametrize(
    "at, message",
    [
        (QQ(11), "outside the time span from 0 to 10"),
        (QQ(4), "nothing to draw at t = 4: the first contact is at t = 3.0"),
    ],
)
def test_no_picture_of_what_is_not_known(at, message):
    with pytest.raises(InputError, match=message):
        still(small(), at)
    with pytest.raises(InputError, match="no contact to draw"):
        still(apart(), None)


@pytest.mark.parametrize(
    "ask",
    [
        lambda _: tile_at(small(), QQ(11)),
        lambda _: tile_at(small(), QQ(4)),
        lambda _: still(small(), QQ(11)),
        lambda _: still(small(), QQ(4)),
        lambda folder: draw(small(), folder / "film.html", at=QQ(11)),
    ],
)
def test_the_library_names_no_option_of_a_command(ask, tmp_path):
    with pytest.raises(InputError, match=r"t = \d+") as refused:
        ask(tmp_path)

    assert "--" not in str(refused.value)


def test_the_picture_in_the_docs_is_that_of_the_demo():
    kept = Path(__file__).parents[3] / "docs" / "first-contact.svg"
    fresh = svg_of(frame_of(still(demo(), None)))
    assert kept.read_text(encoding="utf-8") == fresh, "draw it anew: make pictures"


def test_endings(tmp_path):
    with pytest.raises(InputError, match="ends in one of"):
        draw(small(), tmp_path / "picture.jpg")
    draw(small(), tmp_path / "picture.SVG", at="contact")
    assert ET.parse(tmp_path / "picture.SVG").getroot().tag == f"{SVG}svg"
    assert [p.name for p in tmp_path.iterdir()] == ["picture.SVG"]


def test_png(tmp_path):
    pytest.importorskip("resvg_py")
    draw(small(), tmp_path / "picture.png", theme="dark")
    data = (tmp_path / "picture.png").read_bytes()
    assert data.startswith(b"\x89PNG")
    frame, root = drawn(small(), QQ(0))
    width, height = int.from_bytes(data[16:20]), int.from_bytes(data[20:24])
    assert (width, height) == (2 * frame.window.width, 2 * int(root.get("height")))


def test_png_without_its_library(tmp_path, monkeypatch):
    monkeypatch.setitem(__import__("sys").modules, "resvg_py", None)
    with pytest.raises(InputError, match=r"pip install 'exactpt\[draw\]'"):
        draw(small(), tmp_path / "picture.png")
    assert list(tmp_path.iterdir()) == []


def moving_and_still():
    box = [(0, 0), (2, 0), (2, 1), (0, 1)]
    return Scene(
        [Body("robot", box, Translation([0, 1])), Body("wall", [(8, -1), (8, 9)])], time=(0, 5)
    )


def text_of(scene, tmp_path, **options):
    path = tmp_path / "picture.svg"
    scene.draw(path, **options)
    return path.read_text()


def test_poses_and_paths_of_the_bodies_that_move(tmp_path):
    text = text_of(moving_and_still(), tmp_path, poses=3, tiling=None)

    ghosts = text.partition('<g class="ghosts bodies">')[2].partition("</g>")[0]
    assert ghosts.count("<title>robot</title>") == 3
    assert "wall" not in ghosts
    path = text.partition('<g class="paths">')[2].partition("</g>")[0]
    assert len(path.split('points="')[1].split('"')[0].split()) == 17  # 8 steps between two poses
    assert '<g class="tiles">\n</g>' in text
    assert "tiling" not in text.partition('class="note"')[2].partition("<")[0]


def test_a_legend_has_names_and_a_scale_bar(tmp_path):
    text = text_of(moving_and_still(), tmp_path, legend=True)

    legend = text.partition('<g class="legend">')[2].partition("</g>")[0]
    assert ("robot" in legend, "wall" in legend) == (True, True)
    bar = re.search(r'class="bar" d="M[\d.]+ \d+v6h([\d.]+)v-6"/>\n<text [^>]*>(\w+)<', text)
    assert bar[2] == "2"
    assert 80 < float(bar[1]) <= 160
    crowd = Scene([Body(f"p{i}", [(i, i % 7)]) for i in range(60)])
    assert re.search(r"and \d+ more<", text_of(crowd, tmp_path, legend=True))


@pytest.mark.parametrize("size", ["1/1000", 7, 10**9])
def test_scale_bars_of_any_size(size, tmp_path):
    text = text_of(Scene([Body("a", [(0, 0), (size, 0)])]), tmp_path, legend=True)

    pixels, words = re.search(r'v6h([\d.]+)v-6"/>\n<text [^>]*>([^<]+)<', text).groups()
    assert 64 - 1e-6 <= float(pixels) <= 160
    assert words.replace("e-05", "").lstrip("0.")[0] in "125"


@pytest.mark.parametrize(
    "options, message",
    [
        ({"legend": True, "gap": ("robot", "wall")}, "are for a picture of bodies"),
        ({"poses": -1}, "poses: not a number of them: -1"),
        ({"below": 1}, "below: 1 is for a plot of the clearance"),
        ({"below": -1, "gap": ("robot", "wall")}, "below: a distance is not negative: -1"),
    ],
)
def test_options_that_do_not_go_together(options, message, tmp_path):
    with pytest.raises(InputError, match=message):
        moving_and_still().draw(tmp_path / "x.svg", **options)


def test_a_name_is_beside_the_arrow_of_a_contact():
    """The arrow would go through the name in the middle of the diamond."""
    diamond = [(0, -1), (1, 0), (0, 1), (-1, 0)]
    bodies = [
        Body("diamond", diamond, Translation([-8, 1])),
        Body("wall", [(1, -6), (1, 6)]),
    ]
    frame = frame_of(still(Scene(bodies, time=(0, 9)), None))
    (mark,) = frame.marks
    label = next(shape.label for shape in frame.shapes if shape.name == "diamond")

    assert label is not None
    for left, top, right, bottom in arrow_boxes(mark):
        apart = label[1] + 7 <= top or bottom <= label[1] - 7
        assert apart or right <= label[0] - 24.5 or label[0] + 24.5 <= left


def test_the_header_of_a_page_counts_and_ends_as_the_run_does():
    bodies = [Body("a", [(0, 0)], Translation([0, 1])), Body("b", [(4, 0)])]

    assert "1 event from t = 0 to t = 4<" in page_of(
        film_of(Scene(bodies, time=(0, 8)), tiling=None)
    )
