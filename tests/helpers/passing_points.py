"""A point that passes another beside a chain, so that it takes over the other's fan."""

from exactpt import Body, Scene, Translation

LEFT = Translation([0, -1], [0])


def passing():
    """Point q passes below p, beside the chain t, m, n, b: Figure 4 (ii) of the paper.

    At t the point q is at (9 - t, 0).
    """
    places = {"b": (0, 0), "t": (1, 10), "m": (3, 7), "n": (2, 3), "p": (8, 13)}
    at_rest = [Body(name, [place]) for name, place in places.items()]
    return Scene([*at_rest, Body("q", [(9, 0)], LEFT)], (0, 2))


def pair(edge):
    """An edge of points with names of one letter, in the order of the letters."""
    return "".join(sorted(end.partition(":")[0] for end in edge))
