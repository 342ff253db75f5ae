"""Certificates that bodies stay apart: written, checked, and wrong ones."""

import hashlib
import json
import subprocess
import sys
from fractions import Fraction
from pathlib import Path

import pytest
from click.testing import CliRunner

import exactpt
from exactpt import Body, Rigid, Scene, Translation, check_apart, proof_scene
from exactpt.cli import cli
from exactpt.errors import AuditError, BudgetExceeded, InputError
from exactpt.proof import certify_rows
from exactpt.proof.paths import Paths
from exactpt.testing.scenes import FAMILIES, POINTS, RINGS, SPINNING, generate

ROOT = Path(check_apart.__file__).parent.parent
BOX = [(0, 0), (1, 0), (1, 1), (0, 1)]


def moved(shape, x, y):
    return [(a + x, b + y) for a, b in shape]


def bodies(*others):
    return Scene([Body("a", BOX, Translation([0, 1])), *others], time=(0, 8))


TWO = bodies(Body("b", moved(BOX, 5, 0)))  # which meet at t = 4
THREE = bodies(Body("b", moved(BOX, 5, 0)), Body("c", [(5, 7)]))
PAST = bodies(Body("b", moved(BOX, 5, 2)))  # which do not
MANY = bodies(Body("b", moved(BOX, 5, 2)), Body("c", moved(BOX, 5, -1)), Body("d", [(7, 0)]))


def said(proof):
    return proof.check().split(" ", 2)[2]


def verdict(scene, *lines, start=0, until=8):
    """What the checker answers of a certificate with these lines."""
    file = (scene if isinstance(scene, bytes) else exactpt.certify(scene).scene) if scene else b""
    digest = hashlib.sha256(file).hexdigest()
    head = ["exactpt-apart 1", f"scene sha256 {digest}", f"span {start} {until}"]
    try:
        return check_apart.check(file, "\n".join([*head, *lines, ""]).encode()).split(" ", 2)[2]
    except proof_scene.Rejected as rejected:
        return str(rejected)
    except proof_scene.NoProofError as refused:
        return f"no proof: {refused}"


def scene_file(*given, time=(0, 8)):
    return json.dumps({"exactpt": 1, "time": time, "bodies": given}).encode()


def test_the_checker_imports_nothing_but_the_standard_library():
    code = (
        "import sys; before = set(sys.modules); import exactpt.check_apart;"
        "print(*sorted(set(sys.modules) - before))"
    )
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    found = {m for m in done.stdout.split() if m.startswith("exactpt")}
    of_package = {"exactpt", "exactpt.extensions", "exactpt.interpreters"}
    assert found == {*of_package, "exactpt.check_apart", "exactpt.proof_scene"}


def test_items_are_numbered_alike():
    for family in ("frames", "lakes", "stars", "chains", "points"):
        try:
            scene = generate(family, 3)
        except KeyError:
            continue
        read = proof_scene.Scene(exactpt.proof.emit.scene_bytes(scene).decode())
        items = [(i, *d) for i, b in enumerate(read.bodies) for d in b.edges or [(b.first,) * 2]]
        assert Paths(scene.bodies, Fraction(0), scene.time).items == items


def test_a_contact_is_enclosed_within_a_millionth():
    proof = exactpt.certify(TWO)
    assert proof.contact == exactpt.first_contact(TWO)
    words = said(proof)
    assert words.endswith("4]: b0.0 and b1.0 at t = 4 (b0 is 'a', b1 is 'b')")
    low = Fraction(words.split("(")[1].split(",")[0])
    assert 0 < 4 - low <= Fraction(8, 2**20)


def test_no_contact():
    proof = exactpt.certify(PAST)
    assert said(proof) == "no two bodies share a point in [0, 8], the whole span"
    assert proof.check().whole


def test_some_pairs():
    assert "first contact of two bodies in" in said(exactpt.certify(MANY))
    words = said(exactpt.certify(MANY, between=[("a", "b"), ("b", "c")]))
    assert words.split(" (")[0] == (
        "no two bodies share a point in [0, 8], the whole span; between b0 b1; between b1 b2"
    )
    proof = exactpt.certify(MANY, ignoring=[("a", "d", "c")])
    assert "; ignoring b0 b2 b3 (b0 is 'a', b2 is 'c', b3 is 'd')" in said(proof)
    assert not proof.check().whole
    with pytest.raises(InputError, match="no pair of bodies counts"):
        exactpt.certify(MANY, between=[])


def test_since_a_time():
    words = said(exactpt.certify(PAST, since=3))
    assert words.startswith(
        "no two bodies share a point in [3, 8]; the span of the scene is [0, 8]"
    )
    assert words.endswith(": nothing is said of [0, 3)")
    assert said(exactpt.certify(TWO, since=5)).startswith("two bodies share a point at the start t")


def test_at_the_start():
    nested = bodies(Body("b", [(Fraction(1, 2), Fraction(1, 2))], Translation([0, 1])))
    assert ": b1.0 inside b0 at t = 0 (" in said(exactpt.certify(nested))
    touching = bodies(Body("b", [(1, -1), (1, 5)]))
    assert ": b0.0 and b1.0 at t = 0 (" in said(exactpt.certify(touching))


