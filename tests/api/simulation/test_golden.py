"""Event logs of fixed scenes: the same on every run, machine and hash seed.

``python tests/api/simulation/test_golden.py`` writes the files anew; look at the difference.
"""

import json
import os
import subprocess
import sys
from pathlib import Path

import pytest

from exactpt import Bounce, Simulation
from exactpt.testing.scenes import generate

GOLDEN = Path(__file__).parents[2] / "data" / "golden"
SCENES = [
    ("convex", 3, "greedy"),
    ("ballistic", 2, "greedy"),
    ("turning", 2, "lazy"),
    ("pieces", 3, "greedy"),
    ("grids_passing", 3, "greedy"),
    ("mirrored", 2, "lazy"),
    ("polygons_in_step", 1, "greedy"),
    ("stars", 4, "mixed"),
    ("blobs", 0, "mixed"),
    ("letters", 4, "greedy"),
]
NAMES = ["-".join(map(str, key)) for key in SCENES]


def log(family, seed, tiling):
    """The event log; three bounces, and then to the next contact."""
    simulation = Simulation(generate(family, seed), tiling=tiling)
    bounce = Bounce()

    def respond(simulation, contact):
        if simulation.contacts <= 3 and contact.kind != "self":
            bounce(simulation, contact)

    return "".join(
        json.dumps(event.to_json()) + "\n" for event in simulation.run(on_contact=respond)
    )


@pytest.mark.parametrize("key", SCENES, ids=NAMES)
def test_the_log_is_the_golden_one(key):
    golden = (GOLDEN / f"{NAMES[SCENES.index(key)]}.jsonl").read_text()

    assert log(*key) == golden


@pytest.mark.long
@pytest.mark.parametrize("hash_seed", ["0", "1", "12345"])
def test_the_log_does_not_depend_on_the_hash_seed(hash_seed):
    """In a process of its own, all of them."""
    environment = {
        **os.environ,
        "PYTHONHASHSEED": hash_seed,
        "PYTHONPATH": os.pathsep.join(sys.path),
    }
    program = [sys.executable, __file__, "--print"]
    written = subprocess.run(program, env=environment, capture_output=True, text=True, check=True)
    golden = "".join((GOLDEN / f"{name}.jsonl").read_text() for name in NAMES)

    assert written.stdout == golden


if __name__ == "__main__":
    for key, name in zip(SCENES, NAMES, strict=True):
        if "--print" in sys.argv:
            sys.stdout.write(log(*key))
        else:
            GOLDEN.mkdir(exist_ok=True)
            (GOLDEN / f"{name}.jsonl").write_text(log(*key))
