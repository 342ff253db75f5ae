"""Pseudo-triangulations of one instant: half-edges with marks, built, changed and audited."""
