"""Proofs of right answers are accepted: all families, all tilings, degenerate ones too."""

import sys

import pytest
from folding import every
from proving import agrees, by_both_checkers, proof_of, verdict  # noqa: F401 - a fixture

from exactpt import Body, Pieces, Rigid, Scene, Spin, Translation, proof_check, prove
from exactpt.testing.scenes import FAMILIES, POINTS, generate

pytestmark = pytest.mark.usefixtures("by_both_checkers")


@pytest.mark.long
@pytest.mark.parametrize("family", [*FAMILIES, *POINTS])
def test_families(family):
    for seed in (11, 12):
        scene = generate(family, seed)
        for tiling in ("lazy", "greedy", "mixed", *(["incremental"] if family in POINTS else [])):
            lines, contact = proof_of(scene, tiling)
            assert verdict(scene, lines).startswith("accepted: "), (family, seed, tiling)
            assert agrees(scene, contact)


def box(name, x, y, motion=None, size=1):
    corners = [(x, y), (x + size, y), (x + size, y + size), (x, y + size)]
    return Body(name, corners, motion or Translation())


def test_contact():
    scene = Scene([box("a", 0, 0, Translation([0, 1])), box("b", 4, 0)], time=(0, 10))
    lines, _ = proof_of(scene)
    answer = "accepted: first contact at T = 3: incidences exactly b0.1 at b1.0, b0.2 at b1.3"
    answer += " (b0 is 'a', b1 is 'b')"
    assert verdict(scene, lines) == answer


def test_a_turn_that_begins_at_an_angle_and_passes_180_degrees():
    quarters = [(0, 1), (-1, 0), (0, -1), (1, 0)]
    turns = [Rigid([-i, 1], pivot=(0, 0), orientation=c) for i, c in enumerate(quarters)]
    until = [1, 2, 3, None]
    blade = Body("blade", [(0, 0), (3, 0), (3, 1)], Pieces(list(zip(until, turns, strict=True))))
    for post in [(2, -2), (9, 9)]:
        scene = Scene([blade, Body("post", [post])], time=(0, 4))
        lines, contact = proof_of(scene)
        assert (contact is None) == (post == (9, 9))
        assert verdict(scene, lines).startswith("accepted: ")


def test_a_spin_is_pieces_to_a_checker():
    mill = Body("mill", [(0, 0), (3, 0), (3, 1)], Spin(2, error="1/10"))
    scene = Scene([mill, Body("post", [(-2, -2)])], time=(0, 3))
    lines, contact = proof_of(scene)
    assert contact is not None
    assert verdict(scene, lines).startswith("accepted: ")


def test_no_contact():
    scene = Scene([box("a", 0, 0), box("b", 4, 0)], time=(0, 10))
    lines, _ = proof_of(scene)
    assert verdict(scene, lines) == "accepted: no contact in [0, 10], the whole span"


@every(
    "bodies, what",
    [
        ([box("a", 0, 0), box("b", 1, 0)], "b0.1 at b1.0"),
        ([box("a", 0, 0, size=4), box("b", 1, 1)], "b1.0 in the inside of b0"),
        (
            [Body("a", [(0, 1), (4, 1)]), Body("b", [(2, 0), (2, 3)])],
            "edge b0.0 meets edge b1.0",
        ),
        (
            [box("a", 0, 0, size=4), Body("b", [(2, 0)])],
            "b1.0 on edge b0.0",
        ),
    ],
)
def test_contact_at_the_start_is_one_line(bodies, what):
    scene = Scene(bodies, time=(0, 1))
    lines, _ = proof_of(scene)
    assert len(lines) == 4
    assert verdict(scene, lines) == (
        f"accepted: contact at the start t = 0: {what} (b0 is 'a', b1 is 'b')"
    )


@every(
    "bodies",
    [
        [],
        [Body("p", [(0, 0)])],
        [Body("p", [(0, 0)]), Body("q", [(1, 0)], Translation([0, 1]))],
        [Body("s", [(0, 0), (1, 1)])],
        [Body("c", [(0, 0), (1, 0), (2, 0), (3, 0)], closed=False), Body("p", [(5, 0)])],
        [box("a", 0, 0)],
    ],
)
def test_few_vertices_and_all_on_a_line(bodies):
    scene = Scene(bodies, time=(0, 1))
    lines, contact = proof_of(scene)
    assert contact is None
    assert verdict(scene, lines) == "accepted: no contact in [0, 1], the whole span"


