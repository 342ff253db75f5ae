"""Bodies that turn at a constant rate: gears, mills and orbits."""

from __future__ import annotations

import math
from random import Random

from exactpt.geometry.predicates import Point
from exactpt.kernel.numbers import QQ
from exactpt.motion.body import Body
from exactpt.motion.motions import Translation
from exactpt.motion.spin import Spin
from exactpt.scene.scene import Scene
from exactpt.testing.scenes.shapes import box

ERRORS = ["1/50", "1/1000", "1/1000", "1e-6", "1e-9"]
"""Errors of an angle."""


def gears(rng: Random) -> Scene:
    """Two gears that mesh, with some play between the teeth, at rates that nearly fit."""
    teeth = rng.randint(3, 7), rng.randint(3, 7)
    height = rng.choice([QQ(1, 2), QQ(1, 3)])
    pitch = [QQ(n, 3) for n in teeth]
    apart = sum(pitch) + height * QQ(rng.randint(2, 9), 8)
    end = QQ(rng.randint(1, 3), 2)
    rate, slip = _number(rng, 0.5, 2), rng.choice([QQ(1), 1 + _number(rng, -0.25, 0.25)])
    rates = rate * teeth[1], -rate * teeth[0] * slip
    bodies = []
    for name, n, r, omega, x in zip(
        ("driver", "driven"), teeth, pitch, rates, (QQ(0), apart), strict=True
    ):
        phase = _number(rng, 0, 2 * math.pi)
        ring = _gear((x, QQ(0)), r, height, n, phase)
        spin = Spin(omega / 8, (x, 0), error=rng.choice(ERRORS))
        bodies.append(Body(name, ring, spin))
    return Scene(bodies, (0, end))


def mills(rng: Random) -> Scene:
    """A mill, of blades that are thin or are not, and what flies or stands in its way."""
    end = QQ(rng.randint(1, 3))
    omega = rng.choice([1, -1]) * _number(rng, 0.5, 2)
    spin = Spin(omega, (0, 0), error=rng.choice(ERRORS))
    arm = QQ(rng.randint(2, 4))
    bodies = [
        rng.choice(
            [
                Body("mill", [(-arm, 0), (arm, 0)], spin),
                Body("mill", [(arm, 0), (0, 0), (0, arm)], spin, closed=False),
                Body("mill", _cross(arm, QQ(1, 4)), spin),
                Body("mill", box(-arm, QQ(-1, 4), 2 * arm, QQ(1, 2)), spin),
                Body("mill", [(0, 0), (arm, 0)], spin, radius=QQ(1, 4)),
                Body("mill", [(-1, 0), {"x": [arm, "1/4"], "y": [0]}, (0, "1/2")], spin),
            ]
        )
    ]
    for i in range(rng.randint(1, 3)):
        angle, far = rng.uniform(0, 2 * math.pi), rng.uniform(1.5, 5)
        x, y = _place(far, angle)
        fly = Translation([0, _number(rng, -2, 2)], [0, _number(rng, -2, 2)])
        flying = rng.choice([fly, fly, Translation()])
        size = QQ(rng.randint(1, 4), 4)
        shape = rng.choice([[(x, y)], [(x, y), (x + size, y + size / 3)], box(x, y, size, size)])
        bodies.append(Body(f"b{i}", shape, flying, radius=QQ(rng.choice([0, 0, 1]), 5)))
    return Scene(bodies, (0, end))


def orbits(rng: Random) -> Scene:
    """Discs, triangles and segments that circle around centres near each other, one that drifts."""
    end = QQ(rng.randint(1, 4), 2)
    bodies = []
    for i in range(rng.randint(2, 4)):
        pivot = _number(rng, -0.5, 0.5), _number(rng, -0.5, 0.5)
        spin = Spin(
            rng.choice([1, -1]) * _number(rng, 0.5, 3),
            pivot,
            error=rng.choice(ERRORS),
            x=[0, _number(rng, -1, 1)] if i == 0 else 0,
        )
        angle, far = rng.uniform(0, 2 * math.pi), rng.uniform(1, 4)
        x, y = _place(far, angle)
        size = QQ(rng.randint(2, 6), 8)
        shape = [(x, y), (x + size, y), (x, y + size)][: rng.randint(1, 3)]
        quarters = rng.choice([2, 2, 0]) if len(shape) < 3 else rng.choice([0, 1])
        radius = size * QQ(quarters, 4)
        bodies.append(Body(f"b{i}", shape, spin, radius=radius))
    if rng.random() < 0.3:
        bodies.append(Body("hub", box(QQ(-1, 2), QQ(-1, 2), QQ(1), QQ(1))))
    return Scene(bodies, (0, end))


def _place(far: float, angle: float) -> Point:
    x, y = (round(4096 * far * of(angle)) for of in (math.cos, math.sin))
    return QQ(x, 4096), QQ(y, 4096)


def _number(rng: Random, low: float, high: float) -> QQ:
    return QQ(round(rng.uniform(low, high) * 1024), 1024)


def _gear(center: Point, pitch: QQ, height: QQ, teeth: int, phase: QQ) -> list[Point]:
    """A gear whose teeth have flat tips; on a grid."""
    ring = []
    for k in range(4 * teeth):
        r = pitch + (height / 2 if k % 4 < 2 else -height / 2)
        angle = float(phase) + (k + (0.15 if k % 2 else -0.15) * (1 if k % 4 < 2 else -1)) * (
            math.pi / (2 * teeth)
        )
        x, y = _place(float(r), angle)
        ring.append((center[0] + x, center[1] + y))
    return ring


def _cross(arm: QQ, half: QQ) -> list[Point]:
    quarter = [(arm, -half), (arm, half), (half, half)]
    ring = []
    for _ in range(4):
        ring += quarter
        quarter = [(-y, x) for x, y in quarter]
    return ring
