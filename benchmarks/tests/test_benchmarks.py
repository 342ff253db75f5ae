"""Every benchmark at tiny sizes: the files, the counts, and that a wrong answer is an error."""

import sys
from collections import Counter
from functools import partial
from random import Random
from types import SimpleNamespace

import pytest
from click.testing import CliRunner

from benchmarks import (
    arithmetic,
    arrays,
    auto,
    batch,
    changes,
    cliffs,
    counts,
    crowds,
    doubles,
    exponents,
    first_contact,
    kernel,
    large,
    living,
    motions,
    points,
    proofs,
    scaling,
    skipping,
    small,
    stability,
    statics,
    timing,
    within,
    wrong_answers,
)
from benchmarks.__main__ import bench
from benchmarks.catalogue import BENCHMARKS
from benchmarks.everyday import EVERYDAY
from benchmarks.everyday_later import EVERYDAY_LATER
from benchmarks.methods.cpp import has_compiler
from benchmarks.methods.method import Method
from benchmarks.motion_scenes import BESIDE, PLANS, SCENES, measured
from benchmarks.number_types import ARITHMETICS
from benchmarks.planted import FAMILIES as PLANTED
from benchmarks.planted import Planted
from benchmarks.tests.bench_help import Results, meeting
from exactpt import AlgebraicNumber, AuditError, Body, Scene
from exactpt.cli import main

NO_PEERS = (
    "shapely", "pymunk", "ipctk", "Box2D", "fcl", "flint", "sympy", "mpmath", "matplotlib",
)  # fmt: skip


@pytest.fixture
def results(tmp_path):
    return Results(tmp_path)


@pytest.fixture
def alone(monkeypatch):
    """Nothing optional is installed."""
    for module in NO_PEERS:
        monkeypatch.setitem(sys.modules, module, None)


@pytest.fixture
def undrawn(monkeypatch):
    """Plots take longer than all else."""
    monkeypatch.setitem(sys.modules, "matplotlib", None)


def plots(results):
    return [name for name in results.names() if name.endswith(".svg")]


def test_wrong_answers_of_ours_are_none(results):
    pytest.importorskip("matplotlib")
    wrong_answers.run(results.output, wrong_answers.Sizes(2, 50), 1)
    rows = [row for row in results.rows("wrong-answers") if row["method"] == "exactpt"]
    assert len(rows) == 3 * len(PLANTED)
    assert {(row["missed"], row["invented"], row["off"]) for row in rows} == {("0", "0", "0")}
    assert {row["scenes"] for row in rows} == {"2"}
    assert plots(results) == ["wrong-answers.svg"]


def test_a_wrong_answer_of_ours_is_an_error(results, monkeypatch, alone):
    wrong = {"wrong": lambda _: Planted(meeting(), AlgebraicNumber(2))}
    monkeypatch.setattr(wrong_answers, "FAMILIES", wrong)
    with pytest.raises(AuditError, match="exactpt kinetic, wrong"):
        wrong_answers.run(results.output, wrong_answers.Sizes(1, 10), 0)


def test_methods_without_their_package_are_left_out(results, alone):
    wrong_answers.run(results.output, wrong_answers.Sizes(1, 10), 0)
    methods = {row["method"] for row in results.rows("wrong-answers")}
    assert methods == {"exactpt", "all pairs, doubles"}
    skipped = [line.split()[1] for line in results.said if line.startswith("skipped")]
    assert skipped == ["shapely", "pymunk", "ipctk", "matplotlib"]


def test_first_contact(results, undrawn):
    tiny = first_contact.Sizes(
        dict.fromkeys(first_contact.FAMILIES, (4,)) | {"combs": (16,), "spirals": (16,)},
        scenes=1,
        steps=(20,),
        seconds=1.0,
        runs=2,
    )
    first_contact.run(results.output, tiny, 0)
    rows = results.rows("first-contact")
    own = [row for row in rows if row["method"] == "exactpt"]
    scenes = [row for row in own if row["setting"] != "from arrays"]
    assert len(scenes) == 2 * len(first_contact.FAMILIES)
    assert len(own) > len(scenes)
    assert {(row["missed"], row["invented"]) for row in own} == {("0", "0")}
    assert {row["error"] for row in own} <= {"0.0", ""}
    reference = [row for row in rows if row["method"] == "all pairs, exact"]
    assert {row["family"] for row in reference} == set(first_contact.FAMILIES)
    assert {row["truth"] for row in rows} == {"planted", "all pairs, exact"}


