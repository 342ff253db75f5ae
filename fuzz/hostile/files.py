"""Valid files of every format, and hostile ones made from them."""

from __future__ import annotations

import json
from contextlib import suppress
from functools import cache
from pathlib import Path
from random import Random
from tempfile import TemporaryDirectory
from typing import Final, NamedTuple

from exactpt import BudgetExceeded, InputError, Simulation, certify, write_shapes
from exactpt.batch import run
from exactpt.batch.chunks import digest_of
from exactpt.batch.journal import SEAL
from exactpt.proof.written import write_proof
from exactpt.simulation.store import sealed
from exactpt.testing.scenes import families
from fuzz.changes.excerpts import scene_of
from fuzz.hostile.wounds import damaged, with_another_value, with_another_word

__all__ = ["FORMATS", "SCENES", "Hostile", "batch_files", "hostile", "scene_text"]

SCENES: Final = ("scene", "special")
"""Formats of scene files: "special" ones have holes, parts, radii or spin."""

FORMATS: Final = (
    *SCENES, "geojson", "mfjson", "wkt", "svg", "saved", "proof", "apart", "journal", "part",
)  # fmt: skip
SEEDS: Final = 40
"""Number of valid files of each format."""

DRAWING: Final = """<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 90 60" width="45mm">
<defs><path id="t" d="M0 0h2v3z"/><clipPath id="c"><circle r="3"/></clipPath></defs>
<style>.a {fill: none} #t {stroke: red}</style>
<g transform="translate(3 4) rotate(30) scale(1 2)"><use href="#t" x="9" class="a"/>
<rect x="1" y="2" width="3" height="4" rx="1"/></g><ellipse cx="40" cy="9" rx="5" ry="3"/>
<path d="M60 10 C 70 0 80 20 70 30 S 50 30 60 10 Z M63 12 a2 1 20 1 0 4 4 z"/>
<polyline points="5,50 9,55 14,50"/><line x1="20" y1="50" x2="29" y2="59"/></svg>"""

TRIP: Final = """{"type": "Feature", "properties": {"name": "ship"}, "temporalGeometry":
{"type": "MovingRigidGeometry", "geometry": {"type": "Polygon", "coordinates":
[[[0, 0], [4, 0], [4, 4], [0, 0]], [[2, 1], [3, 1], [3, 2], [2, 1]]]}, "sequences": [{"values":
[{"position": {"lat": 0, "lon": 1.5}, "rotation": 0}, {"position": {"lat": 9, "lon": -2}}],
"datetimes": ["1999-12-31T20:30:00.25-0330", "2000-01-01 00:00:30Z"]}],
"interpolations": ["Linear"]}}"""


class Hostile(NamedTuple):
    """A hostile file.

    Attributes:
        content: its bytes.
        seed: number of the valid file that it was made from.
        wound: "value", if one value of that was changed, and all digests are right; else "text".
    """

    content: bytes
    seed: int
    wound: str


def hostile(kind: str, number: int, seed: int) -> Hostile:
    """A hostile file of a format; half of them have one changed value."""
    rng = Random(f"hostile {kind} {seed} {number}")
    which = rng.randrange(SEEDS)
    text = _valid(kind, which)
    if rng.random() < 0.5:
        return Hostile(damaged(text, rng), which, "text")
    if kind in ("wkt", "svg", "proof", "apart", "part"):
        content = with_another_word(text, rng)
    elif kind == "journal":
        content = _journal_with_another_value(text, rng)
    elif kind == "saved":
        data = with_another_value(_unsealed(text), rng)
        content = json.dumps(sealed(data) if isinstance(data, dict) else data)
    else:
        content = json.dumps(with_another_value(json.loads(text), rng))
    return Hostile(content.encode("utf-8", "surrogatepass"), which, "value")


def _journal_with_another_value(text: str, rng: Random) -> str:
    """A journal with one changed value in one of its lines, which has its digest again."""
    lines = text.splitlines()
    number = rng.randrange(len(lines))
    data = json.loads(lines[number])
    data.pop(SEAL, None)
    data = with_another_value(data, rng)
    if number and isinstance(data, dict):
        data[SEAL] = digest_of(json.dumps(data).encode() + b"\n")
    lines[number] = json.dumps(data)
    return "\n".join(lines) + "\n"


def _unsealed(text: str) -> object:
    data = json.loads(text)
    del data["exactpt-simulation"], data["sha256"]
    return data


def scene_text(which: int) -> str:
    """The scene file from which the valid files of this number are made."""
    return _valid("scene", which)


def _certificate(which: int) -> bytes:
    """The certificate of the scene of this number, or of the next one that has one."""
    plain = [*families("convex", "simple", "points")]
    try:
        return certify(scene_of(plain[which % len(plain)], 1 + which)).text
    except (BudgetExceeded, InputError):
        return _certificate(which + 1)


class _InterruptedError(Exception):
    """A batch is interrupted."""


@cache
def batch_files(which: int) -> dict[str, str]:
    """The files of a batch that was interrupted after two of its chunks, and the whole results.

    By their names: the scenes, the results and the journal so far, and "answers.jsonl".
    """
    lines = [_one_line(number) for number in (which, which + 1, which + 2)] * 12

    done = 0

    def report(*_: int) -> None:
        nonlocal done
        done += 1
        if done == 2:
            raise _InterruptedError

    with TemporaryDirectory() as folder:
        scenes, results = Path(folder) / "scenes.jsonl", Path(folder) / "answers.jsonl"
        scenes.write_text("".join(lines), encoding="utf-8")
        with suppress(_InterruptedError):
            run(scenes, results, report=report)
        files = {path.name: path.read_text(encoding="utf-8") for path in Path(folder).iterdir()}
        run(scenes, results)
        return files | {results.name: results.read_text(encoding="utf-8")}


def _one_line(which: int) -> str:
    """A line of a batch: a small scene of two points."""
    point = {"name": "a", "vertices": [[0, which]], "motion": {"x": [0, 1]}}
    bodies = [point, {"name": "b", "vertices": [[9, 0], [9, 1 + 2 * which]]}]
    note = {"exactpt": 1, "time": [0, 10], "bodies": bodies}
    return json.dumps(note) + " " * 400 + "\n"


@cache
def _valid(kind: str, which: int) -> str:
    """A valid file of a format, made from a scene of a family."""
    if which % 2 and kind in ("svg", "mfjson"):
        return DRAWING if kind == "svg" else TRIP
    if kind in ("journal", "part"):
        return batch_files(which)[f"answers.jsonl.{kind}"]
    special = [*families("rings", "rounded", "spinning", "touching")]
    straight = ["chains_on_grid", "bodies_on_grid", "linear_points", "piecewise_points"]
    plain = [*families("convex", "simple", "points")]
    names = {"special": special, "mfjson": straight}.get(kind, plain)
    scene = scene_of(names[which % len(names)], 1 + which)
    with TemporaryDirectory() as folder:
        path = Path(folder) / f"file.{kind}"
        if kind in SCENES:
            scene.save(path)
        elif kind == "saved":
            simulation = Simulation(scene)
            simulation.step()
            simulation.save(path)
        elif kind == "proof":
            write_proof(scene, path, scene_file=scene_text(which).encode())
        elif kind == "apart":
            path.write_bytes(_certificate(which))
        else:
            write_shapes(scene, path)
        return path.read_text(encoding="utf-8")
