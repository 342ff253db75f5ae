"""The client: finding the program, many and large requests, and what is the caller's fault."""

import json
import random
import shutil
import subprocess
import sys
from fractions import Fraction

import pytest
from cgal_tilings import as_tile, cyclic_pairs, random_map, random_tiling

from exactpt import AuditError, Body, InputError, Scene, cgal
from exactpt.cgal import (
    BodyShape,
    CgalCheck,
    IsolatedRoot,
    build_program,
    check_proof,
    client,
    find_program,
)
from exactpt.cgal.build import sources
from exactpt.cgal.client import recognise
from exactpt.kernel.numbers import QQ

pytestmark = pytest.mark.cgal


@pytest.fixture
def pair():
    """A triangle and a point, with two faces."""
    at = {"a": [(0, 0), (4, 0), (0, 4)], "p": [(4, 4)]}
    vertices = [
        {"body": name, "vertex": i, "x": str(x), "y": str(y)}
        for name, points in at.items()
        for i, (x, y) in enumerate(points)
    ]
    edges = [
        {"u": u, "v": v, "kind": "boundary" if v < 3 else "diagonal", "hull": {u, v} != {1, 2}}
        for u, v in [(0, 1), (1, 2), (2, 0), (1, 3), (2, 3)]
    ]
    faces = [{"vertices": [1, 3, 2], "corners": [3, 1, 2], "region": "F2"}]
    tile = {"at": "0", "tiling": "test", "vertices": vertices, "edges": edges, "faces": faces}
    return tile, [BodyShape("a", 3), BodyShape("p", 1)]


def test_a_tile_as_json_gives_it(witness, pair):
    tile, shapes = pair
    as_read = json.loads(json.dumps(tile))

    verdict = witness.check_tiling(as_read, [(s.name, s.size, s.closed) for s in shapes])

    assert verdict == cgal.Verdict(
        ok=True,
        stats={"vertices": 4, "edges": 5, "faces": 1, "polygons": 1, "hull": 4, "witnesses": 1},
    )


@pytest.mark.parametrize("number", ["0/7", "-0", "0.0", "0e-3", 0, QQ(0), Fraction(0)])
def test_coordinates_are_written_exactly(witness, pair, number):
    tile, shapes = pair
    tile["vertices"][0]["x"] = number

    assert witness.check_tiling(tile, shapes).ok


def test_numbering_may_be_clockwise_if_it_is_known_or_unknown(witness, pair):
    tile, shapes = pair
    for vertex in tile["vertices"][1:3]:
        vertex["vertex"] = 3 - vertex["vertex"]

    verdicts = [
        witness.check_tiling(tile, [BodyShape("a", 3, clockwise=known), shapes[1]])
        for known in (None, True, False)
    ]

    assert [(v.ok, v.reason) for v in verdicts] == [
        (True, ""),
        (True, ""),
        (False, "body 0 is clockwise"),
    ]


def test_shapes_of_a_scene():
    square = [(0, 0), (1, 0), (1, 1), (0, 1)]
    scene = Scene(
        [
            Body("left", square),
            Body("right", [(x + 9, y) for x, y in reversed(square)]),
            Body("wire", [(0, 5), (1, 6), (2, 5)], closed=False),
            Body("dot", [(5, 5)]),
        ]
    )

    shapes = BodyShape.of_scene(scene)

    assert [shape[:3] for shape in shapes] == [
        ("left", 4, True),
        ("right", 4, True),
        ("wire", 3, False),
        ("dot", 1, True),
    ]
    assert [shape.clockwise for shape in shapes[:2]] == [False, True]


BAD_TILES = [
    (lambda t: t["vertices"].append(t["vertices"][0]), "vertex 4 is 'a': 0 again"),
    (lambda t: t["vertices"].pop(), "body 'p': vertex 0 is not in the tile"),
    (lambda t: t["vertices"][3].update(body="q"), "body 'p': vertex 0 is not in the tile"),
    (lambda t: t["edges"][0].update(v=4), "there is no vertex 4 among 4"),
    (lambda t: t["edges"][0].update(v=-1), "there is no vertex -1 among 4"),
    (lambda t: t["faces"][0].update(vertices=[1, 3, 9]), "there is no vertex 9 among 4"),
    (lambda t: t["faces"][0].update(corners=[1, 3]), "face 0 has 2 corners"),
]