@pytest.mark.parametrize(("seconds", "asked"), [(60.0, 3), (-1.0, 1)])
def test_the_fastest_of_some_runs_counts_where_one_is_short(
    results, monkeypatch, alone, seconds, asked
):
    times = iter([5.0, 3.0, 4.0, *[9.0] * 20])
    monkeypatch.setattr(first_contact, "timed", lambda ask: (ask(), next(times)))
    tiny = first_contact.Sizes({"combs": (16,)}, scenes=1, steps=(), seconds=seconds, runs=3)
    first_contact.run(results.output, tiny, 0)
    row = results.rows("first-contact")[0]
    assert float(row["seconds"]) == min([5.0, 3.0, 4.0][:asked])


def test_an_error_of_ours_in_a_first_contact_is_an_error(results, monkeypatch, alone):
    monkeypatch.setitem(first_contact.PLANTED, "combs", AlgebraicNumber(13))
    tiny = first_contact.Sizes({"combs": (16,)}, scenes=1, steps=(), seconds=1.0, runs=1)
    with pytest.raises(AuditError, match="is wrong about"):
        first_contact.run(results.output, tiny, 0)


def test_two_ways_that_disagree_are_an_error(results, monkeypatch, alone):
    other = Method("exactpt", "other", lambda _: lambda: AlgebraicNumber(1))
    monkeypatch.setattr(first_contact, "OWN", (first_contact.OWN[0], other))
    tiny = first_contact.Sizes({"spirals": (16,)}, scenes=1, steps=(), seconds=0.0, runs=1)
    with pytest.raises(AuditError, match="two ways disagree"):
        first_contact.run(results.output, tiny, 0)


def test_another_method_that_is_too_slow_is_not_asked_again(results, alone):
    tiny = first_contact.Sizes({"grazing": (1, 2)}, scenes=1, steps=(), seconds=-1.0, runs=1)
    first_contact.run(results.output, tiny, 0)
    asked = [(row["size"], row["method"]) for row in results.rows("first-contact")]
    assert asked == [("1", "exactpt")] * 2 + [("1", "all pairs, doubles")] + [("2", "exactpt")] * 2


def test_arithmetic(results, undrawn):
    arithmetic.run(results.output, arithmetic.Sizes(10, 5, (2, 100, None)), 0)
    rows = {(r["degeneracy"], r["arithmetic"]): r for r in results.rows("arithmetic")}
    assert len(rows) == 3 * len(ARITHMETICS)
    wrong = {
        key: sum(float(row[f"wrong {kind}"]) for kind in ("signs", "orders", "structures"))
        for key, row in rows.items()
    }
    assert all(wrong[d, a] == 0.0 for d, a in wrong if a in ("exact", "float64, filter"))
    assert all(wrong["10^-2", a.name] == 0.0 for a in ARITHMETICS)
    assert wrong["10^-100", "mpfr 1024"] == 0.0
    assert wrong["10^-100", "float64"] > 0.0
    assert wrong["0", "mpfr 1024"] > 0.0


def test_stability(results):
    pytest.importorskip("matplotlib")
    tiny = stability.Sizes(3, (-1000, 1000), (200,), (50,), (1, 3), (300,), 1)
    stability.run(results.output, tiny, 0)
    rows = results.rows("stability")
    assert len(rows) == 2 * (1 + 2 + 1 + 1 + 2 + 1)
    assert {row["same answer"] for row in rows} == {"yes"}
    assert plots(results) == ["stability-digits.svg", "stability-degree.svg"]


def test_stability_sees_another_answer(results, monkeypatch, alone):
    monkeypatch.setattr(stability, "_scaled", lambda movers, _: stability._retimed(
        movers, stability._clock(3)))  # fmt: skip
    with pytest.raises(AuditError, match="scale"):
        stability.run(results.output, stability.Sizes(3, (10,), (), (), (), (), 1), 0)


