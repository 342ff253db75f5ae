"""Distances by CGAL's algebraic kernel: signs at a time, isolated roots, the order of values."""

from __future__ import annotations

from collections.abc import Iterator
from functools import cache
from typing import final

from exactpt import AlgebraicNumber, Body, Clearance, Scene
from exactpt.cgal import CgalCheck
from exactpt.kernel.algebraic_value import quotient_at
from exactpt.kernel.integer_polynomial import IntPoly, derivative, multiply, subtract
from exactpt.kernel.numbers import QQ, ZZ
from exactpt.kernel.roots import roots_after
from exactpt.search.clearance import ClearancePiece
from exactpt.testing.reference.times import tracks_after
from exactpt.testing.reference.within import is_within

__all__ = ["DifferError", "are_within", "compare", "witness"]


class DifferError(Exception):
    """CGAL decides otherwise than exactpt."""


def compare(
    scene: Scene, gap: Clearance, squared: QQ, time: AlgebraicNumber | None
) -> tuple[int, str | None]:
    """How much CGAL has decided about a first approach and a minimum, and what differs."""
    judge = _Judge(witness())
    try:
        judge.approach(scene, gap, squared, time)
        judge.minimum(gap)
    except DifferError as difference:
        return judge.decided, str(difference)
    return judge.decided, None


def are_within(a: Body, b: Body, squared: QQ, time: AlgebraicNumber, start: QQ) -> bool:
    """Return True if two bodies are within a distance at a time, by signs that CGAL decides.

    Args:
        a: a body.
        b: another one.
        squared: the square of the distance of their cores.
        time: the time, which may be irrational.
        start: the start of the scene.

    Raises:
        DifferError: if CGAL does not find that the time is the only root of its polynomial in its
            interval, or a sign at it is another one by CGAL.
    """
    judge = _Judge(witness())
    judge.root(time)
    return judge.are_within(a, b, squared, time, start)


@cache
def witness() -> CgalCheck:
    """Return the running cgal_check of this process, which the first request starts."""
    return CgalCheck()


@final
class _Instant:
    """A time at which CGAL decides every sign."""

    def __init__(self, judge: _Judge, time: AlgebraicNumber) -> None:
        self._judge = judge
        self._time = time

    def sign_of(self, f: IntPoly, /) -> int:
        return self._judge.sign(f, self._time)


@final
class _Judge:
    """CGAL's opinion of our numbers.

    Attributes:
        decided: number of decisions so far.
    """

    def __init__(self, program: CgalCheck) -> None:
        self._program = program
        self.decided = 0

    def sign(self, f: IntPoly, time: AlgebraicNumber) -> int:
        """The sign at a time, if it is ours too."""
        self.decided += 1
        found = self._program.sign_at_root(list(map(int, f)), time).at
        if found != time.sign_of(f):
            raise DifferError(f"the sign of {f} at {time!r} is {found}")
        return found

    def root(self, number: AlgebraicNumber) -> None:
        """A number is the only root of its polynomial in its interval."""
        self.decided += 1
        verdict = self._program.check_root(number.polynomial, number.low, number.high)
        if not verdict.ok:
            raise DifferError(f"{number!r}: {verdict.reason}")

    def approach(
        self, scene: Scene, gap: Clearance, squared: QQ, time: AlgebraicNumber | None
    ) -> None:
        """The bodies are within the distance at the time; if at none, not when they are nearest."""
        at = gap.minimum.time if time is None else time
        self.root(at)
        a, b = scene.bodies
        if self.are_within(a, b, squared, at, scene.exact_start) != (time is not None):
            raise DifferError(f"within {squared} at {at!r}: not so by CGAL")

    def are_within(self, a: Body, b: Body, squared: QQ, time: AlgebraicNumber, start: QQ) -> bool:
        """Return True if two bodies are within a distance at a time."""
        since = max(body.exact_last_breakpoint(time, start, before=True) for body in (a, b))
        p, q = tracks_after(a, b, since)
        return is_within(_Instant(self, time), a, b, p, q, squared)

    def minimum(self, gap: Clearance) -> None:
        """The least value is that of its time, and no other candidate's is less."""
        time, least = gap.minimum
        self.root(time)
        self.root(least)
        for piece in gap.pieces:
            n, d = _polynomials(piece)
            if piece.start <= time <= piece.end and time.sign_of(d):
                low, high = least.low, least.high
                above = subtract(_times(n, low.denominator), _times(d, low.numerator))
                below = subtract(_times(n, high.denominator), _times(d, high.numerator))
                if self.sign(above, time) < 0 or self.sign(below, time) > 0:
                    raise DifferError(f"the distance at {time!r} is not {least!r}")
            for t in _candidates(piece):
                self.decided += 1
                if self._program.compare_roots(least, quotient_at(n, d, t)) > 0:
                    raise DifferError(f"the distance at {t!r} is less than {least!r}")


def _polynomials(piece: ClearancePiece) -> tuple[IntPoly, IntPoly]:
    return tuple(map(ZZ, piece.numerator)), tuple(map(ZZ, piece.denominator))


def _times(f: IntPoly, factor: int) -> IntPoly:
    return multiply(f, (ZZ(factor),)) if factor else ()


def _candidates(piece: ClearancePiece) -> Iterator[AlgebraicNumber]:
    """The ends of a piece, and the times in it at which the distance has no slope."""
    yield piece.start
    yield piece.end
    n, d = _polynomials(piece)
    slope = subtract(multiply(derivative(n), d), multiply(n, derivative(d)))
    for root in roots_after(slope, piece.start, piece.end.exact_high) if slope else ():
        if root.time < piece.end:
            yield root.time
