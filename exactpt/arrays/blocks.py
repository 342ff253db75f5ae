"""The first contacts of a block of pairs: boxes, then filters, then exact arithmetic."""

from __future__ import annotations

from typing import Final, NamedTuple

import numpy as np

from exactpt.arrays.answers import record_edges, record_overlaps
from exactpt.arrays.candidates import Candidates, all_candidates, vertex_candidates
from exactpt.arrays.contacts import Contacts
from exactpt.arrays.incidence_times import INFINITY, first_incidences
from exactpt.arrays.motions import Motions, reaches
from exactpt.arrays.outlines import Outlines
from exactpt.arrays.radii import vertex_incidences
from exactpt.arrays.relative import Coefficient, Relative, orientations, sides
from exactpt.arrays.sharpening import sharpened
from exactpt.arrays.spans import Spans
from exactpt.arrays.starts import at_start
from exactpt.arrays.undecided import decide, search
from exactpt.filters.rounding import SLACK, U
from exactpt.geometry.ragged import ranges
from exactpt.kernel.doubles import Flags, Floats, Indices, native
from exactpt.pair.straight import Candidate
from exactpt.scene.body_arrays import BodyArrays

CHUNK: Final = 1 << 14
"""Maximum number of pairs of a vertex and an edge at a time: their arrays fit a cache."""
LARGEST: Final = 1 << 18
"""Maximum number of pairs of a vertex and an edge of two bodies; more are searched by boxes."""


