"""Families of questions: fourteen degenerate ones and four generic ones.

Each puts a body that moves next to one at rest. `make_question` then disguises them: a symmetry of
the square, a common velocity, another place, another start, and the bodies swapped. All
numbers are multiples of small powers of two, so the doubles are meant exactly.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from random import Random
from typing import Final, NamedTuple, TypeAlias

from exactpt.brief import record_in_brief
from exactpt.errors import InputError
from exactpt.kernel.numbers import QQ, power_of_two, shorten
from exactpt.testing.questions import Moving, Question
from exactpt.testing.scenes.shapes import box, convex_polygon, hull

Number: TypeAlias = "QQ | int"
Outline: TypeAlias = "Sequence[tuple[Number, Number]]"


class Pass(NamedTuple):
    """A body on its way past another, which rests.

    Attributes:
        moving, still: the outlines.
        x, y: the coefficients of t, t^2, ... of the translation.
        span: the length of the time span.
        closed: whether both bodies are.
        far: the distance from the origin at which they are.
    """

    moving: Outline
    still: Outline
    x: Sequence[Number]
    y: Sequence[Number]
    span: Number
    closed: tuple[bool, bool] = (True, True)
    far: Number = 0

    def __repr__(self) -> str:
        return record_in_brief(self)


Family: TypeAlias = Callable[[Random], Pass]


def corner_to_corner(rng: Random) -> Pass:
    """Two corners that run into each other."""
    gap, speed = rng.randint(1, 6), _one_of(rng, 1, 2, QQ(1, 2))
    tip = _moved(_tipped(rng), -gap, 0)
    other = [(-x, y) for x, y in _tipped(rng)]
    return Pass(tip, other, [speed], [], rng.choice([8, 16]))


def edge_to_edge(rng: Random) -> Pass:
    """Two parallel edges that meet flat."""  # printed into the published set
    gap, shift = rng.randint(1, 6), rng.randint(-2, 2)
    moving = _moved(box(-2, 0, 2, rng.randint(1, 3)), -gap, shift)
    aside = _one_of(rng, 0, 0, QQ(1, 4))
    return Pass(moving, box(0, -2, rng.randint(1, 2), 4), [rng.choice([1, 2])], [aside], 8)


def grazing_corner(rng: Random) -> Pass:
    """A corner that passes below a corner or an edge, and touches it."""
    top = [(y, x) for x, y in _tipped(rng)]
    bottom = [(y, -x) for x, y in _tipped(rng)] if rng.random() < 0.5 else box(-1, 0, 2, 2)
    return Pass(_moved(top, -rng.randint(3, 8), 0), bottom, [rng.choice([1, 2])], [], 16)


def sliding(rng: Random) -> Pass:
    """A box that slides along a line, on which an edge of the other body lies.

    In three of ten questions both are segments.
    """
    left = rng.randint(3, 6)
    table = box(0, -2, rng.randint(1, 4), 2)
    moving = box(-left, 0, rng.randint(1, 2), rng.randint(1, 2))
    if rng.random() < 0.3:
        moving, table = moving[:2], table[2:]
    return Pass(moving, table, [rng.choice([1, 2])], [], 8)


def ties(rng: Random) -> Pass:
    """A fork whose teeth touch all at one time."""
    teeth, height = rng.randint(2, 3), rng.randint(1, 4)
    tips = [p for i in range(teeth) for p in ((2 * i, height), (2 * i + 1, height + 2))][:-1]
    fork = [*tips, (2 * teeth - 2, height + 3), (0, height + 3)]
    return Pass(fork, box(-1, -1, 2 * teeth, 1), [_one_of(rng, 0, 0, QQ(1, 8))], [-1], 8)


def touching_at_start(rng: Random) -> Pass:
    """Bodies that touch at the start, and then part, slide or go on."""
    other = [(-x, y) for x, y in _tipped(rng)] if rng.random() < 0.5 else box(0, -2, 2, 4)
    return Pass(_tipped(rng), other, [rng.choice([-1, -1, 0, 1])], [rng.choice([0, 1])], 4)


def overlapping_at_start(rng: Random) -> Pass:
    """Bodies that overlap at the start, or one inside the other."""
    if rng.random() < 0.5:
        inner = _moved(box(0, 0, 1, 1), rng.randint(1, 2), rng.randint(1, 2))
        return Pass(inner, box(0, 0, 4, 4), [rng.choice([0, 1])], [rng.randint(-1, 1)], 4)
    return Pass(_star(rng), _star(rng), [rng.choice([0, 1])], [], 4)


def last_moment(rng: Random) -> Pass:
    """A first contact at the end of the time span, or just after it."""
    gap, speed = rng.randint(1, 6), rng.choice([1, 2, 4])
    late = _one_of(rng, QQ(0), QQ(0), power_of_two(-10))
    moving = _moved(_tipped(rng), -gap, 0)
    return Pass(moving, box(0, -3, 2, 6), [speed], [], QQ(gap, speed) - late)


def far_away(rng: Random) -> Pass:
    """Convex polygons far from the origin."""
    return _aimed(rng, _convex(rng), _convex(rng))._replace(far=power_of_two(rng.randint(20, 44)))


def hairs_breadth(rng: Random) -> Pass:
    """A corner that passes a corner or an edge, missing or hitting it by very little."""
    shown = grazing_corner(rng)
    hair = rng.choice([-1, -1, 1]) * power_of_two(-rng.choice([10, 20, 30, 40]))
    return shown._replace(moving=_moved(shown.moving, 0, hair))


def bullet(rng: Random) -> Pass:
    """A small fast body and a thin wall."""
    height, thick = rng.randint(-4, 4), power_of_two(-rng.choice([4, 10]))
    shot = _moved(_small(rng), -100, height)
    wall = [(x * thick, y) for x, y in box(0, -3, 1, 6)]
    return Pass(shot, wall, [rng.choice([200, 1024])], [rng.choice([0, 8])], 1)


def together(rng: Random) -> Pass:
    """Bodies at rest to each other: apart, or in touch from the start."""
    gap = _one_of(rng, 0, 0, 1, power_of_two(-20))
    return Pass(_moved(_tipped(rng), -gap, 0), box(0, -2, 2, 4), [], [], 4)


def apex(rng: Random) -> Pass:
    """A body thrown up at a ceiling, which it touches at its highest point, or nearly."""
    k = rng.randint(1, 3)
    gap = _one_of(rng, QQ(0), QQ(0), power_of_two(-10), power_of_two(-30), -power_of_two(-10))
    thrown = [(y, x) for x, y in _tipped(rng)]
    drift = _one_of(rng, 0, 0, 1, QQ(-1, 2))
    return Pass(thrown, _moved(box(-6, 0, 12, 1), 0, k * k + gap), [drift], [2 * k, -1], 2 * k)


def turning_back(rng: Random) -> Pass:
    """A body that retires first and returns, or falls through a height that it has left before."""
    back, gap = rng.randint(1, 3), rng.choice([1, 2, 3, 6])
    moving = _moved(_tipped(rng) if rng.random() < 0.5 else _convex(rng), -gap - 3, 0)
    return Pass(moving, box(0, -3, 2, 6), [-2 * back, 1], [_one_of(rng, 0, 0, QQ(1, 4))], 16)


def convex_pairs(rng: Random) -> Pass:
    """Convex polygons that are aimed at each other."""
    return _aimed(rng, _convex(rng), _convex(rng))


def star_pairs(rng: Random) -> Pass:
    """Simple polygons, most of them not convex, that are aimed at each other."""
    return _aimed(rng, _star(rng), _star(rng))


def thrown_pairs(rng: Random) -> Pass:
    """Convex polygons, one of which flies along a parabola."""
    way = _aimed(rng, _convex(rng), _convex(rng))
    bend = QQ(rng.randint(-4, 4), 8)
    return way._replace(y=[*way.y[:1], bend])


def sticks_and_points(rng: Random) -> Pass:
    """Points, segments and open chains."""
    outlines = [[(rng.randint(-3, 3), rng.randint(-3, 3))] for _ in range(2)]
    closed = []
    for outline in outlines:
        size = rng.choice([1, 2, 2, 3, 4])
        while len(outline) < size:  # each edge goes to the right: the chain is simple
            x = outline[-1][0] + rng.randint(1, 2)
            outline.append((x, rng.randint(-3, 3)))
        closed.append(len(outline) < 3)
    return _aimed(rng, outlines[0], outlines[1])._replace(closed=(closed[0], closed[1]))


DEGENERATE: Final[dict[str, Family]] = {
    f.__name__: f
    for f in (
        corner_to_corner, edge_to_edge, grazing_corner, sliding, ties, touching_at_start,
        overlapping_at_start, last_moment, far_away, hairs_breadth, bullet, together, apex,
        turning_back,
    )
}  # fmt: skip
"""Families whose questions are nearly or fully degenerate."""

GENERIC: Final[dict[str, Family]] = {
    f.__name__: f for f in (convex_pairs, star_pairs, thrown_pairs, sticks_and_points)
}
"""Families of random bodies that are aimed at each other."""

FAMILIES: Final[dict[str, Family]] = {**DEGENERATE, **GENERIC}
"""All families of questions; each makes a pass from a random generator."""

LINEAR: Final = tuple(n for n in FAMILIES if n not in ("apex", "turning_back", "thrown_pairs"))
"""The names of the families in which all motions are linear."""


def make_question(family: str, seed: int = 0, number: int = 0) -> Question:
    """The question of a family, the same on every machine.

    Args:
        family: one of `FAMILIES`.
        seed: the seed of a series of questions.
        number: the number of the question in the series.

    Raises:
        InputError: if there is no such family.
    """
    if family not in FAMILIES:
        raise InputError(f"no family {shorten(family)}; there are: {', '.join(FAMILIES)}")
    name = f"{family}:{seed}:{number}"
    rng = Random(name)
    return disguised(rng, FAMILIES[family](rng), name)


def disguised(rng: Random, way: Pass, name: str) -> Question:
    """The question about a pass: mirrored, in another frame and at another place and time."""
    across, flip_x, flip_y = (rng.random() < 0.5 for _ in range(3))
    start = rng.choice([0, 0, 0, 1, -2])
    speed = (rng.randint(-2, 2), rng.randint(-2, 2)) if rng.random() < 0.5 else (0, 0)
    at = [c + rng.randint(-8, 8) * (rng.random() < 0.5) for c in (way.far, way.far)]

    def moving(
        outline: Outline, x: Sequence[Number], y: Sequence[Number], *, closed: bool
    ) -> Moving:
        axes = [([v[0] for v in outline], x, flip_x), ([v[1] for v in outline], y, flip_y)]
        coordinates, paths = [], []
        for (cs, path, flip), c, v in zip(axes[::-1] if across else axes, at, speed, strict=True):
            s = -1 if flip else 1
            f = _since([0, *(s * k for k in path)], start)
            f += [0] * (2 - len(f))
            f[1] += v
            coordinates.append([float(s * k + c + f[0]) for k in cs])
            paths.append((0.0, *map(float, f[1:])))
        vertices = list(zip(*coordinates, strict=True))
        if across ^ flip_x ^ flip_y:
            vertices.reverse()  # mirrored: counter-clockwise again
        return Moving(tuple(vertices), paths[0], paths[1], closed)

    a = moving(way.moving, way.x, way.y, closed=way.closed[0])
    b = moving(way.still, [], [], closed=way.closed[1])
    if rng.random() < 0.5:
        a, b = b, a
    return Question(a, b, (float(start), float(start + way.span)), name)


def _one_of(rng: Random, *values: Number) -> Number:
    return rng.choice(values)


def _since(f: list[Number], start: int) -> list[Number]:
    """The coefficients of f(t - start)."""
    result: list[Number] = []
    for c in reversed(f):  # Horner's scheme: result * (t - start) + c
        result = [c, *result]
        for k in range(len(result) - 1):
            result[k] -= start * result[k + 1]
    return result


def _moved(outline: Outline, x: Number, y: Number) -> list[tuple[Number, Number]]:
    return [(u + x, v + y) for u, v in outline]


def _convex(rng: Random) -> Outline:
    return convex_polygon(rng, (QQ(0), QQ(0)), 3, rng.randint(3, 6))


def _tipped(rng: Random) -> Outline:
    """A convex polygon with its one rightmost vertex at the origin."""
    behind = [(QQ(rng.randint(-3, -1)), QQ(rng.randint(-3, 3))) for _ in range(rng.randint(2, 4))]
    chain = hull([*behind, (QQ(0), QQ(0))])
    return chain if len(chain) > 2 else [(-2, -1), (0, 0), (-2, 1)]


def _star(rng: Random) -> Outline:
    """A polygon that is star-shaped about the origin, with a vertex in each of eight directions."""
    around = [(1, 0), (1, 1), (0, 1), (-1, 1), (-1, 0), (-1, -1), (0, -1), (1, -1)]
    reach = [rng.randint(1, 3) for _ in around]
    return [(r * x, r * y) for r, (x, y) in zip(reach, around, strict=True)]


def _small(rng: Random) -> Outline:
    return rng.choice([[(0, 0), (QQ(1, 8), 0), (0, QQ(1, 8))], box(0, 0, 1, 1)])


def _aimed(rng: Random, moving: Outline, still: Outline) -> Pass:
    """One body moved to the left of the other, with a velocity that mostly leads to it."""
    gap, height, time = rng.randint(7, 10), rng.randint(-6, 6), rng.choice([2, 4, 8])
    aim = height + rng.randint(-4, 4)
    return Pass(
        _moved(moving, -gap, height), still, [QQ(gap, time)], [QQ(-aim, time)],
        rng.choice([time, 2 * time]),
    )  # fmt: skip
