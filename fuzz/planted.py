"""Planted bugs: classic mistakes, made one at a time, that the fuzzer must find.

They show that the fuzzer would find a fault if there were one. Each mistake is a temporary
change of one function, given by a replacement of its text or of the whole function: so it outlives
renumbered lines and renamed modules. It is hunted where its kind shows: in scenes of families, in
awkward ones, in the small scope, or by a question.
"""

from __future__ import annotations

import time as clock
from collections.abc import Callable, Iterator, Sequence
from contextlib import AbstractContextManager
from dataclasses import dataclass
from itertools import count
from random import Random
from typing import Any, Final, TypeAlias
from unittest.mock import patch

from exactpt import AlgebraicNumber, InputError
from exactpt.arrays import radii, turning
from exactpt.certificates import certifier, coefficients, incidences, perturbation
from exactpt.certificates.certifier import Certifier
from exactpt.certificates.queue import EventQueue
from exactpt.collision import driver
from exactpt.indices import CertificateId, HalfEdge
from exactpt.kernel import filters, roots
from exactpt.kernel.integer_polynomial import negate
from exactpt.motion import track
from exactpt.motion.enclosures import Enclosures
from exactpt.motion.swept import SweptBoxes
from exactpt.motion.track import Track
from exactpt.pairs import boxes, clearance, near_features, search
from exactpt.pairs.boxes import PieceBoxes
from exactpt.pairs.search import LinearSearch
from exactpt.query import locate
from exactpt.query.sight import FreeTriangles
from exactpt.testing.scenes import FAMILIES, generate
from exactpt.tiling import engine
from exactpt.tiling.angles import CertifiedMesh
from exactpt.tiling.clock import Clock
from exactpt.tiling.greedy.greedy import VerticalRules
from exactpt.tiling.isolated import IsolatedEvents
from exactpt.tiling.repairs import Repairs
from fuzz.cases import QUESTION, Failure, failure_of
from fuzz.changes.awkward import SUFFIX, awkward
from fuzz.laws.runner import case_of
from fuzz.laws.runner import look as look_at_case
from fuzz.power.edits import Edit, Function, Replacement
from fuzz.questions.command import KEPT, ask
from fuzz.small_scope.look import look
from fuzz.small_scope.scope import planned

__all__ = ["MOST", "PLANTED", "WITNESSES", "Found", "Mistake", "hunt", "table"]

WITNESSES: Final = ("reference", "static", "filters", "symmetry")

MOST: Final = 14 * len(FAMILIES)
"""Number of scenes in which a mistake is looked for: as many of each family, however many."""
FAMILIES_AS_THEY_ARE: Final = "families"
AWKWARD_FAMILIES: Final = "awkward families"
THE_SMALL_SCOPE: Final = "the small scope"
"""Where a mistake is hunted; or by a question, "questions/...", or by a law, "laws/..."."""

LAW: Final = "laws/"

SMALL_SCOPE: Final = 1000
"""Number of scenes of the small scope in which a mistake is looked for."""

EASY: Final = 5
"""Number of cases of a question that take about as long as a scene of a family."""

WIDTH: Final = 50
"""Width of the column of the names of mistakes."""

