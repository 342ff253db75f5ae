"""What changes from one map to the next, and which angles are taken anew."""

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

__all__ = ["Angle", "Angles", "HalfEdge", "change", "followers"]

HalfEdge: TypeAlias = tuple[int, int]
Angle: TypeAlias = tuple[int, int, int]
Entry: TypeAlias = "tuple[float, int, HalfEdge, AlgebraicNumber]"


def followers(faces: Iterable[Sequence[int]]) -> dict[HalfEdge, HalfEdge]:
    """Of each half-edge of some faces, the one that follows.

    Raises:
        AuditError: if one is there twice.
    """
    after: dict[HalfEdge, HalfEdge] = {}
    for cycle in faces:
        path = pairwise([*cycle, cycle[0], cycle[1]]) if len(cycle) > 1 else ()
        for d, e in pairwise(path):
            if d in after:
                raise AuditError(f"the half-edge {d} has a face twice")
            after[d] = e
    return after


def change(
    after: dict[HalfEdge, HalfEdge],
    old: dict[HalfEdge, HalfEdge],
    new: dict[HalfEdge, HalfEdge],
    is_body_edge: Callable[[int, int], bool],
) -> list[str]:
    """Change a map; the items of the edges that go and come, both for one that moves.

    Args:
        after: the map, changed here.
        old: the links of the faces that go.
        new: those of the faces that come.
        is_body_edge: whether an edge has to stay.
    """
    gone, come = old.keys() - new.keys(), new.keys() - old.keys()
    changed = {d[1] for d in gone | come} | {d[1] for d, e in new.items() if old.get(d, e) != e}
    into = {v: u for u, v in old if v in changed}
    before = {v: _fan(v, u, after) for v, u in into.items()}
    for d in old:
        del after[d]
    after.update(new)
    into = {v: u for u, v in new if v in before}
    for v, u in into.items():
        fan = _fan(v, u, after)
        stay = {w for w in before[v] if w in fan}
        if not _same_cycle([w for w in before[v] if w in stay], [w for w in fan if w in stay]):
            moved = {d for w in stay if not is_body_edge(w, v) for d in ((w, v), (v, w))}
            gone, come = gone | moved, come | moved
    removed = [f"- {u} {v}" for u, v in sorted(gone) if u < v]
    added = [f"+ {u} {v} {after[u, v][1]} {after[v, u][1]}" for u, v in sorted(come) if u < v]
    return removed + added


def _fan(v: int, first: int, after: dict[HalfEdge, HalfEdge]) -> list[int]:
    """The vertices to which v has an edge, clockwise."""
    fan = [first]
    while (u := after[fan[-1], v][1]) != first:
        fan.append(u)
    return fan


def _same_cycle(a: list[int], b: list[int]) -> bool:
    if not a:
        return True
    i = b.index(a[0])
    return a == b[i:] + b[:i]


@final
class Angles:
    """The angles of a map, with the times at which they vanish though their edges stay."""

    def __init__(self, nodes: Nodes) -> None:
        self._nodes = nodes
        self._life: dict[HalfEdge, tuple[int, int]] = {}
        self._due: list[Entry] = []
        self._made = count()

    def begin(self, angles: Iterable[Angle], now: AlgebraicNumber) -> None:
        """Let angles (before, here, after) begin."""
        for u, v, w in angles:
            number = next(self._made)
            self._life[v, w] = u, number
            time = self._nodes.fails((u, v, w), now)
            if time is not None:
                key = enclosing_floats(time._low)[0]
                heapq.heappush(self._due, (key, number, (v, w), time))

    def end(self, half_edges: Iterable[HalfEdge]) -> None:
        """Let the angles of half-edges end."""
        for d in half_edges:
            self._life.pop(d, None)

    def next_time(self) -> AlgebraicNumber | None:
        """The first time at which a living angle vanishes."""
        while self._due and not self._is_alive(self._due[0]):
            heapq.heappop(self._due)
        if not self._due:
            return None
        entries = self._popped(self._due[0][3])
        for entry in entries:
            heapq.heappush(self._due, entry)
        return min(entry[3] for entry in entries)

    def due(self, time: AlgebraicNumber) -> list[Angle]:
        """The living angles that vanish at a time, before which none does; they are forgotten."""
        found = []
        for entry in self._popped(time):
            if entry[3].compare(time) == 0:
                found.append((self._life[entry[2]][0], *entry[2]))
            else:
                heapq.heappush(self._due, entry)
        return found

    def _popped(self, time: AlgebraicNumber) -> list[Entry]:
        """What is to be known of living angles that may vanish up to a time, off the heap."""
        highest, entries = enclosing_floats(time._high)[1], []
        while self._due and self._due[0][0] <= highest:
            entries.append(heapq.heappop(self._due))
        return [entry for entry in entries if self._is_alive(entry)]

    def _is_alive(self, entry: Entry) -> bool:
        return self._life.get(entry[2], (0, -1))[1] == entry[1]
