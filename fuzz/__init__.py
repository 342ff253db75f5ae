"""Fuzzing: random and degenerate scenes, each checked by several independent witnesses.

``python -m fuzz --help`` says how to run it, in a checkout (the wheel is without it). A failure
is shrunk and saved in ``fuzz/corpus``, and the tests replay what is there.
"""
