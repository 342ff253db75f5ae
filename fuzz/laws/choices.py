"""Laws about chosen pairs: between, ignoring, since and a planner select pairs of bodies.

Groups that ignore each other may overlap, and some of them may be those of the scene.
"""

from __future__ import annotations

from collections.abc import Collection
from fractions import Fraction
from itertools import combinations
from random import Random
from typing import NamedTuple, TypeAlias

import exactpt
from exactpt import AlgebraicNumber, Contact, InputError, Scene
from exactpt.kernel.numbers import QQ, fraction
from exactpt.testing import reference
from exactpt.testing.agreement import plain_contact
from fuzz.laws.law import check_equal, refuse_unless
from fuzz.laws.questions import DISTANCES, a_time

__all__ = ["choices_are_each_pair_alone", "chosen_contacts_are_part_of_all"]

Pair: TypeAlias = frozenset[str]
Found: TypeAlias = tuple[AlgebraicNumber, set[Pair]] | None
"""The time of a contact, and the pairs of bodies in it."""


class Choice(NamedTuple):
    """Some pairs of bodies that count, named in a way that public functions take.

    Attributes:
        kind: "between" or "ignoring".
        scene: the scene, with some of the groups.
        between: the pairs, or None.
        ignoring: the other groups.
        chosen: the pairs that count.
    """

    kind: str
    scene: Scene
    between: list[list[str]] | None
    ignoring: list[list[str]]
    chosen: set[Pair]


def _counted(scene: Scene) -> set[Pair]:
    every = {frozenset({a.name, b.name}) for a, b in reference.counted_pairs(scene)}
    refuse_unless(every)
    return every


def _between(scene: Scene, random: Random) -> Choice:
    every = sorted(_counted(scene), key=sorted)
    chosen = random.sample(every, random.randint(1, len(every)))
    named = [random.sample(sorted(pair), 2) for pair in chosen]
    return Choice("between", scene, named, [], set(chosen))


def _ignoring(scene: Scene, random: Random) -> Choice:
    every = _counted(scene)
    names = [body.name for body in scene.bodies]
    groups = [
        random.sample(names, random.randint(2, len(names))) for _ in range(random.randint(1, 3))
    ]
    ignored = {frozenset(pair) for group in groups for pair in combinations(group, 2)}
    of_scene = random.randint(0, len(groups))
    grouped = Scene(scene.bodies, scene.time, ignoring=[*scene.ignoring, *groups[:of_scene]])
    return Choice("ignoring", grouped, None, groups[of_scene:], every - ignored)


def chosen_contacts_are_part_of_all(scene: Scene, random: Random) -> str:
    """Contacts, approaches and new contacts of chosen pairs follow from those of each pair."""
    choice = random.choice([_between, _ignoring])(scene, random)
    _check_contacts(scene, choice)
    _check_approach(scene, choice, fraction(random.choice(DISTANCES)))
    new = _check_new(scene, choice)
    return f"{choice.kind}, {'no contact' if new is None else new.kind}"


def _check_contacts(scene: Scene, choice: Choice) -> None:
    every = exactpt.contacts(scene)
    some = exactpt.contacts(choice.scene, between=choice.between, ignoring=choice.ignoring)
    check_equal("contacts", some, [i for i in every if frozenset({i.a, i.b}) in choice.chosen])


def _check_approach(scene: Scene, choice: Choice, distance: Fraction) -> None:
    found = exactpt.first_within(
        choice.scene, distance=distance, between=choice.between, ignoring=choice.ignoring
    )
    check_equal("first within", found, _first_approach(scene, choice.chosen, distance))


def _first_approach(
    scene: Scene, chosen: Collection[Pair], distance: Fraction
) -> exactpt.Approach | None:
    """Return the least of the times of the chosen pairs, and those that have it."""
    names = [(a.name, b.name) for a, b in combinations(scene.bodies, 2)]
    pairs = [pair for pair in names if frozenset(pair) in chosen]
    times = {pair: exactpt.first_within(scene, *pair, distance) for pair in pairs}
    within = {pair: time for pair, time in times.items() if isinstance(time, AlgebraicNumber)}
    if not within:
        return None
    first = min(within.values())
    at_first = [pair for pair, time in within.items() if time == first]
    return exactpt.Approach(first, tuple(sorted(at_first)))


def _check_new(scene: Scene, choice: Choice) -> Contact | None:
    """Check a new contact, and return it; that of a body with itself may be before all others."""
    new = exactpt.first_contact(
        choice.scene, after_start=True, between=choice.between, ignoring=choice.ignoring
    )
    if new is not None and new.kind == "self":
        return new
    found = plain_contact(new)
    of_two = found and (found.time, {pair for pair in found.names if len(pair) == 2})
    pairs = [sorted(pair) for pair in choice.chosen]
    check_equal("new contact", of_two, reference.first_new_contact(scene, pairs))
    return new


def choices_are_each_pair_alone(scene: Scene, random: Random) -> str:
    """A contact of chosen pairs is the first of these pairs, each taken by itself."""
    start = scene.exact_start
    kind = random.choice(["since", "ignoring", "between", "planner"])
    if kind == "since":
        start = a_time(scene, random)
        chosen = _counted(scene)
        refuse_unless(start < scene.exact_end and _are_bodies(scene, start))
        contact = exactpt.first_contact(scene, since=fraction(start))
    elif kind == "planner":
        mover = random.choice(scene.bodies)
        obstacles = [body for body in scene.bodies if body is not mover]
        chosen = {frozenset({mover.name, body.name}) for body in obstacles}
        planner = exactpt.Planner(obstacles, (scene.start, scene.end))
        contact = planner.first_contact(mover, mover.motion)
    else:
        choice = (_ignoring if kind == "ignoring" else _between)(scene, random)
        chosen = choice.chosen
        contact = exactpt.first_contact(
            choice.scene, between=choice.between, ignoring=choice.ignoring
        )
    found = _value(contact)
    refuse_unless(found is None or all(len(pair) == 2 for pair in found[1]))
    expected = _first_of(scene, chosen, start)
    check_equal(kind, found, expected)
    return f"{kind}, {'no contact' if expected is None else 'a contact'}"


def _are_bodies(scene: Scene, start: QQ) -> bool:
    """Return False if a body has touched itself before a later start, and is none any more."""
    try:
        Scene(scene.bodies, (fraction(start), scene.end))
    except InputError:
        return False
    return True


def _value(contact: Contact | None) -> Found:
    if contact is None:
        return None
    pairs = contact.initial_pairs or [(pair.body, pair.other) for pair in contact.pairs]
    return contact.time, set(map(frozenset, pairs))


def _first_of(scene: Scene, chosen: Collection[Pair], start: QQ) -> Found:
    """Return the first time at which a chosen pair meets, and all chosen pairs that do."""
    best: Found = None
    for two in combinations(scene.bodies, 2):
        if frozenset(body.name for body in two) not in chosen:
            continue
        alone = Scene(two, (fraction(start), scene.end))
        defined = reference.first_contact(alone)
        if defined is None:
            continue
        found = defined.time, defined.names
        refuse_unless(all(len(pair) == 2 for pair in found[1]))  # a body that touches itself
        if best is None or found[0] < best[0]:
            best = found
        elif found[0] == best[0]:
            best = best[0], best[1] | found[1]
    return best
