"""Test if a deforming polygon stays convex: its interior needs no tiling in that case."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

from exactpt.kernel.algebraic import AlgebraicNumber
from exactpt.kernel.budget import check_budget
from exactpt.kernel.numbers import QQ
from exactpt.kernel.roots import roots_after
from exactpt.motion.track import orientation_polynomial

if TYPE_CHECKING:
    from exactpt.motion.body import Body


def stays_convex(body: Body, ring: Sequence[int], start: QQ, end: QQ) -> bool:
    """Return True if a polygon turns strictly left at every vertex throughout (start, end].

    A simple polygon that turns left at every vertex at the start, and goes on doing so,
    keeps its turning number 1: it stays convex, and no two of its vertices ever coincide.

    Args:
        body: the polygon.
        ring: the indices of its vertices, counter-clockwise at the start.
        start: the first time, just after which it must be simple.
        end: the last time.
    """
    triples = list(zip(ring, [*ring[1:], ring[0]], [*ring[2:], *ring[:2]], strict=True))
    time = start
    while True:
        piece = body.exact_piece_after(time)
        until = end if piece.until is None else min(piece.until, end)
        now = AlgebraicNumber(time)
        for a, b, c in triples:
            check_budget()
            f = orientation_polynomial(*(piece.track(i) for i in (a, b, c)))
            if not f or now.sign_after(f) < 0 or any(roots_after(f, now, until)):
                return False
        if until == end:
            return True
        time = until
