"""The protocol: the README's examples word for word, every reason for `bad`, every bad input."""

import re
import subprocess
from pathlib import Path

import pytest
from folding import every

pytestmark = pytest.mark.cgal

README = Path(__file__).parents[3] / "cgal_check" / "README.md"
EXAMPLES = re.findall(
    r"```request\n(.*?)```\n```answer\n(.*?)\n```", README.read_text(encoding="utf-8"), re.DOTALL
)
GREETING = "exactpt-check 1\n"


def run(program, text):
    """Exit code and the answers after the greeting's."""
    done = subprocess.run([program], input=text.encode(), capture_output=True, check=False)
    return done.returncode, done.stdout.decode().splitlines()[1:]


def test_there_is_an_example_of_every_request():
    requests = {request.split()[0] for request, _ in EXAMPLES}

    assert requests == {
        "tiling",
        "triangulation",
        "root",
        "compare",
        "sign",
        "hull",
        "orientations",
        "pair",
        "union",
    }
    assert README.read_text(encoding="utf-8").count("```request") == len(EXAMPLES)


@every("request_text, answer", EXAMPLES)
def test_example_of_the_readme(program, request_text, answer):
    code, answers = run(program, GREETING + request_text)

    assert answers == [answer]
    assert code == (2 if answer.startswith("error") else 0)


def test_many_requests_a_process(program):
    good = [(r, a) for r, a in EXAMPLES if not a.startswith("error")]

    code, answers = run(program, GREETING + "".join(r for r, _ in good) * 3)

    assert answers == [a for _, a in good] * 3
    assert code == 0


# A square with corners 0..3 and a point 4 to the right of it; `{}` in the order of reading.
TILING = """tiling deep vertices {vertices} bodies {bodies} edges {edges} faces {faces} end"""
SOUND = {
    "vertices": "5  0 0  2 0  2 2  0 2  4 1",
    "bodies": "2  polygon 4 0 1 2 3  point 4",
    "edges": (
        "6  0 1 boundary hull  1 2 boundary inner  2 3 boundary hull  3 0 boundary hull"
        "  1 4 diagonal hull  4 2 diagonal hull"
    ),
    "faces": "1  3 1 4 2 corners 1 4 2",
}
OPEN = {  # three points in a triangle and a fourth inside, joined to nothing but 0 and 1
    "vertices": "4  0 0  6 0  3 6  3 2",
    "bodies": "4  point 0  point 1  point 2  point 3",
    "edges": (
        "5  0 1 diagonal hull  1 2 diagonal hull  2 0 diagonal hull"
        "  0 3 diagonal inner  1 3 diagonal inner"
    ),
    "faces": "2  3 0 1 3 corners 0 1 3  4 0 3 1 2 corners 0 1 2",
}
ROUND = {  # a triangle within a triangle, not joined to it
    "vertices": "6  0 0  9 0  0 9  1 1  2 1  1 2",
    "bodies": "2  ring 3 3 4 5  chain 3 0 1 2",
    "edges": (
        "6  0 1 boundary hull  1 2 boundary hull  2 0 diagonal hull"
        "  3 4 boundary inner  4 5 boundary inner  5 3 boundary inner"
    ),
    "faces": "1  3 0 1 2 corners 0 1 2",
}


FRAME = {  # a square with a square hole, and a point in it
    "vertices": "9  0 0  6 0  6 6  0 6  1 1  5 1  5 5  1 5  2 4",
    "bodies": "2  parts 1 4 0 1 2 3 holes 1 4 7 6 5 4  point 8",
    "edges": (
        "11  0 1 boundary hull  1 2 boundary hull  2 3 boundary hull  3 0 boundary hull"
        "  4 5 boundary inner  5 6 boundary inner  6 7 boundary inner  7 4 boundary inner"
        "  4 8 diagonal inner  5 8 diagonal inner  6 8 diagonal inner"
    ),
    "faces": "3  3 4 5 8 corners 4 5 8  3 5 6 8 corners 5 6 8  4 6 7 4 8 corners 4 6 7",
}