def test_radius():
    scene = Scene(
        [
            Body("a", [(0, 0)], Translation([0, 1]), radius=1),
            Body("b", [(6, -1), (6, 1)], radius=2),
        ],
        time=(0, 8),
    )
    words = said(exactpt.certify(scene))
    assert words.endswith(", 3]: b0.0 and b1.0 at t = 3 (b0 is 'a', b1 is 'b')")
    assert said(exactpt.certify(scene, at=0, distance="2.999")).startswith(
        "no two bodies are within"
    )
    with pytest.raises(BudgetExceeded):
        exactpt.certify(scene, at=0, distance=3)


def test_within_a_distance():
    assert ", 3]: b0.0 and b1.0 at t = 3 (" in said(exactpt.certify(TWO, distance=1))
    words = said(exactpt.certify(PAST, distance="0.999"))
    assert words == "no two bodies are within 999/1000 in [0, 8], the whole span"
    words = said(exactpt.certify(PAST, distance="1.5"))
    assert words.startswith("first time within 3/2 of two bodies in (")


def test_a_point_passes_through_a_segment_at_an_irrational_time():
    wall = Body("wall", [(2, -1), (2, 1)])
    scene = Scene([Body("p", [(0, 0)], Translation([0, 0, 1])), wall], time=(0, 5))
    words = said(exactpt.certify(scene))
    assert ": b0.0 through b1.0 in [" in words
    low, high = map(Fraction, words.split("(")[1].split("]")[0].split(", "))
    assert low**2 < 2 < high**2
    assert high - low <= Fraction(5, 2**20)


@pytest.mark.parametrize("family", ["turning", "keyframed", "stars", "lakes", "gears", "convoy"])
def test_families(family):
    assert exactpt.certify(generate(family, 2)).check().startswith("accepted: ")


def test_first_contact_and_the_command_write_it(tmp_path):
    path, file = tmp_path / "x.apart", tmp_path / "s.json"
    contact = exactpt.first_contact(TWO, since=1, certificate=path)
    assert contact.time == 4
    done = CliRunner().invoke(cli, ["check", str(path)])
    assert done.exit_code == 0
    assert " first contact of two bodies in (" in done.output
    TWO.save(file)
    arguments = ["collide", str(file), "--certificate", str(path), "--until", "3"]
    CliRunner().invoke(cli, arguments, catch_exceptions=False)
    done = CliRunner().invoke(cli, ["check", str(path)])
    verdict = (
        " no two bodies share a point in [0, 3]; the span of the scene is [0, 8]: nothing is said "
        "of (3, 8]"
    )
    assert f"{verdict}\n" in done.output  # without cgal_check, another line says so
    path.write_bytes(path.read_bytes().replace(b"none", b"meet 7 0 4"))
    done = CliRunner().invoke(cli, ["check", str(path)], standalone_mode=False)
    assert (done.return_value, "rejected: line 5" in done.output) == (1, True)


def test_exit_codes(tmp_path, capsys):
    path, file = tmp_path / "x.apart", tmp_path / "x.apart.scene.json"
    exactpt.first_contact(PAST.until(5), certificate=path)
    PAST.save(file)
    new = hashlib.sha256(file.read_bytes()).hexdigest()
    lines = path.read_text().split("\n")
    path.write_text("\n".join([lines[0], f"scene sha256 {new}", *lines[2:]]))
    for options, code in (
        ([], 1),
        (["--partial"], 0),
        (["--until", "5"], 0),
        (["--until", "6"], 1),
        (["--until", "5", "--partial"], 2),
        (["--work", "9"], 4),
        (["--what"], 2),
    ):
        assert check_apart.main([str(file), str(path), *options]) == code, options
        assert capsys.readouterr().out.count("\n") == (code != 2)


def test_what_has_no_certificate(tmp_path):
    with pytest.raises(InputError, match="no certificate of a new contact"):
        exactpt.first_contact(TWO, after_start=True, certificate=tmp_path / "x")
    with pytest.raises(InputError, match="no certificate with a proof"):
        exactpt.first_contact(TWO, proof=tmp_path / "p", certificate=tmp_path / "x")
    folding = Body("f", [([0, 1], 0), (5, 1), (5, -1)], closed=False)
    bent = Body("g", [(3, 9), (5, 9)])
    assert said(exactpt.certify(Scene([folding, bent], time=(0, 4)))).startswith("no two bodies")
    assert not list(tmp_path.iterdir())


# Wrong certificates. The two boxes of PAST are apart by y: 1 < 3/2 < 2; by x only up to t = 4.

RIGHT = "c 0 1 3/2"


def test_a_right_one_by_hand():
    assert verdict(PAST, RIGHT, "none") == "no two bodies share a point in [0, 8], the whole span"
    assert verdict(PAST, "c 0 1 2", "none").startswith("no two")  # one body may touch the line
    assert verdict(PAST, "t 3", "c 1 0 9/2", RIGHT, "none").startswith("no two")


