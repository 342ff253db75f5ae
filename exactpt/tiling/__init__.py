"""Pseudo-triangulations of the free space, and how they repair themselves."""
