"""Symmetric variants of a scene, whose contacts follow from those of the scene.

Each variant maps a scene to another one, and its contact to the other's contact: space by a
similarity, time by t' = a t + b, bodies and vertices by new names and numbers.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from fractions import Fraction
from typing import Final, TypeAlias

from exactpt import (
    Affine,
    AlgebraicNumber,
    Body,
    Contact,
    ContactPoint,
    Pieces,
    Polynomial,
    Rigid,
    Scene,
    Spin,
    Translation,
)
from exactpt.kernel.numbers import QQ, ZZ, power_of_two
from exactpt.kernel.square_root import exact_square_root
from exactpt.motion.motions import Position, SimpleMotion, formulas_of
from fuzz.rings import parts_of

__all__ = ["VARIANTS", "Variant", "difference", "expected_time"]

Vector: TypeAlias = tuple[QQ, QQ]
Matrix: TypeAlias = tuple[Vector, Vector]

_IDENTITY: Final[Matrix] = ((QQ(1), QQ(0)), (QQ(0), QQ(1)))
_NOWHERE: Final[Vector] = (QQ(0), QQ(0))
_ONE: Final = QQ(1)
_ZERO: Final = QQ(0)


@dataclass(frozen=True, slots=True)
class Variant:
    """A map of scenes.

    Attributes:
        matrix, shift: p' = matrix p + shift; the matrix is a multiple of a rotation or reflection.
        rate, delay: t' = rate t + delay.
        drift: a velocity added to all bodies.
        cut: whether every motion is cut into two identical pieces, for each body a little later
            than for the previous one: within one double.
        renumber: "turned" or "reversed": new first vertex, or reversed order of vertices.
        reorder: whether bodies are reordered and renamed.
    """

    matrix: Matrix = _IDENTITY
    shift: Vector = _NOWHERE
    rate: QQ = _ONE
    delay: QQ = _ZERO
    drift: Vector = _NOWHERE
    cut: bool = False
    renumber: str = "none"
    reorder: bool = False

    def scene(self, scene: Scene) -> Scene:
        """The image of a scene."""
        middle, moment = (scene.start + scene.end) / 2, (scene.end - scene.start) / 10**30
        bodies = [
            self._body(body, scene.time, middle + i * moment) for i, body in enumerate(scene.bodies)
        ]
        if self.reorder:
            bodies.reverse()
        span = sorted(self.rate * t + self.delay for t in (scene.start, scene.end))
        groups = [[self.name(text) for text in group] for group in scene.ignoring]
        return Scene(bodies, span, ignoring=groups)

    def name(self, name: str) -> str:
        """The new name of a body."""
        return f"~{name}" if self.reorder else name

    def vertex(self, body: Body, i: int) -> int:
        """The new number of a vertex."""
        ring = next(ring for ring in body.rings if i in ring)
        n, k = len(ring), i - ring.start
        if self.renumber == "turned" and body.closed and n > 2:
            return ring[(k - n // 2) % n]
        return ring[n - 1 - k] if self.renumber == "reversed" else i

    def edge(self, body: Body, i: int) -> int:
        """The new number of an edge."""
        u, v = self.vertex(body, i), self.vertex(body, body.end_of_edge(i))
        return v if self.renumber == "reversed" else u

    def place(self, point: tuple[float, float], time: float) -> tuple[float, float]:
        """The approximate image of a point of the scene at a time of the scene."""
        x, y = (c + float(d) * time for c, d in zip(point, self.drift, strict=True))
        (a, b), (c, d) = ((float(p), float(q)) for p, q in self.matrix)
        return a * x + b * y + float(self.shift[0]), c * x + d * y + float(self.shift[1])

    def _body(self, body: Body, span: tuple[Fraction, Fraction], middle: QQ) -> Body:
        order = sorted(range(body.size), key=lambda i: self.vertex(body, i))
        motion = body.motion
        if isinstance(motion, Spin):
            motion = motion.pieces_during(*span)
        if isinstance(motion, Pieces):
            ends = [*motion.until, None]
            parts = [(t, self._motion(m)) for t, m in zip(ends, motion.motions, strict=True)]
            motion = Pieces(parts)
        else:
            motion = self._motion(formulas_of(motion)[0])
        if isinstance(motion, Pieces):
            motion = self._pieces(motion)
        elif self.cut:
            motion = Pieces([(self.rate * middle + self.delay, motion), (None, motion)])
        if body.keyframes:
            frames = [
                (self.rate * f.t + self.delay, [self._point(f.vertices[i]) for i in order])
                for f in body.keyframes
            ]
            frames.sort(key=lambda frame: frame[0])
            return Body(
                self.name(body.name), None, motion, closed=body.closed, keyframes=frames,
                radius=self._length(body.radius),
            )  # fmt: skip
        vertices = [self._position(body.vertices[i]) for i in order]
        name, radius = self.name(body.name), self._length(body.radius)
        if body.has_rings:
            return Body(name, motion=motion, parts=parts_of(body, vertices), radius=radius)
        return Body(name, vertices, motion, closed=body.closed, radius=radius)

    def _length(self, length: QQ) -> QQ:
        (a, _), (c, _) = self.matrix
        factor = exact_square_root(a * a + c * c)
        if factor is None:
            raise ValueError(f"an irrational similarity: {self.matrix}")
        return factor * length

    def _pieces(self, pieces: Pieces) -> Pieces:
        ends = [self.rate * t + self.delay for t in pieces.until]
        motions = list(pieces.motions)
        if self.rate < 0:
            ends, motions = ends[::-1], motions[::-1]
        return Pieces(list(zip([*ends, None], motions, strict=True)))

    def _point(self, point: Vector) -> Vector:
        x, y = _apply(self.matrix, point)
        return x + self.shift[0], y + self.shift[1]

    def _position(self, position: Position) -> Position:
        """The image of a position; one that depends on time moves with it."""
        x, y = self._direction((self._then(position[0]), self._then(position[1])))
        return x + Polynomial([self.shift[0]]), y + Polynomial([self.shift[1]])

    def _direction(self, v: Position) -> Position:
        (a, b), (c, d) = self.matrix
        return _times(a, v[0]) + _times(b, v[1]), _times(c, v[0]) + _times(d, v[1])

    def _then(self, f: Polynomial) -> Polynomial:
        """The function of t' that equals f at t = (t' - delay) / rate."""
        return _compose(f, Polynomial([-self.delay / self.rate, 1 / self.rate]))

    def _motion(self, motion: SimpleMotion) -> SimpleMotion:
        """The image of a motion g: p -> S(g(S^-1(p))), S the map of space."""
        if not isinstance(motion, (Translation, Rigid, Affine)):
            raise TypeError(f"no variant of {motion!r}")
        drifting = (
            motion.x + Polynomial([0, self.drift[0]]),
            motion.y + Polynomial([0, self.drift[1]]),
        )
        x, y = self._direction((self._then(drifting[0]), self._then(drifting[1])))
        if isinstance(motion, Translation):
            return Translation(x, y)
        if isinstance(motion, Rigid):
            (a, b), (c, d) = self.matrix
            turn = self._then(motion.half_turn)
            mirrored = a * d - b * c < 0
            pivot = self._point(motion.pivot)
            cosine, sine = motion.orientation
            if mirrored:
                turn, sine = -turn, -sine
            return Rigid(turn, pivot=pivot, x=x, y=y, orientation=(cosine, sine))
        return self._affine(motion, (x, y))

    def _affine(self, motion: Affine, offset: Position) -> Affine:
        """With M' = A M A^-1, s the shift: A (M A^-1 (p - s) + v) + s = M' p + A v + s - M' s."""
        (a, b), (c, d) = self.matrix
        det = a * d - b * c
        inverse = ((d / det, -b / det), (-c / det, a / det))
        then = tuple(tuple(self._then(f) for f in row) for row in motion.matrix)
        columns = [
            self._direction((_row(then[0], inverse, j), _row(then[1], inverse, j))) for j in (0, 1)
        ]
        matrix = [[columns[j][i] for j in (0, 1)] for i in (0, 1)]
        s, t = self.shift
        moved = [_times(s, row[0]) + _times(t, row[1]) for row in matrix]
        return Affine(
            matrix,
            x=offset[0] + Polynomial([s]) - moved[0],
            y=offset[1] + Polynomial([t]) - moved[1],
        )


