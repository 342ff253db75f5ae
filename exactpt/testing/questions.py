"""Questions: when do two bodies that translate first touch? All their numbers are doubles.

A body with another motion has no `Question`, but may stand in a line of JSON (`read_question`).
"""

from __future__ import annotations

import json
import math
from collections.abc import Mapping
from dataclasses import dataclass
from fractions import Fraction
from typing import Final, NoReturn, TypeAlias, final

from exactpt.brief import record_in_brief
from exactpt.errors import InputError
from exactpt.geometry.predicates import orientation
from exactpt.kernel.numbers import rational, shorten
from exactpt.motion.body import Body
from exactpt.motion.motions import Translation
from exactpt.scene.format import from_json
from exactpt.scene.groups import refuse_groups
from exactpt.scene.scene import Scene

Doubles: TypeAlias = tuple[float, ...]
Name: TypeAlias = "str | int | None"

_BODY: Final = {"vertices", "motion", "closed"}


@final
@dataclass(frozen=True, slots=True)
class Moving:
    """A body that translates.

    Attributes:
        vertices: one (a point), two (a segment) or more, each (x, y).
        x, y: the translation that is added to every vertex, polynomials in t, the constant first;
            empty for rest.
        closed: False for an open chain.
    """

    vertices: tuple[tuple[float, float], ...]
    x: Doubles = ()
    y: Doubles = ()
    closed: bool = True

    def __repr__(self) -> str:
        return record_in_brief(self)

    @property
    def velocity(self) -> tuple[float, float]:
        """The velocity (x, y) at t = 0, which is that of all times if the motion is linear."""
        x, y = self.x, self.y
        return x[1] if len(x) > 1 else 0.0, y[1] if len(y) > 1 else 0.0

    def to_json(self) -> dict[str, object]:
        """Return the body as a JSON object, see docs/testing.md."""
        data: dict[str, object] = {"vertices": [list(v) for v in self.vertices]}
        if self.x or self.y:
            data["motion"] = {"x": list(self.x), "y": list(self.y)}
        return data if self.closed else {**data, "closed": False}


@final
@dataclass(frozen=True, slots=True)
class Question:
    """Two bodies and the closed time span in which they are watched.

    Attributes:
        a, b: the bodies.
        time: the start and the end of the span.
        name: "family:seed:number" if `make_question` has made it, else what its asker calls it.
    """

    a: Moving
    b: Moving
    time: tuple[float, float]
    name: Name = None

    def __repr__(self) -> str:
        return record_in_brief(self)

    @property
    def scene(self) -> Scene:
        """The scene of the bodies "a" and "b", with the exact values of the doubles.

        Raises:
            InputError: if the span is empty, or a body is not simple.
        """
        bodies = [
            Body(name, m.vertices, Translation(m.x, m.y), closed=m.closed)
            for name, m in (("a", self.a), ("b", self.b))
        ]
        return Scene(bodies, self.time)

    @property
    def size(self) -> int:
        """The number of vertices."""
        return len(self.a.vertices) + len(self.b.vertices)

    @property
    def polygons(self) -> bool:
        """True if both bodies are polygons: neither points, segments nor open chains."""
        return all(body.closed and len(body.vertices) > 2 for body in (self.a, self.b))

    @property
    def convex(self) -> bool:
        """True if both bodies are strictly convex polygons."""
        return self.polygons and _is_convex(self.a) and _is_convex(self.b)

    @property
    def summary(self) -> str:
        """A description of a few words."""
        return f"{len(self.a.vertices)} and {len(self.b.vertices)} vertices"

    @classmethod
    def from_scene(cls, scene: Scene, name: Name = None) -> Question:
        """Return the question about the two bodies of a scene.

        Raises:
            InputError: if there are not two, they ignore each other, one does not translate, or a
                number is not a double.
        """
        refuse_groups(scene, "a question is about bodies that count; exactpt.testing asks no other")
        if len(scene.bodies) != 2:
            raise InputError(f"a question is about two bodies, not {len(scene.bodies)}")
        a, b = (_moving(body) for body in scene.bodies)
        return cls(a, b, (_exact_double(scene.start), _exact_double(scene.end)), name)

    @classmethod
    def from_json(cls, data: Mapping[str, object]) -> Question:
        """Return the question of a JSON object, see docs/testing.md.

        Raises:
            InputError: one line that names the fault.
        """
        question = _asked(dict(data))
        if not isinstance(question, Question):
            raise InputError("not a question: a body does more than translate")
        return question

    def to_json(self) -> dict[str, object]:
        """Return the question as a JSON object, see docs/testing.md."""
        name = {} if self.name is None else {"id": self.name}
        bodies = {"a": self.a.to_json(), "b": self.b.to_json()}
        return {**name, "time": list(self.time), **bodies}


Asked: TypeAlias = Question | Scene
"""What can be asked: a question, or the scene of two bodies of which one does not translate."""


def read_question(text: str | bytes) -> tuple[Name, Asked]:
    """Return the id and the question in a line of JSON.

    Raises:
        InputError: one line that names the fault.
    """
    data = objects(text)
    return id_of(data), _asked(data)


def objects(text: str | bytes) -> dict[str, object]:
    """Return the JSON object of a line.

    Raises:
        InputError: if it is none, a key is there twice, or a number is not finite.
    """
    try:
        data = json.loads(text, parse_constant=_no_number, object_pairs_hook=_unique)
    except InputError:
        raise
    except (ValueError, RecursionError):
        raise InputError(f"not JSON: {shorten(_readable(text))}") from None
    if not isinstance(data, dict):
        raise InputError(f"not a JSON object: {shorten(data)}")
    return data


