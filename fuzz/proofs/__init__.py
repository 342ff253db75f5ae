"""Proofs under attack: mutants of proofs of right answers, and proofs of wrong ones."""
