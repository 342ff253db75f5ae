"""Planted mistakes: each is made and undone; scenes by hand for some of those that once escaped.

The sixteen mistakes of strangers escaped in part, since no scene had awkward numbers, no law knew
the last double, and only some questions were asked. `python -m fuzz power` hunts them all.
"""

import math
from fractions import Fraction
from random import Random

import pytest

from exactpt import (
    Body,
    BudgetExceeded,
    Pieces,
    Scene,
    Translation,
    clearance,
    first_contact,
)
from exactpt.kernel.numbers import QQ
from exactpt.search import reading
from exactpt.search.reading import rows_of
from exactpt.testing import ending_at
from exactpt.testing.scenes import FAMILIES, generate
from fuzz.changes.awkward import SUFFIX, awkward, awkward_variant
from fuzz.changes.excerpts import scene_of
from fuzz.changes.variants import VARIANTS, difference, expected_time
from fuzz.planted import PLANTED
from fuzz.power.edits import Edit

pytestmark = pytest.mark.plain


@pytest.mark.parametrize("bug", PLANTED)
def test_mistake_is_made_and_undone(bug):
    """Each text that is replaced is still there, once; afterwards the function is as it was."""
    scene = generate("row", 2)
    before = first_contact(scene).to_json()

    with PLANTED[bug].made():
        pass

    assert first_contact(scene).to_json() == before
    assert PLANTED[bug].kind.endswith(".")


def test_edited_function_is_wrong_for_those_who_imported_it_too():
    """This module has `rows_of` by name: a patch of `reading` would not reach it."""
    point = Body("point", [(0, 0)])

    with Edit(reading, "rows_of", "is_exact = plain.add_all()", "is_exact = True").made():
        assert rows_of([point], QQ(0), QQ(1)).table.count() == 0
    assert rows_of([point], QQ(0), QQ(1)).table.count() == 1


# What a test by hand shows best. The right values are derived in each docstring.


def pairs_that_meet_before_0(time):
    """Six pairs of points; those of one pair are in one place at one time, the others never.

    a = (t / 3, t / 7), b = a + (t - time) (1/7, 1/9) / 10^9: the difference is 0 at that time only.
    The points of the other pairs are 9 apart in x, and their difference moves by less than 1.
    """
    bodies = []
    for k in range(6):
        u, v = Fraction(1, 7 * 10**9), Fraction(1, 9 * 10**9)
        x, y = (0 if k == 0 else 9) - u * time, 40 * k - v * time
        bodies.append(Body(f"a{k}", [(0, 40 * k)], Translation([0, "1/3"], [0, "1/7"])))
        motion = Translation([0, Fraction(1, 3) + u], [0, Fraction(1, 7) + v])
        bodies.append(Body(f"b{k}", [(x, y)], motion))
    return Scene(bodies, (-(10**9), 0))


def test_first_contact_long_before_0_of_equal_velocities_in_thirds_is_found():
    """At t = -10^9 + 10^6 the only two points meet; velocities are off by U / 3 times 10^9."""
    time = -(10**9) + 10**6
    scene = pairs_that_meet_before_0(time)

    assert first_contact(scene, method="pairs").time == time


def test_below_the_least_distance_is_a_single_time():
    """A point passes the origin along y = 1: it is at the distance 1 at t = 2 only, x = t - 2."""
    bodies = [Body("o", [(0, 0)]), Body("p", [(-2, 1)], Translation([0, 1]))]
    gap = clearance(Scene(bodies, (0, 4)), "o", "p")

    assert [(i.start, i.end) for i in gap.below(1)] == [(2, 2)]
    with PLANTED["single times left out"].made():
        assert gap.below(1) == ()


def relay_of_three():
    """Boxes in cells: the first touches its wall at t = 1/3, when the others turn back.

    A tip at x = -u (1/3 - t) is at the wall x = 0 at t = 1/3 in the first cell, and 1/100 before it
    in the others, where the triangle of the wall leaves room; from 1/3 on all of them go back.
    """
    bodies, time = [], Fraction(1, 3)
    for k in range(7):
        y, gap = 10 * k, 0 if k == 0 else Fraction(1, 100)
        bodies.append(Body(f"wall{k}", [(0, y), (1, y + 2), (0, y + 4), (2, y + 4), (2, y)]))
        x = 1 - gap - time
        there, back = Translation([0, 1]), Translation([2 * time, -1])
        shape = [(x, y + 2), (x - 1, y + 2 + Fraction(1, 8)), (x - 1, y + 2 - Fraction(1, 8))]
        bodies.append(Body(f"box{k}", shape, Pieces([(time, there), (None, back)])))
    return Scene(bodies, (0, 1))


def reached_at_each_look(scene):
    """What a search has reached, if its time is over at its first, second, ... look."""
    with ending_at(None) as whole:
        first_contact(scene, method="pairs", max_seconds=1.0)
    for look in range(1, whole.looks + 1):
        with ending_at(look):
            try:
                first_contact(scene, method="pairs", max_seconds=1.0)
            except BudgetExceeded as spent:
                yield spent.reached


