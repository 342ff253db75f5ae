"""Shrinking: a smaller scene that still fails, by delta debugging on its JSON data.

The fuzzer of the repository shrinks by it too.

Source: A. Zeller and R. Hildebrandt, *Simplifying and isolating failure-inducing input*,
IEEE Transactions on Software Engineering 28 (2002) 183-200: remove halves first, then
quarters, and so on.
"""

from __future__ import annotations

import copy
import json
import time as clock
from collections.abc import Callable, Iterable, Iterator, Sequence
from fractions import Fraction
from typing import Any, Final, TypeAlias

from exactpt.errors import InputError
from exactpt.kernel.numbers import fraction, parse_rational, rational
from exactpt.scene.format import from_json
from exactpt.scene.groups import kept_groups, members_of
from exactpt.scene.scene import Scene
from exactpt.scene.written import to_json
from exactpt.testing.questions import Question
from exactpt.testing.truth import Truth, truth_of

Data: TypeAlias = Any
"""A scene as JSON data. Candidates may be invalid scenes; ``fails`` must be false for these."""

Path: TypeAlias = tuple[str | int, ...]

_MEASURES: Final = ("units", "epoch")
"""The keys of a scene that say what its numbers count."""
_ERRORS: Final = ("place_error", "angle_error", "shape_error", "pivot")
"""The keys of a body that state errors of it."""


def shrink(scene: Scene, fails: Callable[[Scene], bool], *, seconds: float = 60.0) -> Scene:
    """Return the smallest scene found for which something still fails.

    Fewer bodies, a shorter span, fewer vertices, simpler motions, rounder numbers: each is kept
    if ``fails`` is true of the scene without it.

    Args:
        scene: a scene for which ``fails`` is true.
        fails: whether a scene fails. It is called with valid scenes only.
        seconds: time limit; the search ends by itself, too.

    Raises:
        ValueError: if ``fails`` is false for the scene itself.
    """
    if not fails(scene):
        raise ValueError("nothing to be shrunken: the scene itself does not fail")

    def fails_as_data(data: Data) -> bool:
        try:
            smaller = from_json(data)
        except InputError:
            return False
        return fails(smaller)

    return from_json(shrink_data(to_json(scene), fails_as_data, seconds))


def shrink_question(
    question: Question, fails: Callable[[Question, Truth], bool], *, seconds: float = 60.0
) -> Question:
    """Return the smallest question found for which something still fails.

    A polygon stays one, and the kind of the true contact stays, too: otherwise most shrink to two
    points that touch at the start, which is another fault.

    Args:
        question: a question for which ``fails`` is true.
        fails: whether a question, with its truth, fails.
        seconds: time limit; the search ends by itself, too.
    """
    kept = _polygons(question), truth_of(question).kind

    def fails_as_data(data: Data) -> bool:
        try:
            smaller = Question.from_scene(from_json(data))
            if _polygons(smaller) != kept[0]:
                return False
            truth = truth_of(smaller)
        except InputError:
            return False
        return truth.kind == kept[1] and fails(smaller, truth)

    data = shrink_data(to_json(question.scene), fails_as_data, seconds)
    return Question.from_scene(from_json(data), question.name)


def _polygons(question: Question) -> list[bool]:
    return [body.closed and len(body.vertices) > 2 for body in (question.a, question.b)]


def shrink_data(
    data: Data,
    fails: Callable[[Data], bool],
    seconds: float,
    steps: Sequence[Callable[[Data], Iterator[Data]]] = (),
) -> Data:
    """Return the smallest scene found in time for which ``fails`` holds; it must hold for ``data``.

    Other data than scenes have their own ``steps``, which yield candidates.
    """
    deadline = clock.monotonic() + seconds
    best, size = data, _size(data)
    improved = True
    while improved:
        improved = False
        for step in steps or _STEPS:
            candidates = step(best)
            while (candidate := next(candidates, None)) is not None:
                if clock.monotonic() > deadline:
                    return best
                its_size = _size(candidate)
                if its_size < size and fails(candidate):
                    best, size, improved = candidate, its_size, True
                    candidates = step(best)
    return best


def _size(data: Data) -> tuple[int, int, int, int]:
    """Size by which scenes are compared: bodies, vertices, weight of numbers, length of text."""
    bodies = data.get("bodies", ())
    vertices = sum(
        sum(len(_at(body, ring)) for ring in _rings(body))
        + sum(len(f["vertices"]) for f in body.get("keyframes", ()))
        for body in bodies
    )
    numbers = sum(_weight(_at(data, path)) for path in _numbers(data))
    return len(bodies), vertices, numbers, len(json.dumps(data))


