"""The first contact of bodies that all move straight, piece by piece.

Each piece of a body's motion is a `MotionPiece`. Pieces whose boxes intersect while both last are
compared in the order in which their boxes intersect, up to the first contact.
"""

from __future__ import annotations

import math
import time as clock
from collections.abc import Iterable, Sequence
from fractions import Fraction
from typing import TYPE_CHECKING, final

from exactpt.errors import BudgetExceeded
from exactpt.kernel.algebraic import AlgebraicNumber
from exactpt.kernel.budget import check_budget, deadline_in, searching
from exactpt.kernel.numbers import QQ, fraction, isqrt
from exactpt.motion.body import Body
from exactpt.motion.outline import Straight
from exactpt.motion.track import Incidence, renumbered
from exactpt.pair.contact import Contact, contact_of
from exactpt.pair.straight import (
    Candidate,
    Earliest,
    LinearContact,
    Span,
    earliest,
    first_incidence,
    span_of,
)
from exactpt.scene.scene import Scene, scene_of
from exactpt.search.pieces import (
    FEW,
    LARGE,
    ContactDistance,
    Distance,
    MotionPiece,
    ScenePieces,
    are_large,
    contact_distance,
    linear_pieces,
)
from exactpt.search.query import Selection
from exactpt.search.straight_filter import candidates_of, window

if TYPE_CHECKING:
    from exactpt.search.features_sweep import PairsSearch


@final
class LinearSearch:
    """A search for the first contact of bodies that all move straight.

    Args:
        scene: the bodies, their motions and the time span.
        pieces: the pieces of the bodies.
        selection: the pairs that count; by default all but those that the scene ignores.
        max_seconds: time limit, in seconds; None for no limit.

    Attributes:
        name: the name of the tiling: None.
    """

    name = None
    lacks_boxes = False

    def __init__(
        self,
        scene: Scene,
        pieces: ScenePieces,
        selection: Selection | None = None,
        max_seconds: float | None = None,
    ) -> None:
        self._scene = scene
        self._pieces = pieces
        self._selection = Selection(scene) if selection is None else selection
        self._deadline = deadline_in(max_seconds)
        self._search = _Search(contact_distance, self._deadline)
        self._is_apart = False  # whether it is known that no two bodies touch at the start

    @property
    def stats(self) -> dict[str, object]:
        """The counts of the search so far, see docs/format.md: pairs of pieces are decided."""
        search = self._search
        return {
            "bodies": len(self._scene.bodies),
            "vertices": self._scene.vertex_count,
            "events": 0,
            "certificates": search.exact + search.filtered,
            "skipped": 0,
            "exact": search.exact,
            "filtered": search.filtered,
        }

    def contact_free_until(self) -> Fraction | None:
        """Return the end of a closed interval from the start on without contact; None if none is.

        A pair of pieces that has not been compared does not touch before its boxes intersect.
        """
        if not self._is_apart:
            return None
        start, low = self._scene.exact_start, self._search.low
        before = math.nextafter(low, -math.inf)
        return fraction(max(start, QQ(before)) if math.isfinite(before) else start)

    def run_to_contact(self) -> Contact | None:
        """Return the first contact in the closed time span of the scene; None if there is none.

        Raises:
            BudgetExceeded: if the time or memory of this thread, or of the search, is used up.
        """
        with searching(self._deadline, self.contact_free_until):
            return self._first_contact()

    def _first_contact(self) -> Contact | None:
        scene = self._scene
        near = [(i, j) for i, j in self._pieces.near_at_start() if self._counts(i, j)]
        if near:
            from exactpt.pair.start import initial_touches

            touches, initial_pairs = initial_touches(scene, near)
            if initial_pairs:
                return contact_of(scene, AlgebraicNumber(scene.exact_start), touches, initial_pairs)
        self._is_apart = True
        found = self._search.run(self._pieces.near(self._counts))
        return None if found is None else contact_of(scene, found.number, found.touches)

    def _counts(self, i: int, j: int) -> bool:
        return i != j and self._selection.counts(i, j)


