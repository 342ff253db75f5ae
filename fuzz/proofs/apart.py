"""Certificates that bodies stay apart, of all families, and wrong ones, by both checkers."""

from __future__ import annotations

import hashlib
import json
import time
from collections.abc import Callable
from dataclasses import dataclass
from fractions import Fraction
from itertools import combinations
from pathlib import Path
from random import Random
from typing import Final

from exactpt import check_apart, first_contact, proof_scene
from exactpt.errors import BudgetExceeded, InputError
from exactpt.kernel.algebraic import AlgebraicNumber
from exactpt.kernel.numbers import rational
from exactpt.proof import Proof, certificate_of, certify
from exactpt.scene.scene import Scene, scene_of
from exactpt.testing import reference
from exactpt.testing.scenes import EVERY, generate
from fuzz.campaign import Check, Counts, Finding, Item, Result, Step, Tell
from fuzz.limits import TooSlow, limit
from fuzz.proofs.checking import checker

__all__ = ["KINDS", "Apart", "is_true", "tampered", "verdict"]

PATIENCE: Final = 120.0
MANY: Final = 10
"""Number of wrong certificates of each right one."""
BUCKETS: Final = (1, 2, 3, 4, 5, 6, 8, 10, 15, 20, 50, 1000)
"""Bounds of the time of a certificate, in times of the search."""
CODES: Final = {"accepted": 0, "rejected": 1, "no proof": 2, "not decided": 4}

Lines = list[str]
Mutant = tuple[bytes, Lines]


def verdict(scene: bytes, certificate: bytes) -> tuple[int, str]:
    """Return the exit code and the line of the checker in Python."""
    try:
        return 0, str(check_apart.check(scene, certificate))
    except proof_scene.Rejected as rejected:
        return 1, str(rejected)
    except proof_scene.NoProofError as refused:
        return 2, str(refused)
    except proof_scene.Exhausted as exhausted:
        return 4, str(exhausted)


def is_true(scene: Scene, lines: Lines) -> bool:
    """Return True if a certificate that has been accepted is true by the all-pairs reference."""
    rows = [line.split() for line in lines if line]
    start, until = (rational(word) for word in rows[2][1:])
    far = sum((Fraction(row[1]) for row in rows if row[0] == "distance"), Fraction(0))
    groups = [{int(w) for w in row[1:]} for row in rows if row[0] == "ignoring"]
    named = [{int(w) for w in row[1:]} for row in rows if row[0] == "between"]
    high = None if rows[-1] == ["none"] else rational(rows[-1][-3])
    bodies = [body.with_radius(body.radius + far / 2) for body in scene.bodies]
    end = max(until if high is None else high, start + (scene.exact_end - scene.exact_start) / 1000)
    first: AlgebraicNumber | None = None
    for i, j in combinations(range(len(bodies)), 2):
        if any({i, j} <= group for group in groups) or (named and {i, j} not in named):
            continue
        two = scene_of((bodies[i], bodies[j]), start, end)
        found = reference.first_contact(two, between=[(bodies[i].name, bodies[j].name)])
        if found is not None and (first is None or found.time < first):
            first = found.time
    if high is None:
        return first is None or first > until
    return first is not None and first <= high and (first > until or high == start)


# Wrong certificates.


def _numbers(line: str, by: Callable[[Fraction], Fraction], k: int) -> str:
    """Return a line with one of its numbers changed."""
    words = line.split()
    words[k] = str(by(Fraction(words[k])))
    return " ".join(words)


def _node(lines: Lines, random: Random, kinds: str) -> int:
    """Return the index of a node of these kinds."""
    return random.choice([k for k, line in enumerate(lines) if line.split()[0] in kinds])


def _step(random: Random) -> Fraction:
    return Fraction(random.choice((-1, 1)), random.choice((1, 2, 10, 1000, 10**6)))


def _line_moved(scene: bytes, lines: Lines, random: Random) -> Mutant:
    k, step = _node(lines, random, "c"), _step(random)
    return scene, [*lines[:k], _numbers(lines[k], lambda c: c + step, 3), *lines[k + 1 :]]


def _line_turned(scene: bytes, lines: Lines, random: Random) -> Mutant:
    k, by = _node(lines, random, "c"), random.choice((-1, 0, 2))
    turned = _numbers(lines[k], lambda x: x * by + (by == 2), random.choice((1, 2)))
    return scene, [*lines[:k], turned, *lines[k + 1 :]]


def _line_in_motion(scene: bytes, lines: Lines, random: Random) -> Mutant:
    k, step = _node(lines, random, "c"), _step(random)
    line = lines[k] if lines[k].count(" ") == 4 else f"{lines[k]} 0"
    return scene, [*lines[:k], _numbers(line, lambda v: v + step, 4), *lines[k + 1 :]]


