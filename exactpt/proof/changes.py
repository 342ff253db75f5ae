"""The changes from one map to the next, and the angles whose lives are renewed."""

from __future__ import annotations

import heapq
from collections.abc import Callable, Iterable, Sequence
from itertools import count, pairwise
from typing import TYPE_CHECKING, TypeAlias, final

from exactpt.errors import AuditError
from exactpt.kernel.numbers import enclosing_floats

if TYPE_CHECKING:
    from exactpt.kernel.algebraic import AlgebraicNumber
    from exactpt.proof.nodes import Nodes

DirectedEdge: TypeAlias = tuple[int, int]
Angle: TypeAlias = tuple[int, int, int]
Entry: TypeAlias = "tuple[float, int, DirectedEdge, AlgebraicNumber]"


def followers(faces: Iterable[Sequence[int]]) -> dict[DirectedEdge, DirectedEdge]:
    """For each half-edge of some faces, the one that follows around its face.

    Raises:
        AuditError: if a half-edge occurs twice.
    """
    after: dict[DirectedEdge, DirectedEdge] = {}
    for cycle in faces:
        path = pairwise([*cycle, cycle[0], cycle[1]]) if len(cycle) > 1 else ()
        for d, e in pairwise(path):
            if d in after:
                raise AuditError(f"the half-edge {d} has a face twice")
            after[d] = e
    return after


def change(
    after: dict[DirectedEdge, DirectedEdge],
    old: dict[DirectedEdge, DirectedEdge],
    new: dict[DirectedEdge, DirectedEdge],
    is_body_edge: Callable[[int, int], bool],
) -> list[str]:
    """Change a map, and return the items of edges removed and added.

    An edge whose place in the star of an end changes is both removed and added.

    Args:
        after: the map, changed in place.
        old: the links of the faces removed.
        new: the links of the faces added.
        is_body_edge: whether an edge is one of a body, which is never removed.
    """
    gone, come = old.keys() - new.keys(), new.keys() - old.keys()
    changed = {d[1] for d in gone | come} | {d[1] for d, e in new.items() if old.get(d, e) != e}
    into = {v: u for u, v in old if v in changed}
    before = {v: _star(v, u, after) for v, u in into.items()}
    for d in old:
        del after[d]
    after.update(new)
    into = {v: u for u, v in new if v in before}
    for v, u in into.items():
        star = _star(v, u, after)
        stay = {w for w in before[v] if w in star}
        if not _same_cycle([w for w in before[v] if w in stay], [w for w in star if w in stay]):
            moved = {d for w in stay if not is_body_edge(w, v) for d in ((w, v), (v, w))}
            gone, come = gone | moved, come | moved
    removed = [f"- {u} {v}" for u, v in sorted(gone) if u < v]
    added = [f"+ {u} {v} {after[u, v][1]} {after[v, u][1]}" for u, v in sorted(come) if u < v]
    return removed + added


def _star(v: int, first: int, after: dict[DirectedEdge, DirectedEdge]) -> list[int]:
    """Return the neighbours of v, clockwise."""
    star = [first]
    while (u := after[star[-1], v][1]) != first:
        star.append(u)
    return star


def _same_cycle(a: list[int], b: list[int]) -> bool:
    if not a:
        return True
    i = b.index(a[0])
    return a == b[i:] + b[:i]


@final
class Angles:
    """The living angles of a map, with the times at which they vanish."""

    def __init__(self, nodes: Nodes) -> None:
        self._nodes = nodes
        self._life: dict[DirectedEdge, tuple[int, int]] = {}
        self._failures: list[Entry] = []
        self._made = count()

    def begin(self, angles: Iterable[Angle], now: AlgebraicNumber) -> None:
        """Begin the lives of angles, given by the vertices before, here and after."""
        for u, v, w in angles:
            number = next(self._made)
            self._life[v, w] = u, number
            time = self._nodes.fails((u, v, w), now)
            if time is not None:
                key = enclosing_floats(time.exact_low)[0]
                heapq.heappush(self._failures, (key, number, (v, w), time))

    def end(self, half_edges: Iterable[DirectedEdge]) -> None:
        """End the lives of the angles of half-edges."""
        for d in half_edges:
            self._life.pop(d, None)

    def next_time(self) -> AlgebraicNumber | None:
        """Return the first time at which a living angle vanishes."""
        while self._failures and not self._is_alive(self._failures[0]):
            heapq.heappop(self._failures)
        if not self._failures:
            return None
        entries = self._popped(self._failures[0][3])
        for entry in entries:
            heapq.heappush(self._failures, entry)
        return min(entry[3] for entry in entries)

    def vanishing(self, time: AlgebraicNumber) -> list[Angle]:
        """Take out the living angles that vanish at a time, in order; none may do so before it."""
        found = []
        for entry in self._popped(time):
            if entry[3].compare(time) == 0:
                found.append((self._life[entry[2]][0], *entry[2]))
            else:
                heapq.heappush(self._failures, entry)
        return sorted(found)

    def _popped(self, time: AlgebraicNumber) -> list[Entry]:
        """Take the entries of living angles that may vanish up to a time off the heap."""
        highest, entries = enclosing_floats(time.exact_high)[1], []
        while self._failures and self._failures[0][0] <= highest:
            entries.append(heapq.heappop(self._failures))
        return [entry for entry in entries if self._is_alive(entry)]

    def _is_alive(self, entry: Entry) -> bool:
        return self._life.get(entry[2], (0, -1))[1] == entry[1]
