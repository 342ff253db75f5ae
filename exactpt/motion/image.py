"""The float enclosure of a trajectory: the doubles nearest to its coefficients."""

from __future__ import annotations

from typing import final

__all__ = ["Image"]


@final
class Image:
    """The doubles nearest to the normalised coefficients of a trajectory.

    With the error bounds `exactpt.motion.frame.Frame.errors` they enclose the trajectory.
    If a coefficient is neither 0 nor of size 2^-100 to 2^100, all of them are NaN, which no
    filter accepts.

    Attributes:
        x0, ..., x3, y0, ..., y3: the coefficients of a translating trajectory, up to t^3;
            0 above its degree.
        xs, ys: all coefficients; both lists have length ``degree`` + 1.
        ws: the denominator's coefficients if the trajectory turns, else empty (a constant
            denominator is divided out).
        degree: the degree of the trajectory; of the numerators if it turns.
        motion: vertices of equal ``motion`` keep their difference (translating) or
            their distances (turning) for ever; -1 is equal to nothing.
    """

    __slots__ = (
        "degree",
        "motion",
        "ws",
        "x0",
        "x1",
        "x2",
        "x3",
        "xs",
        "y0",
        "y1",
        "y2",
        "y3",
        "ys",
    )

    def __init__(self, xs: list[float], ys: list[float], ws: list[float], motion: int) -> None:
        self.xs = xs
        self.ys = ys
        self.ws = ws
        self.degree: int = len(xs) - 1
        self.x0: float = xs[0]
        self.y0: float = ys[0]
        self.x1: float = xs[1] if len(xs) > 1 else 0.0
        self.y1: float = ys[1] if len(ys) > 1 else 0.0
        self.x2: float = xs[2] if len(xs) > 2 else 0.0
        self.y2: float = ys[2] if len(ys) > 2 else 0.0
        self.x3: float = xs[3] if len(xs) > 3 else 0.0
        self.y3: float = ys[3] if len(ys) > 3 else 0.0
        self.motion: int = motion
