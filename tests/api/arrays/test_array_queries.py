"""Moving points against moving segments, beside `first_contact` for each of them."""

import tracemalloc
from fractions import Fraction

import numpy as np
import pytest
from array_help import Queries, agrees, degenerate, generic, same_velocity, small, ulps
from hypothesis import given
from hypothesis import strategies as st

from exactpt import first_contact
from exactpt.arrays import point_segment_contacts
from exactpt.arrays import queries as module
from exactpt.testing import reference

SIZES = (2.0**-1040, 2.0**-300, 2.0**-30, 1.0, 2.0**30, 2.0**300, 2.0**1020)


def assert_all_agree(queries, ask=reference.first_contact):
    contacts = queries.asked()
    wrong = [i for i in range(len(queries)) if not agrees(contacts, i, ask(contacts.scene(i)))]
    assert wrong == []
    return contacts


@pytest.mark.long
def test_generic_queries():
    contacts = assert_all_agree(generic(np.random.default_rng(1), 600))

    assert 50 < contacts.found.sum() < 550
    assert contacts.exact_share == 0.0


def test_exact_arithmetic_decides_less_than_one_generic_query_in_a_thousand():
    contacts = generic(np.random.default_rng(2), 200_000).asked()

    assert contacts.exact.sum() < 200
    assert 10_000 < contacts.found.sum() < 100_000


@pytest.mark.long
def test_degenerate_queries():
    for queries in degenerate(np.random.default_rng(3), 1600):
        assert_all_agree(queries, lambda scene: first_contact(scene, method="pairs"))


@pytest.mark.long
def test_degenerate_queries_by_a_tiling():
    for queries in degenerate(np.random.default_rng(4), 160):
        assert_all_agree(queries, first_contact)


@pytest.mark.slow
@pytest.mark.parametrize("seed", range(10))
def test_100_000_degenerate_queries(seed):
    asked = 0
    for queries in degenerate(np.random.default_rng((5, seed)), 10_400):
        assert_all_agree(queries, lambda scene: first_contact(scene, method="pairs"))
        asked += len(queries)
    assert asked >= 10_000


@pytest.mark.parametrize("size", SIZES)
def test_queries_of_any_size(size):
    rng = np.random.default_rng(6)

    assert_all_agree(small(rng, 150, size / 4))
    assert_all_agree(generic(rng, 60, size))


@pytest.mark.long
def test_velocities_beyond_all_doubles_within_the_span():
    rng = np.random.default_rng(7)
    rows = rng.choice([-1.7e308, -1.0, 0.0, 5e-324, 1e-200, 1.0, 1.7e308], (6, 200, 2))

    assert_all_agree(Queries(*rows[:3], rows[3:], (-1e300, 1.7e308)).of_segments())


@pytest.mark.long("-3.5")
@pytest.mark.parametrize("start", [-3.5, 0.1, 1e6, -(2.0**40)])
def test_spans_that_start_elsewhere(start):
    """The same questions with time counted from another instant, so far as doubles allow it."""
    rng = np.random.default_rng(8)
    there = generic(rng, 300)
    there.places = [p - v * start for p, v in zip(there.places, there.velocities, strict=True)]
    there.time = np.array([start, start + 1.0])

    contacts = assert_all_agree(there)

    assert contacts.found.any()
    assert contacts.exact.sum() <= (0 if abs(start) < 10 else 300)


def test_each_query_has_its_own_span():
    rng = np.random.default_rng(9)
    queries = same_velocity(rng, 300)
    spans = np.sort(rng.integers(-8, 9, (len(queries), 2)), axis=1) / 4
    spans[:, 1] += spans[:, 0] == spans[:, 1]
    queries.time = spans

    assert_all_agree(queries.of_segments())


number = st.one_of(
    st.integers(-3, 3).map(float), st.floats(-4.0, 4.0),
    st.floats(allow_nan=False, allow_infinity=False),
)  # fmt: skip


@pytest.mark.long
@given(st.lists(number, min_size=12, max_size=12))
def test_any_query(row):
    rows = np.array(row).reshape(6, 1, 2)
    queries = Queries(*rows[:3], rows[3:], (0.0, 2.0)).of_segments()

    assert_all_agree(queries)


def test_enclosures_of_contacts_are_neighbouring_doubles():
    contacts = generic(np.random.default_rng(10), 100_000).asked()

    counts = np.bincount(ulps(contacts), minlength=4)

    assert counts[3:].sum() == 0
    assert counts[:2].sum() > 0.9 * counts.sum()


def test_an_exact_time_is_one_double():
    queries = Queries([(0, 1)], [(2, 0)], [(2, 4)], [[(1, 0)], [(0, 0)], [(0, 0)]], (0, 5))
    queries.places = [p + 0.0 for p in queries.places]

    contacts = queries.asked()

    assert contacts.low[0] <= 2.0 <= contacts.high[0]
    assert contacts.contact(0).time == 2


def test_a_segment_that_shrinks_to_a_point_touches_itself():
    contacts = point_segment_contacts(
        [(9, 9)], [(0, 0)], [(4, 2)], velocities=(None, None, [(-2, -1)]), time=(0, 3)
    )

    assert agrees(contacts, 0, first_contact(contacts.scene(0)))
    assert contacts.contact(0).kind == "self"
    assert contacts.low[0] == contacts.high[0] == 2.0


def test_the_length_of_a_chunk_does_not_matter(monkeypatch):
    queries = small(np.random.default_rng(11), 500)
    whole = queries.asked()
    monkeypatch.setattr(module, "CHUNK", 7)

    parts = queries.asked()

    for name in ("found", "low", "high", "kind", "body", "vertex", "edge", "other_vertex", "exact"):
        assert np.array_equal(getattr(whole, name), getattr(parts, name)), name


@pytest.mark.long
def test_memory_is_that_of_the_arrays_and_a_chunk():
    queries = generic(np.random.default_rng(12), 400_000)
    queries.asked()
    tracemalloc.start()
    try:
        contacts = queries.asked()
        most = tracemalloc.get_traced_memory()[1]
    finally:
        tracemalloc.stop()

    kept = 12 * 8 + 2 * 8 + 3 * 4 + 4  # the query, its times, three numbers, four bytes
    assert most < len(contacts) * kept + 200 * 8 * module.CHUNK


def test_contacts_keep_their_own_copy():
    queries = generic(np.random.default_rng(13), 100)
    contacts = queries.asked()
    i = int(contacts.found.argmax())
    before = contacts.contact(i).time
    for array in (*queries.places, *queries.velocities):
        array[:] = 0.0

    assert contacts.contact(i).time == before
    assert Fraction(contacts.low[i]) <= before <= Fraction(contacts.high[i])


def test_an_index_may_count_from_the_end():
    contacts = generic(np.random.default_rng(14), 3).asked()

    assert contacts.scene(-1) == contacts.scene(2)
    with pytest.raises(IndexError):
        contacts.contact(3)
    assert repr(contacts).endswith("0 decided exactly>")
