"""Small scope: every placement of small shapes with every order of contact, numbered.

The rest of the fuzzer is random. Here all placements of two touching bodies with few vertices
on a small grid are enumerated, up to symmetry; larger ones are sampled evenly.
"""
