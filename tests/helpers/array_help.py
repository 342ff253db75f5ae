"""What the tests of arrays share: the comparison with exact contacts, and planted questions."""

from fractions import Fraction

import numpy as np

from exactpt.arrays import KINDS, first_contacts, point_segment_contacts
from exactpt.testing.agreement import plain


def agrees(contacts, i, truth):
    """Whether answer i is an exact contact: its kind, its first incidence, its time enclosed."""
    kind = KINDS[contacts.kind[i]]
    truth = plain(truth)
    if truth is None:
        nowhere = np.isinf(contacts.low[i]) and np.isinf(contacts.high[i])
        return kind == "none" and not contacts.found[i] and nowhere
    low, high = (Fraction(float(t[i])) for t in (contacts.low, contacts.high))
    there = (contacts.body, contacts.vertex, contacts.edge, contacts.other_vertex)
    return (
        bool(contacts.found[i])
        and kind == truth.kind
        and tuple(int(column[i]) for column in there) == first_incidence(contacts, i, truth)
        and low <= truth.time <= high
    )


def first_incidence(contacts, i, truth):
    """Of the first incidence of a contact: body (0 or 1), vertex, edge, other vertex; or -1."""
    names = [body.name for body in contacts.scene(i).bodies]
    rows = [
        (
            names.index(incidence.body),
            incidence.vertex,
            -1 if incidence.edge is None else incidence.edge,
            -1 if incidence.other_vertex is None else incidence.other_vertex,
        )
        for incidence in truth.incidences
    ]
    return min(rows, default=(-1, -1, -1, -1))


def ulps(contacts):
    """For each contact how many doubles its enclosure holds, less one."""
    low, high = (t[contacts.found].view(np.int64) for t in (contacts.low, contacts.high))
    return high - low


class Queries:
    """Points against segments: what `point_segment_contacts` takes."""

    def __init__(self, points, firsts, lasts, velocities, time=(0.0, 1.0)):
        self.places = [np.asarray(a, dtype=float) for a in (points, firsts, lasts)]
        self.velocities = [np.asarray(v, dtype=float) for v in velocities]
        self.time = np.asarray(time, dtype=float)

    def __len__(self):
        return len(self.places[0])

    def asked(self):
        return point_segment_contacts(*self.places, velocities=self.velocities, time=self.time)

    def of_segments(self):
        """Those whose segment is no point at the start."""
        (_, a, b), (_, va, vb) = self.places, self.velocities
        start = np.broadcast_to(self.time, (len(self), 2))[:, 0]
        rows = zip(*(map(_fractions, f) for f in (a, b, va, vb, start[:, None])), strict=True)
        keep = np.array([
            any(b + v * t != a + u * t for a, b, u, v in zip(*ends, strict=True))
            for *ends, (t,) in rows
        ], dtype=bool)  # fmt: skip
        time = self.time if self.time.ndim == 1 else self.time[keep]
        places, velocities = ([a[keep] for a in f] for f in (self.places, self.velocities))
        return Queries(*places, velocities, time)


def _fractions(values):
    return [Fraction(float(x)) for x in values]


def generic(rng, m, scale=1.0):
    """Uniform in a square."""
    rows = rng.uniform(-scale, scale, (6, m, 2))
    return Queries(*rows[:3], rows[3:])


def small(rng, m, unit=1.0):
    """Small multiples of a unit: zeros of every kind."""
    rows = rng.integers(-3, 4, (6, m, 2)) * unit
    return Queries(*rows[:3], rows[3:], (0.0, 2.0)).of_segments()


def same_velocity(rng, m):
    """Two or three of the vertices have one velocity."""
    rows = rng.integers(-3, 4, (6, m, 2)) / 2.0
    which = rng.integers(0, 4, m)[:, None]
    rows[5] = np.where(which <= 1, rows[4], rows[5])
    rows[3] = np.where(which >= 1, rows[4], rows[3])
    return Queries(*rows[:3], rows[3:], (0.0, 3.0)).of_segments()


def grazing(rng, m):
    """The point passes through an end of the segment at a quarter, most of them inside the span."""
    time = rng.integers(-1, 9, (m, 1)) / 4.0
    velocities = rng.integers(-64, 65, (3, m, 2)) / 16.0
    at = rng.integers(-(2**20), 2**20, (2, m, 2)) / 2.0**18
    places = [at[0], at[0], at[1]] if rng.integers(0, 2) else [at[1], at[0], at[1]]
    starts = [p - v * time for p, v in zip(places, velocities, strict=True)]
    return Queries(*starts, velocities, (0.0, 2.0)).of_segments()


