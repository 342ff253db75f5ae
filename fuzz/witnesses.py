"""The witnesses: each looks at a scene in its own way, and says what contradicts what."""

from __future__ import annotations

from collections.abc import Callable
from itertools import islice
from typing import Final, TypeAlias

from exactpt.check import check_scene
from exactpt.collision.allpairs import first_contact_allpairs
from exactpt.collision.contact import Contact
from exactpt.collision.detector import first_contact
from exactpt.collision.tilings import TILINGS
from exactpt.errors import InputError
from exactpt.scene.scene import Scene
from exactpt.simulation.simulation import Simulation
from fuzz.statics import run_and_audit
from fuzz.variants import VARIANTS, difference

__all__ = ["PARTICULAR", "WITNESSES", "Difference", "Witness", "contrast"]

Witness: TypeAlias = Callable[[Scene], None]
"""Raises `Difference`, or whatever broke, if something is wrong with a scene."""


class Difference(Exception):  # noqa: N818 - what was found, the purpose of it all
    """Two ways to the same answer have led to two answers.

    Attributes:
        kind: what differs, in a few words that do not depend on the scene's numbers.
    """

    def __init__(self, kind: str, detail: str = "") -> None:
        super().__init__(f"{kind}: {detail}" if detail else kind)
        self.kind = kind


def reference(scene: Scene) -> None:
    """The first contact by every tiling is that of the all-pairs reference."""
    expected = first_contact_allpairs(scene)

    def compare(name: str) -> None:
        found = first_contact(scene, tiling=name)
        if kind := contrast(expected, found):
            said = f"{_in_words(found)}, but the reference {_in_words(expected)}"
            raise Difference(f"{name}: {kind}", said)

    _with_every_tiling(compare)


def static(scene: Scene) -> None:
    """Between any two events the kinetic tiling is the static one."""

    def audit(name: str) -> None:
        run_and_audit(scene, name, middle=False)

    _with_every_tiling(audit)


def filters(scene: Scene) -> None:
    """The event log is the same, byte for byte, with and without the float filters."""

    def compare(name: str) -> None:
        logs = [
            [event.to_json() for event in Simulation(scene, tiling=name, exact_only=exact).run()]
            for exact in (False, True)
        ]
        for i, (a, b) in enumerate(zip(*logs, strict=False)):
            if a != b:
                raise Difference(f"{name}: event", f"event {i}: {a}, exactly {b}")
        if len(logs[0]) != len(logs[1]):
            raise Difference(f"{name}: length", f"{len(logs[0])}, exactly {len(logs[1])} events")

    _with_every_tiling(compare)


def symmetry(scene: Scene) -> None:
    """Symmetric variants of a scene have the same first contact, mapped."""
    contact = first_contact(scene)
    tilings = [name for name in TILINGS if name not in PARTICULAR]
    # A large scene gets some of the variants; which, depends on its size.
    stride = 1 + scene.vertex_count // 30
    chosen = islice(enumerate(VARIANTS.items()), len(scene.bodies) % stride, None, stride)
    for i, (name, variant) in chosen:
        if name == "backwards" and contact is not None:
            continue
        found = first_contact(variant.scene(scene), tiling=tilings[i % len(tilings)])
        if kind := difference(variant, scene, contact, found):
            said = f"{_in_words(found)}, but the original {_in_words(contact)}"
            raise Difference(f"{name}: {kind}", said)


def cgal(scene: Scene) -> None:
    """CGAL accepts every tiling and every event time."""

    def check(name: str) -> None:
        report = check_scene(scene, tiling=name)
        if not report.ok:
            raise Difference(f"{name}: cgal", report.failures[0])

    _with_every_tiling(check)


PARTICULAR: Final = frozenset({"incremental"})
"""The tilings that are not for all scenes."""

WITNESSES: Final[dict[str, Witness]] = {
    "reference": reference,
    "static": static,
    "filters": filters,
    "symmetry": symmetry,
    "cgal": cgal,
}
"""The witnesses by name."""


def _with_every_tiling(check: Callable[[str], None]) -> None:
    """Check with each tiling; a refusal is a failure, but of a particular one."""
    for name in TILINGS:
        try:
            check(name)
        except InputError:
            if name not in PARTICULAR:
                raise


def contrast(expected: Contact | None, found: Contact | None) -> str | None:
    """What differs between two contacts of one scene; None: nothing."""
    if expected is None or found is None:
        if (expected is None) == (found is None):
            return None
        return "found" if expected is None else "missed"
    if found.time.compare(expected.time) != 0:
        return "time"
    for what in ("kind", "pairs", "overlaps"):
        if getattr(found, what) != getattr(expected, what):
            return what
    return None


def _in_words(contact: Contact | None) -> str:
    if contact is None:
        return "finds no contact"
    pairs = ", ".join(
        f"{p.body}:{p.vertex} on "
        + (f"{p.other}:{p.other_vertex}" if p.edge is None else f"edge {p.edge} of {p.other}")
        for p in contact.pairs[:4]
    )
    more = f" and {len(contact.pairs) - 4} more" if len(contact.pairs) > 4 else ""
    return f"finds t = {float(contact.time)!r}, {contact.kind}: {pairs}{more}"
