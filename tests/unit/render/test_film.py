"""The animation: at any time it shows the tiling that a simulation has then."""

import json
import re
from itertools import pairwise

import pytest
from render_scenes import apart, demo, overlapping, rebuilt, small

from exactpt.kernel.algebraic import AlgebraicNumber, rational_between
from exactpt.kernel.numbers import QQ
from exactpt.pseudotriangulation.snapshot import snapshot
from exactpt.render.data import data_of
from exactpt.render.film import film_of
from exactpt.render.fixed import BITS, fixed, near
from exactpt.render.page import page_of
from exactpt.render.tracker import Tracker
from exactpt.simulation.simulation import Simulation
from exactpt.testing.scenes import generate
from exactpt.tiling.driver import Driver


def alive(spans, step):
    return [s for s in spans if s.first <= step and (s.last is None or step < s.last)]


def cycle(nodes):
    i = nodes.index(min(nodes))
    return (*nodes[i:], *nodes[:i])


def shown(film, step):
    """The free tiles and the edges that the animation shows after a step."""
    tiles = {(cycle(t.nodes), *t.place) for t in alive(film.tiles, step) if not t.inside}
    edges = {(e.u, e.v, e.kind) for e in alive(film.edges, step)}
    return tiles, edges


def in_snapshot(snap, scene):
    number = {body.name: i for i, body in enumerate(scene.bodies)} | {None: -1}
    tiles = {(cycle(f.nodes), number[f.body], f.level or 0) for f in snap.faces}
    edges = {
        (e.u, e.v, "diagonal" if not e.hull else "rim" if e.kind == "boundary" else "hull")
        for e in snap.edges
        if e.hull or e.kind == "diagonal"
    }
    return tiles, edges


SCENES = [
    pytest.param(small(), "greedy", id="small"),
    pytest.param(demo(), "lazy", id="demo"),
    *(
        pytest.param(generate(family, seed), "greedy", id=f"{family}-{seed}")
        for family in ("convex", "ballistic", "turning", "deforming", "pieces", "grids_passing")
        for seed in (1, 2)
    ),
    *(pytest.param(generate(f, 1), "lazy", id=f) for f in ("turning_stars", "blobs", "combs")),
    *(
        pytest.param(generate(family, seed), "mixed", id=f"{family}-{seed}-mixed")
        for family in ("stars", "turning_stars", "combs", "spirals", "nested")
        for seed in (4, 7)
    ),
    # The mesh is built anew, and has fewer half-edges than before.
    *(pytest.param(rebuilt(), t, id=f"bug-rebuilt-{t}") for t in ("greedy", "mixed", "lazy")),
]


@pytest.mark.long("demo", "grids_passing-2")
@pytest.mark.parametrize("scene, tiling", SCENES)
def test_between_events_the_film_shows_the_snapshot(scene, tiling):
    film = film_of(scene, tiling=tiling)
    if not film.tiles:
        return
    times = [AlgebraicNumber(scene.start), *(step.time for step in film.steps)]
    if film.contact is None:
        times.append(AlgebraicNumber(scene.end))
    simulation = Simulation(scene, tiling=tiling)
    for step, (before, after) in enumerate(pairwise(times)):
        if before.compare(after) == 0:
            continue
        at = rational_between(before, after)
        for _ in simulation.run(at):
            pass
        assert shown(film, step) == in_snapshot(simulation.snapshot(), scene)


@pytest.mark.parametrize("scene, tiling", SCENES)
def test_the_events_are_those_of_the_simulation(scene, tiling):
    film = film_of(scene, tiling=tiling)
    events = list(Simulation(scene, tiling=tiling).run())
    changes = [(step.time, change) for step in film.steps for change in step.changes]
    assert [change.kind for _, change in changes] == [event.kind for event in events]
    assert all(t.compare(e.time) == 0 for (t, _), e in zip(changes, events, strict=True))
    times = [step.time for step in film.steps]
    assert all(a.compare(b) < 0 for a, b in pairwise(times))


@pytest.mark.long
def test_at_the_contact_the_film_shows_the_tiling_that_ends_there():
    film = film_of(demo())
    simulation = Simulation(demo())
    list(simulation.run())
    at = near(simulation.contact.time, QQ(10))
    kinetic = simulation.kinetic
    last = snapshot(kinetic.vertices, kinetic.mesh_after(), "lazy", at)
    assert shown(film, len(film.steps)) == in_snapshot(last, demo())


@pytest.mark.long
def test_positions_in_the_data_are_exact():
    film = film_of(demo())
    data = json.loads(json.dumps(data_of(film, at=QQ(5, 2))))
    t = QQ(5, 2)
    places = [place for body in demo().bodies for place in body.at(t)]
    found = []
    unit = BITS - data["timeUnit"]
    assert int(data["at"]) == fixed(t, unit)
    for _, _, _, pieces in data["bodies"]:
        tracks = next(
            tracks for until, tracks in pieces if until is None or int(until) > int(data["at"])
        )
        for track in tracks:
            x, y, w = (sum(QQ(c) * t**i for i, c in enumerate(f)) for f in track)
            found.append((x / w, y / w))
    assert found == places


@pytest.mark.long
def test_times_in_the_data_are_exact():
    data = data_of(film_of(demo()))
    assert data["steps"][-1]["exact"] == ["-141750", "6750", "1099"]
    assert data["contact"]["words"] == "vertex 0 of boat on edge 6 of harbour"
    assert data_of(film_of(small()))["steps"][-1]["exact"] == "3"


def test_a_film_of_bodies_that_overlap():
    film = film_of(overlapping())
    data = data_of(film)
    assert data["start"] == data["end"]
    assert data["contact"]["kind"] == "initial"
    assert film.tiles == ()


def test_a_page_needs_nothing_else_and_is_the_same_every_time():
    page = page_of(film_of(apart()), title='<a&b"]]>')
    assert page == page_of(film_of(apart()), title='<a&b"]]>')
    assert not re.search(r"""(src|href)=["'](?!data:)""", page)
    assert "@@" not in page
    assert "<title>&lt;a&amp;b&quot;]]&gt;</title>" in page
    data = page.split('type="application/json">')[1].split("</script>")[0]
    assert json.loads(data)["bodies"][0][0] == '<a&b"]]>'


@pytest.mark.parametrize("theme", ["light", "dark"])
def test_a_page_with_a_theme(theme):
    assert f'<html lang="en" data-theme="{theme}">' in page_of(film_of(apart()), theme=theme)


@pytest.mark.parametrize(
    "family, tiling",
    [
        ("convex", "lazy"),
        ("convex", "greedy"),
        ("convex", "mixed"),
        ("deforming", "lazy"),
        ("grids_passing", "greedy"),
        ("grids_passing", "lazy"),
        ("ballistic_points", "incremental"),
    ],
)
def test_changes_of_the_engine_make_the_film_of_a_comparison_of_all(family, tiling):
    steps = 0
    for seed in range(2):
        scene = generate(family, seed)
        driver = Driver(scene)
        driver.start(tiling)
        node = driver.tiled.kinetic.vertices.nodes()
        ours, whole = Tracker(driver.tiled.kinetic, node), Tracker(driver.tiled.kinetic, node)
        driver.observers.append(ours)
        while steps < 60 * (seed + 1) and (events := driver.advance(scene.end)) is not None:
            if events:
                steps += 1
                whole.on_changed_edges(None)
                ours.update(steps)
                whole.update(steps)
        assert ours.edges == whole.edges
        assert sorted(map(repr, ours.tiles)) == sorted(map(repr, whole.tiles))
    assert steps > 5
