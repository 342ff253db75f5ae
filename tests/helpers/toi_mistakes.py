"""A time of impact that is right about every family, and ten ways to get it wrong.

It computes with rationals. The roots of quadratics are rounded to 2^-200, which is finer than any
distance that the families have.
"""

from fractions import Fraction
from functools import partial
from math import isqrt

FINE = Fraction(1, 2**100)

MISTAKES = [
    "vertex-vertex missed",
    "parallel edges",
    "wrong quadratic root",
    "tolerance in the wrong place",
    "even roots",
    "start in contact",
    "swapped bodies",
    "far offsets",
    "float equality",
    "end of span",
]


def toi(question, mistake=""):
    start, end = map(Fraction, question.time)
    a, b = points(question.a), points(question.b)
    motion = relative(question.a, question.b)
    if mistake != "start in contact" and (overlap(question.a, at(a, motion, start), question.b, b)):
        return start
    back = [[-c for c in f] for f in motion]
    times = [
        *contacts(a, question.b, b, motion, mistake),
        *contacts(b, question.a, a, motion if mistake == "swapped bodies" else back, mistake),
    ]
    if mistake == "start in contact":
        times = [t for t in times if t > start]
    if mistake == "end of span":
        times = [t for t in times if t < end]
    return min((t for t in times if start <= t <= end), default=None)


def wrong(mistake):
    return partial(toi, mistake=mistake)


def points(body):
    return [(Fraction(x), Fraction(y)) for x, y in body.vertices]


def relative(a, b):
    """The motion of a relative to b: three coefficients in x and in y."""
    padded = [[Fraction(c) for c in f] + [Fraction(0)] * (3 - len(f)) for f in (a.x, a.y, b.x, b.y)]
    return [[p - q for p, q in zip(padded[k], padded[k + 2], strict=True)] for k in (0, 1)]


def edges(body, outline):
    n = len(outline)
    last = n if body.closed and n > 2 else n - 1
    return [(outline[i], outline[(i + 1) % n]) for i in range(last)]


def value(f, t):
    return f[0] + f[1] * t + f[2] * t * t


def at(outline, motion, t):
    return [(x + value(motion[0], t), y + value(motion[1], t)) for x, y in outline]


def cross(ux, uy, vx, vy):
    return ux * vy - uy * vx


def contacts(outline, other, resting, motion, mistake):
    """The times at which a vertex of the outline is on an edge, or on a point."""
    sides = edges(other, resting) or [(resting[0], resting[0])]
    for v in outline:
        for p, q in sides:
            if mistake == "parallel edges" and is_parallel(outline, v, p, q):
                continue
            f = polynomial(v, p, q, motion, mistake)
            for t in roots(f, mistake) if any(f) else along(v, p, q, motion):
                (place,) = at([v], motion, t)
                if lies_on(place, p, q, mistake):
                    yield t


def polynomial(v, p, q, motion, mistake):
    dx, dy = q[0] - p[0], q[1] - p[1]
    f = [cross(dx, dy, x, y) for x, y in zip(*motion, strict=True)]
    f[0] += cross(dx, dy, v[0] - p[0], v[1] - p[1])
    if mistake == "far offsets":  # the determinant of the points, not of their differences
        (px, py), (qx, qy), (vx, vy) = ([float(c) for c in point] for point in (p, q, v))
        f[0] = Fraction(cross(px, py, qx, qy) + cross(qx, qy, vx, vy) + cross(vx, vy, px, py))
        f[0] += cross(dx, dy, motion[0][0], motion[1][0])
    return f


def along(v, p, q, motion):
    """The times at which a vertex that moves along a line passes the ends of an edge on it."""
    for end in (p, q):
        for k in (0, 1):
            f = [v[k] - end[k] + motion[k][0], *motion[k][1:]]
            if any(f):
                yield from roots(f, "")


def roots(f, mistake):
    c, b, a = f
    if a == 0:
        return [-c / b] if b else []
    d = b * b - 4 * a * c
    if d < 0 or (d == 0 and mistake == "even roots"):
        return []
    bits = 400
    scaled = d.numerator * d.denominator << 2 * bits
    root = Fraction(isqrt(scaled), d.denominator << bits)
    both = sorted([(-b - root) / (2 * a), (-b + root) / (2 * a)])
    return both[1:] if mistake == "wrong quadratic root" else both


def lies_on(place, p, q, mistake):
    dx, dy = q[0] - p[0], q[1] - p[1]
    x, y = place[0] - p[0], place[1] - p[1]
    if mistake == "float equality":
        fx, fy = float(place[0]), float(place[1])
        if cross(float(dx), float(dy), fx - float(p[0]), fy - float(p[1])) != 0.0:
            return False
    elif abs(cross(dx, dy, x, y)) > FINE:
        return False
    u, length = x * dx + y * dy, dx * dx + dy * dy
    if length == 0:
        return abs(x) <= FINE and abs(y) <= FINE
    if mistake == "vertex-vertex missed":
        return FINE < u < length - FINE
    slack = Fraction(1, 1000) if mistake == "tolerance in the wrong place" else FINE
    return -slack <= u <= length + slack


def is_parallel(outline, v, p, q):
    i = outline.index(v)
    around = (outline[i - 1], outline[(i + 1) % len(outline)])
    return any(cross(q[0] - p[0], q[1] - p[1], w[0] - v[0], w[1] - v[1]) == 0 for w in around)


def overlap(a, placed, b, resting):
    """Whether two bodies share a point: edges that cross, a vertex on an edge, one inside."""
    for p, q in edges(a, placed):
        for r, s in edges(b, resting):
            if separates(p, q, r, s) and separates(r, s, p, q):
                return True
    rest = [[Fraction(0)] * 3] * 2
    for moving, still, other in ((placed, b, resting), (resting, a, placed)):
        sides = edges(still, other) or [(other[0], other[0])]
        if any(lies_on(at([v], rest, 0)[0], p, q, "") for v in moving for p, q in sides):
            return True
        if still.closed and len(other) > 2 and inside(moving[0], other):
            return True
    return False


def separates(p, q, r, s):
    d = q[0] - p[0], q[1] - p[1]
    left, right = (cross(*d, w[0] - p[0], w[1] - p[1]) for w in (r, s))
    return left * right < 0


def inside(v, outline):
    odd = False
    for (px, py), (qx, qy) in zip(outline, outline[1:] + outline[:1], strict=True):
        if (py > v[1]) != (qy > v[1]):
            odd ^= v[0] < px + (v[1] - py) * (qx - px) / (qy - py)
    return odd
