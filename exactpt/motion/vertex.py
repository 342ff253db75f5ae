"""A moving body and the vertices of its rings."""

from __future__ import annotations

from typing import TYPE_CHECKING, Final, final

from librt.vecs import vec
from mypy_extensions import i32, i64, mypyc_attr

from exactpt.indices import VertexId
from exactpt.kernel.numbers import QQ
from exactpt.motion.float_track import FloatTrack
from exactpt.motion.ring_order import rings_of

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

    from exactpt.motion.body import Body
    from exactpt.motion.course import Piece
    from exactpt.motion.enclosures import Enclosures
    from exactpt.motion.infinitesimal import Direction
    from exactpt.motion.track import Track

_START: Final = QQ(0)


@final
@mypyc_attr(acyclic=True)
class Stage:
    """The motion of a body by one formula; made when it is first needed.

    Args:
        bodies: a sequence with the body.
        number: its position there.
        since: the rational time at which it enters the piece.
        made: the piece, if it is known.
    """

    __slots__ = ("_bodies", "_made", "_number", "_since")

    def __init__(
        self, bodies: Sequence[Body], number: int, since: QQ, made: Piece | None = None
    ) -> None:
        self._bodies: Sequence[Body] = bodies
        self._number: int = number
        self._since: QQ = since
        self._made: Piece | None = made

    @property
    def piece(self) -> Piece:
        """The piece of motion."""
        piece = self._made
        if piece is None:
            piece = self._made = self._bodies[self._number].exact_piece_after(self._since)
        return piece


@final
@mypyc_attr(acyclic=True)
class MovingBody:
    """A body as a ring of vertices, with its current piece of motion.

    The body, its piece and its enclosures are made when they are first needed.

    Args:
        bodies: a sequence with the body.
        number: its position there.
        first: the first one of ``size`` successive vertex ids, its ring.
        size: their number.

    Attributes:
        place: its position in the scene; -1 if it is not there.
        until: the next rational time at which its trajectories, or the displacements of
            its copies, change; None if there is none.
        deforms: whether distances between its vertices may change, in the current piece.
        is_polygon: whether it has an interior and one ring.
        is_tiled: whether its interior is tiled: it deforms at some time, has a diagonal,
            and is not known to stay convex.
        since: the rational time at which it entered the piece.
        enclosures: what makes its enclosures.
    """

    __slots__ = (
        "_bodies", "_body", "_first", "_float_tracks", "_number", "_ring", "_size", "_stage",
        "deforms", "enclosures", "is_polygon", "is_tiled", "place", "since", "until",
    )  # fmt: skip

    def __init__(self, bodies: Sequence[Body], number: int, first: i64 = 0, size: i64 = 0) -> None:
        self._bodies: Sequence[Body] = bodies
        self._number: int = number
        self._first: i64 = first
        self._size: i64 = size
        self._ring: list[VertexId] | None = None
        self.place: int = -1
        self.since: QQ = _START
        self.until: QQ | None = None
        self.deforms: bool = False
        self.is_polygon: bool = False
        self.is_tiled: bool = False
        self.enclosures: Enclosures | None = None
        self._stage: Stage | None = None
        self._body: Body | None = None
        self._float_tracks: list[FloatTrack] | None = None

    @property
    def body(self) -> Body:
        """The body."""
        body = self._body
        if body is None:
            body = self._body = self._bodies[self._number]
        return body

    @property
    def name(self) -> str:
        """Its name; empty for the body of vertices that no body has had."""
        if self._number < 0:
            return ""
        name_of = None if self._body is not None else getattr(self._bodies, "name", None)
        return self.body.name if name_of is None else str(name_of(self._number))

    @property
    def ring(self) -> list[VertexId]:
        """Its vertex ids, counter-clockwise.

        Of a body with holes or several parts those of all rings, one after the other, each with
        the body on its left.
        """
        if self._ring is None:
            return list(map(VertexId, range(self._first, self._first + self._size)))
        return self._ring

    @ring.setter
    def ring(self, ring: list[VertexId]) -> None:
        self._ring = ring

    @property
    def stage(self) -> Stage:
        """The current piece of motion, made when it is first needed."""
        if self._stage is None:
            self._stage = Stage(self._bodies, self._number, self.since)
        return self._stage

    @property
    def piece(self) -> Piece:
        """The motion of the body until its next breakpoint."""
        return self.stage.piece

    @property
    def float_tracks(self) -> list[FloatTrack]:
        """The enclosure of each vertex, in the order of the scene."""
        float_tracks = self._float_tracks
        if float_tracks is None:
            if self.enclosures is None:
                return [_NO_FLOAT_TRACK]
            float_tracks = self._float_tracks = self.enclosures.of_piece(self.piece)
        return float_tracks

    def replace(self, body: Body) -> None:
        """Be another body of the same name from now on; `enter` must follow."""
        self._body = body

    def enter(self, t: QQ) -> Piece:
        """Enter the piece of motion just after a rational time."""
        piece = self.body.exact_piece_after(t)
        self.since, self._float_tracks = t, None
        self._stage = Stage(self._bodies, self._number, t, piece)
        self.until = piece.until
        return piece

    @property
    def rings(self) -> list[list[VertexId]]:
        """The vertex ids of each ring, in the order of the body's rings."""
        return rings_of(self.body, self.ring)


