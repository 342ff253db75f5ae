"""Planted bugs: classic mistakes, made one at a time, that the fuzzer must find.

They show that the fuzzer would find a fault if there were one. Each mistake is a temporary
patch of one function.
"""

from __future__ import annotations

import inspect
import textwrap
import time as clock
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from itertools import count
from typing import Any, Final
from unittest.mock import patch

from exactpt import AlgebraicNumber, InputError
from exactpt.certificates import certifier, coefficients, incidences, perturbation
from exactpt.certificates.certifier import Certifier
from exactpt.certificates.queue import EventQueue
from exactpt.collision import driver
from exactpt.indices import CertificateId, HalfEdge
from exactpt.kernel import filters, roots
from exactpt.kernel.integer_polynomial import negate
from exactpt.motion.swept import SweptBoxes
from exactpt.scene.generate import FAMILIES, generate
from exactpt.tiling import engine
from exactpt.tiling.angles import CertifiedMesh
from exactpt.tiling.clock import Clock
from exactpt.tiling.greedy.greedy import VerticalRules
from exactpt.tiling.isolated import IsolatedEvents
from exactpt.tiling.repairs import Repairs
from fuzz.cases import Failure, failure_of
from fuzz.small_scope.look import look
from fuzz.small_scope.scope import planned

__all__ = ["PLANTED", "WITNESSES", "Found", "hunt", "table"]

WITNESSES: Final = ("reference", "static", "filters", "symmetry")

IN_SMALL_SCOPE: Final = frozenset({"even zeros of copies ignored"})
"""Bugs that hardly show in families: they are hunted in the small scope."""

SMALL_SCOPE: Final = 1000
"""Number of scenes of the small scope in which these are looked for."""

Function = Callable[..., Any]


def _replaced(owner: object, name: str, make: Callable[[Function], Function]) -> Any:
    """A context in which a function is replaced by a wrong one made from it."""
    return patch.object(owner, name, make(getattr(owner, name)))


def _edited(owner: Any, name: str, old: str, new: str) -> Any:
    """A context in which a function has another text, of which ``old`` is replaced by ``new``."""
    right = getattr(owner, name)
    text = textwrap.dedent(inspect.getsource(right))
    if text.count(old) != 1:
        raise InputError(f"planted: {name} has {text.count(old)} times the text {old!r}")
    made: dict[str, Any] = {}
    exec(text.replace(old, new), right.__globals__, made)
    return patch.object(owner, name, made[name])


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
        with _replaced(certifier, "roots_after", _even_roots):
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


