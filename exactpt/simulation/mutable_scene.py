"""A scene and its tiling, both of which may change during a run."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import NamedTuple, final

from exactpt.errors import InputError
from exactpt.kernel.algebraic import AlgebraicNumber
from exactpt.kernel.numbers import QQ, shorten, show
from exactpt.motion.body import Body
from exactpt.motion.motions import Motion
from exactpt.motion.tileable import refuse_untileable
from exactpt.pair.start import initial_touches
from exactpt.scene.scene import Scene
from exactpt.simulation.event import RunEvent, events_of
from exactpt.simulation.motion_changes import with_new_motion
from exactpt.tiling.driver import TiledScene
from exactpt.tiling.start import plan_tiling
from exactpt.tiling.tiling import Tiling


class Choice(NamedTuple):
    """The choice of a tiling.

    Attributes:
        requested: the tiling of the caller: "auto" or one of `TILINGS`.
        name: the name of the one chosen at the start.
        exact_only: whether the float filters are off.
        fan: whether the fan triangulation is maintained.
    """

    requested: str
    name: str
    exact_only: bool
    fan: bool = False


@final
class MutableScene(TiledScene):
    """A scene with its tiling; bodies are added, removed and given new motions.

    Attributes:
        choice: how the tiling was chosen.
        changes: number of new motions, added bodies and removed bodies.
    """

    def __init__(
        self, scene: Scene, tiling: Tiling | None, choice: Choice, changes: int = 0
    ) -> None:
        super().__init__(scene, tiling)
        self.choice = choice
        self.changes = changes
        self._end = scene
        self._is_new = False  # whether the scene is to be built
        self._since = scene.exact_start
        self._given: Sequence[Body] = scene.bodies
        self._copied: list[Body] | None = None  # of the bodies given, when they are first needed
        self._numbered: dict[str, int] | None = None

    def _set_bodies(self, bodies: Sequence[Body]) -> None:
        self._given, self._copied, self._numbered = bodies, None, None

    @property
    def _bodies(self) -> list[Body]:
        if self._copied is None:
            self._copied = list(self._given)
        return self._copied

    @property
    def _number(self) -> dict[str, int]:
        if self._numbered is None:
            self._numbered = {body.name: i for i, body in enumerate(self._bodies)}
        return self._numbered

    @property
    def name(self) -> str:
        """The name of the tiling."""
        return self.choice.name if self.tiling is None else self.tiling.name

    @property
    def now(self) -> AlgebraicNumber:
        """The current time."""
        return AlgebraicNumber(self._since) if self.tiling is None else self.tiling.now

    @property
    def scene(self) -> Scene:
        """The bodies with their current motions, from the last change on; built on first use."""
        if self._is_new:
            self._scene, self._is_new = self._end.going_on(self._bodies, self._since), False
        return self._scene

    @property
    def bodies(self) -> Sequence[Body]:
        """The bodies with their current motions."""
        return self._bodies

    def body(self, name: str) -> Body:
        """Return the body of a given name, with its current motion.

        Raises:
            InputError: if there is none.
        """
        return self._bodies[self._index(name)]

    def has(self, body: Body) -> bool:
        """Return True if a body belongs to the scene, with this motion."""
        return body.name in self._number and self.body(body.name) is body

    def _index(self, name: str) -> int:
        if name not in self._number:
            raise InputError(f"there is no body {shorten(name)}")
        return self._number[name]

    def rational_now(self) -> QQ:
        """Return the current time, as a time at which bodies may change.

        Raises:
            InputError: if it is not rational, or is the end of the time span.
        """
        now = self.kinetic.now.simplified()
        if not now.is_rational:
            raise InputError(
                f"motions change at rational times only, not at t = {float(now)!r}: "
                "run until a rational time first"
            )
        if now.exact_low >= self._end.exact_end:
            raise InputError(f"t = {show(now.exact_low)} is the end of the time span")
        return now.exact_low

    def set_motions(self, motions: Mapping[str, Motion | Body]) -> list[RunEvent]:
        """Change motions, see `Simulation.set_motions`; return the events caused at once."""
        t = self.rational_now()
        new = {
            self._index(name): with_new_motion(self.body(name), motion, t)
            for name, motion in motions.items()
        }
        events = self.kinetic.change_motions(new, t)
        if events is None:
            bodies = [new.get(i, body) for i, body in enumerate(self._bodies)]
            return self._restart(bodies, t, len(new))
        for i, body in new.items():
            self._bodies[i] = body
        self._since, self._is_new = t, True
        self.changes += len(new)
        return events_of(self.kinetic, events)

    def add(self, body: Body) -> list[RunEvent]:
        """Add a body, see `Simulation.add`; return the events caused at once."""
        t = self.rational_now()
        if body.name in self._number:
            raise InputError(f"body {shorten(body.name)}: the name is taken by another body")
        refuse_untileable([body])
        alone = Scene([body], (t, self._end.exact_end))  # checks its shape
        bodies = [*self._bodies, body]
        events = None if body.has_rings else self.kinetic.add_body(body, t)
        if events is None:
            for i, j in initial_touches(alone.going_on(bodies, t))[1]:
                names = bodies[i].name, bodies[j].name
                raise InputError(
                    f"body {shorten(names[1])} touches body {shorten(names[0])} at t = {show(t)}"
                )
            return self._restart(bodies, t, 1)
        self._number[body.name] = len(self._bodies)
        self._bodies.append(body)
        self._since, self._is_new = t, True
        self.changes += 1
        return events_of(self.kinetic, events)

    def remove(self, name: str) -> list[RunEvent]:
        """Remove a body, see `Simulation.remove`; return the events caused at once."""
        t = self.rational_now()
        i, kinetic = self._index(name), self.kinetic
        rings = self._bodies[i].has_rings
        last = self._bodies.pop()
        if i < len(self._bodies):
            self._bodies[i] = last
        self._number[last.name] = i
        del self._number[name]
        events = None if rings else kinetic.remove_body(i, t)
        if events is None:
            return self._restart(self._bodies, t, 1)
        self._since, self._is_new = t, True
        self.changes += 1
        return events_of(self.kinetic, events)

    def _restart(self, bodies: Sequence[Body], t: QQ, changes: int) -> list[RunEvent]:
        """Rebuild the tiling for these bodies; a single event lists the difference in edges.

        A second event lists the difference of the fan triangulation, if it is maintained.
        """
        before, fan_before = self._diagonals(), self._fan()
        scene = self._end.going_on(bodies, t)
        choice = self.choice
        plan = plan_tiling(scene, choice.requested, t, fan=choice.fan)
        kinetic = plan.start(t, exact_only=choice.exact_only)
        kinetic.take_over_counts(self.kinetic)
        kinetic.stats.count("motion")
        kinetic.stats.rebuilds += 1
        self.tiling, self._scene, self._is_new, self._since = kinetic, scene, False, t
        self._set_bodies(bodies)
        self.changes += changes
        events = [_difference("motion", t, before, self._diagonals())]
        fan = kinetic.fan
        if fan is not None:
            changed = _difference("fan", t, fan_before, self._fan())
            fan.changes += len(changed.removed) + len(changed.added)
            if changed.removed or changed.added:
                events.append(changed)
        return events

    def _fan(self) -> set[tuple[str, str]]:
        """Return the edges of the fan triangulation by name; none if it is not maintained."""
        name, fan = self.kinetic.vertices.name, self.kinetic.fan
        ends = () if fan is None else fan.edges
        return {(min(pair), max(pair)) for u, v in ends for pair in [(name(u), name(v))]}

    def _diagonals(self) -> set[tuple[str, str]]:
        name, mesh = self.kinetic.vertices.name, self.kinetic.mesh_after()
        ends = (sorted(map(name, mesh.ends(h))) for h in mesh.diagonals())
        return {(u, v) for u, v in ends if u != v}


def _difference(
    kind: str, t: QQ, before: set[tuple[str, str]], after: set[tuple[str, str]]
) -> RunEvent:
    """Return the event at which edges have been replaced by others."""
    removed, added = sorted(before - after), sorted(after - before)
    return RunEvent(AlgebraicNumber(t), kind, tuple(removed), tuple(added))
