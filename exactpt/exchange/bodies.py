"""The bodies that shapes become: names, holes, parts, repairs, and shapes that cannot be a body."""

from __future__ import annotations

from collections.abc import Callable, Container, Iterable, Sequence
from typing import TYPE_CHECKING, Final, Literal, TypeAlias, final

from exactpt.errors import InputError
from exactpt.exchange.repair import mended, repair_report
from exactpt.exchange.shapes import Kind, Shape, together
from exactpt.geometry.polygon import are_collinear
from exactpt.kernel.numbers import shorten
from exactpt.motion.body import Body
from exactpt.motion.motions import REST, Motion
from exactpt.scene.scene import Scene

if TYPE_CHECKING:
    from exactpt.geometry.predicates import Point
    from exactpt.kernel.numbers import Rational

Holes: TypeAlias = Literal["keep", "refuse", "fill"]
Parts: TypeAlias = Literal["keep", "split"]

_FEWEST: Final[dict[Kind, int]] = {"point": 1, "line": 2, "polygon": 3}


@final
class InvalidShapeError(InputError):
    """A shape whose points do not describe a valid body.

    Attributes:
        fault: what is wrong, without the place of the shape and the remedy.
    """

    def __init__(self, message: str, fault: str) -> None:
        super().__init__(message)
        self.fault = fault


def scene_of(
    shapes: Iterable[Shape],
    *,
    time: Sequence[Rational] = (0, 1),
    holes: Holes = "keep",
    parts: Parts = "keep",
    radius: Rational = 0,
    repaired: Callable[[str], None] | None = None,
    skipped: Callable[[str], None] | None = None,
) -> Scene:
    """Return the scene at rest of some shapes, in their order.

    Args:
        shapes: the shapes, one for each body; a name that is taken gets a number.
        time: the start and the end of the time span.
        holes: "keep" the holes of polygons, "refuse" such polygons, or "fill" the holes.
        parts: "keep" the parts of a shape together as one body, or "split" them into bodies.
        radius: the radius of each body.
        repaired: called with a message for each polygon that is not valid and is replaced by valid
            ones (`mended`); if None, none is.
        skipped: called with a message for each shape that cannot be a body and is left out;
            if None, such a shape is an error.

    Raises:
        InputError: one line that names the shape and the remedy.
    """
    empty = Scene([], time)
    found = _Bodies(time, holes, parts, radius, repaired)
    for given in shapes:
        for shape in given.parts if parts == "split" else (given,):
            if skipped is None:
                found.add_or_mend(shape)
            else:
                found.add_what_is_valid(shape, skipped)
    return empty.going_on(found.bodies.values(), empty.exact_start)


@final
class _Bodies:
    """The bodies of shapes, by name, see `scene_of`."""

    def __init__(
        self,
        time: Sequence[Rational],
        holes: Holes,
        parts: Parts,
        radius: Rational,
        repaired: Callable[[str], None] | None,
    ) -> None:
        self._time, self._holes, self._radius, self._repaired = time, holes, radius, repaired
        self._splits = parts == "split"
        self._last: dict[str, int] = {}
        self.bodies: dict[str, Body] = {}

    def _valid(self, shape: Shape) -> Body:
        name = free_name(shape.name, self.bodies, self._last)
        body = body_of(shape, name, holes=self._holes, radius=self._radius)
        _check_valid(shape, body, self._time)
        return body

    def add_or_mend(self, shape: Shape) -> None:
        """Add the body of a shape; if it is not valid, the body of the repaired shape."""
        try:
            self._add(shape)
        except InvalidShapeError as error:
            if self._repaired is None:
                raise
            given = shape.without_holes() if self._holes == "fill" else shape
            repaired = mended(given, error.fault)
            for part in repaired.parts if self._splits else (repaired,):
                self._add(part)
            self._repaired(repair_report(given, repaired, error.fault))

    def _add(self, shape: Shape) -> None:
        body = self._valid(shape)
        self.bodies[body.name] = body

    def add_what_is_valid(self, shape: Shape, skipped: Callable[[str], None]) -> None:
        """Likewise, without the parts that are not valid on their own."""
        try:
            self.add_or_mend(shape)
            return
        except InputError as error:
            faults = {i: self._fault(part) for i, part in enumerate(shape.parts)}
            left = [part for i, part in enumerate(shape.parts) if faults[i] is None]
            if len(left) == len(faults) or not shape.more:
                skipped(str(error))
                return
        for fault in filter(None, faults.values()):
            skipped(fault)
        for rest in together(left):
            self.add_what_is_valid(rest, skipped)

    def _fault(self, part: Shape) -> str | None:
        try:
            self._valid(part)
        except InputError as error:
            return str(error)
        return None


