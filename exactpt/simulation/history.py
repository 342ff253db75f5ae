"""The past of a run: which bodies there were, how they moved, and what happened to them."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from fractions import Fraction
from typing import NamedTuple, final

from exactpt.brief import record_in_brief
from exactpt.errors import InputError
from exactpt.kernel.algebraic import AlgebraicNumber
from exactpt.kernel.numbers import QQ, fraction, rational, shorten, show
from exactpt.motion.body import Body
from exactpt.motion.motions import Pieces, SimpleMotion
from exactpt.motion.outline import pieces_of
from exactpt.pairs.contact import Contact
from exactpt.scene.scene import Scene


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
            by a motion is there twice, one after the other.
        marks: what happened, in order of time.
        contact: the contact that has ended the run, or None.
    """

    start: Fraction
    end: Fraction
    lives: tuple[Life, ...]
    marks: tuple[Mark, ...]
    contact: Contact | None

    def __repr__(self) -> str:
        return record_in_brief(self)

    @property
    def is_scene(self) -> bool:
        """True if all bodies were there from the start on, and kept their shapes."""
        return all((life.since, life.until) == (self.start, self.end) for life in self.lives)

    def scene(self) -> Scene:
        """Return the whole run as one scene: every motion is a piece of its body's motion.

        Contacts with a response are not in it, as the bodies turned before they touched.

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
                    f"only (or changed its shape then): no scene is this run"
                )
        return Scene([life.body for life in self.lives], (self.start, self.end))


@final
class Log:
    """Collects the changes of a run for its `History`."""

    def __init__(self, scene: Scene) -> None:
        self._start = scene.exact_start
        self._end = scene.exact_end
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
            self._gone.append(_life(plans, t))

    def history(self, now: AlgebraicNumber, contact: Contact | None) -> History:
        """Return the run up to now; if that is irrational, to a rational time just before."""
        end = now.simplified().exact_canonical_interval()[0] if contact is None else self._end
        here = [_life(plans, end) for plans in self._plans.values()]
        lives = sorted([*self._gone, *here], key=lambda life: life.since)
        marks = sorted(self._marks, key=lambda mark: mark.time)
        return History(fraction(self._start), fraction(end), tuple(lives), tuple(marks), contact)


def _is_same_shape(a: Body, b: Body) -> bool:
    return a.exact_shape is b.exact_shape or (
        a.vertices == b.vertices and a.keyframes == b.keyframes
    )


def _life(plans: list[tuple[QQ, Body]], until: QQ) -> Life:
    """Return the life of a body with these motions, each with the time of its beginning."""
    since, body = plans[0]
    if len(plans) == 1:
        return Life(body, fraction(since), fraction(until))
    ends = [*(begin for begin, _ in plans[1:]), None]
    pieces = [
        piece
        for (begin, plan), end in zip(plans, ends, strict=True)
        for piece in _pieces(plan, begin, end)
    ]
    return Life(body.with_motion(Pieces(pieces)), fraction(since), fraction(until))


def _pieces(plan: Body, begin: QQ, end: QQ | None) -> Iterator[tuple[QQ | None, SimpleMotion]]:
    """Yield the pieces of a motion between two times (None: unbounded)."""
    for part, until in pieces_of(plan.motion):
        if until is not None and until <= begin:
            continue
        if until is None or (end is not None and until >= end):
            yield end, part
            return
        yield until, part