def tiling(base, **changes):
    return TILING.format(**(base | changes))


def replaced(base, part, old, new):
    assert old in base[part]
    return tiling(base, **{part: base[part].replace(old, new)})


ON_A_LINE = OPEN | {
    "vertices": "4  0 0  1 0  2 0  3 0",
    "edges": "3  0 1 diagonal hull  2 1 diagonal hull  2 3 diagonal hull",
    "faces": "0",
}
HULL = "0 1 diagonal hull  1 2 diagonal hull  2 0 diagonal hull"
INSIDE = "the inside of body 0, 0-1-2-3, is not one region"
THROUGH = "an edge passes through"


def edges(base, count, without="", extra=""):
    """The edges of a base, some text taken away and other added."""
    assert without in base["edges"]
    text = base["edges"].split(maxsplit=1)[1].replace(without, "")
    return tiling(base, edges=f"{count} {text} {extra}")


def face(base, text):
    return tiling(base, faces=text)


WITHOUT_COORDINATES = [
    (
        replaced(SOUND, "bodies", "point 4", "point 3"),
        "vertex 3 belongs to body 0 and again to body 1",
    ),
    (tiling(SOUND, bodies="1 polygon 4 0 1 2 3"), "vertex 4 belongs to no body"),
    (
        replaced(SOUND, "edges", "1 4 diagonal", "1 4 boundary"),
        "edge 1-4 is called a boundary edge but no body has it",
    ),
    (
        replaced(SOUND, "edges", "1 2 boundary", "1 2 diagonal"),
        "edge 1-2 is called a diagonal but is an edge of a body",
    ),
    (replaced(SOUND, "edges", "1 4 diagonal", "4 4 diagonal"), "edge 4-4 has one end"),
    (replaced(SOUND, "edges", "1 4 diagonal", "2 4 diagonal"), "edge 4-2 is there twice"),
    (edges(SOUND, 5, without="1 2 boundary inner"), "edge 1-2 of a body is missing"),
    (
        edges(SOUND, 4, without="1 4 diagonal hull  4 2 diagonal hull"),
        "vertex 4 is isolated",
    ),
    (face(SOUND, "1  2 1 4 corners 1 4 2"), "face 0 has fewer than three vertices"),
    (face(SOUND, "1  4 1 4 2 4 corners 1 4 2"), "face 0 has a vertex twice"),
    (face(SOUND, "1  3 1 4 2 corners 1 4 4"), "face 0 has a corner twice"),
    (
        face(SOUND, "1  3 1 4 2 corners 1 4 3"),
        "face 0 has corner 3, which is no vertex of it",
    ),
    (replaced(SOUND, "bodies", "0 1 2 3", "3 2 1 0"), "body 0 is clockwise"),
    (replaced(FRAME, "bodies", "4 0 1 2 3", "4 3 2 1 0"), "body 0 is clockwise"),
    (replaced(FRAME, "bodies", "4 7 6 5 4", "4 4 5 6 7"), "a hole of body 0 is counter-clockwise"),
    (
        replaced(FRAME, "vertices", "1 1  5 1  5 5  1 5", "1 1  2 1  3 1  4 1"),
        "a hole of body 0 has no area",
    ),
    (
        replaced(FRAME, "bodies", "4 7 6 5 4", "4 7 6 5 3"),
        "vertex 3 belongs to body 0 and again to body 0",
    ),
    (edges(FRAME, 10, without="4 5 boundary inner"), "edge 4-5 of a body is missing"),
    (tiling(SOUND, vertices="5  0 0  1 0  2 0  3 0  4 1"), "body 0 has no area"),
]

