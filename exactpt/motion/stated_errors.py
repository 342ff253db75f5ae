"""Errors of a body that its user states, and the point about which its angle error turns it.

The true shape of the body differs from the modelled one by the shape error. It is put at the
modelled pose, turned about the image of the reference point by an angle of at most the angle error,
then moved by at most the place error. Both are unknown, continuous functions of time. Nothing
proves a stated error: it is assumed, and counts at every time. An error that the motion proves of
its pieces (`exactpt.motion.path_error`) comes on top of it.

A motion that turns by a formula turns about its pivot, and the angle error of the body, too: else a
small error of the angle would stand for a large one of the place. So only a body whose motion has
no pivot is given one.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Final, NamedTuple, final

from exactpt.errors import InputError
from exactpt.geometry.predicates import Point
from exactpt.kernel.numbers import QQ, Rational, rational, rationals, show
from exactpt.kernel.polynomial import Polynomial
from exactpt.motion.motions import Motion, Piecewise, Rigid, SimpleMotion, formulas_of


@final
class StatedErrors(NamedTuple):
    """The errors that are stated of a body.

    Attributes:
        place: the largest distance by which the body is moved from its modelled place.
        angle: the largest angle by which it is turned, in radians.
        shape: the largest distance of a point of the true shape from the modelled one, then that
            of a point of the modelled shape from the true one.
        pivot: the reference point of the angle error in the rest frame, where it was given; None
            where the motion has a pivot, or without an angle error.
    """

    place: QQ
    angle: QQ
    shape: tuple[QQ, QQ]
    pivot: Point | None

    def reference_point(self, motion: Motion) -> Point | None:
        """Return the point, in the rest frame, about which the angle error turns a body.

        Args:
            motion: the motion of the body.

        Returns:
            The point; None without an angle error.
        """
        if not self.angle:
            return None
        return pivot_of(motion) if self.pivot is None else self.pivot

    @property
    def sizes(self) -> tuple[QQ, QQ, QQ, QQ]:
        """The errors, without the reference point."""
        return self.place, self.angle, *self.shape

    def given(self, write: Callable[[QQ], str] = str) -> dict[str, object]:
        """Return the arguments of `Body` that state these errors; files have the same keys.

        Args:
            write: returns a number as a text.
        """
        options: dict[str, object] = {}
        if self.place:
            options["place_error"] = write(self.place)
        if self.angle:
            options["angle_error"] = write(self.angle)
        if any(self.shape):
            options["shape_error"] = [write(error) for error in self.shape]
        if self.pivot is not None:
            options["pivot"] = [write(coordinate) for coordinate in self.pivot]
        return options

    def with_motion(self, before: Motion, after: Motion) -> StatedErrors:
        """Return the errors of a body with another motion, about the same reference point.

        Raises:
            InputError: if the motion has another pivot.
        """
        reference = self.reference_point(before)
        if reference is None:
            return self
        pivot = pivot_of(after)
        if pivot is None:
            return self._replace(pivot=reference)  # as before, if it was given
        if pivot != reference:
            raise InputError(
                f"angle_error: it is stated about {show(*reference)}, got a motion that turns "
                f"about {show(*pivot)}; make a body of this motion that states its own error"
            )
        return self._replace(pivot=None)

    def plus_assumed_of(self, motion: Motion) -> StatedErrors:
        """Return these errors and those that are assumed of the motion of the body."""
        if not isinstance(motion, Piecewise):
            return self
        place, angle = motion.exact_assumed_errors()
        return self._replace(place=self.place + place, angle=self.angle + angle)

    def halted(self, motion: Motion, formula: SimpleMotion, t: QQ) -> StatedErrors:
        """Return the errors of a body that stands still as it is at a time.

        Its new rest frame is that of the scene: the reference point is now where the motion had it.

        Args:
            motion: the motion that ends.
            formula: the part of it that holds at the time.
            t: the time.
        """
        reference = self.reference_point(motion)
        if reference is None:
            return self
        x, y = reference
        at_rest = Polynomial([x]), Polynomial([y])
        return self._replace(pivot=formula.track(at_rest).exact_at(t))


NONE_STATED: Final = StatedErrors(QQ(0), QQ(0), (QQ(0), QQ(0)), None)
"""The errors of a body that is exactly where it is modelled, but for errors of its motion."""


def read_stated_errors(
    motion: Motion,
    place_error: Rational,
    angle_error: Rational,
    shape_error: Sequence[Rational],
    pivot: Sequence[Rational] | None,
) -> StatedErrors:
    """Return the errors that a caller states of a body with a motion.

    Raises:
        InputError: if one is not a number that is at least 0, or if the reference point of an
            angle error is missing, ambiguous or superfluous.
    """
    place = _size("place_error", place_error)
    angle = _size("angle_error", angle_error)
    inner, outer = _two_numbers("shape_error", shape_error, "two numbers are needed")
    shape = _not_negative("shape_error", inner), _not_negative("shape_error", outer)
    reference = None
    if pivot is not None:
        reference = _two_numbers("pivot", pivot, "two coordinates are needed")
    _check_reference(motion, angle, reference)
    return StatedErrors(place, angle, shape, reference)


def pivot_of(motion: Motion) -> Point | None:
    """Return the pivot about which a motion turns; None if it has none.

    Raises:
        InputError: if its pieces turn about different points.
    """
    pivots = pivots_of(motion)
    if len(pivots) > 1:
        pivot, other, *_ = pivots
        raise InputError(
            f"angle_error: it needs one pivot, got pieces that turn about {show(*pivot)} and about "
            f"{show(*other)}; leave it out, or turn all pieces about one point"
        )
    return pivots[0] if pivots else None


def pivots_of(motion: Motion) -> list[Point]:
    """Return the points about which a motion, or a piece of it, turns: each of them once."""
    turns = [formula for formula in formulas_of(motion) if isinstance(formula, Rigid)]
    return list(dict.fromkeys(turn.exact_pivot for turn in turns))


def _check_reference(motion: Motion, angle: QQ, pivot: Point | None) -> None:
    """Check that an angle error has one reference point, which is stated once."""
    if not angle:
        if pivot is not None:
            raise InputError(
                f"pivot: it is the reference point of an angle_error above 0, which is missing, "
                f"got {show(*pivot)}; leave it out, or state the error"
            )
        return
    of_motion = pivot_of(motion)
    if of_motion is None and pivot is None:
        raise InputError(
            f"angle_error: it needs a reference point, got {show(angle)} and a motion without a "
            f"pivot; state the pivot"
        )
    if of_motion is not None and pivot is not None:
        raise InputError(
            f"pivot: the motion turns about {show(*of_motion)} already, got {show(*pivot)}; leave "
            f"it out"
        )


def _size(what: str, value: Rational) -> QQ:
    try:
        exact = rational(value)
    except InputError as error:
        raise InputError(f"{what}: {error}") from None
    return _not_negative(what, exact)


def _not_negative(what: str, value: QQ) -> QQ:
    if value < 0:
        raise InputError(f"{what}: it must be at least 0, got {show(value)}")
    return value


def _two_numbers(what: str, values: Sequence[Rational], needed: str) -> tuple[QQ, QQ]:
    try:
        first, second = rationals(values, 2, needed)
    except InputError as error:
        raise InputError(f"{what}: {error}") from None
    return first, second
