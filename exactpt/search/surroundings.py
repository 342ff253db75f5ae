"""The distance of two bodies, or of one body from all others, as a function of time."""

from __future__ import annotations

import math
from typing import Final, NamedTuple, final, overload

from exactpt.brief import counted, record_in_brief
from exactpt.cached_property import cached_property
from exactpt.errors import InputError
from exactpt.filters.boxes import Drift, during
from exactpt.filters.rounding import U8
from exactpt.filters.rows import Box
from exactpt.kernel.algebraic import AlgebraicNumber
from exactpt.kernel.budget import check_budget
from exactpt.kernel.numbers import QQ, Rational, nearest_float, power_of_two, shorten
from exactpt.kernel.square_root import root_above
from exactpt.pair.distance import Distance, distance, time_in_span
from exactpt.scene.groups import names_of
from exactpt.scene.scene import Scene, a_scene
from exactpt.search.candidate_pairs import candidate_pairs
from exactpt.search.clearance import (
    Clearance,
    CloseInterval,
    Minimum,
    a_distance,
    clearance_of_two,
)
from exactpt.search.query import Selection
from exactpt.search.reading import rows_of_scene
from exactpt.search.within import time_within_of_two as time_within

FEW: Final = 4
"""Number of other bodies that are compared without a look at boxes."""


class NearestApproach(NamedTuple):
    """The least distance of a body from all others; ``float`` gives the nearest double.

    Attributes:
        body: the name of the other body; of several that of the earliest time, of these the
            first in the order of the scene.
        time: the first time of the least distance.
        squared: the square of the least distance, exactly.
    """

    body: str
    time: AlgebraicNumber
    squared: AlgebraicNumber

    def __repr__(self) -> str:
        return record_in_brief(self)

    @property
    def distance(self) -> AlgebraicNumber:
        """The least distance, exactly."""
        return Minimum(self.time, self.squared).distance

    def __float__(self) -> float:
        return float(self.distance)


@final
class Surroundings:
    """The distance of a body from all others that count with it, over the time span of a scene.

    The functions of time of the single bodies are computed when they are needed: for
    `minimum` and `below`, of those alone whose boxes come near enough.

    Args:
        scene: the bodies and the time span.
        name: the name of the body.

    Attributes:
        name: the name of the body.
        others: the names of all other bodies, in the order of the scene; without those that the
            scene lets this body ignore.

    Raises:
        InputError: if the body does not exist, is the only one, or ignores all others.
    """

    def __init__(self, scene: Scene, name: str) -> None:
        scene.body(name)
        self._scene = scene
        self.name = name
        names = names_of(scene.bodies)
        if len(names) < 2:
            raise InputError(f"clearance: there is no body but {shorten(name)}")
        selection, own = Selection(scene), names.index(name)
        self.others = tuple(
            other for i, other in enumerate(names) if i != own and selection.counts(own, i)
        )
        if not self.others:
            raise InputError(f"clearance: body {shorten(name)} ignores all others in this scene")
        self._found: dict[str, Clearance] = {}

    def __repr__(self) -> str:
        others = counted(len(self.others), "other body")
        return f"<Surroundings of {shorten(self.name, 30)}: {others}>"

    def to(self, other: str) -> Clearance:
        """Return the distance from one other body as a function of time.

        Raises:
            InputError: if the other body does not exist, or is the same.
        """
        if other not in self._found:
            self._found[other] = clearance_of_two(self._scene, self.name, other)
        return self._found[other]

    def nearest(self, at: Rational) -> tuple[str, Distance]:
        """Return the nearest body at a rational time, and the distance from it.

        Of several nearest bodies it is the first in the order of the scene.

        Raises:
            InputError: if the time is outside of the time span.
        """
        t = time_in_span(self._scene, at)
        gaps = self._gaps(t)
        found: dict[int, Distance] = {}
        bound = math.inf
        for k in sorted(range(len(gaps)), key=gaps.__getitem__):
            if gaps[k] > bound:
                break
            found[k] = there = distance(self._scene, self.name, self.others[k], at)
            bound = min(bound, math.nextafter(float(there), math.inf))
        nearest = min(sorted(found), key=found.__getitem__)
        return self.others[nearest], found[nearest]

    def __call__(self, at: Rational) -> float:
        """Return the double nearest to the distance from the nearest body at a rational time."""
        return float(self.nearest(at)[1])

    def below(self, distance: Rational) -> tuple[CloseInterval, ...]:
        """Return the maximal closed intervals in which another body is within a distance.

        Ordered by their starts, then by the order of the bodies in the scene. Each has the nearest
        features in its pieces.

        Raises:
            InputError: if the distance is negative.
        """
        given = a_distance(distance)
        found = [
            interval
            for other in self._near(given)
            if self._first_within(other, given) is not None
            for interval in self.to(other).below(distance)
        ]
        return tuple(sorted(found, key=lambda interval: interval.start))

    @cached_property
    def minimum(self) -> NearestApproach:
        """The least distance from any other body in the time span."""
        _, at_start = self.nearest(self._scene.exact_start)
        bound = max(root_above(QQ(at_start.core_squared)) - QQ(at_start.radius), QQ(0))
        best: NearestApproach | None = None
        for other in self._near(bound):
            check_budget()
            if self._first_within(other, bound) is None:
                continue
            touch = self._first_within(other, QQ(0))
            least = self.to(other).minimum if touch is None else Minimum(touch, AlgebraicNumber(0))
            if best is None or (least.squared, least.time) < (best.squared, best.time):
                best = NearestApproach(other, *least)
                bound = min(bound, root_above(best.squared.exact_high))
        assert best is not None  # noqa: S101 - the body that is nearest at the start is one
        return best

    def _first_within(self, other: str, d: QQ) -> AlgebraicNumber | None:
        """Return the first time at which another body is within a distance."""
        scene, first = self._scene, self._scene.body(self.name)
        return time_within(first, scene.body(other), scene.exact_start, scene.exact_end, d * d)

    def _gaps(self, t: QQ) -> list[float]:
        """Return lower bounds of the distances of the others at a time: those of their boxes.

        The sides of a box are rounded outward. A gap is the length of two differences of them:
        these are off by U of themselves, ``hypot`` by less than 2 U, and the product by U.
        """
        if len(self.others) <= FEW:
            return [0.0] * len(self.others)
        rows = rows_of_scene(self._scene)
        active, sides = during(rows.table, *rows.units.time(t), Drift())
        names = names_of(self._scene.bodies)
        boxes: dict[str, list[Box]] = {name: [] for name in names}
        for row, left, right, bottom, top in zip(
            active, sides[0::4], sides[1::4], sides[2::4], sides[3::4], strict=True
        ):
            boxes[names[rows.table.body[row]]].append((left, right, bottom, top))
        own, unit = boxes[self.name], power_of_two(rows.units.scale[0])
        gaps = [
            min((_gap(box, two) for box in own for two in boxes[other]), default=0.0)
            for other in self.others
        ]
        return gaps if rows.units.is_identity else [nearest_float(QQ(gap) * unit) for gap in gaps]

    def _near(self, reach: QQ) -> list[str]:
        """Return the names of those of the others that may come within a distance."""
        bodies, others = self._scene.bodies, frozenset(self.others)
        pairs = candidate_pairs(self._scene, reach)
        names = [(bodies[i].name, bodies[j].name) for i, j in pairs]
        near = [b if a == self.name else a for a, b in names if self.name in (a, b)]
        return [name for name in near if name in others]


