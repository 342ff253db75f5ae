"""The event queue: laws against the simplest model, a sorted list of exact times."""

from itertools import pairwise
from random import Random

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.stateful import RuleBasedStateMachine, invariant, precondition, rule

from exactpt.certificates.certificate import KIND_COUNT
from exactpt.certificates.queue import EventQueue, EventTime, ExactQueue
from exactpt.filters.rounding import INFINITY
from exactpt.kernel.algebraic import AlgebraicNumber
from exactpt.kernel.counters import Counters
from exactpt.kernel.numbers import QQ, enclosing_floats, power_of_two

# The square root of 2 by two polynomials, the double next to it, thirds, nearly a third.
NUMBERS = [
    AlgebraicNumber.root((-2, 0, 1), QQ(1), QQ(2)),
    AlgebraicNumber.root((-8, 0, 0, 0, 0, 0, 1), QQ(1), QQ(2)),
    AlgebraicNumber(QQ(6369051672525773, 4503599627370496)),
    *(AlgebraicNumber(QQ(n, 3)) for n in range(1, 7)),
    AlgebraicNumber(QQ(1, 3) + QQ(1, 10**40)),
]


class Numbers:
    """Knows which number each time is, by its key."""

    def __init__(self):
        self.asked = 0

    def resolve(self, time):
        self.asked += 1
        time.exact = NUMBERS[time.a]
        time.low, time.high = time.exact.enclosure()
        return time.exact


def time_of(index, width=0.0):
    low, high = NUMBERS[index].enclosure()
    return EventTime(low - width, high + width, index, -1, -1)


numbers = st.integers(0, len(NUMBERS) - 1)
widths = st.sampled_from([0.0, 1e-12, 0.5])


@pytest.mark.parametrize("kind", [EventQueue, ExactQueue])
@given(events=st.lists(st.tuples(numbers, widths)))
def test_events_come_in_the_order_of_time_then_of_slots(kind, events):
    queue = kind(Numbers(), Counters())
    for slot, (index, width) in enumerate(events):
        queue.schedule(slot, time_of(index, width))

    popped = []
    while (batch := queue.pop()) is not None:
        time, entries = batch
        assert [slot for slot, _ in entries] == sorted(slot for slot, _ in entries)
        assert time in [t for _, t in entries]
        popped.append([slot for slot, _ in entries])

    assert sorted(slot for batch in popped for slot in batch) == list(range(len(events)))
    for batch in popped:
        first = NUMBERS[events[batch[0]][0]]
        assert all(NUMBERS[events[slot][0]] == first for slot in batch)
    times = [NUMBERS[events[batch[0]][0]] for batch in popped]
    assert all(a < b for a, b in pairwise(times))


def test_enclosures_that_do_not_overlap_decide_alone():
    numbers = Numbers()
    queue = EventQueue(numbers, Counters())
    for slot, index in enumerate((5, 3, 7)):
        queue.schedule(slot, time_of(index))

    assert [queue.pop()[1][0][0] for _ in range(3)] == [1, 0, 2]
    assert queue.pop() is None
    assert numbers.asked == 0


def test_equal_times_are_one_batch_known_by_the_least_polynomial():
    """sqrt(2) is a root of t^2 - 2 and of t^6 - 8."""
    queue = EventQueue(Numbers(), Counters())
    queue.schedule(4, time_of(1))
    queue.schedule(2, time_of(0))

    time, entries = queue.pop()

    assert [slot for slot, _ in entries] == [2, 4]
    assert time.exact.polynomial == (-2, 0, 1)


class Halves:
    """Resolves each time as 1/2, as a root of (2 t - 1)(t^2 + 1) or of (2 t - 1)(t^2 + 2).

    Both are in (0, 3/5), of which no halves or quarters end at 1/2.
    """

    def __init__(self):
        polynomials = [(-1, 2, -1, 2), (-2, 4, -1, 2)]
        self.numbers = [AlgebraicNumber.root(p, 0, QQ(3, 5)) for p in polynomials]

    def resolve(self, time):
        time.exact = self.numbers[time.a]
        time.low, time.high = 0.25, 0.75
        return time.exact


