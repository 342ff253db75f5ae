"""A running scene: its events, its tiling at any time, its contacts."""
