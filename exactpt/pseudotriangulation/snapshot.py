"""Snapshots: a tiling as plain data, at a rational time, or just after an irrational one.

Vertices are those of the scene. Infinitesimal copies of a vertex are contracted to it;
faces without area are dropped, and edges along such a face are split at its vertices.
The rest is a tiling of the unperturbed free space: no vertex lies in the interior of an
edge, and every face has three corners.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from fractions import Fraction
from itertools import pairwise
from typing import TYPE_CHECKING, Final, final

from exactpt.brief import call_in_brief, counted, cut, record_in_brief
from exactpt.errors import InputError
from exactpt.geometry.predicates import orientation
from exactpt.indices import HalfEdge
from exactpt.kernel.algebraic import AlgebraicNumber
from exactpt.kernel.algebraic_value import LateQuotient
from exactpt.kernel.numbers import QQ, fraction, parse_rational, rational
from exactpt.planar.halfedge import edge_key
from exactpt.pseudotriangulation.mesh import FREE, INSIDE

if TYPE_CHECKING:
    from exactpt.motion.vertices import Vertices
    from exactpt.pseudotriangulation.mesh import Mesh


_WITH_FAN: Final = "incremental"
"""The name of the tiling that has a fan."""


@final
@dataclass(frozen=True, slots=True)
class Node:
    """A vertex of the scene and its position.

    ``exact_x`` and ``exact_y`` are its coordinates at a rational time. Those at an irrational time,
    ``_late``, are computed when they are read.
    """

    body: str
    vertex: int
    exact_x: QQ
    exact_y: QQ
    _late: tuple[LateQuotient, LateQuotient] | None = None

    @property
    def x(self) -> Fraction | AlgebraicNumber:
        """The exact coordinate: a `Fraction` at a rational time."""
        return fraction(self.exact_x) if self._late is None else self._late[0].value()

    @property
    def y(self) -> Fraction | AlgebraicNumber:
        """The exact coordinate: a `Fraction` at a rational time."""
        return fraction(self.exact_y) if self._late is None else self._late[1].value()

    def __reduce__(self) -> tuple[object, ...]:
        return node_of, (self.body, self.vertex, str(self.exact_x), str(self.exact_y), self._late)

    def __repr__(self) -> str:
        if self._late is None:
            return call_in_brief(
                "Node", self.body, self.vertex, str(self.exact_x), str(self.exact_y)
            )
        x, y = (f"{float(coordinate)!r}..." for coordinate in (self.x, self.y))
        return call_in_brief("Node", self.body, self.vertex, x, y)


def _json_of(value: Fraction | AlgebraicNumber) -> object:
    """Return a rational number as text, an irrational number by `AlgebraicNumber.to_json`."""
    return value.to_json() if isinstance(value, AlgebraicNumber) else str(rational(value))


def node_of(
    body: str, vertex: int, x: str, y: str, late: tuple[LateQuotient, LateQuotient] | None = None
) -> Node:
    """Return the node of a pickle."""
    return Node(body, vertex, parse_rational(x), parse_rational(y), late)


@final
@dataclass(frozen=True, slots=True)
class Edge:
    """An edge between nodes ``u < v``; ``kind`` is "boundary" or "diagonal"."""

    u: int
    v: int
    kind: str
    hull: bool

    def __reduce__(self) -> tuple[object, ...]:
        return Edge, (self.u, self.v, self.kind, self.hull)

    def __repr__(self) -> str:
        return record_in_brief(self)


@final
@dataclass(frozen=True, slots=True)
class Face:
    """A pseudo-triangle.

    Attributes:
        nodes: the nodes around it, counter-clockwise.
        corners: the three nodes with an angle below pi.
        region: "F1" inside the relative hull of a body, "F2" outside all relative hulls.
        body: in F1, the body of the relative hull.
        level: in F1, the level of its geodesic.
    """

    nodes: tuple[int, ...]
    corners: tuple[int, ...]
    region: str = "F2"
    body: str | None = None
    level: int | None = None

    def __reduce__(self) -> tuple[object, ...]:
        return Face, (self.nodes, self.corners, self.region, self.body, self.level)

    def __repr__(self) -> str:
        return record_in_brief(self)


@final
@dataclass(frozen=True, slots=True)
class Snapshot:
    """A tiling at a time.

    Attributes:
        tiling: the name of the tiling.
        nodes: all vertices of the scene, in its order.
        edges: body edges and diagonals, in order of their nodes.
        faces: the pseudo-triangles.
    """

    exact_at: QQ
    tiling: str
    nodes: tuple[Node, ...]
    edges: tuple[Edge, ...]
    faces: tuple[Face, ...]
    _time: AlgebraicNumber | None = None
    """The irrational time just before ``exact_at``, at which the nodes are placed, or None."""

    def __reduce__(self) -> tuple[object, ...]:
        at, time = str(self.exact_at), self._time
        return snapshot_of, (at, self.tiling, self.nodes, self.edges, self.faces, time)

    def __repr__(self) -> str:
        counts = f"{counted(len(self.nodes), 'node')}, {counted(len(self.faces), 'face')}"
        time = cut(str(self.exact_at) if self._time is None else str(self._time), 60)
        return f"<Snapshot of the tiling {self.tiling} at t = {time}: {counts}>"

    @property
    def at(self) -> Fraction | AlgebraicNumber:
        """The time; the tiling is the one at that time itself, or just after an irrational one."""
        return fraction(self.exact_at) if self._time is None else self._time

    @property
    def diagonals(self) -> tuple[Edge, ...]:
        """The edges that are not body edges."""
        return tuple(e for e in self.edges if e.kind == "diagonal")

    @property
    def fan(self) -> tuple[tuple[int, int], ...]:
        """The edges that refine an incremental tiling to the fan triangulation (paper, 3.4).

        They join the last corner in x-order of every face to its vertices that are not
        corners. With ``edges`` they are the fan triangulation.

        Raises:
            InputError: if it is another tiling, which has no fan.
        """
        if self.tiling != _WITH_FAN:
            raise InputError(
                f"fan: only the {_WITH_FAN} tiling of points has a fan triangulation, "
                f"got the {self.tiling} tiling"
            )
        edges = []
        for face in self.faces:
            tip = max(face.corners, key=lambda v: (self.nodes[v].exact_x, -self.nodes[v].exact_y))
            edges += [(min(tip, v), max(tip, v)) for v in face.nodes if v not in face.corners]
        return tuple(sorted(edges))

    def to_json(self) -> dict[str, object]:
        """Return the snapshot as in docs/format.md (command ``tile``)."""
        faces = []
        for f in self.faces:
            face: dict[str, object] = {
                "vertices": list(f.nodes),
                "corners": list(f.corners),
                "region": f.region,
            }
            if f.body is not None:
                face |= {"body": f.body, "level": f.level}
            faces.append(face)
        data: dict[str, object] = {
            "at": _json_of(self.at),
            "tiling": self.tiling,
            "vertices": [
                {"body": n.body, "vertex": n.vertex, "x": _json_of(n.x), "y": _json_of(n.y)}
                for n in self.nodes
            ],
            "edges": [{"u": e.u, "v": e.v, "kind": e.kind, "hull": e.hull} for e in self.edges],
            "faces": faces,
        }
        if self.tiling == _WITH_FAN:
            data["fan"] = [list(edge) for edge in self.fan]
        return data


def snapshot_of(
    at: str,
    tiling: str,
    nodes: tuple[Node, ...],
    edges: tuple[Edge, ...],
    faces: tuple[Face, ...],
    time: AlgebraicNumber | None = None,
) -> Snapshot:
    """Return the snapshot of a pickle."""
    return Snapshot(parse_rational(at), tiling, nodes, edges, faces, time)


def snapshot(vertices: Vertices, mesh: Mesh, name: str, at: QQ) -> Snapshot:
    """Return the tiling of a mesh at a rational time, in terms of the scene.

    Args:
        vertices: the moving vertices, with the trajectories of that time.
        mesh: the tiling at that time itself (`Tiling.mesh_now`).
        name: the name of the tiling.
        at: the time.
    """
    return _Contraction(vertices, mesh, at).snapshot(name)


def placed_at(tiling: Snapshot, time: AlgebraicNumber, vertices: Vertices) -> Snapshot:
    """Return the same tiling with its nodes where they are at an irrational time before."""
    paths = [
        path for moving in vertices.bodies for path in moving.body.exact_tracks_just_after(time)
    ]
    nodes = [
        Node(
            node.body, node.vertex, node.exact_x, node.exact_y,
            (LateQuotient(path.x, path.w, time), LateQuotient(path.y, path.w, time)),
        )
        for node, path in zip(tiling.nodes, paths, strict=True)
    ]  # fmt: skip
    return Snapshot(tiling.exact_at, tiling.tiling, tuple(nodes), tiling.edges, tiling.faces, time)


@final
class _Contraction:
    def __init__(self, vertices: Vertices, mesh: Mesh, at: QQ) -> None:
        self.vertices = vertices
        self.mesh = mesh
        self.at = at
        self.nodes: list[Node] = []
        for moving in vertices.bodies:
            body = moving.body
            self.nodes += [Node(body.name, i, x, y) for i, (x, y) in enumerate(body.exact_at(at))]
        self.node = vertices.nodes()
        self.cuts: dict[tuple[int, int], set[int]] = {}

    def snapshot(self, name: str) -> Snapshot:
        whole = []
        for face in self.mesh.faces(FREE):
            nodes, corners = self._contracted(face)
            if self._has_area(corners):
                whole.append((nodes, corners, self.mesh.tile(face[0])))
            else:
                self._cut_along(nodes)
        edges = self._edges()
        faces = []
        for nodes, corners, tile in whole:
            cycle = self._expanded(nodes)
            least = cycle.index(min(cycle))
            around, ends = tuple(cycle[least:] + cycle[:least]), tuple(sorted(corners))
            if tile.body < 0:
                faces.append(Face(around, ends))
            else:
                name_of_body = self.vertices.bodies[tile.body].body.name
                faces.append(Face(around, ends, "F1", name_of_body, tile.level))
        faces.sort(key=lambda f: f.nodes)
        return Snapshot(self.at, name, tuple(self.nodes), tuple(edges), tuple(faces))

    def _is_inside(self, h: HalfEdge) -> bool:
        """Return True if an edge is a diagonal inside a body, and so not in the free space."""
        return self.mesh.region[h] == INSIDE and not self.mesh.is_boundary(h)

    def _contracted(self, face: Sequence[HalfEdge]) -> tuple[list[int], list[int]]:
        """Return the nodes around a face, runs of copies contracted, and its corners."""
        ids = [self.node[self.mesh.map.origin[h]] for h in face]
        nodes = [v for before, v in zip([ids[-1], *ids[:-1]], ids, strict=True) if v != before]
        return nodes, [self.node[self.mesh.map.origin[h]] for h in face if self.mesh.corner[h]]

    def _has_area(self, corners: Sequence[int]) -> bool:
        """Return True if a face with these corners has an area."""
        a, b, c = ((self.nodes[v].exact_x, self.nodes[v].exact_y) for v in corners)
        return orientation(a, b, c) != 0

    def _cut_along(self, nodes: Sequence[int]) -> None:
        """Split the edges of a face without area at its vertices in their interiors."""
        ordered = sorted(set(nodes), key=lambda v: (self.nodes[v].exact_x, self.nodes[v].exact_y))
        rank = {v: i for i, v in enumerate(ordered)}
        for u, v in pairwise([*nodes, nodes[0]]) if len(ordered) > 2 else ():
            low, high = sorted((rank[u], rank[v]))
            if high - low > 1:
                self.cuts.setdefault(edge_key(u, v), set()).update(ordered[low + 1 : high])

    def _path(self, u: int, v: int) -> Iterator[int]:
        """Yield the nodes from u to v along an edge with its splits, v excluded."""
        inside = self.cuts.get(edge_key(u, v))
        if not inside:
            yield u
            return
        a = self.nodes[u]
        along = sorted(
            inside,
            key=lambda w: (
                abs(self.nodes[w].exact_x - a.exact_x) + abs(self.nodes[w].exact_y - a.exact_y)
            ),
        )
        for p, q in pairwise([u, *along, v]):
            yield from self._path(p, q)

    def _expanded(self, nodes: Sequence[int]) -> list[int]:
        if not self.cuts:
            return list(nodes)
        return [w for u, v in pairwise([*nodes, nodes[0]]) for w in self._path(u, v)]

    def _edges(self) -> list[Edge]:
        found: dict[tuple[int, int], Edge] = {}
        origin, node = self.mesh.map.origin, self.node
        for h in map(HalfEdge, range(0, len(origin), 2)):
            if origin[h] < 0 or self._is_inside(h):
                continue
            u, v = node[origin[h]], node[origin[h ^ 1]]
            if u == v:
                continue
            for p, q in pairwise([*self._path(u, v), v]) if self.cuts else ((u, v),):
                key = edge_key(p, q)
                old = found.get(key)
                boundary = self.mesh.is_boundary(h) or (old is not None and old.kind == "boundary")
                hull = self.mesh.is_hull(h) or (old is not None and old.hull)
                found[key] = Edge(*key, "boundary" if boundary else "diagonal", hull)
        return [found[key] for key in sorted(found)]
