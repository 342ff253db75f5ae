"""The program cgal_check: found, started, queried over a pipe, and ended."""

from __future__ import annotations

import contextlib
import os
import shutil
import subprocess
import tempfile
from collections import deque
from collections.abc import Iterable, Iterator, Sequence
from pathlib import Path
from typing import IO, Final, Self, final

from exactpt.cgal.build import PACKAGES
from exactpt.cgal.claims import (
    BodyShape,
    IsolatedRoot,
    PlacedBody,
    Relation,
    RootClaim,
    Signs,
    Tile,
    Verdict,
)
from exactpt.cgal.requests import (
    bodies_request,
    point_words,
    polynomial_words,
    root_words,
    tiling_request,
)
from exactpt.errors import AuditError, InputError
from exactpt.kernel.numbers import QQ, Rational, fraction, rational, shorten

_VARIABLE: Final = "EXACTPT_CGAL_CHECK"
_GREETING: Final = "exactpt-check 1"
_ANSWERS: Final = {"ok", "bad", _GREETING.split(" ")[0]}
_YES_OR_NO: Final = {"yes": True, "no": False}
_SIGNS: Final = {"-": -1, "0": 0, "+": 1, "<": -1, "=": 0, ">": 1}

# Number of requests sent ahead of the replies. A verdict has less than 1,024 bytes, so the
# replies to these fit into an empty pipe (at least 4,096 bytes): the program never blocks on
# writing while the client blocks on writing.
_AHEAD: Final = 3


def find_program() -> Path:
    """Return the cgal_check program: ``$EXACTPT_CGAL_CHECK``, the checkout's build, or on PATH.

    Raises:
        InputError: if there is none; the message has the command that builds it.
    """
    named = os.environ.get(_VARIABLE)
    if named:
        if not os.access(named, os.X_OK) or Path(named).is_dir():
            raise InputError(f"{_VARIABLE} names no program: {shorten(named, 200)}")
        return Path(named)
    built = Path(__file__).parents[2] / "cgal_check" / "build" / "cgal_check"
    if os.access(built, os.X_OK):
        return built
    if on_path := shutil.which("cgal_check"):
        return Path(on_path)
    raise InputError(
        "the program cgal_check is missing; build it: exactpt check --build FOLDER "
        f"(it needs CGAL 5.5 and nlohmann-json 3.11; on Debian: apt-get install {PACKAGES}), "
        f"and let {_VARIABLE} name it"
    )


def recognise(program: Path) -> None:
    """Check that a program is cgal_check: it replies to the greeting of its protocol.

    Raises:
        InputError: if it is another program.
    """
    with CgalCheck(program) as witness:
        witness.orientations([])


def _another(program: Path, message: str) -> InputError:
    return InputError(
        f"{shorten(str(program), 200)} is not cgal_check, "
        f"it does not speak {_GREETING!r}: {message}"
    )


