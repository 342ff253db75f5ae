"""Events of the greedy tiling of convex bodies as their number grows.

Run: python benchmarks/events.py [--most K]

For each k: certificates pending at most (the paper's bound: 30 k), events, exact
decisions in a thousand, microseconds an event (CPU, best of three), and the fitted
exponent of the time per event.
"""

import argparse
import math
import time
from random import Random

from exactpt.collision.tilings import start_tiling
from exactpt.kernel.counters import counters
from exactpt.motion.body import Body
from exactpt.motion.motions import Translation
from exactpt.scene.families.shapes import cells, convex_polygon
from exactpt.scene.scene import Scene
from exactpt.tiling.events import ContactFound

EVENTS = 1000


def crowd(k, seed=1):
    """Convex bodies on a grid with room between them, in linear motion."""
    rng = Random(seed)
    bodies = []
    for i, c in enumerate(cells(rng, k, 1000)):
        move = Translation([0, rng.randint(-1000, 1000)], [0, rng.randint(-1000, 1000)])
        bodies.append(Body(f"b{i}", convex_polygon(rng, c, 60, rng.randint(3, 9)), move))
    return Scene(bodies, (0, 100))


def run(k, tiling):
    scene = crowd(k)
    exact, filtered = counters.exact, counters.filtered
    kinetic = start_tiling(scene, tiling, scene.start)
    start = time.process_time()
    try:
        for _ in kinetic.run():
            if kinetic.stats.total >= EVENTS:
                break
    except ContactFound:
        pass
    spent = time.process_time() - start
    decisions = counters.exact - exact + counters.filtered - filtered
    events = max(1, kinetic.stats.total)
    return spent / events, events, kinetic.stats.most, 1000 * (counters.exact - exact) / decisions


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--most", type=int, default=1000)
    parser.add_argument("--tiling", default="greedy")
    arguments = parser.parse_args()
    print(f"{'k':>5} {'events':>7} {'certificates/k':>14} {'exact/1000':>11} {'us/event':>9}")
    points = []
    for k in (10, 20, 50, 100, 200, 500, 1000):
        if k > arguments.most:
            break
        seconds, events, most, exact = min(run(k, arguments.tiling) for _ in range(3))
        points.append((math.log(k), math.log(seconds)))
        print(f"{k:5} {events:7} {most / k:14.1f} {exact:11.2f} {1e6 * seconds:9.1f}", flush=True)
    n = len(points)
    mx, my = sum(p[0] for p in points) / n, sum(p[1] for p in points) / n
    slope = sum((x - mx) * (y - my) for x, y in points) / sum((x - mx) ** 2 for x, _ in points)
    print(f"fitted exponent of the time per event: {slope:.2f}")


if __name__ == "__main__":
    main()
