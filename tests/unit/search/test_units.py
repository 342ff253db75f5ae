"""Units of rows: which scenes have their own, and that they change no result."""

from fractions import Fraction

import pytest

from exactpt import Body, Pieces, Rigid, Scene, Translation, first_contact, first_within
from exactpt.filters.rounding import FAR
from exactpt.kernel.numbers import QQ, of_double
from exactpt.search.first import pair_search
from exactpt.search.reading import rows_of
from exactpt.search.units import PLAIN, are_plain_times, time_units, units_of

THIRD = Fraction(1, 3)
SHAPE = [(0, 0), (1, THIRD), (0, 1)]


def scene(*, at=0, size=1, since=0, slower=1):
    """Two triangles that meet, one that turns and one that curves and changes its motion.

    Args:
        at: what is added to all places.
        size: all lengths are multiplied by it.
        since: what is added to all times.
        slower: all times are multiplied by it.
    """

    def in_time(*f):
        """The coefficients of size f((t - since) / slower), without what is added to places."""
        total = [Fraction(0)] * len(f)
        for k, c in enumerate(f):  # c (t - since)^k / slower^k, by the binomial theorem
            row = [Fraction(c) / Fraction(slower) ** k]
            for _ in range(k):
                row = [a - Fraction(since) * b for a, b in zip([0, *row], [*row, 0], strict=True)]
            for j, value in enumerate(row):
                total[j] += value
        return total

    def scaled(*f):
        return [Fraction(size) * c for c in in_time(*f)]

    def placed(dx, dy):
        return [(at + size * (x + dx), at + size * (y + dy)) for x, y in SHAPE]

    turn = Rigid(in_time(0, THIRD), pivot=(at, at))
    curve = Translation(scaled(0, 0, "-1/7"))
    on = Translation(scaled("4/7", "-4/7"))
    bend = Pieces([(since + slower * Fraction(2), curve), (None, on)])
    bodies = [
        Body("mill", placed(0, 0), turn),
        Body("ball", placed(4, 0), bend),
        Body("post", placed(-9, -9), Translation(scaled(0, "1/9"))),
    ]
    return Scene(bodies, (since, since + slower * 9))


def units_in(some):
    return units_of(some.bodies, some.exact_start, some.exact_end)


SCENES = {
    "plain": {},
    "far in place": {"at": 10**15 + THIRD},
    "very far in place": {"at": 10**40},
    "far in time": {"since": 10**15 + THIRD},
    "tiny": {"size": Fraction(1, 10**60)},
    "huge": {"size": 10**60},
    "beyond the doubles": {"size": 10**400},
    "below the doubles": {"size": Fraction(1, 10**400)},
    "slow": {"slower": 10**60},
    "fast": {"slower": Fraction(1, 10**60)},
    "tiny and far": {"size": Fraction(1, 10**30), "at": 10**9},
    "all": {"size": 10**30, "at": 10**60, "since": -(10**50), "slower": 10**30},
}


def test_most_scenes_are_read_as_they_are():
    units = units_in(scene())

    assert units.is_identity
    assert units_of([], QQ(0), QQ(1)).is_identity
    assert PLAIN.is_identity


@pytest.mark.parametrize("name", list(SCENES)[1:])
def test_scene_of_other_numbers_has_units_in_which_it_is_like_the_plain_one(name):
    """Lengths and times in units are neither tiny nor huge, nor far from 0 beside what moves."""
    some = scene(**SCENES[name])
    rows = rows_of(some.bodies, some.exact_start, some.exact_end)
    table, span = rows.table, rows.span

    assert not rows.units.is_identity
    assert 2.0**-65 < span.high - span.low < 2.0**65
    assert max(abs(span.low), abs(span.high)) <= 2.0 * FAR * (span.high - span.low)
    places = [abs(c) for k in range(table.count()) for c in table.box(k) if c]
    assert 2.0**-70 < max(places) < 2.0**70


@pytest.mark.parametrize("name", list(SCENES))
def test_results_do_not_depend_on_units(name):
    """The image of the contact of the plain scene: an irrational time and a vertex on an edge."""
    plain, given = first_contact(scene()), SCENES[name]

    contact = first_contact(scene(**given))

    since, slower = Fraction(given.get("since", 0)), Fraction(given.get("slower", 1))
    low, high = plain.time.low, plain.time.high
    assert [(p.body, p.vertex, p.other, p.edge) for p in contact.pairs] == [
        (p.body, p.vertex, p.other, p.edge) for p in plain.pairs
    ]
    assert since + slower * low <= contact.time <= since + slower * high


@pytest.mark.parametrize("name", list(SCENES))
def test_filters_decide_as_much_in_units(name):
    counts = []
    for given in ({}, SCENES[name]):
        search = pair_search(scene(**given))
        search.run_to_contact()
        counts.append(search.stats)
    assert counts[1]["exact"] <= counts[0]["exact"] + 2
    assert counts[1]["certificates"] <= 2 * counts[0]["certificates"] + 8


@pytest.mark.parametrize("name", list(SCENES))
def test_times_of_rows_are_mapped_back_exactly(name):
    some = scene(**SCENES[name])
    rows = rows_of(some.bodies, some.exact_start, some.exact_end)
    units, table = rows.units, rows.table

    assert units.exact_time(rows.span.low) <= rows.span.start <= units.exact_time(rows.span.after)
    assert units.exact_time(rows.span.high) >= rows.span.end
    for k, (start, end) in enumerate(rows.spans):
        assert units.exact_time(table.start[k]) <= start
        assert end <= units.exact_time(table.end[k])
    for t in (0.1, 1.0, 3.7):
        exact = of_double(t) * QQ(2) ** units.time_scale + units.origin
        assert units.exact_time(t) == exact
        assert units.time(exact) == (t, t)


@pytest.mark.parametrize("name", list(SCENES))
def test_distances_are_those_of_the_scene(name):
    """The distance is one of the scene, and becomes a radius in units."""
    given = SCENES[name]
    size = Fraction(given.get("size", 1))
    plain = first_within(scene(), distance=THIRD)

    found = first_within(scene(**given), distance=size * THIRD)

    since, slower = Fraction(given.get("since", 0)), Fraction(given.get("slower", 1))
    assert found.pairs == plain.pairs
    assert since + slower * plain.time.low <= found.time <= since + slower * plain.time.high


def test_times_are_plain_up_to_a_power_of_two_and_where_they_are_not_far():
    assert are_plain_times(0.0, 1.0)
    assert are_plain_times(-1e6, 1e6)
    assert not are_plain_times(0.0, 2.0**64)
    assert not are_plain_times(0.0, 2.0**-64)
    assert not are_plain_times(FAR, FAR + 1.0)
    assert time_units(QQ(0), QQ(2) ** 4) == (0, 0)
    assert time_units(QQ(0), QQ(2) ** 30) == (0, 30)  # powers of such times are of another order
    assert time_units(QQ(0), QQ(2) ** 90)[1] > 64
    assert time_units(QQ(10) ** 30, QQ(10) ** 30 + 1)[0] == QQ(10) ** 30