RADIUS_IS_MASKED: Final = (
    "A radius r is too small by less than 2 U r. From boxes [b, e] of the differences of two "
    "bodies times are bounded with a margin of at least 16 U (|b| + |e|), of which rounding needs "
    "less than half; and e - b is at least twice the sum of the radii. The margin of oriented "
    "boxes is that of the reach times 1 + 10^-10. Below the doubles each margin has 2^-500. Beyond "
    "them, a pair with finite bounds is nearer than the largest double all the time, and so in "
    "contact at the start."
)
SQUARES_ARE_MASKED: Final = (
    "Bodies are farther apart than R at the start, so that the constant term v of the squared "
    "distance is at least R^2, up to its own error. The rounding of R^2, of which R is a rounded "
    "sum, and of the difference is at most 4 U R^2 + U v; that of v at most 2 U v; and the bound "
    "of v is at least 32 U v, by 16 U for each of two or more coefficients."
)
COPIES_ARE_MASKED: Final = (
    "The order is asked for only at a corner p between two edges to copies of one vertex v, in a "
    "tile that is no triangle. At the scale of the copies, such a tile ends in a strip in the "
    "direction of p, which closes when the corner is violated. A third copy of a point is off the "
    "line of the two, and leaves the strip before. The rest of a chain is in it only if an edge of "
    "v points to p, and copies of v are beside its edges, never along them. So by then the tile is "
    "a triangle, of which another function takes care. Where p is in the place of v, at a contact, "
    "the order is 0 in both ways."
)


def _sign_at_a_root(right: Function) -> Function:
    """A sign just before now is taken for the sign just after it, if the function vanishes now."""

    def wrong(self: Certifier, *args: Any) -> Any:
        with patch.object(AlgebraicNumber, "sign_after", AlgebraicNumber.sign_before):
            return right(self, *args)

    return wrong


def _events_dropped(right: Function) -> Function:
    """Every fiftieth event is lost."""
    calls = count(1)

    def wrong(self: EventQueue, slot: CertificateId, *time: object) -> None:
        right(self, slot, *time)
        if next(calls) % 50 == 0:
            self.cancel(slot)

    return wrong


def _order_of_ties(right: Function) -> Function:
    """Events with overlapping enclosures are ordered by slot, without exact comparison."""

    def wrong(self: EventQueue, s: Any, t: Any) -> int:
        order: int = right(self, s, t)
        return order or -1

    return wrong


def _even_roots(right: Function) -> Function:
    """Roots of even multiplicity are ignored, as no certificate fails there."""

    def wrong(*args: Any) -> Iterator[Any]:
        return (root for root in right(*args) if root.crossing)

    return wrong


def _even_zeros_of_copies(right: Function) -> Function:
    """As `_even_roots`, for orientations of infinitesimal copies of one vertex only."""

    def wrong(self: Certifier, a: Any, b: Any, c: Any) -> Any:
        if len({id(v.track) for v in (a, b, c)}) == 3:
            return right(self, a, b, c)
        with Replacement(certifier, "roots_after", _even_roots).made():
            return right(self, a, b, c)

    return wrong


def _always(value: object) -> Callable[[Function], Function]:
    def make(right: Function) -> Function:  # noqa: ARG001
        return lambda *args, **kwargs: value

    return make


def _rigid_if_one_velocity(right: Function) -> Function:
    """Three vertices count as rigid if two of them are."""

    def wrong(self: Certifier, a: int, b: int, c: int) -> bool:
        pair: bool = right(self, a, b, b)
        return pair or bool(right(self, a, b, c))

    return wrong


def _no_meetings(right: Function) -> Function:  # noqa: ARG001
    """Coincident vertices are no contacts: only vertices on edges are."""
    return lambda *args: False


def _wrong_diagonal(right: Function) -> Function:
    """Of two diagonals that become collinear, the wrong one is removed."""

    def wrong(self: Repairs, h: HalfEdge) -> None:
        mesh = self.certified.mesh
        before = mesh.map.previous[h]
        if mesh.is_boundary(before) or mesh.is_boundary(h):
            right(self, h)
            return
        a, p, b = self.certified.angle(h)
        mesh.straighten(h, origin_moves=True)
        self._record_slide(h, before, "reflex", (p, b, a), origin_moves=True)

    return wrong


def _first_body_only(right: Function) -> Function:
    """At the start only vertices and edges are tested, not containment."""

    def wrong(*args: Any) -> Any:
        touches, _ = right(*args)
        return touches, sorted({(min(t.body, t.other), max(t.body, t.other)) for t in touches})

    return wrong


