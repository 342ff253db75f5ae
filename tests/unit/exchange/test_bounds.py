"""Shapes made to exhaust a reader: refused in one line by depth, number and size."""

import json
import os
import signal
import sys
import tracemalloc
from time import process_time

import pytest
from commands import code_of

from exactpt import InputError, Scene, read_shapes
from exactpt.cli.alarm import GRACE
from exactpt.exchange import bodies, svg
from exactpt.exchange.drawing import read_drawing
from exactpt.exchange.losses import Losses
from exactpt.files import read_bytes
from exactpt.pair import start as initial

HEAD = '<svg xmlns="http://www.w3.org/2000/svg">'
OUTLINE = '<path d="M0 0h1v1z"/>'


def convert(source, *options):
    return code_of("convert", source, source.with_name("out.json"), *options)


@pytest.fixture
def refused(tmp_path, capsys):
    """Write a file, convert it, and return the one line that refuses it."""

    def refused(name, text, *options):
        source = tmp_path / name
        source.write_text(text)
        assert convert(source, *options) == 2
        out, err = capsys.readouterr()
        assert (out, err.count("\n")) == ("", 1)
        assert not source.with_name("out.json").exists()
        return err

    return refused


@pytest.mark.parametrize("depth", [101, 5_000, 100_000])
def test_collections_in_collections_of_wkt(refused, depth):
    """At depth 100,000 shapely ended the process; at 5,000 it took 650 MB."""
    text = "GEOMETRYCOLLECTION(" * depth + "POINT (1 1)" + ")" * depth

    assert "geometry 0: nested more than 100 deep" in refused("shapes.wkt", text)


@pytest.mark.long("101")
@pytest.mark.parametrize("depth", [101, 300, 100_000])
def test_collections_in_collections_of_geojson(refused, depth):
    inner = '{"type": "Point", "coordinates": [1, 2]}'
    text = '{"type":"GeometryCollection","geometries":[' * depth + inner + "]}" * depth

    said = refused("shapes.geojson", text)

    assert "nested more than 100 deep" in said or "nested too deeply" in said


def test_what_is_nested_moderately_is_read(tmp_path):
    wkt, drawing = tmp_path / "shapes.wkt", tmp_path / "shapes.svg"
    wkt.write_text("GEOMETRYCOLLECTION(" * 90 + "POINT (1 1)" + ")" * 90)
    drawing.write_text(HEAD + "<g>" * 90 + OUTLINE + "</g>" * 90 + "</svg>")

    assert len(read_shapes(wkt).bodies) == len(read_shapes(drawing).bodies) == 1


def test_groups_in_groups(refused):
    text = HEAD + "<g>" * 50_000 + OUTLINE + "</g>" * 50_000 + "</svg>"

    assert "nested more than 100 deep" in refused("drawing.svg", text)


@pytest.mark.parametrize(
    "text",
    [
        '<g id="a"><use href="#a"/></g>',
        '<g id="a"><use href="#b"/></g><g id="b"><use href="#a"/></g>',
        '<use id="a" href="#a"/>',
        '<g id="a"><use href="#a"/></g><rect id="a" width="1" height="1"/>',
        '<g xmlns:x="http://www.w3.org/1999/xlink" id="a"><use x:href="#a"/></g>',
        "".join(f'<use id="u{i}" href="#u{i + 1}"/>' for i in range(50_000)),
    ],
    ids=["itself", "each other", "one element", "two of a name", "xlink", "chain"],
)
def test_groups_that_use_themselves(refused, text):
    assert "or one is in itself" in refused("drawing.svg", HEAD + text + "</svg>")


def test_copies_of_copies(refused):
    """Eight levels of ten copies are 100,000,000 outlines in a file of 2 kB."""
    levels = [f'<g id="g{i + 1}">' + f'<use href="#g{i}"/>' * 10 + "</g>" for i in range(8)]
    text = HEAD + '<path id="g0" d="M0 0h1v1z"/>' + "".join(levels) + "</svg>"

    assert "more than 100000 elements are copies" in refused("drawing.svg", text)


def test_a_few_copies_are_made(tmp_path):
    drawing = tmp_path / "drawing.svg"
    drawing.write_text(
        HEAD + '<defs><path id="p" d="M0 0h1v1z"/></defs>'
        '<g id="g"><use href="#p"/><use href="#p" x="5"/></g><use href="#g" y="5"/></svg>'
    )

    assert len(read_shapes(drawing).bodies) == 4


