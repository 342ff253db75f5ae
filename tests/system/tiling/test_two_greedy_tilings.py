"""The greedy tiling of convex bodies is one, by the vertical decomposition and by shadow edges."""

import pytest

from exactpt.certificates.certifier import Certifier
from exactpt.kernel.algebraic import AlgebraicNumber, rational_between
from exactpt.motion.vertices import Vertices
from exactpt.pairs.start import initial_touches
from exactpt.scene.generate import CONVEX, FAMILIES, generate
from exactpt.scene.scene import Scene
from exactpt.tiling import catalogue
from exactpt.tiling.events import ContactFound, Stats
from exactpt.tiling.start import make, plan_tiling
from fuzz.corpus import files
from fuzz.statics import audit_at


def in_greedy_order(scene, *, convex):
    """The kinetic tiling of a scene, by the vertical decomposition if ``convex``."""
    vertices = Vertices.of(scene.bodies, scene.start, scene._end)
    certifier = Certifier(vertices, scene._start, scene._end, exact_only=False)
    tiling = make(catalogue.find("greedy", convex=convex), vertices, certifier, Stats())
    tiling.begin(scene._start)
    return tiling


def diagonals(tiling):
    mesh = tiling.mesh_after()
    return sorted(tuple(sorted(mesh.ends(h))) for h in mesh.diagonals())


def following(tiling, scene):
    """The time of the next event, or the end."""
    return tiling.next_number() or AlgebraicNumber(scene._end)


def advance_to(tiling, scene, time):
    """Process all events up to a time; whether there is a contact then."""
    try:
        while following(tiling, scene).compare(time) <= 0:
            if tiling.advance(scene._end) is None:
                return False
    except ContactFound:
        return True
    return False


def compare(scene):
    """Run both up to the contact or the end.

    Returns:
        The number of intervals between events in which the tilings were compared.
    """
    walls, shadows = in_greedy_order(scene, convex=True), in_greedy_order(scene, convex=False)
    compared, end = 0, AlgebraicNumber(scene._end)
    while True:
        now = max(walls.now, shadows.now)
        until = min(following(walls, scene), following(shadows, scene))
        if now < until:
            assert diagonals(walls) == diagonals(shadows)
            audit_at(shadows, rational_between(now, until))
            compared += 1
        if until == end:
            return compared
        found = advance_to(walls, scene, until), advance_to(shadows, scene, until)
        assert found[0] == found[1]
        if found[0]:
            return compared


def are_convex(scene):
    """Whether a scene, which is not of points alone, is for the vertical decomposition."""
    return (
        any(body.size > 1 for body in scene.bodies)
        and not initial_touches(scene)[1]
        and plan_tiling(scene, "greedy", scene._start).entry.bodies is catalogue.Bodies.CONVEX
    )


@pytest.mark.parametrize("family", sorted(CONVEX))
def test_walls_and_shadows_keep_the_same_tiling(family):
    """Between any two events of either; contacts too."""
    scenes = [scene for seed in range(4) if are_convex(scene := generate(family, seed))]

    assert sum(map(compare, scenes)) >= len(scenes) > 0


@pytest.mark.slow
@pytest.mark.parametrize("family", sorted(FAMILIES))
def test_walls_and_shadows_keep_the_same_tiling_in_many_scenes(family):
    """Of all families: some scenes of simple polygons happen to be convex."""
    scenes = [scene for seed in range(60) if are_convex(scene := generate(family, seed))]

    assert sum(map(compare, scenes)) >= len(scenes)
    assert scenes or family not in CONVEX


def test_walls_and_shadows_keep_the_same_tiling_in_the_corpus():
    scenes = [scene for path in files() if are_convex(scene := Scene.load(path))]

    assert len(scenes) > 5
    assert sum(map(compare, scenes)) >= len(scenes)
