"""Whether repairs at one time may have met."""

import pytest

from exactpt.motion.body import Body
from exactpt.scene.scene import Scene
from exactpt.tiling.simultaneous import FailureGroup
from exactpt.tiling.start import start_tiling


@pytest.fixture
def mesh():
    boxes = [Body(f"b{i}", [(x, 0), (x + 2, 1), (x, 3)]) for i, x in enumerate((0, 9, 20))]
    scene = Scene(boxes, (0, 1))
    return start_tiling(scene, "lazy", scene.start).mesh.copy()


def faces(mesh):
    """The tiles, as lists of half-edges."""
    seen = {min(mesh.map.face(h)): mesh.map.face(h) for h in mesh.map.half_edges()}
    return list(seen.values())


def batch(*repairs):
    noted = FailureGroup()
    for half_edges in repairs:
        noted.begin_repair()
        noted.touch(half_edges)
    return noted


def test_one_repair_needs_no_check(mesh):
    assert not batch().needs_check(mesh)
    assert not batch([h for face in faces(mesh) for h in face]).needs_check(mesh)


def test_repairs_of_different_tiles_need_none(mesh):
    first, second, *_ = faces(mesh)

    assert not batch(first, second).needs_check(mesh)
    assert not batch(first[:1], second[1:]).needs_check(mesh)


def test_repairs_of_one_tile_do(mesh):
    face = max(faces(mesh), key=len)

    assert batch(face[:1], face[1:2]).needs_check(mesh)
    assert batch(face, face).needs_check(mesh)


def test_so_do_those_of_which_one_has_removed_what_another_had_changed(mesh):
    _, second, *_ = faces(mesh)
    gone = next(h for h in mesh.diagonals() if h not in second and h ^ 1 not in second)
    noted = batch([gone], second[:1])
    mesh.map.remove_edge(gone)

    assert noted.needs_check(mesh)


def test_with_new_motions_any_repair_needs_one(mesh):
    for noted, expected in ((batch(), False), (batch(faces(mesh)[0]), True)):
        noted.has_new_motions = True

        assert noted.needs_check(mesh) == expected


def test_a_new_time_begins_with_nothing(mesh):
    noted = batch(*faces(mesh)[:1], *faces(mesh)[:1])
    noted.has_new_motions = True

    noted.clear()

    assert not noted.touched
    assert not noted.needs_check(mesh)


def test_what_is_doubted_is_checked_whatever_else_is_repaired(mesh):
    noted = batch()
    noted.require_check(faces(mesh)[0])

    assert noted.needs_check(mesh)
    noted.clear()
    assert not noted.needs_check(mesh)
