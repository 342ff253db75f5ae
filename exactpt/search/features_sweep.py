"""The first contact without a tiling: a sweep over slabs of time with swept bounding boxes.

Within a slab only a vertex and an edge whose swept boxes intersect can touch. A float filter looks
for the first zero of their orientation; exact arithmetic decides the undecided cases,
and whether the vertex lies on the edge at that time. The length of a slab adapts to the number
of candidate pairs, so that few pairs are tested in more than one slab.

No certificate is kept from one slab to the next, and the search knows nothing about the free
space: for a single first contact in a sparse scene neither is needed.
"""

from __future__ import annotations

import heapq
import math
import time as clock
from collections.abc import Collection
from fractions import Fraction
from typing import Final, final

import numpy as np

from exactpt.cached_property import cached_property
from exactpt.certificates.certifier import Certifier
from exactpt.certificates.coincidence import lies_on
from exactpt.certificates.incidences import touches
from exactpt.certificates.queue import EventTime
from exactpt.errors import BudgetExceeded
from exactpt.indices import Triple
from exactpt.kernel.algebraic import AlgebraicNumber
from exactpt.kernel.budget import check_budget, deadline_in, searching
from exactpt.kernel.counters import Counters
from exactpt.kernel.doubles import Flags, Floats, Indices
from exactpt.kernel.numbers import QQ, fraction
from exactpt.motion.slabs import Near
from exactpt.motion.swept_edges import SweptEdges
from exactpt.motion.tileable import are_tileable
from exactpt.motion.track import Incidence
from exactpt.pair.contact import Contact, contact_of
from exactpt.pair.start import initial_touches, near_at_start
from exactpt.pair.straight import Earliest, LinearContact
from exactpt.scene.scene import Scene, scene_of
from exactpt.search.approach_search import ApproachSearch
from exactpt.search.far_spins import bodies_near_others
from exactpt.search.query import Selection

FEW: Final = 64
"""Number of pairs that are compared exactly before a tiling would have been built."""


