"""Campaigns of mutants: each is rejected, or true by the all-pairs reference."""

from __future__ import annotations

import hashlib
import json
import re
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from fractions import Fraction
from functools import partial
from pathlib import Path
from random import Random
from typing import Final, NamedTuple

from exactpt import InputError, Scene, prove
from exactpt.scene.format import loads
from exactpt.scene.written import scene_bytes
from exactpt.testing import reference
from exactpt.testing.scenes import families, generate
from exactpt.tiling.start import tilings_for
from fuzz.campaign import Check, Counts, Finding, Item, Result, Step, Tell
from fuzz.limits import limit
from fuzz.proofs.checking import checker, is_geometric
from fuzz.proofs.texts import TEXTS
from fuzz.proofs.wrong import wheel, wrong_splice

__all__ = ["KINDS", "Mutant", "Mutants", "is_true", "mutants"]

ROUND: Final = 600.0
"""Seconds in which the mutants of a round are made and verified."""

PER_SCENE: Final = 3
"""Number of mutants of a kind that a proof gets."""

OTHER: Final = "another scene's vertices"
WHEEL: Final = "wheel wound twice"
SPLICED: Final = "spliced at a contact"
PLANTED: Final = "contact planted at an event"

TIME: Final = re.compile(
    r" first contact at T = ((?P<at>[-0-9/]+)|[^:]* in \[(?P<low>[-0-9/]+), (?P<high>[-0-9/]+)\]):"
    r"| contact at the start t = (?P<start>[-0-9/]+):"
)
"""The time of a contact in the statement that is proved."""

KINDS: Final = (*TEXTS, OTHER, WHEEL, SPLICED, PLANTED)
"""The kinds of mutants."""


class Mutant(NamedTuple):
    """A proof that ought not to be.

    Attributes:
        kind: one of `KINDS`.
        scene: the bytes of the scene's file.
        proof: the bytes of the proof.
    """

    kind: str
    scene: bytes
    proof: bytes


@dataclass(frozen=True)
class Mutants(Check):
    """The check of mutants, in rounds: case n has those of one proof, and others.

    Attributes:
        most: number of mutants of a kind.
        past: number of mutants of a kind that reading and map do not reject.
        keep: folder for mutants that are accepted and not true.
    """

    most: int
    past: int
    keep: Path
    name = "proof-mutants"

    def wanted(self, counts: Counts) -> frozenset[str]:
        """Return the kinds of which there are not enough."""
        return frozenset(
            kind for kind in KINDS
            if counts[kind, "mutants"] < self.most or counts[kind, "past"] < self.past
        )  # fmt: skip

    def run(self, item: Item, tell: Tell, ends: float | None) -> Result:
        """Have the mutants of a round verified."""
        number, counts = item.numbers.start, Counts()
        findings = []
        with limit(ROUND, ends):
            for i, mutant in enumerate(mutants(number, set(item.wanted or KINDS))):
                path = self.keep / f"{mutant.kind} {number}.{i}"
                files = {path.with_name(f"{path.name}.scene.json"): mutant.scene,
                         path.with_name(f"{path.name}.proof"): mutant.proof}  # fmt: skip
                finding = Finding(mutant.kind, "hangs", str(path), files)
                tell(Step(ROUND, finding))
                answer = checker().verdict(mutant.scene, mutant.proof)
                is_accepted = answer.startswith("accepted: ")
                counts[mutant.kind, "mutants"] += 1
                counts[mutant.kind, "past"] += is_accepted or is_geometric(answer)
                if is_accepted and is_true(mutant, answer):
                    counts[mutant.kind, "true"] += 1
                elif is_accepted:
                    why = f"accepted, and not true: {path}"
                    findings.append(finding._replace(signature="accepted", why=why))
        return Result(counts, findings)

    def table(self, counts: Counts) -> list[str]:
        """One line for each kind, and the sum."""
        lines = [f"{'mutants of proofs':30}{'all':>9}{'past the map':>14}{'true':>7}"]
        rows = {kind: [counts[kind, c] for c in ("mutants", "past", "true")] for kind in KINDS}
        total = [sum(column) for column in zip(*rows.values(), strict=True)]
        for kind, (made, past, true) in {**rows, "all": total}.items():
            lines.append(f"{kind:30}{made:>9}{past:>14}{true:>7}")
        return lines


