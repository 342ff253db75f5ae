"""The first contact of some pairs of bodies, or the first that is new.

Bodies that touch at the start come into a new contact when they touch after they have parted, or
when they begin to overlap (`exactpt.search.new`). Each pair whose swept boxes intersect is
searched alone, up to the best time so far.
"""

from __future__ import annotations

import time as clock
from collections.abc import Iterable
from typing import TypeAlias, final

from exactpt.errors import BudgetExceeded
from exactpt.kernel.algebraic import AlgebraicNumber
from exactpt.kernel.budget import GRACE, check_budget, within
from exactpt.kernel.numbers import QQ
from exactpt.motion.body import Body
from exactpt.motion.outline import may_touch_itself
from exactpt.motion.track import Incidence, renumbered
from exactpt.pair.contact import Contact, contact_of
from exactpt.pair.start import initial_touches, touches_at_distance
from exactpt.pair.straight import Earliest, span_of
from exactpt.scene.scene import Scene, scene_of
from exactpt.search.candidate_pairs import candidate_pairs
from exactpt.search.features_sweep import PairsSearch
from exactpt.search.new import new_contact_time
from exactpt.search.query import Selection
from exactpt.search.reading import straight_rows
from exactpt.search.sweep_search import first_of_two

Meeting: TypeAlias = "tuple[AlgebraicNumber, Iterable[Incidence]]"


@final
class SelectedSearch:
    """A search for the first contact of selected pairs.

    Args:
        scene: the bodies, their motions and the time span.
        after_start: whether bodies that touch at the start count only when they have parted
            and touch again, or begin to overlap.
        selection: the pairs that count; by default all but those that the scene ignores.
        exact_only: whether exact arithmetic decides everything, without the float filters.
        max_seconds: time limit, in seconds; None for no limit.

    Attributes:
        name: the name of the tiling: None.
        pairs: number of pairs of bodies that have been compared.
    """

    name = None
    lacks_boxes = False

    def __init__(
        self,
        scene: Scene,
        *,
        after_start: bool = False,
        selection: Selection | None = None,
        exact_only: bool = False,
        max_seconds: float | None = None,
    ) -> None:
        self._scene = scene
        self._after_start = after_start
        self._selection = Selection(scene) if selection is None else selection
        self._exact_only = exact_only
        self._deadline = None if max_seconds is None else clock.monotonic() + max_seconds
        self.pairs = 0

    @property
    def stats(self) -> dict[str, object]:
        """The counts of the search so far, see docs/format.md."""
        scene = self._scene
        return {
            "bodies": len(scene.bodies),
            "vertices": scene.vertex_count,
            "events": 0,
            "pairs": self.pairs,
        }

    def contact_free_until(self) -> None:
        """Before the end of the search, no time is known up to which bodies are apart."""

    def run_to_contact(self) -> Contact | None:
        """Return the first contact that counts in the closed time span; None if there is none.

        Raises:
            BudgetExceeded: when the time limit is reached.
        """
        with within(None if self._deadline is None else self._deadline + GRACE):
            try:
                return self._first_contact()
            except BudgetExceeded as spent:
                spent.reached = None  # bounds of one pair do not hold for all
                raise

    def _first_contact(self) -> Contact | None:
        scene, start = self._scene, AlgebraicNumber(self._scene.exact_start)
        pairs = self._candidates()
        touches, initial_pairs = initial_touches(scene, pairs)
        if initial_pairs and not self._after_start:
            return contact_of(scene, start, touches, initial_pairs)
        touching = set(initial_pairs)
        best: Earliest[tuple[tuple[int, ...], Iterable[Incidence]]] = Earliest()
        alone = [(i,) for i in self._self_touching()]
        for pair in (*sorted(touching), *(p for p in pairs if p not in touching), *alone):
            check_budget()
            self.pairs += 1
            until = best.until(scene.exact_end)
            meeting = self._renewed(*pair) if pair in touching else self._first(pair, until)
            if meeting is not None:
                best.add(meeting[0], [(pair, meeting[1])])
        if best.number is None:
            return None
        at_start = [(pair[0], pair[-1]) for pair, _ in best.found] if best.number == start else []
        return contact_of(scene, best.number, [t for _, some in best.found for t in some], at_start)

    def _candidates(self) -> list[tuple[int, int]]:
        """Return the pairs i < j of bodies that may come into a contact that counts."""
        named = self._selection.named
        if named is not None:
            return named
        return self._selection.of(candidate_pairs(self._scene, QQ(0)))

    def _self_touching(self) -> list[int]:
        """Return the bodies that may touch themselves."""
        if self._selection.named is not None:
            return []
        return [i for i, body in enumerate(self._scene.bodies) if may_touch_itself(body)]

    def _renewed(self, i: int, j: int) -> Meeting | None:
        """Return the first new contact of two bodies that touch at the start.

        It is looked for beyond the best time so far: at that time they may begin to overlap.
        """
        scene = self._scene
        a, b = scene.bodies[i], scene.bodies[j]
        if _move_together(a, b, scene.exact_start, scene.exact_end):
            return None
        time = new_contact_time(a, b, scene.exact_start, scene.exact_end)
        if time is None:
            return None
        part = scene_of((a, b), scene.exact_start, scene.exact_end)
        at_start = time.compare_rational(part.exact_start) == 0
        touches = (
            initial_touches(part)[0] if at_start else touches_at_distance(part, [(0, 1)], time)
        )
        return time, renumbered(touches, i, j)

    def _first(self, pair: tuple[int, ...], until: QQ) -> Meeting | None:
        """Return the first contact of a pair disjoint at the start, or of a body with itself."""
        scene = self._scene
        if until <= scene.exact_start:
            return None
        bodies = [scene.bodies[i] for i in pair]
        if len(pair) > 1 and not self._exact_only:
            rows = straight_rows(bodies, span_of(scene.exact_start, until))
            if rows is not None:
                met = first_of_two(rows)
                return None if met is None else (met.number, renumbered(met.touches, *pair))
        part = scene_of(bodies, scene.exact_start, until)
        alone = [body.name for body in part.bodies] if len(pair) > 1 else []
        search = PairsSearch(part, exact_only=self._exact_only, ignoring_self=alone)
        contact = search.run_to_contact()
        if contact is None:
            return None
        numbers = {scene.bodies[i].name: i for i in pair}
        return contact.time, contact.exact_incidences(numbers)


def _move_together(a: Body, b: Body, start: QQ, end: QQ) -> bool:
    """Return True if two bodies certainly keep their places relative to each other."""
    if a.exact_breakpoints_between(start, end) or b.exact_breakpoints_between(start, end):
        return False
    tracks = (*a.exact_piece_after(start).tracks, *b.exact_piece_after(start).tracks)
    motion = tracks[0].motion
    return motion is not None and all(track.motion == motion for track in tracks)
