"""Scenes from Python: validated when they are made, simple polygons by brute force."""

import pickle
from decimal import Decimal
from fractions import Fraction
from itertools import combinations

import pytest
from folding import every
from hypothesis import example, given
from hypothesis import strategies as st
from strategies import as_rational, fractions

import exactpt
from exactpt import AlgebraicNumber, Body, InputError, Pieces, Scene, Spin, Translation
from exactpt.testing.scenes import SPINNING, generate
from fuzz.references.real_roots import exact

grid = st.tuples(st.integers(0, 3), st.integers(0, 3))


def meet(p, q, r, s):
    """Whether the closed segments pq and rs meet: solve for both parameters."""
    d, e = (q[0] - p[0], q[1] - p[1]), (s[0] - r[0], s[1] - r[1])
    f = (r[0] - p[0], r[1] - p[1])
    det = d[0] * e[1] - d[1] * e[0]
    if det:
        u = Fraction(f[0] * e[1] - f[1] * e[0], det)
        v = Fraction(f[0] * d[1] - f[1] * d[0], det)
        return 0 <= u <= 1 and 0 <= v <= 1
    if f[0] * d[1] - f[1] * d[0]:
        return False
    on = sorted([p, q]), sorted([r, s])
    return max(on[0][0], on[1][0]) <= min(on[0][1], on[1][1])


def is_simple(points, *, closed):
    """By definition: edges meet in the one point that they share, and nowhere else."""
    n = len(points)
    edges = [(i, i + 1) for i in range(n - 1)]
    if closed and n > 2:
        edges.append((n - 1, 0))
    if any(points[i] == points[j] for i, j in edges):
        return False
    for (a, b), (c, d) in combinations(edges, 2):
        common = {a, b} & {c, d}
        if not common:
            if meet(points[a], points[b], points[c], points[d]):
                return False
            continue
        (v,) = common
        one, other = points[a + b - v], points[c + d - v]
        u = (one[0] - points[v][0], one[1] - points[v][1])
        w = (other[0] - points[v][0], other[1] - points[v][1])
        if u[0] * w[1] == u[1] * w[0] and u[0] * w[0] + u[1] * w[1] > 0:
            return False
    return True


@given(points=st.lists(grid, min_size=1, max_size=7), closed=st.booleans())
@example(points=[(0, 0), (2, 0), (1, 0)], closed=False)
@example(points=[(0, 0), (2, 0), (1, 0)], closed=True)
@example(points=[(0, 0), (1, 0), (2, 0)], closed=True)
@example(points=[(0, 0), (1, 0), (2, 0)], closed=False)
@example(points=[(0, 0), (2, 2), (2, 0), (0, 2)], closed=True)
@example(points=[(0, 0), (2, 0), (2, 2), (1, 0), (0, 2)], closed=True)
def test_simple_is_simple_by_definition(points, closed):
    body = Body("a", points, closed=closed)
    if closed and len(points) > 3 and points[0] == points[-1]:
        points = points[:-1]

    if is_simple(points, closed=closed):
        assert Scene([body]).bodies == (body,)
        return
    with pytest.raises(InputError, match="body 'a'") as refusal:
        Scene([body])
    assert len(str(refusal.value).splitlines()) == 1


@given(start=fractions)
def test_it_is_the_start_that_counts(start):
    """A segment that is a point at t = 1, and only there."""
    body = Body("a", [(0, 0), {"x": [1, -1]}])

    if start == 1:
        with pytest.raises(InputError, match="t = 1"):
            Scene([body], (as_rational(start), 9))
    else:
        assert Scene([body], (as_rational(start), 9)).bodies == (body,)


def test_positions_by_name():
    bodies = [Body("a", [(0, 0)], Translation([0, 1])), Body("b", [(5, 5), (6, "1/2")])]

    at = Scene(bodies, (0, 3)).at("5/2")

    assert {name: [(exact(x), exact(y)) for x, y in ps] for name, ps in at.items()} == {
        "a": [(Fraction(5, 2), 0)],
        "b": [(5, 5), (6, Fraction(1, 2))],
    }


def test_a_scene_up_to_an_earlier_end():
    scene = Scene([Body("a", [(0, 0)])], (1, 9))

    assert scene.until("5/2").end == as_rational(Fraction(5, 2))
    assert scene.until(20).end == 9
    assert (scene.until(2).start, scene.until(2).bodies) == (1, scene.bodies)
    assert scene.end == 9
    for end in (1, 0, "-1/2"):
        with pytest.raises(InputError, match="is not after the start t = 1"):
            scene.until(end)


def test_counts_and_repr():
    scene = Scene([Body("a", [(0, 0)]), Body("b", [(5, 5), (6, 6)])], ("1/2", 3))

    assert scene.vertex_count == 3
    assert repr(scene) == "<Scene: 2 bodies, 3 vertices, t in [1/2, 3]>"
    assert [repr(body) for body in scene.bodies] == [
        "<Body 'a': point of 1 vertex>",
        "<Body 'b': segment of 2 vertices>",
    ]


