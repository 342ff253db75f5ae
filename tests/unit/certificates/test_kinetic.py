"""The queue of certificates, and the kinetic structures that docs/howto/kinetic.md builds on it."""

import doctest
from functools import cmp_to_key
from itertools import combinations, pairwise
from pathlib import Path

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from exactpt import AlgebraicNumber, InputError, Polynomial
from exactpt.certificates import CertificateQueue, orientation, squared_distance, x_order

PAGE = Path(__file__).parents[3] / "docs" / "howto" / "kinetic.md"
t = Polynomial([0, 1])
small = st.integers(-3, 3)
polynomials = st.lists(small, min_size=1, max_size=3).map(Polynomial)
clouds = st.lists(st.tuples(polynomials, polynomials), min_size=3, max_size=6)


@pytest.fixture(scope="module")
def built():
    """The classes of the page."""
    names = (
        CertificateQueue, orientation, x_order, squared_distance, cmp_to_key, pairwise
    )  # fmt: skip
    scope = {value.__name__: value for value in names}
    for example in doctest.DocTestParser().get_examples(PAGE.read_text(encoding="utf-8")):
        if example.source.startswith(("class ClosestPair", "class ConvexHull")):
            exec(example.source, scope)
    return scope


def test_certificates_fail_in_the_order_of_their_times():
    queue = CertificateQueue(until=10)
    queue.watch("third", 3 - t)
    queue.watch("first", 2 - t * t)
    queue.watch("with the third", 9 - t * t)

    seen = []
    while failed := queue.advance():
        seen.append((failed, queue.now))

    assert seen == [
        (["first"], AlgebraicNumber.root([-2, 0, 1], 1, 2)),
        (["third", "with the third"], 3),
    ]
    assert queue.now == 10


def test_a_touch_of_zero_is_no_failure():
    queue = CertificateQueue(until=10)
    queue.watch("touch", (t - 1) ** 2)
    queue.watch("zero", 0 * t)
    queue.watch("at the end", 10 - t)

    assert queue.advance() == []


def test_what_is_violated_fails_now():
    queue = CertificateQueue(start=5, until=10)
    queue.watch("negative just after", 5 - t)

    assert (queue.advance(), queue.now) == (["negative just after"], 5)


def test_a_certificate_is_replaced_and_cancelled_by_name():
    queue = CertificateQueue(until=10)
    queue.watch("a", 1 - t)
    queue.watch("b", 2 - t)
    queue.watch("a", 4 - t)
    queue.cancel("b")
    queue.cancel("never watched")

    assert (queue.advance(), queue.now) == (["a"], 4)


def test_a_span_that_ends_before_it_begins_is_refused():
    with pytest.raises(InputError, match="the end 1 is before the start 2"):
        CertificateQueue(2, 1)


@given(functions=st.lists(st.lists(small, max_size=5).map(Polynomial), max_size=5))
def test_failures_are_the_first_changes_to_negative(functions):
    """By definition: the first root, or the start, just after which the function is negative."""
    queue = CertificateQueue(-2, 2)
    for i, f in enumerate(functions):
        queue.watch(i, f)
    expected = {}
    for i, f in enumerate(functions):
        times = [AlgebraicNumber(-2), *(f.roots(after=-2, until=2) if f.degree >= 0 else [])]
        first = next((x for x in times if f.sign_after(x) < 0 and x < 2), None)
        if first is not None:
            expected[i] = first

    found = {}
    while failed := queue.advance():
        found |= dict.fromkeys(failed, queue.now)

    assert found == expected


def times_between(queue_times, end):
    return [(a.high + b.low) / 2 for a, b in pairwise([*queue_times, end]) if a < b]


@pytest.mark.long
@settings(deadline=None)
@given(points=clouds)
def test_the_closest_pair_is_closest_between_any_two_events(built, points):
    pairs = built["ClosestPair"](points, 0, 4)
    for _ in range(200):
        i, j = pairs.closest
        best = squared_distance(points[i], points[j])
        for a, b in combinations(points, 2):
            lead = squared_distance(a, b) - best
            assert lead.sign_after(pairs.queue.now) >= 0
        if not pairs.advance():
            break
    else:
        raise AssertionError("no end")


@pytest.mark.long
@settings(deadline=None)
@given(points=clouds)
def test_the_hull_has_every_point_on_its_left_after_every_event(built, points):
    if all(orientation(*triple).degree < 0 for triple in combinations(points, 3)):
        return
    hull = built["ConvexHull"](points, 0, 4)
    for _ in range(200):
        if len(hull.hull) > 2:
            for a, b in pairwise([*hull.hull, hull.hull[0]]):
                for p in points:
                    side = orientation(points[a], points[b], p)
                    assert side.sign_after(hull.queue.now) >= 0
        if not hull.advance():
            break
    else:
        raise AssertionError("no end")
