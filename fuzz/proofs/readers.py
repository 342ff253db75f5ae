"""The three readers of scenes on damaged scenes: all of them accept one, or all refuse it.

They are that of the package, `exactpt.proof_scene` of the checkers in Python, and that of
``cgal_check``. A checker of proofs verifies the record of a spin or a path, as the package does; a
checker of certificates reads its form alone.
"""

from __future__ import annotations

import hashlib
import json
from collections.abc import Callable, Iterator, Sequence
from copy import deepcopy
from dataclasses import dataclass
from functools import cache
from pathlib import Path
from random import Random
from tempfile import TemporaryDirectory
from typing import Any, Final

from exactpt import InputError, Scene, proof_scene
from exactpt.motion.tileable import are_tileable
from exactpt.proof.degrees import refuse_degrees
from exactpt.testing.scenes import families, generate
from fuzz.campaign import Check, Counts, Finding, Item, Result, Step, Tell
from fuzz.limits import limit
from fuzz.proofs.both import KEYS, VALUES, along_paths
from fuzz.proofs.checking import checker

__all__ = ["Readers", "damaged_scene", "disagreement", "dressed"]

PATIENCE: Final = 120.0
"""Seconds in which all readers read a scene."""
BASES: Final = 120
"""Number of scenes that are damaged."""
WITH_PATHS: Final = 20
"""Number of those with bodies along paths, which take most time."""
MAX_VERTICES: Final = 40
TABLE: Final = Path(__file__).parents[2] / "tests" / "data" / "grammar-misuse.json"

Json = Any

NUMBERS: Final[list[Json]] = ["0", 0, "1/9", 0.25, "1e-3", "-0", "-1/9", -1, "1/0", "nan", "", None]
NAMES: Final = ["a", "b0", "b*", "b", "*", "**", "", "no", "b1 ", "B0", "p*", "0*", "1", "é*"]
UNITS: Final[list[Json]] = [
    *("s", "ms", "day", "days", "S", "", " ", "mm", "a" * 32, "a" * 33, "é" * 32, "é" * 33),
    *("a\nb", "a\tb", "\x7f", "\x80", "\x9f", "\xa0", "\u2028", "\u2029", "\u200b", "😀", 1, None),
]
EPOCHS: Final[list[Json]] = [
    *("2026-01-01T00:00:00Z", "2024-02-29t23:59:59.5z", "2023-02-29T00:00:00Z", "2026-01-01"),
    *("1900-02-29T00:00:00Z", "2000-02-29 00:00:00+23:59", "0000-01-01T00:00:00Z", "0001-01-01"),
    *("9999-12-31T23:59:59-23:59", "2026-13-01T00:00:00Z", "2026-00-01T00:00:00Z", "now", 0, None),
    *("2026-01-01T24:00:00Z", "2026-01-01T00:60:00Z", "2026-01-01T00:00:60Z", "0001-01-01T00:00"),
    *("2026-01-01T00:00:00", "2026-01-01T00:00:00+24:00", "2026-01-01T00:00:00+00:60"),
    *("2026-01-01T00:00:00-00:00", "2026-01-01T00:00:00.Z", "2026-01-01T00:00:00,5Z"),
    *(f"2026-01-01T00:00:00.{'1' * digits}Z" for digits in (1, 30, 31)),
    *(
        "+2026-01-01T00:00:00Z",
        "2026-1-1T00:00:00Z",
        " 2026-01-01T00:00:00Z",
        "2026-04-31T00:00:00Z",
    ),
    *("2026-01-01T00:00:00Z\n", "٢٠٢٦-01-01T00:00:00Z", "0001-01-01T00:00:00+23:59"),
]


def _number(random: Random, _: Sequence[str]) -> Json:
    return random.choice(NUMBERS)


def _pair(random: Random, _: Sequence[str]) -> Json:
    pairs = [random.choices(NUMBERS, k=size) for size in (1, 2, 2, 2, 2, 3)]
    return random.choice([*pairs, "0", {}, None])


def _groups(random: Random, names: Sequence[str]) -> Json:
    texts = [*names, *(f"{name[:1]}*" for name in names), "*"]
    if random.random() < 0.5:
        texts += NAMES
    sizes = random.choices((0, 1, 2, 2, 3), k=random.randint(0, 3))
    groups = [random.choices(texts, k=size) for size in sizes]
    return random.choice([groups, groups, groups, groups[:1] or None, NAMES[:2], [[1, 2]], {}])


def _units(random: Random, _: Sequence[str]) -> Json:
    keys = random.sample(["length", "time", "time", "mass"], k=random.randint(0, 2))
    return random.choice(
        [{key: random.choice(UNITS) for key in keys}, {"time": "s"}, "s", [], None]
    )


def _epoch(random: Random, _: Sequence[str]) -> Json:
    return random.choice(EPOCHS)


Maker = Callable[[Random, Sequence[str]], Json]
"""Returns a value, right or wrong, for a scene whose bodies have these names."""

