"""Proofs: what a small independent program needs to check an answer (docs/proofs.md)."""

from exactpt.proof.written import Proved, prove, write_proof

__all__ = ["Proved", "prove", "write_proof"]
