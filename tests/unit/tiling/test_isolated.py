"""Isolated events are processed as the engine processes them, or left to it."""

from collections import Counter
from random import Random
from time import monotonic

import pytest

from benchmarks.shapes import crowd
from exactpt import AuditError, Body, BudgetExceeded, Rigid, Scene, Simulation, Translation, onward
from exactpt.certificates.certificate import MOTION, pack
from exactpt.certificates.certifier import Certifier
from exactpt.certificates.queue import EventQueue, EventTime
from exactpt.kernel.budget import within
from exactpt.kernel.rounding import UNSURE
from exactpt.motion.vertices import MOTION as AT_MOTION
from exactpt.motion.vertices import OTHER_MOTION, WIDTH
from exactpt.pairs.start import initial_touches
from exactpt.testing.audits import audit_at, run_and_audit
from exactpt.testing.scenes import FAMILIES, generate
from exactpt.tiling import tiling as tilings
from exactpt.tiling.events import ContactFound
from exactpt.tiling.greedy.greedy import VerticalRules
from exactpt.tiling.greedy.shadowed import ShadowRules
from exactpt.tiling.isolated import DONE, LEFT, OPEN, IsolatedEvents
from exactpt.tiling.lazy import LazyRules
from exactpt.tiling.start import start_tiling

pytestmark = pytest.mark.plain


def crowded(seed, k=30, end=60):
    return crowd(k, Random(f"isolated {seed}"), radius=60, end=end)


@pytest.fixture
def outcomes(monkeypatch):
    """Counts of what `IsolatedEvents.step` has returned."""
    counts, step = Counter(), IsolatedEvents.step

    def counted(self, until):
        outcome = step(self, until)
        counts[outcome] += 1
        return outcome

    monkeypatch.setattr(IsolatedEvents, "step", counted)
    return counts


def summary(kinetic, events):
    return [
        (e.kind, e.removed, e.added, e.time.low, e.time.high, e.time.a, e.time.b, e.time.c)
        for e in events
    ]


def state_of(kinetic):
    """All that a tiling keeps, and all that it has counted."""
    queue = kinetic.queue
    times = [queue.pending(slot) for slot in queue.slots()]
    counts = kinetic.vertices.counters.now()
    return {
        "tiling": kinetic.state(),
        "queue": [(t.low, t.high, t.a, t.b, t.c) for t in times],
        "slots": queue.slots(),
        "now": (kinetic.certifier.now_low, kinetic.certifier.now_high),
        "counts": (counts.exact, counts.filtered, dict(counts.reasons)),
        "certificates": (kinetic.certifier.made, kinetic.certifier.skipped),
        "stats": (kinetic.stats.events, kinetic.stats.most, kinetic.stats.batches),
    }


def run(scene, most=10**9, name="lazy"):
    """The events of a tiling, its state after them, and the contact."""
    kinetic = start_tiling(scene, name, scene.exact_start)
    events, contact = [], None
    try:
        while len(events) < most and (happened := kinetic.advance(scene.exact_end)) is not None:
            events += summary(kinetic, happened)
    except ContactFound as found:
        contact = sorted(found.touches)
    return events, state_of(kinetic), contact, kinetic


def without(monkeypatch, run):
    """The result without isolated events."""
    with monkeypatch.context() as patched:
        for rules in (LazyRules, VerticalRules, ShadowRules):
            patched.setattr(rules, "slides_are_plain", False)
        return run()


def check_equal(monkeypatch, scene, most=10**9, name="lazy"):
    found = run(scene, most, name)
    expected = without(monkeypatch, lambda: run(scene, most, name))
    assert found[:3] == expected[:3]
    return found[3]


@pytest.mark.parametrize("seed", range(4))
def test_events_of_a_crowd_equal_those_of_the_engine(monkeypatch, outcomes, seed):
    check_equal(monkeypatch, crowded(seed))
    assert outcomes[DONE] > 8 * outcomes[LEFT]


