"""Laws about chosen pairs: between, ignoring, since and a planner select pairs of bodies."""

from __future__ import annotations

from collections.abc import Collection
from itertools import combinations
from random import Random
from typing import TypeAlias

import exactpt
from exactpt import AlgebraicNumber, Contact, InputError, Scene
from exactpt.kernel.numbers import QQ, fraction
from exactpt.testing import reference
from fuzz.laws.law import check_equal, refuse_unless
from fuzz.laws.questions import a_time

__all__ = ["choices_are_each_pair_alone"]

Pair: TypeAlias = frozenset[str]
Found: TypeAlias = tuple[AlgebraicNumber, set[Pair]] | None
"""The time of a contact, and the pairs of bodies in it."""


def choices_are_each_pair_alone(scene: Scene, random: Random) -> str:
    """A contact of chosen pairs is the first of these pairs, each taken by itself."""
    names = [body.name for body in scene.bodies]
    every = {frozenset({a.name, b.name}) for a, b in reference.counted_pairs(scene)}
    refuse_unless(every)
    start = scene.exact_start
    kind = random.choice(["since", "ignoring", "between", "planner"])
    if kind == "since":
        start = a_time(scene, random)
        chosen = every
        refuse_unless(start < scene.exact_end and _are_bodies(scene, start))
        contact = exactpt.first_contact(scene, since=fraction(start))
    elif kind == "ignoring":
        groups = [
            random.sample(names, random.randint(2, len(names)))
            for _ in range(random.randint(1, 3))  # they may overlap
        ]
        chosen = every - {frozenset(pair) for group in groups for pair in combinations(group, 2)}
        of_scene = random.randint(0, len(groups))
        grouped = Scene(scene.bodies, scene.time, ignoring=[*scene.ignoring, *groups[:of_scene]])
        contact = exactpt.first_contact(grouped, ignoring=groups[of_scene:])
    elif kind == "between":
        chosen = set(random.sample(sorted(every, key=sorted), random.randint(1, len(every))))
        contact = exactpt.first_contact(scene, between=[sorted(pair) for pair in chosen])
    else:
        mover = random.choice(scene.bodies)
        obstacles = [body for body in scene.bodies if body is not mover]
        chosen = {frozenset({mover.name, body.name}) for body in obstacles}
        planner = exactpt.Planner(obstacles, (scene.start, scene.end))
        contact = planner.first_contact(mover, mover.motion)
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
