"""What a tiling says about changes of its mesh: all of them, and little more."""

import pytest
from folding import every

from exactpt.indices import NO_VERTEX
from exactpt.scene.generate import FAMILIES, POINTS, generate
from exactpt.tiling.events import ContactFound
from exactpt.tiling.incremental.mesh import mesh_of
from exactpt.tiling.start import start_tiling, tilings_for


def links(mesh):
    m = mesh.map
    used = (h for h, v in enumerate(m.origin) if v != NO_VERTEX)
    return {h: (m.origin[h], m.following[h]) for h in used}


@pytest.mark.long(
    "polygons_in_step",
    "linear_points",
    "piecewise_points",
    "point_grids_passing",
    "parabola_points",
    "simultaneous_swaps",
)
@pytest.mark.parametrize("family", [*FAMILIES, *POINTS])
def test_changes(family):
    scene = generate(family, 4)
    for name in tilings_for(scene):
        kinetic = start_tiling(scene, name, scene._start)
        assert kinetic.changes() is None
        before = links(kinetic.mesh_after())
        try:
            while kinetic.advance(scene._end) is not None:
                now, changed = links(kinetic.mesh_after()), kinetic.changes()
                if changed is not None:
                    different = {h for h, _ in before.items() ^ now.items()}
                    assert different <= changed
                before = now
        except ContactFound:
            pass


@every("family", POINTS)
def test_the_mesh_of_points_is_the_one_of_its_trees(family):
    scene = generate(family, 5)
    kinetic = start_tiling(scene, "incremental", scene._start)
    kinetic.mesh_after()
    try:
        while kinetic.advance(scene._end) is not None:
            kept, built = kinetic.mesh_after(), mesh_of(kinetic.structure)
            assert links(kept) == links(built)
            for h in links(built):
                assert (kept.region[h], kept.corner[h]) == (built.region[h], built.corner[h])
                assert kept.map.previous[h] == built.map.previous[h]
    except ContactFound:
        pass


def test_an_event_of_points_changes_little():
    scene = generate("linear_points", 3)
    kinetic = start_tiling(scene, "incremental", scene._start)
    kinetic.changes()
    kinetic.advance(scene._end)
    assert 0 < len(kinetic.changes()) < len(kinetic.mesh_after().map.origin) / 2
