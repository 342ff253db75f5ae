"""Definitions against each other: where a question has two, they agree, and a mistake is found."""

import sys
from contextlib import suppress
from functools import partial
from itertools import combinations
from random import Random

import mpmath
import pytest

from exactpt import AlgebraicNumber, Body, InputError, Scene, Spin
from exactpt.kernel.numbers import QQ, rational
from exactpt.testing import reference
from exactpt.testing.reference import (
    contact,
    features,
    new,
    paths,
    shapes,
    space,
    times,
    turning,
    within,
)
from exactpt.testing.reference.times import tracks_after
from exactpt.testing.scenes import FAMILIES, generate
from fuzz.laws.space import some_point
from fuzz.questions.rounded import rounded_pair
from fuzz.questions.scenes import crowded_scene, distant_scene
from fuzz.questions.tiny import pair_scene, touching_scene
from fuzz.references.true_turns import DIGITS, Truth, real

TINY = (pair_scene, touching_scene, crowded_scene, distant_scene, rounded_pair)


def family_scene(random):
    """A few bodies of a family, with at most nine vertices."""
    while True:
        scene = generate(random.choice(sorted(FAMILIES)), random.getrandbits(20))
        bodies = random.sample(scene.bodies, min(2, len(scene.bodies)))
        if sum(body.size for body in bodies) <= 9:
            return Scene(bodies, scene.time)


def deforming_body(random):
    """A polygon or a chain of which each vertex has a motion of its own."""
    while True:
        vertices = [
            {axis: [random.randint(-4, 4), random.randint(-2, 2)] for axis in "xy"}
            for _ in range(random.randint(3, 5))
        ]
        body = Body("a", vertices, closed=random.random() < 0.5)
        with suppress(InputError):  # it is not simple at the start
            return Scene([body], (0, 4)).bodies[0]


def some_scene(random):
    return random.choice([*TINY, family_scene])(random)


def some_pair(random, makers=TINY):
    """Two bodies of a scene, and its time span."""
    while True:
        scene = random.choice(makers)(random)
        if len(scene.bodies) > 1:
            return *random.sample(scene.bodies, 2), scene.time


def some_time(random, span):
    start, end = map(rational, span)
    return start + (end - start) * QQ(random.randint(0, 12), 12)


def first_contacts_agree(random):
    """Every vertex against every edge, and bodies as sets at and between critical times."""
    scene = some_scene(random)
    by_features, by_sets = reference.first_contact(scene), reference.first_meeting(scene)
    assert (by_features and (by_features.time, by_features.names)) == by_sets
    return by_sets is not None


def self_contacts_agree(random):
    alone = Scene([deforming_body(random)], (0, 4))
    by_features, by_sets = reference.first_contact(alone), reference.first_meeting(alone)
    assert (by_features and (by_features.time, by_features.names)) == by_sets
    for t in (QQ(k, 4) for k in range(17)):
        if not is_simple(alone.bodies[0], t):
            assert by_features is not None
            assert by_features.time <= t
    return by_sets is not None


def is_simple(body, t):
    """Whether edges without a common end are apart, and have a length."""
    points = body.exact_at(t)
    return all(points[i] != points[j] for i, j in body.edges) and not any(
        shapes.segments_meet(*(points[i] for i in (*e, *f)))
        for e, f in combinations(body.edges, 2)
        if not set(e) & set(f)
    )


def incidences_are_features_at_the_distance_of_contact(random):
    """Of two bodies in contact at a rational time that do not overlap."""
    a, b, span = some_pair(random, (touching_scene, pair_scene, rounded_pair))
    scene = Scene([a, b], span)
    first = reference.first_contact(scene, between=[(a.name, b.name)])
    if first is None or not first.time.is_rational:
        return False
    t = first.time.exact_low
    distance = reference.nearest(a, b, t)
    reach = a.radius + b.radius
    if distance.core_squared != reach**2:  # they overlap
        assert distance.core_squared < reach**2
        assert reach == 0 or not first.incidences
        return False
    found = {(i.body, i.vertex, i.edge, i.other_vertex) for i in first.incidences}
    expected = {
        (a.name, p.vertex, q.edge, q.vertex)
        if p.vertex is not None
        else (b.name, q.vertex, p.edge, None)
        for p, q in distance.features
    }
    assert found == expected
    return bool(found)