def test_scaling(results, undrawn):
    scaling.run(results.output, scaling.Sizes((4, 8), (16, 32), 30, 1, (20,)), 0)
    rows = results.rows("scaling")
    measured = [row for row in rows if row["most"]]
    assert len(measured) == 3 * (2 + 2 * 4)
    crowds = [row for row in measured if row["family"] == "convex crowd"]
    assert all(int(row["most"]) <= 30 * int(row["size"]) for row in crowds)
    assert all(0 < int(row["pending"]) <= int(row["made"]) for row in crowds)
    assert all((row["simulation"] != "") == (int(row["events"]) > 0) for row in measured)
    far = [r for r in measured if (r["family"], r["tiling"]) == ("combs, far apart", "mixed")]
    assert [row["made"] for row in far] == ["16", "16"]
    assert len(results.rows("scaling-exponents")) == 3 * 5
    large = [row for row in rows if row["size"] == "20" and row["events"]]
    assert [row["tiling"] for row in large] == ["lazy", "greedy"]
    assert all(int(row["events"]) > 0 and float(row["start s"]) > 0 for row in large)
    floors = [row for row in rows if row["tiling"] == scaling.ALONE]
    assert [int(row["size"]) for row in floors] == [4, 8, 20]
    assert all(float(row["us an event"]) > 0 for row in floors)


def test_batch(results):
    batch.run(results.output, batch.Sizes(12, 6), 0)
    (row,) = results.rows("batch")
    assert row["scenes"] == "12"
    assert all(float(row[name]) > 0 for name in ("MB of results", "us a scene", "MB of a process"))


def test_a_batch_with_another_result_is_an_error():
    batch.check(['{"contact": null}'], [None])
    with pytest.raises(AuditError, match="disagree about scene 1"):
        batch.check(['{"contact": null}', '{"contact": {}}'], [None, None])


def test_points(results, undrawn):
    points.run(results.output, points.Sizes((8, 16), (8,), (8,)), 0)
    rows = results.rows("points")
    assert len(rows) == 2 * 5
    assert all(int(row["changes of the IPT"]) > 0 for row in rows)
    chains = results.rows("points-chains")
    assert len({row["events"] for row in chains if row["chains"].startswith("short")}) == 1
    assert {row["events"] for row in chains if row["chains"].startswith("long")} == {"400"}


def test_statics(results):
    statics.run(results.output, statics.Sizes(9, (8, 64, 512)), 0)
    rows = results.rows("statics")

    assert [row["diagonals"] for row in rows] == ["24"] * 3
    assert float(results.rows("statics-exponents")[0]["p decisions"]) < 0.6


def test_skipping(results):
    skipping.run(results.output, skipping.Sizes({"dense": 6, "combs": 16}, 5), 0)
    cells = {(r["scene"], r["what"]): r for r in results.rows("skipping")}
    assert cells["convoy", "certificates"]["paid"] == "0"
    assert cells["convoy", "polynomials"]["paid"] == "0"
    for what in ("exact decisions", "polynomials", "comparisons"):
        row = cells["dense", what]
        assert int(row["paid"]) < int(row["without skipping"])
    for method in ("kinetic", "pairs"):
        row = cells[f"imports, {method}", "modules of exactpt"]
        assert 0 < int(row["paid"]) < int(row["without skipping"])


def test_kernel(results, undrawn):
    kernel.run(results.output, kernel.Sizes(3, (1, 2, 4), (32,), (5,), 20), 0)
    rows = results.rows("kernel")
    assert {row["program"] for row in rows} >= {"exactpt, exact", "exactpt, filter", "SymPy"}
    exact = [row for row in rows if row["program"] == "exactpt, exact"]
    assert {(row["answered"], row["to 1e-9"]) for row in exact} == {("1.0", "1.0")}
    assert len(results.rows("kernel-batches")) == 2
    certificates = results.rows("kernel-certificates")
    assert [row["degree of motion"] for row in certificates] == ["1", "2", "3"]
    assert {float(row["decided by the filter"]) for row in certificates} == {1.0}


def test_kernel_without_peers(results, alone):
    kernel.run(results.output, kernel.Sizes(2, (2,), (32,), (5,), 1), 0)
    programs = [row["program"] for row in results.rows("kernel")]
    assert programs == ["exactpt, exact", "exactpt, filter"]
    assert plots(results) == []


