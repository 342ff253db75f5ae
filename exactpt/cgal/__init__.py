"""The client of cgal_check, an independent checker: a separate program, reached over a pipe.

The program and its line protocol are described in cgal_check/README.md. This package finds the
program (`client`), writes requests with exact rationals (`requests`) about `claims`, and reads
the verdicts; it decides nothing itself. Tilings are given as the ``tile`` dictionary of
docs/format.md.
"""

from exactpt.cgal.claims import BodyShape, IsolatedRoot, RootClaim, Signs, Tile, Verdict
from exactpt.cgal.client import CgalCheck, find_program

__all__ = [
    "BodyShape",
    "CgalCheck",
    "IsolatedRoot",
    "RootClaim",
    "Signs",
    "Tile",
    "Verdict",
    "find_program",
]