def contacts_are_distances_of_zero(random):
    a, b, span = some_pair(random, (pair_scene, touching_scene))
    found = reference.contact_intervals(a, b, span)
    assert found == reference.intervals_within(a, b, span, 0)
    return bool(found)


def a_first_approach_is_the_start_of_an_interval(random):
    a, b, span = some_pair(random, (distant_scene, pair_scene, rounded_pair))
    squared = QQ(random.choice([0, 1, 2, 4, 5]), random.choice([1, 2, 9]))
    found = reference.intervals_within(a, b, span, squared)
    first = reference.first_within(a, b, span, squared)
    assert first == (found[0][0] if found else None)
    return first is not None


def bodies_are_within_their_distance_and_no_less(random):
    a, b, span = some_pair(random)
    t = some_time(random, span)
    squared = rational(reference.nearest(a, b, t).core_squared)
    ask = partial(within.is_within, AlgebraicNumber(t), a, b, *tracks_after(a, b, t))
    assert ask(squared)
    assert squared == 0 or not ask(squared * (1 - QQ(1, 10**30)))
    return squared > 0


def the_least_distance_is_reached_and_no_less(random):
    a, b, span = some_pair(random, (distant_scene, pair_scene))
    time, squared = reference.least_distance(a, b, span)
    squared = squared.simplified()
    if squared.is_rational:
        assert reference.first_within(a, b, span, squared.exact_low) == time
    while squared.exact_high - squared.exact_low > QQ(1, 10**30):
        squared.refine()
    below = squared.exact_low - (QQ(1, 10**30) if squared.is_rational else 0)
    assert below < 0 or reference.first_within(a, b, span, below) is None
    assert reference.first_within(a, b, span, squared.exact_high) is not None
    return squared.exact_low > 0


def points_and_polynomials_tell_the_same_of_a_rational_time(random):
    a, b, span = some_pair(random)
    t = some_time(random, span)
    by_points = shapes.bodies_meet(a, a.exact_at(t), b, b.exact_at(t))
    by_signs = features.bodies_meet(AlgebraicNumber(t), a, b, *tracks_after(a, b, t))
    assert by_points == by_signs
    return by_points


def a_new_contact_is_the_first_one_if_there_is_none_at_the_start(random):
    scene = some_scene(random)
    first = reference.first_contact(scene)
    if first is not None and first.kind == "initial":
        return False
    assert reference.first_new_contact(scene) == (first and (first.time, first.names))
    return first is not None


def bodies_that_overlap_share_a_point(random):
    """They overlap at a rational time only if they meet; with distance they do not."""
    a, b, span = some_pair(random, (pair_scene, touching_scene))
    t = some_time(random, span)
    overlap = reference.overlap(a, b, t)
    assert overlap == reference.overlap(b, a, t)
    crossing = any(
        shapes.segments_cross(p, q, u, v) for p, q in edges_at(a, t) for u, v in edges_at(b, t)
    )
    assert crossing <= overlap <= (reference.nearest(a, b, t).core_squared == 0)
    return overlap


def edges_at(body, t):
    points = body.exact_at(t)
    return [(points[i], points[j]) for i, j in body.edges]


def inside_by_windings_is_inside_by_crossings(random):
    scene = some_scene(random)
    places = space.points_of(scene, scene.start)
    p = some_point(random, places)
    owner, inside = space.owner(p, places), False
    for body in scene.bodies:
        points = places[body.name]
        at_edge = any(shapes.is_on_segment(p, a, b) for _, a, b in space.edges_of(points))
        is_there = p in points or at_edge or shapes.is_inside(p, body, points)
        alone = space.owner(p, {body.name: points})
        assert (alone is not None) == is_there
        inside = inside or is_there
    assert (owner is not None) == inside
    return inside