@pytest.mark.parametrize("kind", [EventQueue, ExactQueue])
@pytest.mark.parametrize("known", [False, True])
def test_which_of_equal_times_is_taken_does_not_depend_on_what_is_known(kind, known):
    """Of 1/2, known to be rational or not, the first event is taken: both have 2 t - 1."""
    halves = Halves()
    if known:
        assert all(number.compare_rational(QQ(1, 2)) == 0 for number in halves.numbers)
    queue = kind(halves, Counters())
    for slot, which in ((2, 0), (4, 1)):
        queue.schedule(slot, EventTime(0.25, 0.75, which, -1, -1))

    time, entries = queue.pop()

    assert [slot for slot, _ in entries] == [2, 4]
    assert (time.a, time.exact.polynomial) == (0, (-1, 2))


def test_a_time_of_one_function_equals_itself_unresolved():
    numbers = Numbers()
    queue = EventQueue(numbers, Counters())
    queue.schedule(0, time_of(3))
    queue.schedule(1, time_of(3))

    assert len(queue.pop()[1]) == 2
    assert numbers.asked == 0


def test_many_replaced_events_are_dropped():
    queue = EventQueue(Numbers(), Counters())
    for i in range(5000):
        queue.schedule(i % 3, time_of(3 + i % 6))

    assert len(queue) == 3
    assert queue._heap_size + queue._note_size < 300
    assert queue.slots() == [0, 1, 2]


class Rationals:
    """Knows the rational time of each key."""

    def __init__(self):
        self.times = []

    def event(self, t, width):
        self.times.append(t)
        low, high = enclosing_floats(t)
        return EventTime(low - width, high + width, len(self.times) - 1, -1, -1)

    def resolve(self, time):
        time.exact = AlgebraicNumber(self.times[time.a])
        time.low, time.high = time.exact.enclosure()
        return time.exact


