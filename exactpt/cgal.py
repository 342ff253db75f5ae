"""The client of cgal_check, the independent witness: a separate program, asked over a pipe.

The program and the line protocol are described in cgal_check/README.md. This module
finds the program, writes requests with exact rationals, and reads the verdicts; it
decides nothing itself. A tiling goes out as the contract's ``tile`` dictionary has it.
"""

from __future__ import annotations

import contextlib
import os
import re
import shutil
import subprocess
import tempfile
from collections import deque
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import IO, Final, NamedTuple, Self, TypeAlias, TypedDict, cast, final

from exactpt.errors import AuditError, InputError
from exactpt.geometry.polygon import signed_area2
from exactpt.kernel.algebraic import AlgebraicNumber
from exactpt.kernel.numbers import QQ, ZZ, Rational, rational, shorten
from exactpt.scene.scene import Scene

__all__ = [
    "BodyShape",
    "CgalCheck",
    "IsolatedRoot",
    "RootClaim",
    "Signs",
    "Tile",
    "Verdict",
    "find_program",
]

_VARIABLE: Final = "EXACTPT_CGAL_CHECK"
_GREETING: Final = "exactpt-check 1"
_WRITTEN: Final = re.compile(r"-?[0-9]+(?:/[0-9]*[1-9][0-9]*)?", re.ASCII)
_ANSWERS: Final = {"ok", "bad", _GREETING.split(" ")[0]}
_SIGNS: Final = {"-": -1, "0": 0, "+": 1, "<": -1, "=": 0, ">": 1}

# Requests that are under way before an answer is read. A verdict has less than 1,024
# bytes, so their answers fit an empty pipe (4,096 bytes at the very least): the program
# never waits for us while we wait for it.
_AHEAD: Final = 3

Tile: TypeAlias = Mapping[str, object]
"""The contract's ``tile`` dictionary, as `json.load` gives it."""


class _TileVertex(TypedDict):
    body: str
    vertex: int
    x: object
    y: object


class _TileEdge(TypedDict):
    u: int
    v: int
    kind: str
    hull: bool


class _TileFace(TypedDict):
    vertices: list[int]
    corners: list[int]


class _Tile(TypedDict):
    # What we read of a tile; a caller's own type may have more.
    vertices: list[_TileVertex]
    edges: list[_TileEdge]
    faces: list[_TileFace]
    fan: list[list[int]]


class BodyShape(NamedTuple):
    """What a tile does not say of a body: how its vertices are joined.

    Attributes:
        name: as in the tile's vertices.
        size: the number of vertices; all must be in the tile.
        closed: with three vertices or more: a polygon, otherwise an open chain.
        clockwise: whether a polygon's vertices are numbered clockwise; None: unknown,
            and either is accepted.
    """

    name: str
    size: int
    closed: bool = True
    clockwise: bool | None = None

    @classmethod
    def of_scene(cls, scene: Scene) -> list[BodyShape]:
        """The shapes of all bodies, with the orientation at the start, which never changes."""
        return [
            cls(body.name, body.size, body.closed, signed_area2(body.at(scene.start)) < 0)
            for body in scene.bodies
        ]


class IsolatedRoot(NamedTuple):
    """A real root: the only one of ``polynomial`` (constant term first) in [low, high]."""

    polynomial: Sequence[int]
    low: QQ
    high: QQ

    @classmethod
    def of_json(cls, time: Mapping[str, object]) -> IsolatedRoot:
        """The contract's ``time`` object: its polynomial, low and high.

        Raises:
            InputError: if one of these is missing or no number.
        """
        try:
            polynomial = [_exactly(c) for c in cast("Iterable[object]", time["polynomial"])]
            low, high = _exactly(time["low"]), _exactly(time["high"])
        except (KeyError, TypeError, ValueError) as error:
            raise InputError(f"not a time of the contract: {error}") from None
        if any(c.denominator != 1 for c in polynomial):
            raise InputError(f"not a polynomial over the integers: {shorten(time['polynomial'])}")
        return cls([ZZ(c.numerator) for c in polynomial], low, high)


RootClaim: TypeAlias = "IsolatedRoot | AlgebraicNumber"
"""A real root as a caller may pass it."""


class Signs(NamedTuple):
    """The signs of a polynomial just before, at, and just after a root of another."""

    before: int
    at: int
    after: int


@final
@dataclass(frozen=True, slots=True)
class Verdict:
    """What the witness says of a claim.

    Attributes:
        ok: whether it holds.
        reason: why not, in words, with indices of the request; empty if ``ok``.
        stats: the figures of the answer, by name; empty if not ``ok``.
    """

    ok: bool
    reason: str = ""
    stats: Mapping[str, int] = field(default_factory=dict)


