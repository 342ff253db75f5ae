"""The moving vertices of a scene: what every tiling is built on.

Each body becomes a ring of vertices, counter-clockwise, with the body on the left of
its edges. So that every ring turns around an inside, thin bodies get an infinitesimal one
(`exactpt.motion.thin`). Contacts are decided without it.
"""

from __future__ import annotations

from collections.abc import Sequence
from itertools import accumulate, count
from typing import TYPE_CHECKING, Final, final

from exactpt.geometry.polygon import is_counter_clockwise
from exactpt.kernel.counters import Counters
from exactpt.kernel.numbers import QQ, ZZ
from exactpt.motion.convexity import stays_convex
from exactpt.motion.frame import Frame, frame_for
from exactpt.motion.image import Image
from exactpt.motion.thin import Offset, thin_offsets, thin_ring
from exactpt.motion.track import Track

if TYPE_CHECKING:
    from exactpt.motion.body import Body

__all__ = ["MovingBody", "Vertex", "Vertices"]

_NO_TRACK: Final = Track((), (), (ZZ(1),), None)
_NO_IMAGE: Final = Image([0.0], [0.0], [], -1)


@final
class Vertex:
    """A vertex of a ring.

    Attributes:
        id: its position in `Vertices.all`.
        body: the position of its body in the scene; -1 if it is unused.
        index: the vertex of the scene that it is (the copies of a thin body share it).
        track: its path until the body's next breakpoint.
        image: the track in doubles.
        offset: the direction of its infinitesimal offset; None unless the body is thin.
        ahead, behind: the ids of its neighbours on the ring.
        x, y, error: where it was when last asked for, in the frame, and a bound on the errors
            of both; ``seen`` says when that was (`exactpt.certificates.positions`).
    """

    __slots__ = (
        "ahead",
        "behind",
        "body",
        "error",
        "id",
        "image",
        "index",
        "offset",
        "seen",
        "track",
        "x",
        "y",
    )

    def __init__(self, vertex_id: int, body: int, index: int, track: Track, image: Image) -> None:
        self.id: int = vertex_id
        self.body: int = body
        self.index: int = index
        self.track: Track = track
        self.image: Image = image
        self.offset: Offset | None = None
        self.ahead: int = -1
        self.behind: int = -1
        self.x: float = 0.0
        self.y: float = 0.0
        self.error: float = 0.0
        self.seen: object = None


@final
class MovingBody:
    """A body as a ring of vertices, with its current piece of motion.

    Attributes:
        ring: vertex ids, counter-clockwise.
        until: the next rational time at which its tracks, or offsets, change; None if
            there is none.
        horizon: a double at least ``until`` in the frame; infinite for None.
        deforms: whether distances between its vertices may change, in the current piece.
        is_tiled: whether its inside is tiled: it deforms at some time, has a diagonal, and
            need not stay convex.
        since: the rational time at which it entered the piece.
    """

    __slots__ = ("body", "deforms", "horizon", "is_tiled", "ring", "since", "until")

    def __init__(self, body: Body) -> None:
        self.body = body
        self.ring: list[int] = []
        self.since: QQ = QQ(0)
        self.until: QQ | None = None
        self.horizon: float = float("inf")
        self.deforms: bool = False
        self.is_tiled: bool = False


