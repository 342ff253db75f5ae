"""The float image of a track: the doubles next to its coefficients."""

from __future__ import annotations

from typing import final

__all__ = ["Image"]


@final
class Image:
    """The doubles next to the coefficients of a track, in a frame.

    Coefficients that are 0 or of size 2^-100 to 2^100 are the nearest doubles; if one
    is outside, ``x0`` and all others are NaN, which no filter accepts.

    Attributes:
        x0, ..., x3, y0, ..., y3: the coefficients of a track that translates, up to t^3;
            0 above its degree.
        xs, ys: all its coefficients, of one length; ``degree`` + 1 each.
        ws: the denominator's coefficients if the track turns, else empty (a constant
            denominator is divided out).
        degree: the degree of the path; of the numerators if it turns.
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
