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
    """The run of a scene from its start to its end or its first contact.

    At rational times bodies may be given new motions, added and removed, and the free space may
    be queried; with ``on_contact`` the run continues after contacts.

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
        scene: the bodies, their motions and the time span.
        tiling: the tiling to keep: "auto" or one of `TILINGS`.
        exact_only: whether exact arithmetic decides everything, without the float filters.
        max_events: maximum number of reported events; None for no limit.
        max_seconds: time limit in seconds of wall-clock time; None for no limit.

    Raises:
        InputError: if there is no such tiling, it does not support these bodies, or a bound
            is not a number >= 0.

    Attributes:
        contact: the contact that has ended the run, or None; no time passes after it.
        contacts: number of contacts so far.
    """

    # Plans

    def body(self, name: str) -> Body:
        """The body of a given name, with its current motion.

        Raises:
            InputError: if there is none.
        """
        return self._given[0].body(name) if self._living is None else self._living.body(name)

    def set_motion(self, body: str, plan: Motion | Body) -> None:
        """Give a body another motion from now on, see `set_motions`."""
        self.set_motions({body: plan})

    def set_motions(self, plans: Mapping[str, Motion | Body]) -> None:
        """Give bodies other motions from now on; the current time must be rational.

        Only certificates that involve these bodies are recomputed. (The tiling is rebuilt once if
        it is the one for convex bodies and a body need not stay convex.) The events caused are the
        first ones of the next `run`.

        Args:
            plans: by name of the body, a motion of its shape; or a body of the same name and
                number of vertices, if its shape changes in another way.

        Raises:
            InputError: if there is no such body, a vertex would jump (the message names both
                positions), or now is not rational or is the end of the time span.
        """
        self._change(self._changeable().set_motions(plans))

    def add(self, body: Body) -> None:
        """Add a body at the current time, which must be rational; it becomes the last one.

        Only the faces of the tiling that it meets are changed, after a walk to them; in the mixed
        tiling also the geodesics of bodies in whose relative hulls it lies. The tiling of points is
        rebuilt in O(n log n); so is the one for convex bodies, once, if the new body need not stay
        convex.

        Raises:
            InputError: if its name is taken, it is not simple, it touches another body, or now is
                not rational or is the end of the time span.
        """
        self._change(self._changeable().add(body))

    def remove(self, body: str) -> None:
        """Remove a body at the current time, which must be rational.

        The last body of the scene takes its index. Only the faces incident to it are changed, and
        the convex hull if the body is on it; in the mixed tiling also the geodesics that bend
        around it. The tiling of points is rebuilt in O(n log n).

        Raises:
            InputError: if there is no such body, or now is not rational or is the end of the time
                span.
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
        """A picture of the tiling at the current time, or of the contact, for notebooks."""
        return str(extension("picture of a simulation")(self))

    # Saving and copying

    def save(self, path: str | Path) -> None:
        """Write the simulation as JSON, exactly; the file is complete or not there.

        After `restore` the same events follow, byte for byte, as without the interruption. Bounds
        on events and seconds are not saved.

        Raises:
            InputError: if the file cannot be written, or the scene contains what no scene file can
                hold (see `Scene.save`).
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
            path: the file.
            max_events: maximum number of events reported from now on; None for no limit.
            max_seconds: time limit in seconds of wall-clock time; None for no limit.

        Raises:
            InputError: if it is not a saved simulation, or one of another version.
        """
        from exactpt.simulation.store import reading, scene_from_json

        with reading(Path(path)) as data:
            return _resumed(data, scene_from_json(data["scene"]), max_events, max_seconds)

    def copy(self) -> Simulation:
        """An independent copy of the simulation, in memory.

        The same events follow in both. The rest of the bounds on events and seconds is copied too.
        `copy.copy`, `copy.deepcopy` and `pickle` give the same result.
        """
        return copy(self)

    def __reduce__(self) -> tuple[object, ...]:
        events = None if self._max_events is None else max(0, self._max_events - self._events)
        seconds = None if self._deadline is None else max(0.0, self._deadline - monotonic())
        return _resumed, (self._data(None), self.scene, events, seconds)

    def _met_to_json(self) -> dict[str, object] | None:
        """The last contact, if all of its bodies still have the same motions; else None."""
        from exactpt.simulation.saved import number_to_json

        if self._met is None or self._living is None:
            return None
        time, then = self._met
        now = {body.name: body for body in self.scene.bodies}
        if any(now.get(name) is not body for name, body in then.items()):
            return None
        return {"time": number_to_json(time), "bodies": sorted(then)}

    def to_json(self) -> dict[str, object]:
        """The JSON data that `save` writes."""
        return self._data(scene_to_json(self.scene))

    def _data(self, scene: object) -> dict[str, object]:
        """The state of the run, with a given representation of the scene."""
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
    """The simulation of a scene, with the state that `Simulation.to_json` has written."""
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
