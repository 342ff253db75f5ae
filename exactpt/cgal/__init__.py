"""The client of cgal_check, the independent witness: a separate program, asked over a pipe.

The program and the line protocol are described in cgal_check/README.md. This room finds
the program (`client`), writes requests with exact rationals (`requests`) about `claims`,
and reads the verdicts; it decides nothing itself. A tiling goes out as the contract's
``tile`` dictionary has it.
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