def _narrow(right: Function) -> Function:
    """Enclosures of roots are narrowed to a tenth of the proved width."""

    def wrong(*args: Any) -> Any:
        s, low, high = right(*args)
        middle = low + (high - low) / 2
        if not low < high < float("inf"):
            return s, low, high
        return s, middle - (middle - low) / 1000, middle + (high - middle) / 1000

    return wrong


def _flipped(right: Function) -> Function:
    """The sign of a form that is linear in all three vertices is inverted."""

    def wrong(*args: Any) -> Any:
        s, low, high = right(*args)
        return -s, low, high

    return wrong


def _swapped(right: Function) -> Function:
    """Of two vertices with identically equal x, the lower one counts as the left one."""

    def wrong(a: Any, b: Any) -> Iterator[Any]:
        dx, dy, *offsets = right(a, b)
        return iter([dx, negate(dy), *offsets])

    return wrong


def _unguarded(right: Function) -> Function:
    """Filters treat rounded coordinates as exact."""

    def wrong(self: Certifier, *args: Any, **kwargs: Any) -> None:
        right(self, *args, **kwargs)
        self.errors = [0.0] * len(self.errors)

    return wrong


@dataclass(frozen=True, slots=True)
class Mistake:
    """A mistake.

    Attributes:
        kind: the kind of the mistake, a sentence.
        change: the change of one function by which it is made.
        hunted: where it is hunted.
        masked: why no answer can show it, if none can.
    """

    kind: str
    change: Edit | Replacement
    hunted: str = FAMILIES_AS_THEY_ARE
    masked: str = ""

    def made(self) -> AbstractContextManager[object]:
        """Return a context in which it is made."""
        return self.change.made()