def _apply(matrix: Matrix, v: Vector) -> Vector:
    (a, b), (c, d) = matrix
    return a * v[0] + b * v[1], c * v[0] + d * v[1]


def _times(c: QQ, f: Polynomial) -> Polynomial:
    return Polynomial([c]) * f


def _row(row: Sequence[Polynomial], matrix: Matrix, column: int) -> Polynomial:
    return _times(matrix[0][column], row[0]) + _times(matrix[1][column], row[1])


def _compose(f: Polynomial, g: Polynomial) -> Polynomial:
    value = Polynomial()
    for c in reversed(f.coefficients):
        value = value * g + Polynomial([c])
    return value


def _scaled(exponent: int) -> Matrix:
    factor = power_of_two(exponent)
    return (factor, QQ(0)), (QQ(0), factor)


_MIRROR: Final[Matrix] = ((QQ(-1), QQ(0)), (QQ(0), QQ(1)))

VARIANTS: Final[Mapping[str, Variant]] = {
    "shifted": Variant(shift=(QQ(22, 7), QQ(-10, 3))),
    "far": Variant(shift=(power_of_two(60), -power_of_two(60))),
    "scaled": Variant(matrix=((QQ(7, 3), QQ(0)), (QQ(0), QQ(7, 3)))),
    "huge": Variant(matrix=_scaled(500)),
    "tiny": Variant(matrix=_scaled(-500)),
    "mirrored": Variant(matrix=_MIRROR),
    "swapped": Variant(matrix=((QQ(0), QQ(1)), (QQ(1), QQ(0)))),
    "half turn": Variant(matrix=((QQ(-1), QQ(0)), (QQ(0), QQ(-1)))),
    "quarter turn": Variant(matrix=((QQ(0), QQ(-1)), (QQ(1), QQ(0)))),
    "turned": Variant(matrix=((QQ(3, 5), QQ(-4, 5)), (QQ(4, 5), QQ(3, 5)))),
    "turned a little": Variant(
        matrix=((QQ(9999, 10001), QQ(-200, 10001)), (QQ(200, 10001), QQ(9999, 10001)))
    ),
    "later": Variant(delay=QQ(355, 113)),
    "slower": Variant(rate=QQ(7, 2), delay=QQ(-1)),
    "within an instant": Variant(rate=power_of_two(-1060)),
    "for ages": Variant(rate=power_of_two(1060)),
    "drifting": Variant(drift=(QQ(17), QQ(-5, 3))),
    "cut": Variant(cut=True),
    "reordered": Variant(reorder=True),
    "rings turned": Variant(renumber="turned"),
    "rings reversed": Variant(renumber="reversed"),
    "all at once": Variant(
        matrix=((QQ(-5, 13), QQ(12, 13)), (QQ(12, 13), QQ(5, 13))),
        shift=(QQ(1, 3), QQ(5)),
        rate=QQ(1, 3),
        renumber="reversed",
        reorder=True,
    ),
    "awkward": Variant(
        matrix=((QQ(15, 34), QQ(4, 17)), (QQ(4, 17), QQ(-15, 34))),
        shift=(QQ(10, 3), QQ(-29, 7)),
        rate=QQ(9, 13),
        delay=QQ(1, 9),
        drift=(QQ(-2, 13), QQ(1, 3)),
        renumber="turned",
    ),
    "backwards": Variant(rate=QQ(-1)),
}
"""The variants by name. "backwards" preserves only that there is no contact."""