def body_of(
    shape: Shape, name: str, motion: Motion = REST, *, holes: Holes = "keep", radius: Rational = 0
) -> Body:
    """Return the body that a shape becomes.

    Repeated consecutive points count once. A line that ends where it began becomes the polygon
    that it bounds.

    Raises:
        InputError: if the shape has too few points, no area, or (``holes="refuse"``) holes.
    """
    count = sum(len(part.holes) for part in shape.parts)
    if count and holes == "refuse":
        raise InputError(
            f"{shape.where}: polygon {shorten(shape.name)} has {count} hole{'s'[: count > 1]}: "
            "keep or fill them (--holes, in Python holes=), or cut the polygon open"
        )
    rings = [_rings_of(part, fill=holes == "fill") for part in shape.parts]
    if len(rings) == len(rings[0]) == 1:
        points, is_polygon = _ring_of(shape, shape.points)
        closed, more = is_polygon or len(points) < 3, shape.properties
        return Body(name, points, motion, closed=closed, radius=radius, properties=more)
    made = [{"vertices": outline, "holes": inner} for outline, *inner in rings]
    return Body(name, motion=motion, parts=made, radius=radius, properties=shape.properties)


def _rings_of(part: Shape, *, fill: bool) -> list[list[Point]]:
    holes = () if fill else part.holes
    return [_ring_of(part, part.points)[0], *(_ring_of(part, hole)[0] for hole in holes)]


def _ring_of(shape: Shape, ring: Sequence[Point]) -> tuple[list[Point], bool]:
    """Return the points of a ring of a shape, each once, and whether it bounds a polygon."""
    points = _distinct_neighbours(ring)
    closes = shape.kind != "point" and len(points) > 1 and points[0] == points[-1]
    if closes:
        points.pop()
    is_polygon = shape.kind == "polygon" or (closes and len(points) > 2)
    kind: Kind = "polygon" if is_polygon else shape.kind
    if len(points) < _FEWEST[kind] or (is_polygon and are_collinear(points)):
        lacks = {"point": "position", "line": "length", "polygon": "area"}[kind]
        fault = f"{kind} {shorten(shape.name)} {f'has no {lacks}' if ring else 'is empty'}"
        remedy = "remove it"
        if ring is not shape.points:
            fault, remedy = f"a hole of {fault}", "mend it (--repair)"
        raise InvalidShapeError(
            f"{shape.where}: {fault}: {remedy}, or leave such shapes out (--skip-invalid)", fault
        )
    return points, is_polygon


def _check_valid(shape: Shape, body: Body, time: Sequence[Rational]) -> None:
    try:
        Scene([body], time)
    except InputError as error:
        split = "split it (--parts split), " if shape.more else ""
        if body.has_rings and any(part.holes for part in shape.parts):
            split += "fill its holes (--holes fill), "
        mend = "mend it (--repair)" if body.has_interior else "mend it"  # chains are not repaired
        raise InvalidShapeError(
            f"{shape.where}: {error}; {split}{mend}, or leave such outlines out (--skip-invalid)",
            str(error).removeprefix(f"body {shorten(body.name)}: "),
        ) from None


def _distinct_neighbours(points: Sequence[Point]) -> list[Point]:
    return [p for i, p in enumerate(points) if i == 0 or p != points[i - 1]]


def free_name(wanted: str, taken: Container[str], last: dict[str, int]) -> str:
    """Return the wanted name, or the first free one of "wanted 2", "wanted 3", ...

    ``last`` has the last number tried for each name: those below it stay taken.
    """
    number = last.get(wanted, 1)
    name = wanted if number == 1 else f"{wanted} {number}"
    while name in taken:
        number += 1
        name = f"{wanted} {number}"
    last[wanted] = number
    return name
