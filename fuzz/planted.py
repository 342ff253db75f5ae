"""Planted bugs: classic mistakes, put in one at a time, that the fuzzer must find.

Who trusts a fuzzer that finds nothing should see it find something. Each mistake is a
patch of one function while it lasts; nothing is left behind.
"""

from __future__ import annotations

import time as clock
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from typing import Any, Final
from unittest.mock import patch

from exactpt.certificates import certifier, coefficients, incidences, perturbation
from exactpt.certificates.certifier import Certifier
from exactpt.certificates.queue import EventQueue
from exactpt.collision import detector
from exactpt.errors import InputError
from exactpt.kernel import filters
from exactpt.kernel.algebraic import AlgebraicNumber
from exactpt.kernel.integer_polynomial import negate
from exactpt.scene.generate import FAMILIES, generate
from exactpt.tiling import engine
from exactpt.tiling.angles import CertifiedMesh
from exactpt.tiling.greedy.greedy import VerticalRules
from exactpt.tiling.repairs import Repairs
from fuzz.cases import Failure, failure_of

__all__ = ["PLANTED", "WITNESSES", "Found", "hunt", "table"]

WITNESSES: Final = ("reference", "static", "filters", "symmetry")

Function = Callable[..., Any]


def _replaced(owner: object, name: str, make: Callable[[Function], Function]) -> Any:
    """A patch of a function by what is made of the right one."""
    return patch.object(owner, name, make(getattr(owner, name)))


def _sign_at_a_root(right: Function) -> Function:
    """Of a function that vanishes now, the sign before now is taken for the one after."""

    def wrong(self: Certifier, *args: Any) -> Any:
        with patch.object(AlgebraicNumber, "sign_after", AlgebraicNumber.sign_before):
            return right(self, *args)

    return wrong


def _events_dropped(right: Function) -> Function:
    """Every fiftieth event is lost."""

    def wrong(self: EventQueue, slot: int, time: object) -> None:
        right(self, slot, time)
        if self._sequence % 50 == 0:
            self.cancel(slot)

    return wrong


def _order_of_ties(right: Function) -> Function:
    """Events that overlap are not compared exactly: the first slot comes first."""

    def wrong(self: EventQueue, s: Any, t: Any) -> int:
        order: int = right(self, s, t)
        return order or -1

    return wrong


def _even_roots(right: Function) -> Function:
    """Roots of even multiplicity are passed over, as no certificate fails there."""

    def wrong(*args: Any) -> Iterator[Any]:
        return (root for root in right(*args) if root.crossing)

    return wrong


def _even_zeros_of_copies(right: Function) -> Function:
    """The same of the orientations of copies of one vertex alone."""

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
    """Vertices are taken for rigid if two of the three are."""

    def wrong(self: Certifier, a: int, b: int, c: int) -> bool:
        pair: bool = right(self, a, b, b)
        return pair or bool(right(self, a, b, c))

    return wrong


def _no_meetings(right: Function) -> Function:  # noqa: ARG001
    """Vertices that coincide do not count: only edges are hit."""
    return lambda *args: False


def _wrong_diagonal(right: Function) -> Function:
    """Of two diagonals that become one line, the other one gives way."""

    def wrong(self: Repairs, h: int) -> None:
        mesh = self.certified.mesh
        before = mesh.map.previous[h]
        if mesh.is_boundary(before) or mesh.is_boundary(h):
            right(self, h)
            return
        a, p, b = self.certified.angle(h)
        mesh.straighten(h, origin_moves=True)
        self._slid(h, before, "reflex", (p, b, a), origin_moves=True)

    return wrong


def _first_body_only(right: Function) -> Function:
    """Contacts at the start are looked for, but only between vertices and edges."""

    def wrong(scene: Any) -> Any:
        touches, _ = right(scene)
        return touches, sorted({(min(t.body, t.other), max(t.body, t.other)) for t in touches})

    return wrong


def _narrow(right: Function) -> Function:
    """Enclosures of roots are a tenth of what they must be."""

    def wrong(*args: Any) -> Any:
        s, low, high = right(*args)
        middle = low + (high - low) / 2
        if not low < high < float("inf"):
            return s, low, high
        return s, middle - (middle - low) / 1000, middle + (high - middle) / 1000

    return wrong


