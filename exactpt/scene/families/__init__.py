"""Scene families, from generic to fully degenerate; see `exactpt.scene.generate`."""
