"""Questions a second: many small questions at once, beside one by one, and other programs.

Triangles, and points against segments, all in linear motion, in general position. A sample of the
questions is computed one by one; the results must be those of the arrays.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Final, NamedTuple, TypeAlias

import numpy as np

from benchmarks.output import Output, Row
from benchmarks.programs import with_box2d, with_ipctk
from benchmarks.timing import timed
from exactpt import AuditError, Contact, first_contact
from exactpt.arrays import KINDS, Contacts, first_contacts, point_segment_contacts
from exactpt.kernel.numbers import rational

__all__ = ["FULL", "QUICK", "Sizes", "run"]

Asked: TypeAlias = Callable[[], object]
"""Asks another program some questions."""

PASSES: Final = 3
"""Number of times that the arrays are asked; the least time counts."""
TOLERANCE: Final = 1e-6
"""Distance at which ipctk stops, relative to the size of the question."""


class Sizes(NamedTuple):
    """Number of queries and of pairs of triangles, and of those that are computed one by one."""

    queries: int
    pairs: int
    sample: int


QUICK: Final = Sizes(100_000, 20_000, 60)
FULL: Final = Sizes(1_000_000, 200_000, 500)


class _Questions(NamedTuple):
    """Questions of one kind.

    Attributes:
        name: of the kind.
        size: their number.
        ask: computes all at once.
        peers: of each other program the package, and a function from numbers of questions to
            a function that computes these.
    """

    name: str
    size: int
    ask: Callable[[], Contacts]
    peers: Mapping[str, tuple[str, Callable[[list[int]], Asked]]]


def run(output: Output, sizes: Sizes, seed: int) -> None:
    """Compute all questions.

    Raises:
        AuditError: if a result of the arrays is not that of `first_contact`.
    """
    rng = np.random.default_rng(seed)
    rows: list[Row] = []
    for questions in (
        _queries(rng, sizes.queries),
        _triangles(rng, sizes.pairs, 2.0, "pairs of triangles, near"),
        _triangles(rng, sizes.pairs, 100.0, "pairs of triangles, sparse"),
    ):
        output.progress(questions.name)
        rows += _rows(output, questions, rng, sizes.sample)
    output.table("arrays", rows)


def _rows(
    output: Output, questions: _Questions, rng: np.random.Generator, sample: int
) -> list[Row]:
    passes = [timed(questions.ask) for _ in range(PASSES)]
    contacts = passes[0][0]
    seconds = min(seconds for _, seconds in passes)
    some = rng.choice(questions.size, sample, replace=False).tolist()
    scenes = [contacts.scene(i) for i in some]
    single, one_by_one = timed(lambda: [first_contact(scene) for scene in scenes])
    for i, contact in zip(some, single, strict=True):
        if not _same(contacts, i, contact):
            raise AuditError(f"{questions.name}, question {i}: not the answer of first_contact")
    each = one_by_one / sample
    rows: list[Row] = [
        _row(questions, "exactpt, arrays", seconds / questions.size, each, contacts),
        _row(questions, "exactpt, first_contact", each, each, None),
    ]
    for name, (package, prepare) in questions.peers.items():
        if output.has(package):
            _, taken = timed(prepare(some))
            rows.append(_row(questions, name, taken / sample, each, None))
    return rows


def _row(
    questions: _Questions, program: str, seconds: float, reference: float, contacts: Contacts | None
) -> Row:
    return {
        "questions": questions.name,
        "program": program,
        "asked": questions.size if contacts is not None else None,
        "a second": 1.0 / seconds,
        "times first_contact": reference / seconds,
        "contacts": None if contacts is None else int(contacts.found.sum()),
        "exact share": None if contacts is None else contacts.exact_share,
    }


def _same(contacts: Contacts, i: int, contact: Contact | None) -> bool:
    if contact is None:
        return not contacts.found[i]
    low, high = (rational(float(t[i])) for t in (contacts.low, contacts.high))
    return KINDS[contacts.kind[i]] == contact.kind and low <= contact.time <= high


def _queries(rng: np.random.Generator, count: int) -> _Questions:
    places, velocities = rng.uniform(-1.0, 1.0, (2, 3, count, 2))

    def ask() -> Contacts:
        p, a, b = places
        return point_segment_contacts(p, a, b, velocities=list(velocities))

    def ask_ipctk(some: list[int]) -> Asked:
        method = with_ipctk.method_of("tight inclusion", tolerance=TOLERANCE)
        later = places + velocities
        given = [(*places[:, i], *later[:, i]) for i in some]
        return lambda: [method.point_edge_ccd(*rows) for rows in given]

    peers = {"ipctk, point-edge": ("ipctk", ask_ipctk)}
    return _Questions("points against segments", count, ask, peers)


def _triangles(rng: np.random.Generator, count: int, size: float, name: str) -> _Questions:
    """Pairs of triangles of about unit size, in a square."""
    centres = rng.uniform(0.0, size, (2 * count, 1, 2))
    corners = centres + rng.uniform(-1.0, 1.0, (2 * count, 3, 2))
    velocities = rng.uniform(-2.0, 2.0, (2 * count, 2))
    offsets = np.arange(0, 6 * count + 1, 3)
    pairs = np.arange(2 * count).reshape(count, 2)

    def ask() -> Contacts:
        return first_contacts(corners.reshape(-1, 2), offsets, pairs, velocities=velocities)

    def ask_box2d(some: list[int]) -> Asked:
        asks = [
            with_box2d.impact_of({"a": body(2 * i), "b": body(2 * i + 1), "span": 1.0})
            for i in some
        ]
        return lambda: [ask() for ask in asks]

    def body(i: int) -> dict[str, object]:
        x, y = velocities[i].tolist()
        return {"vertices": corners[i].tolist(), "x": [0.0, x], "y": [0.0, y]}

    return _Questions(name, count, ask, {"Box2D, time of impact": ("box2d", ask_box2d)})
