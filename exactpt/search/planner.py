"""First contacts of one shape among obstacles, for many motions: obstacles are prepared once."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from typing import Final, final

from librt.vecs import vec

from exactpt.brief import counted
from exactpt.cached_property import cached_property
from exactpt.errors import InputError
from exactpt.kernel.numbers import Rational, shorten, show
from exactpt.motion.body import Body
from exactpt.motion.motions import Motion, Translation
from exactpt.motion.shape import VertexLike
from exactpt.pair.contact import Contact
from exactpt.scene.scene import Scene
from exactpt.search.reading import Rows, rows_of_scene
from exactpt.search.sweep import Pairs, boxes_during, pairs_with_others
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
        self._spare: list[Rows] = []  # copies of the rows of the obstacles that are not in use

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
        found: list[Contact | None] = []
        is_valid = False
        for motion in motions:
            body = at_rest.with_motion(motion)
            if not (is_valid and isinstance(motion, Translation)):
                Scene([body], (self._scene.start, self._scene.end))
                is_valid = isinstance(motion, Translation)  # others keep it as simple
            found.append(self._first(body))
        return found

    def _first(self, body: Body) -> Contact | None:
        scene = self._scene
        try:
            rows = self._spare.pop()  # another thread may have taken the last one
        except IndexError:
            rows = self._rows.copy()
        planned = scene.going_on((*scene.bodies, body), scene.exact_start)
        with rows.with_body(body):
            pairs = PairsWithLast(rows, self._boxes)
            contact = SweepSearch(planned, rows, pairs).run_to_contact()
        self._spare.append(rows)
        return contact

    @cached_property
    def _rows(self) -> Rows:
        """The rows of all obstacles."""
        rows = rows_of_scene(self._scene).copy()
        rows.make_all_pieces()
        return rows

    @cached_property
    def _boxes(self) -> vec[float]:
        """The boxes of these rows during the whole time span."""
        return boxes_during(self._rows.table, self._rows.span.low, self._rows.span.high)


@final
class PairsWithLast:
    """The pairs of rows of the last body with the others, and with itself.

    Args:
        rows: the rows.
        boxes: the boxes of the rows of the other bodies, during the whole time span.
    """

    def __init__(self, rows: Rows, boxes: vec[float]) -> None:
        self._table = rows.table
        self._boxes = boxes

    def during(self, low: float, high: float) -> Pairs:
        """See `exactpt.search.sweep_search.PairsDuring`."""
        return pairs_with_others(self._table, self._boxes, low, high)

    def first_length(self, span: float) -> float:
        """See `exactpt.search.sweep_search.PairsDuring`: all at once."""
        return span