@final
class CgalCheck:
    """A running cgal_check; started by the first request, ended by `close` or ``with``.

    Args:
        program: the path of the program; by default the result of `find_program`.

    Raises:
        InputError: on construction, if the program is missing; on a request, if the program
            refuses it. The next request then starts the program anew.
        AuditError: on a request, if the program itself fails.
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
        """Return True if a tile is a pseudo-triangulation of the free space, exactly.

        Args:
            tile: the ``tile`` dictionary of docs/format.md.
            bodies: the shape of every body of the scene.
            deep: whether to use a second, independent method too (CGAL's arrangements; slower).

        Raises:
            InputError: if the tile lacks a key or has a value of a wrong type.
        """
        return next(self.check_tilings([(tile, bodies)], deep=deep))

    def check_tilings(
        self, tiles: Iterable[tuple[Tile, Iterable[BodyShape]]], *, deep: bool = False
    ) -> Iterator[Verdict]:
        """Return the verdicts of `check_tiling` on many tiles, in order, by sending ahead."""
        word = "tiling deep" if deep else "tiling"
        return self._verdicts(tiling_request(word, tile, bodies) for tile, bodies in tiles)

    def check_triangulation(
        self, tile: Tile, bodies: Iterable[BodyShape], *, deep: bool = False
    ) -> Verdict:
        """Return True if a tile's edges, with its ``fan`` edges, triangulate the free space.

        The faces of the tile are not examined: see `check_tiling`.
        """
        word = "triangulation deep" if deep else "triangulation"
        return next(self._verdicts([tiling_request(word, tile, bodies)]))

    def check_root(self, polynomial: Sequence[int], low: Rational, high: Rational) -> Verdict:
        """Return True if a polynomial has exactly one real root in [low, high].

        The figures are ``roots``, the number of distinct real roots; ``rank``, the position of
        this one among them, counted from 1; and ``multiplicity``.
        """
        claim = IsolatedRoot(polynomial, rational(low), rational(high))
        return _verdict(self._ask(f"root {root_words(claim)} end\n"))

    def compare_roots(self, a: RootClaim, b: RootClaim) -> int:
        """-1, 0 or 1 if a is less than, equal to, or greater than b.

        Raises:
            InputError: if an interval does not isolate a root.
        """
        return _signs(self._ask(f"compare {root_words(a)} {root_words(b)} end\n"))[0]

    def sign_at_root(self, f: Sequence[int], root: RootClaim) -> Signs:
        """Return the signs of f just before, at and just after a root.

        Raises:
            InputError: if the interval does not isolate a root.
        """
        answer = self._ask(f"sign {root_words(root)} of {polynomial_words(f)} end\n")
        return Signs(*_signs(answer))

    def hull(self, points: Iterable[Sequence[Rational]]) -> list[int]:
        """Return the vertices of the convex hull of points, as indices, counter-clockwise.

        The first is the lexicographically smallest point (by x, then y). Of equal points the first
        counts; points in the interior of a hull edge are left out.
        """
        words = [point_words(p) for p in points]
        return [int(i) for i in _claimed(self._ask(f"hull {len(words)} {' '.join(words)} end\n"))]

    def orientations(self, triples: Iterable[Sequence[Sequence[Rational]]]) -> list[int]:
        """Return the orientation of each triple: 1 left turn, 0 collinear, -1 right turn."""
        words = [" ".join(map(point_words, (a, b, c))) for a, b, c in triples]
        return _signs(self._ask(f"orientations {len(words)} {' '.join(words)} end\n"))

    def relate(self, first: PlacedBody, second: PlacedBody) -> Relation:
        """Return what two bodies have in common at one time, and how far apart they are.

        A square of 2 by 2, and a point above it:

            box = Body("box", [(0, 0), (2, 0), (2, 2), (0, 2)])
            ball = Body("ball", [(1, 5)], Translation([], [0, -1]))
            with CgalCheck() as witness:
                for time in (0, 3, 4):
                    print(witness.relate(PlacedBody.of_body(box, time),
                                         PlacedBody.of_body(ball, time)))

            Relation(do_intersect=False, do_overlap=False, squared=Fraction(9, 1))
            Relation(do_intersect=True, do_overlap=False, squared=Fraction(0, 1))
            Relation(do_intersect=True, do_overlap=False, squared=Fraction(0, 1))

        Raises:
            InputError: if the points or the parts do not fit the shape of a body, or a ring is not
                simple. Whether rings of one body cross is not examined.
        """
        answer = _claimed(self._ask(bodies_request("pair", [first, second])))
        said = dict(zip(answer[::2], answer[1::2], strict=True))
        return Relation(
            _YES_OR_NO[said["intersect"]],
            _YES_OR_NO[said["overlap"]],
            fraction(QQ(said["squared"])),
        )

    def check_union(self, bodies: Iterable[PlacedBody], union: PlacedBody) -> Verdict:
        """Return True if the interior of a body is that of the union of some bodies.

        Two interiors are equal if no area is in one of them alone. The figures are the numbers of
        parts and holes that CGAL finds in the union; parts that touch each other in a point may
        count as one.

            first = Body("first", [(0, 0), (2, 0), (2, 2), (0, 2)])
            second = Body("second", [(1, 1), (3, 1), (3, 3), (1, 3)])
            both = exactpt.union([first, second], name="both")
            place = PlacedBody.of_body
            with CgalCheck() as witness:
                print(witness.check_union([place(first, 0), place(second, 0)], place(both, 0)))
                print(witness.check_union([place(first, 0)], place(both, 0)))

            Verdict(ok=True, reason='', stats={'holes': 0, 'parts': 1})
            Verdict(ok=False, reason='an area of 0 is missing, of 3 is too much', stats={})

        Raises:
            InputError: if the points or the parts do not fit the shape of a body.
        """
        return _verdict(self._ask(bodies_request("union", [*bodies, union])))

    def close(self) -> None:
        """End the program. Later requests start it again."""
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
        pending: deque[Verdict | None] = deque()  # None: a reply of the program still to read
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
            if (
                None in pending
            ):  # aborted: discard unread replies so that later callers do not receive them
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
            pass  # the program has ended: `_read` finds its last line, which gives the reason
        except BaseException:
            self._kill()  # the request was sent incompletely
            raise

    def _read(self) -> str:
        stdout = self._running().stdout
        try:
            line = b"" if stdout is None else stdout.readline()
        except BaseException:
            self._kill()  # the next request would get this reply
            raise
        text = line.decode("ascii", "replace").rstrip("\n")
        if line.endswith(b"\n") and text.split(" ")[0] in _ANSWERS:
            return text
        raise self._failure(text)

    def _running(self) -> subprocess.Popen[bytes]:
        if self._process is not None:
            return self._process
        # Messages of failed CGAL assertions go to a file: a pipe that nobody reads could fill
        # up and block the program.
        self._errors = tempfile.TemporaryFile()  # noqa: SIM115 - closed in `close`
        try:
            self._process = subprocess.Popen(
                self.program, stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=self._errors
            )
        except OSError as error:
            self.close()
            program = shorten(str(self.program), 200)
            raise InputError(f"cannot start {program}: {error.strerror}") from None
        try:
            greeting = self._ask(_GREETING + "\n")
        except (AuditError, InputError) as error:
            raise _another(self.program, str(error)) from None
        if not greeting.startswith(f"{_GREETING} cgal "):
            self._kill()
            raise _another(self.program, greeting)
        return self._process

    def _kill(self) -> None:
        if self._process is not None:
            self._process.kill()
        self.close()

    def _failure(self, last_words: str) -> InputError | AuditError:
        process, errors = self._process, self._errors
        code, message = None, ""
        if process is not None and errors is not None:
            if last_words and not last_words.startswith("error"):
                process.kill()  # it uses another protocol and may never end
            code = process.wait()
            errors.seek(0)
            message = errors.read()[-2000:].decode("utf-8", "replace").strip()
        self.close()
        if code == 2:
            return InputError(f"cgal_check refuses the request: {last_words}")
        return AuditError(f"cgal_check ended with {code}: {last_words} {message}".rstrip())


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
