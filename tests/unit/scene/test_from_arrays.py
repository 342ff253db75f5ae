"""Scenes from arrays: the same as of their bodies, which are made when somebody asks."""

import copy
import json
import pickle
import tracemalloc
from fractions import Fraction

import numpy as np
import pytest

from exactpt import Body, InputError, Scene, Simulation, Translation, first_contact
from exactpt.geometry.ragged import edges_of
from exactpt.motion import body as body_module
from exactpt.scene.body_arrays import BodyArrays

CORNERS = np.array([(0, 0), (2, 0), (0, 2), (5, 1), (7, 0.1), (7, 3), (9, 5), (8, 4)])
OFFSETS = [0, 3, 4, 6, 8]
VELOCITIES = [(1, 0), (0, 0), (-1, 0.25), (0.5, 0.5)]


def from_arrays(**options):
    return Scene.from_arrays(CORNERS, OFFSETS, **({"velocities": VELOCITIES} | options))


def from_bodies(names="0123"):
    cuts = zip(OFFSETS, OFFSETS[1:], VELOCITIES, names, strict=False)
    return Scene([
        Body(name, CORNERS[first:last], Translation([0, v[0]], [0, v[1]]))
        for first, last, v, name in cuts
    ])  # fmt: skip


def test_it_is_the_scene_of_its_bodies():
    scene, other = from_arrays(), from_bodies()

    assert scene == other
    assert other == scene
    assert hash(scene) == hash(other)
    assert scene.to_json() == other.to_json()
    assert scene.at("1/3") == other.at("1/3")
    assert repr(scene) == repr(other)
    assert scene != from_bodies("abcd")


def test_its_first_contact_and_its_events_are_those_of_its_bodies():
    scene, other = from_arrays(time=(0, 9)), from_bodies().going_on(from_bodies().bodies, 0)
    other = Scene(other.bodies, (0, 9))

    assert json.dumps(first_contact(scene).to_json()) == json.dumps(first_contact(other).to_json())
    assert first_contact(scene, method="pairs").time == first_contact(other).time
    events = [[event.to_json() for event in Simulation(s).run()] for s in (scene, other)]
    assert events[0] == events[1]


def test_copies_are_equal():
    scene = from_arrays(names=["a", "b", "c", "d"])

    for other in (copy.deepcopy(scene), pickle.loads(pickle.dumps(scene)), scene.until("1/2")):
        assert other.bodies == scene.bodies


def test_bodies_are_made_when_somebody_asks(monkeypatch):
    made = []
    init = Body.__init__

    def counted(self, *args, **options):
        made.append(args[0])
        init(self, *args, **options)

    monkeypatch.setattr(Body, "__init__", counted)
    scene = from_arrays(names=["a", "b", "c", "d"])
    assert (len(scene.bodies), scene.vertex_count, made) == (4, 8, [])

    assert scene.body("c").size == 2
    assert scene.bodies[-1] is scene.bodies[3]
    assert scene.bodies[1:2][0].at(1) == [(5, 1)]
    assert made == ["c", "d", "b"]


def test_100_000_bodies_need_no_number_of_python(monkeypatch):
    """Neither a rational nor a body is made, and the arrays are all that is kept."""
    n = 100_000
    rng = np.random.default_rng(1)
    corners = (rng.uniform(0.0, 900.0, (n, 1, 2)) + rng.uniform(-1.0, 1.0, (n, 3, 2))).reshape(
        -1, 2
    )
    refused = []
    monkeypatch.setattr(body_module, "rational", refused.append)
    tracemalloc.start()
    try:
        scene = Scene.from_arrays(corners, np.arange(0, 3 * n + 1, 3), velocities=corners[:n])
        kept = tracemalloc.get_traced_memory()[0]
    finally:
        tracemalloc.stop()

    assert scene.vertex_count == 3 * n
    assert refused == []
    assert kept < n * (6 * 8 + 8 + 4 * 8 + 1) + 100_000


