"""Audits of a tiling: between two events it equals the one built from nothing at that time."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple, final

from exactpt.certificates.at_time import PredicatesAt
from exactpt.certificates.certificate import kind_of, part_of
from exactpt.errors import AuditError
from exactpt.indices import Ends
from exactpt.kernel.algebraic import AlgebraicNumber, rational_between
from exactpt.kernel.numbers import QQ
from exactpt.motion.enclosures import Enclosures
from exactpt.motion.vertices import WIDTH, Vertices
from exactpt.pseudotriangulation.mesh import INSIDE, Mesh
from exactpt.scene.scene import Scene
from exactpt.tiling.driver import Driver, Observer
from exactpt.tiling.engine import Engine
from exactpt.tiling.tiling import Tiling

if TYPE_CHECKING:
    from exactpt.simulation.simulation import Simulation

__all__ = [
    "Audited",
    "audit",
    "audit_at",
    "audit_certificates",
    "audit_now",
    "audit_places",
    "run_and_audit",
]


def audit(simulation: Simulation) -> None:
    """Check the present state of a run against the tiling built from nothing.

    The tiling of the run must equal the one built now, if now is rational, and the one built at a
    rational time between now and the next event. The pending certificates must be those certified
    anew, and the coefficients of all trajectories in doubles those computed anew. After each step,
    so is every state of a run audited. Where bodies touch at the start there is no tiling, and
    after a contact there are no later states: then less is compared, or nothing.

    An audit takes as long as building the tiling, and does not change the run.

    Args:
        simulation: the run, between two events.

    Raises:
        AuditError: at the first fault; the message has the time, and the parts that differ.

    Example:
        >>> from exactpt import Simulation
        >>> from exactpt.testing import audit
        >>> from exactpt.testing.scenes import generate
        >>> run = Simulation(generate("stars", 1), tiling="lazy")
        >>> audit(run)
        >>> while run.step():
        ...     audit(run)
    """
    tiling = simulation.kinetic
    if tiling is None:
        return
    audit_places(tiling.vertices)
    if simulation.contact is not None:
        return
    if tiling.now.simplified().is_rational:
        audit_now(tiling)
    _audit_until(tiling, simulation.scene.exact_end)


def _audit_until(tiling: Tiling, end: QQ) -> QQ | None:
    """Audit a tiling between now and its next event.

    Returns:
        The time of the audit; None if the next event, or the end, is now.
    """
    following = tiling.next_number() or AlgebraicNumber(end)
    if tiling.now.compare(following) >= 0:
        return None
    at = rational_between(tiling.now, following)
    audit_at(tiling, at)
    audit_certificates(tiling)
    return at


class Audited(NamedTuple):
    """A run that has passed all audits.

    Attributes:
        kinetic: the tiling at its end.
        contact: whether it ended with a contact.
        gaps: number of audited intervals between consecutive events.
    """

    kinetic: Tiling
    contact: bool
    gaps: int


def run_and_audit(
    scene: Scene, tiling: str, *, exact_only: bool = False, middle: bool = True
) -> Audited | None:
    """Run a scene and audit the tiling between any two consecutive events.

    The audit takes place at a rational time in the interval, with ``middle`` at another one
    nearer to its start, and at event times that are rational.

    Returns:
        The audited run; None if bodies touch at the start.

    Raises:
        AuditError: at the first fault.
        InputError: if the tiling does not support the scene.
    """
    audits = _Audits(middle=middle)
    driver = Driver(scene, observers=[audits])
    if driver.start(tiling, exact_only=exact_only) is not None:
        return None
    audit_places(driver.tiled.kinetic.vertices)
    try:
        contact = driver.run(scene.exact_end)
    finally:
        audit_places(driver.tiled.kinetic.vertices)
    return Audited(driver.tiled.kinetic, contact=contact is not None, gaps=audits.gaps)


@final
class _Audits(Observer):
    """Audits a run, see `run_and_audit`."""

    def __init__(self, *, middle: bool) -> None:
        self._middle = middle
        self.gaps = 0

    def on_advance(self, scene: Scene, tiling: Tiling) -> None:
        """Audit the tiling between now and the next event."""
        at = _audit_until(tiling, scene.exact_end)
        if at is None:
            return
        self.gaps += 1
        if self._middle:
            audit_at(tiling, rational_between(tiling.now, AlgebraicNumber(at)))

    def on_event_time(self, tiling: Tiling) -> None:
        """Audit the tiling at an event time, if that is rational."""
        if tiling.now.simplified().is_rational:
            audit_now(tiling)


def audit_places(vertices: Vertices) -> None:
    """Compare the coefficients of all vertices with enclosures made anew.

    Raises:
        AuditError: if they differ.
    """
    enclosures = Enclosures(vertices.normalization)
    for moving in vertices.bodies:
        float_tracks = enclosures.of_piece(moving.body.exact_piece_after(moving.since))
        for v in moving.ring:
            float_track = float_tracks[vertices.all[v].index]
            expected = float_track.x0, float_track.y0, float_track.x1, float_track.y1
            known = [vertices.places[WIDTH * v + k] for k in range(4)]
            if repr(known) != repr(list(expected)):  # NaN stands for no enclosure
                raise AuditError(f"the coefficients of vertex {v} are {known}, not {expected}")


def audit_certificates(kinetic: Tiling) -> None:
    """Certify a tiling anew, and compare the pending certificates with those before.

    A certificate that a change has left out, or a stale one, shows here at once; in the run, only
    if its vertices become collinear before the angle is certified again.

    Raises:
        AuditError: if a certificate is missing, superfluous, or fails at another time.
    """
    if not isinstance(kinetic, Engine):
        return
    pending = kinetic.table.pending
    before = {slot: pending.time_of(slot) for slot in pending.slots()}
    kinetic.certified.certify_everything()
    slots = pending.slots()
    if before.keys() != set(slots):
        names = [f"{kind_of(c)} of {part_of(c)}" for c in sorted(before.keys() ^ {*slots})]
        raise AuditError(f"certificates missing or superfluous: {', '.join(names)}")
    for slot in slots:
        old, new = before[slot], pending.time_of(slot)
        if old.low > new.high or new.low > old.high:
            raise AuditError(f"certificate {kind_of(slot)} of {part_of(slot)}: fails at {new}")


def audit_at(kinetic: Tiling, at: QQ) -> None:
    """Compare a tiling with the static one, at a rational time before its next event.

    Raises:
        AuditError: if the marks of an angle are wrong, or the tilings differ.
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
        AuditError: if they differ, or there is no static one.
    """
    now = kinetic.now.low
    instant = PredicatesAt(kinetic.vertices, now, after=False)
    kept, static = kinetic.mesh_now(now), kinetic.mesh_at(instant)
    kinetic.audit(kept, instant)
    if not kinetic.entry.is_canonical:
        return
    if _diagonals(static) != _diagonals(kept) or _labels(static) != _labels(kept):
        raise AuditError(f"t = {now}: at the time itself, kinetic is not static")


def _diagonals(mesh: Mesh) -> list[Ends]:
    """Return the diagonals in the free space; those inside bodies are not canonical."""
    pairs = (mesh.ends(h) for h in mesh.diagonals() if mesh.region[h] != INSIDE)
    return sorted((u, v) if u < v else (v, u) for u, v in pairs)


def _labels(mesh: Mesh) -> dict[Ends, object]:
    labels = mesh.labelling()
    return {mesh.ends(h): labels[h] for h in mesh.map.half_edges() if labels and labels[h]}
