"""Pseudo-triangulations at one instant: half-edges with marks, built, changed and audited."""
