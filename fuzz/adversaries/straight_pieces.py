"""An adversary of the filter for straight motion: pieces of many features, judged exactly.

Features far from the other piece are left out, and so are pieces of which the boxes do not meet. So
two pieces are placed where this is a tie: extreme vertices meet at about an end of the window.
"""

from __future__ import annotations

import random
from collections.abc import Iterator
from dataclasses import dataclass, field

from exactpt.filters import straight
from exactpt.filters.candidates import Candidate, Candidates
from exactpt.filters.rows import EXACT, STRAIGHT, Errors, Piece, Table
from fuzz.adversaries.exact_times import Fraction, as_integers, between, common, compared, touching
from fuzz.adversaries.straight import Tally, found_all
from fuzz.adversaries.straight_rows import THIRDS, Row, U, grid_number, random_number, stated

__all__ = ["attack_boxes", "attack_near", "attack_pieces"]


@dataclass
class ManyFeatures:
    """A piece of a few or many vertices: no polygon, since that does not matter here.

    Attributes:
        points: the vertices.
        path: cx, cy, wx, wy.
        errors: those that are stated.
        radius: the radius, exactly.
        exact: multiplied as in `Row`, first the coordinates of the vertices, then the path and the
            radius.
    """

    points: list[tuple[float, float]]
    path: list[float]
    errors: Errors
    radius: float = 0.0
    exact: list[int] = field(default_factory=list)

    def add_to(self, table: Table) -> None:
        """Add the piece to a table."""
        xs, ys = map(list, zip(*self.points, strict=True))
        size = len(xs)
        frame = [0.0] * 24
        frame[0], frame[4], frame[1], frame[5] = self.path
        place, edge = table.add_places(xs, ys), table.add_ring(size)
        box = min(xs), max(xs), min(ys), max(ys)
        piece = Piece(
            body=table.count(),
            kind=STRAIGHT,
            start=-3.0,
            end=3.0,
            place=place,
            size=size,
            edge=edge,
            edges=size,
            frame=frame,
            box=box,
            errors=self.errors,
            radius=self.radius,
            deforms=False,
        )
        table.add_piece(piece)

    def numbers(self) -> list[float]:
        """All doubles, in the order of ``exact``."""
        return [*(c for point in self.points for c in point), *self.path, self.radius]

    def exact_path(self) -> list[int]:
        """The exact numbers of the path."""
        first = 2 * len(self.points)
        return self.exact[first : first + len(self.path)]

    def bounds(self) -> list[float]:
        """The error of each of these."""
        of_places = [self.errors.place] * (2 * len(self.points))
        of_path = [self.errors.path] * 2 + [self.errors.speed] * 2
        of_radius = [0.0]
        return of_places + of_path + of_radius


def two_pieces(
    rng: random.Random, *, with_radii: bool = False
) -> tuple[ManyFeatures, ManyFeatures, float]:
    """Return two pieces, and a time at which two of their vertices are about at one place."""
    number = rng.choice([grid_number, random_number])
    has_errors = rng.random() < 0.3
    pieces: list[ManyFeatures] = []
    for _ in range(2):
        size = rng.choice([1, 3, 6, 6, 9]) if rng.random() < 0.98 else 90
        points = [(number(rng), number(rng)) for _ in range(size)]
        if size == 90:  # many features are near the other piece
            points = [(k * 0.03, y) for k, (_, y) in enumerate(points)]
        errors = stated(rng, "stated") if has_errors else EXACT
        pieces.append(ManyFeatures(points, [number(rng) for _ in range(4)], errors))
    a, b = pieces
    if rng.random() < 0.3:
        b.path = [0.0, 0.0, *(b.path[2:] if rng.random() < 0.5 else (0.0, 0.0))]
    if rng.random() < 0.2:
        a.path[rng.choice((2, 3))] = 0.0
    if rng.random() < 0.5:
        slow = 2.0 ** -rng.randint(3, 20)
        a.path[2:], b.path[2:] = ([slow * w for w in piece.path[2:]] for piece in pieces)
    time = rng.choice([-1.0, 0.0, 1.0, rng.uniform(-3.0, 3.0)])
    p, q = extreme(rng, a), extreme(rng, b)
    if rng.random() < 0.5:  # one of the two at 0: its coordinates hide no rounding
        piece, (x, y) = (a, p) if rng.random() < 0.5 else (b, q)
        piece.points = [(px - x, py - y) for px, py in piece.points]
        p, q = ((0.0, 0.0), q) if piece is a else (p, (0.0, 0.0))
    off = rng.choice([0.0, rng.uniform(-64.0, 64.0) * U])
    for k in range(2):
        a.path[k] = (q[k] - p[k]) + b.path[k] + (b.path[k + 2] - a.path[k + 2]) * time + off
    far_x = rng.uniform(-1.0, 1.0) * 2.0**30
    where = rng.choice(["near", "far paths", "far places"])
    if where == "far paths":
        a.path[0], b.path[0] = a.path[0] + far_x, b.path[0] + far_x
    if where == "far places":
        for piece in pieces:
            piece.points = [(x + far_x, y) for x, y in piece.points]
    if with_radii:
        for piece in pieces:
            piece.radius = rng.choice([0.0, 0.0, 1.0, rng.random()])
    add_exact(rng, a, b)
    return a, b, time