def double(value: object, where: str) -> float:
    """Return the double that a JSON number means, or a text: decimal, or hexadecimal as in C.

    A decimal means the nearest double.

    Raises:
        InputError: if it is none, or not finite.
    """
    try:
        if isinstance(value, str):
            number = float.fromhex(value) if "0x" in value.lower() else float(value)
        elif isinstance(value, int | float) and not isinstance(value, bool):
            number = float(value)
        else:
            number = math.nan
    except (ValueError, OverflowError):
        number = math.nan
    if not math.isfinite(number):
        raise InputError(f"{where}: not a finite double: {shorten(value)}")
    return number


def _asked(data: dict[str, object]) -> Asked:
    for key in ("time", "a", "b"):
        if key not in data:
            raise InputError(f'the key "{key}" is missing')
    for key in data:
        if key not in ("id", "time", "a", "b"):
            raise InputError(f"unknown key {shorten(key)}")
    time = _doubles(data["time"], '"time"')
    if len(time) != 2:
        raise InputError(f'"time": not a start and an end: {shorten(data["time"])}')
    a, b = data["a"], data["b"]
    if _translates(a) and _translates(b):
        return Question(_read(a, '"a"'), _read(b, '"b"'), (time[0], time[1]), id_of(data))
    bodies = [{**_exactly(body, f'"{k}"'), "name": k} for k, body in (("a", a), ("b", b))]
    return from_json({"exactpt": 1, "time": [str(Fraction(t)) for t in time], "bodies": bodies})


def id_of(data: dict[str, object]) -> Name:
    """Return the id of a question as JSON, None if it has none.

    Raises:
        InputError: if it is neither a text nor an integer.
    """
    name = data.get("id")
    if isinstance(name, bool) or not isinstance(name, str | int | None):
        raise InputError(f'"id": neither a text nor an integer: {shorten(name)}')
    return name


def _translates(body: object) -> bool:
    """Return True if a body has the keys of a body that translates."""
    if not isinstance(body, dict) or not _BODY.issuperset(body):
        return False
    motion, vertices = body.get("motion", {}), body.get("vertices")
    plain = isinstance(vertices, list) and not any(isinstance(v, dict) for v in vertices)
    return plain and isinstance(motion, dict) and {"x", "y"}.issuperset(motion)


def _read(body: object, where: str) -> Moving:
    assert isinstance(body, dict)  # noqa: S101 - `_translates`
    vertices = []
    for vertex in body["vertices"]:
        at = _doubles(vertex, f'{where}: "vertices"')
        if len(at) != 2:
            raise InputError(f"{where}: a vertex has two coordinates: {shorten(vertex)}")
        vertices.append((at[0], at[1]))
    closed = body.get("closed", True)
    if not isinstance(closed, bool):
        raise InputError(f'{where}: "closed": not true or false: {shorten(closed)}')
    motion = body.get("motion", {})
    x, y = (_doubles(motion.get(k, []), f'{where}: "{k}"') for k in ("x", "y"))
    if closed and len(vertices) > 3 and vertices[0] == vertices[-1]:
        raise InputError(f'{where}: "vertices": the last repeats the first')
    if not vertices:
        raise InputError(f'{where}: "vertices": at least one is needed')
    return Moving(tuple(vertices), x, y, closed)


def _doubles(values: object, where: str) -> Doubles:
    if not isinstance(values, list):
        raise InputError(f"{where}: not a list of numbers: {shorten(values)}")
    if all(type(value) is float for value in values) and math.isfinite(math.fsum(values)):
        return tuple(values)
    return tuple(double(value, where) for value in values)


def _exactly(body: object, where: str) -> dict[str, object]:
    """Return a body in which every double is written as the rational that it is."""
    if not isinstance(body, dict):
        raise InputError(f"{where}: not a body: {shorten(body)}")
    return {key: _rationals(value, f"{where}: {shorten(key)}") for key, value in body.items()}


def _rationals(value: object, where: str) -> object:
    if isinstance(value, dict):
        return {key: _rationals(part, where) for key, part in value.items()}
    if isinstance(value, list):
        return [_rationals(part, where) for part in value]
    return value if isinstance(value, bool) else str(Fraction(double(value, where)))


def _is_convex(body: Moving) -> bool:
    """Return True if a simple polygon turns strictly one way at every vertex."""
    points = [(rational(x), rational(y)) for x, y in body.vertices]
    corners = zip(points[-2:] + points[:-2], points[-1:] + points[:-1], points, strict=True)
    return {orientation(*corner) for corner in corners} in ({1}, {-1})


def _moving(body: Body) -> Moving:
    motion = body.motion
    if body.keyframes or not isinstance(motion, Translation):
        raise InputError(f"body {body.name}: it does more than translate")
    if body.has_rings:
        raise InputError(f"body {body.name}: it has holes or several parts")
    vertices = []
    for position in body.vertices:
        if any(f.degree > 0 for f in position):
            raise InputError(f"body {body.name}: it deforms")
        vertices.append((_exact_double(position[0](0)), _exact_double(position[1](0))))
    x, y = (tuple(map(_exact_double, f.coefficients)) for f in (motion.x, motion.y))
    return Moving(tuple(vertices), x, y, body.closed)


def _exact_double(value: Fraction) -> float:
    try:
        number = float(value)
    except OverflowError:
        number = math.inf
    if not math.isfinite(number) or Fraction(number) != value:
        raise InputError(f"not a double: {shorten(str(value))}")
    return number


def _unique(pairs: list[tuple[str, object]]) -> dict[str, object]:
    result = dict(pairs)
    if len(result) < len(pairs):
        raise InputError("a key is there twice")
    return result


def _no_number(text: str) -> NoReturn:
    raise InputError(f"not a finite number: {text}")


def _readable(text: str | bytes) -> str:
    return text if isinstance(text, str) else text.decode(errors="replace")
