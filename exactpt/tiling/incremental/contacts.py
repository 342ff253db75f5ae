"""Contacts of points, found by the x-order alone.

Two points that coincide at a time have equal x, and so has every point between them in
the order just before. So each pair of neighbours from one to the other either has equal x
for all times, or a certificate that vanishes at that time (certificates that vanish without a
change of sign have events too). Consecutive such pairs form a column, and points of equal y
in it are in contact.
"""

from __future__ import annotations

from collections.abc import Iterable
from functools import cmp_to_key
from itertools import groupby

from exactpt.certificates.certifier import X_ORDER, Certifier
from exactpt.certificates.coincidence import coordinate_order
from exactpt.indices import VertexId
from exactpt.motion.track import Incidence, difference
from exactpt.tiling.incremental.structure import IncrementalStructure


def coinciding(
    certifier: Certifier, structure: IncrementalStructure, candidates: Iterable[VertexId]
) -> list[Incidence]:
    """Return the points that coincide now, as pairs, in order.

    Args:
        certifier: at the current time.
        structure: the structure just before now.
        candidates: the points whose x-order with the next point vanishes now.
    """

    def height_order(p: VertexId, q: VertexId) -> int:
        return coordinate_order(certifier, certifier.all[q], certifier.all[p], 1)

    order, rank = structure.order, structure.rank
    found: list[Incidence] = []
    done = -1
    for i in sorted(rank[p] for p in candidates):
        if i < done:
            continue
        low, high = i, i + 1
        while low > 0 and _have_equal_x(certifier, order[low - 1], order[low]):
            low -= 1
        while high + 1 < len(order) and _have_equal_x(certifier, order[high], order[high + 1]):
            high += 1
        done = high
        column = order[low : high + 1]
        if len(column) == 2 and height_order(*column):
            continue
        height = cmp_to_key(height_order)
        for _, equal in groupby(sorted(column, key=height), key=height):
            group = sorted(equal)
            found += [
                Incidence(int(p), 0, int(q), -1, 0) for j, q in enumerate(group) for p in group[:j]
            ]
    return sorted(found)


def _have_equal_x(certifier: Certifier, p: VertexId, q: VertexId) -> bool:
    """Return True if two neighbours in the x-order have equal x, now or for all times."""
    if certifier.vanishes_now(p, q, X_ORDER):
        return True
    a, b = certifier.all[p], certifier.all[q]
    f, g = a.float_track, b.float_track
    if not (f.ws or g.ws) and (f.x0 < g.x0 or f.x0 > g.x0 or f.x1 < g.x1 or f.x1 > g.x1):
        return False  # equal coefficients have equal doubles
    return not difference(a.track.x, a.track.w, b.track.x, b.track.w)