@pytest.mark.parametrize("change, reason", BAD_TILES)
def test_a_tile_that_contradicts_itself_is_bad(witness, pair, change, reason):
    """A verdict, not an error: it is the tile that is wrong."""
    tile, shapes = pair
    change(tile)

    verdict = witness.check_tiling(tile, shapes)

    assert (verdict.ok, verdict.reason, verdict.stats) == (False, reason, {})


NO_TILES = [
    (lambda t: t.pop("vertices"), "'vertices' is missing"),
    (lambda t: t["vertices"][0].pop("x"), "'x' is missing"),
    (lambda t: t["faces"][0].pop("corners"), "'corners' is missing"),
    (lambda t: t["vertices"][0].update(x=0.5), "not an exact number: 0.5"),
    (lambda t: t["vertices"][0].update(x="1/0"), "denominator is zero: '1/0'"),
    (lambda t: t["vertices"][0].update(x="1 end"), "not a number: '1 end'"),
    (lambda t: t["vertices"][0].update(x=None), "not a number: None"),
    (lambda t: t["vertices"][0].update(body=[]), "unhashable"),
    (lambda t: t["edges"][0].update(u="0"), "not the index of a vertex: '0'"),
    (lambda t: t["edges"][0].update(u=True), "not the index of a vertex: True"),
    (lambda t: t["edges"][0].update(kind="bridge"), "kind 'bridge'"),
    (lambda t: t["edges"][0].update(hull=1), "hull 1"),
    (lambda t: t.update(edges=None), "NoneType"),
]


@pytest.mark.parametrize("change, message", NO_TILES)
def test_what_is_no_tile_is_the_callers_fault(witness, pair, change, message):
    tile, shapes = pair
    change(tile)

    with pytest.raises(InputError, match="not a tile as `exactpt tile` writes it: .*" + message):
        witness.check_tiling(tile, shapes)


def test_a_fan_makes_triangles(witness):
    """Four points, a pseudo-triangle among them; its fan edge cuts it."""
    vertices = [
        {"body": name, "vertex": 0, "x": str(x), "y": str(y)}
        for name, (x, y) in {"a": (0, 0), "b": (6, 0), "c": (3, 6), "d": (3, 2)}.items()
    ]
    edges = [
        {"u": u, "v": v, "kind": "diagonal", "hull": v < 3}
        for u, v in [(0, 1), (1, 2), (0, 2), (0, 3), (1, 3)]
    ]
    faces = [
        {"vertices": [0, 1, 3], "corners": [0, 1, 3], "region": "F2"},
        {"vertices": [0, 3, 1, 2], "corners": [0, 1, 2], "region": "F2"},
    ]
    tile = {"vertices": vertices, "edges": edges, "faces": faces, "fan": [[3, 2]]}
    shapes = [BodyShape(name, 1) for name in "abcd"]

    assert witness.check_tiling(tile, shapes, deep=True).ok
    assert witness.check_triangulation(tile, shapes, deep=True).stats["faces"] == 3
    for fan, reason in [
        ([], "the region 0-3-1-2 is not a triangle"),
        ([[2, 1]], "edge 2-1 is there twice"),
        ([[2, 3], [3, 2]], "edge 3-2 is there twice"),
    ]:
        verdict = witness.check_triangulation(tile | {"fan": fan}, shapes)
        assert (verdict.ok, verdict.reason) == (False, reason)
    with pytest.raises(InputError, match="'fan' is missing"):
        witness.check_triangulation({k: v for k, v in tile.items() if k != "fan"}, shapes)


def test_time_of_the_contract_is_a_root(witness):
    reported = {"approx": 1.414, "low": "7/5", "high": "3/2", "polynomial": ["-2", "0", "1"]}

    root = IsolatedRoot.of_json(reported)

    assert witness.check_root(*root).stats == {"roots": 2, "rank": 2, "multiplicity": 1}


