"""The small scope: all of it, once, where it says so; and what it finds."""

import datetime
import hashlib
import json
import subprocess
import sys
from collections import Counter
from itertools import permutations, product
from pathlib import Path

import pytest
from click.testing import CliRunner

from exactpt import Body, InputError, Scene
from exactpt.arrays import first_contacts
from exactpt.geometry.polygon import contains, edges, first_self_touch, segments_meet, signed_area2
from exactpt.kernel.numbers import QQ
from exactpt.scene.format import loads
from exactpt.scene.written import to_json
from exactpt.testing import reference
from fuzz.campaign import Item, Progress, campaign
from fuzz.changes.images import halved
from fuzz.laws import kept
from fuzz.planted import PLANTED
from fuzz.small_scope import tally
from fuzz.small_scope.by_arrays import ARRAYS, suits, verdicts
from fuzz.small_scope.command import small_scope
from fuzz.small_scope.look import AFTER_START, are_straight, look, looks
from fuzz.small_scope.motions import ORDERS, SLOTS, TIMES, approaches
from fuzz.small_scope.numbering import spread
from fuzz.small_scope.placements import (
    DIRECTIONS,
    complete,
    disjoint,
    move_offset,
    placements,
    small_shapes,
)
from fuzz.small_scope.run import Scope, start_of
from fuzz.small_scope.sample import FAR, SAMPLES, sampled
from fuzz.small_scope.scenes import touching
from fuzz.small_scope.scope import COMPLETE, entries, in_part, planned, sizes
from fuzz.small_scope.shapes import SYMMETRIES, image, shape_of, shapes, turned

ROOT = Path(__file__).parents[2]


def edge_set(points, closed):
    """A shape as what it covers, without the ways to list it."""
    pairs = edges(len(points), closed=closed) or [(0, 0)]
    return frozenset(frozenset((points[i], points[j])) for i, j in pairs)


def is_simple(points, closed):
    rational = [(QQ(x), QQ(y)) for x, y in points]
    if first_self_touch(rational, closed=closed) is not None:
        return False
    return not closed or signed_area2(rational) != 0


def to_corner(edge_sets):
    """Moved so that the least coordinates are 0, as one figure."""
    points = [p for edge_set in edge_sets for edge in edge_set for p in edge]
    left, low = min(x for x, _ in points), min(y for _, y in points)
    return tuple(
        frozenset(frozenset((x - left, y - low) for x, y in edge) for edge in edge_set)
        for edge_set in edge_sets
    )


def turned_figure(matrix, edge_set):
    return frozenset(frozenset(turned(matrix, p) for p in edge) for edge in edge_set)


@pytest.mark.parametrize(
    "size, closed, grid, orbits",
    [
        (1, False, 3, 1),
        (2, False, 3, 5),
        (3, False, 3, 21),
        (3, True, 3, 8),
        (4, False, 3, 102),
        (4, True, 3, 22),
        (2, False, 4, 9),
        (3, True, 4, 29),
    ],
)
def test_shapes_are_all_up_to_symmetry(size, closed, grid, orbits):
    """Burnside: the orbits are as many as the shapes that a symmetry fixes, on average."""
    brute = {
        to_corner([edge_set(points, closed)])[0]
        for points in permutations(product(range(grid), repeat=2), size)
        if is_simple(points, closed)
    }
    fixed = sum(to_corner([turned_figure(m, s)])[0] == s for m in SYMMETRIES for s in brute)
    found = shapes(size, closed=closed, grid=grid)

    assert {edge_set(shape.vertices, closed) for shape in found} == brute
    assert len(found) == len(brute)
    assert divmod(fixed, len(SYMMETRIES)) == (orbits, 0)
    assert len({min(image(m, shape) for m in SYMMETRIES) for shape in found}) == orbits


def figure(placement):
    """The two bodies of a placement as edge sets, in half units."""
    a = [(2 * x + placement.offset[0], 2 * y + placement.offset[1]) for x, y in placement.a[0]]
    b = [(2 * x, 2 * y) for x, y in placement.b[0]]
    return edge_set(a, placement.a.closed), edge_set(b, placement.b.closed)


def canonical(placement):
    """The same for all images of a placement, and for both orders of the bodies."""
    figures = [
        to_corner([turned_figure(m, body) for body in bodies])
        for m in SYMMETRIES
        for bodies in (figure(placement), figure(placement)[::-1])
    ]
    return min(str([sorted(sorted(e) for e in body) for body in bodies]) for bodies in figures)


