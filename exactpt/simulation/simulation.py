"""Simulation: a scene with its tiling, at a time that moves forward."""

from __future__ import annotations

from collections.abc import Mapping
from copy import copy
from pathlib import Path
from time import monotonic
from typing import Any, final

from exactpt.errors import InputError
from exactpt.extensions import extension
from exactpt.files import write_atomically
from exactpt.kernel.counters import Counts
from exactpt.kernel.numbers import parse_rational
from exactpt.motion.body import Body
from exactpt.motion.motions import Motion
from exactpt.scene.format import to_json as scene_to_json
from exactpt.scene.scene import Scene
from exactpt.simulation.living import LivingScene
from exactpt.simulation.running import Running

__all__ = ["Simulation"]


@final
class Simulation(Running):
    """Runs a scene from its start towards its end or its first contact.

    It lives: at rational times, bodies get new motions, come and go, and the free space
    can be asked about; and with ``on_contact`` it runs on after contacts.

    >>> import exactpt
    >>> ball = exactpt.Body("ball", [(0, 0), (1, 0), (0, 1)], exactpt.Translation([0, 1]))
    >>> wall = exactpt.Body("wall", [(5, -9), (5, 9)])
    >>> simulation = exactpt.Simulation(exactpt.Scene([ball, wall], time=(0, 20)))
    >>> list(simulation.run(2)), simulation.ray_cast((4, "1/2"), (-1, 0)).body
    ([], 'ball')
    >>> simulation.set_motion("ball", exactpt.Translation([1, "1/2"]))
    >>> events = simulation.run(on_contact=exactpt.Bounce(fixed=["wall"]))
    >>> [(event.kind, float(event.time)) for event in events]
    [('motion', 2.0), ('contact', 6.0), ('motion', 6.0)]

    Args:
        scene: what moves.
        tiling: which tiling to keep: "auto" or one of `TILINGS`.
        exact_only: decide everything by exact arithmetic, without the float filters.
        max_events: raise `BudgetExceeded` instead of telling one more event than these.
        max_seconds: raise `BudgetExceeded` after so many seconds of the clock.

    Raises:
        InputError: if there is no such tiling, it is not for these bodies, or a bound is
            no number from 0 on.

    Attributes:
        contact: the contact that has ended the run, if one has; no time passes after it.
        contacts: how many contacts have been met.
    """

    # Plans

    def body(self, name: str) -> Body:
        """The body with a name, with its present plan.

        Raises:
            InputError: if there is none.
        """
        return self._given[0].body(name) if self._living is None else self._living.body(name)

    def set_motion(self, body: str, plan: Motion | Body) -> None:
        """Let a body go on by another motion from now on; see `set_motions`."""
        self.set_motions({body: plan})

    def set_motions(self, plans: Mapping[str, Motion | Body]) -> None:
        """Let bodies go on by other motions from now on; now must be rational.

        The work is for the certificates of these bodies, not for the scene. (Another kind of
        tiling is built, once, if it is that of convex bodies and one need not stay convex.)
        The events that this causes come first in the next `run`.

        Args:
            plans: by name, a motion of the body's shape; or a body of that name with as
                many vertices, for a shape that changes in another way.

        Raises:
            InputError: if there is no such body, a vertex would jump (with the two
                positions), now is not rational or is the end of the time span.
        """
        self._change(self._changeable().set_motions(plans))

    def add(self, body: Body) -> None:
        """Add a body now, which must be rational, as the last one.

        The work is for the faces of the tiling that it meets, after a walk to them; in the
        mixed tiling, for the geodesics of the bodies in whose relative hulls it comes to
        lie, too. The tiling of points is built anew, O(n log n); so is, once, that of
        convex bodies when one comes that need not stay convex.

        Raises:
            InputError: if its name is taken, it is not simple, it touches another body,
                now is not rational or is the end of the time span.
        """
        self._change(self._changeable().add(body))

    def remove(self, body: str) -> None:
        """Remove a body now, which must be rational; the last one takes its place in the scene.

        The work is for the faces of the tiling that it touches, and for the convex hull if
        it is there; in the mixed tiling, for the geodesics that have bent around it, too.
        The tiling of points is built anew, O(n log n).

        Raises:
            InputError: if there is no such body, now is not rational or is the end.
        """
        self._change(self._changeable().remove(body))

    def _changeable(self) -> LivingScene:
        if self.contact is not None:
            raise InputError(
                f"the run has ended with a contact at t = {float(self.contact.time)!r}"
            )
        self._forget_space()
        return self._alive()

    def _repr_svg_(self) -> str:
        """The tiling at the current time, or the contact, for notebooks."""
        return str(extension("picture of a simulation")(self))

    # A run that is interrupted

    def save(self, path: str | Path) -> None:
        """Write the simulation as JSON, exactly; the file is complete or not there.

        `restore` goes on with it: the events that come are the same, byte by byte, as
        without the interruption. Bounds on events and seconds are not saved.

        Raises:
            InputError: if the file cannot be written, or the scene has what no scene file has
                (`Scene.save`).
        """
        from exactpt.simulation.store import json_text

        write_atomically(Path(path), json_text(self.to_json()))

    @classmethod
    def restore(
        cls,
        path: str | Path,
        *,
        max_events: int | None = None,
        max_seconds: float | None = None,
    ) -> Simulation:
        """The simulation that `save` has written.

        Args:
            path: of the file.
            max_events: raise `BudgetExceeded` instead of telling one more event than these,
                from now on.
            max_seconds: raise `BudgetExceeded` after so many seconds of the clock.

        Raises:
            InputError: if the file is none, or of another version.
        """
        from exactpt.simulation.store import reading, scene_from_json

        with reading(Path(path)) as data:
            return _resumed(data, scene_from_json(data["scene"]), max_events, max_seconds)

    def copy(self) -> Simulation:
        """The simulation as it is now, in memory: what happens to one does not to the other.

        The same events come in both. What is left of bounds on events and seconds is taken
        along; so it is by `copy.copy`, `copy.deepcopy` and `pickle`, which work too.
        """
        return copy(self)

    def __reduce__(self) -> tuple[object, ...]:
        events = None if self._max_events is None else max(0, self._max_events - self._events)
        seconds = None if self._deadline is None else max(0.0, self._deadline - monotonic())
        return _resumed, (self._data(None), self.scene, events, seconds)

    def _met_to_json(self) -> dict[str, object] | None:
        """The last contact that was met, if none of its bodies has another plan since."""
        from exactpt.simulation.saved import number_to_json

        if self._met is None or self._living is None:
            return None
        time, then = self._met
        now = {body.name: body for body in self.scene.bodies}
        if any(now.get(name) is not body for name, body in then.items()):
            return None
        return {"time": number_to_json(time), "bodies": sorted(then)}

    def to_json(self) -> dict[str, object]:
        """What `save` writes."""
        return self._data(scene_to_json(self.scene))

    def _data(self, scene: object) -> dict[str, object]:
        """The state of the run, with the scene in a form of its own."""
        from exactpt.simulation.saved import tiling_to_json
        from exactpt.simulation.store import VERSION

        living, counts = self._living, self._counts()
        return {
            "exactpt-simulation": VERSION,
            "name": self.name,
            "tiling": self._asked_for[0],
            "exact_only": self._asked_for[1],
            "margin": str(self._margin),
            "scene": scene,
            "contact": None if self.contact is None else self.contact.to_json(),
            "met": self._met_to_json(),
            "pending": [event.to_json() for event in self._pending],
            "counts": {
                "contacts": self.contacts,
                "changes": 0 if living is None else living.changes,
                "exact": counts.exact,
                "filtered": counts.filtered,
                "reasons": dict(counts.reasons),
            },
            "state": None if living is None else tiling_to_json(living.kinetic),
        }