def _flipped(right: Function) -> Function:
    """The sign of what is linear in all three vertices is the other one."""

    def wrong(*args: Any) -> Any:
        s, low, high = right(*args)
        return -s, low, high

    return wrong


def _swapped(right: Function) -> Function:
    """Of two vertices with equal x for ever the lower one is taken for the left one."""

    def wrong(a: Any, b: Any) -> Iterator[Any]:
        dx, dy, *offsets = right(a, b)
        return iter([dx, negate(dy), *offsets])

    return wrong


def _unguarded(right: Function) -> Function:
    """Filters take coordinates for exact that are rounded."""

    def wrong(self: Certifier, *args: Any, **kwargs: Any) -> None:
        right(self, *args, **kwargs)
        self.errors = [0.0] * len(self.errors)

    return wrong


PLANTED: Final[dict[str, Callable[[], Any]]] = {
    "sign before for sign after": lambda: _replaced(
        Certifier, "_exact_orientation", _sign_at_a_root
    ),
    "sign of a certificate flipped": lambda: _replaced(coefficients, "_three", _flipped),
    "events dropped": lambda: _replaced(EventQueue, "schedule", _events_dropped),
    "equal times not equal": lambda: _replaced(EventQueue, "_compare", _order_of_ties),
    "even roots ignored": lambda: _replaced(certifier, "roots_after", _even_roots),
    "even zeros of copies ignored": lambda: _replaced(
        Certifier, "_exact_orientation", _even_zeros_of_copies
    ),
    "contact proof skipped": lambda: _replaced(engine, "may_touch", _always(False)),
    "straight chains not followed": lambda: _replaced(CertifiedMesh, "_is_flat", _always(False)),
    "vertex on vertex ignored": lambda: _replaced(incidences, "coincide", _no_meetings),
    "the wrong diagonal gives way": lambda: _replaced(Repairs, "_repair_bend", _wrong_diagonal),
    "pieces not certified anew": lambda: _replaced(CertifiedMesh, "certify_body", _always([])),
    "rigid by mistake": lambda: _replaced(Certifier, "rigid", _rigid_if_one_velocity),
    "order of ties swapped": lambda: _replaced(perturbation, "x_order_terms", _swapped),
    "containment at the start missed": lambda: _replaced(
        detector, "initial_touches", _first_body_only
    ),
    "x-order kept for ever": lambda: _replaced(Certifier, "keeps_x_order", _always(True)),
    "root enclosures too narrow": lambda: _replaced(filters, "linear", _narrow),
    "filter bound too small": lambda: _replaced(Certifier, "__init__", _unguarded),
    "vertical bitangents ignored": lambda: _replaced(
        VerticalRules, "repair", lambda right: lambda self: self.cells.violated.clear()
    ),
}
"""The mistakes: each gives a context in which it is made."""


@dataclass(frozen=True, slots=True)
class Found:
    """How a planted bug was found.

    Attributes:
        bug: its name.
        failure: what a witness objected to; None if it escaped.
        family: where.
        scenes: how many scenes that took.
        seconds: and how long.
    """

    bug: str
    failure: Failure | None
    family: str
    scenes: int
    seconds: float


def hunt(bug: str, most: int = 400, witnesses: Sequence[str] = WITNESSES, seed: int = 0) -> Found:
    """Look for a planted bug in the scenes of a campaign, at most so many.

    Raises:
        InputError: if the package is compiled: then nothing can be planted.
    """
    if not filters.__file__.endswith(".py"):
        raise InputError("mistakes are planted in the plain package only: make plain")
    began = clock.perf_counter()
    families = list(FAMILIES)
    for number in range(most):
        family = families[number % len(families)]
        scene = generate(family, seed + number // len(families))
        with PLANTED[bug]():
            for witness in witnesses:
                failure = failure_of(witness, scene, number, patience=10.0)
                if failure is not None:
                    return Found(bug, failure, family, number + 1, clock.perf_counter() - began)
    return Found(bug, None, "", most, clock.perf_counter() - began)


def table(found: Sequence[Found]) -> list[str]:
    """A line for each planted bug."""
    lines = [f"{'planted bug':34}{'scenes':>7}{'seconds':>9}  found by"]
    for f in found:
        by = f"{f.failure.witness}, {f.family}: {f.failure.signature}" if f.failure else "NOTHING"
        lines.append(f"{f.bug:34}{f.scenes:>7}{f.seconds:>9.1f}  {by}")
    return lines
