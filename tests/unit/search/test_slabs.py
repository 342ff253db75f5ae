"""Slabs of time, and the pairs of rows in them."""

from fractions import Fraction
from itertools import pairwise, permutations
from math import inf
from random import Random

import pytest

from exactpt import Body, Pieces, Scene, Spin, Translation, first_contact
from exactpt.filters.rows import WAITING
from exactpt.search.first import pair_search
from exactpt.search.reading import rows_of
from exactpt.search.sweep_search import AllPairs, NamedPairs, Slabs
from exactpt.testing.scenes import FAMILIES, generate

TRIANGLE = [(0, 0), (1, 0), (0, 1)]


def rows_in(scene):
    return rows_of(scene.bodies, scene.exact_start, scene.exact_end)


@pytest.mark.parametrize("longest", [inf, 0.3])
@pytest.mark.parametrize("family", sorted(FAMILIES))
def test_slabs_cover_the_span_in_order(family, longest):
    scene = generate(family, 1)
    rows = rows_in(scene)
    length = longest * (rows.span.high - rows.span.low)

    slabs = list(Slabs(rows, AllPairs(rows), length))

    assert (slabs[0].low, slabs[-1].high) == (rows.span.low, rows.span.high)
    assert all(one.high == two.low for one, two in pairwise(slabs))
    assert all(slab.low < slab.high <= slab.low + length * (1 + 1e-9) for slab in slabs)


def test_slabs_of_a_span_that_doubles_hardly_tell_from_a_time_end():
    start = Fraction(10**16)
    bodies = [Body(f"b{k}", TRIANGLE, Translation([4 * k, k])) for k in range(6)]
    rows = rows_in(Scene(bodies, (start, start + 3)))

    slabs = list(Slabs(rows, AllPairs(rows), 0.01 * (rows.span.high - rows.span.low)))

    assert slabs[-1].high == rows.span.high
    assert len(slabs) <= 102


def spinning(name, x, omega=1):
    spin = Spin(omega, (x, 0), error="1/50")
    return Body(name, [(x, 0), (x + 3, 0), (x + 3, 1)], spin)


def test_rows_of_a_slab_do_not_wait():
    """Two blades that meet have their pieces before a slab is yielded; one far off has none."""
    rows = rows_in(Scene([spinning("a", 0), spinning("b", 5, -1), spinning("far", 99)], (0, 9)))

    for slab in Slabs(rows, AllPairs(rows)):
        assert slab.pairs.waiting == {}
        for pair in slab.pairs.rows():
            assert [rows.table.kind[k] for k in pair].count(WAITING) == 0
            for k in pair:
                assert rows.table.start[k] <= slab.high
                assert rows.table.end[k] >= slab.low

    bodies = list(rows.table.body)
    assert bodies.count(0) > 2
    assert bodies.count(1) > 2
    assert bodies.count(2) == 1


def test_named_pairs_of_rows_that_wait_get_their_pieces():
    scene = Scene([spinning("a", 0), spinning("b", 4, "1/2"), spinning("c", 9)], (0, 9))
    rows = rows_in(scene)

    for slab in Slabs(rows, NamedPairs(rows, [(0, 1)])):
        assert slab.pairs.waiting == {}

    assert list(rows.table.body).count(2) == 1
    between = first_contact(scene, between=[("a", "b")])
    assert between is not None
    assert between == first_contact(Scene(scene.bodies[:2], (0, 9)))


def in_pieces(ends, speeds, *, is_upward):
    """A motion from 0 on at some speeds, each up to a time; the last one for all time."""
    pieces, place, since = [], Fraction(0), Fraction(0)
    for end, speed in zip([*ends, None], speeds, strict=True):
        f = [place - speed * since, speed]
        pieces.append((end, Translation([0], f) if is_upward else Translation(f)))
        if end is not None:
            place, since = place + speed * (end - since), end
    return Pieces(pieces)


def changes_within_an_ulp(order):
    """A point that runs to a wall turns back; both change their motion, in an order.

    All changes are between two doubles, at 1/3 + k / 2^60. The point is at x = t until its last
    change, when it turns back; the wall slides along itself, and is where the point turns, or a bit
    before: so the contact is at x = t, just before that change or at it.
    """
    third, step = Fraction(1, 3), Fraction(1, 2**60)
    times = {"point": [], "wall": []}
    for k, name in enumerate(order):
        times[name].append(third + (k + 1) * step)
    ends, last = times["point"], times["point"][-1]
    point = Body("point", [(0, 0)], in_pieces(ends, [1] * len(ends) + [-1], is_upward=False))
    speeds = [(-1) ** k for k in range(len(times["wall"]) + 1)]
    slide = in_pieces(times["wall"], speeds, is_upward=True)
    for x in (last, last - step / 2):
        yield Scene([point, Body("wall", [(x, -5), (x, 5)], slide)], (0, 1)), x


ORDERS = sorted(
    {
        order
        for points in (1, 2)
        for walls in (0, 1, 2, 3)
        for order in permutations(["point"] * points + ["wall"] * walls)
    }
)


@pytest.mark.parametrize("order", ORDERS, ids="-".join)
def test_changes_within_an_ulp_lose_no_contact(order):
    for scene, time in changes_within_an_ulp(order):
        assert first_contact(scene).time == time


def test_changes_within_an_ulp_lose_no_contact_of_a_named_pair():
    """Of three rows whose ends have equal doubles, the first lasts beside each of the others."""
    for order in ORDERS:
        for scene, time in changes_within_an_ulp(order):
            contact = first_contact(scene, between=[("point", "wall")])
            assert contact is not None
            assert contact.time == time


@pytest.mark.parametrize("family", sorted(FAMILIES))
def test_exact_only_leaves_all_that_boxes_do_not_exclude_to_exact_arithmetic(family):
    scene = generate(family, 0)
    filtered, exact = pair_search(scene), pair_search(scene, exact_only=True)

    contact = exact.run_to_contact()

    found = filtered.run_to_contact()
    assert (contact and contact.to_json()) == (found and found.to_json())
    assert exact.stats["exact"] >= filtered.stats["exact"]


def test_time_free_of_contacts_of_bodies_that_curve_turn_and_deform_is_before_the_contact():
    """A search by pairs knows it at each of its looks at the clock, whatever the motions are."""
    random = Random("free")
    for family in ("turning", "deforming", "ballistic"):
        scene = generate(family, random.randrange(5))
        search = pair_search(scene)
        assert search.contact_free_until() is None
        contact = search.run_to_contact()
        free = search.contact_free_until()
        assert scene.start <= free
        if contact is None:
            assert free == scene.end
        elif contact.time > scene.start:
            assert free < contact.time