OF_BODIES: Final[dict[str, Maker]] = {
    "place_error": _number,
    "angle_error": _number,
    "shape_error": _pair,
    "pivot": _pair,
}
OF_SCENES: Final[dict[str, Maker]] = {"ignoring": _groups, "units": _units, "epoch": _epoch}
NEW_KEYS: Final = {**OF_BODIES, **OF_SCENES}
"""Makers of values for the keys that scenes have got last."""


def dressed(data: Json, random: Random) -> Json:
    """Return a scene with some of the new keys, with right values."""
    names = [body["name"] for body in data["bodies"]]
    for body in data["bodies"]:
        motion = body.get("motion", {})
        if random.random() < 0.4:
            body["place_error"] = "1/100"
        if random.random() < 0.4:
            body["shape_error"] = ["1/50", "0"]
        if random.random() < 0.4:
            body["angle_error"] = "1/1000"
            if not _turns(motion):
                body["pivot"] = ["1/2", "-3"]
        if "path" in motion and random.random() < 0.7:
            _give_pivot(motion, ["7/3", "-2"])
    if len(names) > 1 and random.random() < 0.6:
        data["ignoring"] = [random.sample(names, 2), random.choice((["*"], names[:2]))]
    if random.random() < 0.6:
        data["units"] = {"length": "mm", "time": "s"}
        if random.random() < 0.6:
            data["epoch"] = EPOCHS[0]
    return data


def _turns(motion: Json) -> bool:
    """Return True if a motion, or a piece of it, turns about a pivot."""
    pieces = [piece["motion"] for piece in motion.get("pieces", [])] or [motion]
    return "path" in motion or any("rigid" in piece for piece in pieces)


def _give_pivot(motion: Json, pivot: list[str]) -> None:
    """Let a path about the origin be one about a pivot: poses, half turns, x and y stay."""
    motion["path"]["pivot"] = pivot
    for piece in motion["pieces"]:
        piece["motion"]["rigid"]["pivot"] = pivot


@cache
def base(number: int) -> str:
    """Return the text of a scene, in most cases with some of the new keys; "" for a large one."""
    names = [*families("convex", "simple", "points", "rings", "spinning", "rounded")]
    name, seed = names[number % len(names)], 1 + number // len(names)
    scene = along_paths(number) if number < WITH_PATHS else generate(name, seed)
    if sum(body.size for body in scene.bodies) > MAX_VERTICES:
        return ""
    data = scene.to_json()
    random = Random(f"dressed:{number}")
    return json.dumps(dressed(data, random) if number % 6 else data)


@cache
def of_table() -> list[str]:
    """Return the texts of the scenes that test the new keys, right ones and wrong ones."""
    rows = json.loads(TABLE.read_text(encoding="utf-8"))
    return [json.dumps(row["scene"]) for row in rows]


def damaged_scene(seed: int, number: int) -> bytes | None:
    """Return a scene with none to three damages; None if the one to be damaged is large."""
    random = Random(f"readers:{seed}:{number}")
    text = base(random.randrange(BASES))
    if random.random() < 0.4:
        text = random.choice(of_table())
    if not text:
        return None
    data = json.loads(text)
    for _ in range(random.choice((0, 1, 1, 1, 2, 3))):
        _damage(data, random)
    scene = json.dumps(data, ensure_ascii=random.random() < 0.5)
    if random.random() < 0.05:
        k = random.randrange(len(scene))
        scene = scene[:k] + random.choice('0-.eE"[]{},: \\u\x00\t') + scene[k + 1 :]
    return scene.encode("utf-8", "surrogatepass")


def _places(data: Json) -> Iterator[tuple[Json, Json]]:
    """Yield lists and objects with their keys, at all levels."""
    for key in list(data) if isinstance(data, dict) else range(len(data)):
        yield data, key
        if isinstance(data[key], (dict, list)):
            yield from _places(data[key])


def _names(data: Json) -> list[str]:
    """Return the names of the bodies of a scene that may have been damaged."""
    bodies = data.get("bodies")
    rows = bodies if isinstance(bodies, list) else []
    names = [row.get("name") for row in rows if isinstance(row, dict)]
    return [name for name in names if isinstance(name, str)]


def _value(random: Random) -> Json:
    """Return some value; a copy, for it may be damaged too."""
    return deepcopy(random.choice(VALUES))


def _damage(data: Json, random: Random) -> None:
    """Change a value, a key or a text somewhere, most often at one of the new keys."""
    every = [*_places(data)]
    new = [place for place in every if place[1] in NEW_KEYS]
    holder, key = random.choice(new if new and random.random() < 0.6 else every)
    kind = random.randrange(8)
    if kind == 0:
        holder[key] = _value(random)
    elif kind in (1, 2) and key in NEW_KEYS:
        holder[key] = NEW_KEYS[key](random, _names(data))
    elif kind == 3:
        del holder[key]
    elif kind == 4 and isinstance(holder[key], str) and holder[key]:
        k = random.randrange(len(holder[key]))
        letter = random.choice("0129*-+:.TZ a\n\x85")
        holder[key] = holder[key][:k] + letter + holder[key][k + random.randrange(2) :]
    elif kind == 5 and isinstance(holder, dict):
        holder[random.choice(KEYS)] = _value(random)
    else:
        _give_new_key(data, [place[0][place[1]] for place in every], random)


