"""What the tests of proofs share: a proof as text, the checkers' verdicts, the reference."""

import re
from pathlib import Path
from tempfile import TemporaryDirectory

import pytest

from exactpt import InputError, proof_check, proof_scene
from exactpt.cgal import check_proof
from exactpt.proof.emit import ProofRun
from exactpt.scene.written import scene_bytes
from exactpt.testing import reference

__all__ = ["accepted", "agrees", "by_both_checkers", "proof_of", "verdict", "without_hash"]


def proof_of(scene, tiling="auto"):
    """The lines of a proof, and the contact that it claims."""
    proof = ProofRun(scene, tiling=tiling)
    lines = list(proof.lines())
    return lines, proof.contact


def without_hash(line):
    """What is proved, without the hash of the scene."""
    return re.sub("^accepted: [0-9a-f]{16} ", "accepted: ", line)


def in_python(scene, proof):
    try:
        return without_hash(proof_check.check(scene, proof))
    except proof_scene.Rejected as rejected:
        return str(rejected)
    except proof_scene.NoProofError as refused:
        return f"rejected: {refused}"


def in_cpp(scene, proof):
    with TemporaryDirectory() as folder:
        paths = [Path(folder) / "scene.json", Path(folder) / "proof"]
        for path, content in zip(paths, (scene, proof), strict=True):
            path.write_bytes(content)
        try:
            return without_hash(check_proof(*paths).line)
        except InputError as refused:
            return str(refused).replace("cgal_check: no proof: ", "rejected: ")


CHECKERS = {"python": in_python, "c++": in_cpp}
current = [in_python]


@pytest.fixture(params=["python", pytest.param("c++", marks=pytest.mark.cgal)])
def by_both_checkers(request, monkeypatch):
    """Each test that uses it runs with either checker."""
    monkeypatch.setattr(f"{__name__}.current", [CHECKERS[request.param]])
    if request.param == "c++":
        request.getfixturevalue("program")


def verdict(scene, lines):
    """What the checker answers, as one line."""
    return current[0](scene_bytes(scene), ("\n".join(lines) + "\n").encode())


def accepted(scene, lines):
    return verdict(scene, lines).startswith("accepted: ")


def agrees(scene, contact):
    """Whether a contact is at the time of the reference's."""
    expected = reference.first_contact(scene)
    if contact is None or expected is None:
        return contact is expected
    return contact.time == expected.time
