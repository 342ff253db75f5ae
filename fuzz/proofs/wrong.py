"""Proofs that are wrong from the first: wheels that wind twice, runs spliced at a contact."""

from __future__ import annotations

from fractions import Fraction
from math import cos, pi, sin
from random import Random
from typing import Final

from exactpt import AuditError, Body, InputError, Scene, Translation
from exactpt.kernel.numbers import QQ, power_of_two
from exactpt.proof.changes import change, followers
from exactpt.proof.emit import ProofRun
from exactpt.proof.lines import header
from exactpt.scene.written import scene_bytes
from exactpt.testing import reference

__all__ = ["spliced", "touching_and_going", "wheel", "wrong_splice"]

TILINGS: Final = ("lazy", "greedy", "mixed")


def wheel(random: Random) -> tuple[Scene, list[str]]:
    """Points around a hub, each joined to the next but one or two: all angles are right."""
    n = random.choice([5, 7, 8, 9, 11])
    step = random.choice([s for s in (2, 3) if n % s and n > 2 * s])
    turn, size = random.random(), random.randint(50, 5000)
    places = [(0, 0)]
    for k in range(n):
        angle = 2 * pi * (k + turn + random.uniform(-0.05, 0.05)) / n
        places.append((round(size * cos(angle)), round(size * sin(angle))))
    shift = Translation([0, random.randint(-9, 9)], [0, random.randint(-9, 9)])
    labels = random.sample(range(n + 1), n + 1)  # of the point k: labels[k]
    bodies = [Body(f"p{i}", [places[labels.index(i)]], shift) for i in range(n + 1)]
    scene = Scene(bodies, time=(0, 1))
    rim = [labels[1 + step * k % n] for k in range(n)]
    faces = [f"face {labels[0]} {rim[k - 1]} {rim[k]}" for k in range(n)]
    outer = "outer " + " ".join(str(v) for v in reversed(rim))
    lines = header(scene_bytes(scene), QQ(0), QQ(1))
    return scene, [*lines, *faces, outer, "none"]


def touching_and_going(random: Random, *, with_event: bool) -> Scene:
    """Bodies on a grid of which one comes down to touch another one at t = 1, and leaves.

    With an event, a point passes between two other ones at the same time.
    """
    rows = [[(0, 0), (4, 0)], [(1, 0), (4, 1), (2, 2)], [(0, 0), (2, 1), (4, 0)], [(2, 0)]]
    low, high = random.choice(rows), random.choice(rows)
    shift = random.randint(-3, 3)
    drop = min(y for _, y in high) - max(y for _, y in low)
    lower = Body("low", low, closed=len(low) != 3 or random.random() < 0.5)
    motion = Translation([shift, random.randint(-1, 1)], [Fraction(1 - drop), -2, 1])
    upper = Body("high", high, motion, closed=random.random() < 0.5)
    bodies = [lower, upper, Body("p", [(9, 1)]), Body("q", [(-9, random.randint(2, 5))])]
    if with_event:
        x, y = random.randint(10, 14), random.randint(-4, 4)
        passing = Translation([0], [0, random.choice([-2, -1, 1, 2])])
        bodies += [Body("r", [(x + 4, y)]), Body("s", [(x + 8, y)])]
        bodies.append(Body("t", [(x + 6, y - passing.y.coefficients[1])], passing))
    return Scene(bodies, time=(0, 2))


def spliced(scene: Scene, time: QQ, later: QQ, tiling: str) -> list[str]:
    """A run up to a time, and one from a later time on, made into one proof with an event."""
    file = scene_bytes(scene)
    first = ProofRun(scene.until(time), tiling=tiling, scene_file=file)
    lines = list(first.lines())
    rest = scene.going_on(scene.bodies, later)
    others = list(ProofRun(rest, tiling=tiling, scene_file=file).lines())
    start = next(i for i, line in enumerate(others) if line.split()[0] in ("event", "none"))
    again = ProofRun(rest, tiling=tiling, scene_file=file)
    generator = again.lines()
    for _ in range(start):
        next(generator)
    old, new = first.maker.after, again.maker.after
    solid = followers(first.nodes.solid_faces())
    words = [f"= {u} {v}" for u, v in sorted(old.keys() & new.keys() - solid.keys())]
    words += change(dict(old), old, new, first.maker.is_body_edge)
    lines[2] = f"span {scene.start} {scene.end}"
    return [*lines[:-1], f"event {time} {time} {' '.join(words)}", *others[start:]]


def wrong_splice(random: Random, *, with_event: bool) -> tuple[Scene, list[str]] | None:
    """A scene with a contact at t = 1, and a proof that there is none."""
    scene, tiling = touching_and_going(random, with_event=with_event), random.choice(TILINGS)
    contact = reference.first_contact(scene)
    if contact is None or contact.time != 1:
        return None
    later = QQ(1) + power_of_two(-20)
    if reference.first_contact(scene.going_on(scene.bodies, later)) is not None:
        return None
    try:
        return scene, spliced(scene, QQ(1), later, tiling)
    except (AuditError, InputError):  # `until` the contact, the run ends with it
        return None
