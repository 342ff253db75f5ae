"""Mutants of the text of a proof, by kind."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from fractions import Fraction
from itertools import pairwise
from random import Random
from typing import Final, TypeAlias

__all__ = ["TEXTS", "Mutation"]

Mutation: TypeAlias = Callable[[list[str], Random], list[str] | None]
"""From the lines of a proof to those of another one; None if it has nothing to change."""


def _events(lines: Sequence[str]) -> list[int]:
    return [i for i, line in enumerate(lines) if line.startswith("event ")]


def _at(lines: list[str], i: int, *new: str) -> list[str]:
    return [*lines[:i], *new, *lines[i + 1 :]]


def _late(events: list[int], random: Random) -> int:
    """Return one of the events, often one of the last: fewer lines come after it."""
    return random.choice(events[-3:] if random.random() < 0.7 else events)


def dropped(lines: list[str], random: Random) -> list[str] | None:
    """An event is left out."""
    events = _events(lines)
    return _at(lines, _late(events, random)) if events else None


def doubled(lines: list[str], random: Random) -> list[str] | None:
    """An event is there twice."""
    events = _events(lines)
    if not events:
        return None
    i = random.choice(events)
    return _at(lines, i, lines[i], lines[i])


def swapped(lines: list[str], random: Random) -> list[str] | None:
    """Two events have changed their places."""
    events = _events(lines)
    if len(events) < 2:
        return None
    k = random.randrange(len(events) - 1)
    i, j = events[k], events[k + 1] if random.random() < 0.7 else random.choice(events[k + 1 :])
    return _at(_at(lines, i, lines[j]), j, lines[i])


def _with_time(line: str, time: Fraction) -> str:
    """An event at another time, a rational one."""
    words = line.split()
    k = next(k for k, word in enumerate(words) if word in "-+=")
    return " ".join(["event", str(time), str(time), *words[k:]])


def _span(lines: Sequence[str]) -> Fraction:
    _, start, end = lines[2].split()
    return Fraction(end) - Fraction(start)


def nudged(lines: list[str], random: Random) -> list[str] | None:
    """An event is at another time."""
    events = _events(lines)
    if not events:
        return None
    i = random.choice(events)
    low = Fraction(lines[i].split()[1])
    away = random.choice([-1, 1]) * _span(lines) / random.choice([10, 1000, 2**40])
    return _at(lines, i, _with_time(lines[i], low + away))


def just_after(lines: list[str], random: Random) -> list[str] | None:
    """An event comes just after its time."""
    events = _events(lines)
    if not events:
        return None
    i = random.choice(events)
    high = Fraction(lines[i].split()[2])
    return _at(lines, i, _with_time(lines[i], high + _span(lines) / 2 ** random.randint(20, 80)))


def wrong_contact(lines: list[str], random: Random) -> list[str] | None:
    """The contact is another one, at another time, or there is none."""
    words = lines[-1].split()
    if words[0] != "contact":
        low = Fraction(lines[2].split()[1]) + _span(lines) * random.randint(1, 99) / 100
        u, v = random.sample(range(1 + _most(lines)), 2) if _most(lines) else (0, 0)
        return _at(lines, len(lines) - 1, f"contact {low} {low} vertex {u} vertex {v}")
    if random.random() < 0.2:
        return [*lines[:-1], "none"]
    k = random.choice([k for k in range(len(words)) if words[k - 1] in ("vertex", "edge")])
    words[k] = str(random.randint(0, _most(lines)))
    return [*lines[:-1], " ".join(words)]


def _most(lines: Sequence[str]) -> int:
    """The last vertex."""
    faces = [line.split()[1:] for line in lines if line.startswith(("face", "outer", "inside"))]
    return max((int(v) for face in faces for v in face), default=0)


def edge_moved(lines: list[str], random: Random) -> list[str] | None:
    """A diagonal at the start is another one of the polygon that it splits, or one of an event."""
    faces = [i for i, line in enumerate(lines) if line.startswith(("face ", "inside "))]
    cycles = {i: lines[i].split()[1:] for i in faces}
    side = {(u, v): i for i, c in cycles.items() for u, v in pairwise([*c, c[0]])}
    shared = [(u, v) for (u, v), i in side.items() if side.get((v, u), i) != i]
    if not shared:
        return None
    u, v = random.choice(shared)
    i, j = side[u, v], side[v, u]
    first, second = _from(cycles[i], v), _from(cycles[j], u)
    around = first[:-1] + second[:-1]  # from v around to u, and back
    p, q = sorted(random.sample(range(len(around)), 2))
    one, two = around[p : q + 1], around[q:] + around[: p + 1]
    if min(len(one), len(two)) < 3 or (around[p], around[q]) in side:
        return None
    label = lines[i].split()[0]
    moved = _at(lines, i, " ".join([label, *one]))
    return _at(moved, j, " ".join([label, *two]))


def _from(cycle: list[str], v: str) -> list[str]:
    k = cycle.index(v)
    return cycle[k:] + cycle[:k]


TEXTS: Final[dict[str, Mutation]] = {
    "edge moved": edge_moved,
    "time nudged": nudged,
    "event dropped": dropped,
    "event doubled": doubled,
    "events swapped": swapped,
    "wrong contact": wrong_contact,
    "just after its time": just_after,
}
"""The mutations of texts by kind."""
