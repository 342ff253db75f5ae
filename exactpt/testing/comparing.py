"""An answer and the truth: right, missed, invented, early, late, crashed, or a wrong witness."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Final, TypeAlias

from exactpt.errors import InputError
from exactpt.kernel.algebraic import AlgebraicNumber
from exactpt.kernel.numbers import QQ, Rational, rational, shorten, show
from exactpt.pair.contact import Contact
from exactpt.scene.scene import Scene
from exactpt.search.first import first_contact

VERDICTS: Final = ("right", "missed", "invented", "early", "late", "crashed")
"""What an answer can be."""

TOLERANCE: Final = 1e-9
"""Largest error of a time that counts as none, unless another is given."""

Answer: TypeAlias = "Rational | AlgebraicNumber | Mapping[str, object] | Contact | None"
"""A time, or None for no contact; a contact, or one as JSON (docs/format.md), has witnesses too."""


def bound(tolerance: Rational) -> QQ:
    """Return a tolerance as a rational.

    Raises:
        InputError: if it is negative, or no number.
    """
    exact = rational(tolerance)
    if exact < 0:
        raise InputError(f"a tolerance is not negative: {show(exact)}")
    return exact


def verdict(time: AlgebraicNumber | None, answer: object, tolerance: QQ) -> str:
    """Return one of `VERDICTS` about a time, or None for no contact; "crashed" if it is neither."""
    if answer is None:
        return "right" if time is None else "missed"
    try:
        t = rational(answer)  # type: ignore[arg-type]  # whatever it is
    except InputError:
        return "crashed"
    if time is None:
        return "invented"
    if time.compare_rational(t + tolerance) > 0:
        return "early"
    return "late" if time.compare_rational(t - tolerance) < 0 else "right"


def assert_same_contact(scene: Scene, answer: Answer, *, tolerance: Rational = TOLERANCE) -> None:
    """Assert that an answer is the first contact of a scene.

    Args:
        scene: the scene.
        answer: None for no contact, or the time. Or a contact, also as JSON (docs/format.md):
            then each of its pairs has to be an incidence of the true contact; "point" and
            "normal" are not compared.
        tolerance: the largest error of the time that still counts as right.

    Raises:
        AssertionError: one line: missed, invented, early, late, or the wrong witness, and the
            exact truth.
        InputError: if the answer is none of these.
    """
    __tracebackhide__ = True  # pytest shows the test, not this function
    data = answer.to_json() if isinstance(answer, Contact) else answer
    given: object = data
    pairs: object = ()
    if isinstance(data, Mapping):
        given, pairs = data.get("time"), data.get("pairs", ())
        given = given.get("approx") if isinstance(given, Mapping) else given
    elif isinstance(data, AlgebraicNumber):
        given = data if data.is_rational else float(data)
    if not isinstance(pairs, Sequence) or not all(isinstance(p, Mapping) for p in pairs):
        raise InputError(f"not pairs of features: {shorten(pairs)}")
    truth = first_contact(scene)
    fault = verdict(None if truth is None else truth.time, given, bound(tolerance))
    if fault == "crashed":
        raise InputError(f"not a time: {shorten(given)}")
    if fault != "right":
        said = "no contact" if given is None else f"a contact at t = {given}"
        raise AssertionError(f"{fault}: the answer is {said}; the truth is {_shown(truth)}")
    if truth is not None:
        known = [_features(pair.to_json()) for pair in truth.pairs]
        for pair in pairs:
            if _features(pair) not in known:
                raise AssertionError(
                    f"wrong witness: {_touch(pair)} do not touch at t; the truth is {_shown(truth)}"
                )


def shown_time(time: AlgebraicNumber) -> str:
    """Return an exact time in words."""
    if time.is_rational:
        return str(time.exact_low)
    return f"{float(time)!r}, a root of {list(time.polynomial)}"


def _shown(truth: Contact | None) -> str:
    if truth is None:
        return "no contact"
    where = [_touch(pair.to_json()) for pair in truth.pairs[:3]]
    more = [f"{len(truth.pairs) - 3} more"] if len(truth.pairs) > 3 else []
    time = f"a contact at t = {shown_time(truth.time)} ({truth.kind})"
    return f"{time}: {', '.join(where + more)}" if where else time


def _features(pair: Mapping[str, object]) -> frozenset[tuple[object, ...]]:
    """Return the two features of an incidence, in no order."""
    return frozenset(_feature(pair.get(side)) for side in ("a", "b"))


def _feature(side: object) -> tuple[object, ...]:
    if not isinstance(side, Mapping):
        return ("?", None, None)
    what = "vertex" if side.get("edge") is None else "edge"
    return str(side.get("body")), what, side.get(what)


def _touch(pair: Mapping[str, object]) -> str:
    names = [_feature(pair.get(side)) for side in ("a", "b")]
    return " and ".join(f"{what} {number} of {body}" for body, what, number in names)
