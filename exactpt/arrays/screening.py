"""Pairs of bodies whose numbers are rounded to doubles: what filters decide about the exact."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from exactpt.arrays.blocks import Block
from exactpt.arrays.contacts import Contacts
from exactpt.arrays.motions import relative_motions
from exactpt.arrays.outlines import outlines_of
from exactpt.arrays.spans import read_spans
from exactpt.arrays.turning import record_turning
from exactpt.filters.rounding import SLACK, U
from exactpt.kernel.doubles import Floats
from exactpt.scene.body_arrays import BodyArrays
from exactpt.scene.scene import Scene


def screened(
    bodies: BodyArrays,
    time: Floats,
    scene: Callable[[int], Scene],
    turns: Floats | None = None,
) -> Contacts:
    """Return the first contacts of the pairs (0, 1), (2, 3), ... of bodies with rounded numbers.

    Where filters decide, the result is that of the exact scene. Else ``exact`` is true, and the
    pair is left open: its bodies may also be none (a polygon that is not simple).

    Args:
        bodies: of which each coordinate and coefficient is 0, or the double nearest to the exact
            number and not below 2^-900 in size.
        time: shape (m, 2), the starts and the ends of the time spans.
        scene: the exact scene of a pair.
        turns: if bodies turn, likewise: for each two coefficients of its half turn, its pivot, and
            the cosine and the sine of its first orientation.
    """
    count = len(bodies) // 2
    contacts = Contacts(count, scene)
    outlines = outlines_of(bodies)
    largest = np.maximum(np.abs(outlines.low), np.abs(outlines.high)).max(axis=1)
    rounded = U * SLACK * largest
    spans = read_spans(time, count)
    if turns is None:
        i, j = np.arange(2 * count).reshape(-1, 2).T
        motions = relative_motions(bodies.coefficients, i, j, spans, rounded)
        Block(outlines, bodies, contacts, np.arange(count), i, j, spans, motions).answer()
    else:
        record_turning(bodies, outlines, turns, spans, contacts)
    doubtful = np.array(bodies.doubtful(rounded=rounded), dtype=np.int64) // 2
    contacts.exact[doubtful] = True
    return contacts
