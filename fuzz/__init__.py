"""Fuzzing: random and degenerate scenes, each checked by several independent witnesses.

``python -m fuzz --help`` explains its use, in a checkout (the wheel does not contain it). A failure
is shrunk and saved in ``fuzz/corpus``; the tests replay the corpus.
"""
