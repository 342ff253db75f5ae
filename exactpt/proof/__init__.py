"""Proofs of first contacts, which a small independent program can verify (docs/proofs.md)."""

from exactpt.proof.certified import certificate_of, certify, certify_rows
from exactpt.proof.written import Proof, prove, write_proof

__all__ = ["Proof", "certificate_of", "certify", "certify_rows", "prove", "write_proof"]
