"""Runs to which much happens: bodies respond to contacts, get other motions, come and go.

A journey follows from a scene, a tiling and random choices alone. So the same one can be made
twice: once as it is, and once in another way that must not matter.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from fractions import Fraction
from functools import partial
from itertools import islice, pairwise
from random import Random
from typing import Final, NamedTuple, TypeAlias

import exactpt
from exactpt import (
    Body,
    Contact,
    InputError,
    Pieces,
    Rigid,
    RunEvent,
    Scene,
    Simulation,
    Translation,
)
from exactpt.kernel.numbers import QQ
from exactpt.testing.reference.shapes import bodies_meet
from fuzz.laws.law import check_equal, refuse_unless
from fuzz.laws.runs import bounce_in_doubles
from fuzz.witnesses import Difference

__all__ = ["Journey", "Moment", "touched_by"]

LEGS: Final = 10
"""Maximum number of changes in a journey."""

PARTS: Final = 60
"""Number of parts of the time span, at whose ends most changes are."""

TAME: Final = 0.2
"""Share of journeys in which no body comes, goes or changes its shape: they are one scene."""

RESPONSES: Final = 6
"""Number of contacts with a response; the next one ends the journey."""

Response: TypeAlias = Callable[[Simulation, Contact], object]

Rest: TypeAlias = "Callable[[Journey], object]"
"""What happens between two legs: it may look at the run, or replace it by an equal one."""


class Moment(NamedTuple):
    """A change of a run.

    Attributes:
        time: its time.
        bodies: the bodies from then on, with their motions.
    """

    time: Fraction
    bodies: Sequence[Body]


class Journey:
    """A run of some bodies of a scene, in which motions change and bodies come and go.

    Attributes:
        run: the run, now.
        absent: bodies that are not there now.
        moments: the start, and all changes so far.
    """

    def __init__(self, scene: Scene, tiling: str, random: Random, *, record: bool = False) -> None:
        refuse_unless(scene.bodies)
        self._random = random
        self._keeps_shapes = random.random() < TAME
        bodies = random.sample(scene.bodies, len(scene.bodies))
        away = 0 if self._keeps_shapes else random.randint(0, len(bodies) // 2)
        self.absent = bodies[:away]
        begun = Scene(bodies[away:], (scene.start, scene.end))
        self.run = Simulation(begun, tiling=tiling, record=record)
        refuse_unless(self.run.contact is None)
        self._bounce = exactpt.Bounce(restitution=random.choice(["0", "1/2", "1"]))
        span = scene.end - scene.start
        self._part = span / PARTS
        self._speed = _size_of(scene) / span
        self.moments: list[Moment] = []
        self._note()

    def events(self, rest: Rest = lambda _: None) -> Iterator[RunEvent]:
        """Yield the events of all legs; between two of them there is a rest.

        Raises:
            Difference: if a body that comes is not accepted or refused as it should be.
        """
        for _ in range(LEGS):
            yield from self._leg()
            now = self.run.now.simplified()
            if self.run.contact is not None or now >= self.run.scene.end:
                return
            if now.is_rational:
                self._change(now.low)
                self._note()
            rest(self)

    def _leg(self) -> Iterator[RunEvent]:
        """Yield the events up to a random time, or up to the next event."""
        kind = self._random.choice(["at once", "an event", "a time", "a time", "a time"])
        if kind == "an event":
            yield from islice(self.run.run(on_contact=self._respond), 1)
        elif kind == "a time":
            yield from self.run.run(until=self._later(), on_contact=self._respond)

    def _later(self) -> Fraction:
        """Return a time after now, at most the end."""
        scene = self.run.scene
        start = self.moments[0].time
        _, now = self.run.now.canonical_interval()
        gone = (Fraction(now) - start) // self._part
        return min(scene.end, start + self._part * (gone + self._random.randint(1, 12)))

    @property
    def changes(self) -> int:
        """The number of bodies that have come, gone, or got another motion."""
        named = [{body.name: body for body in moment.bodies} for moment in self.moments]
        return sum(
            before.get(name) is not after.get(name)
            for before, after in pairwise(named)
            for name in before.keys() | after.keys()
        )

    def _note(self) -> None:
        self.moments.append(Moment(self.run.now.low, tuple(self.run.scene.bodies)))

    # Responses

    def _respond(self, run: Simulation, contact: Contact) -> None:
        """Let bodies bounce, stop or go anywhere."""
        if run.contacts > RESPONSES:
            return
        kinds: list[Response] = [partial(bounce_in_doubles, self._bounce), self._go_anywhere]
        if not self._keeps_shapes:
            kinds.append(exactpt.stop)
        respond = self._go_anywhere if contact.kind == "self" else self._random.choice(kinds)
        respond(run, contact)
        self._note()

    def _go_anywhere(self, run: Simulation, contact: Contact) -> None:
        names = sorted({name for pair in contact.pairs for name in (pair.body, pair.other)})
        velocities = [(self._velocity(), self._velocity()) for _ in names]
        run.set_motions(
            {
                name: exactpt.onward(run.body(name), run.now.low, velocity)
                for name, velocity in zip(names, velocities, strict=True)
            }
        )

    # Changes

    def _change(self, now: Fraction) -> None:
        """Let a body come or go, or give one or two other motions."""
        here = [body.name for body in self.run.scene.bodies]
        kinds = ["motion"] * 3 if here else []
        if self.absent:
            kinds += ["come"] * 2
        if here and not self._keeps_shapes:
            kinds += ["go"]
        kind = self._random.choice(kinds)
        if kind == "come":
            self._come(now)
        elif kind == "go":
            self._go(self._random.choice(here))
        else:
            chosen = self._random.sample(here, self._random.choice([1, 1, 2][: 1 + len(here)]))
            self.run.set_motions(
                {name: self._with_some_motion(self.run.body(name), now) for name in chosen}
            )

    def _go(self, name: str) -> None:
        self.absent.append(self.run.body(name))
        self.run.remove(name)

    def _come(self, now: Fraction) -> None:
        """Add a body where its motion leads, or beside another one; it may be refused."""
        body = self.absent.pop(self._random.randrange(len(self.absent)))
        others = self.run.scene.bodies
        if others and self._random.random() < 0.7:
            body = self._beside(body, self._random.choice(others), now)
        touched = touched_by(body, self.run.scene, now)
        before = self.run.to_json()
        try:
            self.run.add(body)
        except InputError:
            self.absent.insert(0, body)
            if touched == []:
                raise Difference("add", f"{body.name!r} is refused, and touches no body") from None
            check_equal("state after a refused body", self.run.to_json(), before)
        else:
            if touched != []:
                raise Difference("add", f"{body.name!r} is accepted, and touches {touched}")

    def _beside(self, body: Body, other: Body, now: Fraction) -> Body:
        """Return a body of which a vertex is at one of another body, or a little beside."""
        (x, y), (u, v) = self._random.choice(body.at(now)), self._random.choice(other.at(now))
        shift = [u - x, v - y]
        for axis in (0, 1):
            shift[axis] += self._random.choice([-1, 0, 0, 1]) * Fraction(1, 4)
        vx, vy = self._velocity(), self._velocity()
        motion = Translation([shift[0] - vx * now, vx], [shift[1] - vy * now, vy])
        return body.halted(now).with_motion(motion)

    def _velocity(self) -> Fraction:
        """Return a coordinate of a velocity, by which the scene is crossed once or twice."""
        return self._speed * Fraction(self._random.randint(-8, 8), 4)

    def _with_some_motion(self, body: Body, now: Fraction) -> Body:
        """Return a body that goes on from where it is, in any kind of motion."""
        rest = body.halted(now)
        u, v = self._velocity(), self._velocity()
        x, y = [-u * now, u], [-v * now, v]
        kinds = ["onward"]
        if not self._keeps_shapes:
            kinds += ["rest", "straight", "straight", "falling", "there and back"]
            kinds += ["deforming"] if body.size > 1 else []
            kinds += ["turning"] if body.size > 1 and not body.angle_error else []
        if isinstance(body.motion, Rigid) and body.angle_error and self._random.random() < 0.5:
            return self._about_another_point(body, body.motion, now)
        kind = self._random.choice(kinds)
        if kind == "straight":
            return rest.with_motion(Translation(x, y))
        if kind == "onward":
            return body.with_motion(exactpt.onward(body, now, (u, v)))
        if kind == "falling":  # v (t - now) (now + 1 - t), by its coefficients
            return rest.with_motion(Translation(x, [-v * now * (now + 1), v * (2 * now + 1), -v]))
        if kind == "there and back":
            turn = now + self._part * self._random.randint(1, 4)
            back = Translation([u * (2 * turn - now), -u], [v * (2 * turn - now), -v])
            return rest.with_motion(Pieces([(turn, Translation(x, y)), (None, back)]))
        if kind == "turning":
            pivot = self._random.choice(rest.at(now))
            return rest.with_motion(Rigid([-now / 4, Fraction(1, 4)], pivot=pivot, x=x, y=y))
        if kind == "deforming" and not body.has_rings:
            return self._deforming(rest, now)
        return rest

    def _about_another_point(self, body: Body, motion: Rigid, now: Fraction) -> Body:
        """Return a body with an angle error that goes on turning, about one of its vertices."""
        plain = body.with_errors()
        pivot = self._random.choice(plain.with_motion(Translation()).at(now))

        def moved_by(x: Fraction, y: Fraction) -> Body:
            turning = Rigid(
                motion.half_turn, pivot=pivot, x=[x], y=[y], orientation=motion.orientation
            )
            return plain.with_motion(turning)

        (x, y), (u, v) = plain.at(now)[0], moved_by(Fraction(0), Fraction(0)).at(now)[0]
        return moved_by(x - u, y - v).with_errors(angle_error=body.angle_error)

    def _deforming(self, rest: Body, now: Fraction) -> Body:
        """Return a body whose vertices have different velocities."""
        vertices = []
        for x, y in rest.at(now):
            a, b = self._velocity() / 4, self._velocity() / 4
            vertices.append({"x": [x - a * now, a], "y": [y - b * now, b]})
        return Body(rest.name, vertices, closed=rest.closed)


def touched_by(body: Body, scene: Scene, time: Fraction) -> list[str] | None:
    """Return the names of bodies that a body touches at a time; None if it is no body then."""
    try:
        Scene([body], (time, scene.end))
    except InputError:
        return None
    at = QQ(time)
    points = body.exact_at(at)
    return [
        other.name for other in scene.bodies if bodies_meet(body, points, other, other.exact_at(at))
    ]


def _size_of(scene: Scene) -> Fraction:
    """Return the larger side of the box around a scene at its start, at least 1."""
    points = [point for body in scene.bodies for point in body.at(scene.start)]
    sides = [max(p[k] for p in points) - min(p[k] for p in points) for k in (0, 1)]
    return max(*sides, Fraction(1))
