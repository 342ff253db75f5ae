"""A planar arm of three links among obstacles: when is the first contact, for certain?

The angle of a link is the sum of the joint angles up to it, which are cubic splines. The path of a
joint is no polynomial: it is fitted by a cubic Hermite spline, and the error of the fit is stated,
so that it widens the bounds of the contact.

The error of the fit. In a piece of duration h, a cubic that has the values and the derivatives of a
function at both ends is within h^4 / 384 times the largest fourth derivative of the function there.
The path of a joint is a sum of terms length * exp(i a(t)). With bounds a1, a2, a3 of |a'|, |a''|,
|a'''| (and a'''' = 0, since a is a cubic in a piece), the fourth derivative of exp(i a) is at most
a1^4 + 6 a1^2 a2 + 3 a2^2 + 4 a1 a3. No piece is across a waypoint, where a''' jumps.
"""

import numpy as np
from scipy.interpolate import CubicHermiteSpline, CubicSpline, PPoly

import exactpt

WAYPOINTS = [0, 1, 2.5, 4]
"""Seconds."""
JOINTS = np.array([[0, 0, 0], [0.8, -0.5, 0.3], [1.2, 0.9, -1], [2, 0.4, 0.6]])
"""The angles of the three joints at each waypoint, in radians."""
LENGTHS = [2.0, 1.5, 1.0]
"""The lengths of the links."""
STEP = 1 / 32
"""The longest time between two knots of a fitted path."""
ROUNDING = 1e-12
"""More than the rounding of a spline in doubles."""


def main() -> None:
    """Search the first contact of the arm with a box, or of its last link with the first."""
    links = arm()
    boxes = obstacles()
    scene = exactpt.Scene([*links, *boxes], time=(0, WAYPOINTS[-1]))
    # Neighbouring links touch at their joint, so only these pairs count.
    pairs = [(link.name, box.name) for link in links for box in boxes]
    pairs.append(("link 1", "link 3"))
    found = exactpt.first_contact_enclosed(scene, between=pairs)

    for link in links:
        print(f"{link.name}: {link.motion}")
    print(f"{found.pairs[0]}: from {float(found.low):.7f} to {float(found.high):.7f} s")


def obstacles() -> list[exactpt.Body]:
    """Return some square boxes."""
    corners = [(-1, 3.4), (-3, 2.6), (2, 3.6), (-2.2, 3.2), (3.5, -1)]
    size = 0.3
    return [
        exactpt.Body(f"box {x} {y}", [(x, y), (x + size, y), (x + size, y + size), (x, y + size)])
        for x, y in corners
    ]


def arm() -> list[exactpt.Body]:
    """Return the links: capsules on paths of poses with stated errors."""
    knots = np.union1d(np.arange(0, WAYPOINTS[-1], STEP), WAYPOINTS)
    # The joint at which a link begins: its places and velocities at the knots, and its error.
    place = np.zeros((len(knots), 2))
    velocity = np.zeros((len(knots), 2))
    error = 0.0
    links = []
    for k, length in enumerate(LENGTHS):
        angle = CubicSpline(WAYPOINTS, JOINTS[:, : k + 1].sum(axis=1), bc_type="clamped")
        path = path_of_link(knots, place, velocity, angle).with_place_error(error)
        links.append(exactpt.Body(f"link {k + 1}", [(0, 0), (length, 0)], path, radius="1/10"))
        # The joint at its other end is where the next link begins.
        cosine, sine = np.cos(angle(knots)), np.sin(angle(knots))
        rate = angle(knots, 1)
        place = place + length * np.column_stack([cosine, sine])
        velocity = velocity + length * np.column_stack([-rate * sine, rate * cosine])
        error += length * error_of_fit(knots, angle) + ROUNDING
    return links


def path_of_link(
    knots: np.ndarray, place: np.ndarray, velocity: np.ndarray, angle: CubicSpline
) -> exactpt.PosePath:
    """Return the path of a link: its first joint fitted, its angle as a cubic in each piece."""
    fitted = CubicHermiteSpline(knots, place, velocity)
    coefficients = np.dstack([fitted.c, pieces_of_angle(knots, angle)])
    return exactpt.PosePath.of_curve(PPoly(coefficients, knots))


def pieces_of_angle(knots: np.ndarray, angle: CubicSpline) -> np.ndarray:
    """Return the coefficients of an angle between the knots, the highest power first.

    Rounded one by one they would jump from piece to piece, so each constant is the sum of the
    turns of the pieces before it.
    """
    starts, durations = knots[:-1], np.diff(knots)
    cubic = angle(starts, 3) / 6
    square = angle(starts, 2) / 2
    linear = angle(starts, 1)
    turns = ((cubic * durations + square) * durations + linear) * durations
    constant = np.cumsum([angle(knots[0]), *turns[:-1]])
    assert abs(constant - angle(starts)).max() < ROUNDING  # noqa: S101 - it is the same angle
    return np.array([cubic, square, linear, constant])


def error_of_fit(knots: np.ndarray, angle: CubicSpline) -> float:
    """Return a bound on the error of the fit of exp(i angle), see the first lines."""
    starts, h = knots[:-1], np.diff(knots)
    third = abs(angle(starts, 3))
    second = abs(angle(starts, 2)) + h * third
    first = abs(angle(starts, 1)) + h * second
    fourth = first**4 + 6 * first**2 * second + 3 * second**2 + 4 * first * third
    return float((h**4 / 384 * fourth).max())


if __name__ == "__main__":
    main()