@final
class PairsSearch:
    """A search for the first contact.

    Two bodies of which one has a radius touch where the distance of their cores is the sum of the
    radii (`ApproachSearch`); a body with a radius does not touch itself, nor does one with rings
    that touch: it keeps its shape.

    Args:
        scene: the bodies, their motions and the time span.
        exact_only: whether exact arithmetic decides everything, without the float filters.
        max_seconds: time limit, in seconds; None for no limit.
        selection: the pairs that count, none of them by its name; by default all but those that
            the scene ignores.
        ignoring_self: names of bodies whose contacts with themselves are ignored.

    Attributes:
        name: the name of the tiling: None.
        certificates: number of orientations whose first zero has been computed.
    """

    name = None

    def __init__(
        self,
        scene: Scene,
        *,
        exact_only: bool = False,
        max_seconds: float | None = None,
        selection: Selection | None = None,
        ignoring_self: Collection[str] = (),
    ) -> None:
        self._given = scene
        chosen = Selection(scene) if selection is None else selection
        if not exact_only:
            near = bodies_near_others(scene)
            if len(near) < len(scene.bodies):
                chosen = chosen.of_bodies(near)
                scene = scene_of(
                    [scene.bodies[i] for i in near], scene.exact_start, scene.exact_end
                )
        self._scene = scene
        self._selection = chosen
        self._exact_only = exact_only
        self._deadline = deadline_in(max_seconds)
        self._counters = Counters()
        has_radius = [body.exact_radius > 0 for body in scene.bodies]
        self._has_radius: Flags = np.array(has_radius, dtype=np.bool_)
        alone = [
            body.name in ignoring_self or bool(body.exact_ring_touches) for body in scene.bodies
        ]
        self._ignores_self: Flags = np.array(alone, dtype=np.bool_)
        self.certificates = 0
        self._passed: QQ | None = None

    @property
    def stats(self) -> dict[str, object]:
        """The counts of the search so far, see docs/format.md."""
        return {
            "bodies": len(self._given.bodies),
            "vertices": self._given.vertex_count,
            "events": 0,
            "certificates": self.certificates,
            "skipped": 0,
            "exact": self._counters.exact,
            "filtered": self._counters.filtered,
        }

    def contact_free_until(self) -> Fraction | None:
        """See `Search.contact_free_until`."""
        return None if self._passed is None else fraction(self._passed)

    @property
    def lacks_boxes(self) -> bool:
        """True if a tiling is expected to decide less exactly: many vertices have no boxes.

        Such a vertex is compared with all edges, and its edges with all vertices. The tiling
        has about three certificates for each vertex.
        """
        scene = self._scene
        if not scene.bodies or not are_tileable(scene.bodies) or not self._selection.is_all:
            return False
        all_vertices, ids = self._swept.vertices.all, self._swept.ids
        count = len(ids)
        unknown = sum(math.isnan(all_vertices[v].float_track.x0) for v in ids)
        return 2 * unknown * count > 3 * count + FEW

    def run_to_contact(self) -> Contact | None:
        """Return the first contact in the closed time span of the scene; None if there is none.

        Raises:
            BudgetExceeded: when the time limit is reached; its ``reached`` is a time up to which
                no contact exists.
        """
        with searching(self._deadline, self.contact_free_until):
            return self._first_contact()

    def _first_contact(self) -> Contact | None:
        scene = self._scene
        touches, initial_pairs = initial_touches(scene, self._near_at_start())
        if initial_pairs:
            return contact_of(scene, AlgebraicNumber(scene.exact_start), touches, initial_pairs)
        found = self.first_after_start() if scene.bodies else None
        return None if found is None else contact_of(scene, found.number, found.touches)

    def _near_at_start(self) -> list[tuple[int, int]] | None:
        """Return the pairs that count and may touch at the start; None if every pair counts."""
        scene, selection = self._scene, self._selection
        if selection.is_all:
            return None

        def counts(first: Indices, second: Indices) -> Flags:
            return ~selection.ignored(first, second)

        return list(near_at_start(scene, [body.exact_radius for body in scene.bodies], counts))

    @cached_property
    def _swept(self) -> SweptEdges:
        """The vertices and edges with their boxes, in the first pieces of motion at first."""
        scene = self._scene
        swept = SweptEdges(scene.bodies, scene.exact_start, scene.exact_end)
        self._counters = swept.vertices.counters
        return swept

    def first_after_start(self) -> LinearContact | None:
        """Return the first contact of bodies that are disjoint at the start, slab by slab."""
        self._passed = self._scene.exact_start
        approaches = self._approaches
        for now, later, near in self._swept.slabs(self._near):
            if self._deadline is not None and clock.monotonic() > self._deadline:
                raise BudgetExceeded("time limit exceeded", fraction(now))
            sharp, rounded = self._split(near)
            best: Earliest[Incidence] = Earliest()
            for found in (
                self._search(now, later, sharp),
                approaches and approaches.first(now, later, rounded),
            ):
                if found is not None:
                    best.add(*found)
            if best.time is not None:
                return LinearContact(best.time, best.found)
            self._passed = later
        return None

    @cached_property
    def _approaches(self) -> ApproachSearch | None:
        """The search for contacts of bodies with a radius; None if none has one."""
        scene = self._scene
        if not scene.has_radius:
            return None
        radii = [body.exact_radius for body in scene.bodies]

        def squared(i: int, j: int) -> QQ:
            return (radii[i] + radii[j]) ** 2

        def apart(i: Indices, j: Indices) -> Flags:
            watched: Flags = (self._has_radius[i] | self._has_radius[j]) & (i != j)
            watched &= ~self._selection.ignored(i, j)
            return watched

        return ApproachSearch(scene, squared, radii, apart, self._swept)

    def _split(self, near: Near) -> tuple[Near, Near]:
        """Return pairs of a vertex and an edge of bodies without radius, and all others."""
        v, e = near
        if self._approaches is None:
            return near, (v[:0], e[:0])
        swept = self._swept
        rounded = self._has_radius[swept.body[v]] | self._has_radius[swept.body[swept.ends[e, 0]]]
        return (v[~rounded], e[~rounded]), (v[rounded], e[rounded])

    def _near(self, now: QQ, later: QQ) -> Near:
        """Return candidate pairs in a slab: vertices and edges whose swept boxes intersect."""
        boxes = self._swept.during(now, later)
        vs, es = [], []
        for v, e in self._swept.meeting(boxes, self._swept.around(boxes)):
            may = self._may_touch(v, e, boxes) & ~self._swept.move_together(v, e, later)
            vs.append(v[may])
            es.append(e[may])
        if self._approaches is not None:
            v, e = self._approaches.near(now, later)
            vs.append(v)
            es.append(e)
        return np.concatenate(vs), np.concatenate(es)

    def _may_touch(self, v: Indices, e: Indices, boxes: Floats) -> Flags:
        """For each pair, whether the vertex can start to touch the edge.

        It cannot if both belong to one rigid body, or are ignored. A vertex
        is not paired with its own edges, except with the edge that starts at it if the boxes of
        that edge's ends coincide: the edge may shrink to a point.
        """
        swept = self._swept
        a, b = swept.ends[e, 0], swept.ends[e, 1]
        i, j = swept.body[v], swept.body[a]
        rigid = (i == j) & ~swept.deforms[i]
        p, q = boxes[a], boxes[b]
        meet = (np.maximum(p, q)[:, ::2] <= np.minimum(p, q)[:, 1::2]).all(axis=1)
        lasts = (v == b) | ((v == a) & ~meet)
        ignored = self._selection.ignored(i, j) | ((i == j) & self._ignores_self[i])
        rounded = self._has_radius[i] | self._has_radius[j]
        may: Flags = ~(rigid | ignored | lasts | rounded)
        return may

    def _ignores(self, i: int, j: int) -> bool:
        return bool(self._ignores_self[i]) if i == j else self._selection.ignores(i, j)

    def _search(self, now: QQ, later: QQ, near: Near) -> LinearContact | None:
        """Return the first contact in (now, later] of bodies without radius."""
        if not len(near[0]):
            return None
        vertices, ids, ends = self._swept.vertices, self._swept.ids, self._swept.ends
        certifier = Certifier(vertices, now, later, exact_only=self._exact_only)
        a, b = ends[near[1]].T
        a = np.where(near[0] == a, b, a)  # an edge that may shrink to a point, and its vertex
        numbers = np.array(ids)
        triples: list[Triple] = list(
            zip(*(numbers[i].tolist() for i in (a, near[0], b)), strict=True)
        )
        self.certificates += len(triples)
        zeros = certifier.orientations_of_any(triples)
        pending: list[tuple[float, int, EventTime, Triple]] = [
            (time.low, k, time, triples[k]) for k, (_, time) in enumerate(zeros) if time is not None
        ]
        heapq.heapify(pending)
        best: AlgebraicNumber | None = None
        best_high = float("inf")
        while pending and pending[0][0] <= best_high:
            check_budget()
            _, k, time, triple = heapq.heappop(pending)
            certifier.move_to(time, [time])
            a, v, b = (vertices.all[i] for i in triple)
            if not lies_on(certifier, v, a, b):
                _, following = certifier.orientation(*triple)
                if following is not None:
                    heapq.heappush(pending, (following.low, k, following, triple))
                continue
            number = certifier.exact_now
            if number.compare_rational(later) <= 0 and (best is None or number.compare(best) < 0):
                best, best_high = number, time.high
        if best is None:
            return None
        certifier.move_to(EventTime(*vertices.normalization.enclosure(best), -1, -1, -1, best), [])
        # All incidences at that time are among the candidates of this slab: pairs excluded by
        # `_may_touch` cannot start to touch.
        features = sorted({*near[0].tolist(), *ends[near[1]].ravel().tolist()})
        found = touches(certifier, vertices, [ids[i] for i in features])
        return LinearContact(best, [t for t in found if not self._ignores(t.body, t.other)])
