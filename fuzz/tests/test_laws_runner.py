"""The runner of laws: cases are texts, faults are shrunk and kept, a new source moves few cases."""

import json
import re
from fractions import Fraction
from random import Random

import pytest
from click.testing import CliRunner

from exactpt import Body, InputError, Scene, Translation, first_contact
from fuzz.laws import command, kept, law, runner, scenes, table
from fuzz.laws.known import Known
from fuzz.laws.law import Law
from fuzz.laws.runner import Case, Tally, case_of, cases_of, count_of, look, shrunk
from fuzz.witnesses import Difference, LeftOutError


def has_a_triangle(scene, random):
    """No body of a scene is a triangle."""
    if any(body.size == 3 for body in scene.bodies):
        raise Difference("triangle", f"{len(scene.bodies)} bodies")
    return "none"


@pytest.fixture
def broken(monkeypatch):
    """A law that most scenes break."""
    monkeypatch.setitem(table.LAWS, "test/triangles", Law(has_a_triangle, ("family/convex",)))
    return "test/triangles"


def first_fault(law):
    return next(found for case in cases_of(law, 0, 50) if (found := look(case).fault))


def test_case_text_is_read_as_it_is_written():
    case = Case("first contact/reference", "tiny/pair+nudged", 7, 27)

    assert str(case) == "first contact/reference tiny/pair+nudged:7:27"
    assert Case.parse(str(case)) == case


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("no such law tiny/pair:0:0", "case: unknown law, got 'no such law'"),
        ("tiling/static tiny/pair:0", "case: not a place, got 'tiny/pair:0'"),
        ("tiling/static tiny/pair:0:x", "write it as LAW SOURCE:SEED:NUMBER"),
        ("tiling/static tiny/none:0:1", "unknown source or change, got 'tiny/none'"),
        ("tiling/static tiny/pair+no:0:1", r"unknown source or change, got 'tiny/pair\+no'"),
    ],
)
def test_case_text_of_another_form_is_refused(text, words):
    with pytest.raises(InputError, match=words):
        Case.parse(text)


def test_case_in_every_run_is_the_same(broken):
    first, again = look(case_of(broken, 3, 5)), look(case_of(broken, 3, 5))

    assert (first.case, first.outcome) == (again.case, again.outcome)
    assert (first.fault and first.fault.why) == (again.fault and again.fault.why)


def test_patterns_take_turns():
    patterns = "tiny", "case", "turning+awkward"
    drawn = [scenes.drawn(patterns, "lot", number) for number in range(6)]

    assert [name.split("/")[0] for name in drawn] == ["tiny", "case", "family"] * 2
    assert drawn[2].endswith("+awkward")


def test_a_new_source_takes_few_cases_over(monkeypatch):
    before = [scenes.drawn(("family",), "lot", number) for number in range(1000)]
    monkeypatch.setitem(scenes.SOURCES, "family/new", scenes.SOURCES["family/convex"])
    scenes.names_of.cache_clear()
    after = [scenes.drawn(("family",), "lot", number) for number in range(1000)]
    monkeypatch.undo()
    scenes.names_of.cache_clear()

    moved = [new for old, new in zip(before, after, strict=True) if old != new]
    assert set(moved) == {"family/new"}
    assert len(moved) < 60  # of 1000 / 50, the share of one source


def test_unknown_source_or_change_is_an_error():
    for pattern in ("no/such", "tiny+no_such"):
        with pytest.raises(KeyError):
            scenes.names_of(pattern)


def test_every_law_names_sources_that_exist():
    for one in table.LAWS.values():
        assert all(scenes.names_of(pattern) for pattern in one.sources)
        assert one.meaning.endswith(".")


def test_law_whose_program_is_not_built_is_left_out(monkeypatch):
    monkeypatch.setitem(law.PROGRAMS, "old engine", lambda: False)

    result = invoked(command.run, "old engine", "reference", "--seconds", "0.1")

    assert result.output.startswith("old engine/same is left out: old engine is not built\n")
    assert "1 laws, seed" in result.output
    assert result.exit_code == 0


TWO = Scene([Body("a", [(0, 0), (1, 0), (0, 1)]), Body("b", [(3, 0), (4, 0), (4, 1), (3, 1)])])


def draws_its_own(scene, random):
    """A law that draws its own scenes: no body is a triangle."""
    drawn = scene if scene.bodies else TWO
    if any(body.size == 3 for body in drawn.bodies):
        raise Difference("triangle", f"{len(drawn.bodies)} bodies", drawn)
    return "none"


def test_fault_in_a_scene_that_a_law_has_drawn_itself_is_shrunk(monkeypatch):
    monkeypatch.setitem(table.LAWS, "test/own", Law(draws_its_own, ("own",)))

    fault = look(Case("test/own", "own", 0, 0)).fault

    assert fault.scene == TWO
    assert [body.name for body in shrunk(fault, 10.0).scene.bodies] == ["a"]