@every(
    "time, words",
    [
        ((1, 1), "time: the span from 1 to 1 is empty"),
        ((2, "1/3"), "time: the span from 2 to 1/3 is empty"),
        ((1,), "a start and an end"),
        ((1, 2, 3), "a start and an end"),
        ((float("nan"), 1), "not a finite number"),
        ((0, float("inf")), "not a finite number"),
        ((0, "soon"), "not a number: 'soon'"),
        ((False, True), "not an exact number: False"),
    ],
)
def test_time_spans_that_are_none_are_refused(time, words):
    with pytest.raises(InputError, match=words):
        Scene([], time)


def test_a_name_can_be_taken_once():
    with pytest.raises(InputError, match="body 'a': the name is taken by another body"):
        Scene([Body("a", [(0, 0)]), Body("a", [(9, 9)])])


def test_bug_a_keyframed_triangle_shaken_flat_is_shaken_again():
    assert generate("keyframed", 20028).bodies[0].name == "b0"


@pytest.mark.parametrize("last", [(0, 0), [0.0, "0"], (Fraction(0), 0)], ids=repr)
def test_a_closing_point_is_dropped(last):
    ring = [(0, 0), (2, 0), (0, 2)]

    assert Body("a", [*ring, last]).size == 3


def test_a_closing_point_of_a_ring_that_deforms_is_dropped():
    corner = {"x": [0, 1], "y": [0]}

    assert Body("a", [corner, (2, 0), (0, 2), corner]).size == 3


def test_vertices_that_only_have_the_same_keys_are_not_one():
    ring = [{"x": [0]}, {"x": [2]}, {"x": [1], "y": [2]}, {"x": [0], "y": [3]}, {"x": [-1]}]

    assert Body("a", ring).size == 5


def test_the_end_of_a_chain_is_kept():
    assert Body("a", [(0, 0), (2, 0), (0, 2), (0, 0)], closed=False).size == 4


def test_a_closing_point_in_a_file_is_refused():
    """A checker of proofs that reads the file would number the vertices in another way."""
    ring = [["0", "0"], ["2", "0"], ["0", "2"], ["0", "0"]]
    data = {"exactpt": 1, "time": ["0", "1"], "bodies": [{"name": "a", "vertices": ring}]}

    with pytest.raises(InputError, match=r"body 'a'.*the last repeats the first"):
        Scene.from_json(data)


def test_positions_at_an_irrational_time_are_decimals():
    time = AlgebraicNumber.root([-2, 0, 1], 1, 2)
    pieces = Pieces([(1, Translation([0, 1])), (None, Translation([-1, 2]))])
    scene = Scene([Body("a", [(0, 0)], pieces), Body("b", [("1/3", 1)])], (0, 9))

    assert scene.at(time, digits=20) == {
        "a": [(Decimal("1.8284271247461900976"), Decimal(0))],
        "b": [(Decimal("0.33333333333333333333"), Decimal(1))],
    }
    assert scene.at("1/2", digits=3)["a"] == [(Decimal("0.5"), 0)]
    with pytest.raises(InputError, match="irrational"):
        scene.at(time)


ASK = {
    "first_contact": exactpt.first_contact,
    "first_contact_enclosed": exactpt.first_contact_enclosed,
    "first_within": lambda scene: exactpt.first_within(scene, distance=1),
    "first_within of two": lambda scene: exactpt.first_within(scene, "a", "b", 1),
    "clearance": lambda scene: exactpt.clearance(scene, "a", "b"),
    "distance": lambda scene: exactpt.distance(scene, "a", "b", 0),
    "contact_intervals": lambda scene: exactpt.contact_intervals(scene, "a", "b"),
    "contacts": exactpt.contacts,
    "prove": exactpt.prove,
    "Simulation": exactpt.Simulation,
}


@pytest.mark.parametrize("ask", ASK.values(), ids=ASK)
@pytest.mark.parametrize("value", [None, "scene.json", [exactpt.Body("a", [(0, 0)])]])
def test_what_is_no_scene_is_refused(ask, value):
    with pytest.raises(InputError, match=r"^not a scene: "):
        ask(value)


@pytest.mark.parametrize("count", [0, 1, 2])
@pytest.mark.parametrize("one", [1, "a"])
def test_one_argument_is_neither_two_names_nor_a_distance(count, one):
    bodies = [exactpt.Body(name, [(i, 0)]) for i, name in enumerate("ab"[:count])]
    scene = exactpt.Scene(bodies, (0, 1))

    with pytest.raises(InputError, match="two names of bodies are given, or none for all bodies"):
        exactpt.first_within(scene, one)


# Families of bodies that turn at a constant rate


@pytest.mark.parametrize("family", sorted(SPINNING))
def test_they_turn_and_survive_files_and_pickles(family):
    scene = generate(family, 4)

    assert any(isinstance(body.motion, Spin) for body in scene.bodies)
    assert Scene.from_json(scene.to_json()) == scene
    assert pickle.loads(pickle.dumps(scene)) == scene
    assert generate(family, 4) == scene != generate(family, 5)