# The words of the triangulation and of the arrangement.
WITH_COORDINATES = [
    (
        replaced(SOUND, "vertices", "4 1", "0 2"),
        "vertices 3 and 4 are at one point",
        "vertices 3 and 4 coincide",
    ),
    (replaced(SOUND, "vertices", "4 1", "2 1"), "vertex 4 lies inside edge 1-2", THROUGH),
    (replaced(SOUND, "vertices", "4 1", "1 1"), INSIDE, INSIDE),
    (replaced(SOUND, "vertices", "4 1", "-1 1"), "cross", "edges cross near"),
    (
        edges(SOUND, 5, without="4 2 diagonal hull"),
        "hull edge 2-4 is missing",
        "not convex at vertex",
    ),
    (edges(SOUND, 7, extra="0 2 diagonal inner"), INSIDE, INSIDE),
    (
        replaced(SOUND, "edges", "4 2 diagonal hull", "4 2 diagonal inner"),
        *["edge 4-2 is on the hull, but called inner"] * 2,
    ),
    (
        replaced(SOUND, "edges", "1 2 boundary inner", "1 2 boundary hull"),
        *["edge 1-2 is not on the hull"] * 2,
    ),
    (face(SOUND, "0"), *["the free region 1-4-2 is not among the faces"] * 2),
    (face(SOUND, "1  3 1 2 4 corners 1 4 2"), *["face 0, 1-2-4, is clockwise"] * 2),
    (
        face(SOUND, "1  3 0 1 2 corners 0 1 2"),
        *["face 0, 0-1-2, is no free region of the edges"] * 2,
    ),
    (
        face(SOUND, "2  3 1 4 2 corners 1 4 2  3 4 2 1 corners 1 4 2"),
        *["face 1, 4-2-1, is there twice"] * 2,
    ),
    (
        replaced(OPEN, "faces", "corners 0 1 2", "corners 0 1 3"),
        *["face 1, 0-3-1-2, has corners 0-1-2, not 0-1-3"] * 2,
    ),
    (
        tiling(
            OPEN,
            vertices="4  0 0  6 0  6 6  0 6",
            edges="4  0 1 diagonal hull  1 2 diagonal hull  2 3 diagonal hull  3 0 diagonal hull",
            faces="1  4 0 1 2 3 corners 0 1 2",
        ),
        *["the region 0-1-2-3 has 4 convex corners: 0-1-2-3"] * 2,
    ),
    (replaced(OPEN, "vertices", "3 2", "3 -1"), *["face 0, 0-1-3, is clockwise"] * 2),
    (replaced(OPEN, "vertices", "3 2", "3 0"), "vertex 3 lies inside edge 0-1", THROUGH),
    (
        tiling(OPEN, vertices="4  0 0  6 0  3 6  3 0", edges=f"4  {HULL}  2 3 diagonal inner"),
        "vertex 3 lies inside edge 0-1",
        THROUGH,
    ),
    (
        edges(OPEN, 4, without="1 3 diagonal inner"),
        "vertex 0 is twice on the boundary",
        "meets itself",
    ),
    (
        tiling(
            OPEN,
            bodies="3  segment 0 3  point 1  point 2",
            edges=f"4  {HULL}  0 3 boundary inner",
        ),
        "vertex 0 is twice on the boundary",
        "meets itself",
    ),
    (tiling(ROUND), *["the region inside 0-1-2 has a second boundary"] * 2),
    # The hole is taken for a body; the point is moved into what is solid, an edge drawn there; a
    # face is left out; the hole is beside the square; a diagonal is missing.
    (
        tiling(FRAME, bodies="3  polygon 4 0 1 2 3  polygon 4 4 5 6 7  point 8"),
        *["the inside of body 0, 0-1-2-3, is not one region"] * 2,
    ),
    (
        replaced(FRAME, "vertices", "2 4", "1/2 2"),
        "cross",
        "edges cross near",
    ),
    (
        edges(FRAME, 12, extra="0 4 diagonal inner"),
        "vertex 0 is twice on the boundary",
        "meets itself",
    ),
    (
        replaced(FRAME, "faces", "3  3 4 5 8 corners 4 5 8", "2"),
        *["the free region 4-5-8 is not among the faces"] * 2,
    ),
    (
        tiling(FRAME, vertices="9  0 0  6 0  6 6  0 6  11 1  15 1  15 5  11 5  12 4"),
        "hull edge",
        "the edges are not connected",
    ),
    (
        edges(FRAME, 10, without="4 8 diagonal inner"),
        *["the region 4-5-8-6-7 has 4 convex corners"] * 2,
    ),
    (
        tiling(ROUND, vertices="6  0 0  1 0  0 1  5 5  6 5  5 6"),
        "hull edge",
        "the edges are not connected",
    ),
    (edges(ON_A_LINE, 4, extra="0 2 diagonal hull"), "vertex 1 lies inside edge 0-2", THROUGH),
    # As many edges as the pieces into which they cut each other.
    (
        replaced(ON_A_LINE, "edges", "2 1 diagonal hull", "2 0 diagonal inner"),
        "vertex 1 lies inside edge 2-0",
        THROUGH,
    ),
    (
        edges(ON_A_LINE, 2, without="2 1 diagonal hull"),
        "hull edge 1-2 is missing",
        "the edges are not connected",
    ),
    (
        replaced(ON_A_LINE, "edges", "2 3 diagonal hull", "2 3 diagonal inner"),
        *["edge 2-3 is on the hull, but called inner"] * 2,
    ),
    (
        face(ON_A_LINE, "1  3 0 1 2 corners 0 1 2"),
        *["face 0, 0-1-2, is no free region of the edges"] * 2,
    ),
]