class Block(NamedTuple):
    """Some pairs (i, j) of bodies.

    Attributes:
        outlines, bodies: all bodies.
        contacts: where the results are written.
        numbers: the numbers of the pairs.
        i, j: the bodies of the pairs.
        spans: their time spans.
        motions: the motions of i relative to j.
        reach: the sums of the radii, positive and rounded; None if all are 0.
    """

    outlines: Outlines
    bodies: BodyArrays
    contacts: Contacts
    numbers: Indices
    i: Indices
    j: Indices
    spans: Spans
    motions: Motions
    reach: Floats | None = None

    def answer(self) -> None:
        """Record the first contacts."""
        near = self._near()
        o, i, j = self.outlines, self.i[near], self.j[near]
        reach = None if self.reach is None else self.reach[near]
        overlaps, unclear = at_start(o, i, j, self.motions.take(near), reach)
        over = near[overlaps]
        record_overlaps(self.contacts, self.numbers[over], self.spans.start[over])
        counts = o.vertex_count[i] * o.edge_count[j] + o.vertex_count[j] * o.edge_count[i]
        for k in near[~overlaps & (counts > LARGEST)].tolist():
            self._search(k)
        left = ~overlaps & (counts <= LARGEST)
        near, unclear = near[left], unclear[left]
        for first, last in ranges(counts[left], CHUNK):
            self._compare(near[first:last], unclear[first:last])

    @np.errstate(all="ignore")
    def _near(self) -> Indices:
        """Return the pairs whose boxes may intersect during the span.

        A gap takes two sums, of terms that add up to at most ``size``.
        """
        o, i, j = self.outlines, self.i, self.j
        least, most, error = reaches(self.motions, self.spans.length.high)
        gap = np.maximum(o.low[i] - o.high[j] + least, o.low[j] - o.high[i] - most)
        size = np.maximum(np.abs(o.low[i]), np.abs(o.high[i]))
        size += np.maximum(np.abs(o.low[j]), np.abs(o.high[j]))
        size += np.maximum(np.abs(least), np.abs(most))
        reach = 0.0 if self.reach is None else self.reach[:, None]
        apart = gap > (4.0 * U * (size + reach) + error) * SLACK + reach
        return np.flatnonzero(~apart.any(axis=1))

    @np.errstate(all="ignore")
    def _compare(self, k: Indices, unclear: Flags) -> None:
        """Record the contacts of the pairs k, of which some may touch at the start.

        The first contact is certain if the enclosure of one candidate's incidence is before all
        other times at which a candidate touches or may touch. All incidences at the time of the
        first contact are of candidates that are left.
        """
        o, n, two, motions = self.outlines, len(k), (self.i[k], self.j[k]), self.motions.take(k)
        length, reach = self.spans.length.take(k), None if self.reach is None else self.reach[k]
        candidates, starts = all_candidates(o, *two)
        pair = candidates.pair
        relative = candidates.relative(o, motions)
        reaches = None if reach is None else reach[pair]
        low, high = first_incidences(relative, length.take(pair), reaches)
        best = np.minimum.reduceat(high, native(starts)).reshape(2, n).min(axis=0)
        left = np.flatnonzero((low <= best[pair]) & (low < INFINITY))
        left = left[~_beside_until(relative, low, high, best[pair], left)]
        if reach is not None:
            corners, starts = vertex_candidates(o, *two)
            until = np.minimum(best, length.high)
            lows, highs = vertex_incidences(o, motions, corners, reach, until)
            highs[highs > length.low[corners.pair]] = INFINITY
            best = np.minimum(best, np.minimum.reduceat(highs, native(starts)))
            near = np.flatnonzero((lows <= best[corners.pair]) & (lows < INFINITY))
            left = np.concatenate((left[low[left] <= best[pair[left]]], near + len(low)))
            candidates, pair = candidates.joined(corners), np.concatenate((pair, corners.pair))
            low, high = np.concatenate((low, lows)), np.concatenate((high, highs))
        counts = np.bincount(pair[left], minlength=n)
        open_ = unclear | (counts > 1) | ((counts == 1) & (best == INFINITY))
        hits = left[~open_[pair[left]]]
        cs = orientations(relative.take(hits)) if reach is None else []
        self._record(k, candidates.take(hits), cs, low[hits], high[hits])
        left = left[open_[pair[left]]]
        left = left[np.argsort(pair[left], kind="stable")]
        times = self.spans.at(k[pair[left]]).times(low[left], high[left])
        listed = candidates.take(left).listed(o, *two, *times)
        end = np.cumsum(np.where(open_, counts, 0))
        for m in np.flatnonzero(open_).tolist():
            some = listed[int(end[m] - counts[m]) : int(end[m])]
            self._decide(int(k[m]), sorted(some), unclear=bool(unclear[m]))

    def _record(
        self, k: Indices, hits: Candidates, cs: list[Coefficient], low: Floats, high: Floats
    ) -> None:
        """Record incidences of pairs among k; ``cs`` if they are zeros of orientations."""
        a, b = hits.bodies(self.i[k], self.j[k])
        k = k[hits.pair]
        if self.is_rounded or not cs:
            low, high = self.spans.at(k).times(low, high)
        else:
            precise = hits.exact(self.outlines, self.bodies.coefficients, a, b, len(cs))
            low, high = sharpened(precise, cs, self.spans.start[k], low, high)
        numbers = hits.numbered(self.outlines, a, b)
        record_edges(self.contacts, self.numbers[k], low, high, hits.second, *numbers)

    @property
    def is_rounded(self) -> bool:
        """True if the numbers of the bodies are the doubles nearest to the exact ones."""
        return self.motions.edges is not None

    def _search(self, k: int) -> None:
        """Search pair k exactly; if its bodies are rounded, leave it open."""
        if self.is_rounded:
            self.contacts.exact[self.numbers[k]] = True
        else:
            search(self.contacts, int(self.numbers[k]))

    def _decide(self, k: int, candidates: list[Candidate], *, unclear: bool) -> None:
        if self.is_rounded or self.motions.degree > 2:
            self._search(k)
        else:
            decide(self.contacts, int(self.numbers[k]), candidates, unclear=unclear)


def _beside_until(
    relative: Relative, low: Floats, high: Floats, until: Floats, some: Indices
) -> Flags:
    """Of some candidates, whether they are undecided and surely do not touch up to a time."""
    beside = np.zeros(len(some), dtype=np.bool_)
    at = np.flatnonzero((high[some] == INFINITY) & (until[some] < INFINITY))
    doubtful = some[at]
    beside[at] = sides(relative.take(doubtful), low[doubtful], until[doubtful])[1]
    return beside