def test_numbers_of_any_length(witness, pair):
    """Python itself writes no integer of more than 4,300 digits."""
    tile, shapes = pair
    power = QQ(10) ** 6000
    for vertex in tile["vertices"]:
        vertex |= {axis: QQ(vertex[axis]) * power + 1 / power for axis in "xy"}
    n = int(power)

    assert witness.check_tiling(tile, shapes).ok
    assert witness.check_root([-n, 1], power, power).ok
    assert (
        witness.compare_roots(
            IsolatedRoot([-n, 1], QQ(0), power), IsolatedRoot([1 - n, 1], QQ(0), power)
        )
        == 1
    )
    text = "1" + "0" * 6000
    root = IsolatedRoot.of_json({"polynomial": ["-" + text, "1"], "low": "0", "high": text})
    assert witness.sign_at_root([-n, 1], root) == (-1, 0, 1)


@pytest.mark.parametrize(
    "change",
    [{"polynomial": ["1/2", "1"]}, {"polynomial": None}, {"low": 0.5}, {"high": "x"}],
)
def test_what_is_no_time_is_the_callers_fault(change):
    with pytest.raises(InputError):
        IsolatedRoot.of_json({"low": "0", "high": "2", "polynomial": ["-1", "1"]} | change)
    with pytest.raises(InputError, match="'low'"):
        IsolatedRoot.of_json({"polynomial": ["-1", "1"]})


def test_large_requests_and_answers_do_not_block(witness):
    """Megabytes both ways: neither side waits for the other."""
    triples = [((0, 0), (1, 0), (i, i - 30_000)) for i in range(60_000)]

    signs = witness.orientations(triples)

    assert signs == [-1] * 30_000 + [0] + [1] * 29_999
    parabola = [(i, i * i) for i in range(20_000)]
    assert witness.hull(parabola) == list(range(20_000))


def test_many_bad_tiles_under_way_do_not_block(witness, pair):
    """The longest reasons, more of them than a pipe holds, written ahead."""
    tile, shapes = pair
    big = 10**600
    tile["vertices"][3] |= {"x": str(big), "y": str(-big)}

    verdicts = list(witness.check_tilings([(tile, shapes)] * 3000, deep=True))

    assert {v.ok for v in verdicts} == {False}
    assert len({v.reason for v in verdicts}) == 1


def test_a_tiling_given_up_half_way_leaves_no_answer_behind(witness, pair):
    verdicts = witness.check_tilings([pair] * 10)
    assert next(verdicts).ok
    verdicts.close()

    assert witness.orientations([((0, 0), (1, 0), (0, 1))]) == [1]


def test_a_bad_tile_in_the_middle_of_many(witness, pair):
    tile, shapes = pair
    bad = tile | {"faces": []}

    verdicts = witness.check_tilings([(tile, shapes), (bad, shapes), (tile, shapes[:1])] * 4)

    assert [v.ok for v in verdicts] == [True, False, False] * 4


def test_the_program_is_started_anew_after_bad_input(witness):
    with pytest.raises(InputError, match=r"line \d+: every number is a root"):
        witness.check_root([], 0, 1)
    with pytest.raises(InputError, match="the interval is reversed"):
        witness.check_root([-1, 1], 2, 0)
    with pytest.raises(InputError, match="leading coefficient"):
        witness.check_root([-1, 1, 0], 0, 2)

    assert witness.check_root([-1, 1], 0, 2).ok


def test_closing_twice_and_asking_again(program):
    witness = CgalCheck(program)
    witness.close()
    assert witness.hull([(0, 0)]) == [0]
    witness.close()
    assert witness.hull([(0, 0)]) == [0]
    witness.close()
    witness.close()


def test_the_variable_comes_before_the_checkout(monkeypatch, program):
    monkeypatch.setenv("EXACTPT_CGAL_CHECK", sys.executable)

    assert str(find_program()) == sys.executable


@pytest.mark.parametrize("name", ["no such program", "."])
def test_a_variable_that_names_no_program(monkeypatch, name):
    monkeypatch.setenv("EXACTPT_CGAL_CHECK", name)

    with pytest.raises(InputError, match="EXACTPT_CGAL_CHECK names no program"):
        CgalCheck()


def test_the_program_on_path_and_no_program(monkeypatch, tmp_path, program):
    monkeypatch.delenv("EXACTPT_CGAL_CHECK", raising=False)
    monkeypatch.setattr(client, "__file__", str(tmp_path / "exactpt" / "cgal" / "client.py"))
    monkeypatch.setenv("PATH", str(tmp_path))
    with pytest.raises(InputError, match=r"exactpt check --build .* libcgal-dev"):
        find_program()

    (tmp_path / "cgal_check").symlink_to(program)

    assert find_program() == tmp_path / "cgal_check"


