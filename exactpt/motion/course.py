"""The course of a body: the trajectories of its vertices, piece by piece."""

from __future__ import annotations

import math
from bisect import bisect_left, bisect_right
from collections.abc import Sequence
from itertools import pairwise
from typing import NamedTuple, final

from exactpt.errors import InputError
from exactpt.filters.rounding import TINY, U
from exactpt.geometry.simple import orientation_of_doubles
from exactpt.kernel.budget import check_budget
from exactpt.kernel.numbers import QQ, nearest_float, of_double, show
from exactpt.motion.motions import (
    Motion,
    Pieces,
    Piecewise,
    Position,
    Rigid,
    SimpleMotion,
    Translation,
)
from exactpt.motion.shape import Places, Shape
from exactpt.motion.track import Track


class NearPositions(NamedTuple):
    """Positions of vertices in doubles.

    Attributes:
        xs, ys: the coordinates.
        error: no coordinate is off by more; infinite or a NaN if one is out of range.
    """

    xs: list[float]
    ys: list[float]
    error: float


@final
class Piece:
    """The motion of a body up to a time, by one formula.

    Args:
        shape: the shape of the body.
        since: a time of the piece, for the shape.
        motion: the formula.
        until: the last time of the piece; None if it has no end.

    Attributes:
        motion, until: as given.
    """

    __slots__ = ("_made", "_shape", "_since", "_tracks", "motion", "until")

    def __init__(self, shape: Shape, since: QQ, motion: SimpleMotion, until: QQ | None) -> None:
        self.motion = motion
        self.until = until
        self._shape = shape
        self._since = since
        self._made: dict[int, Track] = {}
        self._tracks: tuple[Track, ...] | None = None

    def track(self, vertex: int) -> Track:
        """Return the trajectory of a vertex, numbered as in the scene; made on first access."""
        made = self._made.get(vertex)
        if made is None:
            check_budget()
            position = self._shape.after(self._since)[vertex]
            made = self._made.setdefault(vertex, self.motion.track(position))
        return made

    @property
    def tracks(self) -> tuple[Track, ...]:
        """The trajectory of each vertex, in the order of the scene."""
        if self._tracks is None:
            self._tracks = tuple(map(self.track, range(self._shape.size)))
        return self._tracks

    @property
    def translation(self) -> tuple[Places, Translation] | None:
        """The rest positions in doubles, and their common translation.

        None if they are not constant, or out of range, or the motion is not a translation.
        """
        if not isinstance(self.motion, Translation):
            return None
        places = self._shape.near
        return None if places is None else (places, self.motion)

    def position(self, vertex: int, t: QQ) -> tuple[QQ, QQ]:
        """Return the position of a vertex at a rational time of the piece."""
        moved = self.translation
        if moved is None or not moved[0].is_exact:
            return self.track(vertex).exact_at(t)
        places, translation = moved
        dx, dy = translation.exact_at(t)
        return of_double(places.xs[vertex]) + dx, of_double(places.ys[vertex]) + dy

    def positions(self, t: QQ) -> list[tuple[QQ, QQ]]:
        """Return the positions of all vertices at a rational time of the piece."""
        moved = self.translation
        if moved is None or not moved[0].is_exact:
            return [track.exact_at(t) for track in self.tracks]
        (xs, ys, _), translation = moved
        dx, dy = translation.exact_at(t)
        return [(of_double(x) + dx, of_double(y) + dy) for x, y in zip(xs, ys, strict=True)]

    def near_positions(self, t: QQ, origin: tuple[QQ, QQ]) -> NearPositions:
        """Return the positions at a rational time of the piece in doubles, relative to an origin.

        Vertices that are translated or turned are where the first one is, plus their turned
        difference from it. With D the largest size of a coordinate of these differences, and B of
        the first position, both relative: a difference is rounded once, the cosine or the sine too,
        then a product and two sums, each of which is of a size below 2 D + B. So a coordinate is
        off by less than 5 U (2 D) + 2 U (2 D + B) < 16 U (D + B).
        """
        x0, y0 = self.position(0, t)
        base_x, base_y = nearest_float(x0 - origin[0]), nearest_float(y0 - origin[1])
        apart = self._shape.near_differences
        if apart is None or not isinstance(self.motion, (Translation, Rigid)):
            exact = [self.position(v, t) for v in range(self._shape.size)]
            xs = [nearest_float(x - origin[0]) for x, _ in exact]
            ys = [nearest_float(y - origin[1]) for _, y in exact]
            return NearPositions(xs, ys, 2.0 * U * _largest(xs, ys) + TINY)
        dxs, dys = apart
        error = 16.0 * U * (_largest(dxs, dys) + max(abs(base_x), abs(base_y))) + TINY
        if isinstance(self.motion, Translation):
            return NearPositions([base_x + x for x in dxs], [base_y + y for y in dys], error)
        cosine, sine = map(nearest_float, self.motion.exact_map_at(t)[:2])
        both = list(zip(dxs, dys, strict=True))
        xs = [base_x + (cosine * x - sine * y) for x, y in both]
        ys = [base_y + (sine * x + cosine * y) for x, y in both]
        return NearPositions(xs, ys, error)

    def turns_left(self, ring: range, t: QQ) -> bool:
        """Return True if a ring of a body with interior is counter-clockwise at a rational time."""
        moved = self.translation
        if moved is not None:
            xs, ys, is_exact = moved[0]
            some = slice(ring.start, ring.stop)
            turn = orientation_of_doubles(xs[some], ys[some], is_exact=is_exact)
            if turn:
                return turn > 0
        from exactpt.geometry.polygon import is_counter_clockwise

        return is_counter_clockwise([self.position(v, t) for v in ring])

    def straight_x(self, vertex: int) -> tuple[QQ, QQ] | None:
        """Return the coefficients of x = x0 + x1 t of a vertex, without its trajectory.

        None if the motion is not a linear translation of positions that doubles hold.
        """
        moved = self.translation
        if moved is None or not moved[0].is_exact:
            return None
        places, translation = moved
        path = translation.x.exact_coefficients
        if len(path) > 2:
            return None
        x = of_double(places.xs[vertex])
        return (x + path[0] if path else x), (path[1] if len(path) == 2 else QQ(0))

    def corners(self, t: QQ) -> list[tuple[QQ, QQ]]:
        """Return points with the bounding box of the body at a rational time, but for rounding."""
        moved = self.translation
        if moved is None:
            return self.positions(t)
        (xs, ys, _), translation = moved
        dx, dy = translation.exact_at(t)
        return [(of_double(of(xs)) + dx, of_double(of(ys)) + dy) for of in (min, max)]