PLANTED: Final[dict[str, Callable[[], Any]]] = {
    "sign before for sign after": lambda: _replaced(
        Certifier, "_exact_orientation", _sign_at_a_root
    ),
    "sign of a certificate flipped": lambda: _replaced(coefficients, "_three", _flipped),
    "events dropped": lambda: _replaced(EventQueue, "schedule_crossing", _events_dropped),
    "equal times not equal": lambda: _replaced(EventQueue, "_compare", _order_of_ties),
    "even roots ignored": lambda: _replaced(certifier, "roots_after", _even_roots),
    "even zeros of copies ignored": lambda: _replaced(
        Certifier, "_exact_orientation", _even_zeros_of_copies
    ),
    "contact proof skipped": lambda: _replaced(engine, "may_touch", _always(False)),
    "straight chains not followed": lambda: _replaced(CertifiedMesh, "_is_flat", _always(False)),
    "vertex on vertex ignored": lambda: _replaced(incidences, "coincide", _no_meetings),
    "the wrong diagonal gives way": lambda: _replaced(
        Repairs, "_repair_reflex_angle", _wrong_diagonal
    ),
    "pieces not certified anew": lambda: _replaced(CertifiedMesh, "certify_body", _always([])),
    "rigid by mistake": lambda: _replaced(Certifier, "rigid", _rigid_if_one_velocity),
    "order of ties swapped": lambda: _replaced(perturbation, "x_order_terms", _swapped),
    "containment at the start missed": lambda: _replaced(
        driver, "initial_touches", _first_body_only
    ),
    "x-order kept for ever": lambda: _replaced(Certifier, "keeps_x_order", _always(True)),
    "root enclosures too narrow": lambda: _replaced(filters, "linear", _narrow),
    "filter bound too small": lambda: _replaced(Certifier, "__init__", _unguarded),
    "ties lost in the queue": lambda: _edited(
        EventQueue, "pop", "_heap_low[0] <= bound", "_heap_low[0] < bound"
    ),
    "the wrong end of a corner gives way": lambda: _edited(
        Repairs, "_repair_corner", "if side > 0", "if side < 0"
    ),
    "the angle across not certified": lambda: _edited(
        Repairs, "_record_slide", "twin(h), before, m.following[before]]", "twin(h), before]"
    ),
    "the wrong end of an isolated edge slides": lambda: _edited(
        IsolatedEvents, "_choose", "return signs if order > 0 else -signs", "return -signs"
    ),
    "a contact taken for an isolated event": lambda: _edited(
        IsolatedEvents, "_choose", "(stays_after if order > 0 else stays_before)", "False"
    ),
    "an isolated angle across not certified": lambda: _edited(
        IsolatedEvents,
        "_recertify",
        "twin(h), before, following[before]",
        "twin(h), before, before",
    ),
    "ends of pieces missed": lambda: _replaced(Clock, "end_of_piece", _always(None)),
    "swept boxes too small": lambda: _edited(
        SweptBoxes, "_ranges", "r = np.maximum(", "r = 0.5 * np.maximum("
    ),
    "the last root taken for the first": lambda: _edited(
        roots, "_quadratic_roots", "(middle - s, middle + s + 1)", "(middle + s + 1,)"
    ),
    "the end of the span left out": lambda: _edited(
        Clock, "pop", "compare_rational(until) > 0", "compare_rational(until) >= 0"
    ),
    "vertical bitangents ignored": lambda: _replaced(
        VerticalRules, "repair", lambda right: lambda self: self.cells.violated.clear()
    ),
}
"""The mistakes: functions that return a context in which the mistake is made."""


@dataclass(frozen=True, slots=True)
class Found:
    """How a planted bug was found.

    Attributes:
        bug: its name.
        failure: the failure found; None if there was none.
        family: the family of the scene.
        scenes: number of scenes checked.
        seconds: processor time.
    """

    bug: str
    failure: Failure | None
    family: str
    scenes: int
    seconds: float


def hunt(bug: str, most: int = 400, witnesses: Sequence[str] = WITNESSES, seed: int = 0) -> Found:
    """Look for a planted bug in at most ``most`` scenes of a campaign, or of the small scope.

    Raises:
        InputError: if the package is compiled: compiled functions cannot be patched.
    """
    if not filters.__file__.endswith(".py"):
        raise InputError("mistakes are planted in the plain package only: make plain")
    began = clock.process_time()
    if bug in IN_SMALL_SCOPE:
        return _hunt_in_small_scope(bug, began)
    families = list(FAMILIES)
    for number in range(most):
        family = families[number % len(families)]
        scene = generate(family, seed + number // len(families))
        with PLANTED[bug]():
            for witness in witnesses:
                failure = failure_of(witness, scene, number, patience=5.0)
                if failure is not None:
                    return Found(bug, failure, family, number + 1, clock.process_time() - began)
    return Found(bug, None, "", most, clock.process_time() - began)


def _hunt_in_small_scope(bug: str, began: float) -> Found:
    for number in range(SMALL_SCOPE):
        with PLANTED[bug]():
            seen = look(planned(number))
        for answer in seen.answers:
            if answer.fault is not None:
                failure = Failure(answer.method, answer.fault, answer.fault, "")
                seconds = clock.process_time() - began
                return Found(bug, failure, "the small scope", number + 1, seconds)
    return Found(bug, None, "", SMALL_SCOPE, clock.process_time() - began)


def table(found: Sequence[Found]) -> list[str]:
    """One line for each planted bug."""
    lines = [f"{'planted bug':34}{'scenes':>7}{'seconds':>9}  found by"]
    for f in found:
        by = f"{f.failure.witness}, {f.family}: {f.failure.signature}" if f.failure else "NOTHING"
        lines.append(f"{f.bug:34}{f.scenes:>7}{f.seconds:>9.1f}  {by}")
    return lines
