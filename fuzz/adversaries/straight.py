"""An adversary of the filter for straight motion: its outcomes, judged exactly.

Run it as ``python -m fuzz.adversaries.straight --rows 100000 --seed 1``. A row is close if its
exact value is within a tenth of the bound of a tie; the ratio is that of the error of a time to its
bound.
"""

from __future__ import annotations

import math
import random
from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass, field

from exactpt.filters import straight
from exactpt.filters.candidates import Candidate, Candidates
from exactpt.filters.rows import EXACT, NO_BOX, STRAIGHT, Piece, Table
from fuzz.adversaries.exact_times import Fraction, compared, distance, fraction, touching
from fuzz.adversaries.report import Part, Report, run
from fuzz.adversaries.straight_rows import KINDS, Row, bounds_of, make_row, with_unknown

__all__ = ["Tally", "attack", "found_all", "main"]


@dataclass
class Tally:
    """What an attack has found.

    Attributes:
        rows: rows by kind.
        near: rows of which the exact value is within a tenth of the bound of a tie, by aim.
        worst: the largest error of a time by its bound, by kind.
        candidates, sure: how many rows became a candidate, or a sure one.
        wrong: what was wrong, and the rows.
    """

    rows: Counter[str] = field(default_factory=Counter)
    near: Counter[str] = field(default_factory=Counter)
    worst: dict[str, float] = field(default_factory=dict)
    candidates: int = 0
    sure: int = 0
    wrong: list[tuple[str, Row]] = field(default_factory=list)

    def report(self) -> Report:
        """Return the counts for a table."""
        wrong = [f"{what}: {row}" for what, row in self.wrong]
        worst = max(self.worst.values(), default=0.0)
        counts = {"candidates": self.candidates, "sure": self.sure}
        return Report(sum(self.rows.values()), sum(self.near.values()), worst, wrong, counts)


def one_vertex_and_edge() -> Table:
    """Return a table of a piece that is one vertex, and a piece that is one edge."""
    table = Table()
    table.add_places([0.0] * 3, [0.0] * 3)
    table.add_edges([(0, 1)])
    table.add_edges([(0, 0)])
    for place, size, edges in ((0, 1, 0), (1, 2, 1)):
        table.add_piece(
            Piece(
                body=place,
                kind=STRAIGHT,
                start=0.0,
                end=1.0,
                place=place,
                size=size,
                edge=0,
                edges=edges,
                frame=[0.0] * 24,
                box=NO_BOX,
                errors=EXACT,
                radius=0.0,
                deforms=False,
            )
        )
    return table


def fill(table: Table, row: Row) -> None:
    """Put a row into the table."""
    numbers = row.doubles
    for k in range(3):
        table.xs[k], table.ys[k] = numbers[2 * k], numbers[2 * k + 1]
    table.edge[1] = 1 if row.kind == "point" else 0
    for piece in range(2):
        frame = 24 * piece
        cx, cy, wx, wy = numbers[6 + 4 * piece : 10 + 4 * piece]
        table.frames[frame], table.frames[frame + 4] = cx, cy
        table.frames[frame + 1], table.frames[frame + 5] = wx, wy
        errors = row.errors[piece]
        table.place_error[piece], table.path_error[piece] = errors.place, errors.path
        table.speed_error[piece] = errors.speed
        table.start[piece], table.end[piece] = row.start, row.end


def judge(row: Row, found: Candidates, limit: float, tally: Tally) -> None:
    """Compare the outcome of a row with the exact times of contact."""
    rows = found.rows() if found.limit >= limit else found_all(found)
    tally.rows[row.kind] += 1
    tally.candidates += len(rows)
    if not row.exact:  # something is NaN or infinite: that excludes nothing
        is_kept = bool(rows) and rows[0].low <= row.low and rows[0].high >= row.high
        if row.kind != "point" and not is_kept:
            tally.wrong.append(("an unknown number excluded a contact", row))
        return
    times = touching(row.exact)
    wrong = [] if times is None else wrong_times(row, rows, times)
    if found.limit < limit:
        tally.sure += 1
        wrong += wrong_limit(row, found.limit, times)
    tally.wrong += [(what, row) for what in wrong]
    measure(row, rows, tally)