def extreme(rng: random.Random, piece: ManyFeatures) -> tuple[float, float]:
    """Return a vertex, often one on a side of the box."""
    choice = rng.choice([min, max, min, max, None])
    if choice is None:
        return rng.choice(piece.points)
    axis = rng.randrange(2)
    return choice(piece.points, key=lambda point: point[axis])


def add_exact(rng: random.Random, *pieces: ManyFeatures) -> None:
    """Set the exact numbers of pieces, at the ends of the errors or between them."""
    numbers = [x for piece in pieces for x in piece.numbers()]
    bounds = [x for piece in pieces for x in piece.bounds()]
    integers, _ = as_integers(numbers + bounds)
    count = len(numbers)
    exact = [
        x * THIRDS + error * rng.choice((-THIRDS, THIRDS, rng.randint(-THIRDS, THIRDS)))
        for x, error in zip(integers[:count], integers[count:], strict=True)
    ]
    for piece in pieces:
        size = len(piece.numbers())
        piece.exact, exact = exact[:size], exact[size:]


def table_of(*pieces: ManyFeatures) -> Table:
    """Return a table of pieces."""
    table = Table()
    for piece in pieces:
        piece.add_to(table)
    return table


def random_window(rng: random.Random, time: float) -> tuple[float, float]:
    """Return a window, most often with a time at an end of it."""
    if rng.random() < 0.7:
        return rng.choice([(time, time + 1.0), (time - 1.0, time), (time - 1.0, time + 1.0)])
    low, high = sorted((rng.uniform(-3.0, 3.0), rng.uniform(-3.0, 3.0)))
    return low, high


Span = tuple[Fraction, Fraction] | None


def box_times(a: ManyFeatures, b: ManyFeatures, of_one: list[int], of_other: list[int]) -> Span:
    """Return the first and the last time at which boxes of two pieces intersect, exactly.

    Args:
        a: a piece.
        b: another one.
        of_one: the numbers of the vertices of a in the box.
        of_other: those of b.

    Boxes are larger on all sides by the radius.
    """
    spans: list[Span] = []
    path_a, path_b = a.exact_path(), b.exact_path()
    reach = a.exact[-1] + b.exact[-1]
    for axis in range(2):
        one = [a.exact[2 * k + axis] for k in of_one]
        other = [b.exact[2 * k + axis] for k in of_other]
        c = path_a[axis] - path_b[axis]
        w = path_a[2 + axis] - path_b[2 + axis]
        least, most = min(other) - max(one) - reach, max(other) - min(one) + reach
        spans.append(between(least, most, c, w))
    return common(*spans)


def is_in(span: Span, low: float, high: float) -> bool:
    """Return True if a part of a span is in a window."""
    return span is not None and compared(span[0], high) <= 0 <= compared(span[1], low)