def test_points_on_a_line_run_into_each_other():
    bodies = [Body(f"p{i}", [(3 * i, i)], Translation([0, 4 - i], [0])) for i in (0, 1, 2)]
    flat = [Body(b.name, [(3 * i, 0)], b.motion) for i, b in enumerate(bodies)]
    for scene in (Scene(bodies, time=(0, 9)), Scene(flat, time=(0, 9))):
        for tiling in ("lazy", "greedy", "mixed", "incremental"):
            lines, contact = proof_of(scene, tiling)
            assert agrees(scene, contact)
            assert verdict(scene, lines).startswith("accepted: "), tiling


@pytest.mark.parametrize("x, y", [([0], [-2, 0, 1]), ([-2, 0, 1], [0]), ([-2, 0, 1], [-2, 0, 1])])
def test_points_on_a_line_meet_at_an_irrational_time(x, y):
    scene = Scene([Body("p", [(0, 0)]), Body("q", [(0, 0)], Translation(x, y))], time=(0, 2))
    for tiling in ("lazy", "greedy", "mixed", "incremental"):
        lines, contact = proof_of(scene, tiling)
        assert contact.time.polynomial == (-2, 0, 1)
        answer = verdict(scene, lines)
        assert answer.startswith("accepted: first contact at T = 1.4142"), tiling


def test_angle_straight_for_a_moment_is_taken_anew():
    # The deforming chain's middle vertex touches the line of its ends at t = 1.
    middle = {"x": [1], "y": [1, -2, 1]}
    chain = Body("c", [(0, 0), middle, (2, 0)], closed=False)
    scene = Scene([chain, Body("p", [(1, 5)])], time=(0, 3))
    lines, _ = proof_of(scene)
    assert any("=" in line.split() for line in lines)
    assert verdict(scene, lines).startswith("accepted: ")


def test_flat_angles_open_at_a_breakpoint():
    rest, rise = Translation(), Translation([0], [-1, 1])
    bodies = [Body("p", [(0, 0)]), Body("r", [(4, 0)]), Body("s", [(2, 4)])]
    bodies.append(Body("q", [(2, 0)], Pieces([(1, rest), (None, rise)])))
    scene = Scene(bodies, time=(0, 2))
    for tiling in ("lazy", "greedy", "mixed", "incremental"):
        lines, contact = proof_of(scene, tiling)
        assert contact is None
        assert verdict(scene, lines).startswith("accepted: "), tiling


def test_a_tiling_that_is_built_anew():
    scene = generate("crossing_lines", 20)
    lines, contact = proof_of(scene, "mixed")
    assert agrees(scene, contact)
    assert verdict(scene, lines).startswith("accepted: ")


def test_proof_in_memory():
    scene = generate("stars", 6)
    contact, file, proof = prove(scene, tiling="greedy")
    assert agrees(scene, contact)
    assert proof_check.check(file, proof).startswith("accepted: ")


def test_times_are_named_by_what_vanishes():
    lines, _ = proof_of(generate("turning_stars", 3), "lazy")
    events = [line for line in lines if line.startswith("event ")]
    assert sum(" @ " in line for line in events) > len(events) / 2
    assert max(map(len, events)) < 300


def test_bug_a_proof_with_numbers_longer_than_python_reads_is_checked_in_the_same_process(tmp_path):
    far = 10**5000 + 1
    ball = Body("ball", [(0, 0)], Translation([0, 1]))
    scene = Scene([ball, Body("wall", [(far, -1), (far, 1)])], (0, 2 * far))
    limit = sys.get_int_max_str_digits()
    proved = prove(scene)
    proved.save(tmp_path / "a.proof")

    assert " first contact at T = 1000" in proved.check()
    files = [str(tmp_path / "a.proof.scene.json"), str(tmp_path / "a.proof")]
    assert proof_check.main(files) == 0
    assert sys.get_int_max_str_digits() == limit
