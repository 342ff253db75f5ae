"""The moving vertices of a scene, on which every tiling is built.

Each body becomes a counter-clockwise ring of vertices, with the body on the left of its
edges. So that every ring encloses an interior, degenerate bodies get an infinitesimal one
(`exactpt.motion.infinitesimal`). Contacts are decided without it.
"""

from __future__ import annotations

from collections.abc import Sequence
from itertools import accumulate, count
from typing import TYPE_CHECKING, Final, final

import numpy as np
from librt.vecs import append, vec
from mypy_extensions import i32, i64

from exactpt.filters.rounding import INFINITY
from exactpt.indices import VertexId
from exactpt.kernel.budget import check_budget
from exactpt.kernel.counters import Counters
from exactpt.kernel.doubles import items, native
from exactpt.kernel.numbers import QQ
from exactpt.motion.convexity import stays_convex
from exactpt.motion.enclosures import Enclosures
from exactpt.motion.float_track import FloatTrack
from exactpt.motion.infinitesimal import displacements
from exactpt.motion.linear_rows import LinearRows, linear_rows
from exactpt.motion.normalization import Normalization, normalization_for
from exactpt.motion.ring_order import ring_indices
from exactpt.motion.vertex import MovingBody, Vertex, VertexList, unused

if TYPE_CHECKING:
    from exactpt.motion.body import Body

__all__ = ["HORIZON", "MOTION", "OTHER_MOTION", "WIDTH", "MovingBody", "Vertices"]

MANY: Final = 20
"""Number of bodies from which on their vertices are made in numpy, if they allow it."""
FEW: Final = 64
"""Number of bodies from one look at the budget to the next."""
WIDTH: Final[i64] = 8
"""Number of doubles of a vertex in `Vertices.places`: a line of a processor's cache."""
HORIZON: Final[i64] = 4
MOTION: Final[i64] = 5
"""Place of the number of the motion among them, see `FloatTrack.motion`."""
OTHER_MOTION: Final[float] = -2.0
"""Number of the motion of all vertices that `Vertices.places` does not describe alone."""
UNUSED: Final[list[float]] = [0.0, 0.0, 0.0, 0.0, 0.0, OTHER_MOTION, 0.0, 0.0]
"""The doubles of a vertex that no body has."""


