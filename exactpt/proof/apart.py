"""The nodes of a certificate that bodies stay apart (docs/proofs.md, Certificates).

Floats choose moving lines, and on which side of them an item is, if by more than an error bound;
else the checker's own exact test decides. So the nodes are those that the checker goes through.
"""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterator, Sequence
from fractions import Fraction
from typing import Any, Final, TypeAlias, final

import numpy as np

from exactpt.errors import BudgetExceeded
from exactpt.kernel.budget import check_budget
from exactpt.kernel.doubles import Floats
from exactpt.proof.frame import Cut, Extents, Frame
from exactpt.proof.paths import DIRECTIONS, Items, Paths, Plane
from exactpt.proof.whole import MOST, VECTORS, WholeBodies, direction_between
from exactpt.proof_scene import written

CLEAR: Final = 1e-11
"""Smallest gap that a line is put into, relative to the extent of all items."""
CROSSING: Final = 1.7
"""Parts of all items that both children of a node with a line through some of them may have."""
FEW, CLOSE = 8, 1e-15
"""Of so few items, gaps down to the second number are tried: the exact test decides."""
MANY: Final = 24
"""Number of items up to which edges and nearest vertices propose directions, too."""
FINEST: Final = 2**40
"""Times are not halved further than to this part of the span."""
Node: TypeAlias = "tuple[Items | None, set[int], Frame | tuple[Fraction, Fraction], int]"
"""Items (None: all of the frame), their bodies, the interval, and the number of nodes above."""
PLACES: Final = np.array([20, 35, 50, 65, 80])
"""Percentages of the items below lines that some items cross."""