def script(tmp_path, text):
    path = tmp_path / "program"
    path.write_text(f"#!{sys.executable}\n{text}\n", encoding="utf-8")
    path.chmod(0o755)
    return path


@pytest.mark.parametrize(
    "text, error, message",
    [
        ("import sys; sys.exit('boom')", InputError, "is not cgal_check.*ended with 1: .*boom"),
        ("print('hello', flush=True); input(); input()", InputError, "is not cgal_check.*hello"),
        ("input(); print('exactpt-check 2 cgal 7')", InputError, "does not speak"),
        (
            "input(); print('exactpt-check 1 cgal 5', flush=True); input(); import os; os.abort()",
            AuditError,
            "ended with -6",
        ),
    ],
)
def test_a_program_that_breaks_or_speaks_another_language(tmp_path, text, error, message):
    with CgalCheck(script(tmp_path, text)) as broken, pytest.raises(error, match=message):
        broken.hull([(0, 0)])


def test_a_program_that_cannot_be_started(tmp_path):
    with pytest.raises(InputError, match="cannot start"):
        CgalCheck(tmp_path / "nothing").hull([(0, 0)])


def test_hundreds_of_snapshots_of_fifty_bodies(witness):
    rng = random.Random(3)
    tilings = [random_tiling(rng, 10, 5) for _ in range(3)]
    tiles = [as_tile(rng, tilings[i % 3], random_map(rng)) for i in range(50)] * 5
    assert all(len(shapes) == 50 for _, shapes in tiles)

    verdicts = list(witness.check_tilings(tiles))

    assert len(verdicts) == 250
    assert [v.reason for v in verdicts if not v.ok] == []


def test_faces_are_accepted_from_any_start_and_corners_in_any_order(witness, pair):
    tile, shapes = pair
    cycle = tile["faces"][0]["vertices"]
    for start, _ in cyclic_pairs(cycle):
        i = cycle.index(start)
        tile["faces"][0] |= {"vertices": cycle[i:] + cycle[:i], "corners": cycle[::-1]}
        assert witness.check_tiling(tile, shapes).ok


@pytest.mark.parametrize("text", ["", "print('accepted')", "import sys; sys.exit(2)", "input()"])
def test_another_program_is_no_witness_of_a_proof(tmp_path, text):
    """Whatever its exit code: neither a verdict nor a bug of exactpt."""
    with pytest.raises(InputError, match="is not cgal_check"):
        check_proof(tmp_path / "scene.json", tmp_path / "proof", program=script(tmp_path, text))


def test_the_sources_are_those_of_the_checkout():
    assert (sources() / "main.cpp").is_file()


def test_a_build_that_fails_names_the_packages(monkeypatch, tmp_path):
    monkeypatch.setenv("PATH", str(tmp_path))
    with pytest.raises(InputError, match=r"cannot start cmake.*apt-get install g\+\+ cmake"):
        build_program(tmp_path / "build")
    cmake = script(tmp_path, "import sys; sys.exit('CMake Error: could not find CGAL')")
    cmake.rename(tmp_path / "cmake")
    with pytest.raises(InputError, match=r"could not find CGAL; on Debian .* libcgal-dev"):
        build_program(tmp_path / "build")


def test_a_warning_of_a_compiler_does_not_end_the_build(tmp_path):
    """GCC 16 gives one that is wrong, and -Werror made it an error (Debian sid, 2026-11-25)."""
    options = ["-B", str(tmp_path), "-DCMAKE_EXPORT_COMPILE_COMMANDS=ON"]
    subprocess.run(["cmake", "-S", str(sources()), *options], check=True, capture_output=True)
    commands = json.loads((tmp_path / "compile_commands.json").read_text())

    assert len(commands) > 20
    assert not any("-Werror" in entry["command"] for entry in commands)


@pytest.mark.slow
def test_the_program_builds_and_answers(tmp_path):
    if shutil.which("cmake") is None:
        pytest.skip("cmake is not installed")
    recognise(build_program(tmp_path / "build"))
