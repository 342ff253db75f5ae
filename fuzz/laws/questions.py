"""The registry of questions: each with the public ways to ask it, and its definition.

An answer is a plain value in a normal form, so equal answers mean that two ways agree. What a way
does not support it refuses with `LeftOutError`.
"""

from __future__ import annotations

import json
import pickle
from collections.abc import Callable, Iterable
from dataclasses import dataclass
from itertools import combinations
from random import Random
from typing import Any, Final, TypeAlias

import exactpt
from exactpt import (
    AlgebraicNumber,
    Body,
    BudgetExceeded,
    Contact,
    ContactInterval,
    InputError,
    Scene,
    Simulation,
)
from exactpt.kernel.algebraic_value import square_root
from exactpt.kernel.numbers import QQ, fraction, rational
from exactpt.kernel.square_root import exact_square_root
from exactpt.search.clearance import CloseInterval
from exactpt.testing import reference
from exactpt.testing.agreement import plain, plain_contact
from fuzz.laws.law import refuse_unless
from fuzz.witnesses import LeftOutError, tilings_of

__all__ = ["DISTANCES", "QUESTIONS", "Answer", "Question", "a_time", "contact_kind",
           "contact_value", "defined_intervals", "two_names"]  # fmt: skip

Answer: TypeAlias = Any
"""A plain value: numbers, texts, tuples, sets of these."""

Asked: TypeAlias = Any
"""What a question asks about besides the scene: a distance, a time, names of bodies; or None."""

Way: TypeAlias = Callable[[Scene, Asked], Answer]

TILINGS: Final = ("lazy", "greedy", "mixed", "incremental")

DISTANCES: Final = (QQ(0), QQ(1, 3), QQ(1, 2), QQ(1), QQ(3, 2), QQ(2), QQ(10, 3))

IRRATIONAL: Final = (QQ(2), QQ(5), QQ(1, 2), QQ(5, 9))
"""Squares of irrational distances."""

EXTREME: Final = (QQ(1, 10**400), QQ(1, 10**30), QQ(10) ** 30, QQ(10) ** 400)
"""Distances far from all others, some of which no double has."""


def _nothing(scene: Scene, random: Random) -> Asked:  # noqa: ARG001
    return None


@dataclass(frozen=True, slots=True)
class Question:
    """A question about scenes.

    Attributes:
        ways: the public ways to ask it; their answers are equal.
        define: its definition, for small scenes.
        comparable: the part of an answer that the definition has; by default all of it.
        kind: the outcome in a few words, of an answer.
        draw: draws what is asked about besides the scene.
    """

    ways: dict[str, Way]
    define: Way
    kind: Callable[[Answer], str]
    draw: Callable[[Scene, Random], Asked] = _nothing
    comparable: Callable[[Answer], Answer] = lambda answer: answer


# What is asked about


def a_time(scene: Scene, random: Random, steps: int = 8) -> QQ:
    """Return the start, the end, or a multiple of a part of the time span."""
    part = QQ(random.randint(0, steps), steps)
    time: QQ = scene.exact_start + (scene.exact_end - scene.exact_start) * part
    return time


def two_names(scene: Scene, random: Random) -> tuple[str, str]:
    """Return the names of two bodies of a scene that do not ignore each other.

    Raises:
        LeftOutError: if no two bodies count.
    """
    pairs = _counted(scene)
    refuse_unless(pairs)
    first, second = random.choice(pairs)
    return random.choice([(first, second), (second, first)])


def _counted(scene: Scene) -> list[tuple[str, str]]:
    """Return the names of any two bodies of a scene that do not ignore each other."""
    return [(a.name, b.name) for a, b in reference.counted_pairs(scene)]


# The first contact


def contact_value(contact: Contact | None) -> Answer:
    """Return the time, the kind, and the sets of pairs of a contact: all that a user sees."""
    if contact is None:
        return None
    initial_pairs = frozenset(map(frozenset, contact.initial_pairs))
    return contact.time, contact.kind, initial_pairs, contact.pairs


def _without_points(value: Answer) -> Answer:
    """Return a contact without its points and normals, which no definition has."""
    if value is None:
        return None
    time, kind, initial_pairs, pairs = value
    incidences = plain_contact(Contact(time, kind, pairs)).incidences  # type: ignore[union-attr]
    return time, kind, initial_pairs, incidences


