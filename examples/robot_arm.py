"""A planar arm of three links among obstacles: when is the first contact, for certain?

The absolute angle of a link is the sum of the joint angles up to it, cubic splines. The path of a
joint is fitted by a cubic Hermite spline, whose error, at most h^4 / 384 times the largest fourth
derivative in each piece, widens the bounds of the first contact. Both are cubic polynomials between
the same knots. The waypoints are among these, since the angle is no polynomial across a waypoint.
"""

import numpy as np
from scipy.interpolate import CubicHermiteSpline, CubicSpline, PPoly

import exactpt

WAYPOINTS = [0, 1, 2.5, 4]
JOINTS = np.array([[0, 0, 0], [0.8, -0.5, 0.3], [1.2, 0.9, -1], [2, 0.4, 0.6]])
LENGTHS = [2.0, 1.5, 1.0]
H = 1 / 32  # seconds between the knots of the fitted paths, about
ROUNDING = 1e-12  # more than that of the splines' doubles


def angles(joints: np.ndarray, knots: np.ndarray) -> PPoly:
    """The sum of the joint angles, a spline through the waypoints, in pieces between the knots."""
    spline = CubicSpline(WAYPOINTS, joints.sum(axis=1), bc_type="clamped")
    third, second, first = (
        spline(knots[:-1], order) / fact for order, fact in ((3, 6), (2, 2), (1, 1))
    )
    h = np.diff(knots)
    turned = ((third * h + second) * h + first) * h  # each piece begins where the one before ends
    begins = spline(knots[0]) + np.concatenate([[0], np.cumsum(turned[:-1])])
    return PPoly(np.array([third, second, first, begins]), knots)


def arm() -> list[exactpt.Body]:
    """The links: capsules on paths of poses with proved errors."""
    even = np.linspace(0, WAYPOINTS[-1], round(WAYPOINTS[-1] / H) + 1)
    knots = np.union1d(even, WAYPOINTS)
    h = np.diff(knots)
    place = speed = np.zeros((len(knots), 2))
    error, links = 0.0, list[exactpt.Body]()
    for k, length in enumerate(LENGTHS):
        theta = angles(JOINTS[:, : k + 1], knots)
        joint = CubicHermiteSpline(knots, place, speed)
        curve = PPoly(np.dstack([joint.c, theta.c]), knots)
        path = exactpt.PosePath.of_curve(curve).with_place_error(error)
        links.append(exactpt.Body(f"link {k + 1}", [(0, 0), (length, 0)], path, radius="1/10"))
        unit = np.exp(1j * theta(knots))
        turned = 1j * theta(knots, 1) * unit
        place = place + length * np.array([unit.real, unit.imag]).T
        speed = speed + length * np.array([turned.real, turned.imag]).T
        third, second, first = abs(theta.c[0]) * 6, abs(theta.c[1]) * 2, abs(theta.c[2])
        second, first = second + h * third, first + h * second + h * h * third
        fourth = first**4 + 6 * first**2 * second + 3 * second**2 + 4 * first * third
        error += length * (h**4 / 384 * fourth).max() + ROUNDING
    return links


def main() -> None:
    """Search the first contact of the arm with a box, or of its last link with the first."""
    boxes = [(-1, 3.4), (-3, 2.6), (2, 3.6), (-2.2, 3.2), (3.5, -1)]
    square = [(0, 0), (0.3, 0), (0.3, 0.3), (0, 0.3)]
    obstacles = [
        exactpt.Body(f"box {x} {y}", [(x + u, y + v) for u, v in square]) for x, y in boxes
    ]
    links = arm()
    scene = exactpt.Scene([*links, *obstacles], time=(0, WAYPOINTS[-1]))
    pairs = [(a.name, b.name) for a in links for b in obstacles]
    found = exactpt.first_contact_enclosed(scene, between=[*pairs, ("link 1", "link 3")])
    print(*(f"{a.name}: {a.motion}" for a in links), sep="\n")
    print(f"{found.pairs[0]}: from {float(found.low):.7f} to {float(found.high):.7f} s")


if __name__ == "__main__":
    main()
