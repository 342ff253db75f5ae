"""Repairs: their order at one time, that they are enough, and the last resort."""

from collections import Counter

import pytest

from exactpt import AuditError, Body, Scene, Simulation, Translation
from exactpt.certificates.one_sided import OneSided
from exactpt.certificates.perturbation import comes_first
from exactpt.collision.driver import Driver
from exactpt.kernel.numbers import QQ
from exactpt.pseudotriangulation.audit import audit_angles
from exactpt.testing.audits import run_and_audit
from exactpt.testing.scenes import generate
from exactpt.testing.scenes.shapes import box
from exactpt.tiling.engine import Engine
from exactpt.tiling.greedy.greedy import VerticalRules
from exactpt.tiling.greedy.shadowed import ShadowRules
from exactpt.tiling.lazy import LazyRules
from exactpt.tiling.repairs import RebuildNeeded, Repairs
from exactpt.tiling.simultaneous import FailureGroup
from exactpt.tiling.start import TILINGS, start_tiling


def new_sign(certified, h):
    return -1 if certified.mesh.corner[h] else 1


def scene_triple(certified, h):
    return {(v.body, v.index) for v in certified.vertices_of(h)}


@pytest.mark.plain
@pytest.mark.parametrize(
    "family, seed, tiling",
    [
        ("chains", 2, "greedy"),
        ("pieces", 0, "greedy"),
        # Here the sign that a bend gets decides.
        ("chains", 1, "lazy"),
    ],
)
def test_the_copies_of_one_triple_are_mended_in_perturbed_order(monkeypatch, family, seed, tiling):
    """First the triple of the least half-edge; of its copies none that changes after another."""
    choose, moved = Repairs.first_violated, []

    def checked(repairs):
        repaired = repairs.certified
        due = sorted(repaired.table.angles)
        chosen = choose(repairs)
        triple = scene_triple(repaired, due[0])
        assert scene_triple(repaired, chosen) == triple
        this = repaired.vertices_of(chosen), new_sign(repaired, chosen)
        for h in due:
            if scene_triple(repaired, h) == triple:
                other = repaired.vertices_of(h), new_sign(repaired, h)
                assert not comes_first(*other, *this, repaired.certifier.exact_now)
        moved.append(chosen != due[0])
        return chosen

    monkeypatch.setattr(Repairs, "first_violated", checked)
    for _ in Simulation(generate(family, seed), tiling=tiling).run():
        pass

    assert any(moved)


@pytest.mark.plain
@pytest.mark.parametrize("tiling", ["greedy", "mixed", "lazy"])
def test_what_happens_one_by_one_is_repaired_and_not_built_anew(tiling):
    done = Counter()
    for family in ("convex", "ballistic", "turning", "deforming", "blobs", "stars"):
        simulation = Simulation(generate(family, 1), tiling=tiling)
        done.update(event.kind for event in simulation.run())
        assert simulation.stats["rebuilds"] == 0

    assert done["corner"] > 5
    assert done["reflex"] > 5
    assert done["hull"] > 5


@pytest.mark.plain
@pytest.mark.parametrize("tiling, least", [("greedy", 20), ("lazy", 3)])
def test_repairs_at_one_time_are_checked_unless_they_are_apart(monkeypatch, tiling, least):
    """Where the check is left out, it would have found nothing and changed nothing."""
    done = Counter()
    settle = Repairs.repair_all

    def settled(repairs):
        settle(repairs)
        repaired, failure_group = repairs.certified, repairs.certified.failure_group
        if failure_group.needs_check(repaired.mesh):
            done["checked"] += 1
        elif failure_group._repair > 1:
            done["apart"] += 1
            before = sorted(map(repaired.mesh.ends, repaired.mesh.diagonals()))
            repairs.check_batch()
            assert sorted(map(repaired.mesh.ends, repaired.mesh.diagonals())) == before

    monkeypatch.setattr(Repairs, "repair_all", settled)
    for family, seed in [("concentric", 0), ("grids_passing", 3), ("mirrored", 2)]:
        for _ in Simulation(generate(family, seed), tiling=tiling).run():
            pass

    assert done["apart"] >= least
    assert done["checked"] > 10


@pytest.mark.plain
@pytest.mark.long
def test_a_batch_of_more_repairs_than_are_pending_is_no_reason_to_build_anew():
    """Squares that rise in step through a grid, all at once: what fails then is all there is."""
    grid = [Body(f"{i},{j}", box(4 * i, 4 * j, 1, 1)) for i in range(70) for j in range(2)]
    rise = Translation(0, [0, 1])
    row = [Body(f"r{i}", box(4 * i + 2, -3, 1, 1), rise) for i in range(70)]
    scene = Scene([*grid, *row], (0, 14))
    kinetic = start_tiling(scene, "lazy", QQ(0))

    assert sum(1 for _ in Driver(scene, kinetic).events(scene.end)) > 1000
    assert kinetic.stats.rebuilds == 0


@pytest.mark.plain
@pytest.mark.parametrize("seed, flips", [(0, 0), (4, 2), (7, 2), (36, 3)])
def test_pairs_exchanged_on_one_vertical_line_are_no_reason_to_build_anew(seed, flips):
    """Rings in step: a diagonal that has to give way is not there yet (4, 36), or a bitangent
    that enters finds none to replace (0, 7, 36). What the check flips is the static tiling.
    """
    stats = run_and_audit(generate("concentric", seed), "greedy").kinetic.stats

    assert stats.rebuilds == 0
    assert stats.flips == flips


