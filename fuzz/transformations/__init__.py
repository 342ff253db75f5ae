"""Transformations of scenes that leave the motion of every point as it is, and what they keep.

Edges are subdivided, vertices renumbered, rings reversed, bodies permuted, and rigid bodies that
move alike become parts of one body, or parts become bodies. The answer to each question about
the new scene must be the old answer, once numbers and names are mapped back.
"""
