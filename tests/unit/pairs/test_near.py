"""Candidate pairs of bodies with many pieces of motion: few boxes, and no pair is lost."""

from itertools import combinations
from random import Random

import pytest

from exactpt import Body, Pieces, Rigid, Scene, Translation, contact_intervals, contacts
from exactpt.kernel.numbers import QQ
from exactpt.motion.swept import SweptBoxes
from exactpt.pairs import intervals as intervals_module
from exactpt.pairs.intervals import ContactInterval, intervals

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
    cuts = {t for body in bodies for t in body._breakpoints}
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
    every = len({t for body in (a, b) for t in body._breakpoints if 0 < t < 100}) + 1
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
