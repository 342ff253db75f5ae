"""First contacts in space: degenerate queries by hand, arrays, the oracle, check, the fuzzer."""

import json
from fractions import Fraction
from random import Random

import numpy as np
import pytest
from click.testing import CliRunner
from hypothesis import given, settings

from exactpt.cli import cli
from exactpt.errors import InputError
from exactpt.testing import strategies
from exactpt.testing.oracle import Refusals, answers
from exactpt.testing.space import (
    FAMILIES,
    SpaceQuery,
    assert_same_time,
    check_edge_edge,
    check_vertex_face,
    edge_edge,
    edge_edge_array,
    make_query,
    vectorized,
    vertex_face,
    vertex_face_array,
)
from exactpt.testing.space import exact as exact_module
from exactpt.testing.space.exact import contact_of
from fuzz.questions.checks import checked
from fuzz.space_queries import compare_public_queries

FACE = [(-1, -1, 0), (2, -1, 0), (-1, 2, 0)]
KINDS = {"vertex-face": (vertex_face, vertex_face_array), "edge-edge": (edge_edge, edge_edge_array)}


def answer(contact):
    """The time and the coordinates, as rationals."""
    if contact is None:
        return None
    u, v = contact.coordinates
    return tuple(Fraction(*c.as_integer_ratio()) for c in (contact.time, u, v))


@pytest.mark.parametrize(
    "start, end, expected",
    [
        # through the face, through a vertex, along an edge, beside it
        ((0, 0, 1), (0, 0, -2), (Fraction(1, 3), Fraction(1, 3), Fraction(1, 3))),
        ((-1, -1, 1), (-1, -1, -1), (Fraction(1, 2), 0, 0)),
        ((-2, -1, 0), (2, -1, 0), (Fraction(1, 4), 0, 0)),
        ((-2, -2, 0), (2, -2, 0), None),
        # at the end, at the start
        ((0, 0, 1), (0, 0, 0), (1, Fraction(1, 3), Fraction(1, 3))),
        ((2, -1, 0), (9, 9, 9), (0, 1, 0)),
    ],
)
def test_vertex_and_a_face_at_rest(start, end, expected):
    assert answer(vertex_face([start, *FACE], [end, *FACE])) == expected


def test_face_that_is_a_segment_at_all_times():
    """The vertex passes through a face whose vertices are collinear: u is least, then v."""
    face = [(0, 0, 0), (4, 0, 0), (2, 0, 0)]

    contact = vertex_face([(1, 1, 0), *face], [(1, -1, 0), *face])

    assert answer(contact) == (Fraction(1, 2), 0, Fraction(1, 2))


def test_face_that_is_a_point():
    face = [(1, 1, 1)] * 3

    assert answer(vertex_face([(0, 0, 0), *face], [(2, 2, 2), *face])) == (Fraction(1, 2), 0, 0)
    assert vertex_face([(0, 0, 0), *face], [(2, 2, 3), *face]) is None


def test_face_that_collapses_onto_the_vertex():
    """The triangle shrinks to the vertex: all four coincide at t = 1, and never before."""
    contact = vertex_face([(9, 9, 9), *FACE], [(0, 0, 0)] * 4)

    assert answer(contact) == (1, 0, 0)


@pytest.mark.parametrize(
    "start, expected",
    [
        # they cross, an end meets an end, collinear, parallel and beside each other
        ([(-1, 0, 0), (1, 0, 0), (0, -1, 1), (0, 1, 1)], (0.5, 0.5, 0.5)),
        ([(-1, 0, 0), (1, 0, 0), (1, 0, 1), (5, 5, 1)], (0.5, 1, 0)),
        ([(0, 0, 0), (4, 0, 0), (2, 0, 1), (9, 0, 1)], (0.5, 0.5, 0)),
        ([(0, 0, 0), (4, 0, 0), (0, 1, 1), (4, 1, 1)], None),
        # a point and a segment, two points
        ([(1, 0, 0), (1, 0, 0), (0, 0, 1), (4, 0, 1)], (0.5, 0, 0.25)),
        ([(1, 0, 0), (1, 0, 0), (1, 0, 2), (1, 0, 2)], (0.5, 0, 0)),
    ],
)
def test_edges_of_which_one_moves_down(start, expected):
    below = [(x, y, -z) if k > 1 else (x, y, z) for k, (x, y, z) in enumerate(start)]

    assert answer(edge_edge(start, below)) == expected


