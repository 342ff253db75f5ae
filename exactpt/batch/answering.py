"""The results of scenes: pairs of bodies that translate by arrays, the rest one by one."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from itertools import islice
from typing import Final

import numpy as np

from exactpt.arrays.contacts import KINDS, Contacts
from exactpt.arrays.screening import screened
from exactpt.batch.linear import contact_between, initial_contact, is_linear, linear_contact
from exactpt.batch.options import Options
from exactpt.batch.two_bodies import TwoBodies, read_two_bodies
from exactpt.errors import BudgetExceeded, InputError, RoundingError
from exactpt.kernel.budget import check_budget
from exactpt.kernel.collection import collector_at_rest
from exactpt.motion.track import Incidence
from exactpt.scene.body_arrays import BodyArrays
from exactpt.scene.format import loads
from exactpt.scene.scene import Scene

TOGETHER: Final = 512
"""Number of scenes that are taken together."""

INITIAL: Final = KINDS.index("initial")

Answer = dict[str, object]


def answers(scenes: Iterable[str | bytes], options: Options | None = None) -> Iterator[Answer]:
    """Yield the result of each scene, a JSON text (docs/format.md), without a line number.

    >>> two = '''{"exactpt": 1, "time": [0, 9], "bodies": [
    ...     {"name": "ball", "vertices": [[0, 0]], "motion": {"x": [0, 1]}},
    ...     {"name": "wall", "vertices": [[4, -1], [4, 2]]}]}'''
    >>> first, second = answers([two, "{}"])
    >>> first["contact"]["time"]["low"], second
    ('4', {'error': 'scene: the key "exactpt" is missing'})

    Args:
        scenes: the texts; they are taken some hundred at a time.
        options: the query; by default the first contact.
    """
    chosen = options or Options()
    contents = (text.encode(errors="replace") if isinstance(text, str) else text for text in scenes)
    while some := list(islice(contents, TOGETHER)):
        yield from answers_of(some, chosen)


def answers_of(contents: Sequence[bytes], options: Options) -> Iterator[Answer]:
    """Yield the results of some scenes, computed together."""
    known = _by_arrays(contents, options) if options.is_plain else {}
    for k, content in enumerate(contents):
        yield known[k] if k in known else answer(content, options)


def answer(content: bytes, options: Options) -> Answer:
    """Return the result of a scene as JSON, or ``{"error"}`` with the reason."""
    if len(content) > options.max_bytes:
        return {"error": f"more than {options.max_bytes} bytes"}
    try:
        with options.budget():
            check_budget()
            return options.answer(_scene(content))
    except (InputError, BudgetExceeded) as error:
        return {"error": str(error)}
    except MemoryError:
        return {"error": "memory limit exceeded"}
    except RoundingError:  # not a fault of the scene
        raise
    except Exception as error:  # a bug: the other scenes get their results nevertheless
        return {"error": f"an invariant broke: {type(error).__name__}: {error}"}


def _scene(content: bytes) -> Scene:
    try:
        text = content.decode("utf-8-sig")
    except UnicodeDecodeError:
        raise InputError("not UTF-8") from None
    return loads(text)


def _by_arrays(contents: Sequence[bytes], options: Options) -> dict[int, Answer]:
    """Return the results that filters have found, by the index of the scene."""
    try:
        with options.budget(), collector_at_rest():
            check_budget()
            return _screened(_read(contents, options.max_bytes), contents)
    except BudgetExceeded:  # each by itself
        return {}


def _read(contents: Sequence[bytes], longest: int) -> dict[int, TwoBodies]:
    read: dict[int, TwoBodies] = {}
    for k, content in enumerate(contents):
        scene = read_two_bodies(content) if len(content) <= longest else None
        if scene is not None:
            read[k] = scene
    return read


def _screened(read: dict[int, TwoBodies], contents: Sequence[bytes]) -> dict[int, Answer]:
    turning = {place: scene for place, scene in read.items() if scene.turns}
    translating = {place: scene for place, scene in read.items() if not scene.turns}
    return _of_one_kind(translating, contents) | _of_one_kind(turning, contents)


def _of_one_kind(read: dict[int, TwoBodies], contents: Sequence[bytes]) -> dict[int, Answer]:
    """As `_screened`, of scenes that all turn, or all do not."""
    if not read:
        return {}
    scenes, places = [*read.values()], [*read]
    bodies = BodyArrays(
        np.array([x for scene in scenes for x in scene.points]).reshape(-1, 2),
        np.cumsum([0, *(len(body.vertices) for scene in scenes for body in scene.bodies)]),
        coefficients=np.array([scene.coefficients for scene in scenes]).reshape(-1, 2, 3),
        closed=[body.closed for scene in scenes for body in scene.bodies],
    )
    spans = np.array([scene.span for scene in scenes])
    turns = np.array([scene.turns for scene in scenes]).reshape(-1, 6) if scenes[0].turns else None
    contacts = screened(bodies, spans, lambda k: _scene(contents[places[k]]), turns)
    found = {}
    for k, (place, scene) in enumerate(read.items()):
        known = _contact(scene, contacts, k)
        if known is not None:
            found[place] = known
    return found


def _contact(scene: TwoBodies, contacts: Contacts, k: int) -> Answer | None:
    """Return the result of a pair of bodies; None if arrays have not found it."""
    if contacts.exact[k]:
        return None
    if not contacts.found[k]:
        return {"contact": None}
    if contacts.kind[k] == INITIAL:
        return {"contact": initial_contact(scene)}
    side, vertex, edge = int(contacts.body[k]), int(contacts.vertex[k]), int(contacts.edge[k])
    if is_linear(scene):
        return {"contact": linear_contact(scene, side, vertex, edge)}
    touch = Incidence(side, vertex, 1 - side, edge, -1)
    times = float(contacts.low[k]), float(contacts.high[k])
    return {"contact": contact_between(contacts.scene(k), touch, *times)}