def test_placements_are_all_up_to_symmetry_and_none_twice():
    pairs = [*product(small_shapes(1, 2), small_shapes(1, 2))]
    pairs += [*product(small_shapes(3, 3), small_shapes(1, 1))]
    brute = {canonical(p) for a, b in pairs for p in placements(a, b)}
    sizes_of = [(len(p.a.vertices), len(p.b.vertices)) for p in complete()]
    light = [p for p, (a, b) in zip(complete(), sizes_of, strict=True) if a < 3 or a + b == 4]

    assert sorted(map(canonical, light)) == sorted(brute)


def overlap(a, b, closed):
    """By the package's own geometry."""
    sides = [
        edges(len(points), closed=c) or [(0, 0)] for points, c in zip((a, b), closed, strict=True)
    ]
    return (
        any(segments_meet(a[i], a[j], b[k], b[m]) for i, j in sides[0] for k, m in sides[1])
        or (closed[0] and contains(a, b[0]))
        or (closed[1] and contains(b, a[0]))
    )


def test_shapes_touch_and_come_apart_in_the_free_directions():
    for placement in complete()[::97]:
        a, b, offset, free, _ = placement
        closed = (a.closed, b.closed)
        fixed = [(QQ(2 * x), QQ(2 * y)) for x, y in b.vertices]
        assert overlap(
            [(QQ(2 * x + offset[0]), QQ(2 * y + offset[1])) for x, y in a.vertices], fixed, closed
        )
        for i, step in enumerate(DIRECTIONS):
            for size in (1000, 100_000):
                dx, dy = offset[0] + QQ(step[0], size), offset[1] + QQ(step[1], size)
                moved = [(2 * x + dx, 2 * y + dy) for x, y in a.vertices]
                assert overlap(moved, fixed, closed) == (not free >> i & 1)


def test_disjoint_is_neither_touching_nor_inside():
    triangle = shape_of(((0, 0), (4, 0), (0, 4)), closed=True)
    (point,) = shapes(1, closed=False)

    assert not disjoint(point, triangle, (2, 2))
    assert not disjoint(triangle, point, (-2, -2))
    assert not disjoint(point, triangle, (4, 4))
    assert disjoint(point, triangle, (5, 4))


def scenes_by_cell(kinds, place):
    """The scenes of a round with these shapes and this place, an order at a time."""
    chosen = [i for i, e in enumerate(entries()) if (e[0].kinds, e[0].place) == (kinds, place)]
    for k in range(len(ORDERS)):
        yield (
            ORDERS[k],
            (
                in_part(n, COMPLETE, chosen[spread(n, len(chosen))] * len(ORDERS) + k, 0)
                for n in range(len(chosen))
            ),
        )


def test_every_cell_has_a_planned_contact():
    for kinds, place in sorted({(p.kinds, p.place) for p in complete()}):
        for order, scenes in scenes_by_cell(kinds, place):
            missing = {"start"} if order == "rest" else set(TIMES)
            for scene in scenes:
                if scene.cell.time in missing and as_planned(scene):
                    missing.remove(scene.cell.time)
                if not missing:
                    break
            assert not missing, (kinds, place, order)


def as_planned(scene):
    contact = reference.first_contact(scene.scene)
    local = scene.clock.local[0].coefficients
    return contact is not None and not contact.time.sign_of(tuple(int(c) for c in local))


def body_at(data, name, time):
    """A body of a scene file as its shape, and its corner in half units."""
    body = next(b for b in loads(json.dumps(data)).bodies if b.name == name)
    points = tuple((int(x), int(y)) for x, y in body.at(time))
    closed = body.closed and len(points) > 2
    return shape_of(points, closed=closed), min(x for x, _ in points), min(y for _, y in points)


def touch_in(data, first, second, time=1):
    """The shapes of two bodies at a time, and the offset, as a placement has them."""
    (a, left, low), (b, other_left, other_low) = (
        body_at(data, name, time) for name in (first, second)
    )
    return a, b, (2 * (left - other_left), 2 * (low - other_low))


def images(a, b, offset, step):
    """All images of a touch, and of the direction that the first body comes from."""
    for matrix in SYMMETRIES:
        c, d, (x, y) = image(matrix, a), image(matrix, b), turned(matrix, step)
        yield c, d, move_offset(matrix, a, b, offset, exchanged=False), (x, y)
        yield d, c, move_offset(matrix, a, b, offset, exchanged=True), (-x, -y)


