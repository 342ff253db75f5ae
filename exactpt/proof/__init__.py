"""Proofs: what a small independent program needs to check an answer (docs/proofs.md)."""