@pytest.mark.parametrize("base", [SOUND, OPEN, ON_A_LINE, FRAME])
def test_sound_tilings_of_this_file_are_accepted(program, base):
    code, (answer,) = run(program, GREETING + tiling(base))

    assert (code, answer.split()[0], answer.split()[-2:]) == (0, "ok", ["witnesses", "2"])


@every("request_text, reason", WITHOUT_COORDINATES)
def test_reason_that_needs_no_regions(program, request_text, reason):
    assert run(program, GREETING + request_text) == (0, [f"bad {reason}"])


@pytest.mark.parametrize("request_text, first, second", WITH_COORDINATES)
def test_reasons_of_both_witnesses(program, request_text, first, second):
    code, (answer,) = run(program, GREETING + request_text)

    words = re.fullmatch(r"bad triangulation: (.*); arrangement: (.*)", answer)
    assert code == 0
    assert first in words[1]
    assert second in words[2]


@pytest.mark.parametrize("x", ["2", "4/2", f"{2 * 10**40}/{10**40}"])
def test_one_witness_answers_without_being_named(program, x):
    text = replaced(SOUND, "vertices", "4 1", f"{x} 1").replace("tiling deep", "tiling")

    assert run(program, GREETING + text) == (0, ["bad vertex 4 lies inside edge 1-2"])


def test_a_triangulation_has_triangles_only(program):
    quadrangle = tiling(OPEN).replace("tiling", "triangulation")
    quadrangle = quadrangle.replace(f"faces {OPEN['faces']} ", "")

    code, (answer,) = run(program, GREETING + quadrangle)

    assert code == 0
    assert answer.count("the region 0-3-1-2 is not a triangle") == 2


