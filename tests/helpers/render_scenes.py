"""Scenes for the tests of pictures."""

from importlib.resources import files

from exactpt import Body, Rigid, Scene, Translation
from exactpt.scene.format import loads


def demo():
    return loads((files("exactpt") / "data" / "demo.json").read_text(encoding="utf-8"))


def small():
    """A box that meets a turning bar at t = 3, and a triangle far away; all convex."""
    box = Body("box", [(0, 0), (2, 0), (2, 1), (0, 1)], Translation([0, 1]))
    wall = Body("wall", [(5, -3), (6, -3), (6, 3), (5, 3)])
    wheel = Body("wheel", [(0, 6), (2, 6), (1, 8)], Rigid(pivot=(1, 7), half_turn=[0, "1/3"]))
    return Scene([box, wall, wheel], time=(0, 10))


def apart():
    """Two bodies that never meet, one named so that markup would break."""
    first = Body('<a&b"]]>', [(0, 0), (1, 0), (0, 1)], Translation([0, "-1/2"]))
    second = Body("dot", [(3, 3)])
    third = Body("stick", [(3, -1), (4, -2)])
    return Scene([first, second, third], time=(0, 4))


def rebuilt():
    """A square that passes an upright chain, all of whose vertices are on one vertical line."""
    square = [("-11/10", 0), ("-21/10", 1), ("-31/10", 0), ("-21/10", -1)]
    chain = Body("chain", [(-3, -2), (-3, -3), (-3, -4)], closed=False)
    return Scene([Body("square", square, Translation([0, -2], [0, -2])), chain], time=(0, 2))


def overlapping():
    first = Body("first", [(0, 0), (2, 0), (0, 2)])
    second = Body("second", [(1, "-1/2"), (3, "-1/2"), (1, 1)])
    return Scene([first, second], time=(0, 1))
