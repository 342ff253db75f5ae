"""Ids of certificates: the kind, and the part of the structure that it guarantees.

In the queue a certificate is one integer, so that hot code compares and hashes plain numbers.
It is packed and unpacked here, and by the queue in place: a call for each would take too long
in plain Python. The queue breaks ties by that integer, by the
part first; in which order certificates that fail at one time are *repaired* is the order of
`Kind`.
"""

from __future__ import annotations

from enum import IntEnum, unique
from typing import Final, final

from mypy_extensions import i64

from exactpt.indices import CertificateId, VertexId

KIND_COUNT: Final[int] = 16
"""All packed codes of kinds are less."""

_POINT_KINDS: Final = 4


@final
@unique
class Kind(IntEnum):
    """Kinds of certificates of a mesh, in the order of repair; the value is the packed code.

    * SHRINK, of a body, first: a segment that shrinks to a point, a triangle that becomes
      flat. This may be a contact, and contacts are reported before anything changes.
    * MOTION, of a body: its piece of motion ends. All signs after now are those of the next
      piece, so it is entered before anything is judged.
    * EXTREME, of an arc and a side: an extreme vertex against its neighbour on the ring. The
      cells beside it are certified against the new extreme vertex.
    * CELL, of a cell of the vertical decomposition: the x-order of its two extreme vertices.
      Those that rise in the plane turned by rho exchange before the angles that fail at the
      same time, the others after them (`exactpt.certificates.perturbation`, step 1).
    * ANGLE, of a half-edge: its angle keeps the side of pi on which it is. Flips need faces
      with three corners, so all angles are repaired before any diagonal is flipped.
    * TURN, of a vertex: a reflex vertex of a polygon becomes convex, and loses its diagonals
      in mid-air before the others are judged greedy or not.
    * SHADOW and the five after it, of a diagonal: the x-order of the diagonal, that of its
      shadow, and four tangencies of the shadow (`exactpt.tiling.greedy.flipping`).
    * OTHER, and the one after it: of structures from outside the package (docs/extending.md),
      which order them as they need.
    """

    SHRINK = 4
    MOTION = 3
    EXTREME = 2
    CELL = 1
    ANGLE = 0
    TURN = 5
    SHADOW = 8
    OTHER = 6


@final
@unique
class PointKind(IntEnum):
    """Kinds of certificates of moving points, in the order of repair.

    * MOTION: as `Kind.MOTION`.
    * ORDER, of a point: it is left of the next one. What stands in a vertical line then has
      its trees as they were just before.
    * UPPER, LOWER, of a point: the edge on which it hangs in that tree.
    """

    MOTION = 3
    ORDER = 2
    UPPER = 0
    LOWER = 1


# The same as integers of compiled code, which would look an enum up at every use.
ANGLE: Final[int] = int(Kind.ANGLE)
CELL: Final[int] = int(Kind.CELL)
EXTREME: Final[int] = int(Kind.EXTREME)
MOTION: Final[int] = int(Kind.MOTION)
SHRINK: Final[int] = int(Kind.SHRINK)
TURN: Final[int] = int(Kind.TURN)
SHADOW: Final[int] = int(Kind.SHADOW)
OTHER: Final[int] = int(Kind.OTHER)
POINT_ORDER: Final[int] = int(PointKind.ORDER)
POINT_MOTION: Final[int] = int(PointKind.MOTION)


def pack(kind: i64, part: i64) -> CertificateId:
    """Return the certificate of a kind and a part of the mesh, as defined by `Kind`."""
    return CertificateId(KIND_COUNT * part + kind)


def kind_of(certificate: CertificateId) -> i64:
    """Return the value of its `Kind`."""
    return certificate % KIND_COUNT


def part_of(certificate: CertificateId) -> i64:
    """Return the part of the mesh that a certificate watches."""
    return certificate // KIND_COUNT


def pack_point(kind: i64, point: i64) -> CertificateId:
    """Return the certificate of a kind; of a point."""
    return CertificateId(_POINT_KINDS * point + kind)


def point_kind_of(certificate: CertificateId) -> i64:
    """Return the value of its `PointKind`."""
    return certificate % _POINT_KINDS


def point_of(certificate: CertificateId) -> VertexId:
    """Return the point that a certificate watches."""
    return VertexId(certificate // _POINT_KINDS)
