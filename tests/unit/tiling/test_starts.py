"""Starts in arrays: the same tilings, certificates and counts as one by one."""

import warnings
from fractions import Fraction
from itertools import islice
from random import Random

import numpy as np
import pytest

from benchmarks.shapes import crowd
from exactpt import Body, Scene, Simulation, Translation, first_contact
from exactpt.kernel.numbers import QQ
from exactpt.motion import vertices as moving_vertices
from exactpt.motion.linear_rows import linear_rows
from exactpt.motion.vertices import HORIZON, WIDTH
from exactpt.pairs import start
from exactpt.pairs.start import initial_touches, near_pairs
from exactpt.pseudotriangulation import build, stars
from exactpt.testing.scenes import FAMILIES, generate
from exactpt.tiling import angles
from exactpt.tiling.start import plan_tiling, start_tiling, tilings_for

pytestmark = pytest.mark.plain

FEW = 10**9


def crowded(k, seed=0):
    return crowd(k, Random(f"starts {seed}"), radius=60, end=60)


def state_after_start(scene, tiling):
    """The enclosures of a start; the rest that it has made; and its counts of decisions."""
    kinetic = start_tiling(scene, tiling, scene.exact_start)
    queue, counters = kinetic.queue, kinetic.vertices.counters
    pending = [(slot, queue.pending(slot)) for slot in queue.slots()]
    vertices = kinetic.vertices
    return (
        [end for _, t in pending for end in (t.low, t.high)],
        (
            [(v.id, v.body, v.index, v.name) for v in vertices.all],
            list(vertices.places)[HORIZON::WIDTH],
            [(vertices.ahead(v), vertices.behind(v)) for v in vertices.ids()],
            [(m.ring, m.until, m.deforms, m.is_tiled, m.is_polygon) for m in vertices.bodies],
            kinetic.state(),
            kinetic.vertices.enclosures.errors,
            [(slot, t.a, t.b, t.c, t.crossing, t.exact) for slot, t in pending],
            kinetic.table.violated,
            (kinetic.certifier.made, kinetic.certifier.skipped, kinetic.certifier.zeros),
            queue._count,
        ),
        counters.now(),
    )


def compared(scene, monkeypatch):
    """Compare the starts of all tilings of a scene, if its bodies are disjoint."""
    if initial_touches(scene)[1]:
        return
    for tiling in tilings_for(scene):
        states = []
        for least, of_mesh in ((FEW, FEW), (0, FEW), (0, 0)):
            monkeypatch.setattr(angles, "MANY", least)
            monkeypatch.setattr(moving_vertices, "MANY", least)
            monkeypatch.setattr(build, "MANY", of_mesh)
            states.append(state_after_start(scene, tiling))
        (one_by_one, state, counts), (at_once, other, its_counts), (_, last, _) = states
        assert state == other == last
        assert counts == its_counts  # a mesh in numpy takes fewer signs
        assert at_once == pytest.approx(one_by_one, rel=1e-9)


def arrays_of(bodies, time, unit=1.0):
    """The scene of the same bodies, polygons of doubles, in arrays."""
    doubles = [body.exact_shape.near for body in bodies]
    offsets = np.cumsum([0, *(len(near.xs) for near in doubles)])
    corners = [point for near in doubles for point in zip(near.xs, near.ys, strict=True)]
    paths = [
        [
            [float(c) for c in (*f.exact_coefficients, 0, 0)[:2]]
            for f in (body.motion.x, body.motion.y)
        ]
        for body in bodies
    ]
    names = [body.name for body in bodies]
    corners, paths = np.array(corners) * unit, np.array(paths) * unit
    return Scene.from_arrays(corners, offsets, coefficients=paths, names=names, time=time)


