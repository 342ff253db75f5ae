"""The rules of a structure: all that one tiling does unlike another.

The engine (`exactpt.tiling.engine`) keeps any pointed pseudo-triangulation whose angles are
certified. A canonical one has rules of its own on top: certificates that are none of an
angle, what is done when they fail, and what is restored after a change.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from exactpt.errors import AuditError
from exactpt.pseudotriangulation.audit import audit_angles
from exactpt.pseudotriangulation.degenerate import close_at
from exactpt.pseudotriangulation.mesh import Mesh
from exactpt.pseudotriangulation.region import Region

if TYPE_CHECKING:
    from exactpt.certificates.at_time import PredicatesAt
    from exactpt.kernel.numbers import QQ
    from exactpt.motion.body import Body
    from exactpt.motion.vertices import Vertices
    from exactpt.pseudotriangulation.conflict_zone import ConflictZone
    from exactpt.tiling.angles import CertifiedMesh
    from exactpt.tiling.events import Log
    from exactpt.tiling.tiling import State

__all__ = ["Rules"]


class Rules:
    """The rules of a structure; those that it does not have do nothing.

    Attributes:
        certified: the mesh with the certificates of its angles.
        log: what has happened.
    """

    def __init__(self, certified: CertifiedMesh, log: Log) -> None:
        self.certified: CertifiedMesh = certified
        self.log: Log = log

    # Building

    @staticmethod
    def build(instant: PredicatesAt) -> Mesh:
        """The tiling of an instant."""
        raise NotImplementedError

    def begin(self, instant: PredicatesAt) -> Mesh:
        """The tiling that is kept from an instant on; with what is kept besides the mesh."""
        return self.build(instant)

    def close(self, mesh: Mesh, instant: PredicatesAt) -> None:
        """Make a tiling just after an instant the one at the instant.

        Raises:
            AuditError: if that does not end in a tiling.
        """
        if close_at(mesh, instant):
            audit_angles(mesh, instant)

    def audit(self, instant: PredicatesAt) -> None:
        """Compare what is kept besides the mesh with what is built at an instant.

        Raises:
            AuditError: if they differ.
        """

    # State to and from JSON

    def state(self) -> State:
        """What is kept besides the mesh and the flat angles, as JSON data."""
        return {}

    def empty_mesh(self, vertices: Vertices) -> Mesh:  # noqa: ARG002 - labels need them
        """A mesh of this structure without edges."""
        return Mesh(0)

    def resume(self, state: State) -> None:
        """Go on with that state, and with what follows from the mesh."""

    # Certificates

    def certify(self) -> None:
        """Certify all that is no angle, of a tiling that has been built."""

    def certify_body(self, i: int) -> None:
        """Certify anew what depends on a body and is no angle."""

    def changed(self, half_edges: list[int]) -> None:
        """The angles of these half-edges have changed."""

    def cancelled(self, h: int) -> None:
        """An edge has been removed: its certificates go too."""

    def failed(self, certificates: list[int]) -> None:
        """Certificates that are none of an angle or a motion fail now; perhaps none do."""
        if certificates:
            raise AuditError(f"unknown certificates {certificates}")

    # Repairs

    def is_violated(self) -> bool:
        """Whether a certificate that is none of an angle is violated just after now."""
        return False

    def repair(self) -> None:
        """Mend one of these; no angle is violated then."""

    def turns_reflex(self, h: int) -> None:
        """The convex vertex of a body at the origin of h becomes reflex, before the repair."""

    def check(self, touched: list[int]) -> None:
        """Check what repairs at one time that are not apart have left at half-edges.

        Raises:
            RebuildNeeded: if it is not the structure.
        """

    def restore(self) -> None:
        """Make the tiling canonical again where it has changed; no angle is violated.

        Raises:
            RebuildNeeded: if that is not possible.
        """

    # Plans, and bodies that come and go

    def allows_plan(self, body: Body, t: QQ) -> bool:  # noqa: ARG002
        """Whether a body of the tiling can go on by a plan."""
        return True

    def allows_body(self, body: Body, t: QQ) -> bool:  # noqa: ARG002
        """Whether a body can be added."""
        return True

    def region_met(self, zone: ConflictZone) -> Region:
        """What is tiled anew when a body comes: the faces that it meets."""
        return Region(self.certified.mesh, zone.faces, zone.crossed)

    def region_left(self, i: int) -> Region:
        """What is tiled anew when a body goes: the faces that it has touched."""
        gone = self.certified.edges_at(i)
        return Region(self.certified.mesh, [g for h in gone for g in (h, h ^ 1)], gone)

    def enter(self, i: int) -> None:
        """Certify what is no angle of a new body."""

    def leave(self, i: int) -> None:
        """Forget what is no angle of a body, and let the last one have its number."""