def _defined_contact(scene: Scene, _: Asked) -> Answer:
    contact = reference.first_contact(scene)
    if contact is None:
        return None
    initial_pairs = frozenset(map(frozenset, contact.initial_pairs))
    return contact.time, contact.kind, initial_pairs, contact.incidences


def contact_kind(value: Answer) -> str:
    """Return the outcome of a first contact in words."""
    return "no contact" if value is None else str(value[1])


def _by_tiling(name: str) -> Way:
    def ask(scene: Scene, _: Asked) -> Answer:
        refuse_unless(name in tilings_of(scene))
        return contact_value(exactpt.first_contact(scene, tiling=name))

    return ask


def _by_simulation(scene: Scene, _: Asked) -> Answer:
    names = tilings_of(scene)
    refuse_unless(names)
    tiling = names[scene.vertex_count % len(names)]
    return contact_value(Simulation(scene, tiling=tiling).run_to_contact())


def _read_again(scene: Scene, _: Asked) -> Answer:
    text = json.dumps(scene.to_json())
    return contact_value(exactpt.first_contact(Scene.from_json(json.loads(text))))


def _of_a_pickle(scene: Scene, _: Asked) -> Answer:
    return contact_value(exactpt.first_contact(pickle.loads(pickle.dumps(scene))))


def _between_all_pairs(scene: Scene, _: Asked) -> Answer:
    refuse_unless(not any(body.has_rings or body.keyframes for body in scene.bodies))
    pairs = _counted(scene)
    refuse_unless(pairs)
    contact = exactpt.first_contact(scene, between=pairs)
    whole = exactpt.first_contact(scene)
    if whole is not None and any(pair.body == pair.other for pair in whole.pairs):
        raise LeftOutError  # a body touches itself, which no pair of two bodies does
    return contact_value(contact)


def _by_certificate(scene: Scene, _: Asked) -> Answer:
    try:
        return contact_value(exactpt.certify(scene).contact)
    except (InputError, BudgetExceeded):
        raise LeftOutError from None  # bodies, or a closeness, that no certificate is about yet


def _by_proof(scene: Scene, _: Asked) -> Answer:
    names = tilings_of(scene)
    refuse_unless(names)
    tiling = names[scene.vertex_count % len(names)]
    return contact_value(exactpt.prove(scene, tiling=tiling).contact)


FIRST_CONTACT: Final = Question(
    ways={
        "auto": lambda scene, _: contact_value(exactpt.first_contact(scene)),
        "pairs": lambda scene, _: contact_value(exactpt.first_contact(scene, method="pairs")),
        "exact": lambda scene, _: contact_value(
            exactpt.first_contact(scene, method="pairs", exact_only=True)
        ),
        **{name: _by_tiling(name) for name in TILINGS},
        "simulation": _by_simulation,
        "read again": _read_again,
        "pickle": _of_a_pickle,
        "between": _between_all_pairs,
        "certificate": _by_certificate,
        "proof": _by_proof,
    },
    define=_defined_contact,
    kind=contact_kind,
    comparable=_without_points,
)


# The intervals in which bodies touch


def _by_pair(intervals: Iterable[ContactInterval | CloseInterval]) -> Answer:
    found: dict[tuple[str, str], list[tuple[AlgebraicNumber, AlgebraicNumber]]] = {}
    for interval in intervals:
        found.setdefault((interval.a, interval.b), []).append((interval.start, interval.end))
    return found


def _intervals_of_two(scene: Scene, _: Asked) -> Answer:
    return _by_pair(
        interval for a, b in _counted(scene) for interval in exactpt.contact_intervals(scene, a, b)
    )


def _intervals_named_backwards(scene: Scene, _: Asked) -> Answer:
    return _by_pair(
        interval for a, b in _counted(scene) for interval in exactpt.contact_intervals(scene, b, a)
    )


def _intervals_between_all(scene: Scene, _: Asked) -> Answer:
    return _by_pair(exactpt.contacts(scene, between=_counted(scene)))