def test_fault_is_shrunk_to_the_same_signature(broken):
    fault = first_fault(broken)

    smaller = shrunk(fault, 1.0)

    assert smaller.signature == "triangle"
    assert smaller.scene.vertex_count < fault.scene.vertex_count
    assert any(body.size == 3 for body in smaller.scene.bodies)
    assert f"shrunk from {fault.vertices} to {smaller.scene.vertex_count}" in smaller.report
    assert f"python -m fuzz again 'test/triangles' '{fault.case.place}'" in smaller.report


def test_fault_that_does_not_come_again_is_reported_as_it_was(monkeypatch):
    answers = iter([True])

    def fails_once(scene, random):
        if next(answers, False):
            raise Difference("slow", "too slow", scene)
        return "none"

    monkeypatch.setitem(table.LAWS, "test/once", Law(fails_once, ("tiny/pair",)))
    fault = look(case_of("test/once", 0, 0)).fault

    same = shrunk(fault, 10.0)

    assert same.scene == fault.scene
    assert same.why == f"{fault.why}; once, and not when it was repeated"


def test_exception_is_a_fault_with_its_function_as_signature(monkeypatch):
    def fails(scene, random):
        raise ZeroDivisionError("of nothing")

    monkeypatch.setitem(table.LAWS, "test/fails", Law(fails, ("tiny/pair",)))
    fault = look(case_of("test/fails", 0, 0)).fault

    assert fault.signature == "ZeroDivisionError in fails"


def test_hanging_case_is_a_fault(monkeypatch):
    def hangs(scene, random):
        while True:
            pass

    monkeypatch.setattr(runner, "PATIENCE", 0.2)
    monkeypatch.setitem(table.LAWS, "test/hangs", Law(hangs, ("tiny/pair",)))

    assert look(case_of("test/hangs", 0, 0)).fault.signature == "hangs"


def test_outcomes_are_counted_and_silent_ones_apart(monkeypatch):
    def says_little(scene, random):
        if random.random() < 0.5:
            raise LeftOutError
        return "something"

    monkeypatch.setitem(table.LAWS, "test/little", Law(says_little, ("tiny/pair",)))
    tally = Tally()
    for case in cases_of("test/little", 0, 100):
        tally.add(look(case))

    outcomes = tally.outcomes["test/little"]
    assert set(outcomes) == {"something", "not asked"}
    assert outcomes.total() == 100
    assert tally.said("test/little") == outcomes["something"]


def test_scene_with_too_many_vertices_is_left_out(monkeypatch):
    monkeypatch.setitem(table.LAWS, "test/small", Law(has_a_triangle, ("family/convex",), most=0))

    assert look(case_of("test/small", 0, 0)).outcome == "too large"


def test_count_of_a_tier_follows_from_the_cost(monkeypatch):
    monkeypatch.setattr(runner, "costs", lambda: {"tiling/static": 10.0})
    shares = sum(one.share for one in table.LAWS.values())
    seconds = runner.TIERS["full"] * table.LAWS["tiling/static"].share / shares

    assert count_of("tiling/static", "full") == round(seconds / 0.010)
    assert count_of("tiling/static", "quick") < count_of("tiling/static", "full")


def invoked(name, *words):
    return CliRunner().invoke(name, [*words], catch_exceptions=False)


def test_run_again_and_keep_report_the_same_fault(broken, monkeypatch, tmp_path):
    monkeypatch.setattr(kept, "FOLDER", tmp_path)
    place = first_fault(broken).case.place

    ran = invoked(command.run, broken, "--seconds", "0.5", "--seed", "0", "--shrink", "1")
    repeated = invoked(command.again, broken, place, "--shrink", "1")
    written = invoked(command.keep, broken, place, "--note", "a triangle", "--shrink", "1")

    assert ran.exit_code == repeated.exit_code == 1
    assert f"{broken}: triangle" in ran.output
    assert f"{broken}: triangle" in repeated.output
    (path,) = tmp_path.glob("*.json")
    data = json.loads(path.read_text())
    assert str(path) in written.output
    assert (data["law"], data["case"], data["note"]) == (broken, place, "a triangle")
    scene = Scene.from_json(data["scene"])
    assert look(Case.parse(f"{broken} {place}"), scene).fault.signature == "triangle"


@pytest.fixture
def kept_in(monkeypatch, tmp_path):
    """A function that writes the file of a kept case, named `box`, and makes it a source."""
    monkeypatch.setattr(kept, "FOLDER", tmp_path)

    def write(data):
        (tmp_path / "box.json").write_text(kept.text_of(data))
        monkeypatch.setitem(scenes.SOURCES, "case/box", lambda _: kept.kept("box").scene)

    return write


def test_kept_case_is_checked_with_the_choices_that_broke_its_law(monkeypatch, kept_in):
    def draws(scene, random):
        raise Difference("draw", str(random.random()))

    monkeypatch.setitem(table.LAWS, "test/draws", Law(draws, ("tiny/pair",)))
    found = look(case_of("test/draws", 0, 0)).fault
    kept_in(
        {
            "note": "a draw",
            "law": "test/draws",
            "case": found.case.place,
            "scene": found.scene.to_json(),
        }
    )

    first, second = (look(Case("test/draws", "case/box", 0, number)).fault for number in (0, 1))

    assert first.why == found.why
    assert second.why != found.why
    assert "again: python -m fuzz again 'test/draws' 'case/box:0:0'" in first.report
    assert "python -m fuzz keep" not in first.report