PLANTED: Final[dict[str, Mistake]] = {
    "sign before for sign after": Mistake(
        "A sign is taken on the wrong side of a time at which it changes.",
        Replacement(Certifier, "_exact_orientation", _sign_at_a_root),
    ),
    "sign of a certificate flipped": Mistake(
        "One of several forms of a certificate has the other orientation.",
        Replacement(coefficients, "_three", _flipped),
    ),
    "events dropped": Mistake(
        "An event is lost, now and then.",
        Replacement(EventQueue, "schedule_crossing", _events_dropped),
    ),
    "equal times not equal": Mistake(
        "Times that no double tells apart count as different.",
        Replacement(EventQueue, "_compare", _order_of_ties),
    ),
    "even roots ignored": Mistake(
        "Where a sign does not change, nothing is thought to happen.",
        Replacement(certifier, "roots_after", _even_roots),
    ),
    "even zeros of copies ignored": Mistake(
        "The same, in a case that hardly shows in families.",
        Replacement(Certifier, "_exact_orientation", _even_zeros_of_copies),
        THE_SMALL_SCOPE,
    ),
    "contact proof skipped": Mistake(
        "A necessary test is left out.", Replacement(engine, "may_touch", _always(False))
    ),
    "straight chains not followed": Mistake(
        "A degenerate place counts as a general one.",
        Replacement(CertifiedMesh, "_is_flat", _always(False)),
    ),
    "vertex on vertex ignored": Mistake(
        "One of two kinds of incidences is forgotten.",
        Replacement(incidences, "coincide", _no_meetings),
    ),
    "the wrong diagonal gives way": Mistake(
        "Of two things that are alike the wrong one is taken.",
        Replacement(Repairs, "_repair_reflex_angle", _wrong_diagonal),
    ),
    "pieces not certified anew": Mistake(
        "Something that has changed is not looked at again.",
        Replacement(CertifiedMesh, "certify_body", _always([])),
    ),
    "rigid by mistake": Mistake(
        "What holds for two is taken to hold for three.",
        Replacement(Certifier, "rigid", _rigid_if_one_velocity),
    ),
    "order of ties swapped": Mistake(
        "A tie is broken in the other way.",
        Replacement(perturbation, "x_order_terms", _swapped),
    ),
    "containment at the start missed": Mistake(
        "Boundaries are compared, and what is inside them is not.",
        Replacement(driver, "initial_touches", _first_body_only),
    ),
    "x-order kept for ever": Mistake(
        "What holds now is taken to hold for ever.",
        Replacement(Certifier, "keeps_x_order", _always(True)),
    ),
    "root enclosures too narrow": Mistake(
        "An enclosure is narrower than what is proved.",
        Replacement(filters, "linear", _narrow),
    ),
    "filter bound too small": Mistake(
        "Rounded numbers are taken for exact ones.",
        Replacement(Certifier, "__init__", _unguarded),
    ),
    "ties lost in the queue": Mistake(
        "A bound is taken to be excluded that is included.",
        Edit(EventQueue, "pop", "_heap_low[0] <= bound", "_heap_low[0] < bound"),
    ),
    "the wrong end of a corner gives way": Mistake(
        "One of two directions is confused with the other.",
        Edit(Repairs, "_repair_corner", "if side > 0", "if side < 0"),
    ),
    "the angle across not certified": Mistake(
        "One of several places that change is forgotten.",
        Edit(Repairs, "_record_slide", "twin(h), before, m.following[before]]", "twin(h), before]"),
    ),
    "the wrong end of an isolated edge slides": Mistake(
        "One of two directions is confused with the other, on a fast way.",
        Edit(IsolatedEvents, "_choose", "return signs if order > 0 else -signs", "return -signs"),
    ),
    "a contact taken for an isolated event": Mistake(
        "A fast way is taken where it does not apply.",
        Edit(IsolatedEvents, "_choose", "(stays_after if order > 0 else stays_before)", "False"),
    ),
    "an isolated angle across not certified": Mistake(
        "One of several places that change is forgotten, on a fast way.",
        Edit(
            IsolatedEvents,
            "_recertify",
            "twin(h), before, following[before]",
            "twin(h), before, before",
        ),
    ),
    "ends of pieces missed": Mistake(
        "A kind of event is forgotten.",
        Replacement(Clock, "end_of_piece", _always(None)),
    ),
    "swept boxes too small": Mistake(
        "A box does not contain what it stands for.",
        Edit(SweptBoxes, "_ranges", "r = np.maximum(", "r = 0.5 * np.maximum("),
    ),
    "the last root taken for the first": Mistake(
        "Of several solutions the wrong one is taken.",
        Edit(roots, "_quadratic_roots", "(middle - s, middle + s + 1)", "(middle + s + 1,)"),
    ),
    "the end of the span left out": Mistake(
        "A closed interval is taken for an open one.",
        Edit(Clock, "pop", "compare_rational(until) > 0", "compare_rational(until) >= 0"),
    ),
    "vertical bitangents ignored": Mistake(
        "A rule of one tiling is not applied.",
        Replacement(
            VerticalRules, "repair", lambda right: lambda self: self.cells.violated.clear()
        ),
    ),
    "single times left out": Mistake(
        "A closed interval that is a single time is taken for none.",
        Edit(clearance, "_parts_within", "sign_of(f) <= 0", "sign_of(f) < 0"),
        "questions/below",
    ),
    "a term of an error forgotten": Mistake(
        "One of the terms of a bound is left out, which only large edges show.",
        Edit(near_features, "_may_be_least", "far * off_edge + ", ""),
        "questions/moving",
    ),
    "times before 0 forgotten": Mistake(
        "The largest size of a time is taken to be that of the end of its span.",
        Edit(PieceBoxes, "_narrow", "np.maximum(np.abs(low), np.abs(high))", "np.abs(high)"),
        "questions/convoy",
    ),
    "a radius rounded down": Mistake(
        "A bound is rounded to the wrong side.",
        Edit(boxes, "radius_above", "(body.exact_radius)[1]", "(body.exact_radius)[0]"),
        "questions/convoy",
        RADIUS_IS_MASKED,
    ),
    "vertices of swapped bodies not swapped": Mistake(
        "Of two bodies that are put in order, only the names change places.",
        Edit(
            track,
            "vertex_touch",
            "Incidence(other, other_vertex, body, -1, vertex)",
            "Incidence(other, vertex, body, -1, other_vertex)",
        ),
    ),
    "places at the start off by less": Mistake(
        "The constant of a bound is too small, which far bodies show alone.",
        Edit(turning, "_at_start", "64.0 * U", "0.5 * U"),
        "questions/batch",
    ),
    "an isolated angle across not certified, mirrored": Mistake(
        "Of two mirrored branches, one forgets a place that changes.",
        Edit(IsolatedEvents, "_recertify", "h, t, following[t]", "h, t, before"),
    ),
    "the edges beside an isolated corner swapped": Mistake(
        "Before and after are confused.",
        Edit(
            IsolatedEvents,
            "_choose",
            "stays_after if order > 0 else stays_before",
            "stays_before if order > 0 else stays_after",
        ),
    ),
    "the order of copies swapped": Mistake(
        "The arguments of a function that is antisymmetric change places.",
        Edit(
            Repairs,
            "_repair_corner",
            "nearer_copy(certifier, vp, va, vb)",
            "nearer_copy(certifier, vp, vb, va)",
        ),
        THE_SMALL_SCOPE,
        COPIES_ARE_MASKED,
    ),
    "walls in line block the way": Mistake(
        "A path along a wall, or through its end, counts as one across it.",
        Edit(FreeTriangles, "may_pass", "ends[1]) >= 0", "ends[1]) > 0"),
        "laws/space/paths",
    ),
    "hits at the goal missed": Mistake(
        "The end of a closed segment is taken to be excluded.",
        Edit(locate, "cast", "beyond_goal(step.end) > 0", "beyond_goal(step.end) >= 0"),
        "laws/space/places",
    ),
    "rounded constants taken for exact": Mistake(
        "Rounded numbers are taken for exact ones, where in most scenes they are.",
        Edit(Enclosures, "_translated", "is_exact=is_exact", "is_exact=True"),
        AWKWARD_FAMILIES,
    ),
    "no contact for a double too long": Mistake(
        "A bound is rounded to the wrong side, where only the last double shows it.",
        Edit(LinearSearch, "contact_free_until", "(low, -math.inf)", "(low, math.inf)"),
        "laws/budget/searches",
    ),
    "a loop that does not look at the clock": Mistake(
        "A limit is not kept: no answer is wrong, but it comes too late.",
        Edit(
            search._Search,
            "run",
            "check_budget()\n        if self._deadline is not None and clock.monotonic() >",
            "if self._deadline is not None and clock.monotonic() - 3600 >",
        ),
        "laws/budget/looks",
    ),
    "the rounding of a square forgotten": Mistake(
        "The last operation of a formula is not in the bound of its error.",
        Edit(radii, "_squares", "error + K * (square + np.abs(value))", "error"),
        "questions/arrays",
        SQUARES_ARE_MASKED,
    ),
    "numbers packed for another width": Mistake(
        "A value that is kept is used where it does not fit any more.",
        Edit(Track, "packed", "kept != width", "kept < width"),
    ),
}
"""The mistakes by name."""


