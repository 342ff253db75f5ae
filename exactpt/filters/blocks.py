r"""Boxes of consecutive vertices or edges: what is far from a piece is passed over in blocks.

The idea: an outline of thousands of edges around a crowd is far from each body of the crowd, but
for a few of its edges. Consecutive edges of an outline are near each other. So the box of a block
of them is small, and one comparison excludes all of them::

        +-------+-------+
        |   /\  |       |         The boxes of two blocks. Only the second one meets the box
        |  /  \ |  _/\__|         of the other piece, and only its edges are looked at.
        | /    \|_/     |
        +-------+-------+
                     +-----+
                     |     |
                     +-----+

*What is proved.* The box of a block contains the boxes that were added, without rounding. So a
block that is certainly apart from another box has only features that are. If a number is not
finite, no block is apart from anything.
"""

from __future__ import annotations

from typing import Final

from librt.vecs import append, vec
from mypy_extensions import i64

BLOCK: Final[i64] = 32
"""Number of features in a block."""
FEW: Final[i64] = 64
"""Number of features up to which all of them are looked at."""


class Blocks:
    """The boxes of blocks of features.

    Attributes:
        count: the number of features.
    """

    def __init__(self) -> None:
        self.count: i64 = 0
        self._left = vec[float]()
        self._right = vec[float]()
        self._bottom = vec[float]()
        self._top = vec[float]()
        self._zero = 0.0  # NaN if a number is not finite

    def add(self, left: float, right: float, bottom: float, top: float) -> None:
        """Add the box of the next feature."""
        block = self.count // BLOCK
        if self.count % BLOCK == 0:
            self._left = append(self._left, left)
            self._right = append(self._right, right)
            self._bottom = append(self._bottom, bottom)
            self._top = append(self._top, top)
        else:
            self._left[block] = min(self._left[block], left)
            self._right[block] = max(self._right[block], right)
            self._bottom[block] = min(self._bottom[block], bottom)
            self._top[block] = max(self._top[block], top)
        self._zero += 0.0 * left + 0.0 * right + 0.0 * bottom + 0.0 * top
        self.count += 1

    def may_meet(self, block: i64, left: float, right: float, bottom: float, top: float) -> bool:
        """Return True unless the features of a block are certainly apart from a box."""
        is_beside = self._left[block] > right or self._right[block] < left
        is_above_or_below = self._bottom[block] > top or self._top[block] < bottom
        return not (is_beside or is_above_or_below) or self._zero != 0.0


def next_near(
    blocks: Blocks | None, k: i64, left: float, right: float, bottom: float, top: float
) -> i64:
    """Return the first feature from k on whose block may meet a box; there may be none.

    Args:
        blocks: the blocks of all features; None if they are few, and all of them count.
        k: the number of a feature, the next one after a feature that counts.
        left: the box.
        right: likewise.
        bottom: likewise.
        top: likewise.
    """
    if blocks is None or k % BLOCK != 0:
        return k
    while k < blocks.count and not blocks.may_meet(k // BLOCK, left, right, bottom, top):
        k += BLOCK
    return k
