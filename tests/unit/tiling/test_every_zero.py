"""Every zero of a watched angle has an event, with a change of sign or without.

The proof that no contact is missed (`exactpt.certificates.incidences`) stands on it.
"""

from itertools import pairwise

import pytest

from exactpt import AlgebraicNumber, Body, Scene, Translation
from exactpt.certificates.certificate import ANGLE, pack
from exactpt.certificates.perturbation import orientation_polynomial
from exactpt.kernel.roots import common_roots, roots_after
from exactpt.motion.track import difference
from exactpt.pairs.start import initial_touches
from exactpt.pseudotriangulation.mesh import SOLID
from exactpt.testing.scenes import FAMILIES, generate
from exactpt.tiling.events import ContactFound
from exactpt.tiling.start import TILINGS, start_tiling
from fuzz.laws.kept import kept, names
from fuzz.witnesses import tilings_of

GRAZING = Scene(
    [
        Body("chain", [(0, 0), (3, 0), (0, -2)], Translation([1, -2, 1], [0, -1]), closed=False),
        Body("segment", [(0, -3), (0, -4)]),
    ],
    (0, 3),
)


def first_zero(kinetic, h):
    """The first time after now at which the angle of h vanishes, by its exact polynomials."""
    vertices = kinetic.certified.vertices_of(h)
    ends = [kinetic.vertices.bodies[v.body].until for v in vertices]
    until = min([kinetic.certifier.end, *(end for end in ends if end is not None)])
    times = [root.time for root in zeros(vertices, kinetic.now, until)]
    return min(times, default=None)


def zeros(vertices, now, until):
    a, p, b = vertices
    f = orientation_polynomial(a, p, b)
    if f:
        yield from roots_after(f, now, until)
    if not f or len({v.track for v in vertices}) < 3:
        for u, v in pairwise((a, p, b, a)):
            dx = difference(u.track.x, u.track.w, v.track.x, v.track.w)
            dy = difference(u.track.y, u.track.w, v.track.y, v.track.w)
            if u.track is not v.track:
                yield from common_roots(dx, dy, now, until)


def pending(kinetic, h):
    """When an event of the angle of h is pending, or of the triangle that it is one of."""
    m = kinetic.mesh.map
    slots = [h]
    if kinetic.certified.is_triangle(h) and kinetic.mesh.corner[h]:
        slots += [m.following[h], m.previous[h]]
    times = [time for g in slots if (time := kinetic.queue.pending(pack(ANGLE, g)))]
    return min((t.exact or kinetic.certifier.resolve(t) for t in times), default=None)


def check_angles(kinetic):
    """How many zeros without a change of sign have been seen."""
    even = 0
    for h in kinetic.mesh.map.half_edges():
        if kinetic.mesh.region[h] != SOLID:
            expected, found = first_zero(kinetic, h), pending(kinetic, h)
            assert found == expected, [kinetic.vertices.name(v) for v in kinetic.certified.angle(h)]
            f = orientation_polynomial(*kinetic.certified.vertices_of(h))
            if found is not None and f and found.sign_of(f) == 0:
                even += found.sign_before(f) == found.sign_after(f)
    return even


def run_and_check(scene, tiling):
    if initial_touches(scene)[1]:
        return 0
    kinetic = start_tiling(scene, tiling, scene.start)
    even = 0
    try:
        for _ in range(30):
            even += check_angles(kinetic)
            if kinetic.advance(scene.end) is None:
                break
    except ContactFound:
        pass
    return even


@pytest.mark.long
@pytest.mark.parametrize("tiling", TILINGS)
@pytest.mark.parametrize("family", FAMILIES)
def test_the_pending_time_of_an_angle_is_its_first_zero(family, tiling):
    for seed in range(2):
        run_and_check(generate(family, seed), tiling)


@pytest.mark.long
@pytest.mark.parametrize("tiling", TILINGS)
@pytest.mark.parametrize("name", names())
def test_the_same_in_kept_cases(name, tiling):
    scene = kept(name).scene
    if tiling in tilings_of(scene):
        run_and_check(scene, tiling)


@pytest.mark.parametrize("tiling", ["lazy", "mixed"])
def test_a_zero_of_copies_without_a_change_of_sign_is_pending(tiling):
    """At t = 1 the end of the segment is level with two copies, and on their left again."""
    kinetic = start_tiling(GRAZING, tiling, GRAZING.start)

    assert kinetic.next_number() == AlgebraicNumber(1)
    assert check_angles(kinetic) > 0