def test_tangential_contact_is_a_contact_and_a_near_miss_is_none():
    """The cubic has a double root; a gap of 2^-1000 turns it into none."""

    def query(gap):
        rows = []
        for slope in (Fraction(-1, 2), Fraction(1, 2)):
            corners = [(-2, -2, -2 * slope), (2, -2, 2 * slope), (0, 2, 0)]
            rows.append([(slope, 0, gap), *corners])
        return rows

    assert answer(vertex_face(*query(0))) == (0.5, 0.25, 0.5)
    assert vertex_face(*query(Fraction(-1, 2**1000))) is None
    low, high = (vertex_face(*query(Fraction(k, 2**1000))) for k in (1, 4))
    assert high.time < low.time < Fraction(1, 2)


def test_irrational_time_and_coordinates_are_roots():
    contact = vertex_face([(0, 0, 2), *FACE], [(1, 0, -1), (-1, -1, 0), (2, -1, 1), (-1, 2, 3)])

    assert not contact.time.is_rational
    t = float(contact.time)
    corners = np.array([(-1, -1, 0), (2, -1, t), (-1, 2, 3 * t)])
    u, v = map(float, contact.coordinates)
    point = corners[0] + u * (corners[1] - corners[0]) + v * (corners[2] - corners[0])
    assert np.allclose(point, (t, 0, 2 - 3 * t), atol=1e-14)


@pytest.mark.parametrize("kind", KINDS)
def test_arrays_equal_single_queries_in_all_families(kind):
    one, many = KINDS[kind]
    queries = [make_query(kind, family, 1, n) for family in FAMILIES for n in range(12)]

    contacts = many([q.start + q.end for q in queries])

    for k, query in enumerate(queries):
        contact = one(query.start, query.end)
        assert bool(contacts.hit[k]) == (contact is not None)
        if contact is not None:
            assert contacts.low[k] <= contact.time <= contacts.high[k]
            assert contacts.contact(k).time == contact.time
    assert 0 < contacts.exact_share < 1


@pytest.mark.parametrize("kind", KINDS)
@pytest.mark.parametrize("size", [2.0**-1060, 2.0**-340, 1.0, 2.0**340, 2.0**970])
def test_filter_never_excludes_a_contact_at_any_size(kind, size):
    """Contacts with coordinates that differ in the last places, scaled to the ends of the range."""
    random = Random(f"{kind} {size}")
    points = []
    for number in range(150):
        query = make_query(kind, random.choice(["graze", "far", "boundary"]), 2, number)
        points.append(np.array(query.start + query.end) * size)
    points = np.array(points)
    points = np.nextafter(
        points, points + np.array([random.choice([-1, 1]) for _ in range(3)]) * size
    )

    contacts = KINDS[kind][1](points)

    for k in np.nonzero(~contacts.exact)[0]:
        assert KINDS[kind][0](points[k, :4].tolist(), points[k, 4:].tolist()) is None


def test_bernstein_filter_is_wrong_without_its_bound(monkeypatch):
    """The test above can fail: without error bounds, the filter excludes a contact."""
    monkeypatch.setattr(vectorized, "U", 0.0)
    monkeypatch.setattr(vectorized, "TINY", -1e-3)

    with pytest.raises(AssertionError):
        test_filter_never_excludes_a_contact_at_any_size("vertex-face", 1.0)


def test_refused_queries():
    good = make_query("edge-edge", "interior", 0, 0)
    bad = np.array([good.start + good.end] * 2)
    bad[1, 6, 1] = np.nan

    with pytest.raises(InputError, match="query 1: coordinate y of vertex 2 at t = 1 is nan"):
        edge_edge_array(bad)
    masked = edge_edge_array(bad, errors="mask")

    assert masked.refused.tolist() == [False, True]
    assert masked.hit.tolist() == [True, False]
    assert np.isnan(masked.low[1])
    assert np.isnan(masked.high[1])
    assert masked.reasons() == [(1, "coordinate y of vertex 2 at t = 1 is nan")]
    with pytest.raises(InputError, match=r"expected the shape \(n, 8, 3\), got \(2, 3\)"):
        edge_edge_array(np.zeros((2, 3)))
    with pytest.raises(InputError, match="expected 4 points of 3 coordinates"):
        edge_edge([(0, 0, 0)], [(0, 0, 0)])
    assert len(vertex_face_array(np.zeros((0, 8, 3)))) == 0


def test_queries_are_the_same_everywhere():
    query = make_query("vertex-face", "graze", 3, 4)

    assert SpaceQuery.from_json(json.loads(json.dumps(query.to_json()))) == query
    with pytest.raises(InputError, match="no family 'none'"):
        make_query("vertex-face", "none")
    with pytest.raises(InputError, match='"kind": expected one of vertex-face, edge-edge'):
        SpaceQuery.from_json({"kind": "face-face"})
    with pytest.raises(InputError, match='"end": expected 4 points'):
        SpaceQuery.from_json({**query.to_json(), "end": [[0, 0, 0]]})