def _weight(text: str) -> int:
    """Return the complexity of a number; 0 for 0."""
    q = _number(text)
    bits = 4 * (q.numerator.bit_length() + q.denominator.bit_length() - 1)
    return bits + (q < 0) + min(abs(q.numerator), 3)


def _without(items: Sequence[Data]) -> Iterator[list[Data]]:
    """Yield the items without one half, one quarter, ..., one of them."""
    width = len(items) // 2
    while width:
        for start in range(0, len(items), width):
            yield [*items[:start], *items[start + width :]]
        width //= 2


def _changed(data: Data, path: Path, value: Data) -> Data:
    """Return a copy with another value at a path."""
    result = copy.deepcopy(data)
    _at(result, path[:-1])[path[-1]] = value
    return result


def _at(data: Data, path: Path) -> Data:
    for key in path:
        data = data[key]
    return data


def _fewer_bodies(data: Data) -> Iterator[Data]:
    names = [body["name"] for body in data["bodies"]]
    for bodies in _without(data["bodies"]):
        fewer = _changed(data, ("bodies",), bodies)
        groups = tuple(map(tuple, data.get("ignoring", ())))
        kept = kept_groups(groups, names, [body["name"] for body in bodies])
        yield _with_groups(fewer, kept)


def _fewer_groups(data: Data) -> Iterator[Data]:
    for groups in _without(data.get("ignoring", ())):
        yield _with_groups(data, groups)
    for k, group in enumerate(data.get("ignoring", ())):
        for texts in _without(group):
            yield _changed(data, ("ignoring", k), texts)


def _with_groups(data: Data, groups: Iterable[Iterable[str]]) -> Data:
    """Return a copy with other groups of bodies that ignore each other, without a key for none."""
    result = copy.deepcopy(data)
    result.pop("ignoring", None)
    listed = [list(group) for group in groups]
    if listed:
        result["ignoring"] = listed
    return result


def _shorter_span(data: Data) -> Iterator[Data]:
    start, end = map(_number, data["time"])
    for share in (Fraction(1, 8), Fraction(1, 4), Fraction(1, 2), Fraction(3, 4)):
        yield _changed(data, ("time", 1), _text(start + share * (end - start)))


def _fewer_vertices(data: Data) -> Iterator[Data]:
    for i, body in enumerate(data["bodies"]):
        for ring in _rings(body):
            for vertices in _without(_at(body, ring)):
                yield _changed(data, ("bodies", i, *ring), vertices)
        if "keyframes" in body:
            frames = body["keyframes"]
            for kept in _without(range(len(frames[0]["vertices"]))):
                thinner = [{**f, "vertices": [f["vertices"][v] for v in kept]} for f in frames]
                yield _changed(data, ("bodies", i, "keyframes"), thinner)


def _rings(body: Data) -> Iterator[Path]:
    """Yield the paths of the rings of vertices in a body."""
    parts: list[Path] = [("parts", k) for k in range(len(body.get("parts", ())))]
    for path in parts or ([()] if "vertices" in body else []):
        part = _at(body, path)
        yield (*path, "vertices")
        yield from ((*path, "holes", k) for k in range(len(part.get("holes", ()))))


def _fewer_rings(data: Data) -> Iterator[Data]:
    for i, body in enumerate(data["bodies"]):
        rest = {key: value for key, value in body.items() if key != "parts"}
        for part in body.get("parts", ()):
            yield _changed(data, ("bodies", i), {**rest, **part})
        for parts in _without(body.get("parts", ())):
            yield _changed(data, ("bodies", i, "parts"), parts)
        for ring in _rings(body):
            path = ("bodies", i, *ring[:-1])
            if ring[-1] == "vertices" and "holes" in _at(data, path):
                part = _at(data, path)
                yield _changed(data, path, {k: v for k, v in part.items() if k != "holes"})
                for holes in _without(part["holes"]):
                    yield _changed(data, (*path, "holes"), holes)


def _simpler_motions(data: Data) -> Iterator[Data]:
    for i, body in enumerate(data["bodies"]):
        rest = {key: value for key, value in body.items() if key != "motion"}
        if "motion" in body:
            yield _changed(data, ("bodies", i), rest)
            for motion in _parts(body["motion"]):
                yield _changed(data, ("bodies", i, "motion"), motion)
        for frames in _without(body.get("keyframes", ())):
            yield _changed(data, ("bodies", i, "keyframes"), frames)
        for frame in body.get("keyframes", ()):
            del rest["keyframes"]
            yield _changed(data, ("bodies", i), {**rest, "vertices": frame["vertices"]})
            rest["keyframes"] = body["keyframes"]


