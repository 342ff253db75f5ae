"""Scenes with rings that touch: no checker accepts a proof or a certificate of one."""

import hashlib

import pytest
from proving import by_both_checkers, proof_of, verdict  # noqa: F401 - a fixture

from exactpt import Body, Scene, Translation, certify, check_apart, proof_scene
from exactpt.proof.lines import header
from exactpt.scene.written import scene_bytes
from fuzz.proofs.checking import checker

SQUARE = [(0, 0), (8, 0), (8, 8), (0, 8)]

TOUCHING = {
    "a vertex on an edge": [[(4, 0), (5, 2), (3, 2)]],
    "two vertices": [[(0, 0), (2, 1), (1, 2)]],
    "two holes": [[(2, 2), (4, 4), (2, 4)], [(4, 4), (6, 6), (4, 6)]],
    "the inside divided": [[(0, 4), (4, 3), (8, 4)]],
}


def scene_of(holes):
    """A body that is not validated, and a ball beside it that never touches it."""
    ball = Body("ball", [(20, 0), (21, 0), (20, 1)], Translation([0, 1]))
    scene = Scene([ball], (0, 1))
    return scene.going_on([Body("b", SQUARE, holes=holes), ball], scene.exact_start)


def simple(holes):
    """As many holes of as many vertices, small and apart."""
    small = [[(1, 1), (2, 1), (1, 2)], [(4, 4), (5, 4), (4, 5)]]
    return scene_of(small[: len(holes)])


@pytest.mark.usefixtures("by_both_checkers")
@pytest.mark.parametrize("name", TOUCHING)
def test_a_proof_about_rings_that_touch_is_rejected(name):
    """The lines are those of a proof about a body with other holes, that is accepted."""
    lines, _ = proof_of(simple(TOUCHING[name]), "lazy")
    scene = scene_of(TOUCHING[name])
    forged = [*header(scene_bytes(scene), scene.exact_start, scene.exact_end), *lines[3:]]
    assert "not simple" in verdict(scene, forged)


def certificate(name):
    """The scene and the certificate of a body with other holes, about this one."""
    content = scene_bytes(scene_of(TOUCHING[name]))
    text = certify(simple(TOUCHING[name])).text.decode().splitlines(keepends=True)
    text[1] = f"scene sha256 {hashlib.sha256(content).hexdigest()}\n"
    return content, "".join(text).encode()


@pytest.mark.parametrize("name", TOUCHING)
def test_a_certificate_about_rings_that_touch_is_rejected(name):
    with pytest.raises(proof_scene.NoProofError, match="not simple at the start"):
        check_apart.check(*certificate(name))


@pytest.mark.cgal
@pytest.mark.parametrize("name", TOUCHING)
def test_cgal_check_rejects_a_certificate_about_rings_that_touch(name):
    assert "not simple at the start" in checker().verdict(*certificate(name))