def wrong_times(row: Row, rows: list[Candidate], times: tuple[Fraction, Fraction]) -> list[str]:
    """Return what is wrong with the candidate of features that touch between two times."""
    first, last = times
    if row.low > row.high or compared(first, row.high) > 0 or compared(last, row.low) < 0:
        return []
    if not rows:
        return ["a contact in the window was dropped"]
    wrong: list[str] = []
    if compared(first, rows[0].low) < 0 and row.low < rows[0].low:
        wrong.append("a contact before low")
    if compared(last, rows[0].high) > 0 and row.high > rows[0].high:
        wrong.append("a contact after high")
    return wrong


def found_all(found: Candidates) -> list[Candidate]:
    """Return all candidates, also those after the limit."""
    limit, found.limit = found.limit, math.inf
    rows = found.rows()
    found.limit = limit
    return rows


def wrong_limit(row: Row, limit: float, times: tuple[Fraction, Fraction] | None) -> list[str]:
    """Return what is wrong with a limit, by which features touch while both pieces exist."""
    if times is None:
        return ["sure of a contact that is none"]
    wrong: list[str] = []
    if compared(times[0], limit) > 0:
        wrong.append("sure of a contact that comes later")
    if compared(times[0], math.nextafter(row.start, math.inf)) < 0:
        wrong.append("sure of a contact perhaps before the start of a piece")
    if compared(times[0], math.nextafter(row.end, -math.inf)) > 0:
        wrong.append("sure of a contact perhaps after the end of a piece")
    return wrong


def measure(row: Row, rows: list[Candidate], tally: Tally) -> None:
    """Count a row near a tie, and keep the largest error of a time by its bound."""
    known = bounds_of(row)
    px, py, qx, qy, rx, ry, ax, ay, avx, avy, bx, by, bvx, bvy = row.exact
    ux, uy, wx, wy = rx - qx, ry - qy, avx - bvx, avy - bvy
    zx, zy = px - qx + ax - bx, py - qy + ay - by
    c0, c1 = ux * zy - uy * zx, ux * wy - uy * wx
    if not c1 or not math.isfinite(known.r) or not known.r > 0.0:
        if row.aim in {"line", "slope"} and abs(known.c0) <= 0.1 * known.e0:
            tally.near[row.aim] += 1
        return
    time = fraction(-c0, c1)
    for bound in {"window": (row.low, row.high), "span": (row.start, row.end)}.get(row.aim, ()):
        if math.isfinite(bound) and distance(time, bound) <= 0.1 * known.r:
            tally.near[row.aim] += 1
    if row.aim == "foot" and known.length > 0.0:
        n, d = time
        along = (zx * ux + zy * uy) * d + (wx * ux + wy * uy) * n
        squared = (ux * ux + uy * uy) * d
        place = along / squared
        if min(abs(place), abs(place - 1.0)) <= 0.1 * known.foot / known.length:
            tally.near[row.aim] += 1
    if rows and row.low < rows[0].low < rows[0].high < rows[0].until:
        middle = 0.5 * rows[0].low + 0.5 * rows[0].high
        ratio = distance(time, middle) / (0.5 * (rows[0].high - rows[0].low))
        tally.worst[row.kind] = max(tally.worst.get(row.kind, 0.0), ratio)


def attack(rows: int, seed: int, kinds: Sequence[str] = KINDS) -> Tally:
    """Run the filter on rows of some kinds, and judge the outcomes."""
    rng = random.Random(seed)
    tally = Tally()
    table = one_vertex_and_edge()
    for number in range(rows):
        row = make_row(rng, rng.choice(kinds))
        if number % 50 == 49:
            row = with_unknown(rng, row)
        fill(table, row)
        limit = math.inf
        found = Candidates(limit)
        straight.collect(table, 0, 1, row.low, row.high, -math.inf, found)
        judge(row, found, limit, tally)
    return tally


def main() -> None:
    """Attack the filter by rows of each kind, and by pieces; print a table."""
    from fuzz.adversaries.straight_pieces import attack_boxes, attack_near, attack_pieces

    parts: dict[str, Part] = {
        kind: lambda rows, seed, kind=kind: attack(rows, seed, (kind,)).report()  # type: ignore[misc]
        for kind in KINDS
    }
    parts["boxes"] = lambda rows, seed: attack_boxes(rows // 10, seed).report()
    parts["features near a piece"] = lambda rows, seed: attack_near(rows // 100, seed).report()
    parts["features of pieces"] = lambda rows, seed: attack_pieces(rows // 100, seed).report()
    run(parts, str(__doc__))


if __name__ == "__main__":
    main()
