"""Responses to contacts, for `Simulation.run(on_contact=...)`: bounce or stop.

The contact is exact; the response is a modelling choice. New velocities are computed from the
exact ones with the contact normal in doubles, and are rounded to a grid
(`exactpt.simulation.motion_changes`). The simulation decides exactly whether the bodies separate
and when they touch again.
"""

from __future__ import annotations

import math
from collections.abc import Collection, Mapping
from fractions import Fraction
from typing import TYPE_CHECKING, Final, NamedTuple, final

from exactpt.errors import InputError
from exactpt.kernel.numbers import QQ, Rational, fraction, nearest_float, rational, shorten
from exactpt.motion.body import Body
from exactpt.motion.motions import made
from exactpt.simulation.motion_changes import GRID, continued, onward, translation_velocity
from exactpt.simulation.normals import Vector, normals_at

if TYPE_CHECKING:
    from exactpt.pair.contact import Contact, ContactPoint
    from exactpt.simulation.simulation import Simulation

ROUNDS: Final = 8
"""Maximum number of passes over the incidences of a contact."""


def stop(simulation: Simulation, contact: Contact) -> None:
    """Stop all bodies of a contact, in their current position and shape."""
    t = simulation.now.exact_low
    names = sorted({name for pair in contact.pairs for name in (pair.body, pair.other)})
    simulation.set_motions({name: simulation.body(name).halted(t) for name in names})


class _Push(NamedTuple):
    """One direction in which the first body of a pair is pushed, the second in the opposite one.

    Attributes:
        pair: the pair.
        normal: the direction, a unit vector.
        approach: the speed along it at which the bodies approach before the contact.
    """

    pair: ContactPoint
    normal: Vector
    approach: float