def _intervals_at_no_distance(scene: Scene, _: Asked) -> Answer:
    return _by_pair(
        interval for a, b in _counted(scene) for interval in exactpt.clearance(scene, a, b).below(0)
    )


def defined_intervals(
    scene: Scene, a: Body, b: Body
) -> list[tuple[AlgebraicNumber, AlgebraicNumber]]:
    """Return the intervals in which two bodies of a scene touch, by definition."""
    reach = a.exact_radius + b.exact_radius
    if reach:
        return reference.intervals_within(a, b, scene.time, reach**2)
    return reference.contact_intervals(a, b, scene.time)


def _defined_contacts(scene: Scene, _: Asked) -> Answer:
    found = {}
    for a, b in reference.counted_pairs(scene):
        intervals = defined_intervals(scene, a, b)
        if intervals:
            found[a.name, b.name] = intervals
    return found


def _intervals_kind(value: Answer) -> str:
    intervals = [interval for some in value.values() for interval in some]
    instants = sum(start == end for start, end in intervals)
    return f"{min(len(intervals), 3)} intervals, {min(instants, 2)} of one instant"


CONTACTS: Final = Question(
    ways={
        "contacts": lambda scene, _: _by_pair(exactpt.contacts(scene)),
        "of two": _intervals_of_two,
        "named backwards": _intervals_named_backwards,
        "between": _intervals_between_all,
        "at no distance": _intervals_at_no_distance,
    },
    define=_defined_contacts,
    kind=_intervals_kind,
)


# The first time within a distance


def _a_squared_distance(scene: Scene, random: Random) -> QQ:
    """Draw the square of a distance: a small one, one of the size of the scene, or beyond doubles.

    Or that of two bodies at some time, which ties with the start or with another pair.
    """
    kind = random.choice(["small", "small", "root", "of the size", "at a time", "extreme"])
    if kind == "root" and not scene.has_radius:
        return random.choice(IRRATIONAL)
    if kind == "of the size":
        return (_size(scene) * QQ(random.randint(0, 30), 30)) ** 2
    if kind == "extreme":
        return random.choice(EXTREME) ** 2
    if kind == "at a time" and not scene.has_radius and _counted(scene):
        names = two_names(scene, random)
        there = exactpt.distance(scene, *names, at=fraction(a_time(scene, random)))
        return rational(there.squared)
    return random.choice(DISTANCES) ** 2


def _size(scene: Scene) -> QQ:
    """Return the largest difference of a coordinate of the first vertices at the start."""
    first = [body.exact_at(scene.exact_start)[0] for body in scene.bodies]
    differences = (abs(p - q) for u, v in combinations(first, 2) for p, q in zip(u, v, strict=True))
    return max(differences, default=QQ(1))


def _as_approach(found: exactpt.Approach | AlgebraicNumber | None) -> Answer:
    assert not isinstance(found, AlgebraicNumber)  # noqa: S101 - of two bodies alone
    return None if found is None else (found.time, set(found.pairs))


def _first_within(scene: Scene, squared: QQ) -> Answer:
    return _as_approach(exactpt.first_within(scene, distance_squared=fraction(squared)))


def _first_within_distance(scene: Scene, squared: QQ) -> Answer:
    distance = fraction(_root_of(squared))
    return _as_approach(exactpt.first_within(scene, distance=distance))


def _first_within_between(scene: Scene, squared: QQ) -> Answer:
    pairs = _counted(scene)
    found = exactpt.first_within(scene, distance_squared=fraction(squared), between=pairs)
    return _as_approach(found)


def _first_within_of_two(scene: Scene, squared: QQ) -> Answer:
    times = []
    for a, b in _counted(scene):
        time = exactpt.first_within(scene, a, b, distance_squared=fraction(squared))
        assert not isinstance(time, exactpt.Approach)  # noqa: S101 - of all bodies alone
        times.append((time, (a, b)))
    return _least(times)


def _first_below(scene: Scene, squared: QQ) -> Answer:
    distance = fraction(_root_of(squared))
    times = []
    for a, b in _counted(scene):
        intervals = exactpt.clearance(scene, a, b).below(distance)
        times.append((intervals[0].start if intervals else None, (a, b)))
    return _least(times)