def test_arrays(results, alone):
    arrays.run(results.output, arrays.Sizes(2000, 500, 20), 0)
    rows = results.rows("arrays")
    assert [row["program"] for row in rows] == ["exactpt, arrays", "exactpt, first_contact"] * 3
    ours = rows[::2]
    assert [int(row["asked"]) for row in ours] == [2000, 500, 500]
    assert all(float(row["exact share"]) < 0.001 for row in ours)
    assert min(int(row["contacts"]) for row in ours[:2]) > 100


@pytest.mark.parametrize("package", ["ipctk", "Box2D"])
def test_arrays_beside_other_programs(results, package):
    pytest.importorskip(package)
    arrays.run(results.output, arrays.Sizes(200, 200, 10), 0)
    assert any(row["program"].startswith(package) for row in results.rows("arrays"))


def test_another_answer_of_arrays_is_an_error(results, monkeypatch, alone):
    monkeypatch.setattr(arrays, "first_contact", lambda _: None)
    with pytest.raises(AuditError, match="points against segments, question"):
        arrays.run(results.output, arrays.Sizes(200, 20, 50), 0)


# The command


def tiny_benchmark(output, sizes, seed):
    output.table("tiny", [{"sizes": sizes, "seed": seed}])


@pytest.fixture
def one_benchmark(monkeypatch):
    module = SimpleNamespace(run=tiny_benchmark, QUICK="quick", FULL="full")
    monkeypatch.setattr("benchmarks.catalogue.import_module", lambda _: module)


def code_of_bench(*arguments):
    """Return the exit code of `python -m benchmarks` with these arguments."""
    with pytest.raises(SystemExit) as ended:
        main(list(map(str, arguments)), command=bench, name="python -m benchmarks")
    return ended.value.code


def test_the_command_names_machine_versions_and_seed(tmp_path, one_benchmark):
    done = CliRunner().invoke(bench, ["kernel", "--seed", "5", "-o", str(tmp_path / "f")])
    assert done.exit_code == 0
    assert "gmpy2" in done.output
    assert "seed 5, full sizes" in done.output
    assert (tmp_path / "f" / "tiny.csv").read_text() == "sizes,seed\nfull,5\n"
    assert "gmpy2" in (tmp_path / "f" / "machine.txt").read_text()


def test_all_run_if_none_is_named(tmp_path, one_benchmark):
    done = CliRunner().invoke(bench, ["--quick", "-o", str(tmp_path)])
    assert all(f"\n{name}: " in done.output for name in BENCHMARKS)
    assert (tmp_path / "tiny.csv").read_text() == "sizes,seed\nquick,0\n"


@pytest.mark.parametrize("arguments, word", [(["nothing"], "nothing"), (["kernel", "-o"], "-o")])
def test_a_bad_call_is_one_line(arguments, word, capsys):
    assert code_of_bench(*arguments) == 2
    said = capsys.readouterr().err.splitlines()
    assert len(said) == 1
    assert word in said[0]


def test_a_folder_that_is_a_file_is_refused(tmp_path, capsys):
    (tmp_path / "file").write_text("")
    assert code_of_bench("kernel", "-o", tmp_path / "file") == 2
    assert capsys.readouterr().err.count("\n") == 1


def test_within(results, alone):
    within.run(results.output, within.Sizes(bodies=12, runs=1), 0)
    rows = results.rows("within")
    assert [row["ratio"] for row in rows if row["question"] == "first_contact"] == ["1.0"] * 3
    assert len(rows) == 12


def test_a_wrong_approach_is_an_error(results, monkeypatch, alone):
    monkeypatch.setattr(within, "first_within", lambda *_, **__: None)
    with pytest.raises(AuditError, match="disagree about distance"):
        within.run(results.output, within.Sizes(bodies=12, runs=1), 0)


def test_small(results, alone):
    tiny = small.Sizes(triangles=3, bodies=9, plans=3, pieces=4, runs=1)
    small.run(results.output, tiny, 0)
    rows = results.rows("small")
    assert {row["question"] for row in rows} == {
        "two triangles",
        "9 convex bodies",
        "9 octagons",
        "9 discs",
        "plans among 30 obstacles",
        "20 bodies of 4 pieces",
    }
    assert {row["error"] for row in rows if row["method"].startswith("exactpt")} <= {"0.0", ""}
    assert len(rows) == 13


