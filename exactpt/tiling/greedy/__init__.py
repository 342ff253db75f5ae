"""The greedy vertical pseudo-triangulation (paper, section 4)."""
