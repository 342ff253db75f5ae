"""The incremental pseudo-triangulation of one instant: construction and validation."""

from __future__ import annotations

from itertools import pairwise

from exactpt.certificates.at_time import PredicatesAt, sorted_by_x
from exactpt.errors import AuditError
from exactpt.indices import VertexId
from exactpt.tiling.incremental.structure import LOWER, UPPER, IncrementalStructure


def sweep_at(instant: PredicatesAt) -> IncrementalStructure:
    """Return the incremental pseudo-triangulation of an instant: O(n log n)."""
    order = sorted_by_x(instant, map(VertexId, range(len(instant.vertices.all))))
    return IncrementalStructure.sweep(order, instant)


def holds_at(structure: IncrementalStructure, instant: PredicatesAt) -> bool:
    """Return True if a structure that is valid just before or just after an instant is valid at it.

    Args:
        structure: the structure.
        instant: the predicates at the time itself.

    Raises:
        AuditError: if a certificate is violated, instead of only vanishing at it.
    """
    holds = True
    for p, q in pairwise(structure.order):
        if not instant.left_of(p, q):
            if instant.position(p)[0] != instant.position(q)[0]:
                raise AuditError(f"points {p} and {q} are in the wrong order")
            holds = False
    for side, wanted in ((UPPER, 1), (LOWER, -1)):
        for b in structure.order:
            certificate = structure.certificate(side, b)
            if certificate is None:
                continue
            *points, turns_away = certificate
            s = instant.orientation(*points)
            if (s == wanted) != turns_away:
                if s:
                    raise AuditError(f"points {points} turn the wrong way")
                holds = False
    return holds
