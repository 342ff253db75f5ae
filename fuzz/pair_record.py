"""Records of all questions about pairs of bodies, to compare two versions of the code.

A record has a line for every scene: digests of the JSON answers to the questions that need no
tiling. Not recorded: counts of a search, and the doubles around a time in arrays.
"""

from __future__ import annotations

import json
import warnings
from collections.abc import Callable, Iterable, Iterator, Sequence
from functools import partial
from itertools import combinations, islice
from random import Random
from typing import Final

import numpy as np

from exactpt import (
    AlgebraicNumber,
    Approach,
    Clearance,
    Contact,
    ContactInterval,
    EnclosedContact,
    ExactPTError,
    Planner,
    Scene,
    clearance,
    contact_intervals,
    contacts,
    distance,
    first_contact,
    first_contact_enclosed,
    first_within,
)
from exactpt.arrays import first_contacts
from exactpt.batch import answers
from fuzz.changes.excerpts import scene_of
from fuzz.questions.scenes import crowded_scene, distant_scene, meeting_scene
from fuzz.questions.tiny import touching_scene
from fuzz.record import digest

__all__ = ["ARRAYS", "TINY", "array_answers", "pair_answers", "pair_record"]

TINY: Final = (meeting_scene, touching_scene, crowded_scene, distant_scene)
"""Scenes on an integer grid."""
ARRAYS: Final = 6
"""Number of blocks of pairs in arrays."""
OF_WHOLE: Final = ("first", "ignoring", "between", "root")
"""The questions about whole scenes."""
MOST: Final = 3
"""Number of pairs of one scene about which questions about two bodies are asked."""


def pair_record(families: Sequence[str], seeds: int, tiny: int) -> Iterator[str]:
    """Yield the lines of a record.

    Args:
        families: names of families of scenes.
        seeds: number of excerpts of scenes of each family; besides, one scene is whole.
        tiny: number of scenes on an integer grid.
    """
    for family in families:
        whole = pair_answers(scene_of(family, 0))
        yield _line(f"{family} 0", {name: whole[name] for name in OF_WHOLE})
        for seed in range(1, seeds + 1):
            yield _line(f"{family} {seed}", pair_answers(scene_of(family, seed)))
    for k in range(tiny):
        make = TINY[k % len(TINY)]
        yield _line(f"{make.__name__} {k}", pair_answers(make(Random(k))))
    for k in range(ARRAYS):
        yield _line(f"arrays {k}", {"answers": partial(array_answers, k)})


def _as_groups(names: Sequence[str]) -> list[Sequence[str]]:
    """Return the group of some bodies; none for a single one."""
    return [names] if len(names) > 1 else []


def pair_answers(scene: Scene) -> dict[str, Callable[[], object]]:
    """Return the questions about a scene by name."""
    names = [body.name for body in scene.bodies]
    pairs = list(islice(combinations(names, 2), MOST))
    middle = (scene.start + scene.end) / 2
    found: dict[str, Callable[[], object]] = {
        "first": lambda: [
            first_contact(scene),
            first_contact(scene, method="pairs"),
            first_contact(scene, since=middle),
            next(answers([json.dumps(scene.to_json())])),
        ],
        "exact": lambda: first_contact(scene, exact_only=True),
        "ignoring": lambda: first_contact(scene, ignoring=_as_groups(names[::2])),
        "between": lambda: first_contact(scene, between=pairs),
        "after": lambda: [
            first_contact(scene, after_start=True),
            first_contact(scene, after_start=True, ignoring=_as_groups(names[:2])),
        ],
        "within": lambda: [first_within(scene, distance=d) for d in (0, "1/3", 2)],
        "two": lambda: [first_within(scene, *pair, d) for pair in pairs for d in (0, "1/3", 2)],
        "root": lambda: first_within(scene, distance_squared=2),
        "contacts": lambda: contacts(scene),
        "intervals": lambda: [contact_intervals(scene, *pair) for pair in pairs],
        "distance": lambda: [distance(scene, *pair, t) for pair in pairs for t in (scene.start, 1)],
        "clearance": lambda: [clearance(scene, *pair) for pair in pairs],
        "enclosed": lambda: first_contact_enclosed(scene),
    }
    if len(names) > 1:
        *others, last = scene.bodies
        found["planner"] = lambda: Planner(others, (scene.start, scene.end)).first_contacts(
            last, [last.motion, others[0].motion]
        )
    return {name: _guarded(ask) for name, ask in found.items()}


def array_answers(seed: int) -> object:
    """Return the answers for random pairs in arrays, some on a grid and some with radii."""
    rng = np.random.default_rng(seed)
    sizes = rng.choice([1, 2, 3, 4], 60)
    offsets = np.concatenate(([0], np.cumsum(sizes)))
    corners = [2.0 * np.pi * (np.arange(n) + rng.uniform(0.0, 0.3, n)) / n for n in sizes]
    angles = np.concatenate(corners)
    ring = np.stack((np.cos(angles), np.sin(angles)), axis=1)
    places = np.repeat(rng.uniform(-4.0, 4.0, (60, 2)), sizes, axis=0)
    velocities = rng.uniform(-1.0, 1.0, (60, 2))
    if seed % 2:
        places, velocities = np.round(places), np.round(velocities)
        ring = np.round(8 * ring) / 8
    coefficients = np.stack((np.zeros((60, 2)), velocities, 0.125 * np.round(velocities)), axis=2)
    is_curved = seed % 3 == 2
    radii = 0.25 if seed >= ARRAYS // 2 else 0.0
    pairs = rng.permuted(np.arange(60)).reshape(-1, 2)
    found = first_contacts(
        ring + places, offsets, pairs, closed=sizes != 2, radii=radii, time=(0.0, 6.0),
        velocities=None if is_curved else velocities,
        coefficients=coefficients if is_curved else None,
    )  # fmt: skip
    columns = (found.found, found.kind, found.body, found.vertex, found.edge, found.other_vertex)
    return [
        [column.tolist() for column in columns],
        [found.contact(k) for k in range(len(pairs))],
    ]


def _line(name: str, asked: dict[str, Callable[[], object]]) -> str:
    return " ".join([name, *(f"{key} {digest(_plain(ask()))}" for key, ask in asked.items())])


def _guarded(ask: Callable[[], object]) -> Callable[[], object]:
    """Return a function whose value is the message of an error of the package, if there is one."""

    def value() -> object:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore", DeprecationWarning)
            try:
                return ask()
            except ExactPTError as error:
                return f"{type(error).__name__}: {error}"

    return value


def _plain(value: object) -> object:
    """Return an answer as JSON values."""
    if isinstance(value, Contact | ContactInterval | EnclosedContact | AlgebraicNumber):
        return value.to_json()
    if isinstance(value, Approach):
        return [value.time.to_json(), value.pairs]
    if isinstance(value, Clearance):
        least = value.minimum
        return _plain([value.pieces, value.radius, least.time, least.squared])
    if isinstance(value, str | bool | int) or value is None:
        return value
    if isinstance(value, dict):
        return value
    if isinstance(value, Iterable):
        return [_plain(item) for item in value]
    return repr(value)
