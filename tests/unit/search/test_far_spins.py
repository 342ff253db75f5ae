"""Bodies that spin far from all others: no piece of their motion is made."""

from fractions import Fraction
from random import Random

import pytest

from exactpt import Body, Rigid, Scene, Spin, Translation, first_contact
from exactpt.motion.motions import REST
from exactpt.search import far_spins, features_sweep


def blade(name, at, omega, end=20, **options):
    x, y = at
    spin = Spin(omega, (x, y), error="1/50", **options)
    return Body(name, [(x, y), (x + 3, y), (x + 3, y + 4)], spin)


def post(name, x, motion=REST):
    return Body(name, [(x, -1), (x + 1, 0), (x, 1)], motion)


def test_spins_that_are_far_from_all_others_are_not_followed(monkeypatch):
    """Each piece of each body was a slab of time for all."""
    tracks, track = [], Rigid.track
    monkeypatch.setattr(Rigid, "track", lambda *a: tracks.append(1) or track(*a))
    bodies = [blade(f"b{i}", (11 * i, 0), 1) for i in range(4)]

    assert first_contact(Scene([*bodies, post("post", -8)], (0, 20))) is None
    of_the_start = len(tracks)
    assert of_the_start <= 3 * len(bodies)
    contact = first_contact(Scene([*bodies, post("post", -4)], (0, 20)))
    assert {contact.pairs[0].body, contact.pairs[0].other} == {"b0", "post"}
    assert len(tracks) > 3 * of_the_start


@pytest.mark.parametrize(
    "x, options, motion, count",
    [
        ("11/2", {}, REST, 0),  # farther than the farthest vertex
        (5, {}, REST, 2),  # its distance, which a vertex has at some time
        ("26/5", {}, REST, 0),
        (6, {"x": [0, "1/10"]}, REST, 2),
        (6, {}, Translation([0, "-1/10"]), 2),
        (6, {}, Translation([0, "-1/24"]), 0),
        (6, {"x": [0, 0, 1]}, REST, 2),  # a translation whose bounds are not known
        (6, {}, Rigid([0, 1], pivot=(6, 0)), 2),
    ],
)
def test_the_whole_span_counts(x, options, motion, count):
    bodies = [blade("b", (0, 0), 1, **options), post("post", Fraction(x), motion)]
    assert len(far_spins.bodies_near_others(Scene(bodies, (0, 20)))) == count
    wide = [body.with_radius("1/8") for body in bodies]
    assert len(far_spins.bodies_near_others(Scene(wide, (0, 20)))) == (0 if x == "11/2" else 2)


def test_contacts_are_those_of_all_bodies(monkeypatch):
    near, found = far_spins.bodies_near_others, []
    for leaves_out in (True, False):
        if not leaves_out:
            monkeypatch.setattr(
                features_sweep, "bodies_near_others", lambda scene: [*range(len(scene.bodies))]
            )
        random = Random("spins")
        for _ in range(4):
            bodies = [
                blade(f"b{i}", (12 * i, 0), random.choice([-2, -1, 1, 2]), 2) for i in range(3)
            ]
            bodies.insert(
                1,
                post(
                    "post",
                    12 * random.randint(0, 2) + random.randint(-5, 5),
                    Translation([0, "1/5"]),
                ),
            )
            scene = Scene(bodies, (0, 2))
            assert 2 <= len(near(scene)) <= 4
            groups = [["b0", "post"]] if random.random() < 0.5 else []
            found.append(first_contact(scene, ignoring=groups))
    assert found[:4] == found[4:]
    assert len({contact.time for contact in found if contact}) > 1
