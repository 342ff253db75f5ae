"""Slabs of time, in each of which moving boxes are compared: one policy for all sweeps."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from itertools import pairwise
from typing import TYPE_CHECKING, Final, TypeAlias

from exactpt.kernel.budget import check_budget
from exactpt.kernel.numbers import QQ

if TYPE_CHECKING:
    from exactpt.kernel.doubles import Indices

Near: TypeAlias = "tuple[Indices, Indices]"
"""Pairs of things, by number."""

PATIENCE: Final = 8
"""Number of slabs after which one as long as the last that was too long is tried again."""
SMALLEST: Final = 1 << 40
"""The shortest slab is the time span divided by this."""


def slabs(
    times: Sequence[QQ], near: Callable[[QQ, QQ], Near], many: int, first: QQ, longest: QQ
) -> Iterator[tuple[QQ, QQ, Near]]:
    """Cut a time span into slabs; yield the start, the end and the candidates of each.

    With many candidates a slab is shortened, by 4 or by 16, as long as these get fewer by the
    square root of that at least; else they stay near each other, and shorter slabs do not help.
    After a slab that was too long, the following ones are shorter than it for a while. They are
    longer while there are few candidates, so that few are compared in more than one.

    Args:
        times: the start, times that are in no slab but as an end, and the end, in order.
        near: the candidates of a slab.
        many: the number of candidates above which a slab is shortened.
        first: the length of the first slab, if it is not shortened.
        longest: the length of the longest one.
    """
    step, limit, least = first, longest, (times[-1] - times[0]) / SMALLEST
    since = 0  # number of slabs since one was too long
    for begin, until in pairwise(times):
        now = begin
        while now < until:
            check_budget()
            whole = tried = step
            later = min(now + step, until)
            found = near(now, later)
            while len(found[0]) > many and tried > least and 8 * tried >= step:
                tried /= 4
                fewer = near(now, min(now + tried, until))
                if len(fewer[0]) ** 2 * step <= len(found[0]) ** 2 * tried:
                    step, later, found = tried, min(now + tried, until), fewer
            yield now, later, found
            since += 1
            if step < whole:
                limit, since = whole / 2, 0
            elif since > PATIENCE:
                limit = longest
            if later == now + step and 4 * len(found[0]) < many:
                step = min(2 * step, limit)
            now = later