def test_crowds(results):
    crowds.run(results.output, crowds.Sizes((9,), (9, 16), 1), 0)
    rows = results.rows("crowds")
    assert [(row["crowd"], row["bodies"], row["scene of"]) for row in rows] == [
        (crowd, bodies, way)
        for crowd, bodies in (("dense", "9"), ("sparse", "9"), ("sparse", "16"))
        for way in ("arrays", "bodies")
    ]
    assert any(row["time"] for row in rows)
    assert all(float(row["ms to answer"]) > 0 for row in rows)


def test_a_wrong_answer_about_a_crowd_is_an_error(results, monkeypatch):
    monkeypatch.setattr(crowds, "_from_bodies", lambda _: Scene([Body("a", [(0, 0)])]))
    with pytest.raises(AuditError, match="9 bodies, dense"):
        crowds.run(results.output, crowds.Sizes((9,), (), 1), 0)


def test_a_wrong_answer_to_a_small_question_is_an_error(results, monkeypatch, alone):
    monkeypatch.setattr(small.reference, "first_contact", lambda _: None)
    with pytest.raises(AuditError, match="disagree about two triangles"):
        small.run(results.output, small.Sizes(3, 9, 3, 4, 1), 0)


def test_doubles_are_beside_the_floor(results):
    doubles.run(results.output, doubles.Sizes(triangles=3, crowds={9: 2, 16: 2}, turns=1), 0)
    rows = results.rows("doubles")
    ways = 3 if has_compiler() else 2
    questions = ["two triangles"] * ways + ["9 bodies"] * ways + ["16 bodies"] * ways
    assert [row["question"] for row in rows] == questions
    assert len({(row["question"], row["contacts"]) for row in rows}) == 3
    assert [row["contacts"] for row in rows[:ways]] == ["3"] * ways


def test_a_wrong_time_beside_the_floor_is_an_error(results, monkeypatch):
    monkeypatch.setattr(doubles, "_prepare_arrays", lambda _: lambda: 1.0)
    with pytest.raises(AuditError, match="two triangles: from arrays"):
        doubles.run(results.output, doubles.Sizes(3, {}, 1), 0)


@pytest.fixture
def old_is_this_one(monkeypatch):
    """This version in the place of the old one: whatever is built, the results are the same."""
    monkeypatch.setattr(motions, "is_built", lambda: True)
    monkeypatch.setattr(motions, "SITE", motions.HERE)


TINY_MOTIONS = motions.Sizes(
    dict.fromkeys([*SCENES, PLANS], (4,)) | {"combs": (24,)}, crowd=4, turns=2
)


def test_motions_are_asked_of_both_versions(results, old_is_this_one):
    motions.run(results.output, TINY_MOTIONS, 0)
    rows = results.rows("motions")
    assert [row["scene"] for row in rows] == [*SCENES, PLANS]
    assert {row["scene"] for row in rows if row["aim"]} == set(motions.AIMS)
    contacts = {row["scene"]: row["contact"] for row in rows}
    assert contacts["combs"] == "14.0"  # the teeth are 2 apart, and 1/7 is the speed
    assert contacts["turning stars, apart"] == ""
    assert all(float(row["old ms"]) > 0 and float(row["new ms"]) > 0 for row in rows)
    beside = results.rows("motions-beside")
    assert [(row["beside"], row["bodies"]) for row in beside] == [
        (what, "4" if what == "nothing" else "5") for what in BESIDE
    ]
    assert beside[0]["new times alone"] == "1.0"


def test_motions_without_the_old_version_say_so(results, monkeypatch):
    monkeypatch.setattr(motions, "is_built", lambda: False)
    motions.run(results.output, motions.Sizes({"combs": (24,)}, crowd=4, turns=1), 0)
    assert results.said[0] == "skipped: version 0.2 is not built (make old-engine)"
    assert [row["old ms"] for row in results.rows("motions")] == [""]
    assert len(results.rows("motions-beside")) == len(BESIDE)


def test_a_scene_in_motion_is_the_same_for_a_size_and_a_seed():
    first, second, other = (measured("discs", 16, seed) for seed in (0, 0, 1))
    assert first.found == second.found != other.found
    assert first.bodies == first.vertices == 16