def test_again_of_a_kept_case_reports_its_fault(broken, kept_in):
    triangle = Body("a", [(0, 0), (1, 0), (0, 1)])
    kept_in({"note": "a triangle", "scene": Scene([triangle], (0, 1)).to_json()})

    result = invoked(command.again, broken, "case/box:0:0", "--shrink", "1")

    assert result.exit_code == 1
    assert f"{broken}: triangle: 1 bodies" in result.output


@pytest.mark.parametrize(
    ("change", "words"),
    [
        ({"note": None}, "box.json: no note, got the keys ['scene']"),
        ({"scene": None}, "box.json: no scene, got the keys ['note']"),
        ({"notes": "two"}, "box.json: unknown keys, got the keys ['note', 'notes', 'scene']"),
        ({"note": " "}, "box.json: the note is empty"),
        ({"law": "tiling/static"}, "box.json: law and case belong together"),
        ({"scene": {"exactpt": 1, "time": [1, 0], "bodies": []}}, "box.json: time"),
    ],
)
def test_kept_case_of_another_form_is_refused(kept_in, change, words):
    data = {"note": "nothing", "scene": Scene([], (0, 1)).to_json()} | change
    kept_in({key: value for key, value in data.items() if value is not None})

    with pytest.raises(InputError, match=re.escape(words)):
        kept.kept("box")


def test_kept_scene_is_written_with_one_line_for_each_body():
    text = kept.text_of({"note": "a pair", "scene": pair().to_json()})

    assert [line[:15] for line in text.splitlines()] == [
        "{",
        ' "note": "a pai',
        ' "scene": {"exa',
        '  {"name": "a",',
        '  {"name": "b",',
        " ]}",
        "}",
    ]
    assert Scene.from_json(json.loads(text)["scene"]) == pair()


def test_again_of_a_case_that_holds_reports_its_outcome():
    result = invoked(command.again, "first contact/methods", "tiny/fractions:0:0")

    assert result.exit_code == 0
    assert result.output.startswith("holds: ")


def test_keep_of_a_case_that_holds_is_refused():
    result = invoked(command.keep, "first contact/methods", "tiny/fractions:0:0")

    assert result.exit_code == 2
    assert "the law holds" in result.output


def test_known_case_that_holds_fails_the_run(monkeypatch):
    known = Known("first contact/methods tiny/fractions:0:0", "a reason")
    monkeypatch.setattr(command, "KNOWN", (known,))

    result = invoked(command.run, "first contact/methods", "--seconds", "0.2", "--seed", "0")

    assert result.exit_code == 1
    assert "holds, and is known to be broken" in result.output


def test_known_case_that_is_broken_does_not_fail_the_run(broken, monkeypatch):
    for module in (command, runner):
        monkeypatch.setattr(module, "reason_of", lambda _: "a reason")

    result = invoked(command.run, broken, "--seconds", "0.2", "--seed", "0")

    assert result.exit_code == 0
    assert "known to be broken" in result.output


# Changes


def pair():
    motion = Translation([0, "1/2"], [0, 0])
    bodies = [Body("a", [(0, 0), (1, 0), (0, 1)], motion), Body("b", [(3, 0), (4, 1), (3, 1)])]
    return Scene(bodies, (0, 4))


def changed(name, seed=0):
    return scenes.changed(pair(), [name], Random(seed))


def numbers(scene):
    found = []

    def walk(data):
        for value in data.values() if isinstance(data, dict) else data:
            if isinstance(value, str):
                found.append(value)
            elif isinstance(value, dict | list):
                walk(value)

    for body in scene.to_json()["bodies"]:
        walk({key: value for key, value in body.items() if key != "name"})
    return found


def test_nudged_scene_differs_in_at_most_two_numbers_by_little():
    before = numbers(pair())
    for seed in range(20):
        after = numbers(changed("nudged", seed))
        moved = [(a, b) for a, b in zip(before, after, strict=True) if a != b]
        assert 1 <= len(moved) <= 2
        assert all(abs(Fraction(a) - Fraction(b)) <= Fraction(4, 2**30) for a, b in moved)


def test_rounded_scene_has_doubles_only_and_awkward_one_has_others():
    def are_doubles(scene):
        return [Fraction(float(Fraction(n))) == Fraction(n) for n in numbers(scene)]

    assert all(are_doubles(changed("rounded")))
    assert not all(are_doubles(changed("awkward")))


@pytest.mark.parametrize(
    "name", ["halved", "subdivided", "cut", "renumbered", "reversed", "permuted"]
)
def test_change_of_the_description_is_another_scene(name):
    image = changed(name)

    assert image != pair()
    assert first_contact(image).time == first_contact(pair()).time
