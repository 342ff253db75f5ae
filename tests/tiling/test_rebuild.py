"""The last resort: a tiling that cannot be repaired is built anew, just after now."""

import pytest

from exactpt.collision.tilings import TILINGS
from exactpt.errors import AuditError
from exactpt.scene.generate import generate
from exactpt.tiling.kinetic import KineticTiling
from exactpt.tiling.repairs import RebuildNeeded
from fuzz.statics import run_and_audit

pytestmark = pytest.mark.plain


def refuse(*_):
    raise RebuildNeeded


@pytest.mark.parametrize("tiling", TILINGS)
@pytest.mark.parametrize("family", ["convex", "turning", "small_grid", "blobs"])
def test_a_run_without_any_repair_finds_the_same(monkeypatch, tiling, family):
    scene = generate(family, 3)
    repaired = run_and_audit(scene, tiling)
    monkeypatch.setattr(KineticTiling, "_settle", refuse)

    rebuilt = run_and_audit(scene, tiling)

    assert rebuilt.kinetic.stats.rebuilds > 0
    assert rebuilt.contact == repaired.contact
    assert rebuilt.kinetic.now.compare(repaired.kinetic.now) == 0


@pytest.mark.parametrize("tiling", TILINGS)
def test_a_rebuild_that_never_succeeds_ends(monkeypatch, tiling):
    scene = generate("convex", 3)
    monkeypatch.setattr(KineticTiling, "_settle", refuse)
    monkeypatch.setattr(KineticTiling, "_build_anew", lambda *_: False)

    with pytest.raises(AuditError, match="no tiling holds just after t = "):
        run_and_audit(scene, tiling)
