"""Candidate pairs: of many pieces of motion, and by oriented boxes."""

import math
from itertools import combinations
from random import Random

import numpy as np
import pytest

from exactpt import (
    Body,
    Pieces,
    Rigid,
    Scene,
    Translation,
    contact_intervals,
    contacts,
    first_contact,
)
from exactpt.collision.searches import ContactQuery, search_for
from exactpt.kernel.numbers import QQ
from exactpt.motion.outline import straight_pieces
from exactpt.motion.swept import SweptBoxes
from exactpt.pairs import intervals as intervals_module
from exactpt.pairs.boxes import PieceBoxes
from exactpt.pairs.intervals import ContactInterval, intervals
from exactpt.pairs.pieces import MotionPiece

PIECES = 20


def walker(name, rng):
    """A box that changes its velocity often, without a jump, at times of its own."""
    x, y, now = rng.randint(-12, 12), rng.randint(-12, 12), 0
    pieces = []
    for k in range(PIECES):
        until = None if k == PIECES - 1 else now + rng.randint(1, 9)
        vx, vy = rng.randint(-3, 3), rng.randint(-3, 3)
        pieces.append((until, Translation([x - vx * now, vx], [y - vy * now, vy])))
        if until is not None:
            x, y, now = x + vx * (until - now), y + vy * (until - now), until
    return Body(name, [(0, 0), (2, 0), (2, 1), (0, 1)], Pieces(pieces))


@pytest.mark.long
@pytest.mark.parametrize("others", [[], [Body("mill", [(0, 0), (40, 0)], Rigid([0, 1]))]])
def test_contacts_of_many_pieces_need_few_boxes_and_lose_no_pair(others, monkeypatch):
    rng = Random(5)
    bodies = [*(walker(f"w{k}", rng) for k in range(8)), *others]
    scene = Scene(bodies, time=(0, 100))
    cuts = {t for body in bodies for t in body.exact_breakpoints}
    during, counted = SweptBoxes.during, []
    monkeypatch.setattr(
        SweptBoxes, "during", lambda self, *given: counted.append(1) or during(self, *given)
    )

    found = contacts(scene)

    assert len(counted) <= (64 + 2 * len(cuts) if others else 0)
    every = [
        ContactInterval(a.name, b.name, begin.simplified(), end.simplified())
        for a, b in combinations(bodies, 2)
        for begin, end in intervals(a, b, QQ(0), QQ(100))
    ]
    assert len(found) == len(every) >= 4
    assert all(interval in every for interval in found)


def test_features_are_compared_in_pieces_that_come_near_alone(monkeypatch):
    """Two bodies of 20 pieces each were compared in every one."""
    rng = Random(5)
    a, b = (walker(name, rng) for name in "ab")
    scene = Scene([a, b], time=(0, 100))
    every = len({t for body in (a, b) for t in body.exact_breakpoints if 0 < t < 100}) + 1
    times, compared = intervals_module._times, []
    monkeypatch.setattr(
        intervals_module, "_times", lambda *two, **k: compared.append(1) or times(*two, **k)
    )

    found = contact_intervals(scene, "a", "b")

    assert len(compared) < every / 2
    compared.clear()
    whole = intervals(a, b, QQ(0), QQ(100))
    assert [(i.start, i.end) for i in found] == [(s.simplified(), e.simplified()) for s, e in whole]
    assert len(compared) == every


# Oriented boxes: long thin bodies are separated without comparing them, and no contact is lost

TIME = 10
SCALES = [QQ(2) ** -300, QQ(1, 3), QQ(1), QQ(10, 7), QQ(2) ** 300]


def planks(n, degrees, spread=0.0):
    """Long thin bodies side by side, at angles about one direction, drifting apart slowly."""
    rng, a = Random(f"{degrees} {spread}"), math.radians(degrees)
    made = []
    for i in range(n):
        x, y = -1.5 * i * math.sin(a), 1.5 * i * math.cos(a)
        turn = a + math.radians(rng.uniform(-spread, spread))
        end = x + 1000 * math.cos(turn), y + 1000 * math.sin(turn)
        tip = end[0] - 0.1 * math.sin(turn), end[1] + 0.1 * math.cos(turn)
        drift = Translation([0, rng.uniform(-0.1, 0.1)], [0, rng.uniform(-0.1, 0.1)])
        made.append(Body(f"p{i}", [(x, y), end, tip], drift))
    return Scene(made, time=(0, 3))