def members(found, order, companion, touch):
    """The placements that are a touch, turned, with an approach of this kind to it."""
    wanted = {(a, b, offset): step for a, b, offset, step in images(*touch)}
    for placement in found:
        step = wanted.get(placement[:3])
        if step is not None:
            for approach in approaches(order, placement.free, [0]):
                if (approach.companion, DIRECTIONS[approach.direction]) == (companion, step):
                    yield placement


GRAZED = json.loads(
    '{"exactpt":1,"time":["0","3"],"bodies":[{"name":"g","closed":false,"vertices":[["2","1"],'
    '["2","3"],["1","3"],["1","1"]],"motion":{"y":["1","-2","1"]}},{"name":"o","vertices":'
    '[["2","1"]]},{"name":"p","vertices":[["5","-6"]]}]}'
)
WIDE = json.loads(
    '{"exactpt":1,"time":["0","3"],"bodies":[{"name":"g","closed":false,"vertices":[["0","0"],'
    '["3","0"],["0","-2"]],"motion":{"x":["1","-2","1"],"y":["0","-1"]}},{"name":"o",'
    '"vertices":[["0","-3"],["0","-4"]]}]}'
)
ENDS = json.loads(
    '{"exactpt":1,"time":["0","3"],"bodies":[{"name":"g","closed":false,"vertices":[["5","2"],'
    '["5","3"],["3","2"]],"motion":{"y":["1","-2","1"]}},{"name":"o","vertices":[["3","2"],'
    '["2","2"]]}]}'
)


def test_the_scenes_in_which_tilings_missed_a_contact_are_in_the_scope():
    assert list(members(complete(), "square", "alone", (*touch_in(ENDS, "g", "o"), (0, 1))))

    grazed = (*touch_in(GRAZED, "g", "o"), (0, 1))
    assert list(members(complete(), "square", "alone", grazed))
    assert any(
        third is not None and third.offset in FAR and len(third.shape.vertices) == 1
        for _, third in (sampled("three bodies", i) for i in range(20))
    )

    a, b, offset = touch_in(WIDE, "g", "o")
    assert a in small_shapes(2, 4, grid=4)
    assert a not in small_shapes(2, 4)
    assert list(members(placements(a, b), "square", "linear", (a, b, offset, (1, 8))))


def test_a_chain_of_four_meets_a_segment_beside_a_point():
    """The shapes of the fourth scene, in which one incidence was left out."""
    kinds = [
        Counter(body.size for body in planned(n).scene.bodies)
        for n in range(20_000)
        if sampled_three(n)
    ]

    assert Counter({4: 1, 2: 1, 1: 1}) in kinds


def sampled_three(number):
    total, (*_, last) = sum(sizes().values()), sizes().values()
    return spread(number, total) >= total - last and number % 8 == 0


def test_numbers_are_spread_and_none_comes_twice():
    for n in (1, 2, 3, 100, 997):
        assert sorted(spread(i, n) for i in range(n)) == list(range(n))
    assert sum(sizes().values()) > 200_000
    assert sizes()[COMPLETE] == len(ORDERS) * len(entries())
    assert {e.placement for e in entries()} == set(complete())
    parts = Counter(planned(n).cell.part for n in range(1000))
    assert set(parts) == {COMPLETE, *SAMPLES}
    assert 700 < parts[COMPLETE] < 850


def test_a_number_is_the_same_scene_for_ever():
    digest = hashlib.sha256()
    for number in (*range(0, 1000, 25), 10**6, 10**9):
        scene = planned(number)
        digest.update(json.dumps([*scene.cell, to_json(scene.scene)]).encode())

    assert digest.hexdigest()[:16] == "2190b40d9273e7e7"


def test_in_enough_rounds_all_that_is_left_open_comes():
    index = next(i for i, e in enumerate(entries()) if e.placement.kinds == "segment and 3-chain")
    placement, _, copies = entries()[index]
    order = ORDERS.index("square")
    both = [approaches("square", placement.free, touching(placement, k)[0]) for k in (0, 1)]
    rounds = len(SLOTS) * sum(map(len, both)) // copies + 1

    plans = {
        json.dumps(to_json(in_part(0, COMPLETE, (index + k) * len(ORDERS) + order, turn).scene))
        for turn in range(rounds)
        for k in range(copies)
    }

    assert len(plans) == len(SLOTS) * sum(map(len, both))