def _root_of(squared: QQ) -> QQ:
    """Return a rational square root.

    Raises:
        LeftOutError: if it is irrational.
    """
    root = exact_square_root(squared)
    if root is None:
        raise LeftOutError
    return root


def _least(times: Iterable[tuple[AlgebraicNumber | None, tuple[str, str]]]) -> Answer:
    """Return the least of some times, with the pairs of bodies that have it."""
    some = [(time, names) for time, names in times if time is not None]
    if not some:
        return None
    first = min(time for time, _ in some)
    return first, {names for time, names in some if time == first}


def _defined_within(scene: Scene, squared: QQ) -> Answer:
    times = []
    for a, b in reference.counted_pairs(scene):
        radii = a.exact_radius + b.exact_radius
        of_cores = (_root_of(squared) + radii) ** 2 if radii else squared
        time = reference.first_within(a, b, scene.time, of_cores)
        times.append((time, (a.name, b.name)))
    return _least(times)


FIRST_WITHIN: Final = Question(
    ways={
        "squared": _first_within,
        "distance": _first_within_distance,
        "between": _first_within_between,
        "of two": _first_within_of_two,
        "below": _first_below,
    },
    define=_defined_within,
    kind=lambda value: "never" if value is None else f"{min(len(value[1]), 3)} pairs",
    draw=_a_squared_distance,
)


# The distance at a time


def _time_and_names(scene: Scene, random: Random) -> Asked:
    return a_time(scene, random), two_names(scene, random)


def _distance(scene: Scene, asked: Asked) -> Answer:
    time, (first, second) = asked
    return plain(exactpt.distance(scene, first, second, at=fraction(time)))


def _distance_named_backwards(scene: Scene, asked: Asked) -> Answer:
    time, (first, second) = asked
    there = exactpt.distance(scene, second, first, at=fraction(time))
    pairs = tuple((a, b) for b, a in there.features)
    return plain(exactpt.Distance(there.core_squared, pairs, there.radius))


def _distance_at_a_number(scene: Scene, asked: Asked) -> Answer:
    """The time is given as an exact number, of the type of results."""
    time, (first, second) = asked
    return plain(exactpt.distance(scene, first, second, at=AlgebraicNumber(time)))


def _defined_distance(scene: Scene, asked: Asked) -> Answer:
    time, (first, second) = asked
    return reference.nearest(scene.body(first), scene.body(second), fraction(time))


DISTANCE: Final = Question(
    ways={
        "distance": _distance,
        "named backwards": _distance_named_backwards,
        "at a number": _distance_at_a_number,
    },
    define=_defined_distance,
    kind=lambda value: f"{min(len(value[1]), 3)} pairs of features" if value[0] else "overlap",
    draw=_time_and_names,
)


# The first new contact


def _new_contact(
    scene: Scene, between: Iterable[tuple[str, str]] | None = None, *, exact_only: bool = False
) -> Answer:
    contact = exactpt.first_contact(scene, after_start=True, between=between, exact_only=exact_only)
    return _time_and_incidences(contact)


def _time_and_incidences(contact: Contact | None) -> Answer:
    """Return a contact as the definition has a new one; its kind follows from that."""
    found = plain_contact(contact)
    return None if found is None else (found.time, found.names, found.incidences)


def _first_of_all_if_not_at_start(scene: Scene, _: Asked) -> Answer:
    contact = exactpt.first_contact(scene)
    refuse_unless(contact is None or contact.kind != "initial")
    return _time_and_incidences(contact)


def _new_between_all(scene: Scene, _: Asked) -> Answer:
    refuse_unless(_no_body_touches_itself(scene))
    return _new_contact(scene, between=_counted(scene))


def _new_of_two(scene: Scene, _: Asked) -> Answer:
    refuse_unless(_no_body_touches_itself(scene))
    every = [_new_contact(scene, between=[pair]) for pair in _counted(scene)]
    found = [value for value in every if value is not None]
    if not found:
        return None
    first = min(time for time, _, _ in found)
    now = [value for value in found if value[0] == first]
    names = {pair for _, pairs, _ in now for pair in pairs}
    return first, names, frozenset(touch for _, _, touches in now for touch in touches)