@final
class Vertices:
    """The rings of all bodies.

    Args:
        bodies: the bodies with their current motions.
        rings: for each body, the ids of its ring, each with its vertex in the scene.
        since: the time at which each body entered its piece.
        normalization: that of the run.
        end: the end of the time span.
        free: the unused ids, left by removed bodies; the last one is used first.
        plain: whether rings have no infinitesimal copies, and so no displacements.

    Attributes:
        all: the vertices, by id. Later bodies use the ids of removed ones again.
        bodies: the moving bodies, in the order of the scene.
        counters: the counts of decisions about these vertices.
        normalization: that of the enclosures.
        enclosures: the enclosures of the trajectories.
        places: for each id `WIDTH` doubles: the coefficients x0, y0, x1, y1 of `FloatTrack`; the
            horizon, a double at least ``until`` of the body, normalised, infinite if that is None;
            the number of the motion. The latter is `OTHER_MOTION` unless the vertex is in linear
            translation, without infinitesimal copies, and so without other coefficients than
            these. An addition of a body may move the vector.
        next_ids, previous_ids: of each id, those of its neighbours on its ring, -1 if unused; an
            addition of a body may move these vectors too.
        changes: how often trajectories have changed, or bodies been added or removed.
    """

    def __init__(
        self,
        bodies: Sequence[Body],
        rings: Sequence[Sequence[tuple[VertexId, int]]],
        since: Sequence[QQ],
        normalization: Normalization,
        end: QQ,
        free: Sequence[VertexId] = (),
        *,
        plain: bool = False,
    ) -> None:
        self.counters: Counters = Counters()
        self.normalization: Normalization = normalization
        self.enclosures: Enclosures = Enclosures(normalization)
        self.changes: int = 0
        self._plain: bool = plain
        self._end: QQ = end
        n = sum(map(len, rings)) + len(free)
        self.all: VertexList = VertexList([], vec[i32](), vec[i32]())
        for v in range(n):
            self.all.append(unused(VertexId(v)))
        empty, none = UNUSED * n, [i32(-1)] * n
        self.places: vec[float] = vec[float](empty)
        self.next_ids: vec[i32] = vec[i32](none)
        self.previous_ids: vec[i32] = vec[i32](none)
        self.bodies: list[MovingBody] = []
        self._free: list[VertexId] = list(free)
        for k, (ring, t) in enumerate(zip(rings, since, strict=True)):
            self._add(bodies, k, ring, t)

    @classmethod
    def of(cls, bodies: Sequence[Body], start: QQ, end: QQ, *, plain: bool = False) -> Vertices:
        """Return the rings of bodies from a time on.

        With ``plain`` they are the vertices of the scene as they are, without infinitesimal
        copies, and no interior is tiled.
        """
        rows = None if plain or len(bodies) < MANY else linear_rows(bodies, start, end)
        if rows is not None:
            return cls._of_rows(bodies, rows, start, end)
        ids = count()
        rings = [
            [(VertexId(next(ids)), index) for index in ring_indices(body, start, plain=plain)]
            for body in bodies
        ]
        corners = [p for body in bodies for p in body.exact_piece_after(start).corners(start)]
        normalization = normalization_for(corners or [(QQ(0), QQ(0))], start, end)
        self = cls(bodies, rings, [start] * len(bodies), normalization, end, plain=plain)
        for i, moving in enumerate(self.bodies):
            moving.is_tiled = not plain and self._may_pinch(i, start, end)
        return self

    @classmethod
    def _of_rows(cls, bodies: Sequence[Body], rows: LinearRows, start: QQ, end: QQ) -> Vertices:
        """Return the rings of polygons in linear translation, from their coefficients in numpy."""
        self = cls([], [], [], rows.normalization, end)
        self.changes = len(bodies)
        motions = self.enclosures.begin_linear(rows.velocities, rows.error)
        first, sizes = rows.offsets[:-1], np.diff(rows.offsets)
        ids = np.arange(len(rows.indices), dtype=np.int32)
        owners = np.repeat(np.arange(len(bodies), dtype=np.int32), native(sizes))
        places = np.zeros((len(ids), int(WIDTH)))
        places[:, :4] = rows.coefficients
        places[:, HORIZON], places[:, MOTION] = INFINITY, motions[owners]
        self.places = vec[float](items(places))
        ahead, behind = np.roll(ids, -1), np.roll(ids, 1)
        ahead[rows.offsets[1:] - 1], behind[first] = first, rows.offsets[1:] - 1
        self.next_ids, self.previous_ids = vec[i32](items(ahead)), vec[i32](items(behind))
        for i, (v, size) in enumerate(zip(first.tolist(), sizes.tolist(), strict=True)):
            if i % FEW == 0:
                check_budget()
            moving = MovingBody(bodies, i, v, size)
            moving.place, moving.since, moving.is_polygon = i, start, True
            moving.enclosures = self.enclosures
            self.bodies.append(moving)
        indices = vec[i32](items(rows.indices.astype(np.int32)))
        self.all = VertexList(self.bodies[:], vec[i32](items(owners)), indices)
        return self

    def add(self, body: Body, t: QQ) -> int:
        """Add a body as the last one, at a rational time; returns its number."""
        i, indices = len(self.bodies), ring_indices(body, t)
        while len(self._free) < len(indices):
            new = VertexId(len(self.all))
            self._free.insert(0, new)
            self.all.append(unused(new))
            self.next_ids, self.previous_ids = (
                append(self.next_ids, -1),
                append(self.previous_ids, -1),
            )
            for value in UNUSED:
                self.places = append(self.places, value)
        ring = [(self._free.pop(), index) for index in indices]
        self._add([body], 0, ring, t)
        self.bodies[i].is_tiled = self._may_pinch(i, t, self._end)
        return i

    def remove(self, i: int) -> None:
        """Remove a body; the last body takes over its number.

        Its vertices, which events may keep, and the unused ones in their places have its name.
        """
        self.changes += 1
        self.bodies[i].place = -1
        for v in reversed(self.bodies[i].ring):
            removed, self.all[v] = self.all[v], unused(v)
            self.all[v].moving, self.all[v].index = removed.moving, removed.index
            self._set_place(v)
            self._free.append(v)
        last = self.bodies.pop()
        if i < len(self.bodies):
            self.bodies[i] = last
            last.place = i

    def _add(
        self, bodies: Sequence[Body], k: int, ring: Sequence[tuple[VertexId, int]], t: QQ
    ) -> None:
        """Add body k of a sequence as the last one."""
        i, body = len(self.bodies), bodies[k]
        moving = MovingBody(bodies, k)
        moving.place, moving.ring = i, [v for v, _ in ring]
        moving.is_polygon = body.has_interior and not body.has_rings
        moving.enclosures = self.enclosures
        self.bodies.append(moving)
        for v, index in ring:
            self.all[v] = Vertex(v, index, moving)
        for part in moving.rings:
            for behind, here in zip(part, [*part[1:], part[0]], strict=True):
                self.next_ids[behind] = i32(here)
                self.previous_ids[here] = i32(behind)
        self.enter_piece(i, t)

    def ahead(self, v: VertexId) -> VertexId:
        """Return the next vertex on the ring of a vertex."""
        return VertexId(i64(self.next_ids[v]))

    def behind(self, v: VertexId) -> VertexId:
        """Return the vertex before a vertex on its ring."""
        return VertexId(i64(self.previous_ids[v]))

    @property
    def free(self) -> list[VertexId]:
        """The unused ids, left by removed bodies; the last one is used first."""
        return self._free

    def ids(self) -> list[VertexId]:
        """Return the ids in use, body by body."""
        return [v for moving in self.bodies for v in moving.ring]

    def nodes(self) -> list[int]:
        """For each id, the number of its vertex in the scene, over all bodies; -1 if unused."""
        first = list(accumulate((moving.body.size for moving in self.bodies), initial=0))
        return [first[v.body] + v.index if v.body >= 0 else -1 for v in self.all]

    def _may_pinch(self, i: int, start: QQ, end: QQ) -> bool:
        """Return True if the interior of a body must be tiled from a time on."""
        body, ring = self.bodies[i].body, self.bodies[i].ring
        if body.has_rings:
            return self._ever_deforms(i, start)
        return (
            body.size > 3
            and body.closed
            and self._ever_deforms(i, start)
            and not stays_convex(body, [self.all[v].index for v in ring], start, end)
        )

    def _ever_deforms(self, i: int, start: QQ) -> bool:
        """Return True if a body deforms in its current piece or any later one."""
        body = self.bodies[i].body
        return self.bodies[i].deforms or self._deforms_in_pieces(
            body, body.exact_breakpoints_between(start, self._end)
        )

    def _deforms_in_pieces(self, body: Body, starts: Sequence[QQ]) -> bool:
        """Return True if a body deforms in one of the pieces that begin at these times."""
        return any(_deforms(self.enclosures.of_piece(body.exact_piece_after(t))) for t in starts)

    def begins_inside(self, i: int, body: Body, t: QQ) -> bool:
        """Return True if a motion requires a tiling of an interior that is not tiled yet.

        Args:
            i: the number of the body.
            body: the body with its new motion.
            t: the time from which it holds.
        """
        starts = [t, *body.exact_breakpoints_between(t, self._end)]
        is_tiled = self.bodies[i].is_tiled
        return body.has_rings and not is_tiled and self._deforms_in_pieces(body, starts)

    def enter_piece(self, i: int, t: QQ) -> None:
        """Give the vertices of a body the trajectories valid just after a rational time."""
        self.changes += 1
        moving = self.bodies[i]
        piece = moving.enter(t)
        moving.deforms = _deforms(moving.float_tracks)
        if not self._plain and not moving.body.has_interior and len(moving.ring) > 1:
            end = self._end if piece.until is None else min(piece.until, self._end)
            moved = displacements(piece.tracks, t, end)
            for vertex_id, offset in zip(moving.ring, moved.directions, strict=True):
                self.all[vertex_id].offset = offset
            if moved.until is not None and moved.until < end:
                moving.until = moved.until
        horizon = INFINITY if moving.until is None else self.normalization.time(moving.until)[1]
        for vertex_id in moving.ring:
            self._set_place(vertex_id, horizon)

    def _set_place(self, v: VertexId, horizon: float = INFINITY) -> None:
        """Copy the trajectory of a vertex to `places`."""
        vertex, places, at = self.all[v], self.places, WIDTH * v
        float_track = vertex.float_track
        places[at] = float_track.x0
        places[at + 1] = float_track.y0
        places[at + 2] = float_track.x1
        places[at + 3] = float_track.y1
        places[at + HORIZON] = horizon
        is_linear = float_track.degree <= 1 and not float_track.ws and vertex.offset is None
        is_used = vertex.body >= 0
        places[at + MOTION] = float(float_track.motion) if is_linear and is_used else OTHER_MOTION

    def set_motion(self, i: int, body: Body, t: QQ, end: QQ) -> bool:
        """Replace a body by one with the same position at a rational time.

        A body whose interior is tiled stays so, whatever its motion.

        Returns:
            Whether its interior has to be tiled from now on, and is not yet.
        """
        moving = self.bodies[i]
        moving.replace(body)
        self.enter_piece(i, t)
        tiled, moving.is_tiled = moving.is_tiled, moving.is_tiled or self._may_pinch(i, t, end)
        if self.enclosures.motion_count > 2 * len(self.all) + 64:
            self.enclosures.forget_motions({self.motion_of(v.id) for v in self.all})
        return moving.is_tiled and not tiled

    def motion_of(self, v: VertexId) -> int:
        """Return the number of the motion of a vertex, see `FloatTrack.motion`."""
        motion = self.places[WIDTH * v + MOTION]
        return self.all[v].float_track.motion if motion == OTHER_MOTION else int(motion)

    def name(self, vertex_id: VertexId) -> str:
        """Return the name of a vertex in event logs, see `Vertex.name`."""
        return self.all[vertex_id].name


def _deforms(float_tracks: Sequence[FloatTrack]) -> bool:
    first = float_tracks[0].motion
    return first < 0 or any(float_track.motion != first for float_track in float_tracks)
