"""Bodies with holes and several parts: what they are, what is refused, files and copies."""

import copy
import pickle

import pytest

from exactpt import Body, InputError, Scene, Translation
from exactpt.scene.format import loads
from exactpt.testing.scenes import RINGS, generate

BOX = [(0, 0), (9, 0), (9, 9), (0, 9)]
HOLE = [(1, 1), (4, 1), (4, 4), (1, 4)]
OTHER = [(5, 5), (8, 5), (8, 8), (5, 8)]
FAR = [(20, 0), (22, 0), (20, 2)]


def of(*parts, **options):
    return Scene([Body("b", parts=parts, **options)])


def test_vertices_and_edges_are_numbered_through_the_rings():
    body = Body("b", parts=[{"vertices": BOX, "holes": [HOLE]}, FAR])
    assert body.parts == ((range(4), range(4, 8)), (range(8, 11),))
    assert body.rings == (range(4), range(4, 8), range(8, 11))
    assert body.edges == [(0, 1), (1, 2), (2, 3), (3, 0), (4, 5), (5, 6), (6, 7), (7, 4),
                          (8, 9), (9, 10), (10, 8)]  # fmt: skip
    assert [(e, body.end_of_edge(e)) for e in range(11)] == body.edges
    assert body.at(0)[8] == (20, 0)
    assert repr(body) == "<Body 'b': polygon of 11 vertices in 3 rings>"


def test_one_part_is_a_polygon_with_holes():
    whole = Body("b", BOX, holes=[HOLE])
    assert whole == Body("b", parts=[{"vertices": BOX, "holes": [HOLE]}])
    assert whole != Body("b", [*BOX, *HOLE])
    assert Body("b", parts=[BOX]) == Body("b", BOX) == Body("b", BOX, holes=[])
    assert not Body("b", parts=[BOX]).has_rings


def test_a_last_vertex_that_repeats_the_first_is_dropped_in_each_ring():
    assert Body("b", [*BOX, BOX[0]], holes=[[*HOLE, HOLE[0]]]) == Body("b", BOX, holes=[HOLE])


@pytest.mark.long
@pytest.mark.parametrize("family", sorted(RINGS))
def test_copies_and_files(family):
    for seed in range(20):
        scene = generate(family, seed)
        assert Scene.from_json(scene.to_json()) == scene
        assert pickle.loads(pickle.dumps(scene)) == scene == copy.deepcopy(scene)
        hash(scene)


def test_doubles_stay_doubles():
    body = Body(
        "b", [(0.5, 0.0), (9.0, 0.0), (0.0, 9.0)], holes=[[(1.0, 1.0), (2.0, 1.0), (1.0, 2.0)]]
    )
    assert not body.exact_shape.is_exact
    Scene([body])
    assert body.at(0)[3] == (1, 1)


def test_a_motion_is_kept_by_with_motion_and_at():
    moved = Body("b", BOX, holes=[HOLE]).with_motion(Translation([0, 1]))
    assert moved.parts == Body("b", BOX, holes=[HOLE]).parts
    assert moved.at(2)[4] == (3, 1)


@pytest.mark.parametrize(
    ("parts", "message"),
    [
        ([{"vertices": BOX, "holes": [FAR]}], "a hole is outside of its outline: vertex 4 at"),
        ([{"vertices": BOX, "holes": [HOLE, [(2, 2), (3, 2), (2, 3)]]}], "inside another hole"),
        ([{"vertices": BOX, "holes": [[(0, 1), (2, 1), (0, 2)]]}], "piece: edge 3 .* edge 6"),
        ([{"vertices": BOX, "holes": [[(1, 1), (2, 2), (3, 3)]]}], "meets edge"),
        ([{"vertices": BOX, "holes": [HOLE, [(4, 2), (5, 4), (4, 3)]]}], "common piece: edge 5 "),
        ([BOX, HOLE], "a part is inside another part: vertex 4"),
        ([HOLE, BOX], "a part is inside another part: vertex 0"),
        ([BOX, [(9, 3), (12, 3), (9, 4)]], "common piece: edge 1 .* exactpt.union joins"),
        ([BOX, [(0, 0), (0, 9), (9, 9), (9, 0)]], "meets edge"),
        ([[(0, 0), (1, 1)], FAR], "part 0: outline: a ring has at least 3 vertices, not 2"),
        ([{"vertices": BOX, "holes": [[(1, 1), (2, 2)]]}], "part 0: hole 0: a ring has at least"),
        ([{"vertices": BOX, "hole": [HOLE]}], "part 0: unknown key 'hole'"),
        ([{"holes": [HOLE]}], 'part 0: no "vertices"'),
        ([BOX, [(1, 2), (3,), (4, 5)]], "part 1: outline: vertex 1: a vertex has two coordinates"),
        ([], "at least one part is needed"),
        ([FAR, 5], "part 1: outline: vertices: not a list"),
    ],
)  # fmt: skip
def test_what_is_no_body_is_refused(parts, message):
    with pytest.raises(InputError, match=f"body 'b': .*{message}"):
        of(*parts)


