"""Kinetic against static: the tiling between any two events is the one that is built there."""

from exactpt.collision.initial import initial_touches
from exactpt.collision.tilings import start_tiling
from exactpt.kernel.algebraic import AlgebraicNumber, rational_between
from exactpt.tiling.audit import audit_angles
from exactpt.tiling.events import ContactFound
from exactpt.tiling.greedy.greedy import GreedyTiling, greedy_mesh
from exactpt.tiling.greedy.vertical import VerticalDecomposition
from exactpt.tiling.instant import Instant
from exactpt.tiling.mesh import INSIDE


def edges(mesh):
    """The diagonals in free space; those inside bodies are not canonical."""
    return sorted(tuple(sorted(mesh.ends(h))) for h in mesh.diagonals() if mesh.region[h] != INSIDE)


def labels(mesh):
    m = mesh.map
    return {(m.origin[h], m.target(h)): mesh.labels[h] for h in m.half_edges() if mesh.labels[h]}


def audit_at(kinetic, at):
    """Compare at a rational time at which no event happens and nothing has since now."""
    instant = Instant(kinetic.vertices, at)
    audit_angles(kinetic.mesh, instant)
    if kinetic.name == "lazy":
        return
    if not isinstance(kinetic, GreedyTiling):
        mesh = type(kinetic).mesh_at(instant)
        assert edges(mesh) == edges(kinetic.mesh), "diagonals"
        if kinetic.name == "mixed":
            assert labels(mesh) == labels(kinetic.mesh), "labels"
        return
    cells, kept = VerticalDecomposition.at(instant), kinetic.cells
    assert cells.vertex == kept.vertex, "extreme vertices"
    assert sorted(zip(cells.left, cells.right, strict=True)) == sorted(
        zip(kept.left, kept.right, strict=True)
    ), "vertical decomposition"
    mesh, _ = greedy_mesh(instant, cells)
    assert edges(mesh) == edges(kinetic.mesh), "diagonals"


def run_and_audit(scene, tiling, *, exact_only=False, middle=True):
    """Run a scene, auditing every gap between events; the tiling, and whether it met a contact.

    At a rational time near the event just processed, and (``middle``) in the middle of the
    gap. Returns None if bodies touch at the start.
    """
    if initial_touches(scene)[1]:
        return None
    kinetic = start_tiling(scene, tiling, scene.start, exact_only=exact_only)
    gaps = 0
    try:
        while True:
            following = kinetic.next_time()
            end = (
                AlgebraicNumber(scene.end)
                if following is None
                else following.exact or kinetic.certifier.resolve(following)
            )
            if kinetic.now.compare(end) < 0:
                at = rational_between(kinetic.now, end)
                audit_at(kinetic, at)
                if middle:
                    near = rational_between(kinetic.now, AlgebraicNumber(at))
                    audit_at(kinetic, near)
                gaps += 1
            if kinetic.advance(scene.end) is None:
                return kinetic, False, gaps
    except ContactFound:
        return kinetic, True, gaps
