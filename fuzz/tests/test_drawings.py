"""The family of drawings: outlines are those of the picture, and a planted mistake is found."""

from random import Random

import pytest

from exactpt.exchange import flattening, svg
from exactpt.exchange.lengths import Matrix
from exactpt.geometry.overlay import evenodd
from fuzz.campaign import Progress, campaign
from fuzz.drawings import Drawings, compared, drawing

pytest.importorskip("resvg_py")
pytest.importorskip("PIL")


def test_outlines_are_those_of_the_picture(tmp_path):
    check, progress, found = Drawings(0, tmp_path), Progress(), []

    campaign(check, progress, found.append, count=120)

    assert found == []
    assert progress.counts["drawing", "same"] > 60


PLANTED = {
    "the axes of a sheared ellipse": (svg, "_keeps_axes", lambda *_: True),
    "the free space beside a viewBox": (
        flattening, "alignment_of", lambda *_: flattening.Alignment(0.0, 0.0),
    ),
    "the place of a copy": (flattening, "moved", lambda *_: Matrix()),
    "the fill rule": (svg, "_FILL_RULES", {"nonzero": evenodd, "evenodd": evenodd}),
}  # fmt: skip


@pytest.mark.parametrize("planted", PLANTED)
def test_a_wrong_place_is_found(monkeypatch, planted):
    owner, name, wrong = PLANTED[planted]
    monkeypatch.setattr(owner, name, wrong)

    outcomes = [compared(drawing(Random(f"drawing 0 {i}"))).outcome for i in range(240)]

    assert "FAULT" in outcomes