@pytest.mark.parametrize("seed", range(2))
def test_greedy_events_of_a_crowd_equal_those_of_the_engine(monkeypatch, outcomes, seed):
    check_equal(monkeypatch, crowded(seed), name="greedy")
    assert outcomes[DONE] > 30
    assert outcomes[LEFT] > 30


@pytest.mark.long
@pytest.mark.parametrize("name", ["greedy", "lazy"])
@pytest.mark.parametrize("family", FAMILIES)
def test_events_of_every_family_equal_those_of_the_engine(monkeypatch, family, name):
    for seed in range(3):
        scene = generate(family, seed)
        if not initial_touches(scene)[1]:
            check_equal(monkeypatch, scene, name=name)


def test_audits_run_through_isolated_events(outcomes):
    """Kinetic equals static between any two events, also if their exact times are known."""
    for seed in range(2):
        assert run_and_audit(crowded(seed, k=8), "lazy") is not None
    assert outcomes[DONE] > 20


def test_many_at_once_equal_one_by_one(outcomes):
    for seed, chunk in enumerate((1, 7, 64)):
        scene = crowded(seed)
        _, expected, contact, single = run(scene)
        kinetic, found, count = start_tiling(scene, "lazy", scene.exact_start), None, 0
        try:
            while done := kinetic.advance_many(scene.exact_end, chunk):
                assert done <= chunk
                count += done
        except ContactFound as touching:
            found = sorted(touching.touches)
        assert (state_of(kinetic), found) == (expected, contact)
        assert kinetic.log.take() == []
        assert kinetic.log.is_recording
        assert count + chunk > single.stats.total - single.stats.batches


def test_advance_many_stops_between_events(monkeypatch):
    scene = crowded(0)
    kinetic, calls = start_tiling(scene, "lazy", scene.exact_start), []

    def ask():
        calls.append(kinetic.stats.total)
        if len(calls) == 3:
            raise BudgetExceeded("time limit exceeded", None)

    monkeypatch.setattr(tilings, "check_budget", ask)
    with pytest.raises(BudgetExceeded):
        kinetic.advance_many(scene.exact_end, 1000)
    assert kinetic.log.is_recording
    assert kinetic.contact_free_until is kinetic.certifier.now
    monkeypatch.undo()
    assert kinetic.stats.total >= 30
    events, _, _, _ = run(scene, kinetic.stats.total)
    rest = [e for _ in range(20) for e in summary(kinetic, kinetic.advance(scene.exact_end))]
    assert rest == run(scene, len(events) + len(rest))[0][len(events) :]


# Every way of leaving


def leave(monkeypatch, name, result, every=3):
    """Let a method of IsolatedEvents return a result at every few calls."""
    right, calls = getattr(IsolatedEvents, name), []

    def wrong(self, *args):
        calls.append(name)
        return result if len(calls) % every == 0 else right(self, *args)

    monkeypatch.setattr(IsolatedEvents, name, wrong)
    return calls


@pytest.mark.parametrize(("name", "result"), [("_bent", -1), ("_order", 0), ("_choose", 0)])
def test_events_that_doubles_leave_open_are_the_engines(monkeypatch, outcomes, name, result):
    scene = crowded(5)
    calls = leave(monkeypatch, name, result)
    check_equal(monkeypatch, scene)
    assert len(calls) > 100
    assert outcomes[LEFT] > 30
    assert outcomes[DONE] > 30


def test_overlapping_times_are_the_engines(monkeypatch, outcomes):
    """All enclosures are widened, so that many overlap."""
    right = EventQueue.schedule_crossing

    def widened(self, slot, low, high, a, b, c):
        right(self, slot, low - 1e-3, high + 1e-3, a, b, c)

    monkeypatch.setattr(EventQueue, "schedule_crossing", widened)
    check_equal(monkeypatch, crowded(6), most=400)
    assert outcomes[LEFT] > 10


