"""The features of two pieces that may be nearest at one time."""

import math

import pytest

from exactpt.filters import nearest
from exactpt.filters.nearest import Nearest, Tree
from exactpt.filters.rows import EXACT, STRAIGHT, Errors, Piece, Table
from exactpt.filters.starts import snapshot_of
from fuzz.adversaries.nearest import attack
from fuzz.adversaries.pieces import KINDS
from fuzz.power.edits import Edit

SQUARE = [(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0)]
N = 512
is_plain = nearest.__file__.endswith(".py")


def add(table, points, edges=None, errors=EXACT):
    """Add a piece at rest; a ring by default."""
    xs, ys = [x for x, _ in points], [y for _, y in points]
    ring = [(i, (i + 1) % len(points)) for i in range(len(points))]
    edges = ring if edges is None else edges
    where = table.add_places(xs, ys), len(xs), table.add_edges(edges), len(edges)
    box = (min(xs), max(xs), min(ys), max(ys))
    numbers = table.count(), int(STRAIGHT), 0.0, 1.0, *where
    table.add_piece(Piece(*numbers, [0.0] * 24, box, errors, 0.0, deforms=False))


def moved(points, dx, dy):
    """Return points that are moved."""
    return [(x + dx, y + dy) for x, y in points]


def asked(table, within=math.inf):
    """Ask about the pieces 0 and 1."""
    return Nearest(snapshot_of(table, 0, 0.0), snapshot_of(table, 1, 0.0), within)


def names(near):
    """Return the features that are left, sorted: (piece, vertex, edge, other vertex)."""
    return sorted((f.one, f.vertex, f.edge, f.other_vertex) for f in near.features())


def test_corner_next_to_a_corner_is_the_only_pair_left():
    # from (1, 1) to (3, 2); the feet on all edges of these corners are beyond them
    table = Table()
    add(table, SQUARE)
    add(table, moved(SQUARE, 3.0, 2.0))

    near = asked(table)

    assert names(near) == [(0, 2, -1, 0)]
    assert not near.cross
    assert list(near.met) == []
    assert near.is_outside()


def test_edges_that_face_each_other_have_all_their_ends_left():
    # x = 1 and x = 3, from y = 0 to 1 and from 1/4 to 5/4: (1, 1) is beside the edge 3 of the
    # second square, (3, 1/4) beside the edge 1 of the first one; all other distances are larger
    table = Table()
    add(table, SQUARE)
    add(table, moved(SQUARE, 3.0, 0.25))

    assert names(asked(table)) == [(0, 2, 3, -1), (1, 0, 1, -1)]


def test_features_beyond_a_distance_are_left_out():
    table = Table()
    add(table, SQUARE)
    add(table, moved(SQUARE, 3.0, 2.0))  # the square of the distance is 5

    assert names(asked(table, 4.999)) == []
    assert names(asked(table, 5.0)) == [(0, 2, -1, 0)]
    assert asked(table, 4.999).is_outside()


def test_squares_that_cross_have_no_features_left():
    # (1/2, 1/2) and (1, 1) are inside the other square; edges cross at (1, 1/2) and (1/2, 1)
    table = Table()
    add(table, SQUARE)
    add(table, moved(SQUARE, 0.5, 0.5))

    near = asked(table)

    assert near.cross
    assert names(near) == []
    assert not near.is_outside()


def test_vertex_on_an_edge_is_left_beside_edges_that_cross():
    # the tip (1, 1/2) is on the edge x = 1, and the edges of the other end cross y = 0
    table = Table()
    add(table, SQUARE)
    add(table, [(1.0, 0.5), (2.0, 0.5), (2.0, -1.0), (0.5, -1.0), (0.25, 0.75), (0.5, -2.0)])

    near = asked(table)

    assert near.cross
    assert (1, 0, 1, -1) in names(near)


def test_edges_that_touch_may_meet_and_do_not_certainly_cross():
    table = Table()
    add(table, SQUARE)
    add(table, moved(SQUARE, 1.0, 0.5))

    near = asked(table)
    met = list(near.met)

    assert not near.cross
    assert (1, 3) in zip(met[::2], met[1::2], strict=True)
    assert names(near) == [(0, 2, 3, -1), (1, 0, 1, -1)]
    assert not near.is_outside()


def test_square_inside_another_is_not_said_to_be_outside():
    table = Table()
    add(table, [(9 * x, 9 * y) for x, y in SQUARE])
    add(table, moved(SQUARE, 2.0, 3.0))

    near = asked(table)

    assert names(near) == [(1, 0, 3, -1), (1, 3, 3, -1)]  # 2 from x = 0; 3 from y = 0
    assert not near.is_outside()


def test_last_vertex_of_a_chain_is_left_though_no_edge_begins_there():
    table = Table()
    add(table, [(0.0, 0.0), (0.0, 5.0), (4.0, 5.0)], [(0, 1), (1, 2)])
    add(table, [(7.0, 9.0)], [(0, 0)])

    assert names(asked(table)) == [(0, 2, -1, 0)]  # (4, 5) and (7, 9): 5


