"""Simulation: a scene with its tiling, at a time that moves forward."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from copy import copy
from fractions import Fraction
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Any, Self, final

from exactpt.brief import counted
from exactpt.errors import InputError
from exactpt.extensions import extension
from exactpt.files import write_atomically
from exactpt.kernel.algebraic import AlgebraicNumber
from exactpt.kernel.budget import Budget
from exactpt.kernel.numbers import Rational
from exactpt.motion.body import Body
from exactpt.motion.motions import Motion
from exactpt.scene.scene import Scene, a_scene
from exactpt.scene.written import to_json as scene_to_json
from exactpt.simulation.event import RunEvent
from exactpt.simulation.history import History, Log
from exactpt.simulation.running import begin
from exactpt.simulation.spaces import SpaceCache, why_no_tiling
from exactpt.tiling.catalogue import AUTO
from exactpt.tiling.report import report, rules_of

if TYPE_CHECKING:
    from exactpt.kernel.stored import Stored
    from exactpt.pair.contact import Contact
    from exactpt.pseudotriangulation.snapshot import Snapshot
    from exactpt.query import answers
    from exactpt.query.answers import Hit, Place, VertexName
    from exactpt.query.space import FreeSpace, PointLike
    from exactpt.tiling.tiling import Tiling


@final
class Simulation:
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
        fan: whether the fan triangulation of points is maintained too. Its changes at a time are
            an event of kind "fan", the last one of that time, and are counted in
            ``stats["fan_changes"]``; pictures show its edges. It needs the tiling "incremental",
            which "auto" is for points.
        max_events: maximum number of reported events; None for no limit.
        max_seconds: time limit in seconds of wall-clock time; None for no limit. It holds in any
            thread, from the construction on. A run that reaches it between two events can go on
            in a `copy`; one that is interrupted within an event, a quarter of a second later,
            cannot.
        max_memory: maximum memory of the process, in bytes; None for no limit.
        proof: a new folder for proofs (docs/proofs.md): one for each part of the run between two
            changes of motions, ``1.proof`` with ``1.scene.json``, and so on. The last part ends
            with a contact, at the end of the time span, or by `end_proof`. A copy, or a
            restored simulation, writes none.
        record: whether the run is remembered, for `history` and `draw`. Each change of motions
            takes time linear in the number of bodies. A copy, or a restored simulation, remembers
            nothing.

    Raises:
        BudgetExceeded: if the time or memory is used up before the run begins.
        InputError: if the scene is none, the tiling does not exist or does not support the bodies
            or the fan, a bound is not a number >= 0, or the folder contains proofs or cannot be
            made.
    """

    def __init__(
        self,
        scene: Scene,
        *,
        tiling: str = "auto",
        exact_only: bool = False,
        fan: bool = False,
        max_events: int | None = None,
        max_seconds: float | None = None,
        max_memory: int | None = None,
        proof: str | Path | None = None,
        record: bool = False,
    ) -> None:
        a_scene(scene)
        budget = Budget(max_events, max_seconds, max_memory)
        observers = [] if proof is None else [extension("proofs of a simulation")(proof)]
        log = Log(scene) if record else None
        self._run = begin(
            scene, tiling, budget, exact_only=exact_only, fan=fan, observers=observers, log=log
        )
        self._spaces = SpaceCache()

    def __repr__(self) -> str:
        bodies = counted(len(self.scene.bodies), "body")
        ended = ", at a contact" if self.contact is not None else ""
        return f"<Simulation of {bodies}, tiling {self.name}, t = {float(self.now)!r}{ended}>"

    @property
    def contact(self) -> Contact | None:
        """The contact that has ended the run, or None; no time passes after it."""
        return self._run.contact

    @property
    def contacts(self) -> int:
        """Number of contacts so far."""
        return self._run.contacts

    @property
    def scene(self) -> Scene:
        """The bodies with their current motions; the scene starts at the last change of motion."""
        return self._run.mutable.scene

    @property
    def name(self) -> str:
        """The name of the tiling."""
        return self._run.mutable.name

    @property
    def now(self) -> AlgebraicNumber:
        """The current time."""
        return self._run.mutable.now

    @property
    def kinetic(self) -> Tiling | None:
        """The kinetic tiling, for `exactpt.render`; None if bodies touch at the start.

        At a contact it is the tiling just before.
        """
        return self._run.mutable.tiling

    @property
    def stats(self) -> dict[str, object]:
        """The counts of the run so far, and the rules of the tiling and why they were chosen.

        docs/howto/simulation.md#statistics explains the keys.
        """
        mutable = self._run.mutable
        data = report(mutable.scene, mutable.tiling)
        if mutable.tiling is not None:
            data |= rules_of(mutable.tiling, is_auto=mutable.choice.requested == AUTO)
        return data | {"contacts": self.contacts, "plans": mutable.changes}

    # Time

    def run(
        self,
        until: Rational | None = None,
        *,
        on_contact: Callable[[Self, Contact], object] | None = None,
        margin: Rational | None = None,
    ) -> Iterator[RunEvent]:
        """Process the events up to and including a time, by default the end of the span.

        Yields every event after it has been processed. Without ``on_contact`` the first contact is
        the last event. With it, the simulation returns to a rational time just before each contact
        and calls ``on_contact`` with itself and the `Contact`. If that changes anything
        (`set_motion`, `set_motions`, `add`, `remove`), the run continues, until the same contact
        recurs while its bodies still have the same motions; otherwise it ends at the contact.

        Args:
            until: the last time, rational.
            on_contact: the response, which may change motions: bounce, stop or slide.
            margin: maximum distance in time between the callback and the contact; by default
                about 2^-80 of the time span. The callback happens at the last multiple of the
                margin before the contact, whose numbers are short; or later, if another event
                happens between that time and the contact.

        Raises:
            BudgetExceeded: if ``max_events``, ``max_seconds`` or ``max_memory`` is exceeded.
            InputError: if the margin is not positive, or ``until`` is before now.
        """
        respond = None if on_contact is None else partial(on_contact, self)
        return self._run.events(until, respond, margin)

    def step(self) -> list[RunEvent]:
        """Process the events of the next time at which there are any.

        Returns:
            The events; an empty list after the last one, and then the current time is the end.

        Raises:
            BudgetExceeded: if ``max_events``, ``max_seconds`` or ``max_memory`` is exceeded.
        """
        return self._run.step()

    def run_to_contact(self) -> Contact | None:
        """Return the first contact in the time span, or None; the fastest way to find it.

        Raises:
            BudgetExceeded: if ``max_events``, ``max_seconds`` or ``max_memory`` is exceeded.
        """
        return self._run.to_contact()

    def reached(self) -> Fraction | None:
        """Return a rational time, at most now, up to which there is provably no contact.

        As `passed`, but the time now if that is rational, and no contact.
        """
        return self._run.reached()

    def passed(self) -> Fraction | None:
        """Return a rational time such that there is provably no contact from the start to it.

        The interval is closed: with a contact at t = 3, the time is less than 3. It is None if
        bodies touch at the start. It is computed at once, even in the middle of an event.
        """
        return self._run.driver.contact_free_until()

    def end_proof(self) -> None:
        """Write the proof of the part since the last change of motions, and none from now on.

        The part ends now; or, if that time is irrational, between the event now and the one
        before. There is nothing to do after a contact, and at the end of the time span.

        Raises:
            InputError: if a file cannot be written.
        """
        self._run.end_record()

    # Changes of motions and bodies

    def body(self, name: str) -> Body:
        """Return the body of a given name, with its current motion.

        Raises:
            InputError: if there is none.
        """
        return self._run.mutable.body(name)

    def set_motion(self, body: str, motion: Motion | Body) -> None:
        """Give a body another motion from now on, see `set_motions`."""
        self.set_motions({body: motion})

    def set_motions(self, motions: Mapping[str, Motion | Body]) -> None:
        """Give bodies other motions from now on; the current time must be rational.

        Only certificates that involve these bodies are recomputed. (The tiling is rebuilt once if
        it is the one for convex bodies and a body need not stay convex.) The events caused are the
        first ones of the next `run`.

        Args:
            motions: by name of the body, a motion of its shape; or a body of the same name and
                number of vertices, if its shape changes in another way.

        Raises:
            InputError: if a body does not exist, a vertex would jump (the message names both
                positions), or now is not rational or is the end of the time span.
        """
        self._run.change(lambda mutable: mutable.set_motions(motions))

    def add(self, body: Body) -> None:
        """Add a body at the current time, which must be rational; it becomes the last one.

        Only the faces of the tiling that it intersects are changed, after a walk to them; in the
        mixed tiling also the geodesics of bodies in whose relative hulls it lies. The
        tiling of points is rebuilt in O(n log n); so is the one for convex bodies, once, if
        the new body need not stay convex.

        Raises:
            InputError: if its name is taken, it is not simple, it touches another body, or now is
                not rational or is the end of the time span.
        """
        self._run.change(lambda mutable: mutable.add(body))

    def remove(self, body: str) -> None:
        """Remove a body at the current time, which must be rational.

        The last body of the scene takes its index. Only the faces incident to it are changed, and
        the convex hull if the body is on it; in the mixed tiling also the geodesics that bend
        around it. The tiling of points is rebuilt in O(n log n).

        Raises:
            InputError: if the body does not exist, or now is not rational or is the end of the time
                span.
        """
        self._run.change(lambda mutable: mutable.remove(body))

    # Questions

    def space(self, at: Rational | None = None) -> FreeSpace:
        """Return the free space at a time, for any number of queries; built in O(n log n).

        Args:
            at: a rational time, from now to before the next event; by default now.

        Raises:
            InputError: if no time is given and now is not rational, if the time is not between
                now and the next event, or if the run has ended with a contact.
        """
        self._check_tiling()
        with self._run.alone:
            self._run.check_whole()
            return self._spaces.space(self._run.mutable.kinetic, at)

    def _check_tiling(self) -> None:
        """Refuse a question about the tiling when the run has ended with a contact."""
        if self.contact is not None:
            raise InputError(f"no tiling: {why_no_tiling(self.contact)}")

    def snapshot(self) -> Snapshot:
        """Return the tiling at the current time, which must be rational.

        Raises:
            InputError: see `space`.
        """
        return self.space().snapshot

    @property
    def tiling(self) -> Snapshot:
        """The tiling now: ``simulation.tiling.faces``, ``simulation.tiling.diagonals``.

        At an irrational time of an event it is the tiling just after the event, and its ``at`` and
        the coordinates of its nodes are of type `AlgebraicNumber`, computed when they are read.

        >>> import exactpt
        >>> p = exactpt.Body("p", [(0, 0)], exactpt.Translation([0, 1], [0, 0, "1/2"]))
        >>> places = {"q": (-1, 3), "r": (1, 5), "s": (7, 4), "t": (3, 1)}
        >>> others = [exactpt.Body(name, [place]) for name, place in places.items()]
        >>> simulation = exactpt.Simulation(exactpt.Scene([p, *others], time=(0, 4)))
        >>> for _ in range(2): events = simulation.step()
        >>> tiling = simulation.tiling
        >>> tiling.at.polynomial, tiling.nodes[0].x == tiling.at, len(tiling.faces)
        ((-5, 1, 1), True, 3)

        Raises:
            InputError: if the run has ended with a contact.
        """
        self._check_tiling()
        if not self.now.simplified().is_rational:
            with self._run.alone:
                self._run.check_whole()
                return self._spaces.tiling_just_after(self._run.mutable.kinetic)
        return self.snapshot()

    def locate(self, point: PointLike) -> Place:
        """Return the location of a point now, see `FreeSpace.locate`."""
        return self.space().locate(point)

    def ray_cast(self, origin: PointLike, direction: PointLike) -> Hit | None:
        """Return the first point of a ray that belongs to a body now, see `FreeSpace.ray_cast`."""
        return self.space().ray_cast(origin, direction)

    def is_free(self, p: PointLike, q: PointLike) -> bool:
        """Return True if no body intersects a segment now, see `FreeSpace.is_free`."""
        return self.space().is_free(p, q)

    def path(self, start: PointLike, goal: PointLike) -> answers.ShortestPath:
        """Return a shortest path of its homotopy class now, see `FreeSpace.path`."""
        return self.space().path(start, goal)

    def shortest_path(self, start: PointLike, goal: PointLike) -> answers.ShortestPath:
        """Return a shortest path of all now, see `FreeSpace.shortest_path`."""
        return self.space().shortest_path(start, goal)

    def shorten(self, walk: Sequence[PointLike]) -> answers.ShortestPath:
        """Return the shortest path homotopic to a polyline now, see `FreeSpace.shorten`."""
        return self.space().shorten(walk)

    def hull(self) -> list[VertexName]:
        """Return the vertices on the convex hull of all bodies now, see `FreeSpace.hull`."""
        return self.space().hull()

    def relative_hull(self, body: str) -> list[VertexName]:
        """Return the shortest loop around a body now, see `FreeSpace.relative_hull`."""
        return self.space().relative_hull(body)

    def neighbours(self, body: str) -> list[str]:
        """Return the bodies connected to a body by a diagonal now, see `FreeSpace.neighbours`."""
        return self.space().neighbours(body)

    # The past

    def history(self) -> History:
        """Return the whole run so far; ``history().scene()`` is it as one exact scene.

        Raises:
            InputError: if the run is not remembered (``record=True``).
        """
        if self._run.log is None:
            raise InputError("the run is not remembered: Simulation(..., record=True) does that")
        return self._run.log.history(self.now, self.contact)

    def draw(
        self,
        path: str | Path,
        *,
        theme: str = "auto",
        seconds: Rational | None = None,
        fps: int | None = None,
    ) -> None:
        """Draw the simulation into a file: now (.svg, .png), or the whole run so far.

        An animation (.html) or film (.gif, .mp4) of the run, which must be remembered
        (``record=True``), has the contacts, new motions, arrivals and departures on its ruler.
        The edges of the fan, if it is maintained (``fan=True``), are dashed.

        Args:
            path: the file; it is complete or not there.
            theme: "light", "dark" or "auto" (the reader's preference; PNG and films: light).
            seconds: the length of a film (8), before its last frame stays for a second.
            fps: frames of a film in a second (20).

        Raises:
            InputError: if the suffix is unknown, a library is missing, the run is not
                remembered, or no time has passed.
        """
        draw = extension("drawing of a simulation")
        draw(self, Path(path), theme=theme, seconds=seconds, fps=fps)

    def _repr_html_(self) -> str | None:
        """Return the animation of a recorded run, for notebooks; None if there is a picture."""
        return None if self._run.log is None else extension("player of a simulation")(self)

    def _repr_svg_(self) -> str:
        """Return a picture of the tiling at the current time, or of the contact, for notebooks."""
        return str(extension("picture of a simulation")(self))

    # Saving and copying

    def save(self, path: str | Path) -> None:
        """Write the simulation as JSON, exactly; the file is complete or not there.

        After `restore` the same events follow, byte for byte, as without the interruption. Bounds
        on events, seconds and memory are not saved.

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
        max_memory: int | None = None,
        max_bytes: int | None = None,
    ) -> Simulation:
        """Return the simulation that `save` has written.

        Args:
            path: the file.
            max_events: maximum number of events reported from now on; None for no limit.
            max_seconds: time limit in seconds of wall-clock time; None for no limit.
            max_memory: maximum memory of the process, in bytes; None for no limit.
            max_bytes: maximum size of the file, which is refused otherwise; by default 10^8.

        Raises:
            InputError: if it is not a saved simulation, has been changed since (its checksum
                differs), or is of another version.
        """
        from exactpt.simulation.store import reading, scene_from_json

        budget = Budget(max_events, max_seconds, max_memory)
        with budget.held(), reading(Path(path), max_bytes) as data:
            return _with_state(data, scene_from_json(data["scene"]), budget)

    def copy(self) -> Simulation:
        """Return an independent copy of the simulation, in memory.

        The same events follow in both. The rest of the bounds is copied too.
        `copy.copy`, `copy.deepcopy` and `pickle` give the same result.
        """
        return copy(self)

    def to_json(self) -> dict[str, object]:
        """Return the JSON data that `save` writes."""
        from exactpt.simulation.saved_run import run_to_json
        from exactpt.simulation.store import sealed

        with self._run.alone:
            return sealed(run_to_json(self._run, scene_to_json(self.scene)))

    def __reduce__(self) -> tuple[object, ...]:
        from exactpt.simulation.saved_run import run_to_json

        with self._run.alone:
            return _resumed, (run_to_json(self._run, None), self.scene, *self._run.rest())


def _resumed(
    data: dict[str, Any],
    scene: Scene,
    max_events: int | None,
    max_seconds: float | None,
    max_memory: int | None = None,
) -> Simulation:
    """Return the simulation that was copied or pickled."""
    from exactpt.kernel.stored import Stored

    budget = Budget(max_events, max_seconds, max_memory)
    with budget.held():
        return _with_state(Stored(data, "state of a simulation"), scene, budget)


def _with_state(data: Stored, scene: Scene, budget: Budget) -> Simulation:
    """Return the simulation of a scene, with the state that `Simulation.to_json` has written."""
    from exactpt.simulation.saved_run import run_from_json

    self = Simulation.__new__(Simulation)
    self._run = run_from_json(data, scene, budget)
    self._spaces = SpaceCache()
    return self
