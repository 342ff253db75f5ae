"""Both checkers of proofs on damaged proofs and scenes: one exit code, and one statement."""

from __future__ import annotations

import hashlib
import json
import re
from collections.abc import Iterator
from dataclasses import dataclass
from fractions import Fraction
from functools import cache
from pathlib import Path
from random import Random
from typing import Any, Final

from exactpt import Body, InputError, PosePath, Scene, proof_check, proof_scene, prove
from exactpt.testing.scenes import families, generate
from fuzz.campaign import Check, Counts, Finding, Item, Result, Step, Tell
from fuzz.limits import limit
from fuzz.proofs.checking import checker
from fuzz.proofs.texts import TEXTS

__all__ = ["Both", "damaged", "verdicts"]

PATIENCE: Final = 300.0
"""Seconds in which a proof is made and verified."""

CHARACTERS: Final = '0123456789-+/eE."[]{},:null \\u0\x00\t@=#'
VALUES: Final[list[Any]] = [
    *(None, True, 0, "0", [], {}, "1/2", "x", -1, [0], [0, 1], ["0", "1"], {"x": [1]}),
    *({"pieces": []}, {"pieces": [{"motion": {}}]}, {"rigid": {"half_turn": [0, 1]}}),
    *({"affine": {"matrix": [[[1], [0]], [[0], [1]]]}}, {"omega": 1, "error": 1}, 1e400, "1e9999"),
]
WORDS: Final = [
    "0",
    "1",
    "-1",
    "1/2",
    "2",
    "3",
    "7",
    "@",
    "-",
    "+",
    "=",
    "1/0",
    "999",
    "edge",
    "vertex",
    "inside",
]
AT_START: Final = ["contact -1 2 0 1 {}", "contact 0 0 {}", "contact -1 1 0 0 1 {}"]
CLAIMS: Final = "vertex {} inside {}|vertex {} vertex {}|edge 0 1 edge {} {}|vertex {} edge 0 {}"
KEYS: Final = [
    "name",
    "motion",
    "closed",
    "holes",
    "parts",
    "keyframes",
    "x",
    "y",
    "radius",
    "spin",
    "path",
    "spline",
    "assumed_angle_error",
    "until",
    "vertices",
]
SCENES: Final = 150
PATHS: Final = 15
"""The numbers of scenes from which proofs are made, and of those with a path among them."""
MAX_LINES: Final = 120
SHORT: Final = 6
"""Right proofs of n lines are taken with a probability of SHORT / n, so in equal time each."""
CODES: Final = {"accepted": 0, "rejected": 1, "no proof": 2, "not decided": 4}


def along_paths(number: int) -> Scene:
    """Return a scene of two triangles along random paths of two poses, beside a square at rest."""
    random = Random(f"paths:{number}")

    def few(size: int) -> Fraction:
        return Fraction(random.randint(-size, size), 2)

    bodies = [Body("rest", [(9, 0), (11, 0), (11, 2), (9, 2)])]
    for i in (0, 1):
        x, y, angle = ([few(4) + 5 * i, few(2)], [few(4), few(2), few(1)], [few(2), few(3)])
        ends = [sum(f) for f in (x, y, angle)]  # after a unit of time
        later = [[end, few(2)] for end in ends]
        triangle = [(few(3) - 2, few(1) - 1), (few(1) + 2, few(1) - 1), (few(1), few(1) + 2)]
        error = Fraction(1, random.choice((20, 1000)))
        place_error = Fraction(random.choice((0, 0, 1)), 50)
        path = PosePath([0, 1, 2], [(x, y, angle), later], error=error, place_error=place_error)
        bodies.append(Body(f"p{i}", triangle, path))
    return Scene(bodies, (0, 2))