def expected_time(variant: Variant, time: AlgebraicNumber) -> AlgebraicNumber:
    """The image of a time."""
    if variant.rate == 1 and variant.delay == 0:
        return time
    low, high = sorted(variant.rate * t + variant.delay for t in (time.low, time.high))
    if low == high:
        return AlgebraicNumber(low)
    inverse = Polynomial([-variant.delay / variant.rate, 1 / variant.rate])
    f = _compose(Polynomial(time.polynomial), inverse)
    denominator = math.lcm(*(int(c.denominator) for c in f.coefficients))
    return AlgebraicNumber.root(
        tuple(ZZ((c * denominator).numerator) for c in f.coefficients), low, high
    )


def difference(
    variant: Variant, scene: Scene, contact: Contact | None, image: Contact | None
) -> str | None:
    """The error in the contact found in the image of a scene, in words; None if there is none."""
    if contact is None or image is None:
        if (contact is None) == (image is None):
            return None
        return "found" if contact is None else "missed"
    if expected_time(variant, contact.time).compare(image.time) != 0:
        return "time"
    if contact.kind != image.kind:
        return "kind"
    initial_pairs = {
        frozenset(variant.name(name) for name in names) for names in contact.initial_pairs
    }
    if initial_pairs != {frozenset(names) for names in image.initial_pairs}:
        return "initial_pairs"
    bodies = {body.name: body for body in scene.bodies}
    time = float(contact.time)
    expected = {_features(_image(variant, bodies, pair, time)) for pair in contact.pairs}
    if expected != {_features(pair) for pair in image.pairs}:
        return "pairs"
    points = {_features(pair): pair.point for pair in image.pairs}
    for pair in contact.pairs:
        mapped = _image(variant, bodies, pair, time)
        if not _near(mapped.point, points[_features(mapped)], variant.place((0.0, 0.0), time)):
            return "point"
    return None


def _image(
    variant: Variant, bodies: Mapping[str, Body], pair: ContactPoint, time: float
) -> ContactPoint:
    body, other = bodies[pair.body], bodies[pair.other]
    return replace(
        pair,
        body=variant.name(pair.body),
        vertex=variant.vertex(body, pair.vertex),
        other=variant.name(pair.other),
        edge=None if pair.edge is None else variant.edge(other, pair.edge),
        other_vertex=(
            None if pair.other_vertex is None else variant.vertex(other, pair.other_vertex)
        ),
        point=variant.place(pair.point, time),
    )


def _features(pair: ContactPoint) -> frozenset[tuple[str, str, int | None]]:
    vertex = ("vertex", pair.body, pair.vertex)
    if pair.edge is None:
        return frozenset({vertex, ("vertex", pair.other, pair.other_vertex)})
    return frozenset({vertex, ("edge", pair.other, pair.edge)})


def _near(p: tuple[float, float], q: tuple[float, float], origin: tuple[float, float]) -> bool:
    size = max(map(abs, (*p, *q, *origin)))
    return all(abs(a - b) <= 1e-9 * size for a, b in zip(p, q, strict=True))
