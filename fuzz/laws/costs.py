"""Laws about costs, by counts: what matters to nobody changes none by more than a stated share.

A bystander is added to a scene: a body far from all others, at rest, fast or of many vertices, or a
later end of the time span than the first contact. The first contact is the same. The counts that
the command ``exactpt collide`` reports, and the number of looks at the clock, may grow by `SHARE`
and `MARGIN`, looks also by `READ`.
"""

from __future__ import annotations

import json
from collections.abc import Callable
from functools import partial
from pathlib import Path
from random import Random
from tempfile import TemporaryDirectory
from typing import Final, TypeAlias

from click.testing import CliRunner

import exactpt
from exactpt import Body, Pieces, Scene, Simulation, Translation
from exactpt.cli import cli
from exactpt.kernel.numbers import QQ, fraction
from exactpt.testing import ending_at
from fuzz.laws.law import Check, check_equal, refuse_unless
from fuzz.laws.tilings import a_tiling
from fuzz.witnesses import Difference

__all__ = [
    "bystander_costs_nothing",
    "change_costs_nothing_elsewhere",
    "later_end",
    "many_far_bodies",
    "one_body_in_pieces",
    "one_far_body",
    "one_fast_body",
    "one_frame_around",
    "one_large_body",
]  # fmt: skip

SHARE: Final = 1.25
"""Ratio by which a count may grow."""

SHARE_OF_CHANGES: Final = 1.5
"""Ratio by which the certificates of a change may grow: the faces around a body are others then."""

MARGIN: Final = 8
"""Number by which a count may grow beyond that, for each bystander."""

READ: Final = 2
"""Number of looks at the clock, beyond that, for each vertex of bystanders after four of each."""

COUNTED: Final = ("starts", "certificates", "exact")
"""Counts of the command: pairs of bodies that are compared exactly at the start, pairs of features
or certificates, and exact decisions of these."""

CHANGED: Final = 8
"""Number of bodies whose changes are counted."""

LOOKS: Final = "looks"
"""Number of looks at the clock: also reading a scene takes some."""

Bystander: TypeAlias = Callable[[Scene], tuple[Scene, int]]
"""Returns a scene with bystanders, and their number."""


def _size_and_far(scene: Scene) -> tuple[QQ, QQ]:
    """Return the size of a scene, origin included, and a coordinate far outside of it."""
    times = [scene.start, (scene.start + scene.end) / 2, scene.end]
    points = [p for time in times for body in scene.bodies for p in body.at(time)]
    size = max(max(abs(QQ(str(c))) for c in p) for p in points) + 1
    return size, 10 * size


def _with_bodies(scene: Scene, count: int, velocity: Callable[[QQ], QQ]) -> tuple[Scene, int]:
    size, far = _size_and_far(scene)
    bodies = []
    for k in range(count):
        x = far + 3 * k * size
        shape = [(x, far), (x + size, far), (x, far + size)]
        motion = Translation([0], [0, velocity(size)])
        bodies.append(Body(f"bystander {k}", [tuple(map(fraction, p)) for p in shape], motion))
    return Scene([*scene.bodies, *bodies], (scene.start, scene.end)), count


def one_far_body(scene: Scene) -> tuple[Scene, int]:
    """Add a body at rest, ten times as far away as the scene is large."""
    return _with_bodies(scene, 1, lambda _: QQ(0))


def many_far_bodies(scene: Scene) -> tuple[Scene, int]:
    """Add sixteen bodies at rest, far away and far from each other."""
    return _with_bodies(scene, 16, lambda _: QQ(0))


def one_fast_body(scene: Scene) -> tuple[Scene, int]:
    """Add a body far away that leaves, 1000 times the size of the scene in a unit of time."""
    return _with_bodies(scene, 1, lambda size: 1000 * size)


def one_large_body(scene: Scene) -> tuple[Scene, int]:
    """Add a body at rest, far away, with 100 vertices on a parabola."""
    size, far = _size_and_far(scene)
    corners = [(far + size * QQ(k, 100), far + size * QQ(k, 100) ** 2) for k in range(100)]
    body = Body("bystander", [tuple(map(fraction, p)) for p in corners])
    return Scene([*scene.bodies, body], (scene.start, scene.end)), 1


def one_frame_around(scene: Scene) -> tuple[Scene, int]:
    """Add a body at rest around all others: a C of 100 vertices, ten times as large as the scene.

    Its inner side is an arc of the points (1 - t^2, 2 t) / (1 + t^2) times a radius, and its outer
    side has twice the radius.
    """
    _, far = _size_and_far(scene)
    turns = [3 * QQ(2 * k - 49, 50) for k in range(50)]
    arc = [((1 - t * t) / (1 + t * t), 2 * t / (1 + t * t)) for t in turns]
    inner = [(far * x, far * y) for x, y in arc]
    outer = [(2 * x, 2 * y) for x, y in reversed(inner)]
    body = Body("bystander", [tuple(map(fraction, p)) for p in (*inner, *outer)])
    return Scene([*scene.bodies, body], (scene.start, scene.end)), 1