@cache
def base(number: int) -> tuple[bytes, tuple[str, ...]] | None:
    """The scene and the lines of a right proof; None if it is long."""
    names = [*families("convex", "simple", "points", "rings", "spinning")]
    name, seed = names[number % len(names)], 1 + number // len(names)
    scene = along_paths(number) if number >= SCENES - PATHS else generate(name, seed)
    if sum(body.size for body in scene.bodies) > 70:
        return None
    try:
        proved = prove(scene, tiling=("lazy", "greedy", "mixed")[number % 3])
    except InputError:  # bodies with a radius
        return None
    lines = proved.text.decode().splitlines()
    return (proved.scene, tuple(lines)) if len(lines) <= MAX_LINES else None


def damaged(seed: int, number: int) -> tuple[bytes, bytes] | None:
    """Return a scene and a proof, of which at least one is damaged; None for most long proofs."""
    random = Random(f"both:{seed}:{number}")
    right = base(random.randrange(SCENES))
    if right is None or random.random() * len(right[1]) > SHORT:  # long ones take most time
        return None
    scene, lines = right[0], list(right[1])
    sort = random.random()
    if sort < 0.4:
        scene = _scene(scene, random)
    if sort > 0.3:
        for _ in range(random.choice((1, 1, 2))):
            lines = _lines(lines, random)
    if len(lines) > 1 and random.random() < 0.995:
        lines[1] = f"scene sha256 {hashlib.sha256(scene).hexdigest()}"
    return scene, ("\n".join(lines) + "\n").encode("utf-8", "surrogatepass")


def _lines(lines: list[str], random: Random) -> list[str]:
    """The lines with one damage."""
    kind = random.randrange(8)
    if len(lines) < 4:
        return lines
    i = random.randrange(2, len(lines))
    words = lines[i].split()
    k = random.randrange(len(words) or 1)
    if kind == 0 and words:
        number = re.fullmatch(r"(-?\d+)(/\d+)?", words[k])
        step = int(number[1]) + random.choice((-2, -1, 1, 2)) if number else 0
        words[k] = f"{step}{number[2] or ''}" if number else random.choice(WORDS)
    elif kind == 1 and words:
        words[k : k + 1] = random.choice(([], [words[k]] * 2, [random.choice(WORDS)]))
    elif kind == 2:
        j = random.randrange(len(lines[i]) + 1)
        line = lines[i][:j] + random.choice(CHARACTERS) + lines[i][j + random.randrange(2) :]
        return [*lines[:i], line, *lines[i + 1 :]]
    elif kind == 3:
        claim = random.choice(CLAIMS.split("|")).format(random.randrange(9), random.randrange(9))
        last = random.choice(("none", random.choice(AT_START).format(claim)))
        return [*(lines[:3] if random.random() < 0.7 else lines[:-1]), last]
    elif kind == 4 and words[:1] in (["event"], ["contact"]):
        words = _another_name(words, random)
    elif kind == 5:
        start, end = lines[2].split()[1:3] if lines[2].count(" ") == 2 else ("0", "1")
        part = Fraction(random.choice((1, 5, 9, 11)), 10)
        words, i = ["span", start, _scaled(end, part)], 2
    else:
        try:
            made = TEXTS[random.choice(sorted(TEXTS))](lines, random)
        except (ValueError, IndexError, KeyError, ZeroDivisionError):
            return lines  # they take a proof that is in the format
        return lines if made is None or not isinstance(made, list) else made
    return [*lines[:i], " ".join(words), *lines[i + 1 :]]


def _scaled(word: str, by: Fraction) -> str:
    try:
        return str(Fraction(word) * by)
    except (ValueError, ZeroDivisionError):
        return word


def _another_name(words: list[str], random: Random) -> list[str]:
    """A rational time by a polynomial with further factors, or another interval."""
    try:
        low, high = Fraction(words[1]), Fraction(words[2])
    except (ValueError, IndexError, ZeroDivisionError):
        return words
    by = Fraction(1, random.choice((1, 3, 10, 1000, 10**9)))
    if low < high or (len(words) > 3 and re.fullmatch(r"@|-?\d+", words[3])):
        low, high = low - by * random.randrange(3), high + by * random.randrange(3)
        return [words[0], str(low), str(high), *words[3:]]
    f = [-low.numerator, low.denominator]
    for _ in range(random.randrange(3)):
        g = random.choice((f[:2], [random.randrange(-9, 9), random.randrange(1, 9)], [1, 0, 1]))
        product = [0] * (len(f) + len(g) - 1)
        for a, x in enumerate(f):
            for b, y in enumerate(g):
                product[a + b] += x * y
        f = product
    low, high = low - by * random.randrange(2), high + by * random.randrange(2)
    return [words[0], str(low), str(high), *map(str, f), *words[3:]]


