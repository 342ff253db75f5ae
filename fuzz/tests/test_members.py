"""The family of members: every reader passes it, and a reader that is silent does not."""

import json
from random import Random

import pytest

from exactpt.exchange import flattening, geojson, mfjson
from exactpt.exchange.losses import Losses
from fuzz.campaign import Progress, campaign
from fuzz.members import FORMATS, Members, case, fault


@pytest.mark.parametrize("kind", FORMATS)
def test_members_are_read_kept_lost_or_refused(tmp_path, kind):
    check, progress, found = Members([kind], 0, tmp_path), Progress(), []

    campaign(check, progress, found.append, count=120)

    assert found == []
    assert progress.counts[kind, "documents"] == 120
    assert progress.counts[kind, "refused"] > 10
    assert progress.counts[kind, "lost"] > 5
    assert check.table(progress.counts)[1].split()[:2] == [kind, "120"]


PLANTED = {
    "losses are not counted": ("geojson", Losses, "count", lambda *_: None),
    "losses are not added": ("geojson", Losses, "add", lambda *_: None),
    "members are not checked": ("geojson", geojson, "_check_members", lambda *_: None),
    "another calendar is not seen": ("mfjson", mfjson, "_check_calendar", lambda *_: None),
    "an interpolation is not seen": ("mfjson", mfjson, "_check_linear", lambda *_: None),
    "a trajectory is a wire": ("mfjson", mfjson, "_is_trajectory", lambda *_: False),
    "animations are not seen": ("svg", flattening, "_check_animation", lambda *_: None),
    "clip paths are not seen": (
        "svg",
        flattening._Flattening,
        "_cut",
        lambda *given: given[2],
    ),
    "a page has no size": (
        "svg",
        flattening,
        "_page",
        lambda *_: flattening._Page((1, 1), (256, 256)),
    ),
}


@pytest.mark.parametrize("planted", PLANTED)
def test_a_silent_reader_is_found(tmp_path, monkeypatch, planted):
    kind, owner, name, silent = PLANTED[planted]
    monkeypatch.setattr(owner, name, silent)

    faults = [fault(case(kind, Random(f"{planted} {i}")), tmp_path) for i in range(150)]

    assert any(faults)


def test_the_documents_of_the_family_are_valid(tmp_path):
    """Without its member each document is read: a refusal is about the member."""
    for i in range(60):
        given = case("geojson", Random(f"valid {i}"))
        if given.effect == "refused":
            continue
        assert json.loads(given.text)["type"] == "FeatureCollection"
        assert fault(given, tmp_path) == ""