def _parts(motion: Data) -> Iterator[Data]:
    if "pieces" in motion:
        yield from (piece["motion"] for piece in motion["pieces"])
        for pieces in _without(motion["pieces"]):
            if pieces:
                yield {"pieces": [*pieces[:-1], {"motion": pieces[-1]["motion"]}]}
    for kind in ("rigid", "affine"):
        if kind in motion:
            yield {key: motion[kind][key] for key in ("x", "y") if key in motion[kind]}
            for key in ("x", "y"):
                if key in motion[kind]:
                    yield {kind: {k: v for k, v in motion[kind].items() if k != key}}
    for key in ("x", "y"):
        if key in motion:
            yield {k: v for k, v in motion.items() if k != key}


def _lower_degrees(data: Data) -> Iterator[Data]:
    for path in _paths(data):
        value = _at(data, path)
        is_polynomial = isinstance(value, list) and len(value) > 1 and isinstance(value[0], str)
        if is_polynomial and path[0] != "ignoring":
            yield _changed(data, path, value[:-1])
        if isinstance(value, dict) and set(value) == {"x", "y"} and isinstance(path[-1], int):
            yield _changed(data, path, [value["x"][0], value["y"][0]])


def coarser_numbers(data: Data) -> Iterator[Data]:
    """Yield data with all numbers smaller, rounded to integers or halves."""
    for divisor in (1000, 100, 10, 5, 2, 1):
        for unit in (1, 2):
            result = copy.deepcopy(data)
            for path in _numbers(data):
                if path[0] != "time":
                    value = _number(_at(data, path)) * unit / divisor
                    _at(result, path[:-1])[path[-1]] = _text(Fraction(round(value), unit))
            yield result


def simpler_numbers(data: Data) -> Iterator[Data]:
    """Yield data with one number simpler."""
    for path in _numbers(data):
        q = _number(_at(data, path))
        simpler: list[Fraction | int] = [0, 1, -1, int(q), round(q), q.limit_denominator(10)]
        simpler += [round(q / 2), round(q / 10), abs(q), q - (1 if q > 0 else -1)]
        for value in dict.fromkeys(simpler):
            if value != q:
                yield _changed(data, path, _text(value))


def _number(text: str) -> Fraction:
    return fraction(parse_rational(text))


def _text(value: Fraction | int) -> str:
    return str(rational(value))  # Python itself writes no long integers


def _no_properties(data: Data) -> Iterator[Data]:
    """Yield data without the properties of bodies, which no question reads."""
    result = copy.deepcopy(data)
    for body in result["bodies"]:
        body.pop("properties", None)
    yield result


def _fewer_statements(data: Data) -> Iterator[Data]:
    """Yield data without units and an epoch, then without the errors that are stated of a body."""
    yield {key: value for key, value in data.items() if key not in _MEASURES}
    for i, body in enumerate(data["bodies"]):
        yield _changed(data, ("bodies", i), {k: v for k, v in body.items() if k not in _ERRORS})


def _simpler_names(data: Data) -> Iterator[Data]:
    old = [body["name"] for body in data["bodies"]]
    new = [chr(ord("a") + i) if i < 26 else f"b{i}" for i in range(len(old))]
    members = members_of(tuple(map(tuple, data.get("ignoring", ()))), old)
    result = _with_groups(data, [[new[i] for i in group] for group in members])
    for body, name in zip(result["bodies"], new, strict=True):
        body["name"] = name
    yield result


_STEPS: Final = (
    _no_properties,
    _fewer_statements,
    _fewer_bodies,
    _fewer_groups,
    _shorter_span,
    _fewer_rings,
    _fewer_vertices,
    _simpler_motions,
    coarser_numbers,
    _lower_degrees,
    simpler_numbers,
    _simpler_names,
)


def _numbers(data: Data) -> Iterator[Path]:
    """Yield the paths of all numbers: of all texts that are not names, groups or for people."""
    beside = {*_MEASURES, "ignoring"}
    for path in _paths(data):
        is_number = path[-1] != "name" and "properties" not in path and path[0] not in beside
        if is_number and isinstance(_at(data, path), str):
            yield path


def _paths(data: Data, path: Path = ()) -> Iterator[Path]:
    if path:
        yield path
    if isinstance(data, (dict, list)):
        for key in data if isinstance(data, dict) else range(len(data)):
            yield from _paths(data[key], (*path, key))
