"""The mixed pseudo-triangulation of simple polygons (paper, section 5)."""
