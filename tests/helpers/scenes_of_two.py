"""Lines of scenes of two bodies, for the tests of batches."""

import json
import math
from decimal import Decimal
from fractions import Fraction
from random import Random

from exactpt.scene.json_values import Number
from exactpt.testing.families import FAMILIES, make_question


def generic(rng, write=float):
    """Two triangles of random doubles that move past or into each other."""
    bodies = []
    for name, middle in (("a", 0.0), ("b", 5.0)):
        turn = rng.uniform(0, 6)
        corners = [
            (middle + math.cos(turn + 2.1 * k) * rng.uniform(1, 1.2), math.sin(turn + 2.1 * k))
            for k in range(3)
        ]
        speed = rng.uniform(0, 1) * (1 if name == "a" else -1)
        motion = {"x": [0, write(speed)], "y": [0, write(rng.uniform(-0.5, 0.5))]}
        vertices = [[write(x), write(y)] for x, y in corners]
        bodies.append({"name": name, "vertices": vertices, "motion": motion})
    return json.dumps({"exactpt": 1, "time": [0, 10], "bodies": bodies})


def generic_lines(count, seed=0, write=float):
    rng = Random(seed)
    return [generic(rng, write) for _ in range(count)]


def nearly_degenerate(count, seed=0):
    """Questions of all families, each number off by a few 10^-22, far below the next double."""
    rng = Random(seed)

    def off(x):
        if not x or rng.random() < 0.5:
            return _plain(Decimal(x))
        return _plain(Decimal(x) + Decimal(rng.randint(-3, 3)).scaleb(-22))

    lines = []
    for number in range(count):
        for family in FAMILIES:
            question = make_question(family, seed, number)
            start, end = question.time
            bodies = []
            for name, body in (("a", question.a), ("b", question.b)):
                data = {
                    "name": name,
                    "vertices": [[off(x), off(y)] for x, y in body.vertices],
                    "motion": {axis: [off(c) for c in getattr(body, axis)] for axis in "xy"},
                    "closed": body.closed,
                }
                bodies.append(data)
            span = [_plain(Decimal(start)), off(end)]
            lines.append(_dump({"exactpt": 1, "time": span, "bodies": bodies}))
    return lines


def _plain(x):
    return Number(format(x, "f"))


def _dump(data):
    if isinstance(data, Number):
        return str(data)
    if isinstance(data, dict):
        return "{" + ", ".join(f"{json.dumps(k)}: {_dump(v)}" for k, v in data.items()) + "}"
    if isinstance(data, list):
        return "[" + ", ".join(map(_dump, data)) + "]"
    return json.dumps(data)


def far_misses(count, seed=0):
    """A triangle whose tip passes another's by 10^-4 to 10^5 distances of doubles there."""
    rng = Random(seed)
    lines = []
    for _ in range(count):
        far = 10 ** rng.randint(3, 9)
        x, y = (Decimal(rng.randint(far, 9 * far)) for _ in "xy")
        step = Decimal(far).scaleb(-16)
        by = step * rng.randint(-100, 100) * 10 ** rng.randint(0, 7) / 10000
        across = [Decimal(rng.randint(1, 999)) / 1000 for _ in range(4)]
        slope = Decimal(rng.randint(-9, 9)) / 7 if rng.random() < 0.8 else Decimal(0)
        slope = slope.quantize(Decimal("1e-18"))
        below = [(x, y), (x - 1, y - 1 - across[0] - 2), (x + 1, y - 2 - across[1] - 2)]
        # The tip is at (x - 3, y - 3 slope + by) and moves along (1, slope).
        tip = (x - 3, y - 3 * slope + by)
        above = [tip, (tip[0] - 1, tip[1] + 3 + across[2]), (tip[0] + 1, tip[1] + 3 + across[3])]
        bodies = [
            {"name": "a", "vertices": [[_plain(c) for c in v] for v in below]},
            {
                "name": "b",
                "vertices": [[_plain(c) for c in v] for v in above],
                "motion": {
                    "x": [_plain(Decimal(0)), _plain(Decimal(1))],
                    "y": [_plain(Decimal(0)), _plain(slope)],
                },
            },
        ]
        if rng.random() < 0.5:
            bodies.reverse()
        lines.append(_dump({"exactpt": 1, "time": [0, 10], "bodies": bodies}))
    return lines


def tiny_and_far(count, seed=0):
    """Polygons of a few to some thousand distances of doubles, some of which are not simple."""
    rng = Random(seed)
    return [_tiny_and_far(rng) for _ in range(count)]


def _tiny_and_far(rng):
    far = 10 ** rng.randint(0, 9)
    middle = [Decimal(rng.randint(far, 9 * far)) for _ in "xy"]
    step = Decimal(far).scaleb(-16)
    size = rng.choice([60, 1000, 30000])

    def near():
        return [_plain(c + step * rng.randint(-size, size) / 7) for c in middle]

    def speed():
        return [_plain(Decimal(0)), _plain(step * rng.randint(-size, size) / 9)]

    bodies = [
        {
            "name": name,
            "vertices": [near() for _ in range(rng.randint(1, 5))],
            "motion": {axis: speed() for axis in "xy"},
            "closed": rng.random() < 0.7,
        }
        for name in "ab"
    ]
    return _dump({"exactpt": 1, "time": [0, 3], "bodies": bodies})


