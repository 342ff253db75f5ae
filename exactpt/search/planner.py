"""First contacts of one shape among obstacles, for many motions: obstacles are prepared once."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from typing import Final, final

from exactpt.brief import counted
from exactpt.errors import InputError
from exactpt.kernel.numbers import Rational, shorten, show
from exactpt.motion.body import Body
from exactpt.motion.motions import Motion
from exactpt.motion.outline import is_rigid
from exactpt.motion.shape import VertexLike
from exactpt.pair.contact import Contact
from exactpt.scene.scene import Scene
from exactpt.search.features_sweep import PairsSearch
from exactpt.search.obstacles import ActiveInterval, Obstacles
from exactpt.search.query import Selection
from exactpt.search.sweep_search import SweepSearch

NAME: Final = "shape"
"""The name of a shape that is given by its vertices."""


@final
class Planner:
    """Obstacles among which one shape moves: the first contact of each of many motions.

    >>> from exactpt import Body, Planner, Translation
    >>> planner = Planner([Body("wall", [(4, -5), (5, -5), (5, 5), (4, 5)])], time=(0, 10))
    >>> box = [(0, 0), (2, 0), (2, 1), (0, 1)]
    >>> slow, fast = planner.first_contacts(box, [Translation([0, "1/8"]), Translation([0, 1])])
    >>> slow, fast.time
    (None, AlgebraicNumber('2'))

    Obstacles are validated once. They may move; their contacts with each other, and of one with
    itself, are ignored.

    Args:
        obstacles: bodies of different names.
        time: the start and the end of all motions.

    Raises:
        InputError: see `exactpt.Scene`.
    """

    def __init__(self, obstacles: Iterable[Body], time: Sequence[Rational] = (0, 1)) -> None:
        self._scene = Scene(obstacles, time)
        self._obstacles = Obstacles(self._scene)

    def __repr__(self) -> str:
        count, span = len(self._scene.bodies), (self._scene.exact_start, self._scene.exact_end)
        start, end = map(show, span)
        return f"<Planner among {counted(count, 'obstacle')}, t in [{start}, {end}]>"

    def __reduce__(self) -> tuple[object, ...]:
        return Planner, (self._scene.bodies, (self._scene.start, self._scene.end))

    def first_contact(self, shape: Body | Iterable[VertexLike], motion: Motion) -> Contact | None:
        """Return the first contact of a shape with an obstacle or with itself, or None.

        The result is that of `exactpt.first_contact` for the scene of the obstacles and the
        shape as its last body, apart from contacts without the shape.

        Args:
            shape: vertices as of a `Body`, or a body: its own motion does not count.
            motion: its motion.

        Raises:
            InputError: if the shape is not a simple polygon or chain at the start, the motion
                jumps, or an obstacle has its name.
        """
        return self.first_contacts(shape, [motion])[0]

    def first_contacts(
        self, shape: Body | Iterable[VertexLike], motions: Iterable[Motion]
    ) -> list[Contact | None]:
        """Return the `first_contact` of a shape for each of some motions.

        Raises:
            InputError: see `first_contact`.
        """
        given = shape if isinstance(shape, Body) else Body(NAME, shape)
        at_rest = given.with_errors()  # they are about a pivot that the motions need not have
        if any(body.name == at_rest.name for body in self._scene.bodies):
            raise InputError(f"body {shorten(at_rest.name)}: the name is taken by an obstacle")
        if not isinstance(motions, Iterable):
            raise InputError(f"motions: a list of them is needed, not {shorten(motions)}")
        return [self._first(at_rest.with_motion(motion)) for motion in motions]

    def _first(self, body: Body) -> Contact | None:
        scene = self._scene
        Scene([body], (scene.start, scene.end))
        prepared = self._obstacles.with_body(body)
        if prepared is not None:
            rows, near = prepared
            planned = scene.going_on((*scene.bodies, body), scene.exact_start)
            return SweepSearch(planned, rows, [near]).run_to_contact()
        if scene.has_radius or body.exact_radius or not is_rigid(body):  # boxes are those of cores
            whole = ActiveInterval(
                scene.exact_start, scene.exact_end, list(range(len(scene.bodies)))
            )
            return self._first_during(body, [whole])
        return self._first_during(body, self._obstacles.active_intervals(body))

    def _first_during(self, body: Body, intervals: Iterable[ActiveInterval]) -> Contact | None:
        """Return the first contact of a body with obstacles, searched while these are near."""
        scene = self._scene
        for interval in intervals:
            obstacles = [scene.bodies[i] for i in interval.obstacles]
            names = [obstacle.name for obstacle in obstacles]
            part = scene.going_on((*obstacles, body), interval.start).until(interval.end)
            apart = Selection.of_groups(part.bodies, [range(len(obstacles))])
            contact = PairsSearch(part, selection=apart, ignoring_self=names).run_to_contact()
            if contact is not None:
                return contact
        return None
