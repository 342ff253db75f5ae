"""The last resort: a tiling that cannot be repaired is built anew, just after now."""

import pytest

from exactpt.certificates.one_sided import OneSided
from exactpt.errors import AuditError
from exactpt.kernel.numbers import QQ
from exactpt.motion.body import Body
from exactpt.motion.motions import Translation
from exactpt.pseudotriangulation.audit import audit_angles
from exactpt.scene.generate import generate
from exactpt.scene.scene import Scene
from exactpt.tiling.engine import Engine
from exactpt.tiling.greedy.greedy import VerticalRules
from exactpt.tiling.greedy.shadowed import ShadowRules
from exactpt.tiling.lazy import LazyRules
from exactpt.tiling.repairs import RebuildNeeded, Repairs
from exactpt.tiling.start import TILINGS
from fuzz.statics import run_and_audit

pytestmark = pytest.mark.plain


@pytest.fixture(autouse=True)
def every_event_is_repaired(monkeypatch):
    """Isolated events are processed without `Repairs`."""
    for rules in (LazyRules, VerticalRules, ShadowRules):
        monkeypatch.setattr(rules, "slides_are_plain", False)


def refuse(*_):
    raise RebuildNeeded


@pytest.mark.long
@pytest.mark.parametrize("tiling", TILINGS)
@pytest.mark.parametrize("family", ["convex", "turning", "small_grid", "blobs"])
def test_a_run_without_any_repair_finds_the_same(monkeypatch, tiling, family):
    scene = generate(family, 3)
    repaired = run_and_audit(scene, tiling)
    monkeypatch.setattr(Repairs, "repair_all", refuse)

    rebuilt = run_and_audit(scene, tiling)

    assert rebuilt.kinetic.stats.rebuilds > 0
    assert rebuilt.contact == repaired.contact
    assert rebuilt.kinetic.now.compare(repaired.kinetic.now) == 0


@pytest.mark.parametrize("tiling", TILINGS)
def test_a_rebuild_at_the_end_of_the_time_span(monkeypatch, tiling):
    """It was left out once, and the tiling stayed as it was (corpus cgal-d5efe668f5)."""
    comb = [(0, 3), (0, 1), (1, 1), (1, 3), (5, 4), (5, 1), (0, 0), (1, 0), (9, 0), (9, 5)]
    bodies = [Body("a", [(2, 3)]), Body("b", comb, Translation([0], [0, 1]))]
    monkeypatch.setattr(Repairs, "repair_all", refuse)

    run = run_and_audit(Scene(bodies, (0, 2)), tiling)

    assert run.kinetic.now.compare_rational(QQ(2)) == 0
    after = OneSided(run.kinetic.certifier, before=False)
    audit_angles(run.kinetic.mesh, after)


@pytest.mark.parametrize("tiling", TILINGS)
def test_a_rebuild_that_never_succeeds_ends(monkeypatch, tiling):
    scene = generate("convex", 3)
    monkeypatch.setattr(Repairs, "repair_all", refuse)
    monkeypatch.setattr(Engine, "_build_anew", lambda *_: False)

    with pytest.raises(AuditError, match="no tiling holds just after t = "):
        run_and_audit(scene, tiling)