def _scene(scene: bytes, random: Random) -> bytes:
    """The scene with one damage."""
    if random.random() < 0.3:
        text = scene.decode()
        j = random.randrange(len(text))
        text = text[:j] + random.choice(CHARACTERS) + text[j + random.randrange(2) :]
        return text.encode("utf-8", "surrogatepass")
    data = json.loads(scene)
    holder, key = random.choice(list(_places(data)))
    kind = random.randrange(5)
    if kind == 0:
        holder[key] = random.choice(VALUES)
    elif kind == 1 and isinstance(holder, list):
        holder.insert(key, holder[key])
    elif kind == 1:
        holder[random.choice(KEYS)] = random.choice(VALUES)
    elif kind == 2:
        del holder[key]
    elif isinstance(holder[key], str) and key != "name":
        holder[key] = _scaled(holder[key], Fraction(random.choice((-1, 2, 8)), 7))
    return json.dumps(data).encode()


def _places(data: Any) -> Iterator[tuple[Any, Any]]:  # noqa: ANN401 - of JSON
    for key in data if isinstance(data, dict) else range(len(data)):
        yield data, key
        if isinstance(data[key], (dict, list)):
            yield from _places(data[key])


def verdicts(scene: bytes, proof: bytes) -> tuple[tuple[int, str], tuple[int, str]]:
    """The exit code and the line of the checker in Python, and those of the one in C++."""
    try:
        by_python = 0, str(proof_check.check(scene, proof))
    except proof_scene.Rejected as rejected:
        by_python = 1, str(rejected)
    except proof_scene.NoProofError as refused:
        by_python = 2, str(refused)
    except proof_scene.Exhausted as exhausted:
        by_python = 4, str(exhausted)
    line = checker().verdict(scene, proof)
    return by_python, (CODES[line.split(": ")[0]], line)


@dataclass(frozen=True)
class Both(Check):
    """The check of damaged proofs by both checkers.

    Attributes:
        most: number of proofs.
        seed: seed of all of them.
        keep: folder for those about which the checkers disagree.
    """

    most: int
    seed: int
    keep: Path
    name = "proof-both"

    @property
    def about(self) -> object:
        """The seed."""
        return self.seed

    def wanted(self, counts: Counts) -> frozenset[str] | None:
        """Return nothing if there are enough proofs."""
        made = sum(n for (_, column), n in counts.items() if column == "proofs")
        return None if made < self.most else frozenset()

    def run(self, item: Item, tell: Tell, ends: float | None) -> Result:
        """Have a proof verified, if there is one with this number."""
        number = item.numbers.start
        with limit(PATIENCE, ends):
            made = damaged(self.seed, number)
            if made is None:
                return Result(Counts())
            path = self.keep / f"{self.seed}.{number}"
            names = [path.with_name(path.name + end) for end in (".scene.json", ".proof")]
            finding = Finding("", "hangs", str(path), dict(zip(names, made, strict=True)))
            tell(Step(PATIENCE, finding))
            one, other = verdicts(*made)
        counts = Counts({(f"exit code {one[0]}", "proofs"): 1})
        if one[0] == other[0] and (one[0] != 0 or one[1] == other[1]):
            return Result(counts)
        if 4 in (one[0], other[0]):  # not decided: each counts its work in its own way
            return Result(counts)
        why = f"{path}: {one[1]!a:.150}\n  {other[1]!a:.150}"
        return Result(counts, [finding._replace(signature="disagreement", why=why)])

    def table(self, counts: Counts) -> list[str]:
        """One line for each exit code."""
        rows = sorted((row, n) for (row, column), n in counts.items() if column == "proofs")
        return [f"{row}: {n:,} proofs" for row, n in rows]