def test_polynomial_motion_and_open_chains():
    chain = [(0, 0), (4, 0), (4, 4), (0.5, 0.5)]
    scene = Scene.from_arrays(
        [*chain, (9, 9)], [0, 4, 5], coefficients=[[[1, 0, 0.5], [0, 2, 0]], np.zeros((2, 3))],
        closed=[False, True],
    )  # fmt: skip

    body = Body("0", chain, Translation([1, 0, "1/2"], [0, 2]), closed=False)
    assert scene.bodies[0] == body
    assert scene.bodies[0].at(2)[0] == (Fraction(3), Fraction(4))


def test_names_are_found():
    scene = from_arrays()

    assert scene.body("2").at(0)[0] == (7, Fraction(0.1))
    with pytest.raises(InputError, match="there is no body '4'"):
        scene.body("4")


@pytest.mark.parametrize(
    "outline, message",
    [
        (
            [(0, 0), (2, 2), (2, 0), (0, 1)],
            "not a simple polygon and so not valid at the start, t = 3: edge 0",
        ),
        ([(0, 0), (1, 1), (2, 2)], "not a simple polygon and so not valid at the start"),
        (
            [(0, 0), (1, 1), (1, 1)],
            "not valid at the start, t = 3: vertex 1 and the next one are both at",
        ),
        ([(1, 1), (1, 1)], "not valid at the start, t = 3: vertex 0 and the next one are both at"),
    ],
)
def test_a_body_that_is_not_simple_is_refused_at_once(outline, message):
    with pytest.raises(InputError, match=f"body 'b': {message}"):
        Scene.from_arrays(
            [(9, 9), *outline], [0, 1, 1 + len(outline)], names=["a", "b"], time=(3, 4)
        )


def test_what_floats_cannot_tell_is_decided_exactly():
    """Triangles of one unit in the last place, of either orientation, and without one."""
    unit = 2.0**-52
    for far in (0.0, 1.0 / 3.0, 1.0):
        thin = [(far, far), (2.0, 2.0), (1.5, 1.5 + unit)]
        assert Scene.from_arrays(thin, [0, 3]).vertex_count == 3
        with pytest.raises(InputError):
            Scene.from_arrays([(far, far), (2.0, 2.0), (1.5, 1.5)], [0, 3])


def test_arrays_are_copied():
    corners = CORNERS.copy()
    scene = Scene.from_arrays(corners, OFFSETS)
    corners[:] = 0.0

    assert scene.bodies[1].at(0) == [(5, 1)]


def test_consecutive_bodies_are_taken_without_a_copy():
    """Blocks of pairs take their bodies from the arrays of all."""
    bodies = BodyArrays(CORNERS, OFFSETS, velocities=VELOCITIES, radii=[0, 1, 2, 3])
    taken = bodies.take(np.arange(1, 4))

    assert np.shares_memory(taken.vertices, bodies.vertices)
    assert taken.offsets.tolist() == [0, 1, 3, 5]
    for some in ([1, 2, 3], [3, 1, 2], [2, 2], [0, 2], [3], []):
        taken = bodies.take(np.array(some, dtype=np.int64))
        parts = [CORNERS[OFFSETS[k] : OFFSETS[k + 1]].tolist() for k in some]
        assert taken.vertices.tolist() == [vertex for part in parts for vertex in part]
        assert np.diff(taken.offsets).tolist() == [len(part) for part in parts]
        assert taken.radii.tolist() == some
        assert taken.coefficients[:, :, 1].tolist() == [list(VELOCITIES[k]) for k in some]


def test_edges_of_rings_chains_and_points():
    edges = edges_of(np.array([0, 3, 4, 6, 9, 12]), np.array([True, True, True, False, True]))

    assert edges.offsets.tolist() == [0, 3, 4, 5, 7, 10]
    assert edges.first.tolist() == [0, 1, 2, 3, 4, 6, 7, 9, 10, 11]
    assert edges.last.tolist() == [1, 2, 0, 3, 5, 7, 8, 10, 11, 9]
