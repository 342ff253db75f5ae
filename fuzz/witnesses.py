"""The witnesses: independent checks of a scene, each of which reports contradictions."""

from __future__ import annotations

from collections.abc import Callable
from typing import Final, TypeAlias

from exactpt import Contact, Scene, Simulation, first_contact, proof_check, proof_scene, prove
from exactpt.check import check_run
from exactpt.pair.comparison import in_words
from exactpt.scene.groups import is_tileable
from exactpt.search.first import pair_search
from exactpt.testing import reference as defined
from exactpt.testing.agreement import disagreement
from exactpt.testing.audits import run_and_audit
from exactpt.tiling.start import tilings_for
from fuzz.changes.variants import VARIANTS, difference
from fuzz.old_engine.compare import compared
from fuzz.old_engine.process import old_engine
from fuzz.proofs.checking import checker

__all__ = [
    "OLD",
    "WITNESSES",
    "Difference",
    "LeftOutError",
    "Witness",
    "check_proof",
    "contact_by",
    "tilings_of",
]

OLD: Final = "old"
"""The name of the witness that is there only if it has been built, see `fuzz.old_engine`."""

Witness: TypeAlias = Callable[[Scene, int | None], None]
"""A check of a scene; raises `Difference`, or any other exception, if it fails.

It raises `LeftOutError` if it can say nothing about the scene.

Its arguments are the scene and a turn: a number that selects one tiling and some of the
variants, so that a campaign covers more scenes in its time. None selects all of them.
"""


class Difference(Exception):  # noqa: N818 - a finding, the purpose of it all
    """Two methods have given different answers.

    Attributes:
        kind: the type of the difference, in words that do not depend on the scene's numbers.
        scene: the scene in which they differ, if the check has drawn it itself.
    """

    def __init__(self, kind: str, detail: str = "", scene: Scene | None = None) -> None:
        super().__init__(f"{kind}: {detail}" if detail else kind)
        self.kind = kind
        self.scene = scene


class LeftOutError(Exception):
    """A witness can say nothing about a scene, which is counted."""


def reference(scene: Scene, turn: int | None) -> None:  # noqa: ARG001 - always all
    """The first contact is the same however it is asked for, and by definition."""
    expected = defined.first_contact(scene)
    others = tilings_of(scene) or ["exact"]
    for name in ("auto", "pairs", *others):
        if difference := disagreement(expected, contact_by(scene, name)):
            raise Difference(f"{name}: {difference.what}", str(difference))


def contact_by(scene: Scene, name: str) -> Contact | None:
    """The first contact by default, by pairs, exactly by pairs, or by the tiling of a name."""
    if name == "auto":
        return first_contact(scene)
    if name in ("pairs", "exact"):
        return pair_search(scene, exact_only=name == "exact").run_to_contact()
    return first_contact(scene, tiling=name)


def static(scene: Scene, turn: int | None) -> None:
    """Between any two events the kinetic tiling equals the static one."""

    def audit(name: str) -> None:
        run_and_audit(scene, name, middle=False)

    _with_tilings(scene, audit, turn)


def filters(scene: Scene, turn: int | None) -> None:
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

    _with_tilings(scene, compare, turn)


def symmetry(scene: Scene, turn: int | None) -> None:
    """Symmetric variants of a scene have the image of its first contact."""
    contact = first_contact(scene)
    tilings = tilings_of(scene)
    stride = 1 if turn is None else 5
    for i, (name, variant) in enumerate(VARIANTS.items()):
        if turn is not None and i % stride != turn % stride:
            continue
        if name == "backwards" and (contact is not None or scene.has_radius):
            continue  # a rounded body may have closed on itself at the end
        tiling = tilings[(i + (turn or 0)) % len(tilings)] if tilings else "auto"
        found = first_contact(variant.scene(scene), tiling=tiling)
        if kind := difference(variant, scene, contact, found):
            said = f"{in_words(found)}, but the original {in_words(contact)}"
            raise Difference(f"{name}: {kind}", said)


def cgal(scene: Scene, turn: int | None) -> None:
    """CGAL accepts every tiling and every event time."""

    def check(name: str) -> None:
        report = check_run(scene, tiling=name)
        if not report.ok:
            raise Difference(f"{name}: cgal", report.failures[0])

    _with_tilings(scene, check, turn)


def proof(scene: Scene, turn: int | None) -> None:
    """The proof is accepted by the checker in C++, and in one of 17 turns by that in Python."""

    def check(name: str) -> None:
        check_proof(scene, name, in_python=turn is None or turn % 17 == 0)

    _with_tilings(scene, check, turn)


def check_proof(scene: Scene, tiling: str, *, in_python: bool) -> None:
    """Have the proof by a tiling checked by the checker in C++, and by that in Python.

    Raises:
        Difference: if it is not accepted.
    """
    proved = prove(scene, tiling=tiling)
    answer = checker().verdict(proved.scene, proved.text)
    if not answer.startswith("accepted: "):
        raise Difference(f"{tiling}: proof", answer)
    if in_python:
        try:
            proof_check.check(proved.scene, proved.text)
        except proof_scene.Rejected as rejected:
            raise Difference(f"{tiling}: proof in Python", str(rejected)) from None


def old(scene: Scene, turn: int | None) -> None:
    """Answers are those of the engine of version 0.2, byte for byte, or bounds of one time.

    Raises:
        LeftOutError: if that engine answers no question about the scene.
    """
    said = 0
    for asked in compared(scene, tilings_of(scene), turn, old_engine()):
        if asked.is_left_out:
            continue
        said += 1
        if not asked.agrees:
            kind = f"{asked.question}: {asked.new.kind}"
            raise Difference(kind, f"{asked.arguments}: {asked.new.text}, once {asked.old.text}")
    if not said:
        raise LeftOutError


WITNESSES: Final[dict[str, Witness]] = {
    "reference": reference,
    "static": static,
    "filters": filters,
    "symmetry": symmetry,
    "cgal": cgal,
    "proof": proof,
    OLD: old,
}
"""The witnesses by name."""


def tilings_of(scene: Scene) -> list[str]:
    """The tilings that must support a scene, if there are any."""
    return tilings_for(scene) if is_tileable(scene) else []


def _with_tilings(scene: Scene, check: Callable[[str], None], turn: int | None) -> None:
    """Check with each tiling, or with the one selected by ``turn``."""
    names = tilings_of(scene)
    for name in names if turn is None or not names else [names[turn % len(names)]]:
        check(name)
