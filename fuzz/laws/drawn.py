"""Laws whose checks draw their own cases: filters, files, drawings, queries in space.

Their source is "own", a scene without bodies. A fault has its case in its text, and is not shrunk.
"""

from __future__ import annotations

from pathlib import Path
from random import Random
from tempfile import TemporaryDirectory
from typing import Final

from exactpt import Scene
from fuzz import filter_attacks, overlays, predicate_attacks
from fuzz.changes.images import TRANSFORMATIONS
from fuzz.hostile import readers
from fuzz.hostile.files import FORMATS, hostile
from fuzz.laws.law import Check, refuse_unless
from fuzz.questions.checks import QUESTIONS
from fuzz.questions.curves import wrong_along
from fuzz.questions.space import small_query, wrong_in_space
from fuzz.questions.stated import stated_case, wrong_after_moves, wrong_at_the_start
from fuzz.questions.touching_rings import wrong_validity
from fuzz.transformations import run
from fuzz.transformations.run import SCENES
from fuzz.witnesses import Difference

__all__ = [
    "as_asked",
    "curves_are_within_their_errors",
    "descriptions_change_nothing",
    "drawings_have_their_parts",
    "filters_say_what_is_true",
    "hostile_files_are_refused",
    "predicates_are_as_defined",
    "queries_in_space_are_as_defined",
    "stated_errors_are_kept",
    "touching_rings_are_valid_or_not",
]

ATTACKS: Final = 60
"""Number of polynomials in a case about filters."""

DEGREES: Final = (1, 2, 2, 3, 4, 5, 6)

SEEDS: Final = 2**32


def _raise(kind: str, fault: str | None, case: object) -> None:
    """Raise a difference if there is a fault, which is neither None nor empty."""
    if fault:
        raise Difference(kind, f"{fault}; the case: {case}")


def as_asked(question: str) -> Check:
    """Return the check that a question of ``python -m fuzz questions`` is answered right."""

    def check(scene: Scene, random: Random) -> str:  # noqa: ARG001
        """A question of ``python -m fuzz questions``, which draws its own cases."""
        checked = QUESTIONS[question](random)
        _raise(question, checked.fault, checked.to_json())
        return checked.kind

    return check


def descriptions_change_nothing(scene: Scene, random: Random) -> str:  # noqa: ARG001
    """Answers are the same if edges are cut, rings renumbered or reversed, bodies joined, ..."""
    seed, draw = random.randrange(SEEDS), random.choice(list(SCENES))
    chosen = random.choice(list(TRANSFORMATIONS))

    def is_wanted(question: str, transformation: str) -> bool:  # noqa: ARG001
        return transformation == chosen

    asked = 0
    for question, _, fault in run.check(0, seed, is_wanted, draw=SCENES[draw]):
        asked += 1
        if fault is not None:
            case = f"{fault.old.to_json()} became {fault.new.to_json()}"
            _raise(f"{question}, {chosen}", fault.why, case)
    refuse_unless(asked)
    return f"{draw}, {chosen}"


def filters_say_what_is_true(scene: Scene, random: Random) -> str:  # noqa: ARG001
    """What a filter decides holds for the polynomial, alone and in arrays, at its limits too."""
    decided = 0
    attack = filter_attacks.hostile(random, 2)
    for _ in range(ATTACKS):
        found = filter_attacks.answer(attack)
        decided += found[0] != 0
        if len(attack.c) <= 3:
            in_arrays = filter_attacks.answers([attack])
            if in_arrays != [found]:
                raise Difference("filter in arrays", f"{in_arrays}, but alone {found}; {attack}")
        for variant in (attack, *filter_attacks.variants(random, attack, found)):
            fault = filter_attacks.judge(variant, found)
            _raise(f"filter of degree {len(variant.c) - 1}", fault, variant.to_json())
        make = random.choice([filter_attacks.hostile, filter_attacks.extreme])
        attack = make(random, random.choice(DEGREES))
    return f"{10 * round(10 * decided / ATTACKS)} % decided"


def predicates_are_as_defined(scene: Scene, random: Random) -> str:  # noqa: ARG001
    """Predicates of moving vertices are as defined, by filters, in arrays and exactly."""
    attack = predicate_attacks.hostile(random)
    outcome, fault = predicate_attacks.wrong(random, attack)
    _raise("predicate", fault, attack)
    return outcome


def hostile_files_are_refused(scene: Scene, random: Random) -> str:  # noqa: ARG001
    """A damaged file is read, or refused in one line; nothing is lost or half written."""
    form = random.choice(FORMATS)
    number, seed = random.randrange(SEEDS), random.randrange(SEEDS)
    file = hostile(form, number, seed)
    with TemporaryDirectory() as folder:
        ended = readers.read(form, file, Random(f"reader {seed} {number}"), Path(folder))
    where = f"fuzz.hostile.files.hostile({form!r}, {number}, {seed}) by {ended.reader}"
    _raise(f"hostile {form}", ended.fault, where)
    return f"{form} {ended.outcome}"


def queries_in_space_are_as_defined(scene: Scene, random: Random) -> str:  # noqa: ARG001
    """Contacts of two segments, or of a vertex and a triangle, in space are as defined."""
    query = small_query(random)
    kind, fault = wrong_in_space(query)
    _raise("space", fault, query)
    return kind


def drawings_have_their_parts(scene: Scene, random: Random) -> str:  # noqa: ARG001
    """The parts that rings fill by each rule, and their union, are those of the definition."""
    drawing = overlays.random_drawing(random)
    _raise("drawing", overlays.fault_of_drawing(drawing), drawing)
    return drawing.kind


def stated_errors_are_kept(scene: Scene, random: Random) -> str:  # noqa: ARG001
    """A contact at the start is certain only if it is there after each move by the errors."""
    case = stated_case(random)
    kind, fault = wrong_at_the_start(case)
    _raise("stated errors", fault or wrong_after_moves(random, case), case.scene.to_json())
    return kind


def curves_are_within_their_errors(scene: Scene, random: Random) -> str:  # noqa: ARG001
    """A path through points is the curve as given, within the errors that it states."""
    made, kind, fault = wrong_along(random)
    _raise("curve", fault, made.to_json())
    return kind


def touching_rings_are_valid_or_not(scene: Scene, random: Random) -> str:  # noqa: ARG001
    """Bodies whose rings touch are accepted exactly if their interior is connected and simple."""
    made, fault = wrong_validity(random)
    _raise("validity", fault, made and made.to_json())
    return "refused" if made is None else "accepted"