def test_nested_parts_are_allowed():
    of({"vertices": BOX, "holes": [HOLE, OTHER]}, [(2, 2), (3, 2), (2, 3)], FAR)


@pytest.mark.parametrize(
    ("given", "message"),
    [
        ({"holes": [HOLE], "parts": [BOX]}, "holes are for a body of vertices"),
        ({"parts": [BOX], "closed": False}, "an open chain has neither holes nor parts"),
        ({"vertices": BOX, "parts": [FAR]}, "give either vertices or keyframes or parts"),
        ({"keyframes": [(0, BOX)], "holes": [HOLE]}, "holes are for a body of vertices"),
        ({"vertices": BOX, "holes": 3}, "holes: not a list: 3"),
    ],
)
def test_what_does_not_go_together(given, message):
    with pytest.raises(InputError, match=f"body 'b': {message}"):
        Body("b", **given)


@pytest.mark.parametrize(
    ("body", "message"),
    [
        ('"vertices": [[0,0],[9,0],[0,9]], "holes": [[[1,1],[2,1],["x",2]]]',
         "body 'b': hole 0: vertex 2: x: not a number: 'x'"),
        ('"vertices": [[0,0],[9,0],[0,9]], "holes": [[[1,1],[2,1],[1,2],[1,1]]]',
         "body 'b': hole 0: the last repeats the first"),
        ('"vertices": [[0,0],[9,0],[0,9]], "holes": {}', "body 'b': \"holes\": not a list"),
        ('"parts": [{"vertices": [[0,0],[9,0],[0,9]], "motion": {}}]',
         "body 'b': part 0: unknown key 'motion'"),
        ('"parts": [{"vertices": [[0,0],[9,0],[0,9]], "holes": [[]]}]',
         "body 'b': part 0: hole 0: at least one vertex is needed"),
        ('"parts": [{}], "holes": []', "body 'b': \"holes\" belong to \"vertices\""),
        ('"parts": [[[0,0],[9,0],[0,9]]]', "body 'b': part 0: not an object"),
        ('"closed": false, "parts": [{"vertices": [[0,0],[9,0],[0,9]]}]',
         "body 'b': an open chain has neither holes nor parts"),
        ('"parts": []', "body 'b': \"parts\": at least one part is needed"),
        ('"keyframes": [], "parts": []', 'needs either "vertices" or "keyframes" or "parts"'),
    ],
)  # fmt: skip
def test_what_is_wrong_in_a_file_is_named(body, message):
    with pytest.raises(InputError) as raised:
        loads(f'{{"exactpt": 1, "time": [0, 1], "bodies": [{{"name": "b", {body}}}]}}')
    assert message in str(raised.value)


def test_one_hole_inside_of_another_among_many():
    """Only rings whose boxes intersect are compared."""
    holes = [
        [(3 * i, 3 * j), (3 * i + 2, 3 * j), (3 * i, 3 * j + 2)]
        for i in range(10)
        for j in range(10)
    ]
    outline = [(-1, -1), (99, -1), (99, 99), (-1, 99)]
    Scene([Body("plate", outline, holes=holes)])

    holes.append([(12.25, 12.25), (12.5, 12.25), (12.25, 12.5)])
    with pytest.raises(InputError, match="inside another hole: vertex 304"):
        Scene([Body("plate", outline, holes=holes)])
    holes[-1] = [(200, 200), (201, 200), (200, 201)]
    with pytest.raises(InputError, match="outside of its outline: vertex 304"):
        Scene([Body("plate", outline, holes=holes)])
