"""The first contact of bodies that all move straight, piece by piece.

Each body is a row per piece of its motion. Rows whose boxes meet while both last are compared
in the order in which their boxes meet, up to the first contact.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Collection, Iterable, Iterator, Sequence
from itertools import combinations
from typing import TYPE_CHECKING, Final, NamedTuple, TypeAlias, final

from exactpt.errors import BudgetExceeded
from exactpt.kernel.algebraic import AlgebraicNumber
from exactpt.kernel.budget import ask
from exactpt.kernel.numbers import QQ, enclosing_floats
from exactpt.motion.incidence import Touch
from exactpt.motion.outline import Straight, straight_pieces
from exactpt.pairs.contact import Contact, contact_of
from exactpt.pairs.filters import window
from exactpt.pairs.rational import Meeting, Span, algebraic, compare, double_above, span_of
from exactpt.pairs.selection import groups_of
from exactpt.pairs.start import initial_touches
from exactpt.pairs.two_pieces import ContactDistance, first_meeting
from exactpt.scene.scene import Scene

if TYPE_CHECKING:
    from exactpt.pairs.scene_pieces import SceneRows

__all__ = [
    "MOST_VERTICES",
    "FewRows",
    "Row",
    "StraightSearch",
    "Touching",
    "first_of_pairs",
    "first_touching",
    "rows_during",
    "rows_of",
    "straight_rows",
    "window_of",
]

FEW: Final = 10
"""Maximum number of rows of which all pairs are compared without numpy."""
MOST_VERTICES: Final = 64
"""Maximum number of vertices of a body for which comparing two bodies vertex by vertex pays."""


class Row(NamedTuple):
    """A body in one piece of its motion.

    Attributes:
        body: its number.
        straight: its motion.
        start, end: the piece, within the span of the search.
    """

    body: int
    straight: Straight
    start: QQ
    end: QQ


class Touching(NamedTuple):
    """The first contact of some bodies: its time and all incidences at that time."""

    time: QQ | AlgebraicNumber
    touches: list[Touch]

    @property
    def number(self) -> AlgebraicNumber:
        """The time."""
        return algebraic(self.time)


@final
class StraightSearch:
    """A search for the first contact of bodies that all move straight.

    Args:
        scene: the bodies, their motions and the time span.
        rows: the rows of the bodies.
        ignoring: groups of body names; contacts within a group are ignored.

    Attributes:
        name: the name of the tiling: None.
    """

    name = None

    def __init__(
        self, scene: Scene, rows: FewRows | SceneRows, ignoring: Iterable[Collection[str]] = ()
    ) -> None:
        self._scene = scene
        self._rows = rows
        self._group = groups_of(scene, ignoring)

    @property
    def stats(self) -> dict[str, object]:
        """The sizes of the scene."""
        scene = self._scene
        return {"bodies": len(scene.bodies), "vertices": scene.vertex_count, "events": 0}

    def passed(self) -> None:
        """No time up to which there is no contact is known before the end of the search."""

    def run_to_contact(self) -> Contact | None:
        """The first contact in the closed time span of the scene; None if there is none.

        Raises:
            BudgetExceeded: if the time or memory of this thread is used up.
        """
        scene, rows = self._scene, self._rows
        near = [(i, j) for i, j in rows.near_at_start() if self._counts(i, j)]
        if near:
            touches, overlaps = initial_touches(scene, near)
            if overlaps:
                return contact_of(scene, AlgebraicNumber(scene._start), touches, overlaps)
        try:
            found = first_of_pairs(
                (enter, rows[k], rows[l])
                for enter, k, l in rows.near()
                if self._counts(rows.body(k), rows.body(l))
            )
        except BudgetExceeded as spent:
            spent.reached = scene.start
            raise
        return None if found is None else contact_of(scene, found.number, found.touches)

    def _counts(self, i: int, j: int) -> bool:
        return self._group[i] != self._group[j]


@final
class FewRows:
    """The rows of a scene of which all pairs are compared, without numpy.

    Args:
        rows: the rows.
        start: the start of the scene.
    """

    def __init__(self, rows: Sequence[Row], start: QQ) -> None:
        self._rows = rows
        self._start = start

    def near_at_start(self) -> list[tuple[int, int]]:
        """The pairs i < j of bodies whose boxes meet at the start."""
        low, high = enclosing_floats(self._start)
        near: list[tuple[int, int]] = []
        for a, b in combinations([row for row in self._rows if row.start == self._start], 2):
            enter, leave = window_of(a, b, low, high)
            if not enter > leave:
                near.append((a.body, b.body))
        return near

    def near(self) -> Iterator[tuple[float, int, int]]:
        """All pairs of rows of two bodies, each with a time before which they do not touch."""
        for i, j in combinations(range(len(self._rows)), 2):
            if self.body(i) != self.body(j):
                yield -math.inf, i, j

    def body(self, k: int) -> int:
        """The body of a row."""
        return self._rows[k].body

    def __getitem__(self, k: int) -> Row:
        return self._rows[k]


def straight_rows(scene: Scene) -> FewRows | SceneRows | None:
    """The rows of all bodies; None unless all of them move straight and are not large."""
    if len(scene.bodies) > FEW:
        from exactpt.pairs.scene_pieces import scene_rows

        return scene_rows(scene)
    rows = rows_of(scene)
    if rows is None:
        return None
    if len(rows) > FEW:
        from exactpt.pairs.scene_pieces import boxed

        return boxed(scene, rows)
    return FewRows(rows, scene._start)


def rows_of(scene: Scene) -> list[Row] | None:
    """The rows of all bodies; None unless all of them move straight and are not large."""
    rows: list[Row] = []
    for i, body in enumerate(scene.bodies):
        ask()
        if body.size > MOST_VERTICES:
            return None
        pieces = straight_pieces(body)
        if pieces is None:
            return None
        rows += rows_during(i, pieces, scene._start, scene._end)
    return rows


def rows_during(
    body: int, pieces: Sequence[tuple[Straight, QQ | None]], start: QQ, end: QQ
) -> Iterator[Row]:
    """The rows of a body, of given pieces of motion, between two times."""
    since = start
    for straight, until in pieces:
        if until is None or until >= end:
            yield Row(body, straight, since, end)
            return
        if until > since:
            yield Row(body, straight, since, until)
            since = until


Distance: TypeAlias = "Callable[[Row, Row], ContactDistance | None]"
"""The distance at which two rows touch; None if it is 0."""


def contact_distance(a: Row, b: Row) -> ContactDistance | None:
    """Return the distance at which the cores of two bodies touch; None if it is 0."""
    r, s = a.straight.body._radius, b.straight.body._radius
    return ContactDistance.of((r + s) ** 2, r + s) if r or s else None


def first_touching(
    rows: Sequence[Row],
    start: QQ,
    end: QQ,
    distance: Distance = contact_distance,
    margin: float = 0.0,
) -> Touching | None:
    """The first contact in (start, end] of bodies that are disjoint at the start.

    Args:
        rows: of all bodies.
        start: the start.
        end: the end.
        distance: the distance of the cores at which bodies touch.
        margin: at least half of what the distance is more than the sum of the radii.
    """
    if len(rows) <= FEW:
        pairs = ((-math.inf, a, b) for a, b in combinations(rows, 2))
    else:
        from exactpt.pairs.boxes import near_rows

        pairs = ((enter, rows[i], rows[j]) for enter, i, j in near_rows(rows, start, end, margin))
    return first_of_pairs(((enter, a, b) for enter, a, b in pairs if a.body != b.body), distance)


def first_of_pairs(
    pairs: Iterable[tuple[float, Row, Row]], distance: Distance = contact_distance
) -> Touching | None:
    """The first contact of pairs of rows of two bodies that are disjoint when both begin.

    Args:
        pairs: two rows, and a time before which they do not touch; in the order of these times.
        distance: the distance of the cores at which bodies touch.
    """
    search = _Search(distance)
    for enter, a, b in pairs:
        ask()
        if enter > search.high:
            break
        search.compare(a, b)
    return search.best


class _Search:
    """The first contact among the rows compared so far.

    Attributes:
        best: the contact.
        high: a double at least its time.
    """

    def __init__(self, distance: Distance) -> None:
        self._distance = distance
        self._spans: dict[tuple[QQ, QQ], Span] = {}
        self.best: Touching | None = None
        self.high: float = math.inf

    def compare(self, a: Row, b: Row) -> None:
        """Compare two rows."""
        start = max(a.start, b.start)
        end = min(a.end, b.end)
        if start >= end:
            return
        span = self._spans.get((start, end))
        if span is None:
            span = self._spans[start, end] = span_of(start, end)
        met = first_meeting(a.straight, b.straight, span, self.high, self._distance(a, b))
        if met is None:
            return
        touches = list(_touches(met, a.body, b.body))
        order = -1 if self.best is None else compare(met.time, self.best.time)
        if self.best is None or order < 0:
            self.best, self.high = Touching(met.time, touches), double_above(met.time)
        elif order == 0:
            self.best.touches.extend(touches)


def window_of(a: Row, b: Row, low: float, high: float) -> tuple[float, float]:
    """Return the `window` of the boxes of two rows within their contact distance."""
    distance = contact_distance(a, b)
    nearest = 0.0 if distance is None else distance.nearest
    return window(a.straight, b.straight, low, high, nearest)


def _touches(met: Meeting, first: int, second: int) -> Iterator[Touch]:
    """The incidences of two bodies; one of two vertices once, the lower body first."""
    found: set[Touch] = set()
    for of_first, vertex, edge, end in met.incidences:
        body, other = (first, second) if of_first else (second, first)
        if end >= 0 and other < body:
            found.add(Touch(other, end, body, -1, vertex))
        else:
            found.add(Touch(body, vertex, other, edge, end))
    return iter(found)
