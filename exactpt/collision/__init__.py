"""First contacts of a scene: by a tiling, by a search over pairs, and by a plain exact search."""
