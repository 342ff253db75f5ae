"""Truths: the exact first contacts of many questions, by arrays where bodies translate."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import NamedTuple

import numpy as np

from exactpt.arrays.contacts import KINDS, Contacts
from exactpt.arrays.pairs import first_contacts
from exactpt.brief import record_in_brief
from exactpt.kernel.algebraic import AlgebraicNumber
from exactpt.kernel.integer_polynomial import sign_at
from exactpt.kernel.numbers import QQ, rational
from exactpt.kernel.polynomial import Polynomial
from exactpt.pair.contact import Contact
from exactpt.search.first import first_contact
from exactpt.testing.questions import Asked, Moving, Question


class Truth(NamedTuple):
    """The first contact of two bodies, "a" and "b".

    Attributes:
        time: the exact time; None if no contact exists.
        kind: as in `exactpt.Contact`; None if no contact exists.
        pair: the first incidence as JSON (docs/format.md), without its point and normal; None if
            there is none.
    """

    time: AlgebraicNumber | None
    kind: str | None = None
    pair: dict[str, object] | None = None

    def __repr__(self) -> str:
        return record_in_brief(self)

    def to_json(self) -> dict[str, object]:
        """Return the truth as a JSON object, see docs/testing.md."""
        if self.time is None:
            return {"time": None}
        return {"time": self.time.to_json(), "kind": self.kind, "pair": self.pair}


def truths(questions: Sequence[Asked]) -> list[Truth]:
    """Return the truths of questions, in their order.

    Raises:
        InputError: if a span is empty, or a body is not simple.
    """
    plain = [k for k, asked in enumerate(questions) if isinstance(asked, Question)]
    found = dict(zip(plain, _by_arrays([questions[k] for k in plain]), strict=True))
    return [found[k] if k in found else truth_of(asked) for k, asked in enumerate(questions)]


def truth_of(asked: Asked) -> Truth:
    """Return the truth of one question.

    Raises:
        InputError: see `truths`.
    """
    contact = first_contact(asked.scene if isinstance(asked, Question) else asked)
    return Truth(None) if contact is None else _truth(contact)


def _truth(contact: Contact) -> Truth:
    pairs = contact.pairs  # with them, the time has its final form
    first = None
    if pairs:
        first = {key: v for key, v in pairs[0].to_json().items() if key in ("kind", "a", "b")}
    return Truth(contact.time, contact.kind, first)


def _by_arrays(questions: Sequence[Asked]) -> Iterator[Truth]:
    asked = [q for q in questions if isinstance(q, Question)]
    contacts = contacts_of(asked) if asked else None
    for k, question in enumerate(asked):
        if contacts is not None:
            yield _answer(question, contacts, k) if contacts.found[k] else Truth(None)


def contacts_of(asked: Sequence[Question]) -> Contacts:
    """Return the first contacts of some questions, at least one, in arrays."""
    bodies = [body for q in asked for body in (q.a, q.b)]
    size = max(2, *(max(len(m.x), len(m.y)) for m in bodies))
    coefficients = np.zeros((len(bodies), 2, size))
    for k, m in enumerate(bodies):
        coefficients[k, 0, : len(m.x)] = m.x
        coefficients[k, 1, : len(m.y)] = m.y
    return first_contacts(
        [v for m in bodies for v in m.vertices],
        np.cumsum([0, *(len(m.vertices) for m in bodies)]),
        np.arange(len(bodies)).reshape(-1, 2),
        coefficients=coefficients,
        closed=[m.closed for m in bodies],
        time=[q.time for q in asked],
    )


def _answer(question: Question, contacts: Contacts, k: int) -> Truth:
    """Return the truth of a question by arrays, with the exact time."""
    kind = KINDS[contacts.kind[k]]
    if kind == "initial":
        return Truth(AlgebraicNumber(question.time[0]), kind, first_pair(contacts, k))
    time = _time(question, contacts, k)
    return truth_of(question) if time is None else Truth(time, kind, first_pair(contacts, k))


def first_pair(contacts: Contacts, k: int) -> dict[str, object] | None:
    """Return the first incidence of a pair in the form of a truth; None if bodies overlap."""
    body, edge = int(contacts.body[k]), int(contacts.edge[k])
    if body < 0:
        return None
    other = ("edge", edge) if edge >= 0 else ("vertex", int(contacts.other_vertex[k]))
    return {
        "kind": "vertex-edge" if edge >= 0 else "vertex-vertex",
        "a": {"body": "ab"[body], "vertex": int(contacts.vertex[k])},
        "b": {"body": "ab"[1 - body], other[0]: other[1]},
    }


def _time(question: Question, contacts: Contacts, k: int) -> AlgebraicNumber | None:
    """Return the time as the root of the first incidence's polynomial in the enclosure.

    None if it is not clear that there is one.
    """
    low, high = rational(float(contacts.low[k])), rational(float(contacts.high[k]))
    if low == high:
        return AlgebraicNumber(low)
    mover, other = (question.a, question.b)[:: 1 if contacts.body[k] == 0 else -1]
    return root_between(_incidence(mover, other, contacts, k).exact_integers(), low, high)


def root_between(f: Sequence[int], low: QQ, high: QQ) -> AlgebraicNumber | None:
    """Return the one root between two bounds of an integer polynomial, the constant first.

    There is at least one. None if it is not clear that there is one only: a quadratic has exactly
    one root between two places where its signs are opposite, and one in all if its discriminant
    is 0; of a higher degree it is never clear.
    """
    while f and not f[-1]:
        f = f[:-1]
    if len(f) == 2:
        return AlgebraicNumber(QQ(-f[0], f[1]))
    if len(f) != 3:
        return None
    if f[1] * f[1] == 4 * f[0] * f[2]:
        return AlgebraicNumber(QQ(-f[1], 2 * f[2]))
    if low == high:
        return AlgebraicNumber(low)
    if sign_at(tuple(f), low) * sign_at(tuple(f), high) >= 0:
        return None
    return AlgebraicNumber.root(f, low, high)


def _incidence(mover: Moving, other: Moving, contacts: Contacts, k: int) -> Polynomial:
    """Return a polynomial that vanishes at the time of the first incidence."""
    edge = int(contacts.edge[k])
    at = edge if edge >= 0 else int(contacts.other_vertex[k])
    v, p = mover.vertices[contacts.vertex[k]], other.vertices[at]
    x = Polynomial(mover.x) - Polynomial(other.x) + Polynomial([_minus(v[0], p[0])])
    y = Polynomial(mover.y) - Polynomial(other.y) + Polynomial([_minus(v[1], p[1])])
    if edge < 0:
        return x if x.degree == 1 else y
    q = other.vertices[(edge + 1) % len(other.vertices)]
    return y * Polynomial([_minus(q[0], p[0])]) - x * Polynomial([_minus(q[1], p[1])])


def _minus(a: float, b: float) -> QQ:
    return rational(a) - rational(b)
