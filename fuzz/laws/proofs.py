"""Laws about certificates and proofs: they are accepted, and damaged ones state nothing false."""

from __future__ import annotations

from random import Random
from typing import Final

import exactpt
from exactpt import AuditError, BudgetExceeded, InputError, Proof, Scene, proof_scene
from fuzz.laws.law import check_equal
from fuzz.laws.questions import contact_kind, contact_value
from fuzz.laws.tilings import a_tiling
from fuzz.witnesses import Difference, LeftOutError

__all__ = ["certificates_are_accepted", "proofs_are_accepted"]

HEADER: Final = 2
"""Number of lines of a certificate that are not damaged: the format, the hash of the scene."""


def certificates_are_accepted(scene: Scene, random: Random) -> str:
    """A certificate is accepted and has the first contact; a damaged one states nothing false."""
    try:
        certificate = exactpt.certify(scene)
    except (InputError, BudgetExceeded):
        raise LeftOutError from None  # bodies, or a closeness, that no certificate is about yet
    return _checked(scene, certificate, random)


def proofs_are_accepted(scene: Scene, random: Random) -> str:
    """A proof by a tiling is accepted and has the first contact; a damaged one states no more."""
    tiling = a_tiling(scene, random)
    return f"{tiling}, {_checked(scene, exactpt.prove(scene, tiling=tiling), random)}"


def _checked(scene: Scene, proof: Proof, random: Random) -> str:
    """Check a proof; return the kind of its contact."""
    try:
        proof.check()
    except BudgetExceeded:
        raise LeftOutError from None  # the checker gives up rather than take for ever
    contact = exactpt.first_contact(scene)
    check_equal("contact", proof.contact and proof.contact.time, contact and contact.time)
    if contact is not None:
        _check_damaged(proof, random)
    return contact_kind(contact_value(contact))


def _check_damaged(proof: Proof, random: Random) -> None:
    """Raise a difference if the proof of a contact, damaged, states that there is none."""
    lines = proof.text.split(b"\n")
    if len(lines) <= HEADER:
        return
    number = random.randrange(HEADER, len(lines))
    words = lines[number].split(b" ")
    k = random.randrange(len(words))
    words[k] = random.choice([b"", b"0", b"1", words[k] + b"1", b"-" + words[k]])
    text = b"\n".join([*lines[:number], b" ".join(words), *lines[number + 1 :]])
    if text == proof.text:
        return
    try:
        verdict = proof._replace(text=text).check()
    except (AuditError, proof_scene.NoProofError):
        return
    if "no two bodies share a point" in verdict and "the whole span" in verdict:
        raise Difference("damaged", f"line {number + 1} as {words}: {verdict}")
