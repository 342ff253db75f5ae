"""The incremental tiling against the sweep, and against its definition by slopes."""

from fractions import Fraction

from exactpt.certificates.at_time import PredicatesAt
from exactpt.certificates.certifier import Certifier
from exactpt.kernel.algebraic import AlgebraicNumber, rational_between
from exactpt.pairs.start import initial_touches
from exactpt.tiling.events import ContactFound, Stats
from exactpt.tiling.incremental.incremental import IncrementalTiling
from exactpt.tiling.incremental.static import sweep_at
from exactpt.tiling.incremental.structure import LOWER, UPPER
from exactpt.tiling.start import plan_tiling


def started(scene, *, exact_only=False, **options):
    """The tiling at the start of a scene of points."""
    plan = plan_tiling(scene, "incremental", scene.start)
    certifier = Certifier(plan.vertices, scene.start, scene.end, exact_only=exact_only)
    kinetic = IncrementalTiling(plan.entry, plan.vertices, certifier, Stats(), **options)
    kinetic.begin(scene.start)
    return kinetic


def points_at(scene, t):
    """The positions of the points of a scene, as `Fraction`."""
    return [
        tuple(Fraction(int(c.numerator), int(c.denominator)) for c in body.at(t)[0])
        for body in scene.bodies
    ]


def tangents_by_slope(points):
    """Order, u and d of distinct points by definition: the least and the largest slope.

    Of the points left of p (above, for equal x), u(p) is the one with the least slope to p
    and d(p) the one with the largest; vertical is the least of all, the nearest of equals
    counts. Quadratic, `Fraction` only.
    """
    order = sorted(range(len(points)), key=lambda i: (points[i][0], -points[i][1]))
    u, d = [-1] * len(points), [-1] * len(points)
    for k, p in enumerate(order[1:], 1):
        x, y = points[p]
        slopes = {}
        for q in order[:k]:
            a, b = points[q]
            slopes[q] = (1, (y - b) / (x - a)) if a < x else (0, 0)
        # Ranks increase towards p, also along a line.
        nearest = order[:k][::-1]
        u[p] = min(nearest, key=slopes.__getitem__)
        d[p] = max(nearest, key=slopes.__getitem__)
    return order, u, d


def structure_of(structure):
    return structure.order, structure.trees[UPPER].parent, structure.trees[LOWER].parent


def audit_links(structure):
    """Links agree, and the preorder of both trees is the x-order."""
    for tree in structure.trees:
        seen = []
        stack = structure.order[:1]
        while stack:
            z = stack.pop()
            seen.append(z)
            children = []
            c = tree.first[z]
            while c >= 0:
                assert tree.parent[c] == z
                assert tree.before[c] == (children[-1] if children else -1)
                children.append(c)
                c = tree.after[c]
            assert tree.last[z] == (children[-1] if children else -1)
            stack += reversed(children)
        assert seen == structure.order
    assert [structure.rank[p] for p in structure.order] == list(range(len(structure.order)))


def audit_at(kinetic, at, scene=None):
    """Compare with the sweep at a time at which no event happens and nothing has since now."""
    instant = PredicatesAt(kinetic.vertices, at)
    audit_links(kinetic.structure)
    assert structure_of(sweep_at(instant)) == structure_of(kinetic.structure)
    kinetic.mesh_now(at).audit()
    if scene is not None:
        assert structure_of(kinetic.structure) == tangents_by_slope(points_at(scene, at))


def run_and_audit(scene, *, exact_only=False, by_slope=False, each=None, **options):
    """Run a scene, auditing every gap between events: the tiling, the contact, the gaps.

    At a rational time near the event just processed, and in the middle of the gap. ``each``
    is called with the tiling after every step. None if points touch at the start.
    """
    if initial_touches(scene)[1]:
        return None
    kinetic = started(scene, exact_only=exact_only, **options)
    gaps = 0
    try:
        while True:
            end = kinetic.next_number() or AlgebraicNumber(scene.end)
            if kinetic.now.compare(end) < 0:
                at = rational_between(kinetic.now, end)
                audit_at(kinetic, at, scene if by_slope else None)
                audit_at(kinetic, rational_between(kinetic.now, AlgebraicNumber(at)))
                gaps += 1
            if each is not None:
                each(kinetic)
            if kinetic.advance(scene.end) is None:
                return kinetic, None, gaps
    except ContactFound as found:
        return kinetic, found, gaps
