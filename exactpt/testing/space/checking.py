"""check_vertex_face and check_edge_edge: anyone's time of impact in space against the truth."""

from __future__ import annotations

import copy
from collections.abc import Callable, Iterator, Sequence
from fractions import Fraction
from typing import Any, Final

from exactpt.errors import InputError
from exactpt.kernel.numbers import Rational, shorten
from exactpt.testing.checking import Report, Subject, check_subject
from exactpt.testing.comparing import TOLERANCE, bound, shown_time, verdict
from exactpt.testing.shrinking import coarser_numbers, shrink_data, simpler_numbers
from exactpt.testing.space.exact import contact_of
from exactpt.testing.space.families import FAMILIES, make_query
from exactpt.testing.space.queries import Kind, SpaceQuery
from exactpt.testing.truth import Truth

SECONDS: Final = 60.0
"""Time limit for shrinking one counterexample."""


def check_vertex_face(
    toi: Callable[[SpaceQuery], object],
    *,
    cases: int = 1000,
    seed: int = 0,
    families: Sequence[str] | None = None,
    tolerance: Rational = TOLERANCE,
    accept: Callable[[SpaceQuery], bool] | None = None,
) -> Report[SpaceQuery]:
    """Compare a function's times of impact of a vertex and a triangle with the exact ones.

    >>> from exactpt.testing.space import check_vertex_face
    >>> report = check_vertex_face(lambda query: None, cases=9, families=["interior"])
    >>> report.table.total["missed"], report.ok
    (9, False)

    Args:
        toi: takes a `SpaceQuery`, and returns the first time of contact in [0, 1] (a float, an
            integer, a Fraction), or None if there is none. Whatever else it returns or raises
            counts as crashed.
        cases: the number of queries, dealt to the families in turn.
        seed: the seed of the queries.
        families: names of `exactpt.testing.space.FAMILIES`; all if not given.
        tolerance: the largest error of a time that counts as none.
        accept: the domain of ``toi``, see `exactpt.testing.check`.

    Raises:
        InputError: see `exactpt.testing.check`.
    """
    return check_subject(_subject("vertex-face"), toi, cases, seed, families, tolerance, accept)


def check_edge_edge(
    toi: Callable[[SpaceQuery], object],
    *,
    cases: int = 1000,
    seed: int = 0,
    families: Sequence[str] | None = None,
    tolerance: Rational = TOLERANCE,
    accept: Callable[[SpaceQuery], bool] | None = None,
) -> Report[SpaceQuery]:
    """Compare a function's times of impact of two segments with the exact ones.

    Arguments and errors are those of `check_vertex_face`.
    """
    return check_subject(_subject("edge-edge"), toi, cases, seed, families, tolerance, accept)


def assert_same_time(query: SpaceQuery, answer: object, *, tolerance: Rational = TOLERANCE) -> None:
    """Assert that an answer is the time of the first contact of a query.

    Args:
        query: the query.
        answer: the time, or None for no contact.
        tolerance: the largest error of a time that counts as none.

    Raises:
        AssertionError: one line: missed, invented, early or late, and the exact time.
        InputError: if the answer is neither a time nor None.
    """
    __tracebackhide__ = True  # pytest shows the test, not this function
    contact = contact_of(query)
    found = verdict(None if contact is None else contact.time, answer, bound(tolerance))
    if found == "crashed":
        raise InputError(f"answer: expected a time or None, got {shorten(answer)}")
    if found != "right":
        truth = "no contact" if contact is None else f"t = {shown_time(contact.time)}"
        raise AssertionError(f"{found}: the answer is {shorten(answer)}; the truth is {truth}")


def shrink_query(
    query: SpaceQuery, fails: Callable[[SpaceQuery, Truth], bool], *, seconds: float = SECONDS
) -> SpaceQuery:
    """Return the smallest query found for which a condition still holds.

    Args:
        query: a query for which ``fails`` is true.
        fails: the condition on a query and its truth.
        seconds: time limit.
    """

    def made_of(data: dict[str, Any]) -> SpaceQuery:
        start, end = (
            tuple(
                (float(Fraction(x)), float(Fraction(y)), float(Fraction(z))) for x, y, z in data[k]
            )
            for k in ("start", "end")
        )
        return SpaceQuery(query.kind, start, end, query.name)

    def fails_as_data(data: dict[str, Any]) -> bool:
        smaller = made_of(data)
        return fails(smaller, _truth(smaller))

    data = {
        key: [[str(Fraction(c)) for c in p] for p in points]
        for key, points in (("start", query.start), ("end", query.end))
    }
    steps = (_fewer_motions, _fewer_axes, coarser_numbers, simpler_numbers)
    return made_of(shrink_data(data, fails_as_data, seconds, steps))


def _fewer_motions(data: dict[str, Any]) -> Iterator[dict[str, Any]]:
    """Yield data in which one vertex is at rest."""
    for i, point in enumerate(data["start"]):
        smaller = copy.deepcopy(data)
        smaller["end"][i] = list(point)
        yield smaller


def _fewer_axes(data: dict[str, Any]) -> Iterator[dict[str, Any]]:
    """Yield data in which one coordinate is 0 for all vertices."""
    for k in range(3):
        smaller = copy.deepcopy(data)
        for point in (*smaller["start"], *smaller["end"]):
            point[k] = "0"
        yield smaller


def _truth(query: SpaceQuery) -> Truth:
    contact = contact_of(query)
    return Truth(None) if contact is None else Truth(contact.time, query.kind)


def _subject(kind: Kind) -> Subject[SpaceQuery]:
    def make(family: str, seed: int, number: int) -> SpaceQuery:
        return make_query(kind, family, seed, number)

    return Subject(
        families=tuple(FAMILIES),
        make=make,
        truths=lambda queries: [_truth(query) for query in queries],
        shrink=shrink_query,
        imports="from exactpt.testing.space import SpaceQuery, assert_same_time",
        assertion="assert_same_time(question, toi(question), tolerance={tolerance!r})",
    )
