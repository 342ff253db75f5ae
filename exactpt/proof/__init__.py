"""Proofs of answers, which a small independent program can verify (docs/proofs.md)."""

from exactpt.proof.certified import certify
from exactpt.proof.written import Proof, prove, write_proof

__all__ = ["Proof", "certify", "prove", "write_proof"]