@final
class Vertices:
    """The rings of all bodies.

    Args:
        bodies: with their present plans.
        rings: of each body, the ids of its ring, each with the vertex of the scene it is.
        since: when each body entered its piece.
        frame: of the run.
        end: of the time span.
        free: the ids that removed bodies have left, the one to be used again first last.
        plain: whether rings have no copies: then there are no offsets.

    Attributes:
        all: the vertices, by id. A body that is removed leaves its ids to later ones.
        bodies: in the order of the scene.
        counters: of the decisions about these vertices.
        frame: in which the images are.
        changes: how often tracks have changed, or bodies come and gone.
    """

    def __init__(
        self,
        bodies: Sequence[Body],
        rings: Sequence[Sequence[tuple[int, int]]],
        since: Sequence[QQ],
        frame: Frame,
        end: QQ,
        free: Sequence[int] = (),
        *,
        plain: bool = False,
    ) -> None:
        self.counters: Counters = Counters()
        self.frame: Frame = frame
        self.changes: int = 0
        self._plain: bool = plain
        self._end: QQ = end
        self.all: list[Vertex] = [_nobody(v) for v in range(sum(map(len, rings)) + len(free))]
        self.bodies: list[MovingBody] = []
        self._free: list[int] = list(free)
        for body, ring, t in zip(bodies, rings, since, strict=True):
            self._add(body, ring, t)

    @classmethod
    def of(cls, bodies: Sequence[Body], start: QQ, end: QQ, *, plain: bool = False) -> Vertices:
        """The rings of bodies from a time on.

        With ``plain`` they are the vertices of the scene as they are, without copies and
        offsets, and no inside is tiled.
        """
        positions = [body._at(start) for body in bodies]
        flat = [p for points in positions for p in points]
        ids = count()
        rings = [
            [(next(ids), index) for index in _ring_indices(body, points, plain=plain)]
            for body, points in zip(bodies, positions, strict=True)
        ]
        frame = frame_for(flat or [(QQ(0), QQ(0))], start, end)
        self = cls(bodies, rings, [start] * len(bodies), frame, end, plain=plain)
        for i, moving in enumerate(self.bodies):
            moving.is_tiled = not plain and self._may_pinch(i, start, end)
        return self

    def add(self, body: Body, t: QQ) -> int:
        """Add a body as the last one, at a rational time; its number."""
        i, indices = len(self.bodies), _ring_indices(body, body._at(t))
        while len(self._free) < len(indices):
            self._free.insert(0, len(self.all))
            self.all.append(_nobody(len(self.all)))
        self._add(body, [(self._free.pop(), index) for index in indices], t)
        self.bodies[i].is_tiled = self._may_pinch(i, t, self._end)
        return i

    def remove(self, i: int) -> None:
        """Remove a body; the last one gets its number."""
        self.changes += 1
        for v in reversed(self.bodies[i].ring):
            self.all[v] = _nobody(v)
            self._free.append(v)
        last = self.bodies.pop()
        if i < len(self.bodies):
            self.bodies[i] = last
            for v in last.ring:
                self.all[v].body = i

    def _add(self, body: Body, ring: Sequence[tuple[int, int]], t: QQ) -> None:
        i, moving = len(self.bodies), MovingBody(body)
        self.bodies.append(moving)
        for vertex_id, index in ring:
            vertex = self.all[vertex_id]
            vertex.body, vertex.index = i, index
            moving.ring.append(vertex_id)
        for behind, here in zip(moving.ring, [*moving.ring[1:], moving.ring[0]], strict=True):
            self.all[behind].ahead = here
            self.all[here].behind = behind
        self.enter_piece(i, t)

    @property
    def free(self) -> list[int]:
        """The ids that removed bodies have left, the one to be used again first at the end."""
        return self._free

    def ids(self) -> list[int]:
        """The ids in use, body by body."""
        return [v for moving in self.bodies for v in moving.ring]

    def nodes(self) -> list[int]:
        """Of each id, its vertex among those of the scene, counted through; -1 if unused."""
        first = list(accumulate((moving.body.size for moving in self.bodies), initial=0))
        return [first[v.body] + v.index if v.body >= 0 else -1 for v in self.all]

    def _may_pinch(self, i: int, start: QQ, end: QQ) -> bool:
        """Whether the inside of a body must be tiled from a time on."""
        body, ring = self.bodies[i].body, self.bodies[i].ring
        return (
            body.size > 3
            and body.closed
            and self._ever_deforms(i, start)
            and not stays_convex(body, [self.all[v].index for v in ring], start, end)
        )

    def _ever_deforms(self, i: int, start: QQ) -> bool:
        """Whether a body deforms in any of its pieces from a time in the present one on."""
        body = self.bodies[i].body
        return self.bodies[i].deforms or any(
            _deforms(self.frame.images(body._piece_after(t).tracks))
            for t in body._breakpoints
            if t > start
        )

    def enter_piece(self, i: int, t: QQ) -> None:
        """Give the vertices of a body the tracks that hold just after a rational time."""
        self.changes += 1
        moving = self.bodies[i]
        piece = moving.body._piece_after(t)
        moving.since = t
        self._set_until(moving, piece.until)
        images = self.frame.images(piece.tracks)
        moving.deforms = _deforms(images)
        for vertex_id in moving.ring:
            vertex = self.all[vertex_id]
            vertex.track = piece.tracks[vertex.index]
            vertex.image = images[vertex.index]
        if not self._plain and _is_thin(moving.body) and len(moving.ring) > 1:
            end = self._end if piece.until is None else min(piece.until, self._end)
            offsets = thin_offsets(piece.tracks, t, end)
            for vertex_id, offset in zip(moving.ring, offsets.directions, strict=True):
                self.all[vertex_id].offset = offset
            if offsets.until is not None and offsets.until < end:
                self._set_until(moving, offsets.until)

    def _set_until(self, moving: MovingBody, until: QQ | None) -> None:
        moving.until = until
        moving.horizon = float("inf") if until is None else self.frame.time(until)[1]

    def set_plan(self, i: int, body: Body, t: QQ, end: QQ) -> bool:
        """Let a body go on as another one, which is at the same place at a rational time.

        A body whose inside is tiled stays so, whatever it does next.

        Returns:
            Whether its inside has to be tiled from now on, and is not yet.
        """
        moving = self.bodies[i]
        moving.body = body
        self.enter_piece(i, t)
        tiled, moving.is_tiled = moving.is_tiled, moving.is_tiled or self._may_pinch(i, t, end)
        if self.frame.motion_count > 2 * len(self.all) + 64:
            self.frame.forget_motions({v.image.motion for v in self.all})
        return moving.is_tiled and not tiled

    def name(self, vertex_id: int) -> str:
        """The name in event logs: ``"body:vertex"``."""
        vertex = self.all[vertex_id]
        return f"{self.bodies[vertex.body].body.name}:{vertex.index}"


def _nobody(vertex_id: int) -> Vertex:
    """A vertex that no body has."""
    return Vertex(vertex_id, -1, -1, _NO_TRACK, _NO_IMAGE)


def _deforms(images: Sequence[Image]) -> bool:
    first = images[0].motion
    return first < 0 or any(image.motion != first for image in images)


def _ring_indices(body: Body, positions: list[tuple[QQ, QQ]], *, plain: bool = False) -> list[int]:
    if plain:
        return list(range(body.size))
    if _is_thin(body):
        return thin_ring(body.size)
    ring = list(range(body.size))
    return ring if is_counter_clockwise(positions) else ring[::-1]


def _is_thin(body: Body) -> bool:
    return body.size < 3 or not body.closed
