"""What an engine takes: questions that its documentation is about, and their form.

A question is asked from time 0 on. Of a body there is ``{"vertices", "closed", "x", "y"}``, where x
and y are polynomials in time that are added, the constant (0) first and the velocity next. The
vertices of a polygon are counter-clockwise.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from fractions import Fraction
from typing import Any, Final

from exactpt import InputError, Polynomial
from exactpt.geometry.predicates import orientation
from exactpt.kernel.numbers import QQ, rational
from exactpt.testing import Moving, Question, Truth

__all__ = ["as_asked", "from_zero", "kind_of", "why_not"]

_NAMES: Final = {
    "point": "a point",
    "segment": "a segment",
    "chain": "an open chain",
    "convex": "a convex polygon",
    "simple": "a polygon that is not strictly convex",
}


def from_zero(question: Question) -> Question | None:
    """The same question with a time span from 0 on and bodies where they are at that time.

    None if one of its numbers would not be a double.
    """
    start, end = map(rational, question.time)
    try:
        a, b = (_from_zero(body, start) for body in (question.a, question.b))
        return replace(question, a=a, b=b, time=(0.0, _double(end - start)))
    except InputError:
        return None


def _from_zero(body: Moving, start: QQ) -> Moving:
    paths, place = [], []
    for coefficients in (body.x, body.y):
        f = Polynomial(coefficients)(Polynomial([start, 1]))
        shifted = [rational(c) for c in f.coefficients]
        place.append(shifted[0] if shifted else QQ(0))
        paths.append((0.0, *map(_double, shifted[1:])))
    vertices = tuple(
        (_double(rational(x) + place[0]), _double(rational(y) + place[1])) for x, y in body.vertices
    )
    return Moving(vertices, paths[0], paths[1], body.closed)


def _double(value: QQ) -> float:
    near = float(value)
    if rational(near) != value:
        raise InputError("not a double")
    return near


def as_asked(question: Question) -> dict[str, object]:
    """The question as an adapter gets it."""
    return {
        "span": question.time[1],
        **{key: _body(body) for key, body in (("a", question.a), ("b", question.b))},
    }


def _body(body: Moving) -> dict[str, object]:
    path = {axis: [*f, *[0.0] * (2 - len(f))] for axis, f in (("x", body.x), ("y", body.y))}
    vertices = body.vertices[::-1] if _is_clockwise(body) else body.vertices
    return {"vertices": [list(v) for v in vertices], "closed": body.closed, **path}


def _is_clockwise(body: Moving) -> bool:
    if not body.closed or len(body.vertices) < 3:
        return False
    points = [(rational(x), rational(y)) for x, y in body.vertices]
    return sum(p[0] * q[1] - p[1] * q[0] for p, q in zip(points, points[1:] + points[:1],
                                                          strict=True)) < 0  # fmt: skip


def kind_of(body: Moving) -> str:
    """One of "point", "segment", "chain", "convex" (strictly) and "simple"."""
    n = len(body.vertices)
    if n < 3:
        return ("point", "segment")[n - 1]
    if not body.closed:
        return "chain"
    points = [(rational(x), rational(y)) for x, y in body.vertices]
    turns = [orientation(points[i - 2], points[i - 1], points[i]) for i in range(n)]
    same = min(turns) > 0 or max(turns) < 0
    return "convex" if same and n == len(set(points)) else "simple"


def why_not(takes: Mapping[str, Any], question: Question, truth: Truth) -> str | None:
    """Return the reason why an engine does not get a question; None if it does.

    Args:
        takes: "shapes" (see `kind_of`); "motion": "linear" or "polynomial"; if there are limits,
            "vertices": the most of a body, "digits": of its numbers in binary, "least" and
            "most": of the width or height of a body, whichever is smaller or larger, "start":
            "apart" if the bodies may not touch at the start.
        question: the question, from time 0 on.
        truth: its truth.
    """
    bodies = question.a, question.b
    for body in bodies:
        if kind_of(body) not in takes["shapes"]:
            return _NAMES[kind_of(body)]
        if len(body.vertices) > takes.get("vertices", len(body.vertices)):
            return "too many vertices"
        if takes["motion"] == "linear" and any(map(any, (body.x[2:], body.y[2:]))):
            return "not a linear motion"
        sizes = [max(c) - min(c) for c in zip(*body.vertices, strict=True)]
        if max(sizes) > takes.get("most", max(sizes)):
            return "a large body"
        if len(body.vertices) > 2 and min(sizes) < takes.get("least", 0.0):
            return "a small body"
    if takes.get("start") == "apart" and truth.kind == "initial":
        return "in contact at the start"
    if "digits" in takes and not all(_short(body, question.time[1], takes["digits"])
                                     for body in bodies):  # fmt: skip
        return "numbers of too many digits"
    return None


def _short(body: Moving, span: float, digits: int) -> bool:
    """Return True if all coordinates at both ends have at most these binary digits."""
    for k, path in enumerate((body.x, body.y)):
        way = Fraction(path[1] if len(path) > 1 else 0.0) * Fraction(span)
        for vertex in body.vertices:
            at = Fraction(vertex[k])
            if any(_digits(c) > digits for c in (at, way, at + way)):
                return False
    return True


def _digits(value: Fraction) -> int:
    """The number of binary digits from the first to the last one that is not 0."""
    n = abs(value.numerator)
    return (n // (n & -n)).bit_length() if n else 0
