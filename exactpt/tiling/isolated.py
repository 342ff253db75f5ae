"""Isolated events: an angle of vertices in linear translation that fails alone, by doubles.

An event is processed here if doubles decide all of it before anything changes: that it is the
only first one, that no contact is there, that no angle beside it is straight, and which edge
slides. Otherwise it is left to the engine. The signs after it may still be left open by the
filter, or be violated: `CertifiedMesh.certify` decides them exactly, and the engine repairs.
"""

from __future__ import annotations

from typing import Final, final

from exactpt.certificates.certificate import ANGLE, kind_of, part_of
from exactpt.certificates.positions import K, cross_sign, linear_position
from exactpt.certificates.queue import EventQueue
from exactpt.indices import HalfEdge, VertexId
from exactpt.motion.vertices import MOTION, OTHER_MOTION, WIDTH
from exactpt.planar.halfedge import twin
from exactpt.pseudotriangulation.mesh import OUTER
from exactpt.tiling.angles import CertifiedMesh
from exactpt.tiling.clock import Clock
from exactpt.tiling.events import Log
from exactpt.tiling.rules import Rules

LEFT: Final[int] = 0
DONE: Final[int] = 1
OPEN: Final[int] = 2


@final
class IsolatedEvents:
    """The isolated events of a tiling whose rules allow it (`Rules.slides_are_plain`)."""

    def __init__(
        self, certified: CertifiedMesh, queue: EventQueue, clock: Clock, log: Log, rules: Rules
    ) -> None:
        self._certified: CertifiedMesh = certified
        self._queue: EventQueue = queue
        self._clock: Clock = clock
        self._log: Log = log
        self._rules: Rules = rules
        self._errors: list[float] = certified.certifier.errors
        self._middle: float = 0.0
        self._width: float = 0.0

    def step(self, until: float) -> int:
        """Process the next event if it is isolated.

        Args:
            until: a normalised time; later events are left.

        Returns:
            `LEFT` if the event is left, and nothing has changed; `DONE` if it is processed;
            `OPEN` if `Repairs.repair_all` has to follow.
        """
        certified, queue = self._certified, self._queue
        table = certified.table
        if table.flat or table.angles or certified.checks_rigid:
            return LEFT
        slot = queue.first_alone(until)
        if slot < 0 or kind_of(slot) != ANGLE:
            return LEFT
        h = HalfEdge(part_of(slot))
        m = certified.mesh.map
        before, after = m.previous[h], m.following[h]
        if m.following[m.following[after]] == h:  # a triangle: a contact, or a convex vertex
            return LEFT
        time = queue.time_of(slot)
        self._middle, self._width = 0.5 * (time.low + time.high), time.high - time.low
        counted, bent = self._bent(after), -1
        if counted >= 0:
            bent = self._bent(before)
        if bent < 0:
            return LEFT
        moves = self._choose(h, before)
        if moves == 0:
            return LEFT
        certified.certifier.counters.filtered += counted + bent + abs(moves) - 1
        queue.take_first(slot)
        self._clock.enter(time, [(slot, time)])
        self._slide(h, before, origin_moves=moves > 0)
        return self._recertify(h, before, origin_moves=moves > 0)

    def _choose(self, h: HalfEdge, before: HalfEdge) -> int:
        """Choose the edge that slides: as `may_touch` and `Repairs`, by doubles.

        Returns:
            0 if the event is left to the engine. Otherwise the number of filtered signs plus 1,
            positive if the origin of h moves, negative if the target of the edge before it does.
        """
        mesh = self._certified.mesh
        origin, places = mesh.map.origin, self._certified.vertices.places
        a, p, b = origin[before], origin[h], origin[h ^ 1]
        if (
            places[WIDTH * a + MOTION] == OTHER_MOTION
            or places[WIDTH * p + MOTION] == OTHER_MOTION
            or places[WIDTH * b + MOTION] == OTHER_MOTION
        ):
            return 0
        stays_before, stays_after = mesh.boundary[before >> 1], mesh.boundary[h >> 1]
        if mesh.corner[h]:
            order = self._order(p, a, b)  # whether a is between p and b, or b between p and a
            signs = 2 * abs(order) - 1  # `may_touch` and `_repair_corner` both count them
            if order == 0 or (stays_after if order > 0 else stays_before):
                return 0
            return signs if order > 0 else -signs
        if stays_before and stays_after:
            return 0
        order = self._order(a, p, b)
        if order <= 0:
            return 0
        return order if stays_before else -order

    def _order(self, u: VertexId, v: VertexId, w: VertexId) -> int:
        """Return the order of three vertices on a line.

        Returns:
            The number of filtered signs plus 1; positive if v lies between u and w, negative if
            not; 0 if doubles do not decide it.
        """
        ux, uy, ue = self._position(u)
        vx, vy, ve = self._position(v)
        wx, wy, we = self._position(w)
        first, second = _sign(vx - ux, ue + ve), 0
        signs = 1
        if first != 0:
            signs += 1
            second = _sign(wx - vx, ve + we)
        if second == 0:
            first = _sign(vy - uy, ue + ve)
            if first != 0:
                signs += 1
                second = _sign(wy - vy, ve + we)
        if second == 0:
            return 0
        return signs + 1 if first == second else -signs - 1

    def _bent(self, g: HalfEdge) -> int:
        """Return -1 if an angle may be straight; otherwise the number of filtered signs, 0 or 1."""
        m = self._certified.mesh.map
        a, p, b = m.origin[m.previous[g]], m.origin[g], m.origin[g ^ 1]
        if a == b:
            return 0
        places = self._certified.vertices.places
        of_a, of_p, of_b = (
            places[WIDTH * a + MOTION], places[WIDTH * p + MOTION], places[WIDTH * b + MOTION]
        )  # fmt: skip
        if OTHER_MOTION in (of_a, of_p, of_b):
            return -1
        if not (of_a == of_p and of_p == of_b and of_a >= 0.0):
            return 0
        x, y, d = self._position(a)
        px, py, dp = self._position(p)
        bx, by, db = self._position(b)
        return 1 if cross_sign(px - x, py - y, d + dp, bx - x, by - y, d + db) != 0 else -1

    def _position(self, v: VertexId) -> tuple[float, float, float]:
        """Return x and y of a vertex at the time of the event, and a bound on their errors."""
        places, errors, i = self._certified.vertices.places, self._errors, WIDTH * v
        return linear_position(
            places[i], places[i + 1], places[i + 2], places[i + 3],
            self._middle, self._width, errors[0], errors[1],
        )  # fmt: skip

    def _slide(self, h: HalfEdge, before: HalfEdge, *, origin_moves: bool) -> None:
        """Slide an edge, as `Repairs` does, and record it."""
        mesh = self._certified.mesh
        origin, region = mesh.map.origin, mesh.region
        a, p, b = origin[before], origin[h], origin[h ^ 1]
        if mesh.corner[h]:
            kind = "hull" if mesh.is_hull(h if origin_moves else before) else "corner"
            mesh.collapse_corner(h, origin_moves=origin_moves)
        else:
            kind = "hull" if region[h] == OUTER else "reflex"
            mesh.straighten(h, origin_moves=origin_moves)
        if origin_moves:
            self._log.slide(kind, p, b, a)
        else:
            self._log.slide(kind, p, a, b)

    def _recertify(self, h: HalfEdge, before: HalfEdge, *, origin_moves: bool) -> int:
        """Certify the five angles that a slide has changed; return `DONE` or `OPEN`."""
        certified, rules = self._certified, self._rules
        following = certified.mesh.map.following
        if origin_moves:
            e0, e1, e2, e3, e4 = h, following[h], twin(h), before, following[before]
        else:
            t = twin(before)
            e0, e1, e2, e3, e4 = before, following[before], h, t, following[t]
        certified.certify_five(e0, e1, e2, e3, e4)
        if rules.only_angles and not certified.table.angles:
            stats = self._log.stats
            stats.most = max(stats.most, len(self._queue))
            return DONE
        changed = [e0, e1, e2, e3, e4]
        certified.failure_group.clear()
        certified.failure_group.begin_repair()
        certified.failure_group.touch(changed)
        rules.changed(changed)
        return OPEN


def _sign(difference: float, error: float) -> int:
    """Return the sign of a rounded difference of coordinates with these errors, 0 if unknown."""
    bound = error + K * abs(difference)
    return 1 if difference > bound else -1 if difference < -bound else 0