def one_body_in_pieces(scene: Scene) -> tuple[Scene, int]:
    """Add a body far away whose motion has 16 pieces."""
    size, far = _size_and_far(scene)
    span = scene.exact_end - scene.exact_start
    ends = [scene.exact_start + span * QQ(k, 16) for k in range(1, 16)]
    motions = [Translation([0], [0]) for _ in range(16)]
    pieces = Pieces(list(zip([*map(fraction, ends), None], motions, strict=True)))
    shape = [(far, far), (far + size, far), (far, far + size)]
    body = Body("bystander", [tuple(map(fraction, p)) for p in shape], pieces)
    return Scene([*scene.bodies, body], (scene.start, scene.end)), 1


def later_end(scene: Scene) -> tuple[Scene, int]:
    """Let the time span end 16 times as late, after a contact in it."""
    refuse_unless(exactpt.first_contact(scene) is not None)
    refuse_unless(not any(body.keyframes for body in scene.bodies))
    span = scene.exact_end - scene.exact_start
    return Scene(scene.bodies, (scene.start, fraction(scene.exact_start + 16 * span))), 0


def bystander_costs_nothing(bystander: Bystander, *options: str) -> Check:
    """Return the check that a bystander changes no count of a search by much."""

    def check(scene: Scene, random: Random) -> str:  # noqa: ARG001
        """What matters to nobody changes no count of a search by more than a stated share."""
        crowd, number = bystander(scene)
        before, contact = _counts(scene, options)
        after, same = _counts(crowd, options)
        check_equal("time of the contact", same, contact)
        vertices = crowd.vertex_count - scene.vertex_count - 4 * number
        for name, count in before.items():
            most = SHARE * count + MARGIN * (1 + number)
            if name == LOOKS:
                most += READ * max(0, vertices)
            if after[name] > most:
                raise Difference(name, f"{count} became {after[name]}, at most {most:.0f}")
        return "no contact" if contact is None else "a contact"

    return check


def _counts(scene: Scene, options: tuple[str, ...]) -> tuple[dict[str, int], object]:
    """Return the counts of a search by the command, and the time of the contact."""
    with TemporaryDirectory() as folder:
        path = Path(folder) / "scene.json"
        scene.save(path)
        words = ["collide", str(path), "--json", "--max-seconds", "1000", *options]
        with ending_at(None) as clock:
            result = CliRunner().invoke(cli, words, catch_exceptions=False)
    refuse_unless(result.exit_code == 0)
    data = json.loads(result.stdout)
    stats = data["stats"]
    counts = {name: int(stats.get(name, 0)) for name in COUNTED}
    contact = data["contact"]
    return {**counts, LOOKS: clock.looks}, contact and contact["time"]


# Changes of a run


def change_costs_nothing_elsewhere(scene: Scene, random: Random) -> str:
    """A new motion, a body that goes and one that comes touch as many certificates in a crowd."""
    tiling, velocity = a_tiling(scene, random), (random.randint(-3, 3), random.randint(-3, 3))
    names = [body.name for body in random.sample(scene.bodies, min(CHANGED, len(scene.bodies)))]
    near = _surrounded(scene, 12, 10)
    far = _surrounded(near, 48, 4)
    before, after = (_certificates_of_changes(s, tiling, names, velocity) for s in (near, far))
    for kind, count in before.items():
        most = SHARE_OF_CHANGES * count + MARGIN * len(names)
        if after[kind] > most:
            raise Difference(kind, f"{count} became {after[kind]}, at most {most:.0f}")
    return tiling


def _surrounded(scene: Scene, count: int, distance: int) -> Scene:
    """Return a scene in a ring of small bodies at rest, that many times as far away as it is large.

    There are ``count`` of them on each half of the circle, at (1 - t^2, 2 t) / (1 + t^2).
    """
    size, _ = _size_and_far(scene)
    radius = distance * size
    side = radius / (4 * count)
    bodies: list[Body] = []
    for k in range(count):
        t = QQ(2 * k + 1 - count, count)
        x, y = radius * (1 - t * t) / (1 + t * t), radius * 2 * t / (1 + t * t)
        for a, b in ((x, y), (-x, -y)):
            shape = [(a, b), (a + side, b), (a, b + side)]
            name = f"bystander {len(scene.bodies) + len(bodies)}"
            bodies.append(Body(name, [tuple(map(fraction, p)) for p in shape]))
    return Scene([*scene.bodies, *bodies], (scene.start, scene.end))


def _certificates_of_changes(
    scene: Scene, tiling: str, names: list[str], velocity: tuple[int, int]
) -> dict[str, int]:
    """Return the number of certificates that changes of some bodies touch, by kind of change."""
    run = Simulation(scene, tiling=tiling)
    refuse_unless(run.contact is None)
    counts = {"new motion": 0, "removed": 0, "added": 0}
    for name in names:
        body = run.body(name)
        moved = body.with_motion(exactpt.onward(body, scene.start, velocity))
        counts["new motion"] += _touched_by(run, partial(run.set_motions, {name: moved}))
        counts["removed"] += _touched_by(run, partial(run.remove, name))
        counts["added"] += _touched_by(run, partial(run.add, body))
    return counts


def _touched_by(run: Simulation, change: Callable[[], object]) -> int:
    """Return the number of certificates that a change of a run touches."""
    before = _touched(run)
    change()
    return _touched(run) - before


def _touched(run: Simulation) -> int:
    """Return how many certificates a run has made, or has found to be unnecessary."""
    made, skipped = run.stats["certificates"], run.stats["skipped"]
    assert isinstance(made, int) and isinstance(skipped, int)  # noqa: S101, PT018 - documented
    return made + skipped
