"""The fan triangulation of moving points (paper, section 3.4), by hand.

That its events lead from each triangulation to the next is the law `simulation/fan`.
"""

import json
import pickle
from copy import copy

import pytest
from commands import code_of, run
from passing_points import pair, passing

from exactpt import AlgebraicNumber, Body, InputError, Scene, Simulation, Translation
from exactpt.simulation.store import sealed
from exactpt.testing.scenes import generate


def words(text):
    return set(text.split())


def triangulation(snapshot):
    """The edges of the tiling and of its fan, as pairs of the names of vertices."""
    names = [f"{node.body}:{node.vertex}" for node in snapshot.nodes]
    edges = [(edge.u, edge.v) for edge in snapshot.edges]
    return {frozenset((names[u], names[v])) for u, v in [*edges, *snapshot.fan]}


def replay(edges, events):
    """Apply the events of the fan to the edges of the triangulation, and check each of them."""
    for event in events:
        if event.kind == "fan":
            removed, added = (set(map(frozenset, part)) for part in (event.removed, event.added))
            assert removed <= edges
            assert edges.isdisjoint(added)
            edges = edges - removed | added
    return edges


def test_fan_of_a_passing_point_changes_as_derived_by_hand():
    """The tangents by their slopes, for q at (x, 0) with x = 9 - t.

    Left of p at (8, 13), the slopes to p are 13/8 (b), 3/7 (t), 6/5 (m), 10/6 (n): the least is
    that of t, the largest that of n, so p is joined to t, m, n. At the start q comes after p; the
    slopes to q are -13/(x - 8) (p, the least) and 0 (b, the largest): q is joined to p, n, b.

    At t = 1, x = 8: q comes before p. The slopes to q are -10/(x - 1) (t), -7/(x - 3) (m),
    -3/(x - 2) (n), 0 (b). That of t is the least while 7 (x - 1) < 10 (x - 3), x > 23/3: q is
    joined to t, m, n, b. The largest slope to p is that of q now: p is joined to t, q alone.

    At t = 4/3, x = 23/3: from then on m has the least slope to q, q is joined to m, n, b, and
    p to t, m, q.
    """
    simulation = Simulation(passing(), tiling="incremental", fan=True)
    assert set(map(frozenset, map(pair, triangulation(simulation.tiling)))) == set(
        map(frozenset, words("bt bn nt mt mn pt mp np pq nq bq"))
    )

    events = list(simulation.run())

    changes = [
        (str(event.time), event.kind, set(map(pair, event.removed)), set(map(pair, event.added)))
        for event in events
    ]
    assert [change[1:] for change in changes] == [
        ("x-order", {"np"}, {"qt"}),
        ("fan", {"mp", "np"}, {"qt", "mq"}),
        ("corner", {"qt"}, {"mq"}),
        ("fan", {"qt"}, {"mp"}),
    ]
    assert [event.time for event in events] == [
        1,
        1,
        AlgebraicNumber("4/3"),
        AlgebraicNumber("4/3"),
    ]
    assert simulation.stats["fan_changes"] == 4 + 2
    assert simulation.stats["events"] == 2


@pytest.mark.parametrize("number", [0, 1, 7, 20])
def test_fan_is_kept_by_files_copies_and_pickles(tmp_path, number):
    def begun():
        simulation = Simulation(generate("linear_points", 4), fan=True)
        for _ in zip(range(number), simulation.run(), strict=False):
            pass
        return simulation

    begun().save(tmp_path / "run.json")
    whole = begun()
    lines = [e.to_json() for e in whole.run()]

    assert {line["kind"] for line in lines} >= {"fan", "x-order"}
    restored = Simulation.restore(tmp_path / "run.json")
    for other in (restored, copy(begun()), pickle.loads(pickle.dumps(begun()))):
        assert [e.to_json() for e in other.run()] == lines
        assert other.stats["fan_changes"] == whole.stats["fan_changes"]


def test_saved_run_without_a_fan_has_no_key_of_it():
    assert "fan" not in Simulation(passing()).to_json()["state"]


def test_forged_fan_of_another_tiling_is_refused(tmp_path):
    data = Simulation(passing(), tiling="lazy").to_json()
    del data["exactpt-simulation"], data["sha256"]
    data["state"]["fan"] = 3
    (tmp_path / "run.json").write_text(json.dumps(sealed(data)))

    with pytest.raises(InputError, match="no fan, which the lazy tiling does not have, got 3"):
        Simulation.restore(tmp_path / "run.json")


