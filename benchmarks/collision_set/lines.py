"""Passages as lines: questions and answers in JSON, and the queries of CCD benchmarks."""

from __future__ import annotations

import json

from benchmarks.collision_set.answers import coordinates
from benchmarks.collision_set.passages import Passage
from exactpt.testing.truth import Truth


def question_line(name: str, passage: Passage) -> str:
    """The question as `exactpt oracle` reads it: a point "a" and a segment "b"."""
    numbers = coordinates(passage)
    px, py, ax, ay, bx, by = zip(numbers[:6], numbers[6:], strict=True)
    point = {"vertices": [[px[0], py[0]]], "motion": {"x": [0.0, px[1]], "y": [0.0, py[1]]}}
    segment = {"vertices": [{"x": ax, "y": ay}, {"x": bx, "y": by}]}
    return json.dumps({"id": name, "time": [0.0, 1.0], "a": point, "b": segment}) + "\n"


def truth_line(name: str, truth: Truth) -> str:
    """The answer as `exactpt oracle` writes it."""
    return json.dumps({"id": name, **truth.to_json()}) + "\n"


def ccd_query(passage: Passage, *, touches: bool) -> str:
    """Eight lines "x, y, z, result" of an edge-edge query, each number as numerator, denominator.

    The ends of the first edge and of the second one at the time 0, then at the time 1. The first
    one is the vertical segment between z = -1 and z = 1 at the point, the second one is the
    segment, at z = 0: they touch if and only if the point is on the segment. Between the two times
    every end moves straight.
    """
    rows = []
    for p, a, b in (passage.start, passage.end):
        rows += [_row(at, z, passage.bits) for at, z in ((p, -1), (p, 1), (a, 0), (b, 0))]
    return "".join(f"{row},{int(touches)}\n" for row in rows)


def _row(at: tuple[int, int], z: int, bits: int) -> str:
    return f"{_ratio(at[0], bits)},{_ratio(at[1], bits)},{z},1"


def _ratio(units: int, bits: int) -> str:
    """A number of units of 2^-bits as a numerator and a denominator without a common factor."""
    shared = min(bits, (units & -units).bit_length() - 1) if units else bits
    return f"{units >> shared},{1 << (bits - shared)}"