def _time_moved(scene: bytes, lines: Lines, random: Random) -> Mutant:
    k = _node(lines, random, "t")
    times = [Fraction(w) for w in lines[2].split()[1:]]
    q = times[0] + (times[1] - times[0]) * Fraction(random.randrange(-2, 13), 10)
    return scene, [*lines[:k], f"t {q}", *lines[k + 1 :]]


def _node_left_out(scene: bytes, lines: Lines, random: Random) -> Mutant:
    k = _node(lines, random, "cts")
    return scene, [*lines[:k], *lines[k + 1 :]]


def _node_doubled(scene: bytes, lines: Lines, random: Random) -> Mutant:
    k, j = _node(lines, random, "cts"), _node(lines, random, "cts")
    return scene, [*lines[:k], lines[j], *lines[k:]]


def _nodes_swapped(scene: bytes, lines: Lines, random: Random) -> Mutant:
    k, j = _node(lines, random, "cts"), _node(lines, random, "cts")
    made = list(lines)
    made[k], made[j] = made[j], made[k]
    return scene, made


def _later(scene: bytes, lines: Lines, random: Random) -> Mutant:
    data = json.loads(scene)
    start, end = (Fraction(str(t)) for t in data["time"])
    row = lines[2].split()
    until = min(end, Fraction(row[2]) + (end - start) / random.choice((1, 2, 10, 1000, 10**6)))
    last = lines[-1] if until < end and random.random() < 0.5 else "none"
    return scene, [*lines[:2], f"span {row[1]} {until}", *lines[3:-1], last]


def _another_end(scene: bytes, lines: Lines, random: Random) -> Mutant:
    row, low = lines[-1].split(), Fraction(lines[2].split()[2])
    high = Fraction(row[-3])
    if random.random() < 0.5:
        row[-3] = str(low + (high - low) * Fraction(random.randrange(1, 20), 10))
    else:
        row[-1] = str(int(row[-1]) + random.choice((-1, 1)))
    return scene, [*lines[:-1], " ".join(row)]


def _distance(scene: bytes, lines: Lines, random: Random) -> Mutant:
    kept = [line for line in lines if not line.startswith("distance")]
    k = next(k for k, line in enumerate(kept) if line.split()[0] in ("c", "t", "s", "none", "meet"))
    return scene, [*kept[:k], f"distance 1/{random.choice((1, 10, 1000))}", *kept[k:]]


def _body_moved(scene: bytes, lines: Lines, random: Random) -> Mutant:
    data = json.loads(scene)
    body = random.choice(data["bodies"])
    if random.random() < 0.3:
        body["radius"] = str(Fraction(str(body.get("radius", 0))) + abs(_step(random)))
    elif "keyframes" in body:
        point = random.choice(random.choice(body["keyframes"])["vertices"])
        point[random.randrange(2)] = str(Fraction(str(point[0])) + _step(random))
    else:
        part = random.choice(body["parts"]) if "parts" in body else body
        point = random.choice(part["vertices"])
        k = random.randrange(2) if isinstance(point, list) else None
        if k is not None:
            point[k] = str(Fraction(str(point[k])) + _step(random))
    changed = json.dumps(data).encode()
    digest = hashlib.sha256(changed).hexdigest()
    return changed, [lines[0], f"scene sha256 {digest}", *lines[2:]]


def _pair_forgotten(scene: bytes, lines: Lines, _random: Random) -> Mutant:
    """The certificate of an emitter that does not see two bodies that touch."""
    given = Scene.from_json(json.loads(scene))
    found = first_contact(given, method="pairs")
    if found is None or found.kind == "self":
        raise ValueError
    pairs = {(p.body, p.other) for p in found.pairs if p.body != p.other} | set(found.initial_pairs)
    alone = certify(given, ignoring=[min(pairs)]) if len(pairs) == 1 else None
    if alone is None:
        raise ValueError
    kept = [line for line in alone.text.decode().splitlines() if not line.startswith("ignoring")]
    return scene, [kept[0], lines[1], *kept[2:]]


KINDS: Final[dict[str, Callable[[bytes, Lines, Random], Mutant]]] = {
    "a line moved": _line_moved,
    "a line turned": _line_turned,
    "a line in motion": _line_in_motion,
    "a time moved": _time_moved,
    "a node left out": _node_left_out,
    "a node doubled": _node_doubled,
    "nodes swapped": _nodes_swapped,
    "a later L": _later,
    "another last line": _another_end,
    "a distance": _distance,
    "a body moved": _body_moved,
    "a pair forgotten": _pair_forgotten,
}