def _no_body_touches_itself(scene: Scene) -> bool:
    alone = (Scene([body], scene.time) for body in scene.bodies)
    return all(exactpt.first_contact(one) is None for one in alone)


def _defined_new(scene: Scene, _: Asked) -> Answer:
    found = reference.first_new_contact(scene)
    if found is None:
        return None
    time, pairs = found
    named = [(min(pair), max(pair)) for pair in pairs]
    return time, pairs, reference.incidences(scene, time, named)


NEW_CONTACT: Final = Question(
    ways={
        "after start": lambda scene, _: _new_contact(scene),
        "exact": lambda scene, _: _new_contact(scene, exact_only=True),
        "between": _new_between_all,
        "of two": _new_of_two,
        "first of all": _first_of_all_if_not_at_start,
    },
    define=_defined_new,
    kind=lambda value: "none" if value is None else f"{min(len(value[1]), 3)} pairs of bodies",
)


# When bodies are within a distance


def _names_and_distance(scene: Scene, random: Random) -> Asked:
    """Draw two bodies and a distance, often the least one, so that it is reached at one time."""
    first, second = two_names(scene, random)
    distance = random.choice(DISTANCES)
    if random.random() < 0.5:
        least = _least_distance(scene, first, second)
        if least is not None:
            distance = least
    return first, second, distance


def _least_distance(scene: Scene, first: str, second: str) -> QQ | None:
    """Return the least distance of two bodies; None if it is not rational."""
    distance = exactpt.clearance(scene, first, second).minimum.distance.simplified()
    return distance.exact_low if distance.is_rational else None


def _below(scene: Scene, asked: Asked) -> Answer:
    first, second, distance = asked
    gap = exactpt.clearance(scene, first, second)
    return [(interval.start, interval.end) for interval in gap.below(fraction(distance))]


def _below_around(scene: Scene, asked: Asked) -> Answer:
    first, second, distance = asked
    near = exactpt.clearance(scene, first).below(fraction(distance))
    return [(interval.start, interval.end) for interval in near if interval.b == second]


def _defined_below(scene: Scene, asked: Asked) -> Answer:
    first, second, distance = asked
    a, b = scene.body(first), scene.body(second)
    reach = distance + a.exact_radius + b.exact_radius
    return reference.intervals_within(a, b, scene.time, reach**2)


BELOW: Final = Question(
    ways={"below": _below, "around": _below_around},
    define=_defined_below,
    kind=lambda value: f"{min(len(value), 3)} intervals",
    draw=_names_and_distance,
)


# The least distance


def _names(scene: Scene, random: Random) -> Asked:
    return two_names(scene, random)


def _minimum(scene: Scene, names: Asked) -> Answer:
    least = exactpt.clearance(scene, *names).minimum
    return least.time, least.distance


def _minimum_around(scene: Scene, names: Asked) -> Answer:
    """The least distance from all others, in a scene in which these are one body."""
    first, second = names
    alone = Scene([scene.body(first), scene.body(second)], scene.time)
    least = exactpt.clearance(alone, first).minimum
    return least.time, least.distance


def _defined_least(scene: Scene, names: Asked) -> Answer:
    a, b = (scene.body(name) for name in names)
    radii = a.exact_radius + b.exact_radius
    touch = reference.first_within(a, b, scene.time, radii**2)
    if touch is not None:
        return touch, AlgebraicNumber(0)
    least = reference.least_distance(a, b, scene.time)
    return least.time, square_root(least.core_squared) - fraction(radii)


LEAST_DISTANCE: Final = Question(
    ways={
        "clearance": _minimum,
        "named backwards": lambda scene, names: _minimum(scene, names[::-1]),
        "around": _minimum_around,
    },
    define=_defined_least,
    kind=lambda value: "they touch" if value[1] == 0 else "they stay apart",
    draw=_names,
)


QUESTIONS: Final[dict[str, Question]] = {
    "first contact": FIRST_CONTACT,
    "contacts": CONTACTS,
    "first within": FIRST_WITHIN,
    "distance": DISTANCE,
    "new contact": NEW_CONTACT,
    "below": BELOW,
    "least distance": LEAST_DISTANCE,
}
"""The questions by name."""