class _BadTileError(Exception):
    """The tile contradicts itself or the bodies: a verdict, found before asking."""


def find_program() -> Path:
    """The cgal_check program: ``$EXACTPT_CGAL_CHECK``, the checkout's build, or on PATH.

    Raises:
        InputError: if there is none; the message says how to build it.
    """
    named = os.environ.get(_VARIABLE)
    if named:
        if not os.access(named, os.X_OK) or Path(named).is_dir():
            raise InputError(f"{_VARIABLE} names no program: {named!r}")
        return Path(named)
    built = Path(__file__).parents[1] / "cgal_check" / "build" / "cgal_check"
    if os.access(built, os.X_OK):
        return built
    if on_path := shutil.which("cgal_check"):
        return Path(on_path)
    raise InputError(
        "the program cgal_check is missing; build it in the checkout (it needs CGAL 5.5): "
        "cmake -S cgal_check -B cgal_check/build -DCMAKE_BUILD_TYPE=Release "
        f"&& cmake --build cgal_check/build, or let {_VARIABLE} name it"
    )


@final
class CgalCheck:
    """A running cgal_check; started by the first question, ended by `close` or ``with``.

    Args:
        program: the program; `find_program` if not given.

    Raises:
        InputError: here, if there is no program; by every question, if what was asked is
            not acceptable. The next question starts the program anew.
        AuditError: by every question, if the program itself breaks.
    """

    __slots__ = ("_errors", "_process", "program")

    def __init__(self, program: str | Path | None = None) -> None:
        self.program = find_program() if program is None else Path(program)
        self._process: subprocess.Popen[bytes] | None = None
        self._errors: IO[bytes] | None = None

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *_error: object) -> None:
        self.close()

    def check_tiling(
        self, tile: Tile, bodies: Iterable[BodyShape], *, deep: bool = False
    ) -> Verdict:
        """Whether a tile is a pseudo-triangulation of the free space, exactly.

        Args:
            tile: the contract's ``tile`` dictionary.
            bodies: the shape of every body of the scene.
            deep: ask a second, independent witness too (CGAL's arrangements; slower).

        Raises:
            InputError: if the tile lacks a key or has a value of a wrong type.
        """
        return next(self.check_tilings([(tile, bodies)], deep=deep))

    def check_tilings(
        self, tiles: Iterable[tuple[Tile, Iterable[BodyShape]]], *, deep: bool = False
    ) -> Iterator[Verdict]:
        """The verdicts of `check_tiling` on many tiles, in order; writes ahead, so faster."""
        word = "tiling deep" if deep else "tiling"
        return self._verdicts(_tiling_request(word, tile, bodies) for tile, bodies in tiles)

    def check_triangulation(
        self, tile: Tile, bodies: Iterable[BodyShape], *, deep: bool = False
    ) -> Verdict:
        """Whether a tile's edges, with its ``fan`` edges, cut the free space into triangles.

        The faces of the tile are not looked at: see `check_tiling`.
        """
        word = "triangulation deep" if deep else "triangulation"
        return next(self._verdicts([_tiling_request(word, tile, bodies)]))

    def check_root(self, polynomial: Sequence[int], low: Rational, high: Rational) -> Verdict:
        """Whether a polynomial has exactly one real root in [low, high].

        The figures are ``roots``, the number of distinct real roots; ``rank``, which of
        them it is, counted from 1; and ``multiplicity``.
        """
        claim = IsolatedRoot(polynomial, rational(low), rational(high))
        return _verdict(self._ask(f"root {_root_words(claim)} end\n"))

    def compare_roots(self, a: RootClaim, b: RootClaim) -> int:
        """-1, 0 or 1 as a is smaller than, equal to, or larger than b.

        Raises:
            InputError: if an interval does not isolate a root.
        """
        return _signs(self._ask(f"compare {_root_words(a)} {_root_words(b)} end\n"))[0]

    def sign_at_root(self, f: Sequence[int], root: RootClaim) -> Signs:
        """The signs of f just before, at and just after a root.

        Raises:
            InputError: if the interval does not isolate a root.
        """
        answer = self._ask(f"sign {_root_words(root)} of {_polynomial_words(f)} end\n")
        return Signs(*_signs(answer))

    def hull(self, points: Iterable[Sequence[Rational]]) -> list[int]:
        """The corners of the convex hull of points, as indices, counter-clockwise.

        Starts at the smallest point (by x, then y); of equal points, the first; points
        inside a hull edge are left out.
        """
        words = [_point_words(p) for p in points]
        return [int(i) for i in _claimed(self._ask(f"hull {len(words)} {' '.join(words)} end\n"))]

    def orientations(self, triples: Iterable[Sequence[Sequence[Rational]]]) -> list[int]:
        """For each triple of points 1, 0 or -1: a left turn, collinear, a right turn."""
        words = [" ".join(map(_point_words, (a, b, c))) for a, b, c in triples]
        return _signs(self._ask(f"orientations {len(words)} {' '.join(words)} end\n"))

    def close(self) -> None:
        """End the program. It may be asked again."""
        process, errors = self._process, self._errors
        self._process = self._errors = None
        if process is not None and process.stdin is not None and process.stdout is not None:
            with contextlib.suppress(BrokenPipeError):  # it may have ended before us
                process.stdin.close()
            process.stdout.close()
            process.wait()
        if errors is not None:
            errors.close()

    def _verdicts(self, requests: Iterable[str | Verdict]) -> Iterator[Verdict]:
        pending: deque[Verdict | None] = deque()  # None: the program's answer is to be read
        try:
            for request in requests:
                if isinstance(request, Verdict):
                    pending.append(request)
                else:
                    self._write(request)
                    pending.append(None)
                if len(pending) > _AHEAD:
                    yield pending.popleft() or _verdict(self._read())
            while pending:
                yield pending.popleft() or _verdict(self._read())
        finally:
            if None in pending:  # given up half-way: the answers under way are not for others
                self._kill()

    def _ask(self, request: str) -> str:
        self._write(request)
        return self._read()

    def _write(self, text: str) -> None:
        stdin = self._running().stdin
        try:
            if stdin is not None:
                stdin.write(text.encode("ascii"))
                stdin.flush()
        except BrokenPipeError:
            pass  # it ended: its last line, which `_read` finds, says why
        except BaseException:
            self._kill()  # half a request was written
            raise

    def _read(self) -> str:
        stdout = self._running().stdout
        try:
            line = b"" if stdout is None else stdout.readline()
        except BaseException:
            self._kill()  # this answer would be taken for the next one's
            raise
        text = line.decode("ascii", "replace").rstrip("\n")
        if line.endswith(b"\n") and text.split(" ")[0] in _ANSWERS:
            return text
        raise self._failure(text)

    def _running(self) -> subprocess.Popen[bytes]:
        if self._process is not None:
            return self._process
        # Whatever CGAL says of a failed assertion goes to a file: a pipe that nobody
        # reads could fill and block.
        self._errors = tempfile.TemporaryFile()  # noqa: SIM115 - closed in `close`
        try:
            self._process = subprocess.Popen(
                self.program, stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=self._errors
            )
        except OSError as error:
            self.close()
            raise InputError(f"cannot start {str(self.program)!r}: {error.strerror}") from None
        greeting = self._ask(_GREETING + "\n")
        if not greeting.startswith(f"{_GREETING} cgal "):
            self._kill()
            raise InputError(f"{str(self.program)!r} does not speak {_GREETING!r}: {greeting!r}")
        return self._process

    def _kill(self) -> None:
        if self._process is not None:
            self._process.kill()
        self.close()

    def _failure(self, last_words: str) -> InputError | AuditError:
        process, errors = self._process, self._errors
        code, said = None, ""
        if process is not None and errors is not None:
            if last_words and not last_words.startswith("error"):
                process.kill()  # it speaks another language and may never end
            code = process.wait()
            errors.seek(0)
            said = errors.read()[-2000:].decode("utf-8", "replace").strip()
        self.close()
        if code == 2:
            return InputError(f"cgal_check refuses the request: {last_words}")
        return AuditError(f"cgal_check ended with {code}: {last_words} {said}".rstrip())