@dataclass(frozen=True, slots=True)
class Found:
    """How a planted bug was found.

    Attributes:
        bug: its name.
        failure: the failure found; None if there was none.
        place: the family of the scene, the question or the small scope.
        cases: number of cases checked.
        seconds: processor time.
    """

    bug: str
    failure: Failure | None
    place: str
    cases: int
    seconds: float

    @property
    def is_as_expected(self) -> bool:
        """True if it was found; or if it was not, and no answer can show it."""
        return (self.failure is None) == bool(PLANTED[self.bug].masked)


def hunt(
    bug: str,
    most: int = MOST,
    witnesses: Sequence[str] = WITNESSES,
    seed: int = 0,
) -> Found:
    """Look for a planted bug where it is hunted, in at most ``most`` scenes of families.

    In the small scope there are `SMALL_SCOPE` scenes; a question is asked `EASY` times as often.

    Raises:
        InputError: if the package is compiled: compiled functions cannot be patched.
    """
    if not filters.__file__.endswith(".py"):
        raise InputError("mistakes are planted in the plain package only: make plain")
    began = clock.process_time()
    mistake = PLANTED[bug]
    if mistake.hunted == THE_SMALL_SCOPE:
        cases = _in_small_scope(mistake)
    elif mistake.hunted.startswith(LAW):
        cases = _by_law(mistake, most if mistake.masked else EASY * most, seed)
    elif mistake.hunted.startswith(QUESTION):
        cases = _by_question(mistake, most if mistake.masked else EASY * most, seed)
    else:
        cases = _in_families(mistake, most, witnesses, seed)
    checked = 0
    for place, failure in cases:
        checked += 1
        if failure is not None:
            return Found(bug, failure, place, checked, clock.process_time() - began)
    return Found(bug, None, "", checked, clock.process_time() - began)


