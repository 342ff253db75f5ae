"""The incremental pseudo-triangulation of one instant: built, and compared."""

from __future__ import annotations

from itertools import pairwise

from exactpt.certificates.at_time import PredicatesAt, sorted_by_x
from exactpt.errors import AuditError
from exactpt.tiling.incremental.structure import LOWER, UPPER, IncrementalStructure

__all__ = ["holds_at", "sweep_at"]


def sweep_at(instant: PredicatesAt) -> IncrementalStructure:
    """The incremental pseudo-triangulation of an instant: O(n log n)."""
    order = sorted_by_x(instant, range(len(instant.vertices.all)))
    return IncrementalStructure.sweep(order, instant)


def holds_at(structure: IncrementalStructure, instant: PredicatesAt) -> bool:
    """Whether a structure that holds just before or just after an instant holds then.

    Args:
        structure: the structure.
        instant: predicates at the time itself.

    Raises:
        AuditError: if a certificate is violated, and does not just vanish then.
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
            *points, bends = certificate
            s = instant.sign(*points)
            if (s == wanted) != bends:
                if s:
                    raise AuditError(f"points {points} bend the wrong way")
                holds = False
    return holds
