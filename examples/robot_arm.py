"""A planar arm of three links among obstacles: when is the first contact, for certain?

The angle of a link is the sum of the joint angles up to it, cubic splines. The path of a joint is
fitted by a cubic Hermite spline, whose error, at most h^4 / 384 times the largest fourth derivative
in a piece, widens the bounds. No piece is across a waypoint, where that derivative jumps.
"""

import numpy as np
from scipy.interpolate import CubicHermiteSpline, CubicSpline, PPoly

import exactpt

WAYPOINTS = [0, 1, 2.5, 4]
JOINTS = np.array([[0, 0, 0], [0.8, -0.5, 0.3], [1.2, 0.9, -1], [2, 0.4, 0.6]])
LENGTHS, H = [2.0, 1.5, 1.0], 1 / 32  # H: seconds between the knots of the fitted paths, at most
ROUNDING = 1e-12  # more than that of the splines' doubles


def arm() -> list[exactpt.Body]:
    """The links: capsules on paths of poses with proved errors."""
    knots = np.union1d(np.arange(0, WAYPOINTS[-1], H), WAYPOINTS)
    place = speed = np.zeros((len(knots), 2))
    h, error, links = np.diff(knots), 0.0, list[exactpt.Body]()
    for k, length in enumerate(LENGTHS):
        theta = CubicSpline(WAYPOINTS, JOINTS[:, : k + 1].sum(axis=1), bc_type="clamped")
        angle = np.array([theta(knots[:-1], d) / (6, 2, 1, 1)[3 - d] for d in (3, 2, 1, 0)])
        turned = ((angle[0] * h + angle[1]) * h + angle[2]) * h
        angle[3] = np.cumsum([angle[3, 0], *turned[:-1]])  # each piece begins where one ends
        assert abs(angle[3] - theta(knots[:-1])).max() < ROUNDING  # noqa: S101 - the spline
        curve = PPoly(np.dstack([CubicHermiteSpline(knots, place, speed).c, angle]), knots)
        path = exactpt.PosePath.of_curve(curve).with_place_error(error)
        links.append(exactpt.Body(f"link {k + 1}", [(0, 0), (length, 0)], path, radius="1/10"))
        unit = np.exp(1j * theta(knots))
        place = place + length * np.array([unit.real, unit.imag]).T
        speed = speed + length * (theta(knots, 1) * np.array([-unit.imag, unit.real])).T
        third, second, first = abs(angle[0]) * 6, abs(angle[1]) * 2, abs(angle[2])
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
