"""Kinetic equals static: between any two events the tiling is the one that is built there."""

from __future__ import annotations

from typing import NamedTuple

from exactpt.certificates.at_time import PredicatesAt
from exactpt.collision.initial import initial_touches
from exactpt.collision.tilings import start_tiling
from exactpt.errors import AuditError
from exactpt.kernel.algebraic import AlgebraicNumber, rational_between
from exactpt.kernel.numbers import QQ
from exactpt.pseudotriangulation.mesh import INSIDE, Mesh
from exactpt.scene.scene import Scene
from exactpt.tiling.events import ContactFound
from exactpt.tiling.tiling import Tiling

__all__ = ["Audited", "audit_at", "audit_now", "run_and_audit"]


class Audited(NamedTuple):
    """A run that passed all audits.

    Attributes:
        kinetic: the tiling at its end.
        contact: whether it ended with a contact.
        gaps: how many times were audited, between two events each.
    """

    kinetic: Tiling
    contact: bool
    gaps: int


def run_and_audit(
    scene: Scene, tiling: str, *, exact_only: bool = False, middle: bool = True
) -> Audited | None:
    """Run a scene, auditing every gap between events.

    At a rational time within the gap, and (``middle``) at one nearer to its start; and at
    the times of events that are rational.

    Returns:
        What was run; None if bodies touch at the start.

    Raises:
        AuditError: at the first fault.
        InputError: if the tiling is not for such scenes.
    """
    if initial_touches(scene)[1]:
        return None
    kinetic = start_tiling(scene, tiling, scene.start, exact_only=exact_only)
    gaps = 0
    try:
        while True:
            end = kinetic.next_number() or AlgebraicNumber(scene.end)
            if kinetic.now.compare(end) < 0:
                at = rational_between(kinetic.now, end)
                audit_at(kinetic, at)
                if middle:
                    audit_at(kinetic, rational_between(kinetic.now, AlgebraicNumber(at)))
                gaps += 1
            if kinetic.advance(scene.end) is None:
                return Audited(kinetic, contact=False, gaps=gaps)
            if kinetic.now.simplified().is_rational:
                audit_now(kinetic)
    except ContactFound:
        return Audited(kinetic, contact=True, gaps=gaps)


def audit_at(kinetic: Tiling, at: QQ) -> None:
    """Compare a tiling with the static one, at a rational time before its next event.

    Raises:
        AuditError: if an angle is not as marked, or the tilings differ.
    """
    instant = PredicatesAt(kinetic.vertices, at)
    kinetic.audit(kinetic.mesh_after(), instant)
    if not kinetic.entry.is_canonical:
        return
    kinetic.audit_structure(instant)
    mesh, name = kinetic.mesh_at(instant), kinetic.vertices.name
    static, kept = _diagonals(mesh), _diagonals(kinetic.mesh_after())
    if static != kept:
        missing = [f"{name(u)} {name(v)}" for u, v in static if (u, v) not in kept]
        raise AuditError(f"t = {at}: kinetic is not static; missing: {', '.join(missing)}")
    if _labels(mesh) != _labels(kinetic.mesh_after()):
        raise AuditError(f"t = {at}: other labels than the static ones")


def audit_now(kinetic: Tiling) -> None:
    """Compare the tiling at the current time, which is rational, with the static one.

    Raises:
        AuditError: if they differ, or there is none.
    """
    now = kinetic.now.low
    instant = PredicatesAt(kinetic.vertices, now, after=False)
    kept, static = kinetic.mesh_now(now), kinetic.mesh_at(instant)
    kinetic.audit(kept, instant)
    if not kinetic.entry.is_canonical:
        return
    if _diagonals(static) != _diagonals(kept) or _labels(static) != _labels(kept):
        raise AuditError(f"t = {now}: at the time itself, kinetic is not static")


def _diagonals(mesh: Mesh) -> list[tuple[int, int]]:
    """Those in free space; those inside bodies are not canonical."""
    pairs = (mesh.ends(h) for h in mesh.diagonals() if mesh.region[h] != INSIDE)
    return sorted((u, v) if u < v else (v, u) for u, v in pairs)


def _labels(mesh: Mesh) -> dict[tuple[int, int], object]:
    labels = mesh.labelling()
    return {mesh.ends(h): labels[h] for h in mesh.map.half_edges() if labels and labels[h]}