@pytest.mark.parametrize(
    ("lines", "why"),
    [
        (["none"], "line 4: a node is missing"),
        (["c 0 1 1", "none"], "a node is missing"),  # it touches both sorts of sides
        (["c 1 0 4", "none"], "a node is missing"),  # apart at first only
        (["c 0 1 5/2", "none"], "a node is missing"),
        (["c 0 0 1", "none"], "a line without a direction"),
        (["c 0 0 0 1", "none"], "a line without a direction"),
        ([RIGHT, RIGHT, "none"], "more nodes than are needed"),
        (["t 8", RIGHT, RIGHT, "none"], "8 is not between 0 and 8"),
        (["t 0", RIGHT, RIGHT, "none"], "0 is not between 0 and 8"),
        (["t 9", RIGHT, RIGHT, "none"], "9 is not between 0 and 8"),
        (["t 4", RIGHT, "none"], "a node is missing"),  # a half without nodes
        (["t 4", "c 1 0 9/2", "c 1 0 5", "none"], "a node is missing"),
        (["s 0 2", RIGHT, "none"], "a node is missing"),
        (["s 2 2", RIGHT, RIGHT, "none"], "not a number from 0 to 1: 2"),
        (["between 0 0", RIGHT, "none"], "a body is there twice"),
        (["between 0 2", RIGHT, "none"], "not a number from 0 to 1: 2"),
        (["ignoring 0 1", "ignoring 0 1", "none"], "a body is there twice"),
        (["distance 3", RIGHT, "none"], "a node is missing"),
        (["distance 1", RIGHT, "none"], "a node is missing"),
        (["distance -1", RIGHT, "none"], "a distance below 0"),
        ([RIGHT, "meet 9 0 4"], "a time outside of the span"),
        ([RIGHT, "meet 8 0 4"], "these are not near each other then"),
        ([RIGHT, "meet 8 0 9"], "not a number from 0 to 7: 9"),
        ([RIGHT, "inside 8 0 1"], "it is not inside then"),
        ([RIGHT, "cross 0 8 0 4"], "it stays on one side"),
    ],
)
def test_wrong_ones(lines, why):
    words = verdict(PAST, *lines)
    assert words.startswith("rejected: line "), words
    assert why in words


@pytest.mark.parametrize(
    "lines",
    [
        ["c 1 0 1", "meet 8 0 8"],
        ["t 1/0", RIGHT, RIGHT, "none"],
        ["c 1 0", "none"],
        ["c 1/2 0 1", "none"],
        ["none", RIGHT],
        [RIGHT],
        ["distance 1", "between 0 1", RIGHT, "none"],
        ["ignoring 0", RIGHT, "none"],
        [f"c 0 1 {'9' * 10_001}", "none"],
    ][1:],
)
def test_not_in_the_format(lines):
    assert verdict(PAST, *lines).startswith("no proof: ")


def test_spans():
    for start, until in ((-1, 8), (0, 9), (5, 4)):
        assert "not a span" in verdict(PAST, RIGHT, "none", start=start, until=until)
    low = verdict(TWO, "c 1 0 9/2", "meet 4 1 7", until=Fraction(7, 2))
    assert low.startswith("rejected: line 5: a node is missing")  # one touches the line at the end
    right = verdict(TWO, "c 1 0 5", "meet 4 1 7", until=Fraction(7, 2))
    assert right.startswith("first contact of two bodies in (7/2, 4]: b0.1 and b1.3 at t = 4")
    assert "a contact before the end" in verdict(TWO, "c 1 0 5", "meet 4 1 7", until=4)
    assert "at the start" in verdict(TWO, "c 1 0 5", "meet 4 1 7", start=4, until=5)
    assert verdict(TWO, "meet 4 1 7", start=4, until=4).startswith("two bodies share a point at")


def test_nested_bodies_are_not_apart():
    # A point in a box, and a box in a frame: no edges meet, and no line is between the insides.
    outer = {"name": "a", "vertices": [[0, 0], [9, 0], [9, 9], [0, 9]]}
    inner = {"name": "b", "vertices": [[4, 4], [5, 4], [5, 5], [4, 5]]}
    around = ["s 0 2", "s 0 1", *["c 0 1 2"], "c 1 0 7", "s 0 3", "c 0 1 7", "c 1 0 2", "none"]
    words = verdict(scene_file(outer, inner), *around)
    assert "b1 has a ring inside b0 at the start" in words
    words = verdict(scene_file(inner, outer), *[w.replace("s 0", "s 1") for w in around])
    assert "b0 has a ring inside b1 at the start" in words
    open_one = {**outer, "closed": False}
    lines = ["s 0 1", "c 0 1 2", "s 0 2", "c 1 0 7", "c 0 1 7", "none"]
    assert verdict(scene_file(open_one, inner), *lines).startswith("no two bodies")
    frame = {**outer, "holes": [[[1, 1], [8, 1], [8, 8], [1, 8]]]}
    corners = ["c 0 1 2", "c 1 0 2", "c 1 0 7", "c 0 1 7", "none"]
    words = verdict(scene_file(frame, inner), *corners)
    assert words == "no two bodies share a point in [0, 8], the whole span"