def doubled(seed, k=25, unit=1.0, span=1):
    """Triangles of doubles of either orientation, with an upright side, some at rest."""
    rng = Random(f"doubled {seed}")
    bodies = []
    for i in range(k):
        x, y = 40.0 * (i % 5) + rng.uniform(-9, 9), 40.0 * (i // 5) + rng.uniform(-9, 9)
        shift = rng.choice([0, rng.uniform(-1, 1), 2.0**-30 + 3])
        ring = [
            (x - shift, y),
            (x - shift + rng.uniform(1, 5), y),
            (x - shift, y + 3.5),
        ]
        if rng.random() < 0.5:
            ring.reverse()
        speed = rng.choice([[], [shift], [shift, 0.25], [shift, rng.uniform(-1, 1)]])
        paths = [speed or [shift], rng.choice([[], [0, -0.5]])]
        motion = Translation(*([c * unit for c in path] for path in paths))
        bodies.append(Body(f"b{i}", [(x * unit, y * unit) for x, y in ring], motion))
    start = rng.choice([0, Fraction(1, 3)])
    return Scene(bodies, (start, start + Fraction(span)))


def boxes_in_doubles(scene):
    vertices = plan_tiling(scene, "lazy", scene.exact_start).vertices
    return near_pairs(vertices, scene.exact_start)


@pytest.mark.parametrize("few", [0, 1 << 30])
@pytest.mark.parametrize("family", FAMILIES)
def test_pairs_that_are_not_near_are_disjoint_at_the_start(family, few, monkeypatch):
    """Contacts at the start among the scenes: the same incidences as from all pairs."""
    monkeypatch.setattr(start, "FEW", few)
    for seed in range(6):
        scene = generate(family, seed)
        if not scene.has_radius:
            near = boxes_in_doubles(scene)
            assert initial_touches(scene, near) == initial_touches(scene)


@pytest.mark.parametrize("few", [0, start.FEW])
def test_few_boxes_out_of_the_range_of_doubles(few, monkeypatch):
    """At 1/3, so that positions are rounded: those far from it are near nothing, or everything."""
    monkeypatch.setattr(start, "FEW", few)
    places = [0, 10**400, 1.7e308, 9, 9.5]
    bodies = [
        Body(f"b{k}", [(x, 0), (Fraction(x) + 1, 0), (x, 1)], Translation([0], [0, k]))
        for k, x in enumerate(places)
    ]
    scene = Scene(bodies, (Fraction(1, 3), 2))

    near = boxes_in_doubles(scene)

    assert {(3, 4)} <= set(near)
    assert initial_touches(scene, near) == initial_touches(scene)


def test_stars_that_doubles_sort_wrongly_are_sorted_by_predicates(monkeypatch):
    """Planted: all angles are taken for 0, so edges are in the order of the sweep."""
    scene, sorted_again = crowded(30), []
    monkeypatch.setattr(build, "MANY", 0)
    _, right, _ = state_after_start(scene, "lazy")
    monkeypatch.setattr(stars, "_turn", lambda _instant, v, *_ends: np.zeros(len(v)))
    exactly = build._sorted_star

    def noted(*args):
        sorted_again.append(args)
        return exactly(*args)

    monkeypatch.setattr(build, "_sorted_star", noted)
    _, planted, _ = state_after_start(scene, "lazy")

    assert planted == right
    assert sorted_again


@pytest.mark.long
@pytest.mark.parametrize("unit", [1.0, 2.0**-40, 2.0**40, 2.0**90])
@pytest.mark.parametrize("end", [1, 2**-20, 2**20])
def test_starts_of_bodies_of_doubles(unit, end, monkeypatch):
    """Of any size, for spans of any length: the normalization scales."""
    compared(doubled(0, unit=unit, span=end), monkeypatch)
    exact = arrays_of(crowded(25).bodies, (0, end), unit=unit)
    assert linear_rows(exact.bodies, exact.exact_start, exact.exact_end) is not None
    compared(exact, monkeypatch)


def test_bug_starts_at_times_beyond_doubles():
    """They ended with an OverflowError."""
    bodies = [Body(f"b{k}", [(9 * k, 0), (9 * k + 1, 0), (9 * k, 1)]) for k in range(25)]
    scene = Scene(bodies, (10**400, 10**400 + 1))

    assert linear_rows(scene.bodies, scene.exact_start, scene.exact_end) is None
    assert list(Simulation(scene).run()) == []


@pytest.mark.parametrize("size, speed, start", [(1.0, 1e300, 0), (1e306, 1.0, 1)])
def test_bug_starts_of_extreme_bodies_gave_warnings(size, speed, start):
    motion = Translation([0], [0, speed])
    places = [(k * size, (k + 0.5) * size) for k in range(25)]
    bodies = [Body(f"b{k}", [(x, 0), (y, 0), (x, size)], motion) for k, (x, y) in enumerate(places)]
    scene = Scene(bodies, (start, 2**300))

    with warnings.catch_warnings():
        warnings.simplefilter("error")
        linear_rows(scene.bodies, scene.exact_start, scene.exact_end)


def test_bug_rounded_positions_that_cancel_give_no_frame():
    """Paths from about 2^60 to within 2^-22 of the origin: rounded, they seem to be 256 apart."""
    bodies, far = [], 2.0**60
    for k in range(25):
        at = [(128 + s * 2.0**-24, 128 + t * 2.0**-24) for s, t in ((-1, -1), (1, -1), (-1, 1))]
        to_origin = [far, -far - 128]
        bodies.append(Body(f"b{k}", at, Translation(to_origin, to_origin)))

    assert linear_rows(bodies, QQ(1), QQ(2)) is None


@pytest.mark.parametrize("tiling", ["lazy", "greedy"])
@pytest.mark.parametrize("seed", range(3))
def test_starts_from_arrays_make_no_bodies(seed, tiling):
    """A few may be made where equal slopes or abscissas are decided exactly."""
    scene = crowded(40, seed)
    arrays = arrays_of(scene.bodies, (scene.start, scene.end))

    of_arrays = state_after_start(arrays, tiling)

    assert len(arrays.bodies._made) < 10
    assert of_arrays == state_after_start(scene, tiling)
    simulation = Simulation(arrays, tiling=tiling)
    events = list(islice(simulation.run(), 15))
    assert simulation.contact is None
    assert len(arrays.bodies._made) < 10
    assert [event.time for event in events] == sorted(event.time for event in events)
    runs = [
        [event.to_json() for event in Simulation(s, tiling=tiling).run()] for s in (scene, arrays)
    ]
    assert runs[0] == runs[1]
    arrays = arrays_of(scene.bodies, (scene.start, scene.end))
    contacts = [first_contact(s, method="kinetic", tiling=tiling) for s in (scene, arrays)]
    assert len(arrays.bodies._made) < 20  # those of exact decisions up to the contact too
    assert contacts[0] is not None
    assert contacts[0].time == contacts[1].time
    assert [(p.body, p.other) for p in contacts[0].pairs] == [
        (p.body, p.other) for p in contacts[1].pairs
    ]


@pytest.mark.long
@pytest.mark.parametrize("family", FAMILIES)
def test_starts_in_arrays_are_those_one_by_one(family, monkeypatch):
    """Degenerate bodies, deformation and turns among them."""
    for seed in range(3):
        compared(generate(family, seed), monkeypatch)


def test_starts_of_crowds(monkeypatch):
    for k in (3, 30):
        compared(crowded(k), monkeypatch)