def pair_search(
    scene: Scene,
    *,
    exact_only: bool = False,
    selection: Selection | None = None,
    max_seconds: float | None = None,
) -> LinearSearch | PairsSearch:
    """Return the search over pairs: for linear motion if all bodies are linear.

    Args:
        scene: the bodies, their motions and the time span.
        exact_only: whether exact arithmetic decides everything, without the float filters.
        selection: the pairs that count, none of them by its name; by default all but those that
            the scene ignores.
        max_seconds: time limit, in seconds; None for no limit.
    """
    pieces = None if exact_only else scene_pieces_if_linear(scene)
    if pieces is not None:
        return LinearSearch(scene, pieces, selection, max_seconds)
    from exactpt.search.features_sweep import PairsSearch

    return PairsSearch(scene, exact_only=exact_only, max_seconds=max_seconds, selection=selection)


def scene_pieces_if_linear(scene: Scene, margin: float = 0.0) -> ScenePieces | None:
    """Return the pieces of all bodies; None unless all of them move straight.

    None too if no two bodies are compared vertex by vertex, as all are large. If the pieces are
    more than a few, their boxes are grown by a margin.
    """
    if _are_all_large(scene):
        return None
    if len(scene.bodies) > FEW:
        from exactpt.search.scene_pieces import pieces_on_demand

        pieces = pieces_on_demand(scene, margin)
        if pieces is not None:
            return pieces
    linear = linear_pieces(scene)
    return (
        None
        if linear is None
        else ScenePieces.of(linear, scene.exact_start, scene.exact_end, margin)
    )


def _are_all_large(scene: Scene) -> bool:
    """Return True if any two bodies are large: then one sweep over all features is faster."""
    others = len(scene.bodies) - 1
    # All but the smallest body have more than sqrt(LARGE) vertices, if any two are large.
    if others < 1 or scene.vertex_count <= others * isqrt(LARGE):
        return False
    smallest, next_one, *_ = sorted(body.size for body in scene.bodies)
    return are_large(smallest, next_one)


def first_among_pieces(
    pieces: ScenePieces, distance: Distance = contact_distance
) -> LinearContact | None:
    """Return the first contact after the start of bodies that are disjoint at the start.

    Args:
        pieces: of all bodies, their boxes grown by at least half of the distance less the radii.
        distance: the distance of the cores at which bodies touch.
    """
    return _Search(distance).run(pieces.near())


class _Search:
    """The first contact among the pieces compared so far.

    Args:
        distance: the distance of the cores at which bodies touch.
        deadline: the time on the clock after which the search ends; None for no limit.

    Attributes:
        best: the contact.
        low: no two pieces touch before it.
        filtered, exact: numbers of the pairs compared that the filter decides, and of the others.
    """

    def __init__(self, distance: Distance, deadline: float | None = None) -> None:
        self._distance = distance
        self._deadline = deadline
        self._spans: dict[tuple[QQ, QQ], Span] = {}
        self.best: Earliest[Incidence] = Earliest()
        self._enter = -math.inf
        self.filtered = self.exact = 0

    @property
    def low(self) -> float:
        """A double such that no two pieces touch before it."""
        best = self.best.number
        return min(self._enter, math.inf if best is None else best.enclosure()[0])

    def run(self, pairs: Iterable[tuple[float, MotionPiece, MotionPiece]]) -> LinearContact | None:
        """Compare pairs of pieces in the order of the times before which they do not touch."""
        for enter, a, b in pairs:
            check_budget()
            if self._deadline is not None and clock.monotonic() > self._deadline:
                raise BudgetExceeded("time limit exceeded", None)
            if enter > self.best.high:
                break
            self._enter = enter
            self.compare(a, b)
        best = self.best.time
        return None if best is None else LinearContact(best, self.best.found)

    def compare(self, a: MotionPiece, b: MotionPiece) -> None:
        """Compare two pieces."""
        start = max(a.start, b.start)
        end = min(a.end, b.end)
        if start >= end:
            return
        span = self._spans.get((start, end))
        if span is None:
            span = self._spans[start, end] = span_of(start, end)
        distance = self._distance(a, b)
        nearest = 0.0 if distance is None else distance.nearest
        if are_large(a.straight.body.size, b.straight.body.size):
            self._compare_large(a, b, span, distance)
            return
        candidates = candidates_of(a.straight, b.straight, span, self.best.high, nearest)
        if not candidates:
            self.filtered += 1
            return
        self.exact += 1
        met = first_of_candidates(a.straight, b.straight, span, candidates, distance)
        if met is not None:
            self.best.add(met.time, renumbered(met.touches, a.body, b.body))

    def _compare_large(
        self, a: MotionPiece, b: MotionPiece, span: Span, distance: ContactDistance | None
    ) -> None:
        """Compare two pieces of large bodies, while their boxes meet."""
        reach = 0.0 if distance is None else distance.nearest
        latest = min(span.high, self.best.high)
        low, high = window(a.straight, b.straight, span.low, latest, reach)
        start = max(span.start, QQ(low))  # if it is low, boxes do not meet yet
        end = min(self.best.until(span.end), QQ(high))
        if start >= end:
            self.filtered += 1
            return
        self.exact += 1
        met = first_of_large((a.straight.body, b.straight.body), start, end, distance)
        if met is not None:
            self.best.add(met.time, renumbered(met.touches, a.body, b.body))


