"""Which points coincide: found by the x-order alone.

Two points that coincide at a time have equal x then, and so has every point between them in
the order just before. So each pair of neighbours from the one to the other either has equal
x for ever, or a certificate that vanishes at that time (one that does so without change of
sign is scheduled too). Where such pairs form a run, its points of equal y are in contact.
"""

from __future__ import annotations

from collections.abc import Iterable
from functools import cmp_to_key
from itertools import groupby

from exactpt.certificates.certifier import X_ORDER, Certifier
from exactpt.certificates.coincidence import coordinate_order
from exactpt.motion.incidence import Touch, difference
from exactpt.tiling.incremental.structure import IncrementalStructure

__all__ = ["coinciding", "column_around"]


def coinciding(
    certifier: Certifier, structure: IncrementalStructure, level: Iterable[int]
) -> list[Touch]:
    """The points that coincide now, as pairs, in order.

    Args:
        certifier: at the current time.
        structure: as it was just before.
        level: points that have the x of the next one now, by a certificate that vanishes.
    """

    def height_order(p: int, q: int) -> int:
        return coordinate_order(certifier, certifier.all[q], certifier.all[p], 1)

    order, rank = structure.order, structure.rank
    found: list[Touch] = []
    done = -1
    for i in sorted(rank[p] for p in level):
        if i < done:
            continue
        low, high = i, i + 1
        while low > 0 and _is_level(certifier, order[low - 1], order[low]):
            low -= 1
        while high + 1 < len(order) and _is_level(certifier, order[high], order[high + 1]):
            high += 1
        done = high
        run = order[low : high + 1]
        if len(run) == 2 and height_order(*run):
            continue
        height = cmp_to_key(height_order)
        for _, equal in groupby(sorted(run, key=height), key=height):
            group = sorted(equal)
            found += [Touch(p, 0, q, -1, 0) for j, q in enumerate(group) for p in group[:j]]
    return sorted(found)


def column_around(certifier: Certifier, structure: IncrementalStructure, p: int) -> tuple[int, int]:
    """The ranks, from the one to before the other, of the points that have the x of p now."""
    order, rank, vertices = structure.order, structure.rank, certifier.all
    low = high = rank[p]
    while low > 0 and not coordinate_order(certifier, vertices[order[low - 1]], vertices[p], 0):
        low -= 1
    while high + 1 < len(order) and not coordinate_order(
        certifier, vertices[order[high + 1]], vertices[p], 0
    ):
        high += 1
    return low, high + 1


def _is_level(certifier: Certifier, p: int, q: int) -> bool:
    """Whether two neighbours in x-order have equal x now, by a certificate, or for ever."""
    if certifier.vanishes_now(p, q, X_ORDER):
        return True
    a, b = certifier.all[p], certifier.all[q]
    f, g = a.image, b.image
    if not (f.ws or g.ws) and (f.x0 < g.x0 or f.x0 > g.x0 or f.x1 < g.x1 or f.x1 > g.x1):
        return False  # equal coefficients have equal images
    return not difference(a.track.x, a.track.w, b.track.x, b.track.w)
