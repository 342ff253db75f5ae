"""Wrong proofs are rejected, each for its own reason."""

from fractions import Fraction
from random import Random

import pytest
from proving import accepted, agrees, by_both_checkers, proof_of, verdict  # noqa: F401 - a fixture

from exactpt import AuditError, Body, Scene, Translation, proof_scene
from exactpt.kernel.numbers import QQ
from exactpt.proof.emit import ProofRun
from exactpt.scene.format import loads
from exactpt.scene.written import scene_bytes
from exactpt.testing import reference
from exactpt.testing.scenes import generate
from exactpt.tiling import engine, touching
from fuzz.proofs.wrong import spliced, touching_and_going

pytestmark = pytest.mark.usefixtures("by_both_checkers")


def points(*places):
    return Scene([Body(f"p{i}", [place]) for i, place in enumerate(places)], time=(0, 1))


def header(scene):
    return list(ProofRun(scene).lines())[:3]


def test_wheel_that_winds_twice():
    # Five points around a hub, each joined to the next but one: all angles have the right
    # kinds, Euler's formula holds; only the winding of the hub is wrong.
    scene = points((0, 0), (0, 10), (-10, 3), (-6, -8), (6, -8), (10, 3))
    rim = [1, 3, 5, 2, 4]
    faces = [f"face 0 {u} {v}" for u, v in zip(rim, [*rim[1:], rim[0]], strict=True)]
    lines = [*header(scene), *faces, "outer " + " ".join(map(str, reversed(rim))), "none"]
    assert verdict(scene, lines).endswith("the edges of vertex 0 go around it 2 times")
    rim = [1, 2, 3, 4, 5]
    faces = [f"face 0 {u} {v}" for u, v in zip(rim, [*rim[1:], rim[0]], strict=True)]
    lines = [*header(scene), *faces, "outer 5 4 3 2 1", "none"]
    assert accepted(scene, lines)


def test_two_components():
    scene = points((0, 0), (9, 0), (0, 9), (20, 20), (29, 20), (20, 29))
    faces = ["face 0 1 2", "outer 2 1 0", "face 3 4 5", "outer 5 4 3"]
    assert "not connected" in verdict(scene, [*header(scene), *faces, "none"])


def passing(height):
    """A point that passes another one at t = 1, at a height above it, inside a triangle."""
    still = [(0, 0), (-4, 12), (-4, -12), (12, 0)]
    bodies = [Body(f"p{i}", [place]) for i, place in enumerate(still)]
    return Scene([*bodies, Body("q", [(-1, height)], Translation([0, 1]))], time=(0, 2))


PASSING = [
    "face 1 2 4",
    "face 2 0 4",
    "face 2 3 0",
    "face 3 1 0",
    "face 1 4 0",
    "outer 1 3 2",
]


def test_spliced_at_a_contact():
    # Both maps are valid; only what happens at t = 1 is wrong: points 0 and 4 coincide.
    scene = passing(0)
    event = "event 1 1 - 0 3 + 4 3 2 0"
    wrong = verdict(scene, [*header(scene), *PASSING, event, "none"])
    assert wrong.endswith("vertices 0 and 4 coincide at t = 1")
    right = [*header(scene), *PASSING, "contact 1 1 vertex 0 vertex 4"]
    assert accepted(scene, right)


@pytest.mark.long
@pytest.mark.parametrize("tiling", ["lazy", "greedy", "mixed"])
def test_spliced_runs(tiling):
    """Spliced at a touch-and-go contact: rejected; at a time without contact: accepted."""
    random, wrong, right = Random(tiling), 0, 0
    for _ in range(40):
        scene = touching_and_going(random, with_event=False)
        contact = reference.first_contact(scene)
        if contact is None:
            lines = spliced(scene, QQ(1), QQ(1), tiling)
            assert accepted(scene, lines)
            right += 1
        elif contact.time == 1:
            later = Scene.going_on(scene, scene.bodies, QQ(1) + QQ(1, 2**20))
            if reference.first_contact(later) is None:
                lines = spliced(scene, QQ(1), later.exact_start, tiling)
                answer = verdict(scene, lines)
                assert " at t = 1" in answer
                assert "coincide" in answer or "is on the edge" in answer
                wrong += 1
    assert right > 3
    assert wrong > 3


