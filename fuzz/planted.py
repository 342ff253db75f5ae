"""Planted mistakes: classic ones, made one at a time, that the laws must find.

They show that the laws would find a fault if there were one (`python -m fuzz power`). Each mistake
is a temporary change of one function: of its text, or of the whole function. So it outlives
renumbered lines and renamed modules.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import AbstractContextManager
from dataclasses import dataclass
from itertools import count
from typing import Any, Final
from unittest.mock import patch

from exactpt import AlgebraicNumber
from exactpt.arrays import radii, turning
from exactpt.certificates import certifier, coefficients, incidences, perturbation
from exactpt.certificates import first_root as filters
from exactpt.certificates.certifier import Certifier
from exactpt.certificates.queue import EventQueue
from exactpt.filters import straight, windows
from exactpt.filters.exactly import Entry
from exactpt.filters.features import Filter
from exactpt.filters.starts import Starts
from exactpt.filters.straight import Passage
from exactpt.filters.windows import Window
from exactpt.indices import CertificateId, HalfEdge
from exactpt.kernel import roots
from exactpt.kernel.integer_polynomial import negate
from exactpt.motion import track
from exactpt.motion.enclosures import Enclosures
from exactpt.motion.swept import SweptBoxes
from exactpt.motion.track import Track
from exactpt.pair import near_features
from exactpt.query import locate
from exactpt.query.sight import FreeTriangles
from exactpt.search import clearance
from exactpt.search.body_rows import BodyRows
from exactpt.search.decide import Decider
from exactpt.search.new import NewContactSearch
from exactpt.search.reading import Rows
from exactpt.search.sweep import Ignored
from exactpt.search.sweep_search import Slabs, Sweep
from exactpt.tiling import driver, engine
from exactpt.tiling.angles import CertifiedMesh
from exactpt.tiling.clock import Clock
from exactpt.tiling.greedy.greedy import VerticalRules
from exactpt.tiling.isolated import IsolatedEvents
from exactpt.tiling.repairs import Repairs
from fuzz.power.edits import Edit, Function, Replacement

__all__ = ["PLANTED", "Mistake"]

RADIUS_IS_MASKED: Final = (
    "A radius r is too small by less than 2 U r, and positive. With R, the sum of two radii, the "
    "distance of two boxes is compared with R times 1 + 10^-10; the bound of f = u x z - R |u| has "
    "16 U R |u| for R and for |u|, of which rounding needs less than half; that of z . z - R^2 "
    "likewise 16 U R^2. Below the doubles each bound has 2^-500."
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
        masked: why no answer can show it, if none can.
    """

    kind: str
    change: Edit | Replacement
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
    ),
    "a term of an error forgotten": Mistake(
        "One of the terms of a bound is left out, which only large edges show.",
        Edit(near_features, "may_be_least", "far * off_edge + ", ""),
    ),
    "a radius rounded down": Mistake(
        "A bound is rounded to the wrong side.",
        Edit(
            Rows,
            "reach",
            "enclosing_floats(reach * power_of_two(-self.units.scale[0]))[1]",
            "(enclosing_floats(reach * power_of_two(-self.units.scale[0]))[0] or 2.0**-1074)",
        ),
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
        COPIES_ARE_MASKED,
    ),
    "walls in line block the way": Mistake(
        "A path along a wall, or through its end, counts as one across it.",
        Edit(FreeTriangles, "may_pass", "ends[1]) >= 0", "ends[1]) > 0"),
    ),
    "hits at the goal missed": Mistake(
        "The end of a closed segment is taken to be excluded.",
        Edit(locate, "cast", "beyond_goal(step.end) > 0", "beyond_goal(step.end) >= 0"),
    ),
    "rounded constants taken for exact": Mistake(
        "Rounded numbers are taken for exact ones, where in most scenes they are.",
        Edit(Enclosures, "_translated", "is_exact=is_exact", "is_exact=True"),
    ),
    "no contact for a double too long": Mistake(
        "A bound is rounded to the wrong side, where only the last double shows it.",
        Edit(Sweep, "free_until", "nextafter(low, -math.inf)", "nextafter(low, math.inf)"),
    ),
    "a step of the length of the next one": Mistake(
        "A value is used after it has changed.",
        Edit(
            Slabs,
            "__iter__",
            "low, length = slab.high,",
            "low, length = slab.high + slab.high - slab.low,",
        ),
    ),
    "groups but the first forgotten": Mistake(
        "Of several the first one is taken for all.",
        Edit(Ignored, "has", "while p < first[i + 1] and", "while p < first[i] + 1 and"),
    ),
    "the first decided taken for the earliest": Mistake(
        "A bound of an order is taken for the order.",
        Edit(Decider, "_decide_one_by_one", "candidate.low > self._high", "self.best.found"),
    ),
    "a contact after the slab taken for the first": Mistake(
        "What is complete within an interval is used beyond it.",
        Edit(Decider, "_decide_in_doubles", "and time <= of_double(until)", ""),
    ),
    "rounded rows taken for exact": Mistake(
        "Rounded numbers are taken for exact ones.",
        Edit(
            BodyRows,
            "_line",
            "Errors(places.error, path, speed)",
            "EXACT",
        ),
    ),
    "the later start of two pieces forgotten": Mistake(
        "What begins for one of two is taken to begin for both.",
        Edit(
            Decider,
            "_first",
            "max(rows.span.start, one_start, other_start)",
            "max(rows.span.start, one_start)",
        ),
    ),
    "a constant turn forgotten": Mistake(
        "What is usually 1 is taken to be 1.",
        Edit(BodyRows, "_turning", "if cosine == 1 else", "if True else"),
    ),
    "the box at rest taken for that of all turns": Mistake(
        "What holds at one time is taken to hold at all times.",
        Edit(BodyRows, "waiting", ".turned_box", ".box"),
    ),
    "bodies left waiting for their pieces": Mistake(
        "What is put off is never done.",
        Edit(Slabs, "_with_pieces", "while slab.pairs.waiting:", "while not slab:"),
    ),
    "affine bodies taken for rigid ones": Mistake(
        "A comparison of kinds is off by one.",
        Edit(BodyRows, "_piece", "deforms=kind >= AFFINE", "deforms=kind > AFFINE"),
    ),
    "a contact that lasts taken for a new one": Mistake(
        "What is looked at by itself is not left out elsewhere.",
        Edit(NewContactSearch, "_first_contact", "_sweep_but(touching)", "_sweep_but([])"),
    ),
    "a distance forgotten where rows are kept": Mistake(
        "What is kept of one question is used for another.",
        Edit(Rows, "grown", "self._extra + extra", "self._extra"),
    ),
    "a distance forgotten by rows that wait": Mistake(
        "What changes rows does not change those that are still to be made.",
        Edit(
            Rows,
            "_copied",
            "reader.adding_to(other.table, radius)",
            "reader.adding_to(other.table, 0.0)",
        ),
    ),
    "an anchor at (x, x)": Mistake(
        "One coordinate is used for both.",
        Edit(
            windows, "quotients", "table.frames[anchor + PATH_Y]", "table.frames[anchor + PATH_X]"
        ),
    ),
    "the origin of a piece forgotten": Mistake(
        "A time since one begin is taken for a time since another.",
        Edit(Window, "fill", "middle -= table.origin[piece]", "middle -= 0.0"),
    ),
    "a time of the rows taken for one of the scene": Mistake(
        "A number is used in another unit.",
        Edit(
            Decider,
            "_decide_one_by_one",
            "self._rows.units.exact_time(limit)",
            "of_double(limit)",
        ),
    ),
    "times before 0 forgotten": Mistake(
        "The largest size of a time is taken to be that of the end of its span.",
        Edit(straight, "meeting", "w_error * larger_size(low, high)", "w_error * high"),
    ),
    "containment at the start missed by doubles": Mistake(
        "Boundaries are compared, and what is inside them is not.",
        Edit(
            Starts,
            "are_disjoint",
            "pair.is_second_outside() and swapped.is_second_outside()",
            "True",
        ),
    ),
    "the wrong end of an edge along which a vertex slides": Mistake(
        "One of two directions is confused with the other.",
        Edit(Entry, "find", "and w_along > 0.0", "and w_along < 0.0"),
    ),
    "vertices in line with an edge left out": Mistake(
        "A function that vanishes identically is taken for one without a zero.",
        Edit(Passage, "compare", "found.add(features, self.low, high, high)", "pass"),
    ),
    "two vertices of bodies with radii not compared": Mistake(
        "One of several kinds of features is forgotten.",
        Edit(Filter, "_collect_window", "if self.distance != 0.0:", "if False:"),
    ),
    "one side of an edge forgotten": Mistake(
        "Of two roots only one is looked for.",
        Edit(Filter, "_add_edge", "(distance, -distance)", "(distance,)"),
    ),
    "a loop that does not look at the clock": Mistake(
        "A limit is not kept: no answer is wrong, but it comes too late.",
        Edit(
            Sweep,
            "_search",
            "check_budget()\n        if self._deadline is not None and clock.monotonic() >",
            "if self._deadline is not None and clock.monotonic() - 3600 >",
        ),
    ),
    "the rounding of a square forgotten": Mistake(
        "The last operation of a formula is not in the bound of its error.",
        Edit(radii, "_squares", "error + K * (square + np.abs(value))", "error"),
        SQUARES_ARE_MASKED,
    ),
    "numbers packed for another width": Mistake(
        "A value that is kept is used where it does not fit any more.",
        Edit(Track, "packed", "kept != width", "kept < width"),
    ),
}
"""The mistakes by name."""