def test_all_rings_are_looked_at():
    """A body of two parts, the second of them inside another body."""
    parts = [{"vertices": moved(BOX, 20, 0)}, {"vertices": moved(BOX, 4, 4)}]
    two = {"name": "b", "parts": parts}
    outer = {"name": "a", "vertices": [[0, 0], [9, 0], [9, 9], [0, 9]]}
    around = ["c 0 1 2", "c 0 1 7", "c 1 0 7", "c 1 0 2", "c 1 0 15", "none"]
    words = verdict(scene_file(outer, two), *around)
    assert words.startswith("rejected: ")
    assert "b1 has a ring inside b0" in words


def test_every_edge_is_an_item_also_that_which_closes_a_ring():
    triangle = {"name": "a", "vertices": [[0, 0], [4, 0], [4, 4]]}
    through = {"name": "b", "vertices": [[1, 3], [3, 1]]}  # it meets the last edge alone
    assert "a node is missing" in verdict(
        scene_file(triangle, through), "s 0 2", "c 0 1 1/2", "none"
    )


def test_lines_across_breakpoints():
    """A body that jumps ahead between two times, by pieces: both ends are on one side."""
    pieces = {
        "pieces": [
            {"until": 2, "motion": {"x": [0, 3]}},
            {"until": 4, "motion": {"x": [12, -3]}},
            {"motion": {}},
        ]
    }
    there = {"name": "a", "vertices": [[0, 0]], "motion": pieces}
    wall = {"name": "b", "vertices": [[4, -1], [4, 1]]}
    file = scene_file(there, wall)
    assert "a node is missing" in verdict(file, "c 1 0 3", "none")
    assert verdict(file, "c 1 0 3", "meet 2 0 1", until=1).startswith("rejected: line 5")
    low = verdict(file, "t 1/2", "c 1 0 3", "c 0 1 0 0", "none")
    assert "a node is missing" in low


def test_curves_are_in_their_hulls():
    """A parabola that dips below its ends: (4 - t)^2 + 1/10 at t = 4."""
    dip = {"name": "a", "vertices": [[0, 0]], "motion": {"y": ["16.1", -8, 1]}}
    floor = {"name": "b", "vertices": [[-1, 0], [1, 0]]}
    file = scene_file(dip, floor)
    assert "a node is missing" in verdict(file, "c 0 1 1/20", "none")  # the hull reaches below
    halves = ["t", "c 0 1 1/20", "c 0 1 1/20", "none"]
    assert verdict(file, *halves).startswith("no two bodies")
    deeper = file.replace(b"16.1", b"15.9")
    assert "a node is missing" in verdict(deeper, *halves)


def test_a_turning_rod_sweeps_more_than_its_ends():
    rod = Body("a", [(-2, 0), (2, 0)], Rigid([-1, "1/4"]))  # half a turn in [0, 8]
    scene = Scene([rod, Body("b", [(0, 3)])], time=(0, 8))
    assert said(exactpt.certify(scene)).startswith("no two bodies")
    near = Scene([rod, Body("b", [(0, "1.99")])], time=(0, 8))
    file = exactpt.proof.emit.scene_bytes(near)
    assert "a node is missing" in verdict(file, "c 0 1 1", "none")
    assert "a node is missing" in verdict(file, "c 0 1 199/100", "none")


def test_a_passage_needs_an_edge_with_a_length_at_that_time():
    """The edge shrinks to a point at t = 4, far from the vertex: every orientation is 0 then."""
    edge = {"name": "a", "vertices": [[0, 0], {"x": [4, -1], "y": []}]}
    far = {"name": "b", "vertices": [[100, 100]]}
    words = verdict(scene_file(edge, far, time=(0, 5)), "c 1 0 50", "cross 1 5 2 0", until=2)
    assert words.startswith("rejected: line 5: it may pass beside the edge")


def test_a_passage_beside_the_edge():
    edge = {"name": "a", "vertices": [[0, 0], [0, 1]]}
    past = {"name": "b", "vertices": [[-3, 2]], "motion": {"x": [0, 1]}}
    words = verdict(scene_file(edge, past), "c 1 0 -1/2", "cross 2 4 2 0", until=2)
    assert "it may pass beside the edge" in words
    through = {**past, "vertices": [[-3, "1/2"]]}
    words = verdict(scene_file(edge, through), "c 1 0 -1/2", "cross 2 4 2 0", until=2)
    assert words.startswith("first contact of two bodies in (2, 4]: b1.0 through b0.0 in [2, 4]")
    words = verdict(scene_file(edge, through), "c 1 0 -1/2", "cross 4 5 2 0", until=2)
    assert "it stays on one side of the edge" in words