def tampered(proof: Proof, kind: str, random: Random) -> Mutant | None:
    """Return a scene and the lines of a wrong certificate; None if there is none of this kind."""
    lines = proof.text.decode().splitlines()
    try:
        made = KINDS[kind](proof.scene, lines, random)
    except (IndexError, ValueError, StopIteration, InputError, BudgetExceeded, ZeroDivisionError):
        return None
    return None if made == (proof.scene, lines) else made


@dataclass(frozen=True)
class Apart(Check):
    """The check of certificates: a family in turn, with consecutive seeds.

    Attributes:
        seed: the first seed.
        keep: folder for the findings.
    """

    seed: int
    keep: Path
    name = "certificates"

    @property
    def about(self) -> object:
        """The seed."""
        return self.seed

    def run(self, item: Item, tell: Tell, ends: float | None) -> Result:
        """Write a certificate, have it verified, and wrong ones."""
        number, families = item.numbers.start, sorted(EVERY)
        family, seed = families[number % len(families)], self.seed + number // len(families)
        counts, findings = Counts(), list[Finding]()
        slow = Finding(family, "hangs", str(self.keep / f"{family}.{seed}"))
        try:
            with limit(PATIENCE, ends):
                tell(Step(PATIENCE, slow))
                self._look(family, seed, counts, findings)
        except TooSlow:
            if counts[family, "accepted"]:  # the reference, about a wrong one that is accepted
                counts[family, "not compared to the end"] = 1
            else:
                findings.append(slow)
        return Result(counts, findings)

    def _look(self, family: str, seed: int, counts: Counts, findings: list[Finding]) -> None:
        """Add the results for one scene."""
        path = self.keep / f"{family}.{seed}"
        scene = generate(family, seed)
        began = time.thread_time()
        contact = first_contact(scene, method="pairs")
        searched = time.thread_time()
        try:
            proof = certificate_of(scene, contact)
        except InputError as error:
            counts[family, "refused before any work"] = 1
            counts["reason", str(error)[:60]] = 1
            return
        except BudgetExceeded as error:
            counts[family, "out of budget"] = 1
            counts["reason", str(error)[:60]] = 1
            return
        found = verdict(proof.scene, proof.text)
        spent = (time.thread_time() - searched) / max(searched - began, 1e-9)
        counts["cost", f"at most {next((b for b in BUCKETS if spent <= b), 10**6)}"] = 1
        items = sum(len(body.edges) or 1 for body in scene.bodies)
        counts["size", "bytes"], counts["size", "edges"] = len(proof.text), items
        each = next(b for b in (20, 50, 100, 10**9) if len(proof.text) < b * items)
        counts["bytes an edge", f"below {each}"] = 1
        counts[family, "accepted"] = 1
        if found[0] or not self._agree(found, proof.scene, proof.text):
            findings.append(self._finding(family, path, proof.scene, proof.text, found))
        random = Random(f"apart:{family}:{seed}")
        for k, kind in enumerate(random.sample(sorted(KINDS), MANY)):
            made = tampered(proof, kind, random)
            if made is None:
                continue
            text = "".join(f"{line}\n" for line in made[1]).encode()
            found = verdict(made[0], text)
            said = ("accepted", "rejected", "no scene", "", "not decided")[found[0]]
            counts[kind, said] += 1
            wrong = not self._agree(found, made[0], text)
            if found[0] == 0:
                wrong |= not is_true(Scene.from_json(json.loads(made[0])), made[1])
            if wrong:
                where = path.with_name(f"{path.name}.{k}")
                findings.append(self._finding(kind, where, made[0], text, found))

    def _agree(self, found: tuple[int, str], scene: bytes, text: bytes) -> bool:
        """Return True if the checker in C++ has the same exit code, and the same statement."""
        line = checker().verdict(scene, text)
        return CODES[line.split(": ")[0]] == found[0] and (found[0] != 0 or line == found[1])

    def _finding(
        self, row: str, path: Path, scene: bytes, text: bytes, found: tuple[int, str]
    ) -> Finding:
        names = [path.with_name(path.name + end) for end in (".apart.scene.json", ".apart")]
        files = dict(zip(names, (scene, text), strict=True))
        return Finding(row, "false or in disagreement", f"{path}: {found[1]!a:.150}", files)

    def table(self, counts: Counts) -> list[str]:
        """One line for each row."""
        rows: dict[str, list[str]] = {}
        for (row, column), n in sorted(counts.items()):
            rows.setdefault(row, []).append(f"{n:,.0f} {column}")
        return [f"{row}: {', '.join(found)}" for row, found in sorted(rows.items())]
