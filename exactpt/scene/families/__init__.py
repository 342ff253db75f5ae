"""Seeded scene families, from generic to wholly degenerate; see `exactpt.scene.generate`."""
