"""A moving vertex of a ring."""

from __future__ import annotations

from typing import TYPE_CHECKING, Final, final

from mypy_extensions import mypyc_attr

from exactpt.indices import NO_VERTEX, VertexId
from exactpt.kernel.numbers import QQ
from exactpt.kernel.rounding import INFINITY
from exactpt.motion.course import Piece
from exactpt.motion.image import Image
from exactpt.motion.motions import REST
from exactpt.motion.shape import Shape

if TYPE_CHECKING:
    from exactpt.motion.infinitesimal import Direction
    from exactpt.motion.track import Track

__all__ = ["Vertex", "unused"]

_NO_PIECE: Final = Piece(Shape([(0, 0)]), QQ(0), REST, None)
_NO_IMAGE: Final = Image([0.0], [0.0], [], -1)


@final
@mypyc_attr(acyclic=True)
class Vertex:
    """A vertex of a ring.

    Attributes:
        id: its position in `Vertices.all`.
        body: the position of its body in the scene; -1 if it is unused.
        index: its vertex in the scene (infinitesimal copies share it).
        owner: the name of its body; of the last one if it is unused.
        piece: the motion of its body until the next breakpoint.
        image: the float enclosure of its trajectory until then.
        offset: the direction of its infinitesimal displacement; None unless the body is
            degenerate.
        horizon: a double at least ``until`` of its body, normalised; infinite if that is None.
        ahead, behind: the ids of its neighbours on the ring.
        x, y, error: its last computed position, normalised, and a bound on the errors of
            both; ``seen`` tells when (`exactpt.certificates.positions`).
    """

    __slots__ = (
        "ahead", "behind", "body", "error", "horizon", "id", "image", "index", "offset", "owner",
        "piece", "seen", "x", "y",
    )  # fmt: skip

    def __init__(
        self, vertex_id: VertexId, body: int, index: int, piece: Piece, image: Image
    ) -> None:
        self.id: VertexId = vertex_id
        self.piece: Piece = piece
        self.image: Image = image
        self.horizon: float = INFINITY
        self.body: int = body
        self.index: int = index
        self.owner: str = ""
        self.offset: Direction | None = None
        self.ahead: VertexId = NO_VERTEX
        self.behind: VertexId = NO_VERTEX
        self.x: float = 0.0
        self.y: float = 0.0
        self.error: float = 0.0
        self.seen: object = None

    @property
    def track(self) -> Track:
        """Its trajectory until the body's next breakpoint."""
        return self.piece.track(self.index)

    @property
    def name(self) -> str:
        """Its name in event logs: ``"body:vertex"``."""
        return f"{self.owner}:{self.index}"

    def is_copy_of(self, other: Vertex) -> bool:
        """Whether both are one vertex of the scene, or infinitesimal copies of one."""
        return self.index == other.index and self.body == other.body


def unused(vertex_id: VertexId) -> Vertex:
    """A vertex that belongs to no body."""
    return Vertex(vertex_id, -1, -1, _NO_PIECE, _NO_IMAGE)
