"""Claims that cgal_check verifies, and its verdicts."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from fractions import Fraction
from typing import NamedTuple, TypeAlias, cast, final

from exactpt.brief import record_in_brief
from exactpt.errors import InputError
from exactpt.geometry.polygon import signed_area2
from exactpt.geometry.predicates import Point
from exactpt.kernel.algebraic import AlgebraicNumber
from exactpt.kernel.numbers import QQ, ZZ, Rational, rational, shorten
from exactpt.motion.body import Body
from exactpt.scene.scene import Scene

Tile: TypeAlias = Mapping[str, object]
"""The ``tile`` dictionary of docs/format.md, as `json.load` returns it."""


class BodyShape(NamedTuple):
    """The properties of a body that a tile does not contain.

    Attributes:
        name: as in the tile's vertices.
        size: the number of vertices; all must be in the tile.
        closed: for three or more vertices: whether it is a polygon, not an open chain.
        clockwise: whether a polygon's vertices are numbered clockwise; None if unknown:
            either order is accepted.
        parts: of a body with holes or several parts: for each part the numbers of the vertices
            of its outline, counter-clockwise, and of its holes, clockwise.
    """

    name: str
    size: int
    closed: bool = True
    clockwise: bool | None = None
    parts: Sequence[Sequence[Sequence[int]]] = ()

    def __repr__(self) -> str:
        return record_in_brief(self)

    @classmethod
    def of_scene(cls, scene: Scene) -> list[BodyShape]:
        """Return the shapes of all bodies, with their constant orientation."""
        return [cls._of_body(body, body.exact_at(scene.exact_start)) for body in scene.bodies]

    @classmethod
    def _of_body(cls, body: Body, points: Sequence[Point]) -> BodyShape:
        if not body.has_rings:
            return cls(body.name, body.size, body.closed, signed_area2(points) < 0)
        parts = [
            [
                ring if (signed_area2([points[i] for i in ring]) > 0) == (k == 0) else ring[::-1]
                for k, ring in enumerate(part)
            ]
            for part in body.parts
        ]
        return cls(body.name, body.size, parts=parts)


class PlacedBody(NamedTuple):
    """A body at one time.

    A radius is not part of it: it is the core that is placed.

    Attributes:
        shape: its shape. The rings of a body may be numbered in either orientation.
        points: the coordinates of all vertices, by number, exactly.
    """

    shape: BodyShape
    points: Sequence[Sequence[Rational]]

    def __repr__(self) -> str:
        return record_in_brief(self)

    @classmethod
    def of_body(cls, body: Body, at: Rational) -> PlacedBody:
        """Return a body at a rational time.

        >>> from exactpt import Translation
        >>> ball = Body("ball", [(0, 0), (1, 0)], Translation([0, 2]))
        >>> [(int(x), int(y)) for x, y in PlacedBody.of_body(ball, 3).points]
        [(6, 0), (7, 0)]
        """
        parts = body.parts if body.has_rings else ()
        return cls(BodyShape(body.name, body.size, body.closed, parts=parts), body.at(at))


class Relation(NamedTuple):
    """What two bodies have in common at one time.

    Attributes:
        do_intersect: whether they share a point; bodies are closed sets.
        do_overlap: whether their interiors share a point. A point or a chain has no interior.
        squared: the square of their distance; 0 if they intersect.
    """

    do_intersect: bool
    do_overlap: bool
    squared: Fraction

    def __repr__(self) -> str:
        return record_in_brief(self)


class IsolatedRoot(NamedTuple):
    """A real root: the only one of ``polynomial`` (constant term first) in [low, high]."""

    polynomial: Sequence[int]
    low: QQ
    high: QQ

    def __repr__(self) -> str:
        return record_in_brief(self)

    @classmethod
    def of_json(cls, time: Mapping[str, object]) -> IsolatedRoot:
        """Return the root in a ``time`` object of docs/format.md: its polynomial, low and high.

        Raises:
            InputError: if a key is missing or a value is not a number.
        """
        try:
            polynomial = [exactly(c) for c in cast("Iterable[object]", time["polynomial"])]
            low, high = exactly(time["low"]), exactly(time["high"])
        except (KeyError, TypeError, ValueError) as error:
            raise InputError(f"not a time as exactpt writes it: {error}") from None
        if any(c.denominator != 1 for c in polynomial):
            raise InputError(f"not a polynomial over the integers: {shorten(time['polynomial'])}")
        return cls([ZZ(c.numerator) for c in polynomial], low, high)


RootClaim: TypeAlias = "IsolatedRoot | AlgebraicNumber"
"""A real root, in any form that callers may pass."""


class Signs(NamedTuple):
    """The signs of a polynomial just before, at, and just after a root of another."""

    before: int
    at: int
    after: int

    def __repr__(self) -> str:
        return record_in_brief(self)


@final
@dataclass(frozen=True, slots=True)
class Verdict:
    """The verdict on a claim.

    Attributes:
        ok: whether the claim holds.
        reason: why it does not, with indices of the request; empty if ``ok``.
        stats: the figures of the reply, by name; empty if not ``ok``.
    """

    ok: bool
    reason: str = ""
    stats: Mapping[str, int] = field(default_factory=dict)

    def __repr__(self) -> str:
        return record_in_brief(self)


def exactly(value: object) -> QQ:
    """Return the rational value; floats are refused, since they indicate earlier rounding."""
    if isinstance(value, float):
        raise InputError(f"not an exact number: {shorten(value)}")
    return rational(cast("Rational", value))