def test_search_that_is_ended_at_any_look_has_reached_less_than_the_contact():
    """The contact is at 1/3; the double below it is the last that may be reached."""
    reached = {r for r in reached_at_each_look(relay_of_three()) if r is not None}

    assert reached
    assert max(reached) < Fraction(1, 3)
    with PLANTED["no contact for a double too long"].made():
        wrong = {r for r in reached_at_each_look(relay_of_three()) if r is not None}
    assert max(wrong) == Fraction(math.nextafter(1 / 3, 1)) > Fraction(1, 3)


TOGETHER = Translation([0.0, 1.0], [0.0, 1.0])
"""One unit in x and in y in each unit of time: along the line of a slider."""


def slider(motion):
    """A chain along the line x = y, with its tip at (2, 2); numbers are doubles."""
    return Body("slider", [(0.0, 0.0), (1.0, 1.0), (2.0, 2.0)], motion, closed=False)


def corner(c):
    """A chain with its end at (c, c), which leads around the slider, so that boxes intersect."""
    return Body("corner", [(c, c), (c + 1.0, 0.0), (1.0, -1.0)], closed=False)


def test_slider_that_turns_back_before_a_corner_has_no_contact():
    """Its tip is at (3, 3) at t = 1, where it turns back, and would be at (4, 4) at t = 2."""
    back = Translation([2.0, -1.0], [2.0, -1.0])
    scene = Scene([slider(Pieces([(1, TOGETHER), (None, back)])), corner(4.0)], (0, 3))

    assert first_contact(scene) is None


def test_contact_before_that_of_a_slider_in_the_first_slab_is_the_first():
    """The tip is at (40, 40) at t = 38. A point comes from x = -20 to the post at x = -10, t = 10.

    Four points fly past, so that the first slab ends before 10.
    """
    flying = [(-50.0, 0.0, -9.0), (90.0, 0.0, 9.0), (-50.0, 1.0, -9.0), (90.0, 1.0, 9.0)]
    bodies = [
        slider(TOGETHER),
        corner(40.0),
        Body("point", [(-20.0, 0.0)], Translation([0.0, 1.0])),
        Body("post", [(-10.0, -1.0), (-10.0, 1.0)], closed=False),
        *(Body(f"{x}, {y}", [(x, y)], Translation([0.0, v])) for x, y, v in flying),
    ]
    scene = Scene(bodies, (0, 100))

    assert first_contact(scene).time == 10
    with PLANTED["a contact after the slab taken for the first"].made():
        assert first_contact(scene).time == 38


@pytest.mark.parametrize("radius", ["1/3", "1/7", str(10**400), f"1/{10**400}", "5/13"])
def test_radius_rounded_down_excludes_no_pair(radius):
    """See `fuzz.planted`: the margins of boxes contain what is missing, so no answer changes."""
    bodies = [
        Body(f"b{k}", [(10 * k, 0)], Translation([0, Fraction(k, 9)], [0, "1/3"]), radius=radius)
        for k in range(12)
    ]
    scene = Scene(bodies, (-90, 90))
    right = first_contact(scene, method="pairs")

    with PLANTED["a radius rounded down"].made():
        again = first_contact(scene, method="pairs")

    assert (again and again.to_json()) == (right and right.to_json())


# Awkward images


def test_awkward_number_of_a_scene_is_no_double():
    scene = awkward(generate("convex", 1), Random(3))

    numbers = [c for body in scene.bodies for v in body.at(scene.start) for c in v]
    assert sum(QQ(float(c)) == c for c in numbers) < len(numbers) / 10


def test_awkward_scene_of_a_family_is_named_and_repeated():
    name = f"turning{SUFFIX}"

    first, again, plain = scene_of(name, 5), scene_of(name, 5), scene_of("turning", 5)
    assert first == again
    assert first != plain
    assert len(first.bodies) == len(plain.bodies)


@pytest.mark.parametrize("family", [*FAMILIES][::4])
def test_contact_of_an_awkward_image_is_the_image_of_the_contact(family):
    variant = awkward_variant(Random(family))
    scene = scene_of(family, 2)
    image = variant.scene(scene)

    found = first_contact(image, exact_only=True)
    assert difference(variant, scene, first_contact(scene), found) is None


def test_expected_time_of_a_reversed_time_is_enclosed():
    """The time sqrt(2) of t^2 = 2 is at 3 - sqrt(2) = 1.5857... in the image: t' = 3 - t."""
    wall = Body("wall", [(0, 0), (0, 9)], closed=False)
    point = Body("p", [(-2, 1)], Translation([0, 0, 1]))
    time = first_contact(Scene([wall, point], (0, 3))).time
    backwards = VARIANTS["backwards"]

    image = expected_time(backwards, time)

    assert float(image) == -math.sqrt(2)
