"""What tilings do if nothing else helps: guards that few scenes reach, or none.

A tiling that cannot be repaired is built anew (law `tiling/static`, families of combs). That of
points has two more ways out before that; and if no tiling holds, the run ends with an error.
"""

import pytest

from exactpt import AuditError, Body, Scene, Simulation, Translation, first_contact
from exactpt.certificates.one_sided import OneSided
from exactpt.pseudotriangulation.audit import audit_angles
from exactpt.testing import audit
from exactpt.testing.scenes import generate
from exactpt.tiling.engine import Engine
from exactpt.tiling.greedy.greedy import VerticalRules
from exactpt.tiling.greedy.shadowed import ShadowRules
from exactpt.tiling.incremental.tree_repairs import TreeRepairs
from exactpt.tiling.lazy import LazyRules
from exactpt.tiling.repairs import RebuildNeeded, Repairs

pytestmark = pytest.mark.plain


def run_and_audit(scene, tiling):
    run = Simulation(scene, tiling=tiling)
    audit(run)
    while run.step():
        audit(run)
    return run


@pytest.mark.parametrize("family", ["point_grids_passing", "simultaneous_swaps", "crossing_lines"])
@pytest.mark.parametrize("refused", ["_repair_one", "_sort_columns", "both"])
def test_structure_of_points_is_the_static_one_by_any_way_out(monkeypatch, refused, family):
    """Exchanges one by one, columns as a whole, and the sweep anew lead to one structure."""
    for name in ("_repair_one", "_sort_columns"):
        if refused in (name, "both"):
            monkeypatch.setattr(TreeRepairs, name, lambda _: False)

    runs = [run_and_audit(generate(family, seed), "incremental") for seed in range(6)]

    rebuilds = sum(run.stats.get("rebuilds", 0) for run in runs)
    assert (rebuilds > 0) == (refused != "_sort_columns" or family == "simultaneous_swaps")


@pytest.fixture
def no_repair(monkeypatch):
    """Every event ends in a rebuild: none is processed alone, none is repaired."""

    def refuse(_):
        raise RebuildNeeded

    for rules in (LazyRules, ShadowRules, VerticalRules):
        monkeypatch.setattr(rules, "slides_are_plain", False)
    monkeypatch.setattr(Repairs, "repair_all", refuse)


@pytest.mark.parametrize("tiling", ["greedy", "mixed", "lazy"])
@pytest.mark.parametrize("family", ["convex", "turning", "small_grid", "blobs"])
@pytest.mark.usefixtures("no_repair")
def test_run_without_any_repair_finds_the_first_contact(tiling, family):
    scene = generate(family, 3)

    run = run_and_audit(scene, tiling)

    assert run.stats["rebuilds"] > 0
    assert run.contact == first_contact(scene, method="pairs")


@pytest.mark.parametrize("tiling", ["greedy", "mixed", "lazy"])
@pytest.mark.usefixtures("no_repair")
def test_bug_a_rebuild_at_the_end_of_the_time_span_was_left_out(tiling):
    comb = [(0, 3), (0, 1), (1, 1), (1, 3), (5, 4), (5, 1), (0, 0), (1, 0), (9, 0), (9, 5)]
    bodies = [Body("a", [(2, 3)]), Body("b", comb, Translation([0], [0, 1]))]

    run = run_and_audit(Scene(bodies, (0, 2)), tiling)

    assert run.now == 2
    audit_angles(run.kinetic.mesh, OneSided(run.kinetic.certifier, before=False))


@pytest.mark.usefixtures("no_repair")
def test_rebuild_that_never_succeeds_ends_with_an_error(monkeypatch):
    monkeypatch.setattr(Engine, "_build_anew", lambda *_: False)

    with pytest.raises(AuditError, match="no tiling holds just after t = "):
        run_and_audit(generate("convex", 3), "lazy")


def test_space_of_points_notices_a_wrong_tree():
    """Of (3, 2) the upper tangent ends at (1, 3), not at (2, 1)."""
    points = [(0, 0), (1, 3), (2, 1), (3, 2)]
    run = Simulation(Scene([Body(f"p{i}", [p]) for i, p in enumerate(points)]))
    upper = run.kinetic.structure.trees[0]
    assert upper.parent[3] == 1
    upper.detach(3)
    upper.append(2, 3)

    with pytest.raises(AuditError):
        run.snapshot()