def _tiling_request(word: str, tile: Tile, bodies: Iterable[BodyShape]) -> str | Verdict:
    """The text of a request; or the verdict, where the tile does not even fit the bodies."""
    parts = cast("_Tile", tile)
    with_faces = word.startswith("tiling")
    try:
        lines = [word, *_vertex_lines(parts["vertices"])]
        lines += _body_lines(parts["vertices"], [BodyShape(*shape) for shape in bodies])
        index = range(len(parts["vertices"]))
        lines += _edge_lines(parts["edges"], [] if with_faces else parts["fan"], index)
        lines += _face_lines(parts["faces"], index) if with_faces else []
    except _BadTileError as fault:
        return Verdict(ok=False, reason=str(fault))
    except KeyError as error:
        raise InputError(f"not a tile of the contract: {error} is missing") from None
    except (TypeError, ValueError) as error:
        raise InputError(f"not a tile of the contract: {error}") from None
    return "\n".join([*lines, "end\n"])


def _vertex_lines(vertices: list[_TileVertex]) -> Iterator[str]:
    yield f"vertices {len(vertices)}"
    for vertex in vertices:
        yield f"{_coordinate(vertex['x'])} {_coordinate(vertex['y'])}"


def _body_lines(vertices: list[_TileVertex], shapes: list[BodyShape]) -> Iterator[str]:
    place: dict[tuple[str, int], int] = {}
    for i, vertex in enumerate(vertices):
        if place.setdefault((vertex["body"], vertex["vertex"]), i) != i:
            raise _BadTileError(f"vertex {i} is {vertex['body']!r}: {vertex['vertex']} again")
    yield f"bodies {len(shapes)}"
    for shape in shapes:
        ring = [place.pop((shape.name, number), None) for number in range(shape.size)]
        if None in ring:
            missing = ring.index(None)
            raise _BadTileError(f"body {shape.name!r}: vertex {missing} is not in the tile")
        words = " ".join(map(str, reversed(ring) if shape.clockwise else ring))
        if shape.size < 3:
            yield f"{'point' if shape.size == 1 else 'segment'} {words}"
        elif not shape.closed:
            yield f"chain {shape.size} {words}"
        else:
            yield f"{'ring' if shape.clockwise is None else 'polygon'} {shape.size} {words}"
    for (name, number), i in place.items():
        raise _BadTileError(f"vertex {i} is of no body: {name!r}: {number}")


