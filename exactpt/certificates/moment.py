"""Exact times of events, also after the vertices have been given other motions."""

from __future__ import annotations

from typing import TYPE_CHECKING, TypeAlias, final

from mypy_extensions import mypyc_attr

from exactpt.certificates.queue import EventTime
from exactpt.errors import AuditError
from exactpt.kernel.algebraic import AlgebraicNumber, linear_root
from exactpt.kernel.integer_polynomial import IntPoly, sign_at, square_free
from exactpt.motion.track import difference, orientation_polynomial

if TYPE_CHECKING:
    from exactpt.motion.course import Piece
    from exactpt.motion.normalization import Normalization
    from exactpt.motion.vertex import Stage

Numbered: TypeAlias = "tuple[Piece, int]"
"""A vertex: the piece of motion of its body, and its number in the scene."""


@final
@mypyc_attr(acyclic=True)
class Moment:
    """The time of an event, a number on demand.

    It keeps the pieces of motion of the event, so it is the same time whatever motions the
    vertices have by that time, and whichever vertices have their ids.

    Args:
        time: the time.
        vertices: those whose function vanishes then: the stage of the body, and the number in the
            scene. None are needed if the exact time is known.
        normalization: that of the enclosure.
    """

    def __init__(
        self, time: EventTime, vertices: tuple[tuple[Stage, int], ...], normalization: Normalization
    ) -> None:
        self._time: EventTime = time
        self._vertices: tuple[tuple[Stage, int], ...] = vertices
        self._normalization: Normalization = normalization

    @property
    def number(self) -> AlgebraicNumber:
        """The exact time."""
        exact = self._time.exact
        if exact is None:
            vertices = tuple([(stage.piece, vertex) for stage, vertex in self._vertices])
            exact = exact_time(self._time, vertices, self._normalization)
        return exact


def exact_time(
    time: EventTime, vertices: tuple[Numbered, ...], normalization: Normalization
) -> AlgebraicNumber:
    """Compute ``time.exact``, and narrow the enclosure as far as doubles allow.

    Args:
        time: a root, alone in its enclosure, of the function of ``vertices``. A filter has found
            it, so the function is not identically zero.
        vertices: three for their orientation, two for their x-order.
        normalization: that of the enclosure.

    Raises:
        AuditError: if the enclosure holds no single root of the function.
    """
    number = _crossing(*vertices) if len(vertices) == 2 else None
    if number is None:
        tracks = [piece.track(vertex) for piece, vertex in vertices]
        if len(tracks) == 3:
            f = orientation_polynomial(tracks[0], tracks[1], tracks[2])
        else:
            f = difference(tracks[0].x, tracks[0].w, tracks[1].x, tracks[1].w)
        number = linear_root(f) or _isolated(f, time, normalization)
    time.exact = number
    time.low, time.high = normalization.enclosure(number)
    return number


def _crossing(a: Numbered, b: Numbered) -> AlgebraicNumber | None:
    """Return the time at which two vertices have one x, if `Piece.straight_x` knows both.

    None if they have the same velocity: in a state that was forged.
    """
    of_a, of_b = a[0].straight_x(a[1]), b[0].straight_x(b[1])
    if of_a is None or of_b is None or of_a[1] == of_b[1]:
        return None
    return AlgebraicNumber((of_a[0] - of_b[0]) / (of_b[1] - of_a[1]))


def _isolated(f: IntPoly, time: EventTime, normalization: Normalization) -> AlgebraicNumber:
    """Return the root of a polynomial in the enclosure of a time.

    Raises:
        AuditError: if it does not change its sign there. Refinement would not end.
    """
    low, high = normalization.exact_time(time.low), normalization.exact_time(time.high)
    p = square_free(f)
    below = sign_at(p, low)
    if below == 0:
        return AlgebraicNumber(low)
    if sign_at(p, high) == below:
        raise AuditError(f"no failure between t = {float(low)!r} and {float(high)!r}")
    return AlgebraicNumber.exact_root(p, low, high)
