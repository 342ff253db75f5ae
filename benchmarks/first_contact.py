"""First contact: kinetic, by pairs, and the all-pairs reference, on the scenes of the tests.

Run: python benchmarks/first_contact.py [--reference SECONDS] [SCENE ...]

Times are CPU seconds of one run on a loaded scene; the answers are compared. The
reference is tried only where it is expected to end in that many seconds (default 20).
"""

import argparse
import time
from pathlib import Path

from exactpt import Scene
from exactpt.collision.allpairs import first_contact_allpairs
from exactpt.collision.detector import first_contact

SCENES = Path(__file__).parent.parent / "tests" / "data" / "scenes"


def timed(call):
    start = time.process_time()
    result = call()
    return result, time.process_time() - start


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("scenes", nargs="*", type=Path)
    parser.add_argument("--reference", type=float, default=20.0)
    arguments = parser.parse_args()
    paths = arguments.scenes or sorted(p for p in SCENES.glob("*.json") if p.stem != "answers")
    print(f"{'scene':28} {'vertices':>8} {'kinetic s':>10} {'pairs s':>8} {'reference s':>12}")
    for path in paths:
        first_contact(Scene.load(path))  # imports
        scene = Scene.load(path)
        kinetic, t = timed(lambda scene=scene: first_contact(scene))
        scene = Scene.load(path)
        pairs, u = timed(lambda scene=scene: first_contact(scene, method="pairs"))
        assert (kinetic and kinetic.pairs) == (pairs and pairs.pairs)
        # About 8 microseconds for each vertex and edge that are of different bodies.
        line = f"{path.stem:28} {scene.vertex_count:8} {t:10.3f} {u:8.3f}"
        if scene.vertex_count**2 * 8e-6 < arguments.reference:
            reference, r = timed(lambda scene=scene: first_contact_allpairs(scene))
            assert (kinetic and kinetic.pairs) == (reference and reference.pairs)
            line += f" {r:12.3f}   ({r / t:.0f} x, {r / u:.0f} x)"
        print(line, flush=True)


if __name__ == "__main__":
    main()