def test_bodies_that_come_and_go_and_new_motions_change_the_fan():
    simulation = Simulation(passing(), fan=True)
    edges = triangulation(simulation.tiling)
    edges = replay(edges, simulation.run("1/2"))
    changes = [
        lambda: simulation.add(Body("r", [(7, 5)])),
        lambda: simulation.remove("m"),
        lambda: simulation.set_motion("q", Translation([0, -1], ["-1/2", 1])),
        lambda: simulation.remove("b"),
    ]
    for change in changes:
        change()
        edges = replay(edges, simulation.run(simulation.now))
        assert triangulation(simulation.tiling) == edges
    edges = replay(edges, simulation.run("19/10"))
    assert triangulation(simulation.tiling) == edges


def test_polygon_added_to_a_run_with_a_fan_is_refused_and_the_run_goes_on():
    simulation = Simulation(passing(), fan=True)
    list(simulation.run("1/2"))

    with pytest.raises(InputError, match="only points have a fan triangulation, got body 's' with"):
        simulation.add(Body("s", [(20, 0), (21, 0), (21, 1)]))

    assert [event.kind for event in simulation.run()] == ["x-order", "fan", "corner", "fan"]


def test_proof_of_a_run_with_a_fan_is_that_of_a_run_without(tmp_path):
    for name, fan in (("with", True), ("without", False)):
        simulation = Simulation(passing(), fan=fan, proof=tmp_path / name)
        list(simulation.run())
    proofs = [(tmp_path / name / "1.proof").read_bytes() for name in ("with", "without")]
    assert proofs[0] == proofs[1]


BOX = Scene([Body("box", [(0, 0), (2, 0), (2, 1)]), Body("p", [(5, 5)])], (0, 1))


@pytest.mark.parametrize(
    ("scene", "tiling", "reason"),
    [
        (BOX, "auto", "got body 'box' with 3 vertices; leave the fan out"),
        (BOX, "greedy", "got body 'box' with 3 vertices; leave the fan out"),
        (BOX, "incremental", "body 'box': has 3 vertices: the incremental tiling is for points"),
        (passing(), "greedy", "got the greedy tiling; leave the fan out, or choose the tiling"),
        (Scene([Body("disc", [(0, 0)], radius=1)]), "auto", "body 'disc' has a radius"),
    ],
)
def test_fan_of_other_bodies_or_tilings_is_refused(tmp_path, capsys, scene, tiling, reason):
    with pytest.raises(InputError, match=reason.replace("(", r"\(")):
        Simulation(scene, tiling=tiling, fan=True)
    scene.save(tmp_path / "scene.json")
    file, choice = tmp_path / "scene.json", ("--fan", "--tiling", tiling)
    for command in ("tile", "simulate"):
        assert code_of(command, file, *choice) == 2
        captured = capsys.readouterr()
        assert captured.out == ""
        assert captured.err.count("\n") == 1
        assert reason in captured.err


def test_fan_of_the_snapshot_of_another_tiling_is_refused():
    with pytest.raises(InputError, match="got the lazy tiling"):
        _ = Simulation(passing(), tiling="lazy").tiling.fan


def test_tile_with_fan_prints_the_same_built_and_reached_by_a_run(tmp_path):
    """At t = 3/2 the tiles of q and of p have one vertex each that is no corner: n, and m."""
    passing().save(tmp_path / "scene.json")
    built, reached = (
        json.loads(run("tile", tmp_path / "scene.json", "--fan", "--at", "3/2", *more).output)
        for more in ((), ("--run",))
    )
    names = [vertex["body"] for vertex in built["vertices"]]
    assert {pair((names[u], names[v])) for u, v in built["fan"]} == {"nq", "mp"}
    assert built == reached


def test_simulate_with_fan_writes_its_events(tmp_path):
    passing().save(tmp_path / "scene.json")
    run("simulate", tmp_path / "scene.json", "--fan", "--events", tmp_path / "e.jsonl")

    events = map(json.loads, (tmp_path / "e.jsonl").read_text().splitlines())

    assert [e["kind"] for e in events] == ["x-order", "fan", "corner", "fan"]