def test_a_day_starts_where_the_day_before_has_not_been():
    today = datetime.date(2026, 3, 1)
    later = start_of(today + datetime.timedelta(days=1))

    assert later - start_of(today) == 4000
    assert planned(later).number == later


def counts(progress):
    """Counts without times."""
    return {key: n for key, n in progress.counts.items() if key[-1] != "seconds"}


def run(progress, report=lambda _: None, **limits):
    campaign(Scope(), progress, report, **limits)
    return progress


def wrong(numbers):
    """Number of scenes on which methods disagree."""
    result = Scope(shrink=0.0).run(Item(numbers), lambda _: None, None)
    return tally.disagreements(result.counts)


def test_a_run_resumes(tmp_path):
    state = tmp_path / "state.json"
    whole = run(Progress(40, 40), count=70)

    run(Progress(40, 40), count=30, state=state)
    again = run(Progress.load(state, Scope()), count=70)

    assert again.next == whole.next == 110
    assert counts(again) == counts(whole)
    assert sum(row[0] for row in tally.cells(whole.counts).values()) == 70


def test_the_state_of_another_scope_is_refused(tmp_path, monkeypatch):
    state = tmp_path / "state.json"
    Progress().save(state, Scope())
    monkeypatch.setattr("fuzz.small_scope.run.sizes", lambda: {"complete": 1})
    with pytest.raises(InputError, match="another campaign: small scope"):
        Progress.load(state, Scope())


def test_two_processes_see_what_one_sees():
    one, two = run(Progress(), count=60), run(Progress(), count=60, jobs=2)

    assert counts(one) == counts(two)


def test_tilings_are_audited_now_and_then():
    methods = Counter(answer.method for n in range(64) for answer in look(planned(n)).answers)

    assert methods["pairs"] == methods["greedy"] == 64
    for more in ("static", "going on"):
        assert sum(n for name, n in methods.items() if name.startswith(more)) == 4


def test_arrays_are_asked_for_two_bodies_that_translate():
    seen = looks([planned(n) for n in range(50)])

    for one in seen:
        reported = [answer.fault for answer in one.answers if answer.method == ARRAYS]
        assert reported == ([None] if suits(one.planned.scene) else [])
    orders = Counter(one.planned.cell.order for one in seen if suits(one.planned.scene))
    assert set(orders) == {"rest", "linear", "square", "cube", "fourth"}


def test_auto_is_asked_where_it_is_not_pairs():
    for one in looks([planned(n) for n in range(50)]):
        methods = [answer.method for answer in one.answers]
        assert ("auto" in methods) == are_straight(one.planned.scene)


def _wrong(attribute, value):
    """Arrays that tell something wrong about each fourth pair."""

    def ask(*args, **options):
        contacts = first_contacts(*args, **options)
        getattr(contacts, attribute)[::4] = value
        return contacts

    return ask


@pytest.mark.parametrize(
    ("attribute", "value", "fault"),
    [
        ("found", False, "missed"),
        ("low", 1e9, "time"),
        ("low", -1e9, "enclosure"),
        ("kind", 2, "kind"),
        ("vertex", 7, "pairs"),
        ("edge", 7, "pairs"),
        ("other_vertex", 7, "pairs"),
    ],
)
def test_a_wrong_answer_of_arrays_is_found(monkeypatch, attribute, value, fault):
    monkeypatch.setattr("exactpt.testing.truth.first_contacts", _wrong(attribute, value))

    reported = [
        answer.fault
        for one in looks([planned(n) for n in range(50)])
        for answer in one.answers
        if answer.method == ARRAYS
    ]

    assert set(reported[::4]) == {fault}
    assert set(reported[1::4]) == {None}


def test_a_call_that_fails_is_asked_scene_by_scene(monkeypatch):
    def ask(vertices, *args, **options):
        if len(vertices) > 2:
            raise ZeroDivisionError
        return first_contacts(vertices, *args, **options)

    monkeypatch.setattr("exactpt.testing.truth.first_contacts", ask)
    scenes = [s.scene for s in map(planned, range(200)) if suits(s.scene)]

    reported = verdicts(scenes, [reference.first_contact(scene) for scene in scenes])

    wrong = [scene.vertex_count > 2 for scene in scenes]
    assert [v.fault == "ZeroDivisionError" for v in reported] == wrong
    assert not all(wrong)