@pytest.mark.parametrize("seed", range(4))
@pytest.mark.parametrize("far", [0, 3, 30, 300])
def test_a_calendar_of_many_days_is_in_order(far, seed):
    """Times that spread over up to 300 powers of ten; ties; enclosures as wide as many days."""
    rng, rationals = Random(f"{far} {seed}"), Rationals()
    queue, model, now = EventQueue(rationals, Counters()), {}, QQ(0)

    def schedule(slot):
        later = QQ(rng.randint(1, 99), 7) * QQ(10) ** rng.randint(-far // 2, far // 2)
        tie = model and rng.random() < 0.02
        model[slot] = rng.choice(list(model.values())) if tie else now + later
        width = rng.choice([0.0] * 19 + [float(later) * rng.random() * 3])
        queue.schedule(slot, rationals.event(model[slot], width))

    for slot in range(400):
        schedule(slot)
    most_days = 0
    for _ in range(400):
        _, entries = queue.pop()
        most_days = max(most_days, queue._days)
        now = min(model.values())
        expected = sorted(slot for slot, t in model.items() if t == now)
        assert [slot for slot, _ in entries] == expected
        for slot in expected:
            del model[slot]
        for slot in rng.sample(range(400), 4):
            schedule(slot)
        gone = rng.randrange(400)
        queue.cancel(gone)
        model.pop(gone, None)
        assert len(queue) == len(model)
    assert most_days > 20


class QueueMachine(RuleBasedStateMachine):
    """Any order of scheduling, replacing, cancelling and popping, against a dict."""

    def __init__(self):
        super().__init__()
        self.queue = EventQueue(Numbers(), Counters())
        self.model = {}

    @rule(slot=st.integers(0, 6), index=numbers, width=widths)
    def schedule(self, slot, index, width):
        self.queue.schedule(slot, time_of(index, width))
        self.model[slot] = index

    @rule(slot=st.integers(0, 6))
    def cancel(self, slot):
        self.queue.cancel(slot)
        self.model.pop(slot, None)

    @precondition(lambda self: self.model)
    @rule()
    def pop(self):
        _, entries = self.queue.pop()

        first = min(NUMBERS[i] for i in self.model.values())
        expected = sorted(s for s, i in self.model.items() if NUMBERS[i] == first)
        assert [slot for slot, _ in entries] == expected
        for slot in expected:
            del self.model[slot]

    @invariant()
    def same_slots(self):
        assert self.queue.slots() == sorted(self.model)
        assert len(self.queue) == len(self.model)
        for slot in range(7):
            time = self.queue.pending(slot)
            assert (None if time is None else time.a) == self.model.get(slot)


TestQueue = pytest.mark.long(QueueMachine.TestCase)


def test_bug_ends_of_motions_within_one_double_are_told_apart():
    """All ends of motions have one key; what they are is known exactly from the start."""
    thirds = [QQ(1, 3) + QQ(k, 10**30) for k in (2, 0, 1)]
    low, high = AlgebraicNumber(QQ(1, 3)).enclosure()
    queue = EventQueue(Numbers(), Counters())
    for slot, t in enumerate(thirds):
        queue.schedule(slot, EventTime(low, high, -1, -1, -1, AlgebraicNumber(t)))

    assert [[s for s, _ in queue.pop()[1]] for _ in thirds] == [[1], [2], [0]]


@pytest.mark.parametrize("far", [False, True])
def test_bug_an_enclosure_without_end_is_popped(far):
    """Numbers beyond the doubles have infinite ends; the days of a calendar cannot reach them."""
    rationals = Rationals()
    queue = EventQueue(rationals, Counters())
    times = [power_of_two(1100), *(QQ(k) for k in range(300, 0, -1))]
    for slot, time in enumerate(times):
        queue.schedule(slot, rationals.event(time, 0.0))
    if far:  # a slot whose enclosure holds all others
        queue.schedule(400, EventTime(0.5, INFINITY, 0, -1, -1))
        rationals.times[0] = times[0]

    popped = [[slot for slot, _ in queue.pop()[1]] for _ in times]

    assert popped == [[slot] for slot in range(300, 0, -1)] + [[0, 400] if far else [0]]
    assert queue.pop() is None


def test_pending_times_equal_the_scheduled_ones():
    """Times without an exact number are stored as numbers alone; the others as they are."""
    queue = EventQueue(Numbers(), Counters())
    plain = EventTime(0.25, 0.5, 7, 8, -1)
    touching = EventTime(0.25, 0.5, 1, 2, 3, crossing=False)
    exact = EventTime(*NUMBERS[0].enclosure(), 0, -1, -1, NUMBERS[0])
    for slot, time in ((16, plain), (5, touching), (6, exact)):
        queue.schedule(slot, time)

    found = queue.pending(16)
    assert (found.low, found.high, found.a, found.b, found.c) == (0.25, 0.5, 7, 8, -1)
    assert (found.exact, found.crossing) == (None, True)
    assert queue.pending(5) is touching
    assert queue.pending(6) is exact
    queue.schedule_crossing(6, 1.0, 2.0, 3, 4, 5)
    assert (queue.pending(6).exact, queue.pending(6).low) == (None, 1.0)
    queue.cancel(16)
    assert queue.pending(16) is None
    assert queue.pending(10**6) is None


@pytest.mark.parametrize("exponent", [-1100, -1060, -1030, 0, 1000, 1100])
def test_bug_a_queue_whose_events_lie_within_the_least_doubles_ends(exponent):
    """The days of its calendar would be infinitely many in a unit of time."""
    rationals = Rationals()
    queue = EventQueue(rationals, Counters())
    for slot in range(40):
        time = (1 + slot * 17 % 40) * power_of_two(exponent)
        queue.schedule(slot, rationals.event(time, 0.0))

    popped = [queue.pop()[1][0][0] for _ in range(40)]
    assert popped == sorted(range(40), key=lambda slot: slot * 17 % 40)
    assert queue.pop() is None


def test_bug_a_row_of_many_new_events_is_shorter_than_the_old_one():
    """The calendar read the row at a slot of its heap that was not there any more."""
    queue = EventQueue(Numbers(), Counters())
    queue.schedule_crossing(KIND_COUNT * 100, 1.0, 1.0, 3, -1, -1)
    assert queue.first_alone(9.0) == KIND_COUNT * 100  # it is in the heap now
    queue.cancel(KIND_COUNT * 100)

    queue.schedule_angles(np.array([2]), np.array([2.0]), np.array([3.0]))

    assert queue.slots() == [KIND_COUNT * 2]
    assert queue.first_alone(9.0) == KIND_COUNT * 2
