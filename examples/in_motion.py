"""Shapes from a file, set in motion: a scene to run and to draw.

    python examples/in_motion.py examples/shapes/pond.svg --how swirl -o pond.json
    exactpt draw pond.json -o pond.html

Neighbours that share a border are in contact from the start; --shrink takes a margin off
every polygon (by shapely), so that they have a way to go. Holes are filled, and what lies in
one, as Lesotho in South Africa, is to be left out; unless they are kept (--holes keep).
"""

from __future__ import annotations

import argparse
from collections.abc import Iterator
from random import Random

import exactpt
from exactpt import Body, Rigid, Scene, Translation
from exactpt.kernel.numbers import QQ

SPAN = 10


def shrunk(scene: Scene, margin: float) -> Scene:
    """The shapes at the start with a margin taken off; what vanishes is left out."""
    smaller = {
        name: geometry.buffer(-margin, join_style="mitre")
        for name, geometry in scene.to_shapely(scene.start).items()
    }
    kept = {name: geometry for name, geometry in smaller.items() if not geometry.is_empty}
    return Scene.from_shapely(kept, (0, SPAN), parts="split")


def middle(points: list[tuple[QQ, QQ]]) -> tuple[QQ, QQ]:
    """The middle of the box around some points."""
    xs, ys = zip(*points, strict=True)
    return (min(xs) + max(xs)) / 2, (min(ys) + max(ys)) / 2


def moved(scene: Scene, how: str, rng: Random) -> Iterator[Body]:
    """The bodies, each with a motion of its own.

    gather: all move to one place, where each would be at the end. fall: thrown up, each as
    high as it happens to be. swirl: each turns about its middle and drifts.
    """
    everything = [point for points in scene.at(0).values() for point in points]
    x, y = middle(everything)
    size = max(abs(p[0] - x) + abs(p[1] - y) for p in everything)
    for body in scene.bodies:
        points = body.at(0)
        a, b = middle(points)
        chance = [QQ(rng.randint(-100, 100), 100) for _ in range(3)]
        drift = [[0, c * size / (4 * SPAN)] for c in chance[:2]]
        if how == "gather":
            motion: Translation | Rigid = Translation([0, (x - a) / SPAN], [0, (y - b) / SPAN])
        elif how == "fall":
            speed = (2 + chance[0]) * size / (2 * SPAN)
            motion = Translation([0, drift[0][1] / 4], [0, speed, -speed / SPAN * 2])
        else:
            motion = Rigid([0, chance[2] / 4], pivot=(a, b), x=drift[0], y=drift[1])
        yield body.with_motion(motion)


def main() -> None:
    """Read the command line, write the scene, say when its bodies meet."""
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("shapes")
    parser.add_argument("-o", "--output", required=True)
    parser.add_argument("--how", choices=["gather", "fall", "swirl"], default="gather")
    parser.add_argument("--shrink", type=float, default=0.0)
    parser.add_argument("--leave-out", nargs="*", default=[], metavar="NAME")
    parser.add_argument("--holes", choices=["fill", "keep"], default="fill")
    parser.add_argument("--tolerance", type=float, default=0.1)
    parser.add_argument("--seed", type=int, default=1)
    given = parser.parse_args()
    scene = exactpt.read_shapes(
        given.shapes, time=(0, SPAN), tolerance=given.tolerance, holes=given.holes, parts="split"
    )
    scene = Scene([body for body in scene.bodies if body.name not in given.leave_out], (0, SPAN))
    if given.shrink:
        scene = shrunk(scene, given.shrink)
    moving = Scene(moved(scene, given.how, Random(given.seed)), (0, SPAN))
    moving.save(given.output)
    contact = exactpt.first_contact(moving, method="auto")
    print(moving)
    if contact is not None:
        bodies = {(pair.body, pair.other) for pair in contact.pairs} | set(contact.initial_pairs)
        pairs = ", ".join(f"{a} and {b}" for a, b in sorted(bodies))
        print(f"first contact at t = {float(contact.time)!r}: {pairs}")


if __name__ == "__main__":
    main()