def test_radius_counts_on_both_sides():
    a = {"name": "a", "vertices": [[0, 0]], "radius": 1}
    b = {"name": "b", "vertices": [[5, 0]], "radius": 2}
    file = scene_file(a, b)
    assert verdict(file, "c 1 0 2", "none").startswith("no two bodies")
    for c in ("1", "1/2", "3", "7/2"):  # 3: the length of (1, 0) is rounded up
        assert "a node is missing" in verdict(file, f"c 1 0 {c}", "none")
    assert verdict(file, "distance 19/10", "c 1 0 101/100", "none").startswith("no two bodies are")
    assert "a node is missing" in verdict(file, "distance 2", "c 1 0 1", "none")
    tilted = ["c 3 4 0", "c 3 4 5", "c 3 4 10"]
    assert all("a node is missing" in verdict(file, line, "none") for line in tilted)


def test_pairs_that_do_not_count_prove_nothing():
    file = exactpt.proof.emit.scene_bytes(MANY)
    assert verdict(file, "between 0 1", RIGHT, "none").startswith("no two bodies share a point in")
    assert "do not count" in verdict(file, "between 0 1", RIGHT, "meet 5 0 10", until=4)
    merged = ["ignoring 1 2", "ignoring 1 3", "none"]
    assert "a body is there twice" in verdict(file, *merged)


def test_a_certificate_of_another_scene_is_refused():
    proof = exactpt.certify(TWO)
    with pytest.raises(proof_scene.NoProofError, match="for a different scene"):
        check_apart.check(proof.scene + b" ", proof.text)
    with pytest.raises(AuditError):
        proof._replace(text=proof.text.replace(b"meet 4", b"meet 5/2")).check()


def test_numbers_beyond_doubles_and_far_away():
    far = 10**400
    scene = Scene([Body("a", [(far, 0), (far + 1, 0)]), Body("b", [(0, 1)])], time=(0, 1))
    with pytest.raises(BudgetExceeded, match="out of the range of doubles"):
        exactpt.certify(scene)
    near = Scene([Body("a", [(10**20, 0)]), Body("b", [(10**20 + 1, 0)])], time=(10**9, 10**9 + 1))
    assert said(exactpt.certify(near)).startswith("no two bodies share a point in [1000000000, ")


def test_pairs_may_come_from_a_generator(tmp_path):
    exactpt.first_contact(TWO, between=(p for p in [("a", "b")]), certificate=tmp_path / "x")
    assert b"\nbetween 0 1\n" in (tmp_path / "x").read_bytes()


def test_rows_of_arrays():
    corners = [(0, 0), (2, 0), (0, 2), (5, 1), (7, 0), (7, 3), (0, 9), (1, 9), (0, 0), (1, 0)]
    offsets, pairs = [0, 3, 6, 8, 10], [(0, 1), (0, 2), (0, 3)]
    velocities = [(1, 0), (-2, 0), (0, 0), (0, 0)]
    found = exactpt.arrays.first_contacts(
        corners, offsets, pairs, velocities=velocities, closed=[True, True, False, False]
    )
    proof = certify_rows(found)
    words = "3 rows, each of two or more bodies in the whole span: no contact in 2, contact at the"
    assert said(proof) == f"{words} start in 1"
    for old, new, why in (
        (b"span 0 1;", b"span 0 1/2;", "row 1: only a part is proved"),
        (b"c ", b"c 100000", "row 1: a node is missing"),
    ):
        wrong = proof._replace(text=proof.text.replace(old, new, 1))
        with pytest.raises(AuditError, match=why):
            wrong.check()
    lines = proof.text.split(b"\n")
    wide = proof._replace(text=b"\n".join([*lines[:2], b"open", *lines[3:]]))
    assert said(wide).endswith("no contact in 1, contact at the start in 1, open in 1")
    assert not wide.check().whole
    with pytest.raises(proof_scene.NoProofError, match="a last line without an end"):
        check_apart.check(proof.scene, proof.text[:-1])
    for part in (proof.scene + proof.scene.split(b"\n")[0], proof.scene + b"\n"):
        digests = [hashlib.sha256(x).hexdigest().encode() for x in (proof.scene, part)]
        with pytest.raises(proof_scene.NoProofError):  # a scene without a row
            check_apart.check(part, proof.text.replace(*digests))
    with pytest.raises(proof_scene.NoProofError):
        check_apart.check(b"", b"exactpt-apart-rows 1")
    with pytest.raises(proof_scene.NoProofError, match="the numbers of scenes and of rows"):
        check_apart.check(proof.scene, b"\n".join(lines[:-2]) + b"\n")


def test_bodies_that_count_with_no_other_one_are_left_out():
    """The body c overlaps b, and counts with none: no line is clear of both."""
    square = [(-7, 4), (-1, 4), (-1, 10), (-7, 10)]
    shapes = [square, moved(BOX, 3, -1), [(-1, -8), (5, -8), (5, -2), (-1, -2)], [(1, -1)]]
    steps = [(-1, 0), (-1, 0), (1, 1), (-1, 0)]
    motions = [Translation([0, x], [0, y]) for x, y in steps]
    scene = Scene([Body(*row) for row in zip("abcd", shapes, motions, strict=True)], time=(0, 3))
    made = exactpt.certify(scene, between=[("d", "b"), ("d", "a")])
    assert said(made).startswith("no two bodies share a point in [0, 3], the whole span")