def touching(rng, m):
    """The line of a turning segment touches the path of the point, and turns back: a double zero.

    With a = (0, 0), b = (1, k t) and p = (x, y) + t (vx, vy) the orientation is
    y + (vy - k x) t - k vx t^2; it is s (t - r)^2 for y = s r^2, vy - k x = -2 s r, k vx = -s.
    """
    k = rng.choice([-2.0, -1.0, -0.5, 0.5, 1.0, 2.0], m)
    s, r, x = (rng.integers(low, high, m) / 8.0 for low, high in ((-16, 17), (0, 17), (-4, 16)))
    zero, one = np.zeros(m), np.ones(m)
    rows = [(x, s * r * r), (zero, zero), (one, zero), (-s / k, k * x - 2 * s * r), (zero, zero),
            (zero, k)]  # fmt: skip
    rows = [np.stack(row, axis=1) for row in rows]
    shear = rng.integers(-2, 3, m)[:, None]
    rows = [row + shear * row[:, ::-1] * (1.0, 0.0) for row in rows]
    return Queries(*rows[:3], rows[3:], (0.0, 2.0)).of_segments()


def shaken(rng, queries):
    """The same, with a coordinate of each moved to the next double, or by 2^-40."""
    rows = np.stack((*queries.places, *queries.velocities))
    m = len(queries)
    at = rng.integers(0, 6, m), np.arange(m), rng.integers(0, 2, m)
    moved = np.where(
        rng.integers(0, 2, m), np.nextafter(rows[at], rng.choice([-9.0, 9.0], m)),
        rows[at] + rng.choice([-(2.0**-40), 2.0**-40], m),
    )  # fmt: skip
    rows[at] = moved
    return Queries(*rows[:3], rows[3:], queries.time).of_segments()


PLANTED = (small, same_velocity, grazing, touching)


def degenerate(rng, m):
    """About m planted questions of every kind, a half of them shaken."""
    exact = [plant(rng, m // 8) for plant in PLANTED]
    return [*exact, *(shaken(rng, plant(rng, m // 8)) for plant in PLANTED)]


class Table:
    """Bodies and pairs of them: what `first_contacts` takes."""

    def __init__(self, shapes, coefficients, pairs, closed=True, time=(0.0, 2.0)):  # noqa: FBT002
        self.vertices = np.concatenate(shapes)
        self.offsets = np.concatenate(([0], np.cumsum([len(shape) for shape in shapes])))
        self.coefficients = coefficients
        self.pairs = pairs
        self.closed = closed
        self.time = np.asarray(time, dtype=float)

    def asked(self):
        return first_contacts(
            self.vertices, self.offsets, self.pairs, coefficients=self.coefficients,
            closed=self.closed, time=self.time,
        )  # fmt: skip


def some_pairs(rng, n, m):
    first = rng.integers(0, n, m)
    return np.stack((first, (first + rng.integers(1, n, m)) % n), axis=1)


def stars(rng, n):
    """Points, segments and star-shaped polygons around points of a square, in general position."""
    shapes = []
    for _ in range(n):
        k = int(rng.integers(1, 8))
        angles = (np.arange(k) + rng.uniform(0.0, 0.9, k)) * (2.0 * np.pi / k)
        radii = rng.uniform(0.3, 1.0, k)
        shape = np.stack((radii * np.cos(angles), radii * np.sin(angles)), axis=1)
        shapes.append(shape + rng.uniform(-1.0, 1.0, 2))
    return shapes


def boxes(rng, n):
    """Points, segments, triangles and boxes of small integers: everything touches."""
    corners = [np.array(shape, dtype=float) for shape in (
        [(0, 0)], [(0, 0), (1, 0)], [(0, 0), (1, 2)], [(0, 0), (2, 0), (0, 1)],
        [(0, 0), (1, 0), (1, 1), (0, 1)], [(0, 0), (0, 2), (1, 2), (1, 0)],
        [(0, 0), (2, 0), (2, 2), (1, 1), (0, 2)],
    )]  # fmt: skip
    return [corners[rng.integers(0, 7)] + rng.integers(-2, 3, 2) for _ in range(n)]