@final
class Bounce:
    """Collisions of bodies that are pushed along the normal, and with bodies that never move.

    Rotations and deformations continue unchanged; translations become linear.

    Args:
        fixed: names of bodies that never change their motion; all of them are bodies at the
            first contact.
        restitution: the speed of separation over that of approach, along the normal, in [0, 1];
            1 for elastic collisions.
        masses: positive masses by name; 1 for bodies that are not named.
        slowest: minimum normal speed, positive, at which touching features separate.
        fastest: maximum absolute value of each velocity coordinate; None for no limit.
        grid: positive step to whose multiples velocities are rounded. This, and ``slowest``, is
            why the energy of elastic collisions drifts; docs/howto/simulation.md has figures.

    Raises:
        InputError: if ``fixed`` is a string, or a number is out of range (that of doubles too,
            except for ``grid``); at the first contact, if a name in ``fixed`` or ``masses`` is no
            body; at a contact, if a velocity leaves the range of doubles.
    """

    def __init__(
        self,
        fixed: Collection[str] = (),
        *,
        restitution: Rational = 1,
        masses: Mapping[str, Rational] | None = None,
        slowest: Rational = "1/16",
        fastest: Rational | None = None,
        grid: Rational = GRID,
    ) -> None:
        if isinstance(fixed, str):
            raise InputError(f"fixed: a collection of names, not the text {shorten(fixed)}")
        masses = dict(masses or {})
        positive = {"slowest": slowest, "fastest": fastest, "grid": grid}
        positive |= {f"the mass of {shorten(name)}": mass for name, mass in masses.items()}
        for what, number in positive.items():
            if number is not None and rational(number) <= 0:
                raise InputError(f"{what}: not positive: {shorten(number)}")
            if number is None or what == "grid":
                continue
            if not 0.0 < nearest_float(rational(number)) < math.inf:
                raise InputError(f"{what}: beyond the range of doubles: {shorten(number)}")
        if not 0 <= rational(restitution) <= 1:
            raise InputError(f"restitution: not between 0 and 1: {shorten(restitution)}")
        self._fixed = frozenset(fixed)
        # A misspelt name would be a body that is pushed away, or of another mass.
        self._unseen = dict.fromkeys(fixed, "fixed") | dict.fromkeys(masses, "masses")
        self._restitution = nearest_float(rational(restitution))
        self._masses = {name: rational(mass) for name, mass in masses.items()}
        self._slowest = nearest_float(rational(slowest))
        self._fastest = math.inf if fastest is None else nearest_float(rational(fastest))
        self._grid = rational(grid)

    def __call__(self, simulation: Simulation, contact: Contact) -> None:
        """Give the bodies of a contact velocities with which they separate."""
        self._check_names(simulation)
        t = simulation.now.exact_low
        names = sorted({name for pair in contact.pairs for name in (pair.body, pair.other)})
        bodies = {name: simulation.body(name) for name in names}
        change = {name: [0.0, 0.0] for name in names}
        pushes = [push for pair in contact.pairs for push in self._pushes(pair, bodies, t)]
        for _ in range(ROUNDS):
            # Incidence by incidence until all separate: a vertex may touch several edges.
            pushed = [self._push(push, change) for push in pushes]
            if not any(pushed):
                break
        motions = {}
        for name in names:
            if name not in self._fixed and any(change[name]):
                motions[name] = self._motion(bodies[name], change[name], t)
        simulation.set_motions(motions)

    def momentum(self, simulation: Simulation) -> tuple[Fraction, Fraction]:
        """Return the momentum (x, y) now of all bodies that are not fixed, exactly.

        The velocity of a body is that of its translation: rotations and deformations, which
        contacts do not change, have no part in it.

        Raises:
            InputError: if now is irrational and the velocity of a body is not constant, or its
                motion is of a user-defined class.
        """
        moving = self._moving(simulation)
        x, y = (sum((m * v[k] for m, v in moving), QQ(0)) for k in (0, 1))
        return fraction(x), fraction(y)

    def kinetic_energy(self, simulation: Simulation) -> Fraction:
        """Return the kinetic energy of these bodies now, the sum of m (vx^2 + vy^2) / 2.

        See `momentum` for the bodies.
        """
        moving = self._moving(simulation)
        return fraction(sum((m * (x * x + y * y) / 2 for m, (x, y) in moving), QQ(0)))

    def _moving(self, simulation: Simulation) -> list[tuple[QQ, tuple[QQ, QQ]]]:
        """Return the masses and velocities of all bodies that are not fixed."""
        return [
            (self._masses.get(body.name, QQ(1)), translation_velocity(body, simulation.now))
            for body in simulation.scene.bodies
            if body.name not in self._fixed
        ]

    def _check_names(self, simulation: Simulation) -> None:
        """Check that every name that was given is that of a body, now or at a contact before."""
        for name, option in sorted(self._unseen.items()):
            try:
                simulation.body(name)
            except InputError as error:
                raise InputError(f"Bounce: {option}: {error}") from None
            del self._unseen[name]

    def __reduce__(self) -> tuple[object, ...]:
        fastest = None if math.isinf(self._fastest) else self._fastest
        masses = {name: str(mass) for name, mass in self._masses.items()}
        options = {
            "restitution": self._restitution, "masses": masses, "slowest": self._slowest,
            "fastest": fastest, "grid": str(self._grid),
        }  # fmt: skip
        return made, (Bounce, (tuple(sorted(self._fixed)),), options)

    def _pushes(self, pair: ContactPoint, bodies: dict[str, Body], t: QQ) -> list[_Push]:
        """How the first body of a pair is to be pushed; nothing if both stay."""
        if pair.body == pair.other or self._fixed.issuperset((pair.body, pair.other)):
            return []
        a, b = bodies[pair.body], bodies[pair.other]
        (ux, uy), (vx, vy) = _velocities(pair, a, b, t)
        if pair.normal is not None:
            normals = [pair.normal]
        else:
            vertices = (a, pair.vertex), (b, pair.other_vertex or 0)
            normals = normals_at(*vertices, (ux - vx, uy - vy), t)
        return [_Push(pair, (nx, ny), nx * (vx - ux) + ny * (vy - uy)) for nx, ny in normals]

    def _push(self, push: _Push, change: dict[str, list[float]]) -> bool:
        """Push one pair apart, by opposite impulses along a normal, if needed.

        Returns:
            Whether an impulse was applied: not to a pair that separates.
        """
        pair, (nx, ny), approach = push
        a, b = change[pair.body], change[pair.other]
        parting = nx * (a[0] - b[0]) + ny * (a[1] - b[1]) - approach
        if parting >= self._slowest / 2:
            return False
        goal = max(self._restitution * abs(approach), self._slowest)
        for (name, share), way in zip(self._shares(pair), (1.0, -1.0), strict=True):
            change[name][0] += way * (goal - parting) * share * nx
            change[name][1] += way * (goal - parting) * share * ny
        return True

    def _shares(self, pair: ContactPoint) -> list[tuple[str, float]]:
        """Return the share of each body of a pair in a change of relative speed; the sum is 1.

        It is in inverse proportion to the mass; that of a fixed body is infinite. Masses are
        divided by the larger one, as neither their inverses nor their sum need be a double.
        """
        names = (pair.body, pair.other)
        if not self._fixed.isdisjoint(names):
            return [(name, 0.0 if name in self._fixed else 1.0) for name in names]
        a, b = (nearest_float(self._masses.get(name, QQ(1))) for name in names)
        heavy = max(a, b)
        a, b = a / heavy, b / heavy
        return [(pair.body, b / (a + b)), (pair.other, a / (a + b))]

    def _motion(self, body: Body, change: list[float], t: QQ) -> Body:
        velocity = [
            min(max(v + dv, -self._fastest), self._fastest)
            for v, dv in zip(_translation_speed(body, t), change, strict=True)
        ]
        if not all(map(math.isfinite, velocity)):
            raise InputError(
                f"body {shorten(body.name)}: its velocity after the bounce is beyond the range of "
                f"doubles"
            )
        return continued(body, onward(body, t, velocity, grid=self._grid))