def test_contact_at_the_last_moment():
    scene = Scene([Body("a", [(0, 0), (4, 0)]), Body("b", [(2, 1)], Translation([0], [0, -1]))])
    lines, contact = proof_of(scene)
    assert contact.time == 1
    assert accepted(scene, lines)
    assert verdict(scene, [*lines[:-1], "none"]).endswith("vertex 2 is on the edge 0 1 at t = 1")


def test_contact_at_the_first_moment():
    # Bodies that touch at the start and part: the map after is valid.
    scene = Scene([Body("a", [(0, 0), (4, 0)]), Body("b", [(2, 0)], Translation([0], [0, 1]))])
    later = Scene.going_on(scene, scene.bodies, QQ(1, 2))
    lines = list(ProofRun(later, scene_file=scene_bytes(scene)).lines())
    lines[2] = "span 0 1"
    assert verdict(scene, lines).endswith("vertex 2 is on the edge 0 1 at t = 0")
    assert accepted(scene, proof_of(scene)[0])


def test_a_point_inside_a_body():
    square = [{"x": [x, x], "y": [y]} for x, y in ((0, 0), (4, 0), (4, 4), (0, 4))]
    scene = Scene([Body("a", square), Body("p", [(2, 1)])], time=(0, "1/9"))
    faces = [f"inside 4 {u} {v}" for u, v in ((0, 1), (1, 2), (2, 3), (3, 0))]
    lines = [*header(scene), *faces, "outer 3 2 1 0", "none"]
    assert "runs inside a body to another one" in verdict(scene, lines)
    assert accepted(scene, proof_of(scene)[0])


def test_edges_inside_a_rigid_body():
    scene = Scene([Body("a", [(0, 0), (4, 0), (4, 4), (0, 4)])])
    assert accepted(scene, [*header(scene), "outer 3 2 1 0", "none"])
    halves = ["inside 0 1 2", "inside 2 3 0", "outer 3 2 1 0"]
    assert "is there twice" in verdict(scene, [*header(scene), *halves, "none"])


def test_a_flat_vertex_that_runs_into_its_neighbour():
    bodies = [Body(f"p{i}", [(4 * i, 0)]) for i in range(3)]
    bodies[1] = Body("p1", [(4, 0)], Translation([0, 1]))
    scene = Scene(bodies, time=(0, 9))
    faces = ["outer 0 1 2 1"]
    # Which it is depends on the sample: before the vertices meet, or after.
    answer = verdict(scene, [*header(scene), *faces, "none"])
    assert "vanishes during its life" in answer or answer.endswith("the angle 2 1 0 is 0")
    right = "contact 4 4 vertex 1 vertex 2"
    assert accepted(scene, [*header(scene), *faces, right])


def test_an_event_is_needed():
    # Point 3 passes through the edge 0 1 of a triangle at t = 2, and the map does not change.
    still = [Body(f"p{i}", [p]) for i, p in enumerate([(-4, 0), (4, 0), (0, 9)])]
    scene = Scene([*still, Body("q", [(0, 2)], Translation([0], [0, -1]))], time=(0, 3))
    faces = ["face 0 1 3", "face 1 2 3", "face 2 0 3", "outer 2 1 0"]
    assert "vanishes during its life" in verdict(scene, [*header(scene), *faces, "none"])
    event = "event {} {} - 0 1 = 3 0"
    assert accepted(scene, [*header(scene), *faces, event.format(2, 2), "none"])
    for time in ("3/2", "5/2"):
        assert not accepted(scene, [*header(scene), *faces, event.format(time, time), "none"])
    # The angle at point 3 changes its kind, though both of its edges stay.
    assert not accepted(scene, [*header(scene), *faces, event[:-6].format(2, 2), "none"])


def test_another_scene():
    from exactpt import proof_check

    scene = points((0, 0), (1, 0))
    lines = "\n".join(proof_of(scene)[0]).encode()
    for text in (scene_bytes(points((0, 0), (2, 0))), b"{}"):
        with pytest.raises(proof_scene.NoProofError):
            proof_check.check(text, lines)


