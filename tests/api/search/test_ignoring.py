"""Bodies that ignore each other: `pairs` looks past their contacts, a tiling refuses."""

import pytest
from click.testing import CliRunner
from commands import code_of

from exactpt import Body, InputError, Scene, Translation, first_contact
from exactpt.cli import cli
from exactpt.kernel.numbers import QQ
from exactpt.testing import reference
from exactpt.testing.scenes import generate


def box(name, x, motion=None, y=0):
    corners = [(x, y), (x + 1, y), (x + 1, y + 1), (x, y + 1)]
    return Body(name, corners, *([motion] if motion else []))


ROW = Scene(
    [box("fast", 0, Translation([0, 1])), box("near", 3), box("far", 7), box("other", 2, y=9)],
    (0, 20),
)


def test_ignored_contacts_are_passed_over():
    assert float(first_contact(ROW, method="pairs").time) == 2
    later = first_contact(ROW, method="pairs", ignoring=[["fast", "near"]])
    assert (float(later.time), {p.other for p in later.pairs} | {p.body for p in later.pairs}) == (
        6,
        {"fast", "far"},
    )
    assert first_contact(ROW, method="auto", ignoring=[("fast", "near", "far")]) is None


def test_what_overlaps_at_the_start_may_go_on():
    scene = Scene([box("a", 0, Translation([0, 1])), box("b", QQ(1, 2)), box("c", 4)], (0, 9))

    assert first_contact(scene, method="pairs").kind == "initial"
    contact = first_contact(scene, method="pairs", ignoring=[["a", "b"]])

    assert float(contact.time) == 3
    assert contact.initial_pairs == ()


def test_at_one_time_only_what_counts_is_told():
    """fast meets two bodies at t = 2; one of them is ignored."""
    scene = Scene(
        [box("fast", 0, Translation([0, 1])), box("up", 3, y=QQ(1, 2)), box("down", 3, y=-1)],
        (0, 9),
    )

    contact = first_contact(scene, method="pairs", ignoring=[["fast", "up"]])

    assert float(contact.time) == 2
    assert all({p.body, p.other} <= {"fast", "down"} for p in contact.pairs)


def test_a_body_that_closes_on_itself_is_seen_within_a_group():
    jaw = Body(
        "jaw", [(0, 0), (6, 0), {"x": [6], "y": [3, -1]}, {"x": [1], "y": [3, -1]},
                {"x": [1], "y": [2]}, (0, 2)], closed=False,
    )  # fmt: skip
    scene = Scene([jaw, box("in", 3)], (0, 4))

    assert first_contact(scene, method="pairs", ignoring=[["jaw", "in"]]).kind == "self"


@pytest.mark.parametrize("seed", range(6))
@pytest.mark.parametrize("family", ["convex", "letters", "turning_stars", "grids_passing"])
def test_of_a_body_among_others_that_ignore_each_other(family, seed):
    """The first contact is the first of that body with one of them alone, by the reference."""
    scene = generate(family, seed)
    span = (scene.start, scene.end)
    one, *others = scene.bodies[:5]
    alone = [reference.first_contact(Scene([one, other], span)) for other in others]

    groups = [[other.name for other in others]] if len(others) > 1 else []
    found = first_contact(Scene([one, *others], span), method="pairs", ignoring=groups)

    times = [float(contact.time) for contact in alone if contact is not None]
    assert (None if found is None else float(found.time)) == min(times, default=None)


@pytest.mark.parametrize(
    "arguments, message",
    [
        (
            ["--method", "kinetic", "--ignore", "fast,near"],
            "a tiling watches all bodies, but some ignore each other",
        ),
        (["--method", "pairs", "--ignore", "fast,nobody"], "there is no body 'nobody'"),
        (["--ignore", "fast"], "a group needs at least two bodies, got ['fast']"),
        (["--ignore", "fast,slow*"], "no body has a name of the pattern 'slow*'"),
    ],
)
def test_refusals(tmp_path, capsys, arguments, message):
    ROW.save(tmp_path / "row.json")
    assert code_of("collide", tmp_path / "row.json", *arguments) == 2
    assert message in capsys.readouterr().err
    with pytest.raises(InputError, match="a tiling watches all bodies"):
        first_contact(ROW, method="kinetic", ignoring=[["fast", "near"]])


def test_on_the_command_line(tmp_path):
    ROW.save(tmp_path / "row.json")
    arguments = ["collide", str(tmp_path / "row.json"), "--method", "pairs"]

    result = CliRunner().invoke(cli, [*arguments, "--ignore", "fast,near"])

    assert "first contact at t = 6.0" in result.output


@pytest.mark.parametrize("ignoring", ["ab", ["ab"], ["a", "b"]])
def test_bug_a_text_is_no_group(ignoring):
    """``["ab"]`` was read as the group of a and b, and their contact was lost."""
    triangle = [(0, 0), (1, 0), (0, 1)]
    touching = Scene([Body("a", triangle), Body("b", triangle)])

    with pytest.raises(InputError, match=r"names (is|are) needed, got"):
        first_contact(touching, ignoring=ignoring)