@pytest.mark.long
def test_an_end_within_an_enclosure_is_the_engines(monkeypatch, outcomes):
    """Advancing to the times of events, rounded, neither misses nor repeats any."""
    scene = crowded(7)
    events, _, _, _ = run(scene, 60)
    ends = [
        start_tiling(scene, "lazy", scene.exact_start).vertices.normalization.exact_time(e[3])
        for e in events
    ]
    kinetic, found = start_tiling(scene, "lazy", scene.exact_start), []
    for end in ends:
        while (happened := kinetic.advance(end)) is not None:
            found += summary(kinetic, happened)
        assert not kinetic.is_after(end)
    assert [e[:3] for e in found] == [e[:3] for e in events[: len(found)]]
    assert len(events) - len(found) <= 1


def test_vertices_of_other_motions_are_the_engines(monkeypatch, outcomes):
    """A body that turns among others: events beside it are left, all others are not."""
    still = crowded(8, k=20)
    shape = [(-500, -500), (-440, -500), (-470, -440)]
    turning = Body("turning", shape, Rigid([0, 1], pivot=(-470, -480)))
    kinetic = check_equal(
        monkeypatch, Scene([*still.bodies, turning], (still.start, still.end)), most=300
    )
    assert kinetic.vertices.places[WIDTH * kinetic.vertices.bodies[-1].ring[0] + AT_MOTION] == (
        OTHER_MOTION
    )
    assert outcomes[DONE] > 100
    assert outcomes[LEFT] > 0


def test_other_kinds_are_the_engines(monkeypatch, outcomes):
    """A new piece of motion, straight chains, and a contact end or interrupt isolated events."""
    for family in ("pieces", "row", "grids_passing", "grazing", "stars", "combs"):
        for seed in range(2):
            check_equal(monkeypatch, generate(family, seed))
    assert outcomes[LEFT] > 20


def test_touching_zeros_are_the_engines():
    """A zero without change of sign may be a contact."""
    kinetic = start_tiling(crowded(9), "lazy", crowded(9).exact_start)
    first = kinetic.clock.pop(crowded(9).exact_end)[0]
    kinetic = start_tiling(crowded(9), "lazy", crowded(9).exact_start)
    slot = kinetic.queue.first_alone(2.0)
    assert slot >= 0
    time = kinetic.queue.pending(slot)
    assert time.low == first.low
    touching = EventTime(time.low, time.high, time.a, time.b, time.c, crossing=False)
    kinetic.queue.schedule(slot, touching)
    assert kinetic.queue.first_alone(2.0) == -1
    assert kinetic._isolated.step(2.0) == LEFT
    kinetic.queue.schedule(pack(MOTION, 0), EventTime(time.low, time.high, -1, -1, -1))
    kinetic.queue.cancel(slot)
    assert kinetic._isolated.step(2.0) == LEFT


def test_signs_after_an_event_are_decided_exactly(monkeypatch, outcomes):
    """The filter is unsure of every second certificate: equal events, at equal exact times."""
    scene = crowded(10, k=12)
    events, _, contact, kinetic = run(scene, 150)
    right, calls = Certifier.filtered_orientation, []

    def unsure(self, a, b, c):
        calls.append(a)
        if len(calls) % 2:
            return right(self, a, b, c)
        self.made += 1
        return UNSURE

    monkeypatch.setattr(Certifier, "filtered_orientation", unsure)
    exact, _, exact_contact, other = run(scene, 150)
    assert [e[:3] for e in exact] == [e[:3] for e in events]
    assert exact_contact == contact
    assert other.now.compare(kinetic.now) == 0
    assert outcomes[DONE] > 100


def test_violated_signs_after_an_event_are_repaired(monkeypatch, outcomes):
    """Planted: every fifth corner gives way at the wrong end; the marks are then violated."""
    scene, right, corners = crowded(11, k=12), IsolatedEvents._choose, []

    def wrong(self, h, before):
        moves = right(self, h, before)
        mesh = self._certified.mesh
        if moves and mesh.corner[h]:
            other = before if moves > 0 else h
            corners.append(h)
            if len(corners) % 5 == 0 and not mesh.boundary[other >> 1]:
                return -moves
        return moves

    monkeypatch.setattr(IsolatedEvents, "_choose", wrong)
    audited = run_and_audit(scene, "lazy")
    assert audited is not None
    assert outcomes[OPEN] > 0


