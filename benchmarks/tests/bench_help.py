"""What the tests of the benchmarks share: a place for results, and small scenes."""

import csv

from benchmarks.output import Output
from exactpt import Body, Rigid, Scene, Translation
from exactpt.testing import Moving


class Results:
    """An output, and what was said."""

    def __init__(self, folder):
        self.said = []
        self.output = Output(folder, self.said.append, lambda _: None)
        self.folder = folder

    def rows(self, name):
        with (self.folder / f"{name}.csv").open(encoding="utf-8", newline="") as file:
            return list(csv.DictReader(file))

    def names(self):
        return [path.name for path in self.output.written]


def box(x, y, size=2):
    return [(x, y), (x + size, y), (x + size, y + size), (x, y + size)]


def square(left, low, size=1.0, **motion):
    """A square of a question, with its translation."""
    corners = ((left, low), (left + size, low), (left + size, low + size), (left, low + size))
    return Moving(corners, **motion)


def meeting(gap=6, speed=2):
    """Two boxes that meet after gap / speed."""
    return Scene(
        [Body("a", box(0, 0)), Body("b", box(2 + gap, 1), Translation([0, -speed]))], (0, 10)
    )


def passing():
    """Two boxes that pass a unit apart."""
    return Scene([Body("a", box(0, 0)), Body("b", box(8, 3), Translation([0, -2]))], (0, 10))


def turning():
    return Scene([Body("a", box(0, 0)), Body("b", box(8, 3), Rigid([0, 1]))], (0, 1))


def closing_jaw():
    """One body whose upper jaw comes down on the lower one at t = 2."""
    upper = [{"x": [x], "y": [y, -1]} for x, y in [(0, 3), (4, 3), (4, 4), (-1, 4)]]
    lower = [{"x": [x], "y": [y]} for x, y in [(-1, 0), (4, 0), (4, 1), (0, 1)]]
    return Scene([Body("jaw", [*lower, *upper])], (0, 5))


def thrown():
    """A box thrown up that comes down on another at t = 5, on a parabola."""
    ball = Body("ball", box(0, 2), Translation([0], [0, 4, -1]))
    return Scene([Body("ground", box(-1, -7, 4)), ball], (0, 10))


def segments_and_points():
    """A point that hits a segment at t = 3, and a chain out of the way."""
    return Scene(
        [
            Body("point", [(0, 0)], Translation([0, 1])),
            Body("segment", [(3, -1), (3, 1)]),
            Body("chain", [(9, 9), (10, 10), (11, 9)], closed=False),
        ],
        (0, 10),
    )