# The last resort: a tiling that cannot be repaired is built anew, just after now


@pytest.fixture
def every_event_is_repaired(monkeypatch):
    """Isolated events are processed without `Repairs`."""
    for rules in (LazyRules, VerticalRules, ShadowRules):
        monkeypatch.setattr(rules, "slides_are_plain", False)


def refuse(*_):
    raise RebuildNeeded


@pytest.mark.plain
@pytest.mark.long
@pytest.mark.parametrize("tiling", TILINGS)
@pytest.mark.parametrize("family", ["convex", "turning", "small_grid", "blobs"])
@pytest.mark.usefixtures("every_event_is_repaired")
def test_a_run_without_any_repair_finds_the_same(monkeypatch, tiling, family):
    scene = generate(family, 3)
    repaired = run_and_audit(scene, tiling)
    monkeypatch.setattr(Repairs, "repair_all", refuse)

    rebuilt = run_and_audit(scene, tiling)

    assert rebuilt.kinetic.stats.rebuilds > 0
    assert rebuilt.contact == repaired.contact
    assert rebuilt.kinetic.now.compare(repaired.kinetic.now) == 0


@pytest.mark.plain
@pytest.mark.parametrize("tiling", TILINGS)
@pytest.mark.usefixtures("every_event_is_repaired")
def test_a_rebuild_at_the_end_of_the_time_span(monkeypatch, tiling):
    """It was left out once, and the tiling stayed as it was."""
    comb = [(0, 3), (0, 1), (1, 1), (1, 3), (5, 4), (5, 1), (0, 0), (1, 0), (9, 0), (9, 5)]
    bodies = [Body("a", [(2, 3)]), Body("b", comb, Translation([0], [0, 1]))]
    monkeypatch.setattr(Repairs, "repair_all", refuse)

    run = run_and_audit(Scene(bodies, (0, 2)), tiling)

    assert run.kinetic.now.compare_rational(QQ(2)) == 0
    after = OneSided(run.kinetic.certifier, before=False)
    audit_angles(run.kinetic.mesh, after)


@pytest.mark.plain
@pytest.mark.parametrize("tiling", TILINGS)
@pytest.mark.usefixtures("every_event_is_repaired")
def test_a_rebuild_that_never_succeeds_ends(monkeypatch, tiling):
    scene = generate("convex", 3)
    monkeypatch.setattr(Repairs, "repair_all", refuse)
    monkeypatch.setattr(Engine, "_build_anew", lambda *_: False)

    with pytest.raises(AuditError, match="no tiling holds just after t = "):
        run_and_audit(scene, tiling)


# Whether repairs at one time may have met


@pytest.fixture
def mesh():
    boxes = [Body(f"b{i}", [(x, 0), (x + 2, 1), (x, 3)]) for i, x in enumerate((0, 9, 20))]
    scene = Scene(boxes, (0, 1))
    return start_tiling(scene, "lazy", scene.start).mesh.copy()


def faces(mesh):
    """The tiles, as lists of half-edges."""
    seen = {min(mesh.map.face(h)): mesh.map.face(h) for h in mesh.map.half_edges()}
    return list(seen.values())


def batch(*repairs):
    noted = FailureGroup()
    for half_edges in repairs:
        noted.begin_repair()
        noted.touch(half_edges)
    return noted


def test_one_repair_needs_no_check(mesh):
    assert not batch().needs_check(mesh)
    assert not batch([h for face in faces(mesh) for h in face]).needs_check(mesh)


def test_repairs_of_different_tiles_need_none(mesh):
    first, second, *_ = faces(mesh)

    assert not batch(first, second).needs_check(mesh)
    assert not batch(first[:1], second[1:]).needs_check(mesh)


def test_repairs_of_one_tile_do(mesh):
    face = max(faces(mesh), key=len)

    assert batch(face[:1], face[1:2]).needs_check(mesh)
    assert batch(face, face).needs_check(mesh)


def test_so_do_those_of_which_one_has_removed_what_another_had_changed(mesh):
    _, second, *_ = faces(mesh)
    gone = next(h for h in mesh.diagonals() if h not in second and h ^ 1 not in second)
    noted = batch([gone], second[:1])
    mesh.map.remove_edge(gone)

    assert noted.needs_check(mesh)


def test_with_new_motions_any_repair_needs_one(mesh):
    for noted, expected in ((batch(), False), (batch(faces(mesh)[0]), True)):
        noted.has_new_motions = True

        assert noted.needs_check(mesh) == expected


def test_a_new_time_begins_with_nothing(mesh):
    noted = batch(*faces(mesh)[:1], *faces(mesh)[:1])
    noted.has_new_motions = True

    noted.clear()

    assert not noted.touched
    assert not noted.needs_check(mesh)


def test_what_is_doubted_is_checked_whatever_else_is_repaired(mesh):
    noted = batch()
    noted.require_check(faces(mesh)[0])

    assert noted.needs_check(mesh)
    noted.clear()
    assert not noted.needs_check(mesh)