def _velocities(pair: ContactPoint, a: Body, b: Body, t: QQ) -> tuple[Vector, Vector]:
    """Return the velocities of the vertex and of the feature that it touches."""
    first = _velocity(a, pair.vertex, t)
    if pair.edge is None:
        return first, _velocity(b, pair.other_vertex or 0, t)
    return first, _velocity_beside(b, pair.edge, (a, pair.vertex), t)


def _velocity(body: Body, vertex: int, t: QQ) -> Vector:
    """Return the velocity of a vertex just after a time, in doubles."""
    x, y = body.exact_piece_after(t).track(vertex).velocity(t)
    return nearest_float(x), nearest_float(y)


def _velocity_beside(body: Body, edge: int, vertex: tuple[Body, int], t: QQ) -> Vector:
    """Return the velocity of the point of an edge that is nearest to a vertex of a body."""
    if body.exact_piece_after(t).translation is not None:
        return _translation_speed(body, t)
    points, end = body.exact_at(t), body.end_of_edge(edge)
    a, b = points[edge], points[end]
    place = vertex[0].exact_at(t)[vertex[1]]
    dx, dy = b[0] - a[0], b[1] - a[1]
    along = ((place[0] - a[0]) * dx + (place[1] - a[1]) * dy) / (dx * dx + dy * dy)
    s = nearest_float(min(max(along, QQ(0)), QQ(1)))
    (ux, uy), (vx, vy) = (_velocity(body, v, t) for v in (edge, end))
    return ux + s * (vx - ux), uy + s * (vy - uy)


def _translation_speed(body: Body, t: QQ) -> Vector:
    """Return the velocity that the motion's translation gives to every vertex, in doubles."""
    x, y = translation_velocity(body, t)
    return nearest_float(x), nearest_float(y)
