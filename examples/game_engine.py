"""A time of impact of a game engine under test: swept separating axes, with one mistake.

`toi` is made for convex polygons that move linearly, so only these are put to it. It takes the axes
of one body alone: `check` finds that, and writes the smallest counterexamples as a pytest file.
"""

import argparse
from pathlib import Path

from exactpt.testing import LINEAR, Moving, Question, check


def axes(body: Moving) -> list[tuple[float, float]]:
    """The normals of the edges of a polygon."""
    corners = body.vertices
    ends = [*corners[1:], corners[0]]
    return [(b[1] - a[1], a[0] - b[0]) for a, b in zip(corners, ends, strict=True)]


def swept(question: Question, normals: list[tuple[float, float]]) -> float | None:
    """When the projections on all normals overlap for the first time; None if they never do."""
    a, b = question.a, question.b
    vx, vy = a.velocity[0] - b.velocity[0], a.velocity[1] - b.velocity[1]
    low, high = question.time
    ax, ay, bx, by = (next(iter(f), 0.0) for f in (a.x, a.y, b.x, b.y))
    for nx, ny in normals:
        p = [nx * (x + ax) + ny * (y + ay) for x, y in a.vertices]
        q = [nx * (x + bx) + ny * (y + by) for x, y in b.vertices]
        speed = nx * vx + ny * vy
        before, after = min(q) - max(p), max(q) - min(p)
        if speed == 0 and (before > 0 or after < 0):
            return None
        if speed != 0:
            enter, leave = sorted((before / speed, after / speed))
            low, high = max(low, enter), min(high, leave)
    return low if low <= high else None


def toi_one_sided(question: Question) -> float | None:
    """The mistake: axes of the first body alone."""
    return swept(question, axes(question.a))


def toi(question: Question) -> float | None:
    """Axes of both bodies."""
    return swept(question, [*axes(question.a), *axes(question.b)])


def main() -> None:
    """Check both, and write the tests for the wrong one into a file, if one is named."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("tests", type=Path, nargs="?", help="the pytest file to write")
    given = parser.parse_args()
    wrong = check(toi_one_sided, cases=400, families=LINEAR, accept=lambda q: q.convex)
    print(wrong)
    if given.tests is not None:
        given.tests.write_text(wrong.pytest_file())
    print(check(toi, cases=400, families=LINEAR, accept=lambda q: q.convex))


if __name__ == "__main__":
    main()
