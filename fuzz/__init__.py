"""Fuzzing: random and degenerate scenes, each checked by several independent witnesses.

``python -m fuzz --help`` explains its use, in a checkout (the wheel does not contain it). A failure
is shrunk and saved in ``tests/cases``, where the tests check all laws on it.
"""