@pytest.mark.plain
@pytest.mark.parametrize(
    "bug", ["even roots ignored", "vertex on vertex ignored", "contact proof skipped"]
)
def test_a_planted_bug_is_found_in_a_few_scenes(bug):
    assert wrong(range(60)) == 0
    with PLANTED[bug].made():
        assert wrong(range(60)) > 0


@pytest.mark.plain
def test_a_fault_is_printed_shrunk_and_saved(tmp_path, monkeypatch):
    monkeypatch.setattr(kept, "FOLDER", tmp_path)

    with PLANTED["vertex on vertex ignored"].made():
        done = CliRunner().invoke(small_scope, ["--count", "20", "--shrink", "2", "--jobs", "0"])

    assert done.exit_code == 1
    assert "saved: " in done.output
    number = int(done.output.split("\nscene ")[1].split(":")[0])
    cases = [kept.kept(name) for name in kept.names()]
    assert any(f"small scope {number}" in case.note for case in cases)
    assert cases[0].scene.vertex_count <= planned(number).scene.vertex_count


def test_the_command(tmp_path):
    state = tmp_path / "state.json"

    def fuzz(*arguments):
        return CliRunner().invoke(small_scope, [*arguments, "--jobs", "0"])

    done = fuzz("--count", "20", "--state", str(state))
    assert done.exit_code == 0
    assert done.output.startswith("scenes of a round: complete ")
    assert " 0.00 %" in done.output
    again = fuzz("--count", "21", "--state", str(state))
    assert "from case 20 on\n" in again.output
    assert Scene.load(_saved(tmp_path, fuzz("--show", "5").output)).vertex_count
    assert fuzz("--start", "1", "--state", str(state)).exit_code == 2
    assert fuzz("--start", "1", "--today").exit_code == 2
    assert "from case 2" in fuzz("--today", "--seconds", "0").output


def _saved(folder, text):
    path = folder / "scene.json"
    path.write_text(text)
    return path


def test_the_command_is_one_of_the_fuzzer():
    done = subprocess.run(
        [sys.executable, "-m", "fuzz", "small-scope", "--count", "1"],
        capture_output=True,
        text=True,
        cwd=ROOT,
        check=False,
    )

    assert done.returncode == 0
    assert "of a round" in done.stdout


@pytest.mark.plain
def test_even_zeros_of_copies_are_needed():
    """The fault that the scope was made for: scene 627 is the first that shows it."""
    with PLANTED["even zeros of copies ignored"].made():
        answers = look(planned(627)).answers

    assert [answer.method for answer in answers if answer.fault] == ["lazy"]
    assert not any(answer.fault for answer in look(planned(627)).answers)


def test_new_contacts_are_asked_for_with_cut_edges():
    answers = [a for n in range(64) for a in look(planned(n)).answers if a.method == AFTER_START]

    assert len(answers) == 16
    assert {answer.fault for answer in answers} == {None}


def test_cut_edges_are_the_same_points():
    for number in range(0, 400, 7):
        scene = planned(number).scene
        cut = halved(scene)
        for body, same in zip(scene.bodies, cut.bodies, strict=True):
            assert len(same.edges) == 2 * len(body.edges)
            assert len({*same.at(scene.end)} & {*body.at(scene.end)}) == len({*body.at(scene.end)})
            assert same.has_interior == body.has_interior
    plate = Body("p", [(0, 0), (9, 0), (0, 9)], holes=[[(1, 1), (1, 2), (2, 1)]], radius=1)
    (cut,) = halved(Scene([plate], time=(0, 1))).bodies
    assert cut.edges[-1] == (11, 6)
    assert [len(ring) for ring in cut.rings] == [6, 6]
    assert cut.radius == 1


@pytest.mark.plain
def test_bug_crossings_at_vertices_are_found(monkeypatch):
    """Edges that cross at inner points alone overlapped."""
    numbers = {157: "new contact of cut edges", 5137: "new contact"}

    def faults():
        return {n: [a.fault for a in look(planned(n)).answers if a.fault] for n in numbers}

    assert faults() == {n: [] for n in numbers}
    monkeypatch.setattr("exactpt.pair.overlap._chains_cross", lambda *_: False)
    assert faults() == {n: [what] for n, what in numbers.items()}
