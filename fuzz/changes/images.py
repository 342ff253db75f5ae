"""The transformations: images of scenes, with the old feature of each new vertex and edge."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from itertools import combinations
from random import Random
from typing import Any, Final, NamedTuple, TypeAlias

from exactpt import AlgebraicNumber, Body, FreeSpace, InputError, Polynomial, Scene
from exactpt.kernel.numbers import QQ
from exactpt.motion.motions import Position
from exactpt.testing import reference
from fuzz.changes.variants import Variant, expected_time

__all__ = [
    "TRANSFORMATIONS",
    "Feature",
    "Image",
    "Mirror",
    "Side",
    "halved",
    "move_alike",
    "untouched",
]

Interval: TypeAlias = tuple[AlgebraicNumber, AlgebraicNumber]

SHARES: Final = (QQ(1, 2), QQ(1, 4), QQ(3, 4))
"""Where edges are subdivided. The new vertices of bodies of doubles are doubles."""


class Feature(NamedTuple):
    """A vertex or an edge of a body of the old scene.

    Attributes:
        kind: "vertex" or "edge".
        body: the name of the body.
        number: the number of the vertex, or of the edge.
    """

    kind: str
    body: str
    number: int


@dataclass(frozen=True)
class Mirror:
    """A reflection of the plane, or of time, or none: each undoes itself.

    Attributes:
        signs: of x and of y.
        swaps_axes: whether x and y change places.
        turning: the sum of a time and its image; None if time goes on as it did.
    """

    signs: tuple[int, int] = (1, 1)
    swaps_axes: bool = False
    turning: QQ | None = None

    @property
    def is_orientation_kept(self) -> bool:
        """False if a ring counter-clockwise becomes one clockwise."""
        return self.signs[0] * self.signs[1] * (-1 if self.swaps_axes else 1) > 0

    def point(self, p: Sequence[Any]) -> tuple[Any, Any]:
        """Return the image of a point, or of a direction."""
        x, y = self.signs[0] * p[0], self.signs[1] * p[1]
        return (y, x) if self.swaps_axes else (x, y)

    def time(self, t: QQ) -> QQ:
        """Return the image of a rational time."""
        return t if self.turning is None else self.turning - t

    def interval(self, start: AlgebraicNumber, end: AlgebraicNumber) -> Interval:
        """Return the image of an interval."""
        if self.turning is None:
            return start, end
        return expected_time(self.variant, end), expected_time(self.variant, start)

    @property
    def variant(self) -> Variant:
        """The map of scenes."""
        p, q = QQ(self.signs[0]), QQ(self.signs[1])
        matrix = ((p, QQ(0)), (QQ(0), q))
        if self.swaps_axes:
            matrix = ((QQ(0), q), (p, QQ(0)))
        if self.turning is None:
            return Variant(matrix=matrix)
        return Variant(matrix=matrix, rate=QQ(-1), delay=self.turning)


UNCHANGED: Final = Mirror()


@dataclass(frozen=True)
class Side:
    """A scene, and what its numbers and names stand for.

    Attributes:
        scene: the scene.
        vertices, edges: the old feature of each vertex and each edge, by body and number.
        groups: for each name the common name of all bodies that are one body in the old or in
            the new scene.
        mirror: what the plane and time of the old scene look like in this one.
        spaces: the free space at the start by each tiling that has been used.
    """

    scene: Scene
    vertices: Mapping[tuple[str, int], Feature]
    edges: Mapping[tuple[str, int], Feature]
    groups: Mapping[str, str]
    mirror: Mirror = UNCHANGED
    spaces: dict[str, FreeSpace] = field(default_factory=dict, compare=False)

    def members(self, group: str) -> list[str]:
        """Return the names of the bodies of a group."""
        return [body.name for body in self.scene.bodies if self.groups[body.name] == group]


class Image(NamedTuple):
    """A scene and its image."""

    old: Side
    new: Side


def untouched(scene: Scene, groups: Mapping[str, str] | None = None) -> Side:
    """Return the side of the old scene: each feature stands for itself."""
    names = {body.name: body.name for body in scene.bodies}
    return Side(
        scene,
        {(b.name, i): Feature("vertex", b.name, i) for b in scene.bodies for i in range(b.size)},
        {(b.name, i): Feature("edge", b.name, i) for b in scene.bodies for i, _ in b.edges},
        names if groups is None else groups,
    )


class _Ring(NamedTuple):
    """Vertices in a new order, with what each and the edge from it to the next stand for."""

    vertices: list[Position]
    features: list[Feature]
    edges: list[Feature]


def _ring(body: Body, numbers: Sequence[int]) -> _Ring:
    return _Ring(
        [body.vertices[i] for i in numbers],
        [Feature("vertex", body.name, i) for i in numbers],
        [Feature("edge", body.name, i) for i in numbers],
    )


def _subdivided(body: Body, random: Random) -> Iterator[_Ring]:
    for ring in body.rings:
        vertices, features, edges = list[Position](), list[Feature](), list[Feature]()
        for i in ring:
            here, edge = body.vertices[i], Feature("edge", body.name, i)
            vertices.append(here)
            features.append(Feature("vertex", body.name, i))
            edges.append(edge)
            if any(i == first for first, _ in body.edges) and random.random() < 0.7:
                there = body.vertices[body.end_of_edge(i)]
                vertices.append(_between(here, there, random.choice(SHARES)))
                features.append(edge)
                edges.append(edge)
        yield _Ring(vertices, features, edges)


def halved(scene: Scene) -> Scene:
    """Return a scene in which each edge is cut in the middle: the same sets of points.

    Bodies given by keyframes are left as they are.
    """
    bodies = [_halved_body(body) for body in scene.bodies]
    return Scene(bodies, (scene.start, scene.end), ignoring=scene.ignoring)


def _halved_body(body: Body) -> Body:
    if body.keyframes or not body.edges:
        return body
    starts = {first for first, _ in body.edges}
    rings = []
    for ring in body.rings:
        vertices = list[Position]()
        for i in ring:
            vertices.append(body.vertices[i])
            if i in starts:
                end = body.vertices[body.end_of_edge(i)]
                vertices.append(_between(body.vertices[i], end, QQ(1, 2)))
        rings.append(_Ring(vertices, [], []))
    return _made(body, rings, body.name)


def _between(p: Position, q: Position, share: QQ) -> Position:
    s, t = Polynomial([share]), Polynomial([1 - share])
    return t * p[0] + s * q[0], t * p[1] + s * q[1]


def _renumbered(body: Body, random: Random) -> Iterator[_Ring]:
    for ring in body.rings:
        k = random.randrange(len(ring)) if body.closed and len(ring) > 2 else 0
        yield _ring(body, [*ring[k:], *ring[:k]])


def _reversed(body: Body, random: Random) -> Iterator[_Ring]:  # noqa: ARG001
    for ring in body.rings:
        found = _ring(body, ring[::-1])
        is_cyclic = body.closed and len(ring) > 2
        edges = [found.edges[(k + 1) % len(ring)] for k in range(len(ring))]
        yield found._replace(edges=edges if is_cyclic or len(ring) < 2 else edges[:-1])


def _made(body: Body, rings: Sequence[_Ring], name: str) -> Body:
    """Return a body of other rings, in the order of those of ``body``."""
    if not body.has_rings:
        # A chain that was one edge may have got more vertices.
        closed = body.closed and body.size > 2
        return Body(name, rings[0].vertices, body.motion, closed=closed, radius=body.radius)
    found = iter(rings)
    parts = [[next(found).vertices for _ in part] for part in body.parts]
    return _of_parts(name, body, parts)


def _of_parts(name: str, like: Body, parts: Sequence[Sequence[Sequence[Position]]]) -> Body:
    made = [{"vertices": outline, "holes": holes} for outline, *holes in parts]
    return Body(name, motion=like.motion, parts=made, radius=like.radius)


def _side(bodies: Sequence[Body], rings: Mapping[str, Sequence[_Ring]], old: Scene,
          groups: Mapping[str, str]) -> Side:  # fmt: skip
    vertices: dict[tuple[str, int], Feature] = {}
    edges: dict[tuple[str, int], Feature] = {}
    for body in bodies:
        numbers = iter(range(body.size))
        for ring in rings[body.name]:
            for k, feature in enumerate(ring.features):
                number = next(numbers)
                vertices[body.name, number] = feature
                if k < len(ring.edges):
                    edges[body.name, number] = ring.edges[k]
    new = Scene(bodies, (old.start, old.end), ignoring=old.ignoring)
    return Side(new, vertices, edges, groups)


def _each(change: Callable[[Body, Random], Iterator[_Ring]]) -> Callable[..., Image | None]:
    """Return the transformation that changes the rings of every body."""

    def image(scene: Scene, random: Random) -> Image | None:
        if any(body.keyframes for body in scene.bodies):
            return None
        rings = {body.name: list(change(body, random)) for body in scene.bodies}
        bodies = [_made(body, rings[body.name], body.name) for body in scene.bodies]
        old = untouched(scene)
        return Image(old, _side(bodies, rings, scene, old.groups))

    return image


def _permuted(scene: Scene, random: Random) -> Image | None:
    bodies = random.sample(scene.bodies, len(scene.bodies))
    if bodies == list(scene.bodies):
        bodies.reverse()
    old = untouched(scene)
    new = Scene(bodies, (scene.start, scene.end), ignoring=scene.ignoring)
    return Image(old, Side(new, old.vertices, old.edges, old.groups))


def _joined(scene: Scene, random: Random) -> Image | None:
    """Make one body of two that move alike and lie apart, one in a hole of the other perhaps."""
    pairs = [
        (a, b) for a, b in combinations(scene.bodies, 2) if move_alike(a, b, scene.exact_start)
    ]
    if not pairs:
        return None
    two = random.choice(pairs)
    name = f"{two[0].name}+{two[1].name}"
    rings = {body.name: [_ring(body, ring) for ring in body.rings] for body in scene.bodies}
    parts = [
        [[body.vertices[i] for i in ring] for ring in part] for body in two for part in body.parts
    ]
    bodies = [body for body in scene.bodies if body not in two]
    bodies.insert(random.randint(0, len(bodies)), _of_parts(name, two[0], parts))
    groups = {body.name: body.name for body in scene.bodies}
    groups |= {body.name: name for body in two} | {name: name}
    both = [ring for body in two for ring in rings[body.name]]
    return Image(untouched(scene, groups), _side(bodies, rings | {name: both}, scene, groups))


def move_alike(a: Body, b: Body, t: QQ) -> bool:
    """Return True if two rigid bodies with an interior have one motion and lie apart."""
    if a.motion != b.motion or a.radius != b.radius or not (_is_solid(a) and _is_solid(b)):
        return False
    return reference.nearest(a, b, t).core_squared > (a.exact_radius + b.exact_radius) ** 2


def _is_solid(body: Body) -> bool:
    rigid = all(f.degree <= 0 for vertex in body.vertices for f in vertex)
    return body.has_interior and not body.keyframes and rigid


def _separated(scene: Scene, random: Random) -> Image | None:
    """Make bodies of the parts of one."""
    several = [b for b in scene.bodies if len(b.parts) > 1 and _is_solid(b)]
    if not several:
        return None
    one = random.choice(several)
    rings = {body.name: [_ring(body, ring) for ring in body.rings] for body in scene.bodies}
    groups = {body.name: body.name for body in scene.bodies}
    bodies = []
    for body in scene.bodies:
        if body is not one:
            bodies.append(body)
            continue
        for k, part in enumerate(one.parts):
            name = f"{one.name}.{k}"
            rings[name], groups[name] = [_ring(one, ring) for ring in part], one.name
            bodies.append(_of_parts(name, one, [[[one.vertices[i] for i in r] for r in part]]))
    new = [body for body in bodies if groups[body.name] == one.name]
    if not all(move_alike(a, b, scene.exact_start) for a, b in combinations(new, 2)):
        return None
    return Image(untouched(scene, groups), _side(bodies, rings, scene, groups))


def _mirrored(scene: Scene, random: Random) -> Image:
    """Reflect the plane: at an axis, at both, or at the diagonal."""
    mirror = random.choice(
        [Mirror((-1, 1)), Mirror((1, -1)), Mirror((-1, -1)), Mirror((1, 1), swaps_axes=True)]
    )
    return _in_mirror(scene, mirror)


def _backwards(scene: Scene, random: Random) -> Image:  # noqa: ARG001
    """Let time run from the end to the start."""
    return _in_mirror(scene, Mirror(turning=scene.exact_start + scene.exact_end))


def _in_mirror(scene: Scene, mirror: Mirror) -> Image:
    old = untouched(scene)
    new = mirror.variant.scene(scene)
    return Image(old, Side(new, old.vertices, old.edges, old.groups, mirror))


def _allowed(make: Callable[[Scene, Random], Image | None]) -> Callable[..., Image | None]:
    """Return a transformation that gives None if no scene can hold the result."""

    def image(scene: Scene, random: Random) -> Image | None:
        try:
            return make(scene, random)
        except InputError:
            return None

    return image


def _plain(make: Callable[[Scene, Random], Image]) -> Callable[..., Image | None]:
    """Return a transformation that gives None if bodies move on arcs: no variant turns these."""

    def image(scene: Scene, random: Random) -> Image | None:
        try:
            return make(scene, random)
        except TypeError:
            return None

    return image


TRANSFORMATIONS: Final[Mapping[str, Callable[[Scene, Random], Image | None]]] = {
    "subdivided": _each(_subdivided),
    "renumbered": _each(_renumbered),
    "reversed": _each(_reversed),
    "permuted": _permuted,
    "joined": _allowed(_joined),
    "separated": _allowed(_separated),
    "mirrored": _plain(_mirrored),
    "backwards": _plain(_backwards),
}
"""The transformations by name; each returns None where it does not apply."""