def _resumed(
    data: Mapping[str, Any], scene: Scene, max_events: int | None, max_seconds: float | None
) -> Simulation:
    """The simulation with the state that `Simulation.to_json` tells, of a scene."""
    from exactpt.simulation.saved import (
        contact_from_json,
        event_from_json,
        number_from_json,
        tiling_from_json,
    )

    asked, exact_only = data["tiling"], data["exact_only"]
    counts, state = data["counts"], data["state"]
    self = Simulation(Scene([], (scene._start, scene._end)), tiling=asked, exact_only=exact_only,
                      max_events=max_events, max_seconds=max_seconds)  # fmt: skip
    self._given = scene, data["name"]
    self._margin = parse_rational(data["margin"])
    self._living = state and LivingScene(
        scene,
        tiling_from_json(state, scene.bodies, exact_only=exact_only),
        asked,
        exact_only=exact_only,
        changes=counts["changes"],
    )
    self._pending.extend(map(event_from_json, data["pending"]))
    self.contact = data["contact"] and contact_from_json(data["contact"])
    self.contacts = counts["contacts"]
    if self._living is not None:
        if data["met"] is not None:
            time, names = number_from_json(data["met"]["time"]), data["met"]["bodies"]
            self._met = time, {name: self._living.body(name) for name in names}
        before = Counts(counts["exact"], counts["filtered"], counts["reasons"])
        self._living.kinetic.vertices.counters.set(before)
    return self