def a_segment_is_free_if_a_ray_gets_to_its_end(random):
    scene = some_scene(random)
    places = space.points_of(scene, scene.start)
    p, q = some_point(random, places), some_point(random, places)
    if p == q or space.owner(p, places) is not None:
        return False
    hit = space.first_hit(p, (q[0] - p[0], q[1] - p[1]), places)
    if hit is None or hit.at > 1:
        assert not space.crosses(p, q, places)
        straight = paths.shortest_length(places, p, q)
        assert straight.may_be(paths.length_of([p, q]))
    else:
        if hit.edge is not None and hit.at < 1:
            assert space.crosses(p, q, places)
        here = tuple(p[k] + hit.at * (q[k] - p[k]) for k in (0, 1))
        assert space.owner(here, places) is not None
        before = tuple((p[k] + here[k]) / 2 for k in (0, 1))
        assert space.owner(before, places) is None
    return hit is not None


def a_spin_turns_by_its_angle_within_its_error(random):
    """By rationals and by mpmath to 600 bits; the pieces of its motion up to its stated error."""
    pivot = tuple(QQ(random.randint(-6, 6), random.choice([1, 3])) for _ in "xy")
    omega = QQ(random.randint(-9, 9) or 1, random.choice([1, 2, 7]))
    error = QQ(1, random.choice([10, 1000, 10**6]))
    shape = [(random.randint(-9, 9), random.randint(-9, 9)) for _ in range(2)]
    if shape[0] == shape[1]:
        return False
    body = Body("a", shape, Spin(omega, pivot, error=error))
    t = some_time(random, (0, 4))
    places = turning.turned(shape, pivot, omega * t, bits=600)
    with mpmath.workdps(DIGITS + 20):
        (true,) = Truth(Scene([body], (0, 4))).bodies
        for (x, y), exact in zip(places, true.places(real(t)), strict=True):
            assert abs(mpmath.mpc(real(x), real(y)) - exact) < mpmath.mpf(2) ** -590
    for (x, y), (u, v), at in zip(places, body.at(t), shape, strict=True):
        arm = shapes.squared_distance(at, pivot)
        assert (x - u) ** 2 + (y - v) ** 2 <= arm * error**2 + QQ(1, 2**500)
    return t > 0


LAWS = {
    law.__name__: law
    for law in (
        first_contacts_agree,
        self_contacts_agree,
        incidences_are_features_at_the_distance_of_contact,
        contacts_are_distances_of_zero,
        a_first_approach_is_the_start_of_an_interval,
        bodies_are_within_their_distance_and_no_less,
        the_least_distance_is_reached_and_no_less,
        points_and_polynomials_tell_the_same_of_a_rational_time,
        a_new_contact_is_the_first_one_if_there_is_none_at_the_start,
        bodies_that_overlap_share_a_point,
        inside_by_windings_is_inside_by_crossings,
        a_segment_is_free_if_a_ray_gets_to_its_end,
        a_spin_turns_by_its_angle_within_its_error,
    )
}
"""Each returns whether the case says much: a contact, a distance, a point inside."""


@pytest.mark.long(
    "a_first_approach_is_the_start_of_an_interval-40",
    "contacts_are_distances_of_zero-40",
    "first_contacts_agree-40",
    "the_least_distance_is_reached_and_no_less-40",
)
@pytest.mark.parametrize("count", [40, pytest.param(2000, marks=pytest.mark.slow)])
@pytest.mark.parametrize("law", LAWS)
def test_two_definitions_of_one_question_agree(law, count):
    said = [LAWS[law](Random(f"{law} {k}")) for k in range(count)]

    assert count / 10 <= sum(said)
    assert not all(said)


# Mistakes in the definitions


def backwards(angle, bits):
    """The cosine and the sine of minus an angle."""
    return COSINE_AND_SINE(-angle, bits)


COSINE_AND_SINE = turning.cosine_and_sine


def never(*_):
    return False


def always(*_):
    return True


def nothing(*_):
    return iter(())


def on_no_line(found, piece):
    """Times on edges, of vertices that leave the line of the edge."""
    turning = [corner for corner in found if contact.orientation_polynomial(*corner)]
    return TIMES_ON_EDGES(turning, piece)


TIMES_ON_EDGES = contact._times_on_edges


def without_touches(found):
    """Intervals of which those of one time are lost."""
    return [(since, until) for since, until in INTERVALS_OF(found) if since != until]


