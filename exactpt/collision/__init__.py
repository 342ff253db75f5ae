"""First contacts of a scene: the choice of the search, and the search by a tiling."""