def test_versions_that_disagree_about_a_motion_are_an_error(results, old_is_this_one, monkeypatch):
    found = iter([["1"], ["2"]])
    asked = measured("combs", 24, 0)
    monkeypatch.setattr(motions._Engine, "ask", lambda *_: asked._replace(found=next(found)))
    with pytest.raises(AuditError, match="disagree about combs, 24"):
        motions.run(results.output, motions.Sizes({"combs": (24,)}, crowd=4, turns=1), 0)


def test_counts_of_scenes_beside_each_other(results):
    counts.run(results.output, counts.Sizes(("combs", "sliding_capsules"), (1, 4)), 0)
    rows = results.rows("counts")
    assert [(row["family"], row["scenes"]) for row in rows] == [
        ("combs", "1"),
        ("combs", "4"),
        ("sliding_capsules", "1"),
        ("sliding_capsules", "4"),
    ]
    assert [row["bodies"] for row in rows[:2]] == ["2", "8"]
    assert [row["pairs"] for row in rows[:2]] == ["1", "4"]  # in one slab, none of two scenes
    assert 0 < int(rows[0]["compared"]) < int(rows[1]["compared"])


def test_a_contact_that_no_scene_alone_has_is_an_error(results, monkeypatch):
    monkeypatch.setattr(counts, "beside", lambda _: meeting())
    with pytest.raises(AuditError, match="the first of 1 scenes is 3, not None"):
        counts.run(results.output, counts.Sizes(("combs",), (1,)), 0)


def test_auto_is_beside_all_other_methods(results, alone):
    auto.run(results.output, auto.Sizes((1,), 1), 0)
    rows = results.rows("auto")
    assert [row["family"] for row in rows] == [*EVERYDAY, *EVERYDAY_LATER]
    for row in rows:
        assert row["best"] in ("pairs", "greedy", "mixed", "lazy")
        assert float(row["ratio"]) == pytest.approx(float(row["auto ms"]) / float(row["best ms"]))
    assert sum(row["contact"] != "" for row in rows) >= 5


def test_cliffs(results, alone):
    cliffs.run(results.output, cliffs.Sizes((9,), 9, 4, 1), 0)
    questions = Counter(row["question"] for row in results.rows("cliffs"))
    assert questions["convoy of 9"] == questions["4 turning bodies"] == 4
    assert sum("time span" in question for question in questions) == 8
    assert sum("rate" in question for question in questions) == 2
    lanes = {row["tiling"]: row for row in results.rows("cliffs-lanes")}
    assert list(lanes) == ["greedy", "mixed", "lazy"]
    assert lanes["greedy"]["times greedy"] == "1.0"
    assert all(float(row["exact share"]) < 0.01 for row in lanes.values())


def test_methods_that_disagree_are_an_error(monkeypatch):
    contact = SimpleNamespace(time=1, kind="vertex-edge", pairs=())
    monkeypatch.setattr(auto, "first_contact", lambda _, method: contact if method else None)
    with pytest.raises(AuditError, match="disagree about something"):
        auto.by_methods("something", meeting(), {"a": {"method": ""}, "b": {"method": "b"}}, 1)


def test_what_takes_long_is_asked_once(monkeypatch):
    asked = Counter()

    def prepare(name):
        asked[name] += 1
        return lambda: name

    monkeypatch.setattr(timing, "timed", lambda ask: (name := ask(), 0.1 if name == "fast" else 2))
    found = timing.in_turn({n: partial(prepare, n) for n in ("slow", "fast")}, 5)
    assert asked == {"slow": 1, "fast": 5}
    assert found == {"slow": ("slow", 2), "fast": ("fast", 0.1)}


@pytest.mark.cgal
def test_proofs(results, program, monkeypatch):
    monkeypatch.setenv("EXACTPT_CGAL_CHECK", str(program))
    proofs.run(results.output, proofs.Sizes(10, 16, 4, 2), 0)
    rows = results.rows("proofs")
    assert len(rows) == 7
    assert all(int(row["bytes an event"] or 0) <= 130 for row in rows)
    assert all(float(row["C++ s"]) >= 0 for row in rows)
    assert [row["family"] for row in results.rows("certificates")] == [
        "ballistic",
        "ballistic_points",
    ]
    costs = results.rows("certificate-costs")
    assert [row["cost"] for row in costs] == list(proofs.PARTS)
    assert all(
        float(row["least"]) <= float(row["median"]) + 0.1 <= float(row["largest"]) + 0.2
        for row in costs
    )