@pytest.mark.parametrize("fault", [3.0, -9.0])
def test_wrong_coefficients_are_noticed(monkeypatch, outcomes, fault):
    """Planted: one coefficient in `places` is wrong, so that signs are violated after events."""
    scene = crowded(12, k=12)
    kinetic = start_tiling(scene, "lazy", scene.exact_start)
    for _ in range(10):
        kinetic.advance(scene.exact_end)
    kinetic.vertices.places[WIDTH * kinetic.vertices.bodies[3].ring[0]] += fault
    outcomes.clear()
    with within(monotonic() + 60, None), pytest.raises(AuditError):
        _audit_often(kinetic, scene.exact_end)
    assert outcomes[DONE] > 0


@pytest.mark.parametrize("fault", [1e-4, 1e-2])
def test_small_errors_of_all_coefficients_are_noticed(fault):
    """Planted: x0 of every vertex is off, of coordinates up to 5,000; failures lie before now."""
    scene = crowded(12, k=12)
    kinetic = start_tiling(scene, "lazy", scene.exact_start)
    for _ in range(10):
        kinetic.advance(scene.exact_end)
    ring = [v for body in kinetic.vertices.bodies for v in body.ring]
    for k, v in enumerate(ring):
        kinetic.vertices.places[WIDTH * v] += fault * (-1) ** k
    with within(monotonic() + 60, None), pytest.raises(AuditError):
        _audit_often(kinetic, scene.exact_end)


def _audit_often(kinetic, end):
    times = [end * k / 2000 for k in range(1, 2000)]
    for time in times:
        if not kinetic.is_after(time):
            while kinetic.advance(time) is not None:
                pass
            audit_at(kinetic, time)


# In the middle of runs


def changed_runs(scene, seed):
    """A run with saves, copies, new motions, an added and a removed body; its digest."""
    random, found = Random(seed), []
    simulation = Simulation(scene, tiling="lazy")
    names = [body.name for body in scene.bodies]
    for k in range(1, 9):
        time = scene.start + (scene.end - scene.start) * k / 40
        found += [event.to_json() for event in simulation.run(time)]
        if simulation.contact is not None:
            break
        if k == 3:
            simulation.remove(names[5])
        elif k == 5:
            far = Body(
                "new", [(-900, -900), (-840, -900), (-870, -840)], Translation([0, 1], [0, 2])
            )
            simulation.add(far)
        elif k != 4:
            turned = random.randint(-9, 9), random.randint(-9, 9)
            simulation.set_motion(names[k], onward(simulation.body(names[k]), time, turned))
        else:
            simulation = simulation.copy()
        found.append(simulation.snapshot().to_json())
    found.append(simulation.stats)
    return found


@pytest.mark.parametrize("seed", range(3))
def test_changes_in_the_middle_of_runs_equal_those_of_the_engine(monkeypatch, outcomes, seed):
    scene = crowded(seed + 20)
    found = changed_runs(scene, seed)
    done = outcomes[DONE]
    assert found == without(monkeypatch, lambda: changed_runs(scene, seed))
    assert done > 30


def test_a_retreat_after_isolated_events(monkeypatch):
    """The contact is answered just before it; then the run goes on."""

    def answered(seed=0):
        scene, found = crowd(14, Random(f"answered {seed}"), radius=300, end=200), []

        def respond(run, contact):
            found.append(contact.to_json())
            for name in {name for pair in contact.pairs for name in (pair.body, pair.other)}:
                run.set_motion(name, onward(run.body(name), run.now.low, (0, 0)))

        simulation = Simulation(scene, tiling="lazy")
        found += [event.to_json() for event in simulation.run(on_contact=respond)]
        return found, simulation.stats

    assert answered() == without(monkeypatch, answered)