_NO_FLOAT_TRACK: Final = FloatTrack([0.0], [0.0], [], -1)
_NO_BODY: Final = MovingBody((), -1)


@final
@mypyc_attr(acyclic=True)
class Vertex:
    """A vertex of a ring.

    Attributes:
        id: its position in `Vertices.all`.
        index: its vertex in the scene (infinitesimal copies share it).
        moving: its body; the last one if it is unused.
        offset: the direction of its infinitesimal displacement; None unless the body is
            degenerate.
        x, y, error: its last computed position, normalised, and a bound on the errors of
            both; ``seen`` is their time (`exactpt.certificates.positions`).
    """

    __slots__ = ("error", "id", "index", "moving", "offset", "seen", "x", "y")

    def __init__(self, vertex_id: VertexId, index: int, moving: MovingBody) -> None:
        self.id: VertexId = vertex_id
        self.index: int = index
        self.moving: MovingBody = moving
        self.offset: Direction | None = None
        self.x: float = 0.0
        self.y: float = 0.0
        self.error: float = 0.0
        self.seen: object = None

    @property
    def body(self) -> int:
        """The position of its body in the scene; -1 if it is unused."""
        return self.moving.place

    @property
    def piece(self) -> Piece:
        """The motion of its body until the next breakpoint."""
        return self.moving.piece

    @property
    def float_track(self) -> FloatTrack:
        """The float enclosure of its trajectory until that time."""
        return _NO_FLOAT_TRACK if self.moving.place < 0 else self.moving.float_tracks[self.index]

    @property
    def track(self) -> Track:
        """Its trajectory until the body's next breakpoint."""
        return self.moving.piece.track(self.index)

    @property
    def name(self) -> str:
        """Its name in event logs: ``"body:vertex"``."""
        return f"{self.moving.name}:{self.index}"

    def is_copy_of(self, other: Vertex) -> bool:
        """Return True if both are one vertex of the scene, or infinitesimal copies of one."""
        return self.index == other.index and self.moving is other.moving


def unused(vertex_id: VertexId) -> Vertex:
    """Return a vertex that belongs to no body."""
    return Vertex(vertex_id, -1, _NO_BODY)


@final
class VertexList:
    """Vertices by id; those given by numbers of bodies are made when they are first needed.

    Args:
        bodies: the moving bodies.
        owners: of each vertex, the position of its body among these.
        indices: of each vertex, its vertex in the body.
    """

    def __init__(self, bodies: list[MovingBody], owners: vec[i32], indices: vec[i32]) -> None:
        self._bodies: list[MovingBody] = bodies
        self._owners: vec[i32] = owners
        self._indices: vec[i32] = indices
        self._made: list[Vertex | None] = [None] * len(owners)

    def __len__(self) -> int:
        return len(self._made)

    def __getitem__(self, v: VertexId) -> Vertex:
        """Return the vertex of an id."""
        vertex = self._made[v]
        if vertex is None:
            vertex = Vertex(v, self._indices[v], self._bodies[i64(self._owners[v])])
            self._made[v] = vertex
        return vertex

    def __setitem__(self, v: VertexId, vertex: Vertex) -> None:
        """Replace the vertex of an id."""
        self._made[v] = vertex

    def append(self, vertex: Vertex) -> None:
        """Add a vertex, whose id is the number of the others."""
        self._made.append(vertex)

    def __iter__(self) -> Iterator[Vertex]:
        """Yield all vertices."""
        for v in range(len(self._made)):
            yield self[VertexId(v)]
