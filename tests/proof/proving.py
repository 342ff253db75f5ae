"""What the tests of proofs share: a proof as text, the checker's verdict, the reference."""

from exactpt import proof_check
from exactpt.collision.allpairs import first_contact_allpairs
from exactpt.proof.emit import Proof, scene_bytes

__all__ = ["accepted", "agrees", "proof_of", "verdict"]


def proof_of(scene, tiling="auto"):
    """The lines of a proof, and the contact that it claims."""
    proof = Proof(scene, tiling=tiling)
    lines = list(proof.lines())
    return lines, proof.contact


def verdict(scene, lines):
    """What the checker answers, as one line."""
    try:
        return proof_check.check(scene_bytes(scene), ("\n".join(lines) + "\n").encode())
    except proof_check.Rejected as rejected:
        return str(rejected)


def accepted(scene, lines):
    return verdict(scene, lines).startswith("accepted: ")


def agrees(scene, contact):
    """Whether a contact is at the time of the reference's."""
    expected = first_contact_allpairs(scene)
    if contact is None or expected is None:
        return contact is expected
    return contact.time == expected.time
