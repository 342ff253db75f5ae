"""The client of cgal_check, an independent checker: a separate program, reached over a pipe.

The program and its line protocol are described in cgal_check/README.md. This package finds the
program (`client`), writes requests with exact rationals (`requests`) about `claims`, and reads
the verdicts; it decides nothing itself. Tilings are given as the ``tile`` dictionary of
docs/format.md. Proofs are verified by a call of their own (`proofs`).
"""

from exactpt.cgal.build import build_program
from exactpt.cgal.claims import (
    BodyShape,
    IsolatedRoot,
    PlacedBody,
    Relation,
    RootClaim,
    Signs,
    Tile,
    Verdict,
)
from exactpt.cgal.client import CgalCheck, find_program
from exactpt.cgal.proofs import ProofVerdict, check_proof, check_proofs

__all__ = [
    "BodyShape",
    "CgalCheck",
    "IsolatedRoot",
    "PlacedBody",
    "ProofVerdict",
    "Relation",
    "RootClaim",
    "Signs",
    "Tile",
    "Verdict",
    "build_program",
    "check_proof",
    "check_proofs",
    "find_program",
]
