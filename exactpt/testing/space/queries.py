"""The record of a query in space: four vertices that move linearly during [0, 1]."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Final, Literal, TypeAlias, cast, final

from exactpt.brief import record_in_brief
from exactpt.errors import InputError
from exactpt.kernel.numbers import QQ, Rational, rational, shorten
from exactpt.testing.questions import Name, double, id_of

Kind: TypeAlias = Literal["vertex-face", "edge-edge"]
KINDS: Final = ("vertex-face", "edge-edge")

Point: TypeAlias = tuple[float, float, float]
Exact: TypeAlias = tuple[QQ, QQ, QQ]


@final
@dataclass(frozen=True, slots=True)
class SpaceQuery:
    """A vertex and a face, or two edges, of which all vertices move linearly.

    Attributes:
        kind: "vertex-face" or "edge-edge".
        start: four points (x, y, z) at t = 0: the vertex and the three vertices of the face, or
            the two ends of the first edge and the two ends of the second.
        end: the same four vertices at t = 1.
        name: "family:seed:number" if a family has made the query, else chosen by the caller.
    """

    kind: Kind
    start: tuple[Point, ...]
    end: tuple[Point, ...]
    name: Name = None

    def __repr__(self) -> str:
        return record_in_brief(self)

    @property
    def size(self) -> int:
        """The number of coordinates that are not zero."""
        return sum(c != 0 for point in self.start + self.end for c in point)

    @property
    def summary(self) -> str:
        """A description of a few words."""
        return self.kind

    @classmethod
    def from_json(cls, data: Mapping[str, object]) -> SpaceQuery:
        """Return the query of a JSON object, see docs/testing.md.

        Raises:
            InputError: one line with the key and the value that are wrong.
        """
        kind = data.get("kind")
        if kind not in KINDS:
            raise InputError(f'"kind": expected one of {", ".join(KINDS)}, got {shorten(kind)}')
        for key in data:
            if key not in ("id", "kind", "start", "end"):
                raise InputError(f"unknown key {shorten(key)}")
        start, end = (_doubles(data, key) for key in ("start", "end"))
        return cls(kind, start, end, id_of(dict(data)))

    def to_json(self) -> dict[str, object]:
        """Return the query as a JSON object, see docs/testing.md."""
        name = {} if self.name is None else {"id": self.name}
        start, end = ([list(p) for p in points] for points in (self.start, self.end))
        return {**name, "kind": self.kind, "start": start, "end": end}


def read_points(points: Sequence[Sequence[Rational]], where: str) -> tuple[Exact, ...]:
    """Return four points as rationals.

    Raises:
        InputError: if there are not four points of three finite numbers each.
    """
    if len(points) != 4 or any(len(point) != 3 for point in points):
        raise InputError(f"{where}: expected 4 points of 3 coordinates, got {shorten(points)}")
    return tuple((rational(x), rational(y), rational(z)) for x, y, z in points)


def _doubles(data: Mapping[str, object], key: str) -> tuple[Point, ...]:
    if key not in data:
        raise InputError(f'the key "{key}" is missing')
    points = data[key]
    listed = isinstance(points, list) and len(points) == 4
    if not listed or not all(
        isinstance(p, list) and len(p) == 3 for p in cast("list[object]", points)
    ):
        raise InputError(f'"{key}": expected 4 points of 3 coordinates, got {shorten(points)}')
    where = f'"{key}"'
    return tuple(
        (double(x, where), double(y, where), double(z, where))
        for x, y, z in cast("list[list[object]]", points)
    )