def test_proofs_without_the_program(results, tmp_path, monkeypatch):
    monkeypatch.setenv("EXACTPT_CGAL_CHECK", str(tmp_path / "none"))
    proofs.run(results.output, proofs.Sizes(10, 16, 2, 1), 0)
    assert {row["C++ s"] for row in results.rows("proofs")} == {""}


def test_a_proof_that_is_rejected_is_an_error(results, monkeypatch):
    wrong = "contact 0 0 vertex 0 vertex 1"
    monkeypatch.setattr("exactpt.proof.lines.Lines.none", lambda *_: iter([wrong]))
    with pytest.raises(AuditError, match="rejected: line"):
        proofs.run(results.output, proofs.Sizes(10, 16, 2, 1), 0)


TINY = living.Sizes((12,), ("lazy", "greedy"), 30, 10, 5)


def test_changes(results):
    changes.run(results.output, changes.QUICK, 0)
    fits = results.rows("changes-exponents")
    assert {row["tiling"] for row in fits} == {"greedy", "lazy"}
    assert all(float(row["p"]) <= float(row["bound"]) + 0.1 for row in fits)
    assert all(int(row["changes"]) > 0 for row in results.rows("changes"))


def test_large(results):
    large.run(results.output, large.Sizes((40,), 30, 2), 0)
    rows = results.rows("large")
    assert [row["tiling"] for row in rows] == ["lazy", "greedy"]
    assert {row["events seen"] for row in rows} == {"30"}
    assert all(int(row["events at once"]) > 0 for row in rows)


def test_living(results, alone):
    living.run(results.output, TINY, 0)
    rows = results.rows("living")
    assert [row["tiling"] for row in rows] == ["lazy", "greedy"]
    assert all(row["contacts"] == "30" for row in rows)
    figures = ("contacts a second", "last third / first", "ms an audit", "us a change of plan")
    assert all(float(row[figure]) > 0 for row in rows for figure in figures)


def test_an_audit_of_what_lives_sees_a_wrong_mark():
    run = living.Living(living.box(12, Random(0)), "lazy", TINY)
    mesh = run.simulation.kinetic.mesh_after()
    living.audit(run.simulation)
    face = next(iter(mesh.faces()))
    marks = [mesh.corner[h] for h in face]
    for h, mark in zip(face, marks[1:] + marks[:1], strict=True):
        mesh.corner[h] = mark  # three corners still
    with pytest.raises(AuditError):
        living.audit(run.simulation)


def test_bug_scaling_of_a_tiling_without_a_known_bound():
    run = scaling.Measured(*[1] * len(scaling.Measured._fields))

    assert scaling._fit("convex crowd", "a new tiling", (10, 20), [run, run])["bound"] == ""


def test_exponents_of_every_family(results):
    rows = exponents.run(results.output, exponents.Sizes(0.05, 2), 0)
    assert [row["family"] for row in rows] == list(exponents.FAMILIES)
    assert len(rows) >= 30
    assert all(row["seconds"] for row in rows)


def test_sizes_of_a_question_that_never_takes_long_have_an_end(results, monkeypatch):
    made = []

    def made_at_once(n):
        made.append(n)
        return lambda: None

    monkeypatch.setitem(exponents.FAMILIES, "at once", exponents.Family(made_at_once, 2))

    (row,) = exponents.run(results.output, exponents.Sizes(1, 2, ("at once",)), 0)

    assert row["sizes"] == "256 512"
    assert max(made) == 512


def test_exponents_above_a_limit_are_an_exit_code(monkeypatch, tmp_path, capsys):
    rows = [{"family": "slow", "exponent": 2.5}, {"family": "fast", "exponent": 1.0}]
    module = SimpleNamespace(run=lambda *_: rows, QUICK="quick", FULL="full")
    monkeypatch.setattr("benchmarks.catalogue.import_module", lambda _: module)
    for limit, code in (("1.3", 1), ("3", 0)):
        command = ["exponents", "-o", str(tmp_path), "--fail-above", limit]
        assert code_of_bench(*command) == code
    assert capsys.readouterr().err == "exponents above 1.3: slow\n"
