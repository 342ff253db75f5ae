"""Writes scenes of two moving polygons, one on each line: input of `exactpt batch`.

python examples/many_scenes.py 1000000 >scenes.jsonl
exactpt batch scenes.jsonl -o results.jsonl --jobs 2
"""

from __future__ import annotations

import argparse
import json
import math
from random import Random


def polygon(rng: Random, x: float, y: float) -> list[list[float]]:
    """Three to five vertices on a circle of a radius between 0.5 and 1."""
    corners, turn, radius = rng.randint(3, 5), rng.uniform(0, math.tau), rng.uniform(0.5, 1)
    angles = [turn + math.tau * (k + rng.uniform(0, 0.8)) / corners for k in range(corners)]
    return [[x + radius * math.cos(a), y + radius * math.sin(a)] for a in angles]


def scene(rng: Random) -> dict[str, object]:
    """A body that flies towards another, and hits or misses it; all numbers are doubles."""
    turn = rng.uniform(0, math.tau)
    away = [rng.uniform(3, 9) * math.cos(turn), rng.uniform(3, 9) * math.sin(turn)]
    speed = [-c / rng.uniform(2, 8) + rng.uniform(-0.3, 0.3) for c in away]
    flying = {"x": [0, speed[0]], "y": [0, speed[1]]}
    drift = {"x": [0, rng.uniform(-0.1, 0.1)], "y": [0, rng.uniform(-0.1, 0.1)]}
    bodies = [
        {"name": "flying", "vertices": polygon(rng, *away), "motion": flying},
        {"name": "drifting", "vertices": polygon(rng, 0, 0), "motion": drift},
    ]
    return {"exactpt": 1, "time": [0, 10], "bodies": bodies}


def main() -> None:
    """Write as many scenes as the argument says."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("scenes", type=int)
    given = parser.parse_args()
    rng = Random(1)
    for _ in range(given.scenes):
        print(json.dumps(scene(rng)))


if __name__ == "__main__":
    main()
