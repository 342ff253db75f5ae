"""Engines, one file each: what it is asked and promises (ABOUT), and its answer to a question."""
