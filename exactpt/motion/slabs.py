"""Slabs of time, in each of which moving boxes are compared: one policy for all sweeps."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from typing import TYPE_CHECKING, Final, NamedTuple, TypeAlias

from exactpt.kernel.budget import check_budget
from exactpt.kernel.numbers import QQ

if TYPE_CHECKING:
    from exactpt.kernel.doubles import Indices

Near: TypeAlias = "tuple[Indices, Indices]"
"""Pairs of things, by number."""

PATIENCE: Final = 8
"""Number of slabs after which a longer one is tried, whatever was found before."""
SMALLEST: Final = 1 << 40
"""The shortest slab is the time span divided by this."""


class Slab(NamedTuple):
    """A slab of time.

    Attributes:
        start, end: its ends.
        near: the candidates in it.
    """

    start: QQ
    end: QQ
    near: Near

    @property
    def size(self) -> int:
        """The number of candidates."""
        return len(self.near[0])


def slabs(
    start: QQ, end: QQ, slab: Callable[[QQ, QQ], Slab], many: int, first: QQ, longest: QQ
) -> Iterator[Slab]:
    """Cut a time span into slabs.

    With many candidates a slab is shortened, by 4 or by 16, as long as these get fewer by the
    square root of that at least; else they stay near each other, and shorter slabs do not help.
    After a slab that was too long, the following ones are shorter than it for a while.

    The next slab is twice as long if the candidates are few, so that few are compared in more than
    one. It also is if their number does not follow from the length: if they are many but stay near
    each other, or hardly more than in the slab before, of half the length. After some slabs of one
    length a longer one is tried, which shows whether it does.

    Args:
        start: the start of the first slab.
        end: the end of the last one.
        slab: returns the slab between two times, or one that begins there and ends earlier.
        many: the number of candidates above which a slab is shortened.
        first: the length of the first slab, if it is not shortened.
        longest: the length of the longest one.
    """
    step, limit, least = first, longest, (end - start) / SMALLEST
    since = 0  # number of slabs since one was too long
    equal = 0  # number of slabs of the same length
    half: Slab | None = None  # the slab before, if it was half as long
    now = start
    while now < end:
        check_budget()
        whole = tried = step
        found = slab(now, min(now + step, end))
        while found.size > many and tried > least and 8 * tried >= step:
            tried /= 4
            fewer = slab(now, min(now + tried, end))
            if fewer.size**2 * step <= found.size**2 * tried:
                step, found = tried, fewer
        yield found
        since, equal = since + 1, equal + 1
        is_too_long = step < whole
        if is_too_long:
            limit, since, equal = whole / 2, 0, 1
        elif since > PATIENCE:
            limit = longest
        is_few = 4 * found.size < many
        stays = found.size > many and not is_too_long
        hardly_grows = half is not None and found.size**2 <= 2 * half.size**2
        half = None
        if found.end == now + step and (is_few or stays or hardly_grows or equal > PATIENCE):
            longer = min(2 * step, limit)
            if longer > step:
                half, equal = found, 0
            step = longer
        now = found.end
