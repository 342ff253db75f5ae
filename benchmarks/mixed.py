"""Certificates and events of the tilings of simple polygons, interlocked and far apart.

Run: python benchmarks/mixed.py [--most VERTICES]

Two combs that mesh, and two rectilinear spirals, of 16 to 4,096 vertices each: one moves
past the other. For each tiling: certificates made at the start, events up to the first
contact (or the end), and CPU seconds to build and to run. A second row has the two a
hundred diameters apart: there the certificates of "mixed" do not depend on the size.
"""

import argparse
import time

from exactpt.collision.tilings import start_tiling
from exactpt.motion.body import Body
from exactpt.motion.motions import Translation
from exactpt.scene.scene import Scene
from exactpt.tiling.events import ContactFound


def combs(vertices):
    """Two combs with teeth of width 2, 8 apart, and their diameter."""
    teeth = max(1, (vertices - 4) // 4)
    lower = [(-2, -2), (8 * teeth, -2), (8 * teeth, 0)]
    for i in reversed(range(teeth)):
        lower += [(8 * i + 2, 0), (8 * i + 2, 9), (8 * i, 9), (8 * i, 0)]
    lower.append((-2, 0))
    upper = [(x + 4, 11 - y) for x, y in reversed(lower)]
    return lower, upper, 8 * teeth + 20


def spirals(vertices):
    """Two rectilinear spirals of wall 1 in a corridor of 3, interlocked, and their diameter."""
    steps = max(4, vertices // 2 - 1)
    x = y = 0
    center, length = [(0, 0)], 4
    for i in range(steps):
        dx, dy = ((1, 0), (0, 1), (-1, 0), (0, -1))[i % 4]
        x, y = x + dx * length, y + dy * length
        center.append((x, y))
        length += 4 * (i % 2)
    left, right = [], []
    for i, (x, y) in enumerate(center):
        before, after = center[max(0, i - 1)], center[min(len(center) - 1, i + 1)]
        ux, uy = _sign(x - before[0]), _sign(y - before[1])
        vx, vy = _sign(after[0] - x), _sign(after[1] - y)
        nx, ny = -(uy + vy), ux + vx
        left.append((4 * x + 2 * nx, 4 * y + 2 * ny))
        right.append((4 * x - 2 * nx, 4 * y - 2 * ny))
    spiral = right + left[::-1]
    return spiral, [(8 - x, 8 - y) for x, y in spiral], 16 * (length + 4)


def _sign(d):
    return (d > 0) - (d < 0)


def measure(scene, tiling):
    start = time.process_time()
    kinetic = start_tiling(scene, tiling, scene.start)
    built = time.process_time()
    certificates = kinetic.certifier.made
    try:
        for _ in kinetic.run():
            pass
    except ContactFound:
        pass
    ran = time.process_time()
    return certificates, kinetic.stats.total, built - start, ran - built


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--most", type=int, default=4096)
    arguments = parser.parse_args()
    tilings = ("mixed", "greedy", "lazy")
    print(f"{'':28}" + "".join(f"{name:>34}" for name in tilings))
    head = f"{'certs':>8} {'events':>7} {'build s':>8} {'run s':>7}"
    print(f"{'family':10} {'vertices':>8} {'where':>7} " + "  ".join([head] * len(tilings)))
    for make in (combs, spirals):
        size = 16
        while size <= arguments.most:
            first, second, diameter = make(size)
            for where, shift in (("near", 0), ("far", 100 * diameter)):
                moved = [(x + shift, y) for x, y in second]
                # Along the teeth, or across the corridor; and a slow drift where far.
                motion = Translation([0, "1/7"], [0, "1/5"])
                scene = Scene([Body("a", first), Body("b", moved, motion)], (0, 40))
                cells = []
                for tiling in tilings:
                    certs, events, built, ran = measure(scene, tiling)
                    cells.append(f"{certs:8} {events:7} {built:8.3f} {ran:7.3f}")
                print(
                    f"{make.__name__:10} {len(first):8} {where:>7} " + "  ".join(cells), flush=True
                )
            size *= 4


if __name__ == "__main__":
    main()