def mutants(number: int, kinds: set[str]) -> Iterator[Mutant]:
    """The mutants of a round: those of one proof, and others."""
    random = Random(f"mutants:{number}")
    names = [*families("convex", "simple", "points", "rings")]
    scene = generate(names[number % len(names)], 100_000 + number // len(names))
    texts = [kind for kind in (*TEXTS, OTHER) if kind in kinds]
    if texts:
        _, file, proof = prove(scene, tiling=random.choice(tilings_for(scene)))
        lines = proof.decode().splitlines()
        for kind in texts:
            for _ in range(PER_SCENE):
                made = _moved(file, lines, random) if kind == OTHER else TEXTS[kind](lines, random)
                if isinstance(made, list):
                    made = file, made
                if made is not None and made[1] != lines:
                    yield Mutant(kind, made[0], _text(made[1]))
    others: dict[str, Callable[[Random], tuple[Scene, list[str]] | None]] = {
        WHEEL: wheel,
        SPLICED: partial(wrong_splice, with_event=False),
        PLANTED: partial(wrong_splice, with_event=True),
    }
    for kind, make in others.items():
        for _ in range(PER_SCENE if kind in kinds else 0):
            wrong = make(random)
            if wrong is not None:
                yield Mutant(kind, scene_bytes(wrong[0]), _text(wrong[1]))


def _text(lines: list[str]) -> bytes:
    return ("\n".join(lines) + "\n").encode()


def _moved(file: bytes, lines: list[str], random: Random) -> tuple[bytes, list[str]] | None:
    """The scene with a vertex at rest in its body elsewhere, and the proof made out to it."""
    data = json.loads(file)
    bodies = [body for body in data["bodies"] if isinstance(body.get("vertices", [{}])[0], list)]
    if not bodies:
        return None
    vertices = random.choice(bodies)["vertices"]
    plain = [k for k, v in enumerate(vertices) if isinstance(v, list)]
    k, size = random.choice(plain), random.choice([1, 10, 100])
    vertices[k] = [
        str(Fraction(c) + Fraction(random.randint(-99, 99), 99) * size) for c in vertices[k]
    ]
    other = json.dumps(data).encode()
    return other, [lines[0], f"scene sha256 {hashlib.sha256(other).hexdigest()}", *lines[2:]]


def is_true(mutant: Mutant, answer: str) -> bool:
    """Return True if an accepted statement is right by the reference, incidences included."""
    try:
        scene = loads(mutant.scene.decode())
    except InputError:
        return False  # what is no scene has to be refused
    last = mutant.proof.decode().splitlines()[2].split()[2]
    contact = reference.first_contact(scene.until(last))
    if " no contact in [" in answer:
        return contact is None
    time = TIME.search(answer)
    if contact is None or time is None:
        return False
    low, high = (Fraction(time[k] or time["at"] or time["start"]) for k in ("low", "high"))
    is_then = contact.time.compare_rational(low) >= 0 >= contact.time.compare_rational(high)
    at = {body.name: i for i, body in enumerate(scene.bodies)}
    pairs = sorted(
        f"b{at[p.body]}.{p.vertex} on edge b{at[p.other]}.{p.edge}"
        if p.edge is not None
        else f"b{at[p.body]}.{p.vertex} at b{at[p.other]}.{p.other_vertex}"
        for p in contact.incidences
    )
    if time["start"] is not None:
        return is_then and contact.kind == "initial"
    said = answer.split(": incidences exactly ")[1].split(" (", maxsplit=1)[0]
    return is_then and sorted(said.split(", ")) == pairs
