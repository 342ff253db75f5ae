"""The incremental pseudo-triangulation of moving points (paper, section 3)."""