FAULTS = [
    ("tile", "unknown request: 'tile'"),
    ("hull 0 end end", "unknown request: 'end'"),
    ("hull 0 0 end", "expected 'end', found '0'"),
    ("hull 1 0 0", "the input ends in the middle of a request"),
    ("hull 2 0 0 end", "expected a rational, found 'end'"),
    ("hull -1 end", "expected a count, found '-1'"),
    ("hull 99999999999999999999 end", "count is too large: 99999999999999999999"),
    ("hull 10000000", "the input ends in the middle of a request"),
    ("hull 1 1/0 1 end", "denominator is zero: 1/0"),
    ("hull 1 1/000 1 end", "denominator is zero: 1/000"),
    ("hull 1 1/-2 1 end", "expected a rational, found '1/-2'"),
    ("hull 1 0.5 1 end", "expected a rational, found '0.5'"),
    ("hull 1 nan 1 end", "expected a rational, found 'nan'"),
    ("hull 1 +1 1 end", "expected a rational, found '+1'"),
    ("hull 1 - 1 end", "expected a rational, found '-'"),
    ("hull 1 1/2/3 1 end", "expected a rational, found '1/2/3'"),
    ("hull 1 0x10 1 end", "expected a rational, found '0x10'"),
    ("hull 1 1_0 1 end", "expected a rational, found '1_0'"),
    ("hull 1 \x01\xff 1 end", "expected a rational, found '??'"),
    (f"hull 1 {'7' * 99}x 1 end", f"expected a rational, found '{'7' * 40}...'"),
    ("root polynomial 2 1 0 between 0 1 end", "the leading coefficient of a polynomial is zero"),
    ("root polynomial 0 between 0 1 end", "every number is a root of the zero polynomial"),
    ("root polynomial 2 1 1/2 between 0 1 end", "expected an integer, found '1/2'"),
    ("root polynomial 1 1 1 between 0 1 end", "expected 'between', found '1'"),
    ("root polynomial 2 1 1 between 1 0 end", "the interval is reversed"),
    (replaced(SOUND, "vertices", "5  ", "4  "), "expected 'bodies', found '4'"),
    (replaced(SOUND, "vertices", "5  ", "6  "), "expected a rational, found 'bodies'"),
    (replaced(SOUND, "bodies", "point 4", "point 5"), "no such vertex: 5 of 5"),
    (replaced(SOUND, "bodies", "point 4", "disc 4"), "unknown kind of body: 'disc'"),
    (
        replaced(SOUND, "bodies", "polygon 4", "polygon 2"),
        "a polygon has three vertices or more, not 2",
    ),
    (replaced(FRAME, "bodies", "parts 1", "parts 0"), "a body has one part or more"),
    (replaced(FRAME, "bodies", "holes 1", "4 7 6 5 4"), "expected 'holes', found '4'"),
    (
        replaced(FRAME, "bodies", "holes 1 4 7 6 5 4", "holes 1 2 7 6"),
        "a hole has three vertices or more, not 2",
    ),
    (
        replaced(SOUND, "edges", "1 4 diagonal", "1 4 bridge"),
        "expected 'boundary' or 'diagonal', found 'bridge'",
    ),
    (
        replaced(SOUND, "edges", "4 2 diagonal hull", "4 2 diagonal"),
        "expected 'hull' or 'inner', found 'faces'",
    ),
    (replaced(SOUND, "faces", "corners 1 4 2", "corners 1 4"), "expected a count, found 'end'"),
    (replaced(SOUND, "faces", "3 1", "4 1"), "expected a count, found 'corners'"),
    ("pair vertices 1 0 0 bodies 1 point 0 end", "a pair has two bodies, not 1"),
    ("pair vertices 1 0 0 bodies 3 point 0 point 0 point 0 end", "a pair has two bodies, not 3"),
    ("pair vertices 1 0 0 bodies 2 point 0 point 1 end", "no such vertex: 1 of 1"),
    ("pair vertices 1 0 0 bodies 2 point 0 disc 0 end", "unknown kind of body: 'disc'"),
    ("pair bodies 0 end", "expected 'vertices', found 'bodies'"),
    ("pair vertices 0 bodies 0 edges", "expected 'end', found 'edges'"),
    ("union vertices 0 bodies 0 end", "a union has one body or more"),
]
NO_GREETING = [
    ("", "the input ends in the middle of a request"),
    ("exactpt-check 2", "expected '1', found '2'"),
    ("tiling", "expected 'exactpt-check', found 'tiling'"),
]


@pytest.mark.parametrize(
    "text, what", NO_GREETING + [(GREETING + text, what) for text, what in FAULTS]
)
def test_bad_input_gets_one_line_and_exit_code_2(program, text, what):
    done = subprocess.run([program], input=text.encode("latin-1"), capture_output=True, check=False)

    last = done.stdout.decode("ascii").splitlines()[-1]
    assert re.fullmatch(r"error line \d+: (.*)", last)[1] == what
    assert done.returncode == 2


def test_every_truncation_is_an_error_or_complete(program):
    """Cut anywhere, a request is refused: nothing is answered before its end was read."""
    words = tiling(OPEN).split()
    for n in range(1, len(words)):
        code, (answer,) = run(program, GREETING + " ".join(words[:n]))
        assert (code, answer[:5]) == (2, "error")