def _give_new_key(data: Json, values: Sequence[Json], random: Random) -> None:
    """Give one of the new keys to the scene or a body, or sometimes to another object."""
    key = random.choice(sorted(NEW_KEYS))
    objects = [one for one in (data, *values) if isinstance(one, dict)]
    right = [one for one in objects if "name" in one] if key in OF_BODIES else [data]
    holder = random.choice(right if right and random.random() < 0.9 else objects)
    holder[key] = NEW_KEYS[key](random, _names(data))


# ---- Who reads it.


def by_package(scene: bytes) -> tuple[Scene | None, str]:
    """Return the scene that the package reads, or why it refuses it."""
    with TemporaryDirectory() as folder:
        path = Path(folder) / "scene.json"
        path.write_bytes(scene)
        try:
            return Scene.load(path), ""
        except InputError as refused:
            return None, str(refused)


def by_python(scene: bytes, *, are_records_verified: bool) -> str:
    """Return why the checkers in Python refuse a scene; "" if they read it."""
    try:
        with proof_scene.budget(None, len(scene)):
            text = scene.decode("utf-8-sig")
            proof_scene.Scene(text, are_records_verified=are_records_verified)
    except UnicodeDecodeError:
        return "not UTF-8"
    except proof_scene.NoProofError as refused:
        return str(refused)
    return ""


def by_cpp(scene: bytes, *, are_records_verified: bool) -> str:
    """Return why ``cgal_check`` refuses a scene; "" if it reads it, a radius included."""
    kind = "proof" if are_records_verified else "apart"
    head = f"exactpt-{kind} 1\nscene sha256 {hashlib.sha256(scene).hexdigest()}\n"
    proof = f"{head}span 0 -1\nnone\n"  # of no scene: rejected, once the scene is read
    line = checker().verdict(scene, proof.encode())
    if line.startswith("not decided"):
        raise proof_scene.Exhausted
    is_read = line.startswith("rejected") or line.endswith("a radius: no proof is possible")
    return "" if is_read else line


def is_beyond(scene: Scene) -> bool:
    """Return True if no checker reads a scene that the package reads.

    That are scenes with rings that touch, and with coordinates of high degrees.
    """
    if not are_tileable(body for body in scene.bodies if not body.radius):
        return True
    try:
        refuse_degrees(scene.bodies)
    except InputError:
        return True
    return False


def disagreement(scene: bytes) -> str:
    """Return how the readers differ about a scene; "" if they do not.

    Raises:
        Exhausted: if a checker does not decide within its budget of work.
    """
    read, why = by_package(scene)
    in_python, in_cpp = (
        [by(scene, are_records_verified=verified) for verified in (True, False)]
        for by in (by_python, by_cpp)
    )
    for of, one, other in zip(("proofs", "certificates"), in_python, in_cpp, strict=True):
        if bool(one) != bool(other):
            return (
                f"checkers of {of}: {one or 'read'!a:.90} in Python, {other or 'read'!a:.90} in C++"
            )
    if in_python[1] and not in_python[0]:
        return f"read by the checkers of proofs alone: {in_python[1]!a:.90}"
    if read is None and not in_python[0]:
        return f"read by the checkers, and not by the package: {why!a:.150}"
    if read is not None and in_python[0] and not is_beyond(read):
        return f"read by the package, and not by the checkers: {in_python[0]!a:.150}"
    if read is not None and in_python[1] and not is_beyond(read):
        return f"read by the package, and not by those of certificates: {in_python[1]!a:.150}"
    return ""


@dataclass(frozen=True)
class Readers(Check):
    """The check of damaged scenes by all readers.

    Attributes:
        seed: seed of all of them.
        keep: folder for those about which readers disagree.
    """

    seed: int
    keep: Path
    name = "scene-readers"

    @property
    def about(self) -> object:
        """The seed."""
        return self.seed

    def run(self, item: Item, tell: Tell, ends: float | None) -> Result:
        """Have a scene read, if there is one with this number."""
        counts, findings = Counts(), list[Finding]()
        for number in item.numbers:
            scene = damaged_scene(self.seed, number)
            if scene is None:
                continue
            path = self.keep / f"{self.seed}.{number}.scene.json"
            finding = Finding("", "hangs", str(path), {path: scene})
            with limit(PATIENCE, ends):
                tell(Step(PATIENCE, finding))
                try:
                    why = disagreement(scene)
                except proof_scene.Exhausted:
                    counts["not decided", "scenes"] += 1
                    continue
                is_read = not by_python(scene, are_records_verified=True)
            counts["read" if is_read else "refused", "scenes"] += 1
            if why:
                findings.append(finding._replace(signature="disagreement", why=f"{path}: {why}"))
        return Result(counts, findings)

    def table(self, counts: Counts) -> list[str]:
        """One line for scenes that are read, and for those that are not."""
        rows = sorted((row, n) for (row, column), n in counts.items() if column == "scenes")
        return [f"{row}: {n:,} scenes" for row, n in rows]
