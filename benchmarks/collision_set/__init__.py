"""The Exact 2D collision set: questions, their exact answers and proofs (docs/collision-set.md)."""
