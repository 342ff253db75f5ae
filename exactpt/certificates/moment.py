"""Exact times of events, also after the vertices have been given other motions."""

from __future__ import annotations

from typing import TYPE_CHECKING, final

from exactpt.certificates.queue import EventTime
from exactpt.kernel.algebraic import AlgebraicNumber, linear_root
from exactpt.kernel.integer_polynomial import IntPoly, sign_at, square_free
from exactpt.motion.incidence import difference, orientation

if TYPE_CHECKING:
    from exactpt.motion.course import Piece
    from exactpt.motion.frame import Frame
    from exactpt.motion.track import Track

__all__ = ["Moment", "exact_time"]


@final
class Moment:
    """The time of an event, a number on demand.

    It keeps the pieces of motion of the event, so it is the same time whatever motions the
    vertices have by then, and whichever vertices have their ids.

    Args:
        time: the time.
        vertices: those whose function vanishes then, as in `exact_time`: for each the piece of
            its body and its number in the scene. None are needed if the exact time is known.
        frame: the normalisation of the enclosure.
    """

    def __init__(
        self, time: EventTime, vertices: tuple[tuple[Piece, int], ...], frame: Frame
    ) -> None:
        self._time: EventTime = time
        self._vertices: tuple[tuple[Piece, int], ...] = vertices
        self._frame: Frame = frame

    @property
    def number(self) -> AlgebraicNumber:
        """The exact time."""
        if self._time.exact is not None:
            return self._time.exact
        tracks = tuple([piece.track(vertex) for piece, vertex in self._vertices])
        return exact_time(self._time, tracks, self._frame)


def exact_time(time: EventTime, tracks: tuple[Track, ...], frame: Frame) -> AlgebraicNumber:
    """Compute ``time.exact``, and narrow the enclosure as far as doubles allow.

    Args:
        time: a root, alone in its enclosure, of the function of ``tracks``. A filter has found
            it, so the function is not zero for ever.
        tracks: three for their orientation, two for their x-order.
        frame: the normalisation of the enclosure.
    """
    if len(tracks) == 3:
        f = orientation(tracks[0], tracks[1], tracks[2])
    else:
        f = difference(tracks[0].x, tracks[0].w, tracks[1].x, tracks[1].w)
    number = linear_root(f)
    if number is None:
        number = _isolated(f, time, frame)
    time.exact = number
    time.low, time.high = frame.enclosure(number)
    return number


def _isolated(f: IntPoly, time: EventTime, frame: Frame) -> AlgebraicNumber:
    """The root of a polynomial in the enclosure of a time."""
    low, high = frame.exact_time(time.low), frame.exact_time(time.high)
    p = square_free(f)
    if sign_at(p, low) == 0:
        return AlgebraicNumber(low)
    return AlgebraicNumber._root(p, low, high)
