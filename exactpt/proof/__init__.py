"""Proofs of answers, which a small independent program can verify (docs/proofs.md)."""

from exactpt.proof.written import Proved, prove, write_proof

__all__ = ["Proved", "prove", "write_proof"]