INTERVALS_OF = times.intervals_of


def without_edges(a, b, p, q):
    return iter(())


def later_roots(f, begin, until):
    """The roots in a span, but for the first one."""
    return ROOTS_IN(f, begin, until)[1:]


ROOTS_IN = times.roots_in

BY_SETS = first_contacts_agree
TO_SELF = self_contacts_agree
AT_CONTACT = incidences_are_features_at_the_distance_of_contact
APPROACH = a_first_approach_is_the_start_of_an_interval
ZERO = contacts_are_distances_of_zero
LEAST = the_least_distance_is_reached_and_no_less
DISTANCE = bodies_are_within_their_distance_and_no_less
POINTS = points_and_polynomials_tell_the_same_of_a_rational_time
NEW = a_new_contact_is_the_first_one_if_there_is_none_at_the_start
OVERLAP = bodies_that_overlap_share_a_point
WINDINGS = inside_by_windings_is_inside_by_crossings
SEGMENT = a_segment_is_free_if_a_ray_gets_to_its_end
SPIN = a_spin_turns_by_its_angle_within_its_error
NEAREST = sys.modules[
    "exactpt.testing.reference.nearest"
]  # the package has a function of that name

MISTAKES = {
    "vertices on the line of an edge ignored": (
        contact,
        "_times_on_edges",
        on_no_line,
        BY_SETS,
    ),
    "no distance of contact is reached": (contact, "_times_at_distance", nothing, BY_SETS),
    "no contact at the start": (contact, "_meet_at_start", never, BY_SETS),
    "a first root is lost": (contact, "roots_in", later_roots, BY_SETS),
    "touches at one time are no intervals": (contact, "intervals_of", without_touches, BY_SETS),
    "bodies that never touch themselves": (contact, "_can_touch_itself", never, TO_SELF),
    "a fold is simple": (contact, "_is_fold", never, TO_SELF),
    "no vertex is on an edge": (contact._Touching, "is_on_inside", never, AT_CONTACT),
    "no foot at a time": (NEAREST, "squared_to_interior", never, AT_CONTACT),
    "every foot is inside": (within, "has_foot", always, DISTANCE),
    "vertices have no edges to come near": (within, "corners", without_edges, DISTANCE),
    "a critical time is left out": (within, "_excesses", nothing, APPROACH),
    "a distance has no slope": (NEAREST, "slope", lambda _: (), LEAST),
    "no vertex is above an edge": (NEAREST, "corners", without_edges, LEAST),
    "contained bodies are apart, by signs": (features, "is_inside", never, POINTS),
    "contained bodies are apart, by points": (shapes, "is_inside", never, POINTS),
    "every line meets its segment": (features, "is_between", always, POINTS),
    "segments that cross are apart": (features, "segments_meet", never, ZERO),
    "chains never cross": (new, "chains_cross", never, OVERLAP),
    "no overlap on any line": (new, "_overlap_at", never, OVERLAP),
    "all lines overlap": (new, "_overlap_at", always, OVERLAP),
    "bodies are never apart": (new, "bodies_meet", always, NEW),
    "no point is inside": (space, "is_inside", never, WINDINGS),
    "a way through bodies": (space, "segments_cross", never, SEGMENT),
    "a sine of the opposite sign": (turning, "cosine_and_sine", backwards, SPIN),
    "a sector is walled up": (paths, "crosses", always, SEGMENT),
}
"""Where a mistake is planted, and the law that finds it."""


@pytest.mark.long(
    "vertices on the line of an edge ignored",
    "no distance of contact is reached",
    "a first root is lost",
)
@pytest.mark.parametrize("mistake", MISTAKES)
def test_a_mistake_in_a_definition_is_found(mistake, monkeypatch):
    owner, name, wrong, law = MISTAKES[mistake]
    monkeypatch.setattr(owner, name, wrong)

    assert is_broken(law)


def is_broken(law, count=300):
    """Whether a law does not hold in one of some cases, or ends in an error."""
    for k in range(count):
        try:
            law(Random(f"{law.__name__} {k}"))
        except Exception:
            return True
    return False