def _edge_lines(edges: list[_TileEdge], fan: list[list[int]], index: range) -> Iterator[str]:
    yield f"edges {len(edges) + len(fan)}"
    for edge in edges:
        ends, kind, hull = _indices((edge["u"], edge["v"]), index), edge["kind"], edge["hull"]
        if kind not in {"boundary", "diagonal"} or not isinstance(hull, bool):
            raise ValueError(f"edge {ends}: kind {shorten(kind)}, hull {shorten(hull)}")
        yield f"{ends} {kind} {'hull' if hull else 'inner'}"
    for u, v in fan:
        yield f"{_indices((u, v), index)} diagonal inner"


def _face_lines(faces: list[_TileFace], index: range) -> Iterator[str]:
    yield f"faces {len(faces)}"
    for i, face in enumerate(faces):
        cycle, corners = face["vertices"], face["corners"]
        if len(corners) != 3:
            raise _BadTileError(f"face {i} is said to have {len(corners)} corners")
        yield f"{len(cycle)} {_indices(cycle, index)} corners {_indices(corners, index)}"


def _indices(vertices: Iterable[int], index: range) -> str:
    words = []
    for v in vertices:
        if type(v) is not int:
            raise TypeError(f"not the index of a vertex: {shorten(v)}")
        if v not in index:
            raise _BadTileError(f"there is no vertex {v} among {len(index)}")
        words.append(str(v))
    return " ".join(words)


def _coordinate(value: object) -> str:
    if isinstance(value, str) and _WRITTEN.fullmatch(value):
        return value  # as the protocol wants it
    return _rational_words(_exactly(value))


def _exactly(value: object) -> QQ:
    # A float says that a number was rounded on its way here.
    if isinstance(value, float):
        raise InputError(f"not an exact number: {value!r}")
    return rational(cast("Rational", value))


def _rational_words(value: QQ) -> str:
    return f"{value.numerator}/{value.denominator}"


def _point_words(point: Sequence[Rational]) -> str:
    x, y = point
    return f"{_rational_words(rational(x))} {_rational_words(rational(y))}"


def _polynomial_words(f: Sequence[int]) -> str:
    if f and f[-1] == 0:
        raise InputError("the leading coefficient of a polynomial is zero")
    # ZZ, because Python refuses to write an int of more than 4,300 digits.
    return " ".join(map(str, (len(f), *map(ZZ, f))))


def _root_words(root: RootClaim) -> str:
    low, high = _rational_words(root.low), _rational_words(root.high)
    return f"polynomial {_polynomial_words(root.polynomial)} between {low} {high}"


def _verdict(answer: str) -> Verdict:
    word, _, rest = answer.partition(" ")
    if word != "ok":
        return Verdict(ok=False, reason=rest)
    names, figures = rest.split()[::2], map(int, rest.split()[1::2])
    return Verdict(ok=True, stats=dict(zip(names, figures, strict=True)))


def _claimed(answer: str) -> list[str]:
    word, _, rest = answer.partition(" ")
    if word != "ok":
        raise InputError(f"cgal_check: {rest}")
    return rest.split()


def _signs(answer: str) -> list[int]:
    return [_SIGNS[word] for word in _claimed(answer)]
