"""Bodies that spin far from all others: no piece of their motion is made."""

from collections import Counter
from fractions import Fraction
from random import Random

import pytest

from exactpt import Body, Rigid, Scene, Spin, Translation, first_contact, first_within
from exactpt.filters.rows import TURNING, WAITING
from exactpt.motion.motions import REST
from exactpt.search.query import Selection
from exactpt.search.reading import rows_of
from exactpt.search.sweep_search import SweepSearch, pairs_that_count


def blade(name, at, omega, end=20, **options):
    x, y = at
    spin = Spin(omega, (x, y), error="1/50", **options)
    return Body(name, [(x, y), (x + 3, y), (x + 3, y + 4)], spin)


def post(name, x, motion=REST):
    return Body(name, [(x, -1), (x + 1, 0), (x, 1)], motion)


def searched(scene, groups=(), *, with_all_pieces=False):
    """The contact of a search, and how many rows of each kind of motion it has made."""
    rows = rows_of(scene.bodies, scene.exact_start, scene.exact_end)
    if with_all_pieces:
        rows.make_all_pieces()
    pairs = pairs_that_count(rows, Selection(scene, None, groups))
    contact = SweepSearch(scene, rows, pairs).run_to_contact()
    return contact, Counter(rows.table.kind)


def test_spins_that_are_far_from_all_others_are_not_followed(monkeypatch):
    """Each piece of each body was a slab of time for all."""
    tracks, track = [], Rigid.track
    monkeypatch.setattr(Rigid, "track", lambda *a: tracks.append(1) or track(*a))
    bodies = [blade(f"b{i}", (11 * i, 0), 1) for i in range(4)]

    contact, kinds = searched(Scene([*bodies, post("post", -8)], (0, 20)))
    assert contact is None
    assert (kinds[WAITING], kinds[TURNING]) == (4, 0)
    assert len(tracks) <= 3 * len(bodies)  # of the start
    contact, kinds = searched(Scene([*bodies, post("post", -4)], (0, 20)))
    assert {contact.pairs[0].body, contact.pairs[0].other} == {"b0", "post"}
    assert kinds[WAITING] == 4
    assert kinds[TURNING] >= 1


def test_pieces_are_made_up_to_the_slab_of_the_contact():
    """A blade of 5 about (0, 0), turning by 1, meets a post at (-9/2, 0) within its first turn."""
    blades = [blade("b", (0, 0), 1, 200)]
    _, whole = searched(Scene(blades, (0, 200)), with_all_pieces=True)

    contact, kinds = searched(Scene([*blades, post("post", Fraction(-9, 2))], (0, 200)))

    assert contact.time < 7
    assert 1 <= kinds[TURNING] < whole[TURNING] / 10


@pytest.mark.parametrize(
    "x, options, motion, is_near",
    [
        ("11/2", {}, REST, False),  # farther than the farthest vertex
        (5, {}, REST, True),  # its distance, which a vertex has at some time
        ("26/5", {}, REST, False),
        (6, {"x": [0, "1/10"]}, REST, True),
        (6, {}, Translation([0, "-1/10"]), True),
        (6, {}, Translation([0, "-1/24"]), False),
        (6, {"x": [0, 0, 1]}, REST, True),
        (6, {}, Rigid([0, 1], pivot=(6, 0)), True),
    ],
)
def test_the_whole_span_counts(x, options, motion, is_near):
    bodies = [blade("b", (0, 0), 1, **options), post("post", Fraction(x), motion)]
    wide = [body.with_radius("1/8") for body in bodies]
    assert has_pieces(bodies) == is_near
    assert has_pieces(wide) == (x != "11/2")


def has_pieces(bodies):
    """Whether pieces of the first body are made in a search."""
    scene = Scene(bodies, (0, 20))
    rows = rows_of(scene.bodies, scene.exact_start, scene.exact_end)
    SweepSearch(scene, rows, pairs_that_count(rows, Selection(scene))).run_to_contact()
    return list(rows.table.body).count(0) > 1


def test_contacts_are_those_of_bodies_with_all_their_pieces():
    random, found = Random("spins"), []
    for _ in range(4):
        bodies = [blade(f"b{i}", (12 * i, 0), random.choice([-2, -1, 1, 2]), 2) for i in range(3)]
        x = 12 * random.randint(0, 2) + random.randint(-5, 5)
        bodies.insert(1, post("post", x, Translation([0, "1/5"])))
        scene = Scene(bodies, (0, 2))
        groups = [["b0", "post"]] if random.random() < 0.5 else []

        contact, kinds = searched(scene, groups)
        expected, all_kinds = searched(scene, groups, with_all_pieces=True)

        assert contact == expected == first_contact(scene, ignoring=groups)
        assert kinds[TURNING] <= all_kinds[TURNING]
        found.append(contact)
    assert len({contact.time for contact in found if contact}) > 1


@pytest.mark.parametrize(("corner", "distance"), [((-2.5, -2.5), 2), ((-1, -1), 0.5)])
def test_bug_a_distance_was_forgotten_by_rows_that_wait(corner, distance):
    """Pieces of a spin that are made during a search are as near as those of `pieces_during`."""
    x, y = corner
    blade = Body("blade", [(0, 0), (2, 0), (2, 0.5), (0, 0.5)], Spin(1, error="1/1000"))
    wall = Body("wall", [corner, (x - 1.5, y - 2.5), (x - 2.5, y - 1.5)])
    in_pieces = blade.with_motion(blade.motion.pieces_during(0, 7))
    expected = first_within(Scene([in_pieces, wall], (0, 7)), distance=distance)

    approach = first_within(Scene([blade, wall], (0, 7)), distance=distance)

    assert approach == expected
    assert approach is not None


def test_bug_details_of_a_late_contact_made_all_pieces_before_it():
    """A point comes to a wheel of radius 1 from x = -1000, a thousandth at a time: near t = 10^6.

    Its incidence asked for all breakpoints up to that time, and there were too many.
    """
    wheel = Body("wheel", [(0, 0), (1, 0)], Spin(1, error="1/1000"))
    point = Body("point", [(-1000, 0)], Translation([0, "1/1000"]))

    contact = first_contact(Scene([wheel, point], (0, 10**6)))

    (pair,) = contact.pairs
    assert 999_000 <= contact.time <= 10**6
    assert (pair.body, pair.other, pair.edge) == ("point", "wheel", 0)
