"""Lifetimes of the tiles and edges of a tiling during a run, in numbers of steps.

A tiling that flexes keeps its combinatorial structure between two steps, so a tile or an edge is
recorded once, with its first and last step. After a step only the parts that changed are
examined. A tile that changes passes its tint on to the tile that shares most of its edges.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Sequence
from itertools import zip_longest
from typing import TYPE_CHECKING, Final, NamedTuple, final

from exactpt.indices import Ends, HalfEdge
from exactpt.planar.halfedge import edge_key
from exactpt.pseudotriangulation.mesh import F2, FREE, INSIDE, OUTER, SOLID, Tile
from exactpt.render.palette import TINTS
from exactpt.tiling.driver import CHANGES, Observer

if TYPE_CHECKING:
    from exactpt.planar.halfedge import PlanarMap
    from exactpt.tiling.tiling import Tiling

_CHUNK: Final = 64


class EdgeSpan(NamedTuple):
    """An edge ``u < v`` after step ``first`` until step ``last`` (None: to the end).

    ``kind`` is "diagonal", "hull" (a diagonal on the convex hull), "rim" (an edge of a
    body on the convex hull) or "fan" (an edge of the fan triangulation, not of the tiling).
    """

    u: int
    v: int
    kind: str
    first: int
    last: int | None


class TileSpan(NamedTuple):
    """A tile after step ``first`` until step ``last`` (None: to the end).

    ``nodes`` are in counter-clockwise order; ``corners`` are the three convex ones; ``inside``
    is true if the tile is part of a body; ``place`` gives the body whose relative hull
    contains it, and its level in the tree.
    """

    nodes: tuple[int, ...]
    corners: tuple[int, ...]
    tint: int
    inside: bool
    place: Tile
    first: int
    last: int | None


@final
class Tracker(Observer):
    """Observes the mesh of a kinetic tiling.

    Args:
        kinetic: the tiling, which `update` reads after each step.
        node: for every moving vertex, the vertex of the scene that it is or copies.
    """

    listens_to: int = CHANGES

    def __init__(self, kinetic: Tiling, node: list[int]) -> None:
        self._kinetic = kinetic
        self._node = node
        self._seen: list[tuple[object, ...] | None] = []
        self._labels: list[frozenset[int]] = []
        self._tile_of: list[int] = []
        self._tiles: dict[int, TileSpan] = {}
        self._made = 0
        self._members: dict[tuple[int, int], set[int]] = {}
        self._key_of: dict[int, tuple[int, int]] = {}
        self._edges: dict[tuple[int, int], tuple[str, int]] = {}
        self._gone_tiles: list[TileSpan] = []
        self._gone_edges: list[EdgeSpan] = []
        self._fan: dict[tuple[int, int], int] = {}
        self._known: set[HalfEdge] | None = None
        kinetic.changes()  # those before the first step
        self.update(0)

    @property
    def tiles(self) -> list[TileSpan]:
        """All tiles so far."""
        return [t for t in (*self._gone_tiles, *self._tiles.values()) if len(t.nodes) > 2]

    @property
    def edges(self) -> list[EdgeSpan]:
        """All edges so far: the diagonals, the edges of bodies on the convex hull, the fan."""
        tiling = [EdgeSpan(*key, kind, since, None) for key, (kind, since) in self._edges.items()]
        fan = [EdgeSpan(*key, "fan", since, None) for key, since in self._fan.items()]
        return self._gone_edges + tiling + fan

    def on_changed_edges(self, changed: set[HalfEdge] | None) -> None:
        """See `Observer.on_changed_edges`; the half-edges are for the next update."""
        if changed is None or self._known is None:
            self._known = None
        else:
            self._known |= changed

    def update(self, step: int) -> None:
        """Record the changes since the last call; the present state holds from ``step`` on.

        A mark, the region of a half-edge or whether its angle is a corner, changes only where the
        half-edge has another origin or predecessor. Labels change anywhere.
        """
        mesh = self._kinetic.mesh_after()
        m, known, self._known = mesh.map, self._known, set()
        more = len(m.origin) - len(self._tile_of)
        self._tile_of += [-1] * more
        self._seen += [None] * more
        some = set(range(len(self._seen))) if known is None else set(map(int, known))
        some.update([int(m.following[h]) for h in some if _origin(m, h) >= 0])
        changed: set[int] = set()
        for h in some:
            now = None
            if h < len(m.origin):
                now = m.origin[h], m.following[h], mesh.region[h], mesh.corner[h]
            if self._seen[h] != now:
                self._seen[h] = now
                changed.add(h)
        labels = list(mesh.labelling())  # a label places the tiles on both sides of its edge
        changed.update(h ^ side for h in _differences(self._labels, labels) for side in (0, 1))
        self._labels = labels
        ordered = sorted(changed)
        self._update_tiles(ordered, step)
        self._update_edges(ordered, step)
        if self._kinetic.fan is not None:
            self._update_fan(self._kinetic.fan.edges, step)

    def _update_tiles(self, changed: list[int], step: int) -> None:
        mesh = self._kinetic.mesh_after()
        m = mesh.map
        old = {h: self._tile_of[h] for h in changed}
        cycles: list[list[int]] = []
        found: set[int] = set()
        for h in changed:
            if h in found or _origin(m, h) < 0 or mesh.region[h] in (OUTER, SOLID):
                continue
            cycle = [int(g) for g in m.face(HalfEdge(h))]
            found.update(cycle)
            old.update((g, self._tile_of[g]) for g in cycle)
            cycles.append(cycle)
        for h in changed:
            self._tile_of[h] = -1
        before = {tile: self._tiles.pop(tile) for tile in sorted(set(old.values()) - {-1})}
        for cycle, heir in zip(cycles, _heirs(cycles, old), strict=True):
            name = heir if heir >= 0 else self._made
            self._made += heir < 0
            for h in cycle:
                self._tile_of[h] = name
            self._enter(name, cycle, before.pop(name, None), step)
        for tile in before.values():
            self._leave(tile, step)

    def _enter(self, name: int, cycle: list[int], before: TileSpan | None, step: int) -> None:
        mesh = self._kinetic.mesh_after()
        m = mesh.map
        around = [self._node[m.origin[h]] for h in cycle]
        nodes = [v for u, v in zip([around[-1], *around], around, strict=False) if u != v]
        corners = tuple(self._node[m.origin[h]] for h in cycle if mesh.corner[h])
        inside = mesh.region[cycle[0]] != FREE
        place = F2 if inside else mesh.tile(HalfEdge(cycle[0]))
        if before is not None:
            is_same = set(before.corners) == set(corners) and before.place == place
            if is_same and _same_cycle(before.nodes, nodes):
                self._tiles[name] = before
                return
            self._leave(before, step)
        tint = before.tint if before is not None else self._new_tint(name, cycle)
        self._tiles[name] = TileSpan(tuple(nodes), corners, tint, inside, place, step, None)

    def _leave(self, tile: TileSpan, step: int) -> None:
        if tile.first < step:
            self._gone_tiles.append(tile._replace(last=step))

    def _new_tint(self, name: int, cycle: list[int]) -> int:
        """Return a tint that no neighbouring tile has, if there is one."""
        nearby = (self._tiles.get(self._tile_of[h ^ 1]) for h in cycle)
        taken = {tile.tint for tile in nearby if tile is not None}
        free = [tint for tint in range(TINTS) if tint not in taken]
        return free[name % len(free)] if free else name % TINTS

    def _update_edges(self, changed: list[int], step: int) -> None:
        m = self._kinetic.mesh_after().map
        touched: dict[tuple[int, int], None] = {}
        for edge in dict.fromkeys(h >> 1 for h in changed):
            key = self._key_of.pop(edge, None)
            if key is not None:
                self._members[key].discard(edge)
                touched[key] = None
            ends = _origin(m, 2 * edge), _origin(m, 2 * edge + 1)
            u, v = (self._node[w] if w >= 0 else -1 for w in ends)
            if u != v:
                key = (u, v) if u < v else (v, u)
                self._key_of[edge] = key
                self._members.setdefault(key, set()).add(edge)
                touched[key] = None
        for key in touched:
            kind = self._kind(self._members[key])
            before = self._edges.get(key)
            if before is not None and before[0] != kind:
                del self._edges[key]
                if before[1] < step:
                    self._gone_edges.append(EdgeSpan(*key, *before, step))
            if kind is not None and (before is None or before[0] != kind):
                self._edges[key] = (kind, step)

    def _update_fan(self, triangulation: set[Ends], step: int) -> None:
        """Record the edges of the fan triangulation that are not in the tiling."""
        nodes = (edge_key(self._node[u], self._node[v]) for u, v in triangulation)
        now = {edge for edge in nodes if edge not in self._edges}
        for edge in sorted(self._fan.keys() - now):
            since = self._fan.pop(edge)
            if since < step:
                self._gone_edges.append(EdgeSpan(*edge, "fan", since, step))
        for edge in sorted(now - self._fan.keys()):
            self._fan[edge] = step

    def _kind(self, members: Iterable[int]) -> str | None:
        """Return the kind of an edge, given its copies; None on or inside a body."""
        mesh = self._kinetic.mesh_after()
        edges = [e for e in members if mesh.boundary[e] or mesh.region[2 * e] != INSIDE]
        boundary = any(mesh.boundary[e] for e in edges)
        if any(mesh.is_hull(HalfEdge(2 * e)) for e in edges):
            return "rim" if boundary else "hull"
        return None if boundary or not edges else "diagonal"


def _origin(m: PlanarMap, h: int) -> int:
    """Return the origin of a half-edge; -1 if a rebuilt mesh does not have it."""
    return int(m.origin[h]) if h < len(m.origin) else -1


def _differences(old: Sequence[object], new: Sequence[object]) -> list[int]:
    """Return the indices at which two lists differ. Equal chunks are skipped at once."""
    return [
        i
        for start in range(0, max(len(old), len(new)), _CHUNK)
        if old[start : start + _CHUNK] != new[start : start + _CHUNK]
        for i, (a, b) in enumerate(
            zip_longest(old[start : start + _CHUNK], new[start : start + _CHUNK]), start
        )
        if a != b
    ]


def _heirs(cycles: list[list[int]], old: dict[int, int]) -> list[int]:
    """For each cycle the tile that it continues, the one that had most of its half-edges; or -1."""
    votes = sorted(
        (-count, i, tile)
        for i, cycle in enumerate(cycles)
        for tile, count in Counter(old[h] for h in cycle).items()
        if tile >= 0
    )
    heirs = [-1] * len(cycles)
    taken: set[int] = set()
    for _, i, tile in votes:
        if heirs[i] < 0 and tile not in taken:
            heirs[i] = tile
            taken.add(tile)
    return heirs


def _same_cycle(a: tuple[int, ...], b: list[int]) -> bool:
    if len(a) != len(b):
        return False
    return not a or any(tuple(b[i:] + b[:i]) == a for i in range(len(b)))
