"""A box of bouncing bodies, some of which deform, that never overlap: for ever, exactly.

    python examples/bouncing_box.py --bodies 100 --deforming 10 --contacts 3000

Bodies bounce off each other and off the walls. Each contact time is an algebraic number;
the simulation stops at a rational time less than 2^-70 before it, where the two bodies get
velocities that are rounded to a grid. That the bodies are disjoint is checked on the way,
exactly and by other code than the tiling's. Coordinates stay as small as they are, and so
does the memory.
"""

from __future__ import annotations

import argparse
import resource
import time
from collections.abc import Sequence
from random import Random

import exactpt
from exactpt.kernel.numbers import QQ
from exactpt.pair.start import initial_touches
from exactpt.simulation.motion_changes import translation_at
from exactpt.simulation.responses import Bounce

WALLS = ("south", "east", "north", "west")
PULSES = 4


def convex(rng: Random, size: int) -> list[tuple[QQ, QQ]]:
    """A convex polygon around the origin, of radius at most 3, counter-clockwise."""
    circle = [(4, 0), (3, 2), (2, 3), (0, 4), (-2, 3), (-3, 2), (-4, 0), (-3, -2), (-2, -3),
              (0, -4), (2, -3), (3, -2)]  # fmt: skip
    scale = QQ(rng.randint(4, 8), 12)
    while True:
        chosen = sorted(rng.sample(range(12), size))
        gaps = [(b - a) % 12 for a, b in zip(chosen, chosen[1:] + chosen[:1], strict=True)]
        if max(gaps) < 6:
            return [(scale * circle[i][0], scale * circle[i][1]) for i in chosen]


def pulsing(x: Sequence[QQ], y: Sequence[QQ], t: QQ) -> exactpt.Pieces:
    """A translation, and from a time on four pulses: stretched to and fro, twice."""
    pieces: list[tuple[QQ | None, exactpt.Affine]] = []
    stretched, way = QQ(0), QQ(1, 4)
    for i in range(PULSES):
        # 1 + s in x and 1 - s in y, with s from 0 to 1/4 and back.
        s = [stretched - way * t, way]
        matrix = [[[1 + s[0], s[1]], [0]], [[0], [1 - s[0], -s[1]]]]
        t, stretched, way = t + 1, stretched + way, -way
        pieces.append((t if i < PULSES - 1 else None, exactpt.Affine(matrix, x=x, y=y)))
    return exactpt.Pieces(pieces)


def box(bodies: int, deforming: int, seed: int, end: int) -> exactpt.Scene:
    """A box of convex bodies on a grid, with random velocities, in four walls."""
    rng = Random(seed)
    width = next(w for w in range(1, bodies + deforming + 2) if w * w >= bodies + deforming)
    side, thick = 10 * width, 5
    cells = rng.sample(range(width * width), bodies + deforming)
    scene = []
    for i, cell in enumerate(cells):
        center = [QQ(10 * (cell % width) + 5), QQ(10 * (cell // width) + 5)]
        x, y = ([c, QQ(rng.randint(-32, 32), 4)] for c in center)
        motion = exactpt.Translation(x, y) if i < bodies else pulsing(x, y, QQ(0))
        name = f"body {i}" if i < bodies else f"jelly {i - bodies}"
        scene.append(exactpt.Body(name, convex(rng, rng.randint(3, 7)), motion))
    low, high = -thick, side + thick
    for name, (a, b, c, d) in zip(
        WALLS,
        [(low, low, high, 0), (side, 1, high, side - 1), (low, side, high, high),
         (low, 1, 0, side - 1)],
        strict=True,
    ):  # fmt: skip
        scene.append(exactpt.Body(name, [(a, b), (c, b), (c, d), (a, d)]))
    return exactpt.Scene(scene, (0, end))


def digits(scene: exactpt.Scene, t: QQ) -> int:
    """The largest number of bits in a coordinate."""
    return max(
        max(c.numerator.bit_length(), c.denominator.bit_length())
        for points in scene.at(t).values()
        for p in points
        for c in p
    )


def main() -> None:
    """Run the box and print a line of figures now and then."""
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("--bodies", type=int, default=100)
    parser.add_argument("--deforming", type=int, default=10)
    parser.add_argument("--contacts", type=int, default=2000)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--end", type=int, default=200)
    parser.add_argument("--tiling", default="lazy")
    args = parser.parse_args()
    scene = box(args.bodies, args.deforming, args.seed, args.end)
    simulation = exactpt.Simulation(scene, tiling=args.tiling)
    bounce = Bounce(WALLS, fastest=16)
    began = time.monotonic()
    checks = 0

    def respond(simulation: exactpt.Simulation, contact: exactpt.Contact) -> None:
        nonlocal checks
        bounce(simulation, contact)
        if simulation.contacts % 20 == 0:
            checks += 1
            if initial_touches(simulation.scene)[1]:
                raise SystemExit(f"bodies overlap at t = {float(simulation.now)}")
        if simulation.contacts % (args.contacts // 20 or 1) == 0:
            stats = simulation.stats
            print(
                f"t = {float(simulation.now):8.4f}, {simulation.contacts} contacts, "
                f"{stats['events']} events, {stats['pending']} certificates pending, "
                f"{digits(simulation.scene, simulation.now.low)} bits, {checks} checks, "
                f"{resource.getrusage(resource.RUSAGE_SELF).ru_maxrss // 1024} MB, "
                f"{time.monotonic() - began:.0f} s",
                flush=True,
            )

    t = QQ(0)
    while simulation.contacts < args.contacts and t < args.end - PULSES:
        t += PULSES
        for _ in simulation.run(t, on_contact=respond):
            if simulation.contacts >= args.contacts:
                break
        else:
            again = {}
            for i in range(args.deforming):
                x, y = translation_at(simulation.body(f"jelly {i}"), t)
                again[f"jelly {i}"] = pulsing(x.coefficients, y.coefficients, t)
            simulation.set_motions(again)
    print(simulation.stats)


if __name__ == "__main__":
    main()