@pytest.mark.long
@pytest.mark.parametrize("check", [check_vertex_face, check_edge_edge])
def test_check_counts_and_shrinks_the_mistakes_of_a_function(check):
    def toi(query):
        contact = contact_of(query)
        return None if contact is None or contact.time == 1 else contact.time

    report = check(toi, cases=120, seed=5, families=["boundary", "interior"])

    assert set(report.table.rows) == {"boundary", "interior"}
    assert report.table.total["missed"] + report.table.total["crashed"] > 0
    assert all(e.question.size <= 12 for e in report.counterexamples if e.verdict == "missed")
    text = report.pytest_file()
    assert "from exactpt.testing.space import SpaceQuery, assert_same_time" in text
    compile(text, "test_it.py", "exec")


def test_right_answers_are_right():
    def toi(query):
        contact = contact_of(query)
        return None if contact is None else float(contact.time)

    assert check_vertex_face(toi, cases=60).ok
    assert check_edge_edge(toi, cases=60).ok
    with pytest.raises(AssertionError, match="missed: the answer is None; the truth is t = 1/2"):
        assert_same_time(SpaceQuery("vertex-face", ((0, 0, 1), *FACE), ((0, 0, -1), *FACE)), None)


def test_oracle_answers_planar_questions_and_queries_in_space(tmp_path):
    query = make_query("edge-edge", "interior", 0, 1)
    lines = [
        json.dumps(query.to_json()).encode(),
        b'{"time": [0, 1], "a": {"vertices": [[0, 0]]}, "b": {"vertices": [[0, 0]]}}',
        b'{"kind": "edge-edge", "start": 1, "end": 2}',
    ]
    refusals = Refusals()

    first, second, third = map(json.loads, answers(lines, 1, refusals))

    assert first["id"] == query.name
    assert first["time"] == contact_of(query).time.to_json()
    assert len(first["coordinates"]) == 2
    assert second["kind"] == "initial"
    assert third["error"] == '"start": expected 4 points of 3 coordinates, got 1'
    assert refusals.count == 1
    (tmp_path / "queries.jsonl").write_bytes(lines[0] + b"\n")
    result = CliRunner().invoke(cli, ["oracle", str(tmp_path / "queries.jsonl")])
    assert json.loads(result.output) == first


@pytest.mark.parametrize("number", range(40))
def test_first_contact_equals_the_enumeration_of_vertices(number):
    assert checked("space", 9, number).fault is None


def test_public_queries_are_read_and_compared(tmp_path):
    rows = ["0,1,0,1,1,1", "-1,1,-1,1,0,1", "2,1,-1,1,0,1", "-1,1,2,1,0,1"]
    rows += ["0,1,0,1,-1,2", *rows[1:]]
    lines = []
    (tmp_path / "unit-vertex-face-0.csv").write_text("\n".join(f"{row},1" for row in rows))
    (tmp_path / "unit-edge-edge-0.csv").write_text("\n".join(f"{row},1" for row in rows))

    differences = compare_public_queries(tmp_path, 5, lines.append)

    assert differences == 1 + 5  # edges are said to touch and do not
    assert lines[0].startswith("2 queries, 1 differences, 1 contacts, 0 of them at irrational")
    assert "5 in arrays, 0 differences" in lines[1]
    (tmp_path / "unit-edge-edge-0.csv").write_text("1,2")
    with pytest.raises(InputError, match="not eight rows of seven integers"):
        compare_public_queries(tmp_path, None, lines.append)


def test_enumeration_finds_a_planted_mistake(monkeypatch):
    """Ends of degenerate contacts are forgotten."""
    monkeypatch.setattr(exact_module, "_contains_origin", lambda *_: False)

    assert any(checked("space", 9, number).fault for number in range(80))


@pytest.mark.parametrize("kind", KINDS)
def test_strategies_draw_queries_of_a_kind(kind):
    drawn = []

    @settings(max_examples=30, database=None)
    @given(strategies.space_queries(kind), strategies.space_queries(kind, "graze"))
    def draw(any_query, grazing):
        assert any_query.kind == grazing.kind == kind
        assert str(grazing.name).startswith("graze:0:")
        contact = contact_of(any_query)
        drawn.append(contact is not None)

    draw()

    assert len(drawn) >= 25
    with pytest.raises(InputError, match="no family"):
        strategies.space_queries(kind, "none")
