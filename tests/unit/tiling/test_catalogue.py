"""Which tiling is meant, and a structure that is registered from outside (docs/extending.md).

The interface of such a structure is that of modules of `exactpt.tiling` and of certificates.
"""

import sys
from importlib.util import module_from_spec, spec_from_file_location
from pathlib import Path
from random import Random

import pytest
from ranked import RANKED

import exactpt
from exactpt import AlgebraicNumber, Body, InputError, Scene, Simulation, first_contact
from exactpt.certificates.at_time import PredicatesAt
from exactpt.kernel.algebraic import rational_between
from exactpt.testing import reference
from exactpt.testing.scenes import generate
from exactpt.tiling import catalogue
from exactpt.tiling.events import ContactFound
from exactpt.tiling.start import start_tiling

PLAIN = catalogue.Entry("plain", catalogue.Bodies.ANY, "plain_shadowed:ShadowRules")


@pytest.fixture
def registered():
    added = [RANKED, PLAIN]
    catalogue.ENTRIES.extend(added)
    yield
    for entry in added:
        catalogue.ENTRIES.remove(entry)


def test_an_unknown_tiling_is_refused_with_the_names_of_all():
    with pytest.raises(
        InputError,
        match="no tiling 'x'; there are: auto, incremental, greedy, mixed, lazy",
    ):
        Simulation(generate("convex", 0), tiling="x")


def test_a_tiling_of_points_refuses_other_bodies():
    scene = Scene([Body("p", [(0, 0)]), Body("s", [(1, 0), (2, 0)])])

    with pytest.raises(InputError, match="body 's': has 2 vertices: the incremental tiling is for"):
        Simulation(scene, tiling="incremental")


@pytest.mark.parametrize("points", [[], [(1, 2)], [(1, 2), (1, 3)]])
def test_tiling_of_hardly_any_points_has_no_faces(points):
    simulation = Simulation(Scene([Body(f"p{i}", [p]) for i, p in enumerate(points)]))

    assert list(simulation.run()) == []
    assert (simulation.name, simulation.tiling.faces) == ("incremental", ())
    assert len(simulation.tiling.edges) == (len(points) == 2)


@pytest.mark.parametrize("family", ["convex", "stars", "pieces", "turning"])
def test_a_structure_from_outside_is_kept_up_to_date(registered, family):
    ranks = 0
    for seed in range(3):
        scene = generate(family, seed)
        kinetic = start_tiling(scene, "ranked", scene.start)
        try:
            while True:
                end = kinetic.next_number() or AlgebraicNumber(scene.end)
                if kinetic.now.compare(end) < 0:
                    at = rational_between(kinetic.now, end)
                    kinetic.audit_structure(PredicatesAt(kinetic.vertices, at))
                if kinetic.advance(scene.end) is None:
                    break
        except ContactFound:
            pass
        ranks += kinetic.stats.events.get("rank", 0)
        expected, found = reference.first_contact(scene), first_contact(scene, tiling="ranked")
        assert (expected and expected.time) == (found and found.time)
    assert ranks > 0


def test_a_structure_from_outside_is_saved_and_goes_on(registered, tmp_path):
    scene = generate("convex", 3)
    whole = [event.to_json() for event in Simulation(scene, tiling="ranked").run()]
    simulation = Simulation(scene, tiling="ranked")
    middle = simulation.run((scene.start + scene.end) / 4)
    events = [event.to_json() for event in middle]

    simulation.save(tmp_path / "run.json")
    simulation = Simulation.restore(tmp_path / "run.json")

    assert events + [event.to_json() for event in simulation.run()] == whole


def test_bodies_come_and_go_in_a_structure_from_outside(registered):
    scene = generate("small_grid", 0)
    rng, simulation = Random(5), Simulation(scene, tiling="ranked")
    names = [body.name for body in scene.bodies]
    out = [simulation.body(name) for name in rng.sample(names, 3)]
    kinetic = simulation.kinetic
    for body in out:
        simulation.remove(body.name)
        kinetic.audit_structure(PredicatesAt(kinetic.vertices, scene.start))
    for body in out:
        simulation.add(body)
        kinetic.audit_structure(PredicatesAt(kinetic.vertices, scene.start))
    assert simulation.stats["rebuilds"] == 0


@pytest.mark.parametrize("family", ["stars", "turning_stars", "chains"])
def test_flipping_rules_from_outside_keep_the_same_tiling(registered, monkeypatch, family):
    """The rules of `greedy`, not compiled, where those of the package are."""
    source = Path(exactpt.__file__).parent / "tiling" / "greedy" / "shadowed.py"
    spec = spec_from_file_location("plain_shadowed", source)
    module = module_from_spec(spec)
    spec.loader.exec_module(module)
    monkeypatch.setitem(sys.modules, "plain_shadowed", module)
    scene = generate(family, 1)

    inside, outside = Simulation(scene, tiling="greedy"), Simulation(scene, tiling="plain")

    events = [event.to_json() for event in outside.run()]
    assert type(outside.kinetic.rules) is module.ShadowRules
    assert type(inside.kinetic.rules).__name__ == "ShadowRules"
    assert events == [event.to_json() for event in inside.run()]
    assert len(events) > 0


DART = [(0, 0), (4, 2), (0, 4), (1, 2)]
BOX = [(9, 0), (10, 0), (10, 1), (9, 1)]


@pytest.mark.parametrize(
    ("bodies", "tiling", "rules", "why"),
    [
        ([BOX], "greedy", "VerticalRules", "all bodies stay convex"),
        ([BOX, DART], "greedy", "ShadowRules", "body 'b1' need not stay convex"),
        ([BOX, DART], "auto", "MixedRules", "body 'b1' need not stay convex"),
        ([BOX], "auto", "VerticalRules", "all bodies stay convex"),
        ([BOX], "mixed", "MixedRules", "mixed is for any bodies"),
        ([[(0, 0)], [(1, 1)]], "auto", "IncrementalTiling", "all bodies are points"),
    ],
)
def test_stats_name_the_rules_and_why_they_were_chosen(bodies, tiling, rules, why):
    scene = Scene([Body(f"b{i}", outline) for i, outline in enumerate(bodies)], time=(0, 1))

    stats = Simulation(scene, tiling=tiling).stats

    assert (stats["rules"], stats["why"]) == (rules, why)
