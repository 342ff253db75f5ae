"""Transformations keep the answers to all questions; each of them shows a planted fault."""

from collections import Counter
from random import Random

import pytest
from click.testing import CliRunner

from exactpt import AlgebraicNumber, Body, Scene
from exactpt.certificates import first_root as filters
from exactpt.kernel.numbers import QQ
from fuzz.campaign import Progress
from fuzz.changes.images import TRANSFORMATIONS, Mirror, move_alike
from fuzz.transformations import run
from fuzz.transformations.answers import QUESTIONS
from fuzz.transformations.command import Transformations, transformations
from fuzz.transformations.planted import PLANTED, hunt
from fuzz.transformations.run import SCENES, check, scene_of

is_plain = filters.__file__.endswith(".py")


def checked(numbers):
    tally, faults = Counter(), []
    for number in numbers:
        for question, transformation, fault in check(number):
            tally[question, transformation] += 1
            if fault is not None:
                faults.append(fault[:4])
    return tally, faults


def command(*words):
    return CliRunner().invoke(transformations, [*words, "--jobs", "0"], catch_exceptions=False)


def test_no_answer_changes_in_24_scenes():
    tally, faults = checked(range(24))

    assert faults == []
    assert {q for q, _ in tally} == set(QUESTIONS)
    assert {t for _, t in tally} == set(TRANSFORMATIONS)


def test_new_contacts_of_thin_bodies_do_not_depend_on_how_a_wall_is_cut():
    def wanted(question, transformation):
        return question == "new contact" and transformation in ("subdivided", "reversed")

    found = [f for k in range(200) for *_, f in check(k, wanted=wanted, draw=SCENES["standing"])]

    assert len(found) > 300
    assert set(found) == {None}


@pytest.mark.slow
def test_no_answer_changes_in_300_scenes():
    tally, faults = checked(range(100, 400))

    assert faults == []
    assert sum(tally.values()) > 20_000


@pytest.mark.skipif(not is_plain, reason="compiled classes cannot be patched")
@pytest.mark.parametrize("name", PLANTED)
def test_a_planted_fault_is_found(name):
    fault = hunt(name, 100)

    assert fault is not None
    assert fault.transformation == name


def test_every_transformation_has_a_planted_fault():
    assert set(PLANTED) == set(TRANSFORMATIONS)


@pytest.mark.parametrize("name", TRANSFORMATIONS)
def test_features_are_where_the_old_ones_are(name):
    """A new vertex is an old one or on an old edge; a new edge is in an old one.

    Seen in the mirror, if the image is one.
    """
    seen = 0
    for number in range(60):
        scene = scene_of(Random(number))
        image = TRANSFORMATIONS[name](scene, Random(number))
        if image is None:
            continue
        t = (2 * scene.exact_start + scene.exact_end) / 3
        old = {body.name: (body, body.exact_at(t)) for body in image.old.scene.bodies}
        mirror = image.new.mirror
        for body in image.new.scene.bodies:
            places = [mirror.point(place) for place in body.exact_at(mirror.time(t))]
            for i, place in enumerate(places):
                seen += 1
                assert is_on(place, image.new.vertices[body.name, i], old)
            for i, j in body.edges:
                feature = image.new.edges[body.name, i]
                assert feature.kind == "edge"
                assert is_on(places[i], feature, old)
                assert is_on(places[j], feature, old)
    assert seen > 20


@pytest.mark.parametrize(
    "mirror, point, image, kept",
    [
        (Mirror(), (2, 5), (2, 5), True),
        (Mirror((-1, 1)), (2, 5), (-2, 5), False),
        (Mirror((-1, -1)), (2, 5), (-2, -5), True),
        (Mirror((1, 1), swaps_axes=True), (2, 5), (5, 2), False),
    ],
)
def test_mirror_of_a_point_is_itself_after_two_times(mirror, point, image, kept):
    assert mirror.point(point) == image
    assert mirror.point(image) == point
    assert mirror.is_orientation_kept is kept
    scene = Scene([Body("p", [point])], (0, 1))
    assert mirror.variant.scene(scene).body("p").at(0) == [image]


def test_mirror_of_time_turns_an_interval_around():
    """t' = 10 - t: from 2 to 5 becomes from 5 to 8."""
    mirror = Mirror(turning=QQ(10))

    assert mirror.time(QQ(2)) == 8
    assert mirror.interval(AlgebraicNumber(2), AlgebraicNumber(5)) == (5, 8)


def is_on(place, feature, old):
    """Return True if a place is that of an old vertex, or on an old edge."""
    body, places = old[feature.body]
    a = places[feature.number]
    if feature.kind == "vertex":
        return place == a
    b = places[body.end_of_edge(feature.number)]
    (x, y), (u, v) = ((p[0] - a[0], p[1] - a[1]) for p in (place, b))
    return x * v == y * u and 0 <= x * u + y * v <= u * u + v * v


@pytest.mark.parametrize(
    "second, alike",
    [
        (Body("b", [(5, 0), (6, 0), (5, 1)]), True),
        (Body("b", [(5, 0), (6, 0), (5, 1)], radius=1), False),
        (Body("b", [(1, 0), (6, 0), (5, 1)]), False),  # it touches the first body
        (Body("b", [(5, 0), (6, 0), (5, 1)], closed=False), False),
    ],
)
def test_bodies_that_may_be_joined(second, alike):
    first = Body("a", [(0, 0), (1, 0), (0, 1)])

    assert move_alike(first, second, QQ(0)) is alike


def test_a_run_that_is_stopped_continues_from_its_counts(tmp_path):
    counts = tmp_path / "counts.json"
    whole = command("--scenes", "4", "--keep", str(tmp_path / "found"))
    command("--scenes", "2", "--counts", str(counts), "--keep", str(tmp_path / "found"))
    rest = command("--scenes", "4", "--counts", str(counts), "--keep", str(tmp_path / "found"))

    assert whole.exit_code == rest.exit_code == 0
    assert whole.output.splitlines()[1:-1] == rest.output.splitlines()[1:-1]
    assert whole.output.endswith(": 0 differences\n")
    assert rest.output.startswith("from case 2 on\n")
    check = Transformations(0, "mixed", None, tmp_path)
    before = Progress.load(counts, check).counts
    command("--scenes", "5", "--enough", "2", "--counts", str(counts))
    after = Progress.load(counts, check)
    assert after.next == 5
    assert all(after.counts[key] == n for key, n in before.items() if n >= 2)


def test_a_disagreement_is_reported_and_kept(monkeypatch, tmp_path):
    wrong = QUESTIONS["positions"]._replace(ask=lambda side, _: side.scene.vertex_count)
    monkeypatch.setitem(run.QUESTIONS, "positions", wrong)

    result = command("--scenes", "1", "--keep", str(tmp_path))

    assert result.exit_code == 1
    assert "positions, subdivided, scene 0: " in result.output
    kept = sorted(tmp_path.glob("0-positions-subdivided-*.json"))
    assert [bool(Scene.load(path).bodies) for path in kept] == [True, True]
