"""The laws by CGAL fail where an answer of exactpt is a wrong one."""

from dataclasses import replace
from fractions import Fraction
from random import Random

import pytest

import exactpt
from exactpt import AlgebraicNumber, Body, Contact, ContactPoint, FreeSpace, Scene, Translation
from fuzz.laws import confirmed
from fuzz.laws.confirmed import (
    contacts_are_confirmed,
    distances_are_confirmed,
    first_contact_is_confirmed,
    spaces_are_confirmed,
    unions_are_confirmed,
)
from fuzz.witnesses import Difference

pytestmark = pytest.mark.cgal

BOX = [(0, 0), (2, 0), (2, 2), (0, 2)]
# The point is at (8 - 2 t, 1): in the box from t = 3 to t = 4.
MEETING = Scene(
    [Body("box", BOX), Body("point", [(8, 1)], Translation([0, -2]))],
    time=(0, 8),
)
# The point is at (t^2, 1) - (8, 0): on the edge x = 0 at t = sqrt(8), and then in the box.
IRRATIONAL = Scene(
    [Body("box", BOX), Body("point", [(-8, 1)], Translation([0, 0, 1]))],
    time=(0, 3),
)
APART = Scene([Body("box", BOX), Body("point", [(9, 9)]), Body("other", [(5, 1), (6, 1), (5, 2)])])
ROOT = AlgebraicNumber.root([-8, 0, 1], 2, 3)
LATER = AlgebraicNumber.root([-17, 0, 2], 2, 3)  # sqrt(17 / 2), when the point is in the box
EARLIER = AlgebraicNumber.root([-15, 0, 2], 2, 3)


def on_edge(edge, vertex=0):
    """The point on an edge of the box."""
    return ContactPoint("vertex-edge", "point", vertex, "box", edge, None, (0.0, 0.0), None)


def contact(time, *incidences):
    return Contact(AlgebraicNumber(time) if isinstance(time, int) else time, "any", incidences)


def is_broken(law, scene):
    """Return the kind of the difference that one of some random choices shows."""
    for seed in range(20):
        try:
            law(scene, Random(seed))
        except Difference as difference:
            return difference.kind
    return None


FIRST = [
    (MEETING, contact(3, on_edge(1)), None),
    (MEETING, None, "contact before the first"),
    (MEETING, contact(4, on_edge(3)), "contact before the first"),
    (MEETING, contact(2, on_edge(1)), "incidence"),
    (MEETING, contact(3, on_edge(0)), "incidence"),
    (MEETING, contact(3), "pairs"),
    (IRRATIONAL, contact(ROOT, on_edge(3)), None),
    (IRRATIONAL, contact(LATER, on_edge(3)), "contact before the first"),
    (IRRATIONAL, contact(EARLIER, on_edge(3)), "no contact by signs"),
]


@pytest.mark.parametrize(("scene", "found", "kind"), FIRST)
def test_wrong_first_contact_breaks_the_law(monkeypatch, scene, found, kind):
    monkeypatch.setattr(confirmed, "contact_by", lambda *_: found)

    assert is_broken(first_contact_is_confirmed, scene) == kind


def shifted(start, end):
    """Contact intervals of which the ends are moved."""

    def ask(scene, a, b, found=exactpt.contact_intervals):
        return [
            replace(
                interval,
                start=AlgebraicNumber(interval.start.exact_low + start),
                end=AlgebraicNumber(interval.end.exact_low + end),
            )
            for interval in found(scene, a, b)
        ]

    return ask


@pytest.mark.parametrize(
    ("shifts", "kind"),
    [
        ((0, 0), None),
        ((Fraction(1, 2**70), 0), "contact"),
        ((0, 1), "contact"),
        ((-1, 0), "contact"),
    ],
)
def test_wrong_contact_interval_breaks_the_law(monkeypatch, shifts, kind):
    monkeypatch.setattr(exactpt, "contact_intervals", shifted(*map(Fraction, shifts)))

    assert is_broken(contacts_are_confirmed, MEETING) == kind


def nearer(distance):
    return replace(distance, core_squared=Fraction(1, 3))


def of_first_corners(distance):
    """The first corners of two bodies as their nearest features, which they never are here."""
    corners = [
        tuple(feature._replace(vertex=0, edge=None) for feature in pair)
        for pair in distance.features
    ]
    return replace(distance, features=tuple(corners))


@pytest.mark.parametrize(
    ("change", "kind"),
    [(None, None), (nearer, "squared distance"), (of_first_corners, "distance of features")],
)
def test_wrong_distance_breaks_the_law(monkeypatch, change, kind):
    right = exactpt.distance
    if change is not None:
        monkeypatch.setattr(exactpt, "distance", lambda *asked, at: change(right(*asked, at=at)))

    assert is_broken(distances_are_confirmed, APART) == kind


def without_first(names):
    return names[1:]


def negated(is_free):
    return not is_free


def nowhere(place):
    return replace(place, body=None)


@pytest.mark.parametrize(
    ("method", "change", "kind"),
    [
        ("hull", None, None),
        ("hull", without_first, "hull"),
        ("relative_hull", without_first, "convex relative hull"),
        ("is_free", negated, "free segment"),
        ("locate", nowhere, "owner of a point"),
    ],
)
def test_wrong_query_of_the_free_space_breaks_the_law(monkeypatch, method, change, kind):
    right = getattr(FreeSpace, method)
    if change is not None:
        monkeypatch.setattr(FreeSpace, method, lambda *asked: change(right(*asked)))

    assert is_broken(spaces_are_confirmed, APART) == kind


def test_wrong_union_breaks_the_law(monkeypatch):
    assert is_broken(unions_are_confirmed, APART) is None

    monkeypatch.setattr(exactpt, "union", lambda bodies, name: Body(name, bodies[0].at(0)))

    assert is_broken(unions_are_confirmed, APART) == "union"