def test_points_of_curves_are_counted(refused, monkeypatch):
    monkeypatch.setattr(svg, "_MAX_POINTS", 1000)
    text = HEAD + '<circle r="100"/>' * 20 + "</svg>"

    assert "more than 1000 points: raise" in refused("drawing.svg", text, "--tolerance", "0.01")


class Counting(dict):
    asked = 0

    def __contains__(self, key):
        self.asked += 1
        return super().__contains__(key)


@pytest.mark.parametrize("wanted", ["a", "a 7"])
def test_one_name_for_all(wanted):
    """The names tried grow with the number of bodies, not with its square."""
    taken, last = Counting(), {}
    for i in range(2000):
        taken[bodies.free_name("a" if i % 2 else wanted, taken, last)] = None

    assert len(taken) == 2000
    assert taken.asked < 8000


@pytest.mark.long
@pytest.mark.parametrize("how", ["parts", "features"])
def test_many_bodies_of_one_name(tmp_path, how):
    places = [[i, i] for i in range(3000)]
    feature = {"type": "Feature", "properties": {"name": "a"}}
    point = {"type": "MultiPoint", "coordinates": places}
    data = feature | {"geometry": point}
    if how == "features":
        points = [feature | {"geometry": {"type": "Point", "coordinates": p}} for p in places]
        data = {"type": "FeatureCollection", "features": points}
    (tmp_path / "shapes.geojson").write_text(json.dumps(data))

    names = [body.name for body in read_shapes(tmp_path / "shapes.geojson").bodies]

    assert names == ["a", *(f"a {i}" for i in range(2, 3001))]


@pytest.mark.parametrize("command", ["collide", "convert"])
def test_all_in_one_place(tmp_path, capsys, monkeypatch, command):
    """Of 20,000 points in one place 200 million pairs touch."""
    monkeypatch.setattr(initial, "MAX_PAIRS", 1000)
    source = tmp_path / "shapes.wkt"
    source.write_text(f"MULTIPOINT ({', '.join(['(1 1)'] * 100)})")
    assert convert(source) == 0
    reported = capsys.readouterr()
    if command == "collide":
        code = code_of("collide", source.with_name("out.json"))
        reported = capsys.readouterr()
        assert (code, reported.out) == (2, "")

    assert reported.err.endswith("more than 1000 pairs of bodies share a point at the start\n")


COMMANDS = {
    "collide": [],
    "simulate": [],
    "tile": [],
    "check": [],
    "draw": ["-o", "picture.svg"],
    "convert": ["out.geojson"],
}