def test_all_ties_of_facing_combs_are_left_and_few_pairs_are_compared():
    # tips at (2 k, 0) and at (2 k, 3): the nearest vertex of another tooth is sqrt(13) away
    teeth = [(float(k), 0.0 if k % 2 == 0 else -1.0) for k in range(N)]
    table = Table()
    add(table, [*teeth, (float(N), -9.0), (-1.0, -9.0)])
    add(table, [(x, 3.0 - y) for x, y in [*teeth, (float(N), -9.0), (-1.0, -9.0)]])

    near = asked(table)

    assert names(near) == [(0, k, -1, k) for k in range(0, N, 2)]
    assert near.compared < 16 * N


def test_polygons_of_many_vertices_are_told_apart_by_few_pairs():
    # vertices at angles of whole parts of the circle: (1, 0) is nearest to (2, 0), and next to it
    # are neighbours of both at a distance that is larger by their sagittas
    table = Table()
    turns = [2.0 * math.pi * k / N for k in range(N)]
    add(table, [(math.cos(a), math.sin(a)) for a in turns])
    add(table, [(3.0 - math.cos(a), math.sin(a)) for a in turns])

    near = asked(table)

    assert names(near) == [(0, 0, -1, 0)]
    assert near.compared < N // 2


@pytest.mark.parametrize("error", [math.nan, math.inf, 2.0**150])
def test_pieces_out_of_range_have_all_pairs_left(error):
    # 16 pairs of vertices, and twice 16 of a vertex and an edge
    table = Table()
    add(table, SQUARE)
    add(table, moved(SQUARE, 9.0, 9.0), errors=Errors(error, 0.0, 0.0))

    near = asked(table, 1.0)

    assert len(names(near)) == 48
    assert not near.cross
    assert not near.is_outside()


def test_products_that_overflow_lose_nothing():
    # as above, times 2^300: the square of u x z would be 2^1200
    table = Table()
    for shift in ((0.0, 0.0), (3.0, 0.25)):
        add(table, [(x * 2.0**300, y * 2.0**300) for x, y in moved(SQUARE, *shift)])

    assert {(0, 2, 3, -1), (1, 0, 1, -1)} <= set(names(asked(table)))


def test_error_of_places_leaves_what_it_may_make_nearest():
    # distances 1 and 1 + 2^-10; the errors of both, 2^-12, may change either by 2 sqrt(2) 2^-12
    table = Table()
    errors = Errors(2.0**-12, 0.0, 0.0)
    add(table, [(0.0, 0.0), (0.0, 50.0)], [(0, 1)], errors)
    add(table, [(1.0, 0.0), (9.0, 25.0), (1.0 + 2.0**-10, 50.0)], [(0, 1), (1, 2)], errors)

    left = names(asked(table))

    assert (0, 0, -1, 0) in left
    assert (0, 1, -1, 2) in left


@pytest.mark.parametrize("kind", KINDS.values(), ids=KINDS)
def test_nearest_features_attacked_in_rationals_are_left(kind):
    found = attack(kind, 300, seed=61)

    assert found.wrong == []
    assert found.counts["cross"] > 20
    assert found.counts["outside"] > 40
    assert found.counts["pairs left"] * 2 < found.counts["of"]


MISTAKES = {
    "no margin": Edit(Nearest, "__init__", "margin = 6.0 *", "margin = 0.0 *"),
    "far edges": Edit(Nearest, "_is_beyond", "off = 3.0 * self._rho", "off = 0.0"),
    "sign of a foot": Edit(Nearest, "_is_beyond", "along < -(", "along < ("),
    "the other end": Edit(Nearest, "_add_edge", "-(ux * x + uy * y)", "(ux * x + uy * y)"),
    "gap in x": Edit(Nearest, "_gap", "max(x, 0.0)", "abs(x)"),
    "last child": Edit(Nearest, "_search", "2 * i + 1, j)", "2 * i, j)"),
    "swapped tree": Edit(Nearest, "_search", "i, 2 * j + 1)", "i, 2 * j)"),
    "last edges": Edit(Tree, "_leaf_box", "k + 1 == end or", "False and"),
    "vertices alone": Edit(Tree, "_add_edges", "begins_edge[v] == 0", "begins_edge[v] == 2"),
    "lengths": Edit(Nearest, "_compare", "self._far + lengths", "self._far"),
    "crossing far": Edit(Nearest, "_compare", "self._touching + lengths", "self._touching"),
    "inside": Edit(Nearest, "is_outside", " and self._swapped.is_second_outside()", ""),
    "touching": Edit(
        Nearest, "is_outside", " or not self._least > 4.0 *", " or not self._least > -4.0 *"
    ),
    "large errors": Edit(Nearest, "__init__", "self._rho < LARGEST_ERROR", "True"),
}


@pytest.mark.long
@pytest.mark.skipif(not is_plain, reason="compiled functions cannot be edited")
@pytest.mark.parametrize("mistake", MISTAKES.values(), ids=MISTAKES)
def test_planted_mistake_in_nearest_features_is_found(mistake):
    with mistake.made():
        assert any(attack(kind, 400, seed=61).wrong for kind in KINDS.values()) or is_found()


def is_found():
    """Return whether a piece out of range, or a comb, shows a mistake."""
    try:
        test_products_that_overflow_lose_nothing()
        test_pieces_out_of_range_have_all_pairs_left(math.nan)
        test_all_ties_of_facing_combs_are_left_and_few_pairs_are_compared()
    except AssertionError:
        return True
    return False
