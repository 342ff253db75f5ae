"""The rules of a tiling: everything in which one tiling differs from another.

The engine (`exactpt.tiling.engine`) maintains any pointed pseudo-triangulation by
certificates of its angles. A canonical tiling adds rules: further certificates, their
repairs, and the flips that make the tiling canonical again after a change.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from typing import TYPE_CHECKING, ClassVar, Final

from mypy_extensions import mypyc_attr

from exactpt.certificates.certificate import OTHER
from exactpt.errors import AuditError
from exactpt.indices import CertificateId, HalfEdge
from exactpt.planar.halfedge import twin
from exactpt.pseudotriangulation.audit import audit_angles
from exactpt.pseudotriangulation.degenerate import close_at
from exactpt.pseudotriangulation.mesh import Mesh
from exactpt.pseudotriangulation.region import Region
from exactpt.tiling.angles import CertifiedMesh, Followers

if TYPE_CHECKING:
    from exactpt.certificates.at_time import PredicatesAt
    from exactpt.kernel.numbers import QQ
    from exactpt.motion.body import Body
    from exactpt.motion.vertices import Vertices
    from exactpt.pseudotriangulation.conflict_zone import ConflictZone
    from exactpt.tiling.events import Log
    from exactpt.tiling.tiling import State

MOST_PARTS: Final = 64
"""Maximum number of certificates of one kind in a structure from outside, for each vertex."""


@mypyc_attr(allow_interpreted_subclasses=True)
class Rules(Followers, ABC):
    """The rules of a tiling; only `build` is required, the other methods do nothing by default.

    Call `build` of the class, ``type(rules).build``: compiled code that calls a static method of
    an instance does not find the one of a subclass in plain Python.

    Attributes:
        slides_are_plain: whether a slide changes the mesh as `Mesh` itself does, so that
            isolated events are processed by `exactpt.tiling.isolated`. Set by the class.
        only_angles: whether nothing but certificates of angles follows from a slide; the methods
            `changed`, `is_violated` and `recanonicalize` are then not called after isolated events.
        certified: the mesh, with the certificates of its angles.
        log: the record of events.
    """

    slides_are_plain: ClassVar[bool] = False
    only_angles: ClassVar[bool] = False

    def __init__(self, certified: CertifiedMesh, log: Log) -> None:
        self.certified: CertifiedMesh = certified
        self.log: Log = log

    # Building

    @staticmethod
    @abstractmethod
    def build(instant: PredicatesAt) -> Mesh:
        """Return the tiling of an instant, built from scratch."""

    def begin(self, instant: PredicatesAt) -> Mesh:
        """Return the tiling of an instant, to be maintained from then on.

        Data that the rules maintain besides the mesh are built too.
        """
        return type(self).build(instant)

    def close(self, mesh: Mesh, instant: PredicatesAt) -> None:
        """Change the tiling just after an instant, in place, into the one at the instant.

        Raises:
            AuditError: if the result is not a tiling.
        """
        if close_at(mesh, instant):
            audit_angles(mesh, instant)

    def audit(self, instant: PredicatesAt) -> None:
        """Compare the data besides the mesh with those built from scratch at an instant.

        Raises:
            AuditError: if they differ.
        """

    # State to and from JSON

    def state(self) -> State:
        """Return the data besides the mesh and the flat angles, as a JSON object."""
        return {}

    def empty_mesh(self, vertices: Vertices) -> Mesh:  # noqa: ARG002 - labels need them
        """Return a mesh of this tiling without edges."""
        return Mesh(0)

    def resume(self, state: State) -> None:
        """Restore the data besides the mesh, from a saved state and from the mesh.

        The state may be forged: `exactpt.kernel.stored.Stored` checks its values.
        """

    def has_part(self, kind: int, part: int) -> bool:
        """Return True if a part may have a certificate of a kind, besides those of the engine.

        By default those of structures from outside may, with parts up to a multiple of the number
        of vertices: the queue has room for all parts up to the largest.
        """
        most = MOST_PARTS * (len(self.certified.vertices.all) + 1)
        return OTHER <= kind <= OTHER + 1 and part < most

    # Certificates

    def failed(self, certificates: list[CertificateId]) -> None:
        """Process the failed certificates of an event, except those of angles and bodies."""
        if certificates:
            raise AuditError(f"unknown certificates {certificates}")

    # Repairs

    def is_violated(self) -> bool:
        """Return True if a certificate, other than of an angle, is violated just after now."""
        return False

    def repair(self) -> None:
        """Repair one violated certificate; called when no angle is violated."""

    def turns_reflex(self, h: HalfEdge) -> None:
        """Follow a vertex, the origin of h, that becomes reflex, before the repair."""

    def check(self, touched: list[HalfEdge]) -> None:
        """Check the tiles of half-edges after several repairs of one time that interact.

        Raises:
            RebuildNeeded: if these are not tiles of the canonical tiling.
        """

    def recanonicalize(self) -> None:
        """Make the tiling canonical again where it has changed; called when nothing is violated.

        Raises:
            RebuildNeeded: if the changes cannot be completed locally.
        """

    # Changes of motions, insertion and removal of bodies

    def allows_plan(self, body: Body, t: QQ) -> bool:  # noqa: ARG002
        """Return True if a body of the tiling may take this new motion from a time on."""
        return True

    def allows_body(self, body: Body, t: QQ) -> bool:  # noqa: ARG002
        """Return True if a body may be added at a time."""
        return True

    def region_of_insertion(self, zone: ConflictZone) -> Region | None:
        """Return the region to retile when a body is added: the faces that it intersects.

        None if the whole must be tiled anew.
        """
        return Region(self.certified.mesh, zone.faces, zone.crossed)

    def region_of_removal(self, i: int) -> Region | None:
        """Return the region to retile when a body is removed: the faces at its vertices.

        None if the whole must be tiled anew.
        """
        gone = self.certified.edges_at(i)
        return Region(self.certified.mesh, [g for h in gone for g in (h, twin(h))], gone)

    def enter(self, i: int) -> None:
        """Certify a new body, except for its angles."""

    def leave(self, i: int) -> None:
        """Forget a removed body; the last body takes over its number."""
