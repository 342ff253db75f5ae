"""Runs with bodies in holes: events, new plans, bodies that come and go, saved runs, refusals."""

import pytest

from exactpt import Body, InputError, Scene, Simulation, Translation, first_contact
from exactpt.kernel.algebraic import rational_between
from exactpt.pseudotriangulation.mesh import FREE, INSIDE, OUTER, SOLID
from exactpt.testing.audits import audit_at, run_and_audit
from exactpt.testing.scenes import RINGS, generate
from exactpt.tiling.start import TILINGS

FRAME = [(0, 0), (12, 0), (12, 12), (0, 12)]
HOLE = [(1, 1), (11, 1), (11, 11), (1, 11)]
ISLE = [(2, 2), (4, 2), (2, 4)]


def room(*bodies, **options):
    frame = Body("frame", parts=[{"vertices": FRAME, "holes": [HOLE]}, ISLE], **options)
    return Scene([frame, *bodies], (0, 20))


def ball(speed=(1, 0)):
    return Body("ball", [(6, 6), (7, 6), (6, 7)], Translation([0, speed[0]], [0, speed[1]]))


def components(mesh):
    """The vertices of each component of a mesh."""
    left, found = {v for v, h in enumerate(mesh.ring_edge) if h >= 0}, []
    while left:
        reached, todo = set(), [min(left)]
        while todo:
            v = todo.pop()
            if v not in reached:
                reached.add(v)
                todo += [mesh.map.target(h) for h in mesh.map.star(mesh.ring_edge[v])]
        found.append(reached)
        left -= reached
    return found


def test_a_free_component_for_every_hole():
    simulation = Simulation(room(ball(), Body("out", [(20, 5)])))
    mesh = simulation.kinetic.mesh
    found = components(mesh)
    assert sorted(map(len, found)) == [4 + 3, 4 + 3 + 3]  # "out" has three infinitesimal copies
    for component in found:
        half_edges = [h for h in mesh.map.half_edges() if mesh.map.origin[h] in component]
        cycles = {min(mesh.map.face(h)): mesh.region[h] for h in half_edges}
        assert len(component) - len(half_edges) // 2 + len(cycles) == 2
        assert set(cycles.values()) <= {FREE, SOLID, OUTER}
    assert simulation.name == "mixed"


def test_the_inside_of_a_deforming_body_is_tiled_around_its_holes():
    hole = [{"x": [x], "y": [y, "1/9"]} for x, y in HOLE]
    frame = Body("frame", FRAME, holes=[hole])
    simulation = Simulation(Scene([frame, ball((0, 0))], (0, 20)))
    mesh = simulation.kinetic.mesh
    assert len(components(mesh)) == 1
    assert len(mesh.faces(INSIDE)) == 4
    list(simulation.run())
    assert (simulation.contact.kind, simulation.contact.time) == ("self", 9)


@pytest.mark.long
@pytest.mark.parametrize("tiling", TILINGS)
@pytest.mark.parametrize("family", sorted(RINGS))
def test_the_tiling_is_valid_between_all_events(family, tiling):
    """And equal to the one built there, if it is canonical; no event calls for a rebuild."""
    for seed in range(5):
        audited = run_and_audit(generate(family, seed), tiling, middle=True)
        assert audited is None or audited.kinetic.stats.rebuilds == 0


@pytest.mark.long
def test_a_saved_run_goes_on(tmp_path):
    for seed in range(6):
        scene = generate("lakes", seed)
        whole = Simulation(scene)
        if whole.tiling is None:
            continue
        reported = [event.to_json() for event in whole.run()]
        part = Simulation(scene)
        begun = [event.to_json() for event in part.run(until=scene.end / 3)]
        if part.contact is not None:
            continue
        part.save(tmp_path / "run.json")
        rest = [event.to_json() for event in Simulation.restore(tmp_path / "run.json").run()]
        assert [e for e in begun + rest if e["kind"] != "contact"] == [
            e for e in reported if e["kind"] != "contact"
        ]


@pytest.mark.parametrize("tiling", TILINGS)
def test_plans_of_a_body_with_holes_and_what_comes_or_goes_in_them_are_local(tiling):
    simulation = Simulation(room(ball((0, 0))), tiling=tiling)
    list(simulation.run(until=1))
    simulation.set_motion("frame", Translation([-1, 1], [0]))
    kinetic = simulation.kinetic
    assert kinetic.stats.rebuilds == 0
    audit_at(kinetic, rational_between(kinetic.now, kinetic.next_number()))
    simulation.add(Body("late", [(3, 8), (4, 8)]))
    simulation.add(Body("inner", [(9, 9)]))
    simulation.remove("late")
    assert simulation.kinetic.stats.rebuilds == (3 if tiling == "mixed" else 0)  # its loop changes
    kinetic = simulation.kinetic
    audit_at(kinetic, rational_between(kinetic.now, kinetic.next_number()))
    list(simulation.run())
    truth = first_contact(
        Scene([room(motion=Translation([-1, 1])).bodies[0], ball((0, 0)), Body("inner", [(9, 9)])],
              (1, 20)),
        method="pairs",
    )  # fmt: skip
    assert simulation.contact.time == truth.time
    assert simulation.contact.kind == truth.kind


def test_a_body_with_holes_is_added_around_another_one():
    simulation = Simulation(Scene([ball((0, 0))], (0, 20)))
    simulation.add(room().bodies[0].with_motion(Translation([0, 1])))
    list(simulation.run())
    assert simulation.contact.time == 5
    other = Simulation(Scene([Body("x", [("1/2", "1/2")])], (0, 2)))
    with pytest.raises(InputError, match="touches"):
        other.add(room().bodies[0])


def test_a_plan_may_begin_to_deform_the_body():
    simulation = Simulation(room(ball((0, 0))))
    list(simulation.run(until=1))
    hole = [{"x": [x - 1, 1], "y": [y]} for x, y in HOLE]
    frame = Body("frame", parts=[{"vertices": FRAME, "holes": [hole]}, ISLE])
    simulation.set_motions({"frame": frame})
    assert simulation.kinetic.stats.rebuilds == 1
    list(simulation.run())
    assert (simulation.contact.kind, simulation.contact.time) == ("self", 2)


def test_stopping_and_bouncing_keep_the_rings():
    simulation = Simulation(room(ball()))
    list(simulation.run())
    assert simulation.contact.time == 4
    frame = simulation.body("frame").halted(4)
    assert frame.parts == simulation.body("frame").parts
    assert frame == room().bodies[0]
