"""A mobile robot on a spline of poses among thirty obstacles: first contact, near misses, picture.

x, y and the angle are cubic splines of SciPy through waypoints. The first contact is enclosed for
the path itself; the times during which the robot is within 5 mm are those of its rational pieces,
whose points are at most `r error` away from it, r their distance from the origin of the robot.
"""

import argparse
from random import Random

import numpy as np
from scipy.interpolate import CubicSpline

import exactpt

TIMES = [0, 2, 4, 6, 8, 10]  # seconds
POSES = np.array(  # millimetres, radians
    [
        [0, 0, 0],
        [900, 150, 0.6],
        [1500, 900, 1.8],
        [900, 1600, 3.2],
        [200, 1200, 4.4],
        [0, 300, 4.7],
    ]
)
ROBOT = [(-200, -125), (200, -125), (200, 125), (-200, 125)]


def cell(rng: Random) -> exactpt.Scene:
    """The robot and triangles that it does not touch at the start."""
    path = exactpt.PosePath.of_curve(CubicSpline(TIMES, POSES), error="1/100000")
    bodies = [exactpt.Body("robot", ROBOT, path)]
    while len(bodies) < 31:
        x, y = rng.randint(-900, 2400), rng.randint(-900, 2400)
        if x * x + y * y > 400**2:
            corners = [(x, y), (x + 60, y + 10), (x + 20, y + 70)]
            bodies.append(exactpt.Body(f"obstacle {len(bodies)}", corners))
    return exactpt.Scene(bodies, time=(0, 10))


def main() -> None:
    """Print the first contact and all times within 5 mm; draw into a file, if one is named."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("picture", nargs="?", help="the file of the picture to draw")
    given = parser.parse_args()
    scene = cell(Random(8))
    obstacles = [body.name for body in scene.bodies[1:]]
    found = exactpt.first_contact_enclosed(scene, ignoring=[obstacles])
    if found is not None:
        high = f"{float(found.high):.6f}" if found.is_certain else "the end, or not at all"
        print(f"first contact {found.pairs[0]} between {float(found.low):.6f} and {high} s")
    wide = scene.bodies[0].with_radius(5)  # its contacts are the times within 5 mm
    near = exactpt.Scene([wide, *scene.bodies[1:]], time=(0, 10))
    for interval in exactpt.contacts(near, ignoring=[obstacles]):
        print(f"within 5 mm of {interval.b}: {interval.start:.6f} to {interval.end:.6f} s")
    if given.picture is not None:
        scene.draw(given.picture, tiling=None, legend=True, poses=12)


if __name__ == "__main__":
    main()