@pytest.mark.parametrize("degrees, spread", [(45, 0), (20, 0), (70, 0.01)])
def test_planks_side_by_side_are_compared_with_few_others(degrees, spread):
    scene = planks(60, degrees, spread)
    search = search_for(scene, ContactQuery("auto", "auto"))
    assert search.run_to_contact() is None
    assert search.stats["certificates"] <= 60  # of 1,770 pairs whose boxes overlap


def test_planks_at_random_angles_meet_as_with_all_pairs_compared(monkeypatch):
    scene = planks(40, 45, 0.1)
    found = first_contact(scene)
    monkeypatch.setattr(PieceBoxes, "narrow", lambda *_: None)
    assert found is not None
    assert found == first_contact(scene)


def touching(rng):
    """Two bodies of which a vertex is on an edge at time 0 < T < TIME."""
    scale, far = rng.choice(SCALES), rng.choice([0, 0, 2**20, 2**36]) * rng.choice([-1, 1])
    u = rng.randint(-999, 999) * 2, rng.randint(-999, 999) * 2
    q = far + rng.randint(-9, 9), far // 3 + rng.randint(-9, 9)
    middle = q[0] + u[0] // 2, q[1] + u[1] // 2
    t = rng.randint(1, TIME - 1)
    v, w = ([rng.randint(-5, 5) for _ in "xy"] for _ in "ab")
    tip = tuple(m + (a - b) * t for m, a, b in zip(middle, v, w, strict=True))
    tails = [tuple(x + rng.randint(-999, 999) for x in tip) for _ in "ab"]
    edge = [q, (q[0] + u[0], q[1] + u[1])] if any(u) else [q]
    bodies = []
    for shape, velocity in ((edge, v), ([tip, *tails][: rng.randint(1, 3)], w)):
        shift = rng.randint(-1, 1) * far
        vertices = [((x - shift) * scale, (y + shift) * scale) for x, y in shape]
        x, y = (
            [sign * shift * scale, c * scale] for sign, c in ((1, velocity[0]), (-1, velocity[1]))
        )
        bodies.append(Body("b", vertices, Translation(x, y)))
    return bodies, t


def test_rectangles_that_touch_at_a_time_are_not_separated_then():
    rng, rows, times = Random("touching"), [], []
    for _ in range(600):
        bodies, t = touching(rng)
        for body in bodies:
            ((straight, _),) = straight_pieces(body)
            rows.append(MotionPiece(len(rows), straight, QQ(0), QQ(TIME)))
        times.append(t)
    i, j = np.arange(0, len(rows), 2), np.arange(1, len(rows), 2)
    enter, leave = PieceBoxes.of(rows).windows(i, j, 0.0, float(TIME))
    assert (enter <= times).all()
    assert (times <= leave).all()
    low, high = np.zeros(len(i)), np.full(len(i), float(TIME))
    PieceBoxes.of(rows).narrow(i, j, low, high)
    assert (low <= times).all()
    assert (times <= high).all()
    assert np.count_nonzero(high - low < 0.01) > 100  # and most of them only then
    now = np.array(times, dtype=float)
    PieceBoxes.of(rows).narrow(j, i, now, later := now.copy())
    assert (now == times).all()
    assert (later == times).all()


@pytest.mark.parametrize(
    "vertices", [[(0, 0)], [(1e308, 1e308), (-1e308, -1e308)], [(0, 0), (5e-324, 0)]]
)
def test_rectangles_at_the_ends_of_the_doubles_exclude_nothing(vertices):
    bodies = [Body(f"b{k}", vertices, Translation([0, k * 1e-320])) for k in (0, 1)]
    rows = [
        MotionPiece(k, straight_pieces(body)[0][0], QQ(0), QQ(10) ** 300)
        for k, body in enumerate(bodies)
    ]
    low, high = np.zeros(1), np.array([1e300])
    PieceBoxes.of(rows).narrow(np.array([0]), np.array([1]), low, high)
    assert low[0] == 0.0
    assert high[0] >= 0.0


def test_bug_joined_pieces_have_oriented_boxes_too():
    """The outlines of joined pieces were missing: narrowing their times raised AttributeError."""
    rows = [
        MotionPiece(k, straight_pieces(body)[0][0], QQ(0), QQ(3))
        for k, body in enumerate(planks(6, 45).bodies)
    ]
    i, j = np.triu_indices(6, 1)
    ends = []
    for boxes in (PieceBoxes.of(rows), PieceBoxes.of(rows[:2]).joined(PieceBoxes.of(rows[2:]))):
        low, high = np.zeros(len(i)), np.full(len(i), 3.0)
        boxes.narrow(i, j, low, high)
        ends.append((low > high).tolist())
    assert ends[0] == ends[1]
    assert any(ends[0])