@final
class Course:
    """A shape under a motion; each piece is computed on demand.

    Attributes:
        motion: the motion.

    Raises:
        InputError: if a vertex jumps.
    """

    __slots__ = ("_frames", "_last", "_pieces", "_shape", "motion")

    def __init__(self, shape: Shape, motion: Motion) -> None:
        self.motion = motion
        self._shape = shape
        self._pieces: dict[QQ | None, Piece] = {}
        self._last: tuple[QQ, list[tuple[QQ, QQ]]] | None = None
        self._frames: tuple[QQ, ...] = tuple([frame.t for frame in shape.keyframes])
        if isinstance(motion, Pieces):
            self._check_continuity(motion)

    def breakpoints_between(self, start: QQ, end: QQ) -> tuple[QQ, ...]:
        """Return the times at which the formulas of the trajectories change, in order.

        They are between two times, not at them.

        Raises:
            InputError: if there are too many.
        """
        frames = self._frames[bisect_right(self._frames, start) : bisect_left(self._frames, end)]
        motion = self.motion
        if not isinstance(motion, Piecewise):
            return frames
        ends = motion.exact_breakpoints_between(start, end)
        return tuple(sorted({*frames, *ends})) if frames else tuple(ends)

    @property
    def breakpoints(self) -> tuple[QQ, ...]:
        """The times at which the formulas of the trajectories change, in order.

        Raises:
            InputError: if there is no end of them.
        """
        motion = self.motion
        if not isinstance(motion, Piecewise):
            return self._frames
        return tuple(sorted({*self._frames, *motion.exact_breakpoints}))

    def last_breakpoint_before(self, t: QQ) -> QQ | None:
        """Return the last time before another one at which formulas change; None if never."""
        ended = bisect_left(self._frames, t)
        frame = self._frames[ended - 1] if ended else None
        motion = self.motion
        if not isinstance(motion, Piecewise):
            return frame
        end = motion.exact_last_breakpoint_before(t)
        if frame is None or end is None:
            return end if frame is None else frame
        return max(frame, end)

    def is_breakpoint(self, t: QQ) -> bool:
        """Return True if the formulas of the trajectories change at a time."""
        motion = self.motion
        return t in self._frames or (
            isinstance(motion, Piecewise) and motion.exact_is_breakpoint(t)
        )

    def after(self, t: QQ) -> Piece:
        """Return the piece just after a rational time."""
        ended = bisect_right(self._frames, t)
        end = self._frames[ended] if ended < len(self._frames) else None
        motion = self.motion
        if isinstance(motion, Piecewise):
            motion, until = motion.exact_formula_after(t)
            if end is None or (until is not None and until < end):
                end = until
        if end not in self._pieces:
            self._pieces[end] = Piece(self._shape, t, motion, end)
        return self._pieces[end]

    def at(self, t: QQ) -> list[tuple[QQ, QQ]]:
        """Return the positions at a time; those at the last requested time are cached."""
        last = self._last  # one read: other threads may share the body
        if last is None or last[0] != t:
            self._last = last = t, self.after(t).positions(t)
        return last[1][:]

    def place(self, vertex: int, t: QQ) -> tuple[QQ, QQ]:
        """Return the position of a vertex at a time."""
        last = self._last
        if last is not None and last[0] == t:
            return last[1][vertex]
        return self.after(t).position(vertex, t)

    def _check_continuity(self, motion: Pieces) -> None:
        for t, (before, after) in zip(motion.exact_until, pairwise(motion.motions), strict=True):
            if (
                isinstance(before, (Translation, Rigid))
                and isinstance(after, (Translation, Rigid))
                and before.exact_map_at(t) == after.exact_map_at(t)
            ):
                continue
            shape = self._shape.after(t)
            both = zip(_places(shape, before, t), _places(shape, after, t), strict=True)
            for i, (a, b) in enumerate(both):
                if a != b:
                    raise InputError(f"vertex {i} {jump(t, a, b)}; see exactpt.in_local_time")


def _largest(xs: Sequence[float], ys: Sequence[float]) -> float:
    """Return the largest size of a coordinate."""
    sides = max(xs), -min(xs), max(ys), -min(ys)
    return max(sides)


def jump(t: QQ, a: tuple[QQ, QQ], b: tuple[QQ, QQ]) -> str:
    """Return the words of a message about a jump at t from a to b."""
    size = math.hypot(nearest_float(b[0] - a[0]), nearest_float(b[1] - a[1]))
    places = [f"({nearest_float(x):.9g}, {nearest_float(y):.9g})" for x, y in (a, b)]
    return f"jumps at t = {show(t)} from {places[0]} to {places[1]}, by {size:.3g}"


def _places(shape: Sequence[Position], motion: SimpleMotion, t: QQ) -> list[tuple[QQ, QQ]]:
    """Return the positions of vertices at a time."""
    places = []
    for position in shape:
        check_budget()
        places.append(motion.track(position).exact_at(t))
    return places