Cases: TypeAlias = "Iterator[tuple[str, Failure | None]]"
"""Where a case is from, and its failure if it has one."""


def _in_families(mistake: Mistake, most: int, witnesses: Sequence[str], seed: int) -> Cases:
    """Check scenes of the families, taken in turn, by witnesses."""
    families = list(FAMILIES)
    for number in range(most):
        family, turn = families[number % len(families)], seed + number // len(families)
        scene = generate(family, turn)
        if mistake.hunted == AWKWARD_FAMILIES:
            scene = awkward(scene, Random(f"{family} {turn}"))
            family += SUFFIX
        failure: Failure | None = None
        with mistake.made():
            for witness in witnesses:
                failure = failure_of(witness, scene, number, patience=5.0)
                if failure is not None:
                    break
        yield family, failure


def _in_small_scope(mistake: Mistake) -> Cases:
    for number in range(SMALL_SCOPE):
        with mistake.made():
            seen = look(planned(number))
        faults = [answer for answer in seen.answers if answer.fault is not None]
        failure = None
        for answer in faults[:1]:
            failure = Failure(answer.method, answer.fault or "", answer.fault or "", "")
        yield THE_SMALL_SCOPE, failure


def _by_question(mistake: Mistake, most: int, seed: int) -> Cases:
    """Ask the question of a mistake, which is compared with its definition."""
    question = mistake.hunted.removeprefix(QUESTION)
    for number in range(most):
        with mistake.made():
            asked = ask(question, seed, number, lambda _: None, None, KEPT)
        failure = None
        for finding in asked.findings[:1]:
            failure = Failure("question", finding.signature, finding.why, "")
        yield mistake.hunted, failure


def _by_law(mistake: Mistake, most: int, seed: int) -> Cases:
    """Check cases of a law."""
    law = mistake.hunted.removeprefix(LAW)
    for number in range(most):
        with mistake.made():
            fault = look_at_case(case_of(law, seed, number)).fault
        failure = None
        if fault is not None:
            failure = Failure("law", fault.signature, fault.why, "")
        yield mistake.hunted, failure


def table(found: Sequence[Found]) -> list[str]:
    """One line for each planted bug."""
    lines = [f"{'planted bug':{WIDTH}}{'cases':>7}{'seconds':>9}  found by"]
    for f in found:
        by = "masked" if PLANTED[f.bug].masked else "NOTHING"
        if f.failure is not None:
            by = f"{f.failure.witness}, {f.place}: {f.failure.signature}"
        lines.append(f"{f.bug:{WIDTH}}{f.cases:>7}{f.seconds:>9.1f}  {by}")
    return lines
