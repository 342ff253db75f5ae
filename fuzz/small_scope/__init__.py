"""Small scope: every placement of small shapes with every order of contact, by number.

The rest of the fuzzer is random. Here two bodies of few vertices on a small grid are taken
all, up to symmetry, wherever they touch; what is larger is an evenly spread sample.
"""