@pytest.fixture
def folder(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    return tmp_path


@pytest.mark.parametrize("command", COMMANDS)
def test_every_command_refuses_by_size(folder, capsys, command):
    """A file of a terabyte, all of it a hole, is refused by its size: it is not read."""
    with (folder / "scene.json").open("wb") as file:
        file.truncate(10**12)

    assert code_of(command, "scene.json", *COMMANDS[command]) == 2

    said = "scene.json: more than 100000000 bytes: allow more by --max-bytes (in Python max_bytes)"
    assert capsys.readouterr().err == f"exactpt: {said}\n"


@pytest.mark.skipif(sys.platform == "win32", reason="devices of a Unix")
@pytest.mark.parametrize("command", COMMANDS)
@pytest.mark.parametrize("device", ["/dev/zero", "/dev/urandom", "/dev/null"])
def test_every_command_refuses_devices(folder, capsys, command, device):
    os.symlink(device, "scene.json")

    assert code_of(command, "scene.json", *COMMANDS[command]) == 2
    assert capsys.readouterr().err == "exactpt: scene.json: cannot be read: a device\n"


@pytest.mark.parametrize("command", [c for c in COMMANDS if c != "check"])
def test_the_size_allowed_is_an_option(folder, capsys, command):
    (folder / "scene.json").write_text('{"exactpt": 1, "time": [0, 1], "bodies": []}')
    arguments = [command, "scene.json", *COMMANDS[command], "--max-bytes"]

    assert code_of(*arguments, "43") == 2
    assert "more than 43 bytes" in capsys.readouterr().err
    assert code_of(*arguments, "44") == 0


@pytest.mark.skipif(sys.platform == "win32", reason="pipes of a Unix")
def test_a_pipe_is_read_up_to_the_limit():
    ours, theirs = os.pipe()
    os.write(theirs, b'{"exactpt": 1, "time": [0, 1], "bodies": []}' + b" " * 100)
    os.close(theirs)
    path = f"/dev/fd/{ours}"

    with pytest.raises(InputError, match="more than 50 bytes"):
        Scene.load(path, max_bytes=50)

    os.close(ours)


@pytest.mark.skipif(sys.platform == "win32", reason="Windows has no such signal")
def test_conversion_within_a_time(folder, capsys, monkeypatch):
    """The alarm that the option sets rings while a body is made."""
    (folder / "shapes.wkt").write_text("POINT (1 1)")
    left = []

    def late(*_, **__):
        left.append(signal.getitimer(signal.ITIMER_REAL)[0])
        signal.raise_signal(signal.SIGALRM)

    monkeypatch.setattr(bodies.Body, "__init__", late)

    assert code_of("convert", "shapes.wkt", "out.json", "--max-seconds", "900") == 4
    assert capsys.readouterr().err == "exactpt: time limit exceeded\n"
    assert len(left) == 1
    assert 0 < left[0] <= 900 + GRACE
    assert not (folder / "out.json").exists()


def test_a_file_takes_the_memory_that_it_has(tmp_path):
    """Reading allocated the whole limit: 100 MB for a file of 1 kB."""
    path = tmp_path / "scene.json"
    path.write_bytes(b"x" * 1000)
    for most in (None, 10**10, 10**30):
        tracemalloc.start()
        try:
            assert read_bytes(path, most) == b"x" * 1000
            assert tracemalloc.get_traced_memory()[1] < 4_000_000
        finally:
            tracemalloc.stop()


@pytest.mark.parametrize("most", ["x", -1, pytest.param(-(10**10000), id="long"), 1e9, None])
def test_a_limit_that_is_no_number_of_bytes(tmp_path, most):
    path = tmp_path / "scene.json"
    path.write_bytes(b"")
    if most is None:
        assert read_bytes(path, most) == b""
        return
    with pytest.raises(InputError, match=r"^max_bytes: not a number of bytes: "):
        read_bytes(path, most)


@pytest.mark.parametrize(
    ("drawn", "message"),
    [
        (f'<g transform="{"translate(" * 50_000}"/>', "g: transform: "),
        (f'<g transform="scale(2) {"translate(" * 9}"/>', "g: transform: "),
        (f'<g transform="scale({"1 " * 50_000}"/>', "g: transform: "),
        (f'<g style="transform:{"translate(" * 50_000};fill:red"/>', "g: transform: "),
        (f'<rect width="1{" " * 50_000}!"/>', "rect: width: not a length: "),
        (f'<path d="M0 0 L{" " * 50_000}x"/>', "path: path data: "),
        (f'<polygon points="1{" " * 50_000}x"/>', "polygon: points: "),
        (f'<svg preserveAspectRatio="{" " * 50_000}x" width="1" height="1"/>', "preserveAspect"),
    ],
)
def test_long_attributes_are_refused_in_linear_time(refused, drawn, message):
    """svgelements took 25 s for 180 kB of transforms, which backtracking read again and again."""
    assert message in refused("a.svg", f"{HEAD}{drawn}</svg>", "--max-seconds", "5")


@pytest.mark.parametrize("digits", [30, 2_000])
def test_long_digits_of_points_are_the_same_doubles(digits):
    """Each takes quadratic time in the regular expressions of svgelements."""
    text = "1" * digits
    drawing = read_drawing(f'{HEAD}<polygon points="-{text},2 3,{text}"/></svg>', Losses())
    (outline,) = drawing.root
    words = [float(word) for word in outline.get("points").replace(",", " ").split()]
    assert words == [-float(text), 2, 3, float(text)]
    assert len(outline.get("points")) < 70


@pytest.mark.parametrize(
    "css",
    [
        "/*" * 50_000,
        ".a{" * 50_000,
        f"a{' ' * 50_000}{{}}b{{c:d}}",
        "a" * 50_000,
        "}" * 50_000,
        ";@" * 50_000,
        ",".join(f".c{i}" for i in range(20_000)) + "{display:inline}",
    ],
)
def test_long_style_sheets_are_read_in_linear_time(css):
    began = process_time()
    drawing = read_drawing(f"{HEAD}<style>{css}</style>{OUTLINE}</svg>", Losses())
    assert len(drawing.root) == 1
    assert process_time() - began < 5


def test_path_data_that_is_refused_is_shown(refused):
    """The message was "not a drawing that can be read: ValueError()"."""
    said = refused("a.svg", f'{HEAD}<path d="M0 0 L{" " * 300}1 2 3"/></svg>')

    assert "not a drawing that can be read: path data: 'M0 0 L  " in said
    assert len(said) < 300
