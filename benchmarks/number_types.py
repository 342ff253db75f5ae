"""Questions about moving points, computed with different number types.

The questions are the sign of an orientation just after time 0, its first zero later, and which
of two first zeros is earlier. Rounding types use a closed form, by the same code for every
precision; exactpt computes with its filter and without.
"""

from __future__ import annotations

import math
from abc import ABC, abstractmethod
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager, nullcontext
from typing import TYPE_CHECKING, Any, Final, NamedTuple, TypeAlias, final

import gmpy2

from exactpt import Body, Translation
from exactpt.certificates.certifier import Certifier
from exactpt.certificates.queue import EventQueue, ExactQueue
from exactpt.indices import CertificateId
from exactpt.kernel.numbers import QQ, nearest_float
from exactpt.motion.vertices import Vertices

if TYPE_CHECKING:
    from contextlib import AbstractContextManager

__all__ = ["ARITHMETICS", "END", "EXACT", "Arithmetic", "MovingPoint", "Triple", "hull"]

END: Final = QQ(4)
"""End of the time span, which starts at 0."""

Triple: TypeAlias = tuple[int, int, int]


class MovingPoint(NamedTuple):
    """A point in linear motion, with exact coefficients."""

    x: QQ
    y: QQ
    vx: QQ
    vy: QQ


class Questions(ABC):
    """Questions about moving points, computed with one number type."""

    @abstractmethod
    def sign(self, triple: Triple) -> int:
        """The orientation of three points just after time 0: 1 left, -1 right, 0 collinear."""

    @abstractmethod
    def order(self, p: Triple, q: Triple) -> int:
        """-1, 0 or 1 if p is collinear before, at the same time as, or after q."""


class Arithmetic(NamedTuple):
    """A number type.

    Attributes:
        name: its name in tables.
        load: converts moving points; not timed.
        context: context manager in which to convert and compute.
    """

    name: str
    load: Callable[[Sequence[MovingPoint]], Questions]
    context: Callable[[], AbstractContextManager[object]]


@final
class _Rounded(Questions):
    """Closed forms in a number type that rounds; inputs are rounded first."""

    def __init__(
        self,
        points: Sequence[MovingPoint],
        number: Callable[[QQ], Any],
        root: Callable[[Any], Any],
    ) -> None:
        self._points = [tuple(number(c) for c in point) for point in points]
        self._root = root
        self._end = number(END)

    def _orientation(self, triple: Triple) -> tuple[Any, Any, Any]:
        (ax, ay, avx, avy), (bx, by, bvx, bvy), (cx, cy, cvx, cvy) = (
            self._points[i] for i in triple
        )
        ux, uy, vx, vy = bx - ax, by - ay, cx - ax, cy - ay
        dux, duy, dvx, dvy = bvx - avx, bvy - avy, cvx - avx, cvy - avy
        return (
            ux * vy - uy * vx,
            ux * dvy + dux * vy - uy * dvx - duy * vx,
            dux * dvy - duy * dvx,
        )

    def sign(self, triple: Triple) -> int:
        for c in self._orientation(triple):
            if c != 0:
                return 1 if c > 0 else -1
        return 0

    def _first_root(self, triple: Triple) -> Any:  # noqa: ANN401 - a number of any kind
        c0, c1, c2 = self._orientation(triple)
        square = c1 * c1 - 4 * c0 * c2
        if square < 0:
            return None
        root = self._root(square)
        q = -(c1 + root) / 2 if c1 >= 0 else -(c1 - root) / 2
        roots = [c0 / q if q != 0 else None, q / c2 if c2 != 0 else None]
        return min((t for t in roots if t is not None and 0 < t <= self._end), default=None)

    def order(self, p: Triple, q: Triple) -> int:
        s, t = self._first_root(p), self._first_root(q)
        if s is None or t is None:
            return (s is None) - (t is None)
        return int(s > t) - int(s < t)


@final
class _Certified(Questions):
    """The certificates and event times of exactpt."""

    def __init__(self, points: Sequence[MovingPoint], *, exact_only: bool) -> None:
        bodies = [
            Body(f"p{i}", [(p.x, p.y)], Translation([0, p.vx], [0, p.vy]))
            for i, p in enumerate(points)
        ]
        vertices = Vertices.of(bodies, QQ(0), END)
        self._ids = [moving.ring[0] for moving in vertices.bodies]
        self._certifier = Certifier(vertices, QQ(0), END, exact_only=exact_only)
        self._queue = ExactQueue if exact_only else EventQueue

    def sign(self, triple: Triple) -> int:
        a, b, c = (self._ids[i] for i in triple)
        return self._certifier.orientation(a, b, c)[0]

    def order(self, p: Triple, q: Triple) -> int:
        queue = self._queue(self._certifier, self._certifier.counters)
        for slot, triple in enumerate((p, q)):
            a, b, c = (self._ids[i] for i in triple)
            time = self._certifier.orientation(a, b, c)[1]
            if time is not None:
                queue.schedule(CertificateId(slot), time)
        popped = queue.pop()
        slots = [] if popped is None else [slot for slot, _ in popped[1]]
        return 0 if len(slots) != 1 else -1 if slots[0] == 0 else 1


def _mpfr(bits: int) -> Arithmetic:
    """Binary floating point of a given precision, correctly rounded."""

    @contextmanager
    def precision() -> Iterator[None]:
        with gmpy2.context(gmpy2.get_context(), precision=bits):
            yield

    return Arithmetic(
        f"mpfr {bits}", lambda points: _Rounded(points, gmpy2.mpfr, gmpy2.sqrt), precision
    )


EXACT: Final = Arithmetic("exact", lambda points: _Certified(points, exact_only=True), nullcontext)

ARITHMETICS: Final = (
    Arithmetic("float64", lambda points: _Rounded(points, nearest_float, math.sqrt), nullcontext),
    *(_mpfr(bits) for bits in (64, 128, 256, 512, 1024)),
    Arithmetic("float64, filter", lambda points: _Certified(points, exact_only=False), nullcontext),
    EXACT,
)
"""All number types, from the weakest guarantee to the strongest."""


def hull(questions: Questions, order: Sequence[int]) -> tuple[int, ...]:
    """The convex hull just after time 0 of points that are given from left to right."""
    chains: list[int] = []
    for sequence in (order, order[::-1]):
        chain: list[int] = []
        for p in sequence:
            while len(chain) > 1 and questions.sign((chain[-2], chain[-1], p)) <= 0:
                chain.pop()
            chain.append(p)
        chains += chain[:-1]
    return tuple(chains)
