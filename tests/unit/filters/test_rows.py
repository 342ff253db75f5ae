"""The table of the filters: records and vectors."""

import pytest
from librt.vecs import vec

from exactpt.filters.rows import (
    BOX,
    FRAME,
    PATH_X,
    PATH_Y,
    STRAIGHT,
    Errors,
    Piece,
    Table,
    bounds,
)

VECTORS = [name for name in dir(Table()) if isinstance(getattr(Table(), name), vec)]
TRIANGLE = [0.0, 4.0, 1.0], [-1.0, 0.0, 5.0]


def record(table, *, start=0.0, end=2.0, radius=0.25, errors=(0.0, 0.0, 0.0)):
    """The record of the triangle with the path (7 + 3 t, 8)."""
    place, edge = table.add_places(*TRIANGLE), table.add_ring(3)
    frame = [7.0, 3.0, 0.0, 0.0] + [8.0, 0.0, 0.0, 0.0] + [0.0] * 16
    return Piece(
        body=5,
        kind=int(STRAIGHT),
        start=start,
        end=end,
        place=place,
        size=3,
        edge=edge,
        edges=3,
        frame=frame,
        box=(0.0, 4.0, -1.0, 5.0),
        errors=Errors(*errors),
        radius=radius,
        deforms=False,
    )


def test_table_read_by_its_numbers_has_the_edges_of_the_second_piece():
    table = Table()
    table.add_piece(record(table))
    table.add_piece(record(table))

    place, edge = table.place[1], table.edge[1]
    ends = [(table.begins[edge + e], table.ends[edge + e]) for e in range(table.edges[1])]

    assert (place, edge) == (3, 3)
    assert ends == [(0, 1), (1, 2), (2, 0)]
    assert [(table.xs[place + i], table.ys[place + i]) for i, _ in ends] == list(
        zip(*TRIANGLE, strict=True)
    )


def test_straight_row_is_that_of_its_record():
    recorded, quick = Table(), Table()
    recorded.add_piece(record(recorded))

    quick.add_straight(5, 0.0, 2.0, *TRIANGLE, (7.0, 3.0), (8.0,), 0.25)

    assert VECTORS
    for name in VECTORS:
        assert list(getattr(quick, name)) == list(getattr(recorded, name)), name


def test_row_of_a_path_begins_where_its_number_says():
    table = Table()
    for k in range(3):
        table.add_straight(k, 0.0, 1.0, [0.0], [0.0], (float(k), 10.0 + k), (20.0 + k,), 0.0)

    assert [table.frames[FRAME * k + PATH_X + 1] for k in range(3)] == [10.0, 11.0, 12.0]
    assert [table.frames[FRAME * k + PATH_Y] for k in range(3)] == [20.0, 21.0, 22.0]
    assert len(table.frames) == 3 * FRAME
    assert len(table.boxes) == 3 * BOX


def test_box_of_a_row_is_left_right_bottom_top():
    table = Table()
    table.add_piece(record(table))

    assert table.box(0) == (0.0, 4.0, -1.0, 5.0)


def test_errors_of_a_record_go_to_vectors_of_their_own():
    table = Table()
    table.add_piece(record(table, errors=(1.0, 2.0, 3.0)))

    found = table.place_error[0], table.path_error[0], table.speed_error[0]

    assert found == (1.0, 2.0, 3.0)


def test_vertices_of_their_own_are_numbered_by_eight_coefficients():
    table = Table()

    assert table.add_own([0.0] * 24) == 0
    assert table.add_own([0.0] * 8) == 3


def test_general_vertices_are_numbered_by_where_their_numbers_begin():
    table = Table()

    assert table.add_general([0.0] * 18) == 0
    assert table.add_general([0.0] * 9) == 18


def test_copy_of_a_table_can_grow_alone():
    table = Table()
    table.add_piece(record(table))
    other = table.copy()

    other.add_piece(record(other))

    assert (table.count(), other.count()) == (1, 2)
    for name in VECTORS:
        same = getattr(other, name)[: len(getattr(table, name))]
        assert list(same) == list(getattr(table, name)), name


@pytest.mark.parametrize("n", [1, 2, 5])
def test_ring_of_vertices_ends_where_it_begins(n):
    table = Table()

    assert table.add_ring(n) == 0
    assert list(zip(table.begins, table.ends, strict=True)) == [(i, (i + 1) % n) for i in range(n)]


def test_bounds_of_numbers_are_the_least_and_the_greatest():
    assert bounds([3.0, -1.0, 2.0, 7.0, -0.5]) == (-1.0, 7.0)