def first_of_candidates(
    a: Straight,
    b: Straight,
    span: Span,
    candidates: Sequence[Candidate],
    distance: ContactDistance | None = None,
) -> LinearContact | None:
    """Return the first contact of two bodies in (start, end], exactly, from its candidates.

    Args:
        a: a body.
        b: another body; the two are disjoint at the start, or farther apart than the distance.
        span: the start and the end.
        candidates: as `candidates_of` returns them.
        distance: the contact distance of the cores; None if it is 0.
    """
    if distance is None:
        return first_incidence(a, b, span, candidates)
    return first_at_distance((a.body, b.body), *span[:2], candidates, distance.squared)


def first_of_large(
    bodies: tuple[Body, Body], start: QQ, end: QQ, distance: ContactDistance | None
) -> LinearContact | None:
    """Return the first contact of two large bodies in (start, end], by a sweep over features.

    Args:
        bodies: two bodies; they are disjoint at the start, or farther apart than the distance.
        start: the start.
        end: the end.
        distance: the contact distance of the cores; None if it is 0.
    """
    scene = scene_of(bodies, start, end)
    if distance is None:
        from exactpt.search.features_sweep import PairsSearch

        return PairsSearch(scene).first_after_start()
    from exactpt.kernel.square_root import root_above
    from exactpt.search.approach_search import ApproachSearch

    squared, half = distance.squared, root_above(distance.squared) / 2
    return ApproachSearch(scene, lambda _i, _j: squared, [half, half]).run()


def first_at_distance(
    bodies: tuple[Body, Body],
    start: QQ,
    end: QQ,
    candidates: Iterable[Candidate],
    squared: QQ,
) -> LinearContact | None:
    """Return the first time in (start, end] at which candidates are at a distance, exactly.

    Args:
        bodies: two bodies, farther apart than the distance at the start.
        start: the start; from there on each body is in one piece of its motion.
        end: the end.
        candidates: in the order of their earliest times. Of vertices and edges alone, if the
            distance is 0.
        squared: the square of the distance.
    """
    from exactpt.pair.features import FeaturePair
    from exactpt.pair.pieces_of_two import segments_of

    pieces = [body.exact_piece_after(start) for body in bodies]
    begin = AlgebraicNumber(start)

    def first(touch: Incidence, until: QQ) -> tuple[AlgebraicNumber, Incidence] | None:
        i, vertex, j, edge, other = touch
        ends = (other,) if edge < 0 else segments_of(bodies[j])[edge]
        pair = FeaturePair(touch, pieces[i].track(vertex), tuple(map(pieces[j].track, ends)))
        time = pair.first_time(squared, begin, until)
        return None if time is None else (time, pair.touch_at(time, ends))

    return earliest(candidates, first, end)