def attack_boxes(pairs: int, seed: int) -> Tally:
    """Run `meeting` on pairs of pieces, and compare its bounds with the exact times."""
    rng = random.Random(seed)
    tally = Tally()
    for _ in range(pairs):
        a, b, time = two_pieces(rng, with_radii=True)
        low, high = random_window(rng, time)
        first, last = straight.meeting(table_of(a, b), 0, 1, low, high)
        row = Row("boxes", repr((a, b)), (), (), (a.errors, b.errors), low, high)
        tally.rows[row.kind] += 1
        times = box_times(a, b, list(range(len(a.points))), list(range(len(b.points))))
        if times is None or not is_in(times, low, high):
            continue
        tally.candidates += 1
        if first > last:
            tally.wrong.append(("a time at which boxes intersect was excluded", row))
        elif low < first and compared(times[0], first) < 0:
            tally.wrong.append(("boxes intersect before", row))
        elif high > last and compared(times[1], last) > 0:
            tally.wrong.append(("boxes intersect after", row))
    return tally


def attack_near(pairs: int, seed: int) -> Tally:
    """Let the filter choose features near another piece; compare these with the exact times."""
    rng = random.Random(seed)
    tally = Tally()
    for _ in range(pairs):
        a, b, time = two_pieces(rng)
        low, high = random_window(rng, time)
        table = table_of(a, b)
        passage = straight.Passage(table, straight.relative_motion(table, 0, 1), 0, 1, low)
        passage.set_window(low, high)
        passage.bound_displacement()
        vertices, edges = passage.near_vertices(), passage.near_edges()
        met = list(passage.near_pairs(vertices, edges)) if len(vertices) else []
        known = {(met[k], met[k + 1]) for k in range(0, len(met), 2)}
        row = Row("near", repr((a, b)), (), (), (a.errors, b.errors), low, high)
        wrong = [
            f"vertex {vertex} and edge {edge} were left out"
            for vertex, edge in meeting_features(a, b, low, high)
            if (vertex, edge) not in known
        ]
        tally.rows[row.kind] += len(a.points) * len(b.points)
        tally.candidates += len(known)
        tally.wrong += [(what, row) for what in wrong]
    return tally


def meeting_features(
    a: ManyFeatures, b: ManyFeatures, low: float, high: float
) -> Iterator[tuple[int, int]]:
    """Yield vertices of a and edges of b of which the exact boxes meet in a window."""
    size = len(b.points)
    for vertex in range(len(a.points)):
        for edge in range(size):
            if is_in(box_times(a, b, [vertex], [edge, (edge + 1) % size]), low, high):
                yield vertex, edge


def attack_pieces(pairs: int, seed: int) -> Tally:
    """Run `meeting` and the filter on pairs of pieces; judge all their features."""
    rng = random.Random(seed)
    tally = Tally()
    for _ in range(pairs):
        a, b, time = two_pieces(rng)
        table = table_of(a, b)
        start, end = random_window(rng, time)
        low, high = straight.meeting(table, 0, 1, start, end)
        found = Candidates(end)
        if low <= high:
            straight.collect(table, 0, 1, low, high, start, found)
        known = {(c.one, c.vertex, c.edge): c for c in found_all(found)}
        window = start, min(end, found.limit)
        judge_features(0, a, b, known, window, tally)
        judge_features(1, b, a, known, window, tally)
    return tally


def judge_features(
    one: int,
    a: ManyFeatures,
    b: ManyFeatures,
    known: dict[tuple[int, int, int], Candidate],
    window: tuple[float, float],
    tally: Tally,
) -> None:
    """Compare the candidates of vertices of a piece with the exact times of contact."""
    low, high = window
    size = len(b.points)
    paths = a.exact_path() + b.exact_path()
    for vertex in range(len(a.points)):
        v = a.exact[2 * vertex : 2 * vertex + 2]
        for edge in range(size):
            i, j = 2 * edge, 2 * ((edge + 1) % size)
            exact = (*v, *b.exact[i : i + 2], *b.exact[j : j + 2], *paths)
            row = Row("pieces", "none", (), exact, (a.errors, b.errors), low, high)
            tally.rows[row.kind] += 1
            times = touching(exact)
            if times is None or compared(times[1], low) < 0 or compared(times[0], high) > 0:
                continue
            candidate = known.get((one, vertex, edge))
            if candidate is None:
                tally.wrong.append(("a contact of pieces was dropped", row))
            elif compared(times[0], candidate.low) < 0 and candidate.low > low:
                tally.wrong.append(("a contact of pieces before low", row))
            else:
                tally.candidates += 1