@final
class Separation:
    """The search for the nodes of a certificate.

    Args:
        paths: the vertices.
        groups: a number for each body; bodies with equal ones do not count as a pair.
        counts: whether two of some bodies are a pair that counts.
        counted: the pairs of bodies that count, if they are named.
    """

    def __init__(
        self,
        paths: Paths,
        groups: Sequence[int],
        counts: Callable[[set[int]], bool],
        counted: Collection[tuple[int, int]] | None = None,
    ) -> None:
        self._paths, self._counts, self._counted = paths, counts, counted
        self._body = paths.body
        self._groups = groups
        self._group = np.array(groups, dtype=np.intp)[self._body]

    @np.errstate(all="ignore")  # a line from an overflow is not proposed
    def lines(self, start: Fraction, end: Fraction) -> list[str]:
        """Return the lines of the nodes, for all items from start to end.

        Raises:
            BudgetExceeded: if bodies are too near to each other, or there are too many nodes.
        """
        every = np.arange(len(self._body), dtype=np.intp)
        span, most = end - start, 1000 + 50 * len(every)
        lines: list[str] = []
        todo: list[Node] = [(every, {*range(len(self._groups))}, (start, end), 0)]
        while todo:
            some, present, time, depth = todo.pop()
            if not self._counts(present):
                continue
            check_budget()
            if self._counted:  # the others do not matter in this node, nor in any below it
                present = {i for pair in self._counted if {*pair} <= present for i in pair}
                some = self._of(present, every if some is None else some)
            if not isinstance(time, Frame):
                assert some is not None  # noqa: S101
                time, some = Frame(self._paths, some, *time), None
            frame = time
            if len(lines) >= most:
                raise BudgetExceeded(f"a certificate of more than {most} nodes is needed", None)
            whole = self._between_bodies(frame, present)
            if whole is not None:
                plane, low = whole
                lines.append(plane.line())
                for part in (present - low, low):
                    rest = some if some is None else self._of(part, some)
                    todo.append((rest, part, frame, depth + 1))
                continue
            items = self._of(present, frame.items) if some is None else some
            found = self._cut(frame, items, frame.rows(items))
            if found is not None:
                plane, below, above = found
                lines.append(plane.line())
                todo += [self._node(items[~side], frame, depth + 1) for side in (below, above)]
                continue
            start, end = frame.time.start, frame.time.end
            body = int(np.bincount(self._body[items]).argmax())
            mine = self._body[items] == body
            several, is_short = items[mine], start == end or (end - start) * 64 < span
            if len(several) > 1 and (depth % 2 or is_short):
                middle = int(several[len(several) // 2])
                lines.append(f"s {body} {middle}")
                parts = [items[~(mine & (items < middle))], items[~(mine & (items >= middle))]]
                todo += [self._node(part, frame, depth + 1) for part in parts]
                continue
            if (end - start) * FINEST < span or start == end:
                raise BudgetExceeded("bodies are too near to each other for a certificate", None)
            q = self._middle(items, start, end)
            lines.append("t" if q == (start + end) / 2 else f"t {written(q)}")
            todo += [(items, present, time, depth + 1) for time in ((q, end), (start, q))]
        return lines

    def _of(self, bodies: Collection[int], items: Items) -> Items:
        """Return those of some items that belong to some bodies."""
        mine = np.zeros(len(self._groups), dtype=bool)
        mine[[*bodies]] = True
        return items[mine[self._body[items]]]

    def _node(self, items: Items, frame: Frame, depth: int) -> Node:
        """Return a node of some items."""
        return items, set(self._body[items].tolist()), frame, depth

    def _middle(self, items: Items, start: Fraction, end: Fraction) -> Fraction:
        """Return the breakpoint of a body that is next to the middle of the time, or the middle."""
        middle = (start + end) / 2
        bodies = {*self._body[items].tolist()}
        breaks = {q for i in bodies for q in self._paths.breaks[i].breaks if start < q < end}
        return min(breaks, key=lambda q: (abs(q - middle), q)) if breaks else middle

    def _between_bodies(self, frame: Frame, present: set[int]) -> tuple[Plane, set[int]] | None:
        """Return a moving line between whole bodies; None without one, or for many bodies."""
        if len(present) > MOST:
            return None
        if frame.whole is None:
            frame.whole = WholeBodies(frame, self._groups)
        return frame.whole.cut(present)

    def _cut(self, frame: Frame, items: Items, rows: Items) -> tuple[Plane, Any, Any] | None:
        """Return a good moving line, with the items below and above it; None if there is none."""
        for cut, most in self._proposed(frame, items, rows):
            plane = frame.plane(cut)
            below, above = frame.sides(items, rows, plane)
            one, other = len(items) - int(above.sum()), len(items) - int(below.sum())
            if max(one, other) < len(items) and one + other <= most * len(items):
                return plane, below, above
        return None

    def _proposed(self, frame: Frame, items: Items, rows: Items) -> Iterator[tuple[Cut, float]]:
        """Yield moving lines, and the parts of all items that both of their sides may have."""
        two = self._between_two(frame, items, rows)
        if two is not None and len(two):
            yield from (
                (cut, 1.0) for cut in self._clean(items, two, frame.extents(items, rows, two))
            )
        usual = DIRECTIONS, frame.usual(rows)
        both = [usual]
        if two is None or len(two):
            yield from ((cut, 1.0) for cut in self._clean(items, *usual))
            more = self._directions(frame, items, rows)
            both += [(more, frame.extents(items, rows, more))] if len(more) else []
            for some in both[1:]:
                yield from ((cut, 1.0) for cut in self._clean(items, *some))
        cuts = [cut for some in both if len(items) > 4 for cut in self._crossing(*some)]
        yield from ((cut, CROSSING) for cut in sorted(cuts, reverse=True)[:3])

    def _clean(self, items: Items, directions: Floats, extents: Extents) -> Iterator[Cut]:
        """Yield lines between all items, in their order along a direction: the three best."""
        (low, high), count, columns = extents, len(items), np.arange(len(directions))
        order = np.argsort((low + high).sum(axis=0), axis=0, kind="stable")
        before = np.maximum.accumulate(high[:, order, columns], axis=1)[:, :-1]
        after = np.minimum.accumulate(low[:, order[::-1], columns], axis=1)[:, -2::-1]
        gap = (after - before).min(axis=0)
        clear = gap / (high.max(axis=(0, 1)) - low.min(axis=(0, 1)) + 1e-300)
        group = self._group[items][order]
        alone = np.logical_and.accumulate(group == group[0], axis=0)[:-1].astype(float)
        alone += np.logical_and.accumulate(group[::-1] == group[-1], axis=0)[-2::-1]
        k = np.arange(1, count)[:, None]
        worth = np.minimum(k, count - k) / count + 0.4 * alone + 0.3 * np.minimum(clear, 0.3)
        worth -= 0.1 * (np.abs(directions).max(axis=1) > 1e6)  # longer numbers
        worth[~(clear > (CLEAR if count > FEW else CLOSE))] = -1.0
        best = worth.argmax(axis=0)
        worths = worth[best, columns]
        for j in np.argsort(-worths, kind="stable")[:3].tolist():
            if worths[j] <= 0:
                return
            i, (x, y) = best[j], directions[j].tolist()
            above = self._paths.extra * float(np.hypot(x, y))
            c, d = ((before[:, i, j] + after[:, i, j]) / 2 - above).tolist()
            yield Cut(float(worths[j]), (int(x), int(y)), (c, d), float(gap[i, j]))

    def _crossing(self, directions: Floats, extents: Extents) -> list[Cut]:
        """Return lines through the middle of all items, some of which are on both sides."""
        low, high = extents
        size = high.max(axis=(0, 1)) - low.min(axis=(0, 1)) + 1e-300
        count, ordered = low.shape[1], np.sort((low + high) / 2, axis=1)
        between = (ordered[:, 1:] + ordered[:, :-1]) / 2
        at = between[:, (count - 1) * PLACES // 100].swapaxes(0, 1)
        at = np.concatenate([at, np.broadcast_to(at[2].mean(axis=0), at[:1].shape)])
        below = (high < (at - 1e-6 * size)[:, :, None]).all(axis=1).sum(axis=1)
        above = (low > (at + 1e-6 * size)[:, :, None]).all(axis=1).sum(axis=1)
        least, found = np.minimum(below, above), list[Cut]()
        for flat in np.argsort(-least, axis=None)[:3].tolist():
            k, j = divmod(flat, len(directions))
            if least[k, j]:
                x, y = directions[j].tolist()
                c, d = (at[k, :, j] - self._paths.extra * float(np.hypot(x, y))).tolist()
                room = 1e-3 * float(size[j])
                found.append(Cut(float(least[k, j]) / count, (int(x), int(y)), (c, d), room))
        return found

    def _between_two(self, frame: Frame, items: Items, rows: Items) -> Floats | None:
        """Return a direction in which one of two groups is before the other at start and end.

        None if it is to be searched for: of more groups, many vertices, with distances, or where
        doubles are too near. No row if it does not exist: the vectors from one group to the other
        are in no half-plane. If they are, it is in the middle of them, with short numbers.
        """
        group = self._group[items]
        mine = group == group[0]
        others = group[~mine]
        a, b = (_numbers(frame.ends_of[rows[part]]) for part in (mine, ~mine))
        if (others != others[:1]).any() or len(a) * len(b) > VECTORS:
            return None
        return direction_between(frame.ends[:, a], frame.ends[:, b], is_round=self._paths.is_round)

    def _directions(self, frame: Frame, items: Items, rows: Items) -> Floats:
        """Return normals of some edges, and directions between nearest vertices of two groups."""
        some = rows if len(rows) <= MANY else rows[:: len(rows) // MANY]
        u, v = frame.ends[:, frame.ends_of[some, 0]], frame.ends[:, frame.ends_of[some, 1]]
        along = np.concatenate([(v - u)[0], (v - u)[1]])
        found = [np.stack([-along[:, 1], along[:, 0]], axis=1)]
        group = self._group[items]
        mine = group == group[0]
        if len(items) <= MANY or len(np.unique(group)) == 2:
            a, b = (_numbers(frame.ends_of[rows[part]]) for part in (mine, ~mine))
            for at in frame.ends:
                apart = at[a][:, None] - at[b][None]
                i, j = np.unravel_index(int((apart**2).sum(axis=2).argmin()), apart.shape[:2])
                found.append(apart[i, j][None])
        raw = np.concatenate(found)
        size = np.abs(raw).max(axis=1, keepdims=True)
        raw = raw[(size[:, 0] > 0) & np.isfinite(size[:, 0])]
        raw /= np.abs(raw).max(axis=1, keepdims=True) if len(raw) else 1.0
        grids = (1e3, 2.0**50) if len(items) <= FEW else (1e3,)
        rounded = (np.rint(raw * grid).tolist() for grid in grids)
        return np.array([row for rows in rounded for row in sorted({*map(tuple, rows)})])


def _numbers(vertices: Items) -> Items:
    """Return these numbers in order, each of them once."""
    return np.flatnonzero(np.bincount(vertices.ravel()))
