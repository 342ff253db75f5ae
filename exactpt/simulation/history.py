"""The past of a run: which bodies there were, how they moved, and what happened to them."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from fractions import Fraction
from typing import NamedTuple, final

from exactpt.brief import record_in_brief
from exactpt.errors import InputError
from exactpt.geometry.predicates import Point
from exactpt.kernel.algebraic import AlgebraicNumber
from exactpt.kernel.numbers import QQ, fraction, rational, shorten, show
from exactpt.motion.body import Body
from exactpt.motion.motions import Motion, Pieces, SimpleMotion
from exactpt.motion.outline import pieces_during
from exactpt.motion.stated_errors import StatedErrors, pivots_of
from exactpt.pair.contact import Contact
from exactpt.scene.scene import Scene
from exactpt.scene.units import Units


class Mark(NamedTuple):
    """What happened to bodies at a time.

    Attributes:
        time: the exact time.
        kind: "contact", "plan" (a new motion), "arrival" or "departure".
        bodies: their names.
    """

    time: AlgebraicNumber
    kind: str
    bodies: tuple[str, ...]

    def __repr__(self) -> str:
        return record_in_brief(self)


class Life(NamedTuple):
    """A body with all of its motions as pieces of one motion, from a time until another.

    Before and after, its motion is continued by its first and last motion.
    """

    body: Body
    since: Fraction
    until: Fraction

    def __repr__(self) -> str:
        return record_in_brief(self)


@final
@dataclass(frozen=True, slots=True)
class History:
    """A run up to now, see `Simulation.history`.

    Attributes:
        start, end: the time span; the end is that of the scene if a contact has ended the run.
        lives: the bodies, in the order in which they came. One whose shape was changed
            by a motion is there twice, one after the other. So is one with an angle error, if a
            motion changed the point about which this turns it.
        marks: what happened, in order of time.
        contact: the contact that has ended the run, or None.
        units, epoch: those of the scene.
    """

    start: Fraction
    end: Fraction
    lives: tuple[Life, ...]
    marks: tuple[Mark, ...]
    contact: Contact | None
    units: Units | None = None
    epoch: str | None = None

    def __repr__(self) -> str:
        return record_in_brief(self)

    @property
    def is_scene(self) -> bool:
        """True if all bodies were there from the start on, and kept their shapes."""
        return all((life.since, life.until) == (self.start, self.end) for life in self.lives)

    def scene(self) -> Scene:
        """Return the whole run as one scene: every motion is a piece of its body's motion.

        Contacts with a response are not in it, as the bodies turned before they touched. A body
        with several motions has the largest of the errors that were stated of it or assumed of one
        of them; an error that a path or a spin proves of its pieces is not kept then.

        Raises:
            InputError: if no time has passed, or a body came, went or changed its shape.
        """
        if self.start == self.end:
            raise InputError(f"no time has passed since t = {show(rational(self.start))}")
        for body, since, until in self.lives:
            if (since, until) != (self.start, self.end):
                raise InputError(
                    f"body {shorten(body.name)} was there from t = {show(rational(since))} "
                    f"to t = {show(rational(until))} "
                    f"only (or changed its shape, or what it turns about, then): "
                    f"no scene is this run"
                )
        bodies, span = [life.body for life in self.lives], (self.start, self.end)
        return Scene(bodies, span, units=self.units, epoch=self.epoch)


@final
class Log:
    """Collects the changes of a run for its `History`."""

    def __init__(self, scene: Scene) -> None:
        self._start = scene.exact_start
        self._end = scene.exact_end
        self._units, self._epoch = scene.units, scene.epoch
        self._plans = {body.name: [(scene.exact_start, body)] for body in scene.bodies}
        self._gone: list[Life] = []
        self._marks: list[Mark] = []

    def add_contact(self, contact: Contact) -> None:
        """Add a contact of bodies."""
        self._marks.append(Mark(contact.time, "contact", tuple(sorted(contact.bodies))))

    def changed(self, t: QQ, bodies: Iterable[Body]) -> None:
        """At a rational time, these are the bodies and their motions; takes time linear in them."""
        new = {body.name: body for body in bodies}
        for name in self._plans.keys() - new.keys():
            self._end_life(name, t)
            self._mark(t, "departure", name)
        for name, body in new.items():
            plans = self._plans.get(name)
            if plans is None:
                self._plans[name] = [(t, body)]
                self._mark(t, "arrival", name)
            elif plans[-1][1] is not body:
                if not _is_same_shape(plans[-1][1], body):
                    self._end_life(name, t)
                    plans = self._plans[name] = []
                if plans and plans[-1][0] == t:
                    plans.pop()
                plans.append((t, body))
                self._mark(t, "plan", name)

    def _mark(self, t: QQ, kind: str, name: str) -> None:
        """Add a mark; marks of one kind at one time are merged."""
        last = self._marks[-1] if self._marks else None
        if last is not None and last.kind == kind and last.time.compare_rational(t) == 0:
            if name not in last.bodies:
                self._marks[-1] = last._replace(bodies=(*last.bodies, name))
        else:
            self._marks.append(Mark(AlgebraicNumber(t), kind, (name,)))

    def _end_life(self, name: str, t: QQ) -> None:
        plans = self._plans.pop(name)
        if plans[0][0] < t:
            self._gone += _lives(plans, t)

    def history(self, now: AlgebraicNumber, contact: Contact | None) -> History:
        """Return the run up to now; if that is irrational, to a rational time just before."""
        end = now.simplified().exact_canonical_interval()[0] if contact is None else self._end
        here = [life for plans in self._plans.values() for life in _lives(plans, end)]
        lives = sorted([*self._gone, *here], key=lambda life: life.since)
        marks = sorted(self._marks, key=lambda mark: mark.time)
        span = fraction(self._start), fraction(end)
        return History(*span, tuple(lives), tuple(marks), contact, self._units, self._epoch)


def _is_same_shape(a: Body, b: Body) -> bool:
    return a.exact_shape is b.exact_shape or (
        a.vertices == b.vertices and a.keyframes == b.keyframes
    )


def _lives(plans: list[tuple[QQ, Body]], until: QQ) -> Iterator[Life]:
    """Yield the lives of a body of one shape, each up to the next one, or until a time."""
    parts = _of_one_reference_point(plans)
    ends = [*(part[0][0] for part in parts[1:]), until]
    return map(_life, parts, ends)


def _of_one_reference_point(plans: list[tuple[QQ, Body]]) -> list[list[tuple[QQ, Body]]]:
    """Return the plans in parts, each of which has an angle error about one point, or none."""
    parts = list[list[tuple[QQ, Body]]]()
    has_angle_error, points = False, set[Point]()
    for since, body in plans:
        has_angle_error = has_angle_error or _has_angle_error(body)
        points |= _possible_reference_points(body)
        if not parts or (has_angle_error and len(points) > 1):
            parts.append([])
            has_angle_error, points = _has_angle_error(body), _possible_reference_points(body)
        parts[-1].append((since, body))
    return parts


def _has_angle_error(body: Body) -> bool:
    """Return True if an angle error is stated of a body, or assumed of its motion."""
    return body.exact_errors.plus_assumed_of(body.motion).angle > 0


def _possible_reference_points(body: Body) -> set[Point]:
    """Return the points about which an angle error of a body may turn it, if there is one."""
    points = set(pivots_of(body.motion))
    return points if body.exact_errors.pivot is None else {*points, body.exact_errors.pivot}


def _life(plans: list[tuple[QQ, Body]], until: QQ) -> Life:
    """Return the life of a body with these motions, each with the time of its beginning."""
    since, body = plans[0]
    if len(plans) == 1:
        return Life(body, fraction(since), fraction(until))
    ends = [*(begin for begin, _ in plans[1:]), None]
    pieces = [
        piece
        for (begin, plan), end in zip(plans, ends, strict=True)
        for piece in _pieces(plan.motion, begin, end, until)
    ]
    motion = Pieces(pieces)
    whole = body.with_errors().with_motion(motion)
    errors = _largest_errors([plan for _, plan in plans], motion)
    return Life(whole.exact_with_errors(errors), fraction(since), fraction(until))


def _largest_errors(plans: list[Body], motion: Pieces) -> StatedErrors:
    """Return errors that hold for a body in each of its plans.

    Args:
        plans: the body with each of its motions, which have one reference point at most.
        motion: these motions together, without what is assumed of each of them.
    """
    errors = [plan.exact_errors.plus_assumed_of(plan.motion) for plan in plans]
    inner, outer = (max(of_shape) for of_shape in zip(*(e.shape for e in errors), strict=True))
    place, angle = max(e.place for e in errors), max(e.angle for e in errors)
    given = next((e.pivot for e in errors if e.pivot is not None), None)
    pivot = None if pivots_of(motion) else given
    return StatedErrors(place, angle, (inner, outer), pivot)


def _pieces(
    motion: Motion, begin: QQ, end: QQ | None, life_end: QQ
) -> Iterator[tuple[QQ | None, SimpleMotion]]:
    """Yield the pieces of a motion from one time to another one.

    If the end is None, it is the last motion of a body. Of pieces without end, such as those of a
    `Spin`, that one which holds at the end of the life of the body is the last.
    """
    last = life_end if end is None else end
    if end is None and isinstance(motion, Pieces):
        last = max((last, *(t + 1 for t in motion.exact_until)))
    for part, until in pieces_during(motion, begin, last):
        if until is None or until >= last:
            yield end, part
            return
        yield until, part
