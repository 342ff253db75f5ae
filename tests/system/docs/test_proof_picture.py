"""The picture of a proof in the README is drawn from a proof that is accepted."""

import runpy
from pathlib import Path

import exactpt

DOCS = Path(__file__).parents[3] / "docs"


def test_picture():
    script = runpy.run_path(str(DOCS / "draw_proof.py"))
    assert exactpt.prove(script["SCENE"], tiling="lazy").check().startswith("accepted: ")
    assert script["picture"]() == (DOCS / "proof.svg").read_text(encoding="utf-8")
