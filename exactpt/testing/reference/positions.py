"""Where the vertices of a body are, by the formulas of docs/format.md.

They are read straight from the JSON of a scene, in fractions: no module of the package takes part.
"""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction
from typing import Any, TypeAlias

__all__ = ["body_at", "motion_at"]

Json: TypeAlias = dict[str, Any]
"""A body or a motion of a scene file; its numbers are exact texts or integers."""

Point: TypeAlias = tuple[Fraction, Fraction]


def motion_at(motion: Json | None, x: Fraction, y: Fraction, t: Fraction) -> Point:
    """Return where a motion carries a point.

    >>> motion_at({"x": [0, "1/2"], "y": []}, Fraction(1), Fraction(0), Fraction(4))
    (Fraction(3, 1), Fraction(0, 1))

    Args:
        motion: a motion of the format; None for rest. It has no `spin` and no `path`.
        x: the first coordinate of the point.
        y: the second one.
        t: the time.
    """
    if motion is None:
        return x, y
    if "pieces" in motion:
        for piece in motion["pieces"]:
            if "until" not in piece or t <= Fraction(str(piece["until"])):
                return motion_at(piece["motion"], x, y, t)
    if "rigid" in motion:
        rigid = motion["rigid"]
        px, py = (Fraction(str(c)) for c in rigid.get("pivot", ["0", "0"]))
        h = _at(rigid["half_turn"], t)
        cosine, sine = (1 - h * h) / (1 + h * h), 2 * h / (1 + h * h)
        c, s = (Fraction(str(part)) for part in rigid.get("orientation", ["1", "0"]))
        dx, dy = c * (x - px) - s * (y - py), s * (x - px) + c * (y - py)
        return (
            px + cosine * dx - sine * dy + _at(rigid.get("x", []), t),
            py + sine * dx + cosine * dy + _at(rigid.get("y", []), t),
        )
    if "affine" in motion:
        affine = motion["affine"]
        (a, b), (c, d) = affine["matrix"]
        return (
            _at(a, t) * x + _at(b, t) * y + _at(affine.get("x", []), t),
            _at(c, t) * x + _at(d, t) * y + _at(affine.get("y", []), t),
        )
    return x + _at(motion.get("x", []), t), y + _at(motion.get("y", []), t)


def _at(coefficients: Sequence[Any], t: Fraction) -> Fraction:
    return sum((Fraction(str(c)) * t**i for i, c in enumerate(coefficients)), Fraction(0))


def body_at(body: Json, t: Fraction) -> list[Point]:
    """Return the vertices of a body at a time.

    >>> body_at({"vertices": [{"x": [0, 1], "y": [5]}]}, Fraction(2))
    [(Fraction(2, 1), Fraction(5, 1))]

    Args:
        body: a body of the format without holes and parts, see `motion_at`.
        t: the time.
    """
    return [motion_at(body.get("motion"), x, y, t) for x, y in _shape_at(body, t)]


def _shape_at(body: Json, t: Fraction) -> list[Point]:
    if "keyframes" in body:
        frames = [
            (
                Fraction(str(f["t"])),
                [(Fraction(str(x)), Fraction(str(y))) for x, y in f["vertices"]],
            )
            for f in body["keyframes"]
        ]
        before = [f for f in frames if f[0] <= t]
        after = [f for f in frames if f[0] > t]
        if not before:
            return after[0][1]
        if not after:
            return before[-1][1]
        (t0, p), (t1, q) = before[-1], after[0]
        s = (t - t0) / (t1 - t0)
        return [
            ((1 - s) * a + s * c, (1 - s) * b + s * d) for (a, b), (c, d) in zip(p, q, strict=True)
        ]
    return [
        (_at(v.get("x", []), t), _at(v.get("y", []), t))
        if isinstance(v, dict)
        else (Fraction(str(v[0])), Fraction(str(v[1])))
        for v in body["vertices"]
    ]