def test_a_body_within_a_chain_at_a_time():
    """No line is clear of all edges: at one time, too, a body is split."""
    chain = Body("chain", [(0, 0), (9, 0), (9, 9), (0, 9), (0, "1/9")], closed=False)
    scene = Scene([chain, Body("inner", [(3, 4), (4, 4), (3, 5)])], time=(0, 20))
    for distance in (0, "1/2", 2):
        assert said(exactpt.certify(scene, at=1, distance=distance)).startswith("no two bodies")


def test_a_body_inside_another_one_at_a_time_has_no_certificate():
    inner = Body("inner", [(4, 3), (5, 3), (4, 4)], Translation([0, 1]))
    scene = Scene([Body("outer", [(0, 0), (9, 0), (9, 9), (0, 9)]), inner], time=(0, 20))
    for distance in (0, "1/2"):
        with pytest.raises(InputError, match="inside another body at t = 1"):
            exactpt.certify(scene, at=1, distance=distance)
    assert said(exactpt.certify(scene, at=8)).startswith("no two bodies share a point at t = 8")


def row_files(scenes, row):
    """A scene file with a scene on each line, and a file with this row for each."""
    scene = b"".join(scene + b"\n" for scene in scenes)
    head = f"exactpt-apart-rows 1\nscenes sha256 {hashlib.sha256(scene).hexdigest()}\n"
    return scene, (head + f"{row}\n" * len(scenes)).encode()


PAIR = [{"name": "a", "vertices": [[0, 0]]}, {"name": "b", "vertices": [[3, 4]]}]
WRONG_ROWS = [  # bodies that never touch are not "in contact", however near a distance makes them
    ([scene_file(*PAIR)], "span 0 0;distance 5;meet 0 0 1", 1),
    ([scene_file(*PAIR)], "span 0 8;distance 1;c 1 0 1;none", 1),
    ([scene_file(PAIR[0])], "span 0 8;none", 1),
    ([scene_file(*PAIR), b"\xef\xbb\xbf" + scene_file(*PAIR)], "open", 2),
]


def test_rows_with_a_distance_or_one_body_are_refused():
    for scenes, row, code in WRONG_ROWS:
        error = proof_scene.Rejected if code == 1 else proof_scene.NoProofError
        start = "^rejected: row 1: no contacts of two bodies" if code == 1 else "BOM"
        with pytest.raises(error, match=start):
            check_apart.check(*row_files(scenes, row))
    scene, rows = row_files([scene_file(*PAIR)], "span 0 8;distance 0;c 1 0 1;none")
    assert check_apart.check(scene, rows).endswith("no contact in 1")


@pytest.mark.cgal
def test_wrong_rows_in_cpp(program, tmp_path):
    for scenes, row, code in WRONG_ROWS:
        for name, part in zip("sr", row_files(scenes, row), strict=True):
            (tmp_path / name).write_bytes(part)
        command = [program, "proof", tmp_path / "s", tmp_path / "r"]
        done = subprocess.run(command, capture_output=True, text=True, check=False)
        assert done.returncode == code
        assert done.stdout.startswith("rejected: row 1: no contacts" if code == 1 else "")


@pytest.mark.cgal
def test_rows_in_cpp(program, tmp_path):
    corners = [(0, 0), (2, 0), (0, 2), (5, 1), (7, 0), (7, 3)]
    found = exactpt.arrays.first_contacts(
        corners, [0, 3, 6], [(0, 1)] * 3, velocities=[(1, 0), (-2, 0)], time=(0, 10)
    )
    proof = certify_rows(found)
    proof.save(tmp_path / "x")
    for text, code in ((proof.text, 0), (proof.text.replace(b"meet", b"meet 0"), 2)):
        (tmp_path / "x").write_bytes(text)
        command = [program, "proof", tmp_path / "x.scene.json", tmp_path / "x"]
        done = subprocess.run(command, capture_output=True, text=True, check=False)
        assert done.returncode == code
        assert code or done.stdout == f"{proof.check()}\n"


