"""Straight motions of many bodies: from arrays, from doubles and from rationals alike."""

from random import Random

import numpy as np
import pytest

from exactpt import Body, Scene, Translation, first_contact

SIZE = 24


def drawn(rng, *, rounded=False):
    """Vertices, offsets, coefficients, closed and radii of bodies on a small grid."""
    vertices, offsets, coefficients, closed, radii = [], [0], [], [], []
    for k in range(SIZE):
        x, y = 6 * (k % 6), 6 * (k // 6)
        count = rng.choice([1, 2, 3, 3, 4])
        corners = [(0, 0), (3, 0), (3, 3), (0, 3)][:count]
        is_closed = rng.random() < 0.7
        if is_closed and count == 4 and rng.random() < 0.5:
            corners.append((0, 0))  # repeats the first one
        vertices += [(x + u, y + v) for u, v in corners]
        offsets.append(len(vertices))
        scale = rng.choice([1, 0.1])
        coefficients.append(
            [[0, rng.randint(-2, 2) * scale, 0], [rng.choice([0, 0, 0.5]), rng.randint(-2, 2), 0]]
        )
        closed.append(is_closed)
        radii.append(rng.choice([0, 0.25, 1]) if rounded else 0)
    return vertices, offsets, coefficients, closed, radii


def one_by_one(vertices, offsets, coefficients, closed, radii, *, exact):
    """The same scene of bodies given one by one; ``exact``: of rational texts."""
    number = (lambda v: str(exact_fraction(v))) if exact else (lambda v: v)
    bodies = []
    for k in range(SIZE):
        points = [tuple(map(number, p)) for p in vertices[offsets[k] : offsets[k + 1]]]
        x, y = ([number(c) for c in f] for f in coefficients[k])
        bodies.append(
            Body(str(k), points, Translation(x, y), closed=closed[k], radius=number(radii[k]))
        )
    return Scene(bodies, (0, 5))


def exact_fraction(value):
    numerator, denominator = float(value).as_integer_ratio()
    return f"{numerator}/{denominator}"


def answer(scene):
    contact = first_contact(scene)
    return contact and contact.to_json()


@pytest.mark.parametrize("rounded", [False, True])
@pytest.mark.parametrize("seed", range(12))
def test_one_answer_however_the_bodies_are_given(seed, rounded):
    vertices, offsets, coefficients, closed, radii = drawn(Random(seed), rounded=rounded)
    arrays = Scene.from_arrays(
        vertices, offsets, coefficients=coefficients, closed=closed, radii=radii, time=(0, 5)
    )
    given = (vertices, offsets, coefficients, closed, radii)

    answers = [
        answer(s) for s in (arrays, one_by_one(*given, exact=False), one_by_one(*given, exact=True))
    ]

    assert answers[0] == answers[1] == answers[2]
    assert answers[0] == answer(Scene(list(arrays.bodies), (0, 5)))


def test_only_bodies_that_come_near_are_made():
    corners = np.array([(0.0, 0.0), (1.0, 0.0), (0.0, 1.0)])
    places = np.array([(10.0 * i, 10.0 * j) for i in range(20) for j in range(20)])
    vertices = (corners[None] + places[:, None]).reshape(-1, 2)
    velocities = np.zeros((400, 2))
    velocities[0] = (5.0, 0.1)
    scene = Scene.from_arrays(vertices, range(0, 1201, 3), velocities=velocities, time=(0, 10))

    contact = first_contact(scene)

    assert {pair.body for pair in contact.pairs} | {pair.other for pair in contact.pairs} == {
        "0", "20"
    }  # fmt: skip
    assert len(scene.bodies._made) <= 4


@pytest.mark.parametrize("form", ["arrays", "doubles", "rationals"])
@pytest.mark.parametrize("axis", [0, 1])
def test_bug_a_radius_that_is_lost_far_away_still_counts(form, axis):
    """Doubles are 1/8 apart there: a box grown by a radius of 1/20 was the box of the core."""
    far = 10.0**15
    at = [(far, 0.0), (far + 0.125, 0.0), *((0.0, 20.0 + k) for k in range(12))]
    motions = [([0, 0], [0, 0]), ([-0.03, 0], [-4, 1]), *[([0, 0], [0, 0])] * 12]
    if axis:
        at, motions = [p[::-1] for p in at], [m[::-1] for m in motions]
    if form == "arrays":
        scene = Scene.from_arrays(
            at, range(len(at) + 1), coefficients=motions, radii=[0.05] * len(at), time=(0, 8)
        )
    else:
        number = (lambda v: v) if form == "doubles" else exact_fraction
        scene = Scene(
            [
                Body(
                    str(k),
                    [tuple(map(number, p))],
                    Translation(*(list(map(number, f)) for f in m)),
                    radius=number(0.05),
                )
                for k, (p, m) in enumerate(zip(at, motions, strict=True))
            ],
            (0, 8),
        )

    contact = first_contact(scene)

    assert contact is not None
    assert contact.time == first_contact(scene, exact_only=True).time