def turning(count, seed=0):
    """Two triangles of random doubles, one or both of which turn."""
    rng = Random(seed)
    lines = []
    for _ in range(count):
        bodies = [
            {
                "name": name,
                "vertices": [
                    [middle + math.cos(2.1 * k) * rng.uniform(1, 1.2), math.sin(2.1 * k)]
                    for k in range(3)
                ],
                "motion": {"rigid": {"half_turn": [0, rng.uniform(-1, 1)], "pivot": [middle, 0.5]}},
            }
            for name, middle in (("a", 0.0), ("b", 5.0))
        ]
        moved = {"x": [0, -rng.random()], "y": [0, rng.uniform(-0.1, 0.1), 0.01]}
        bodies[1]["motion"]["rigid"] |= moved
        if rng.random() < 0.5:
            bodies[1]["motion"] = moved
        lines.append(_dump({"exactpt": 1, "time": [0, 9], "bodies": bodies}))
    return lines


def _turn(rng, pivot, number):
    more = {"x": [0, number()], "y": [0, number(), number()]} if rng.random() < 0.7 else {}
    return {"rigid": {"half_turn": [0, number()], "pivot": pivot, **more}}


ORIENTATIONS = ((1, 0), (0, 1), (-1, 0), ("3/5", "4/5"), ("-4/5", "3/5"))


def turning_on_a_grid(count, seed=0):
    """Bodies of small integers that turn: touching, crossing, within each other, not simple."""
    rng = Random(seed)

    def number():
        return rng.randint(-2, 2)

    def body(name, x):
        vertices = [[x + number(), number()] for _ in range(rng.randint(1, 4))]
        if rng.random() < 0.4:
            vertices = [[x, 0], [x + rng.randint(1, 2), 0], [x, rng.randint(1, 2)]]
        data = {"name": name, "vertices": vertices, "closed": rng.random() < 0.7}
        if rng.random() < 0.3:
            return data | {"motion": {"x": [0, number()], "y": [number(), number(), number()]}}
        motion = _turn(rng, [x + number(), number()], number)
        if rng.random() < 0.3:
            motion["rigid"]["orientation"] = list(rng.choice(ORIENTATIONS))
        if rng.random() < 0.3:
            motion["rigid"]["half_turn"] = [number(), f"{number()}/{rng.randint(1, 3)}"]
        return data | {"motion": motion}

    lines = []
    for _ in range(count):
        start = rng.choice([0, 0, 0, 1, -1, -2])
        bodies = [body("a", 0), body("b", rng.randint(0, 5))]
        if rng.random() < 0.2 and "rigid" in bodies[0]["motion"]:
            bodies[1]["motion"] = bodies[0]["motion"]
        span = [start, start + rng.randint(1, 4)]
        lines.append(_dump({"exactpt": 1, "time": span, "bodies": bodies}))
    return lines


def turning_past(count, seed=0):
    """A tip that turns to a place at a given time, at, on or along an edge that ends or lies there.

    The edge is moved by 0, or by 10^-4 to 10^-22 of the radius.
    """
    rng = Random(seed)
    lines = []
    for _ in range(count):
        t, rate = Fraction(rng.randint(0, 8), rng.choice([2, 4, 5])), Fraction(rng.randint(1, 3), 2)
        h = rate * t
        cosine, sine = (1 - h * h) / (1 + h * h), 2 * h / (1 + h * h)
        radius, far = rng.randint(1, 4), rng.choice([0, 0, 10**6])
        x, y = far + radius * cosine, radius * sine
        by = rng.choice([0, 1, -1]) * Fraction(1, 10 ** rng.choice([4, 8, 11, 13, 15, 17, 22]))
        out = 1 + by
        nx, ny = rng.choice([(cosine, sine), (-cosine, -sine), (sine, -cosine), (1, 0), (-1, 2)])
        ends = rng.choice([(-1, 1), (0, 1), (Fraction(-1, 3), 1)])
        x, y = far + (x - far) * out, y * out
        edge = [(x - s * ny, y + s * nx) for s in ends]
        edge += rng.choice([[], [(x + 2 * nx, y + 2 * ny)]])
        moved = rng.choice([{}, {"x": [0, Fraction(1, 3)]}])
        a = {"name": "a", "vertices": [(far + radius, 0), (far, Fraction(1, 9)), (far, 0)]}
        shared = {axis: list(path) for axis, path in moved.items()}
        a["motion"] = {"rigid": {"half_turn": [0, rate], "pivot": [far, 0], **shared}}
        bodies = [a, {"name": "b", "vertices": edge, "motion": moved}]
        rng.shuffle(bodies)
        scene = {"exactpt": 1, "time": [0, rng.choice([t or 1, t + 1])], "bodies": bodies}
        lines.append(json.dumps(scene, default=str))
    return lines