def _gap(one: Box, two: Box) -> float:
    """Return a lower bound of the distance of two boxes."""
    left, right, bottom, top = one
    low_x, high_x, low_y, high_y = two
    x, y = max(0.0, low_x - right, left - high_x), max(0.0, low_y - top, bottom - high_y)
    return math.hypot(x, y) * (1.0 - U8)


@overload
def clearance(scene: Scene, a: str, b: str) -> Clearance: ...


@overload
def clearance(scene: Scene, a: str) -> Surroundings: ...


def clearance(scene: Scene, a: str, b: str | None = None) -> Clearance | Surroundings:
    """Return the Euclidean distance of two bodies, or of one from all others, over a time span.

    >>> from exactpt import Body, Scene, Translation
    >>> ball = Body("ball", [(-9, 3)], Translation([0, 1]))
    >>> box = Body("box", [(0, 0), (2, 0), (2, 2), (0, 2)])
    >>> scene = Scene([ball, box, Body("far", [(0, 99)])], time=(0, 20))
    >>> gap = clearance(scene, "ball", "box")
    >>> gap.squared(0), gap(10), gap.minimum.time, float(gap.minimum)
    (Fraction(82, 1), 1.0, AlgebraicNumber('9'), 1.0)
    >>> around = clearance(scene, "ball")
    >>> around.minimum.body, around(10), around.nearest(0)[0]
    ('box', 1.0, 'box')
    >>> [(i.b, float(i.start), float(i.end)) for i in around.below(1)]
    [('box', 9.0, 11.0)]

    A `Spin` or a `PosePath` counts as its pieces: docs/howto/motions.md has the bounds for the
    true motion.

    Args:
        scene: the bodies and the time span.
        a: the name of a body.
        b: the name of another body; if it is not given, all others.

    Raises:
        InputError: if a body does not exist, both are the same, or they ignore each other; or one
            body ignores all others.
    """
    a_scene(scene)
    return Surroundings(scene, a) if b is None else clearance_of_two(scene, a, b)