MISSED = [
    (
        '{"exactpt":1,"time":["0","3"],"bodies":[{"name":"g","closed":false,"vertices":[["2","1"],'
        '["2","3"],["1","3"],["1","1"]],"motion":{"y":["1","-2","1"]}},'
        '{"name":"o","vertices":[["2","1"]]},{"name":"p","vertices":[["5","-6"]]}]}'
    ),
    (
        '{"exactpt":1,"time":["0","3"],"bodies":[{"name":"g","closed":false,"vertices":[["0","0"],'
        '["3","0"],["0","-2"]],"motion":{"x":["1","-2","1"],"y":["0","-1"]}},'
        '{"name":"o","vertices":[["0","-3"],["0","-4"]]}]}'
    ),
    (
        '{"exactpt":1,"time":["0","3"],"bodies":[{"name":"g","closed":false,"vertices":[["5","2"],'
        '["5","3"],["3","2"]],"motion":{"y":["1","-2","1"]}},'
        '{"name":"o","vertices":[["3","2"],["2","2"]]}]}'
    ),
]


@pytest.mark.parametrize("tiling", ["lazy", "greedy", "mixed"])
@pytest.mark.parametrize("text", MISSED)
def test_a_missed_contact_has_no_proof(text, tiling):
    # Tilings have missed these contacts. Whatever they answer: accepted if and only if right.
    scene = loads(text)
    lines, contact = proof_of(scene, tiling)
    assert accepted(scene, lines) == agrees(scene, contact)


def mutants(lines, random):
    """Proofs with one line changed."""
    events = [i for i, line in enumerate(lines) if line.startswith("event ")]
    faces = [i for i, line in enumerate(lines) if line.startswith(("face ", "outer "))]
    i, j = sorted(random.sample(events, 2))
    words = lines[i].split()
    time = Fraction(words[1]) * random.choice([Fraction(999, 1000), Fraction(1001, 1000)])
    k = next(k for k, word in enumerate(words) if word in "-+=")
    nudged = " ".join(["event", str(time), str(time), *words[k:]])
    k = random.randrange(3, len(words))
    other = [*words[:k], str(random.randrange(12)), *words[k + 1 :]]
    swapped = lines[:]
    swapped[i], swapped[j] = lines[j], lines[i]
    f = random.choice(faces)
    yield "dropped", lines[:i] + lines[i + 1 :]
    yield "doubled", lines[: i + 1] + lines[i:]
    yield "swapped", swapped
    yield "nudged", [*lines[:i], nudged, *lines[i + 1 :]]
    yield "another vertex", [*lines[:i], " ".join(other), *lines[i + 1 :]]
    yield "no face", lines[:f] + lines[f + 1 :]
    yield "no items", [*lines[:i], " ".join(words[:-3]), *lines[i + 1 :]]
    last = lines[-1].split()
    if last[0] == "contact":
        last[-1] = str(int(last[-1]) ^ 1)
        yield "another contact", [*lines[:-1], " ".join(last)]
        yield "no contact", [*lines[:-1], "none"]


@pytest.mark.long
@pytest.mark.parametrize(
    "family", ["stars", "convex", "chains", "deforming", "turning_stars", "letters"]
)
def test_mutants(family):
    """What is accepted nevertheless claims what is true: the time of the same contact."""
    random, rejected, kept = Random(family), 0, 0
    for seed in range(4):
        scene = generate(family, seed)
        lines, _ = proof_of(scene, "lazy")
        if sum(line.startswith("event ") for line in lines) < 2:
            continue
        true = verdict(scene, lines).split(";")[0]
        for _ in range(6):
            for kind, wrong in mutants(lines, random):
                answer = verdict(scene, wrong)
                if answer.startswith("accepted: "):
                    assert answer.split(";")[0] == true, kind
                    kept += 1
                else:
                    assert answer.startswith("rejected: line ")
                    rejected += 1
    assert rejected > 20
    assert rejected > 15 * kept


@pytest.mark.long
@pytest.mark.plain
@pytest.mark.parametrize("tiling", ["lazy", "greedy", "mixed"])
def test_an_engine_that_is_blind_to_contacts(tiling, monkeypatch):
    """Its wrong answers have no proof; its right ones do. (Or it notices that it is lost.)"""
    for module in (engine, touching):
        monkeypatch.setattr(module, "report_touches", lambda *_: None)
    random, right, wrong = Random(f"blind {tiling}"), 0, 0
    for _ in range(60):
        scene = touching_and_going(random, with_event=False)
        if (expected := reference.first_contact(scene)) and expected.kind == "initial":
            continue
        try:
            lines, contact = proof_of(scene, tiling)
        except AuditError:
            continue
        assert accepted(scene, lines) == agrees(scene, contact)
        right, wrong = right + agrees(scene, contact), wrong + (not agrees(scene, contact))
    assert right > 5
    assert wrong > 2