@pytest.mark.slow
def test_both_kinds_of_proof_agree_on_200_scenes():
    """A tiling's proof has the exact time T; a certificate has (L, H]: T is in it."""
    families, done, contacts = [*FAMILIES, *POINTS, *RINGS, *SPINNING], 0, 0
    for k in range(600):
        scene = generate(families[k % len(families)], 50 + k // len(families))
        if done == 200 or scene.vertex_count > 80:
            continue
        try:
            first, other = exactpt.prove(scene), exactpt.certify(scene)
        except (InputError, BudgetExceeded):  # a contact of a body with itself, or too near
            continue
        proved, certified = first.check(), other.check()
        done += 1
        if proved.time is None:
            words = f"in [{scene.start}, {scene.end}], the whole span"
            assert certified.split(" ", 2)[2] == f"no two bodies share a point {words}"
            continue
        contacts += 1
        rows = [line.split() for line in other.text.decode().splitlines()]
        high = Fraction(rows[-1][-3])
        assert proved.time.compare_rational(high) <= 0
        assert high == scene.start or proved.time.compare_rational(Fraction(rows[2][2])) > 0
        assert high - Fraction(rows[2][2]) <= (scene.end - scene.start) / 2**20
    assert (done, contacts > 60) == (200, True)


def time_of(low, high, *polynomial):
    return {"low": str(low), "high": str(high), "polynomial": list(map(str, polynomial))}


EXPECTED = [  # of the bodies TWO, which meet at t = 4, and the exit code
    ({"contact": {"time": time_of(4, 4, -4, 1), "kind": "vertex-edge"}}, 0),
    ({"contact": {"time": time_of(3, 5, -16, 0, 1), "kind": "vertex-edge"}}, 0),
    ({"contact": {"time": time_of(3, 5, -17, 0, 1), "kind": "vertex-edge"}}, 1),  # later
    ({"contact": {"time": time_of(3, 5, -15, 0, 1), "kind": "vertex-edge"}}, 1),  # before
    ({"contact": {"time": time_of(5, 5, -5, 1), "kind": "vertex-edge"}}, 1),
    ({"contact": {"time": time_of(0, 0, 0, 1), "kind": "initial"}}, 1),
    ({"contact": {"time": time_of(4, 4, -4, 1), "kind": "self"}}, 1),
    ({"contact": None, "until": "8"}, 1),
    ({"contact": None, "until": "3"}, 0),
    ({"contact": {"time": time_of(5, 6, -4, 1), "kind": "vertex-edge"}}, 2),  # no root
    ({"contact": {"time": time_of(4, 4, -5, 1), "kind": "vertex-edge"}}, 2),
    ({"contact": {"time": time_of(5, 3, -4, 1), "kind": "vertex-edge"}}, 2),
    ({"contact": {"time": time_of(4, 4, "-9/2", 1), "kind": "vertex-edge"}}, 2),  # was -4
    ({"contact": {"kind": "vertex-edge"}}, 2),
    ({"contact": {"time": time_of(4, 4, -4, 1)}}, 2),
    ({}, 2),
]


def check_expected(checker, folder):
    """Compare an answer with a certificate, of all pairs and of some."""
    answer, path = folder / "answer.json", folder / "x"
    exactpt.certify(TWO).save(path)
    for data, code in EXPECTED:
        answer.write_text(json.dumps(data), encoding="utf-8")
        assert checker("--expect", answer) == code, data
    answer.write_text(json.dumps(EXPECTED[0][0]), encoding="utf-8")
    assert checker("--expect", answer, "--until", "3") == 2
    exactpt.certify(TWO, between=[("a", "b")]).save(path)  # all pairs of this scene
    assert checker("--expect", answer) == 0
    exactpt.certify(THREE, between=[("a", "b")]).save(path)
    assert checker("--expect", answer) == 1
    assert checker("--expect", answer, "--partial") == 0
    exactpt.certify(TWO, distance="1/1000000000").save(path)  # of an approach, soon before
    assert checker("--expect", answer) == 1
    answer.write_text(json.dumps({"contact": None, "until": "4"}), encoding="utf-8")
    assert checker("--expect", answer) == 1
    exactpt.certify(PAST.until(5)).save(path)
    answer.write_text(json.dumps({"contact": None, "until": "5"}), encoding="utf-8")
    assert checker("--expect", answer) == 0
    path.write_bytes(b"exactpt-apart-rows 1\n" + path.read_bytes())
    assert checker("--expect", answer) == 2


def test_an_answer_is_compared(tmp_path):
    files = [str(tmp_path / "x.scene.json"), str(tmp_path / "x")]
    check_expected(lambda *words: check_apart.main([*files, *map(str, words)]), tmp_path)


@pytest.mark.cgal
def test_an_answer_is_compared_in_cpp(program, tmp_path):
    files = [program, "proof", tmp_path / "x.scene.json", tmp_path / "x"]

    def checker(*words):
        return subprocess.run([*files, *words], capture_output=True, check=False).returncode

    check_expected(checker, tmp_path)


def test_answers_of_the_command_are_certified(tmp_path):
    for k, family in enumerate(["turning", "stars", "keyframed", "parabola_points"]):
        file, path, answer = (tmp_path / name for name in ("s.json", "x", "answer.json"))
        generate(family, k).save(file)
        done = CliRunner().invoke(cli, ["collide", str(file), "--json", "--certificate", str(path)])
        answer.write_text(done.output, encoding="utf-8")
        assert check_apart.main([str(file), str(path), "--expect", str(answer)]) == 0


def touching_without_crossing():
    """A point that turns back at a wall, at a time that is no rational number: t^2 = 2."""
    wall = Body("wall", [(-9, 0), (9, 0)])
    return Scene([Body("p", [(0, 1)], Translation([0], [3, 0, -4, 0, 1])), wall], time=(0, 5))


def test_an_answer_without_a_certificate_is_printed(tmp_path):
    scene, file, path = touching_without_crossing(), tmp_path / "s.json", tmp_path / "x"
    scene.save(file)
    with pytest.raises(BudgetExceeded, match="irrational time") as spent:
        exactpt.first_contact(scene, certificate=path)
    assert spent.value.answer == (exactpt.first_contact(scene),)
    plain = CliRunner().invoke(cli, ["collide", str(file)])
    done = CliRunner().invoke(cli, ["collide", str(file), "--certificate", str(path)])
    assert done.stdout == plain.stdout
    assert isinstance(done.exception, BudgetExceeded)
    done = CliRunner().invoke(cli, ["collide", str(file), "--certificate", str(path), "--json"])
    answer = json.loads(done.stdout)
    assert answer["certificate"] is None
    assert answer["contact"]["kind"] == "vertex-edge"
    assert sorted(p.name for p in tmp_path.iterdir()) == ["s.json"]
    code = "import sys; from exactpt.cli import main; sys.exit(main())"
    command = [sys.executable, "-c", code, "collide", str(file), "--certificate", str(path)]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    assert (done.returncode, done.stdout) == (4, plain.stdout)
    assert done.stderr.count("\n") == 1


@pytest.mark.parametrize("with_cgal", [False, pytest.param(True, marks=pytest.mark.cgal)])
def test_the_command_has_both_checkers_verify(tmp_path, monkeypatch, request, with_cgal):
    path = tmp_path / "x"
    exactpt.certify(TWO).save(path)
    program = request.getfixturevalue("program") if with_cgal else tmp_path / "none"
    monkeypatch.setenv("EXACTPT_CGAL_CHECK", str(program))
    done = CliRunner().invoke(cli, ["check", str(path)], standalone_mode=False)
    assert done.return_value == 0
    second = done.stdout.splitlines()[1:]
    assert second == (["cgal_check agrees"] if with_cgal else [])
    assert ("verified by one checker" in done.stderr) is not with_cgal


@pytest.mark.parametrize("power", [155, 307])
def test_sums_and_squares_beyond_the_doubles_warn_of_nothing(power):
    """Lines are proposed in floats that overflow, of which numpy warned (here an error)."""
    s = 10**power
    left = Body("b", [(-s, 0), (-s // 2, -s // 3), (-s, s)])
    right = Body("d", [(s, 1), (3 * s // 2, 7)])  # touched at t = 1 / s
    rising = Body("a", [(0, 0), (s, 0), (s // 2, s)], Translation([0, s]))
    with pytest.raises(BudgetExceeded, match="too near to each other"):
        exactpt.certify(Scene([rising, left, right], time=(0, 1)))


def certificate_by(*given, time=("0", "1"), **options):
    return exactpt.certify(Scene.from_json(json.loads(scene_file(*given, time=time))), **options)


@pytest.mark.parametrize(
    ("x", "wall"),
    [(["-1", "3", "-3", "1"], "2e-75"), ([str(n * 10**54) for n in (-1, 3, -3, 1)], "2")],
)
def test_bug_an_irrational_contact_just_after_the_start_is_certified(x, wall):
    """Its enclosure began at the start, and the certificate had no node."""
    point = {"name": "p", "vertices": [["0", "0"]], "motion": {"x": x}}
    other = {"name": "q", "vertices": [[wall, "-1"], [wall, "1"]]}
    assert " through " in said(certificate_by(point, other, time=["1", "2"]))


def test_bug_a_scene_without_bodies_is_certified():
    assert (
        said(certificate_by(time=[0, 1])) == "no two bodies share a point in [0, 1], the whole span"
    )


def test_bug_a_radius_or_distance_beyond_doubles_is_a_spent_budget():
    disc = {"name": "p", "vertices": [["0", "0"]], "radius": "1e309"}
    other = {"name": "q", "vertices": [["3e309", "0"]]}
    with pytest.raises(BudgetExceeded, match="out of the range of doubles"):
        certificate_by(disc, other)
    with pytest.raises(BudgetExceeded, match="out of the range of doubles"):
        exactpt.certify(PAST, distance=10**309)


def test_bug_numbers_near_the_largest_double_cause_no_warning(recwarn):
    point = {"name": "p", "vertices": [["0", "0"]], "motion": {"x": ["0", "1e308"]}}
    other = {"name": "q", "vertices": [["0", "1"], ["9", "1"]], "motion": {"x": ["0", "1.5e308"]}}
    said(certificate_by(point, other))
    assert not recwarn.list


def test_bug_tiny_bodies_that_overlap_at_the_start_are_found():
    """A filter by doubles lost the pair."""
    disc = {"name": "p", "vertices": [["2e-324", "0"]], "radius": "1e-324"}
    other = {"name": "q", "vertices": [["2.5e-324", "0"], ["2.5e-324", "1"]], "radius": "1.4e-324"}
    assert said(certificate_by(disc, other)).endswith("at t = 0 (b0 is 'p', b1 is 'q')")


def test_a_line_between_two_bodies_is_found_in_any_direction():
    """The normal of a line past a moving point is that of no edge, and not in the usual ones."""
    point = Body("p", [(0, 0)])
    past = Body("q", [(1000, 176)], Translation([0, -1996], [0, -263]))
    nodes = exactpt.certify(Scene([point, past], time=(0, 1))).text.decode().splitlines()[3:-1]
    assert len(nodes) == 1
    assert nodes[0].startswith("c ")
