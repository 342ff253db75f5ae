"""Blocks of features: by hand, and by the adversaries of the filters with blocks of two."""

from __future__ import annotations

import math
from collections.abc import Iterator
from contextlib import ExitStack, contextmanager
from unittest.mock import patch

import pytest

from exactpt import Body, Scene, Translation, first_contact
from exactpt.filters import blocks, starts, straight
from exactpt.filters.blocks import BLOCK, Blocks
from exactpt.filters.rows import STRAIGHT
from exactpt.search.reading import rows_of_scene
from fuzz.adversaries import starts as adversary_of_starts
from fuzz.adversaries.straight_pieces import attack_near, attack_pieces
from fuzz.power.edits import Edit

is_plain = blocks.__file__.endswith(".py")
needs_plain = pytest.mark.skipif(not is_plain, reason="compiled code cannot be edited")


@contextmanager
def in_twos() -> Iterator[None]:
    """Let all pieces have blocks, of two features each."""
    with ExitStack() as stack:
        stack.enter_context(patch.object(blocks, "BLOCK", 2))
        for module in (starts, straight):
            stack.enter_context(patch.object(module, "FEW", 0))
        yield


def unit_squares(count: int) -> Blocks:
    """Squares of side 1 in a row along x, at 0, 1, 2 ..."""
    made = Blocks()
    for k in range(count):
        made.add(float(k), k + 1.0, 0.0, 1.0)
    return made


def test_box_of_a_block_is_that_of_all_its_features():
    width = int(BLOCK)
    made = unit_squares(width + 1)

    assert made.count == width + 1
    assert made.may_meet(0, width - 0.5, width + 9.0, 0.0, 1.0)
    assert made.may_meet(0, float(width), width + 9.0, 1.0, 2.0)  # the corners touch
    assert not made.may_meet(0, width + 0.5, width + 9.0, 0.0, 1.0)
    assert made.may_meet(1, width + 0.5, width + 9.0, 0.0, 1.0)
    assert not made.may_meet(1, -1.0, width - 0.5, 0.0, 1.0)
    assert not made.may_meet(0, 0.0, 1.0, 1.5, 2.0)
    assert not made.may_meet(0, 0.0, 1.0, -2.0, -0.5)


@pytest.mark.parametrize("place", range(4))
@pytest.mark.parametrize("value", [math.nan, math.inf, -math.inf])
def test_blocks_with_a_number_that_is_not_finite_may_meet_all(place, value):
    made = unit_squares(2)
    box = [0.0, 1.0, 0.0, 1.0]
    box[place] = value
    made.add(*box)

    assert made.may_meet(0, 99.0, 100.0, 0.0, 1.0)


def test_box_that_is_unknown_may_meet_all_blocks():
    assert unit_squares(2).may_meet(0, math.nan, math.nan, math.nan, math.nan)


@needs_plain
def test_features_near_a_piece_by_blocks():
    with in_twos():
        near, pieces = attack_near(300, seed=14), attack_pieces(60, seed=12)

    assert not near.wrong, near.wrong[:3]
    assert not pieces.wrong, pieces.wrong[:3]
    assert min(near.candidates, pieces.candidates) > 50


@needs_plain
def test_disjoint_pieces_by_blocks():
    with in_twos():
        found = adversary_of_starts.attack(int(STRAIGHT), 500, seed=59)

    assert found.wrong == 0, found.first
    assert found.told > 0.97 * found.random > 10


MISTAKES = {
    "a side of a box": Edit(Blocks, "add", "max(self._right[block], right)", "right"),
    "the other side": Edit(Blocks, "add", "min(self._bottom[block], bottom)", "bottom"),
    "in x and in y": Edit(Blocks, "may_meet", "not (is_beside or", "not (not is_beside or"),
    "the first after a block": Edit(blocks, "next_near", "k += BLOCK", "k += BLOCK + 1"),
    "the first of a block": Edit(
        blocks, "next_near", "while k < blocks.count and not", "while k < blocks.count and"
    ),
    "the ray": Edit(starts.Pair, "is_outside", "edges_near(x, INFINITY", "edges_near(x, x"),
    "blocks of another piece": Edit(starts.Snapshot, "take", "self._blocks, self._parts", "_, _"),
}


@needs_plain
@pytest.mark.parametrize("mistake", MISTAKES.values(), ids=MISTAKES)
def test_planted_mistake_in_blocks_is_found(mistake):
    with mistake.made(), in_twos():
        assert is_found()


def is_found() -> bool:
    """Return whether an attack, or a crowd in a frame, finds a wrong claim."""
    try:
        return bool(
            attack_near(300, seed=14).wrong
            or attack_pieces(60, seed=12).wrong
            or any(
                adversary_of_starts.attack(int(STRAIGHT), rows, 59).wrong for rows in (100, 1000)
            )
            or overlaps_in_a_frame() != [("b", "frame")]
            or disjoint_in_a_row() != [True, False]
        )
    except IndexError:
        return True


def ring(count: int, x: float, y: float, radius: float) -> list[tuple[float, float]]:
    turns = [2.0 * math.pi * k / count for k in range(count)]
    return [(x + radius * math.cos(turn), y + radius * math.sin(turn)) for turn in turns]


def overlaps_in_a_frame() -> list[tuple[str, str]]:
    """Three triangles in and beside a frame of 200 vertices; b overlaps its inner side."""
    frame = Body("frame", ring(100, 0, 0, 12), holes=[ring(100, 0, 0, 10)])
    inside = [Body(name, ring(3, x, 0, 0.5)) for name, x in (("a", 0), ("b", 9.8), ("c", 20))]
    contact = first_contact(Scene([*inside, frame], time=(0, 1)))
    return [] if contact is None else [tuple(sorted(pair)) for pair in contact.initial_pairs]


def disjoint_in_a_row() -> list[bool]:
    """An L is disjoint from a square in its corner, and then not from one that contains it."""
    corner = [(0.0, 0.0), (4.0, 0.0), (4.0, 1.0), (1.0, 1.0), (1.0, 4.0), (0.0, 4.0)]
    bodies = [
        Body("l", corner),
        Body("in the corner", [(2, 2), (3, 2), (3, 3), (2, 3)]),
        Body("around", [(-1, -1), (5, -1), (5, 5), (-1, 5)]),
    ]
    table = rows_of_scene(Scene(bodies, time=(0, 1))).table
    made = starts.Starts(table, 0.0)
    return [made.are_disjoint(0, 1), made.are_disjoint(0, 2)]


def test_pieces_in_a_row_have_their_own_blocks():
    assert disjoint_in_a_row() == [True, False]


@needs_plain
def test_pieces_in_a_row_have_their_own_blocks_of_two():
    with in_twos():
        assert disjoint_in_a_row() == [True, False]


def test_overlap_with_a_frame_at_the_start():
    assert overlaps_in_a_frame() == [("b", "frame")]


def test_first_contact_with_a_frame():
    """The point at 0 reaches the side of the hole at 10 (a vertex is there) at t = 10 by 1."""
    frame = Body("frame", ring(100, 0, 0, 12), holes=[ring(100, 0, 0, 10)])
    point = Body("p", [(0, 0)], Translation([0, 1]))
    crowd = [Body(f"b{k}", ring(5, 3 * math.cos(k), 3 * math.sin(k), 0.2)) for k in (1, 2, 3, 4)]

    contact = first_contact(Scene([point, frame, *crowd], time=(0, 20)))

    assert contact is not None
    assert set(contact.bodies) == {"frame", "p"}
    assert contact.time == 10
