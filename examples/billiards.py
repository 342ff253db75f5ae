"""Three hundred polygons between four walls: elastic bounces, energy, a copy on the disk.

python examples/billiards.py 300 2      # polygons, seconds of the scene
"""

import argparse
from pathlib import Path
from random import Random
from tempfile import TemporaryDirectory

import exactpt
from exactpt.testing.scenes.shapes import convex_polygon


def table(count: int, rng: Random) -> tuple[exactpt.Scene, list[str]]:
    """Convex polygons on a grid with random velocities, and the names of the walls."""
    width = next(w for w in range(1, count + 1) if w * w >= count)
    side = 6 * width
    bodies = []
    for i in range(count):
        center = 6 * (i % width) + 3, 6 * (i // width) + 3
        velocity = exactpt.Velocity(*(rng.randint(-64, 64) / 16 for _ in range(2)))
        shape = convex_polygon(rng, center, 2, rng.randint(3, 7))
        bodies.append(exactpt.Body(f"p{i}", shape, velocity))
    walls = {
        "south": [(-1, -1), (side + 1, -1), (side + 1, 0), (-1, 0)],
        "north": [(-1, side), (side + 1, side), (side + 1, side + 1), (-1, side + 1)],
        "west": [(-1, 0.5), (0, 0.5), (0, side - 0.5), (-1, side - 0.5)],
        "east": [(side, 0.5), (side + 1, 0.5), (side + 1, side - 0.5), (side, side - 0.5)],
    }
    bodies += [exactpt.Body(*wall) for wall in walls.items()]
    return exactpt.Scene(bodies, time=(0, 1000)), list(walls)


def main() -> None:
    """Run, save, restore and go on; print the energy, the momentum of one body and the rates."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("polygons", type=int)
    parser.add_argument("seconds", type=int, help="the time span of the scene")
    given = parser.parse_args()
    seconds = given.seconds
    scene, walls = table(given.polygons, Random(7))
    simulation = exactpt.Simulation(scene, tiling="lazy")
    bounce = exactpt.Bounce(walls, grid="1/1073741824", slowest="1/1024")
    before = bounce.kinetic_energy(simulation)
    with TemporaryDirectory() as folder:
        for t in range(1, seconds + 1):
            for _ in simulation.run(t, on_contact=bounce):
                pass
            drift = float(bounce.kinetic_energy(simulation) / before - 1)
            print(f"t = {t}: {simulation.contacts} contacts, energy changed by {drift:.1e}")
            simulation.save(Path(folder) / "run.json")
            simulation = exactpt.Simulation.restore(Path(folder) / "run.json")
    simulation.remove("p0")
    simulation.set_motion("p1", exactpt.onward(simulation.body("p1"), seconds, (0, 1)))
    print("velocity of p1:", *map(str, simulation.body("p1").velocity_at(seconds)[0]))
    print(f"rules: {simulation.stats['rules']}, {simulation.stats['events']} events")


if __name__ == "__main__":
    main()
