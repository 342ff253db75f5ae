"""Laws by witnesses: another program, another version, another definition says the same."""

from __future__ import annotations

from random import Random

from exactpt import Scene
from exactpt.check import check_run
from exactpt.testing import reference
from fuzz.laws.law import check_equal, refuse_unless
from fuzz.laws.questions import defined_intervals
from fuzz.laws.tilings import a_tiling
from fuzz.old_engine.answers import answer_to
from fuzz.old_engine.compare import compared
from fuzz.old_engine.process import Answer, compiled_engine, old_engine
from fuzz.witnesses import Difference, tilings_of

__all__ = ["cgal_accepts_runs", "compiled_is_plain", "definitions_agree", "old_engine_agrees"]


def definitions_agree(scene: Scene, random: Random) -> str:  # noqa: ARG001
    """The first contact by all pairs is the start of the first interval by critical times."""
    refuse_unless(not any(body.has_rings or body.keyframes for body in scene.bodies))
    contact = reference.first_contact(scene)
    refuse_unless(contact is None or contact.kind != "self")
    starts = []
    for a, b in reference.counted_pairs(scene):
        intervals = defined_intervals(scene, a, b)
        starts += [interval[0] for interval in intervals[:1]]
    check_equal("time of the first contact", contact and contact.time, min(starts, default=None))
    return "no contact" if contact is None else contact.kind


def cgal_accepts_runs(scene: Scene, random: Random) -> str:
    """CGAL accepts every tiling and every event time of a run."""
    tiling = a_tiling(scene, random)
    report = check_run(scene, tiling=tiling)
    if not report.ok:
        raise Difference(f"{tiling}: cgal", report.failures[0])
    return f"{tiling}, {'some' if report.events else 'no'} events"


def old_engine_agrees(scene: Scene, random: Random) -> str:
    """The engine of version 0.2 gives the same results, byte for byte, or bounds of one time."""
    outcome = ""
    for asked in compared(scene, tilings_of(scene), random.randrange(100), old_engine()):
        if asked.is_left_out:
            continue
        outcome = asked.question
        if not asked.agrees:
            kind = f"{asked.question}: {asked.new.kind}"
            raise Difference(kind, f"{asked.arguments}: {asked.new.text}, once {asked.old.text}")
    refuse_unless(outcome)
    return outcome


def compiled_is_plain(scene: Scene, random: Random) -> str:
    """The compiled package gives the same results and events as the plain one, byte for byte."""
    tiling = a_tiling(scene, random)
    questions: list[tuple[str, dict[str, object]]] = [
        ("first contact", {}),
        ("run", {"tiling": tiling}),
        ("run", {"tiling": tiling, "exact_only": True}),
        ("contacts", {}),
        ("enclosed contact", {}),
    ]
    asked, arguments = random.choice(questions)
    plain = Answer.of(answer_to(asked, scene, arguments))
    compiled = compiled_engine().ask(asked, scene, **arguments)
    check_equal(f"{asked}, compiled", compiled, plain)
    return f"{asked}, {plain.kind}"
