"""The runner of laws: cases by number, their outcomes, and faults in the smallest scene found."""

from __future__ import annotations

import json
import time as clock
from collections import Counter
from collections.abc import Callable, Collection, Iterable, Iterator, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from random import Random
from typing import Final, NamedTuple, TypeAlias

from exactpt import InputError, Scene
from exactpt.testing import shrink
from fuzz.laws.kept import PREFIX, kept_of_source
from fuzz.laws.known import reason_of
from fuzz.laws.scenes import drawn, is_source, made
from fuzz.laws.table import LAWS
from fuzz.limits import TooSlow, limit, signed
from fuzz.witnesses import Difference, LeftOutError

__all__ = ["TIERS", "Case", "Fault", "Looked", "Tally", "Worth", "case_of", "cases_of",
           "cost_of", "count_of", "favour", "laws_of_cases", "look", "run_for", "runnable",
           "scene_of", "shrunk"]  # fmt: skip

PATIENCE: Final = 20.0
"""Seconds of processor time after which a case counts as hanging."""

COSTS: Final = Path(__file__).with_name("costs.json")
"""Milliseconds of a case of each law, written by `make accept`."""

TIERS: Final = {"quick": 30.0, "minute": 60.0, "full": 240.0}
"""Seconds of processor time of all laws, on the machine that wrote the costs."""

FAVOUR: Final = 7.0
"""Factor by which the share of a favoured law grows."""

USUAL: Final = 20.0
"""Milliseconds of a case of a law without recorded costs."""

OWN: Final = "own"
"""The source of laws that draw their own cases."""

COST: Final = "cost/"
"""What the names of laws about costs begin with."""

NOT_ASKED: Final = "not asked"
NO_SCENE: Final = "no such scene"
TOO_LARGE: Final = "too large"
KNOWN_FAULT: Final = "known to be broken"
SILENT: Final = (NOT_ASKED, NO_SCENE, TOO_LARGE)
"""Outcomes of cases in which a law says nothing."""

Worth: TypeAlias = Callable[[str], float]
"""The factor by which the share of a law in the time is multiplied."""


class Case(NamedTuple):
    """A case, which is the same in every run.

    Attributes:
        law: the name of the law.
        source: the source of the scene, with its changes.
        seed, number: the seed of the run, and the number of the case in it.
    """

    law: str
    source: str
    seed: int
    number: int

    @property
    def place(self) -> str:
        """The case without its law."""
        return f"{self.source}:{self.seed}:{self.number}"

    def __str__(self) -> str:
        return f"{self.law} {self.place}"

    @classmethod
    def parse(cls, text: str) -> Case:
        """Return the case of a text, ``LAW SOURCE:SEED:NUMBER``.

        Raises:
            InputError: if the text is no case, or there is no such law.
        """
        law, _, place = text.rpartition(" ")
        source, *numbers = place.rsplit(":", 2)
        if law not in LAWS:
            raise InputError(f"case: unknown law, got {law!r}; see python -m fuzz run --list")
        try:
            seed, number = map(int, numbers)
        except ValueError:
            wanted = "write it as LAW SOURCE:SEED:NUMBER"
            raise InputError(f"case: not a place, got {place!r}; {wanted}") from None
        if not is_source(source):
            raise InputError(f"case: unknown source or change, got {source!r}")
        return cls(law, source, seed, number)

    @property
    def choices(self) -> str:
        """The place from which the random choices follow.

        A kept case has at first the choices with which its law was broken.
        """
        if self.number > 0:
            return self.place
        case = kept_of_source(self.source)
        return case.place if case is not None and case.law == self.law else self.place


class Fault(NamedTuple):
    """A broken law.

    Attributes:
        case: the case.
        signature: the kind of the fault, the same for the same fault in another scene.
        why: what is wrong, in words.
        scene: the scene.
        vertices: the number of vertices of the scene before it was shrunk.
    """

    case: Case
    signature: str
    why: str
    scene: Scene
    vertices: int

    @property
    def report(self) -> str:
        """What a failing test prints: the fault, the commands, the scene."""
        law, place = self.case.law, self.case.place
        data = json.dumps(self.scene.to_json())
        size = f"shrunk from {self.vertices} to {self.scene.vertex_count} vertices"
        lines = [f"{law}: {self.why}", f"  again: python -m fuzz again '{law}' '{place}'"]
        if not place.startswith(PREFIX):
            lines.append(
                f"  keep:  python -m fuzz keep  '{law}' '{place}'      (writes tests/cases)"
            )
        return "\n".join([*lines, f"  scene: {data}      {size}"])


class Looked(NamedTuple):
    """A checked case.

    Attributes:
        case: the case.
        outcome: what the law said, in a few words; one of `SILENT` if it said nothing.
        seconds: processor time.
        fault: the fault; None if the law holds.
    """

    case: Case
    outcome: str
    seconds: float
    fault: Fault | None = None

    @property
    def is_silent(self) -> bool:
        """True if the law said nothing."""
        return self.outcome in SILENT


def case_of(law: str, seed: int, number: int) -> Case:
    """Return the case of a number, which a law with few cases has once."""
    if LAWS[law].cases is not None:
        seed = 0
    source = drawn(LAWS[law].sources, f"{law} {seed}", number)
    return Case(law, source, seed, number)


def cases_of(law: str, seed: int, count: int) -> Iterator[Case]:
    """Yield the first cases of a law; there are `Law.cases` of some."""
    return (case_of(law, seed, number) for number in range(count))


def scene_of(case: Case) -> Scene | None:
    """Return the scene of a case; None if its source makes none there."""
    try:
        return made(case.source, Random(f"scene {case}"))
    except (InputError, TypeError, ValueError):
        return None


def look(case: Case, scene: Scene | None = None) -> Looked:
    """Check a case.

    Args:
        case: the case.
        scene: another scene for the same law and the same random choices; by default that of
            the case.
    """
    began = clock.process_time()
    law = LAWS[case.law]
    scene = scene_of(case) if scene is None else scene
    if scene is None:
        return Looked(case, NO_SCENE, clock.process_time() - began)
    outcome, fault = TOO_LARGE, None
    if law.most is None or scene.vertex_count <= law.most:
        outcome, fault = _check(case, scene)
    return Looked(case, outcome, clock.process_time() - began, fault)


def _check(case: Case, scene: Scene) -> tuple[str, Fault | None]:
    """Return the outcome of a case, and its fault."""
    try:
        with limit(PATIENCE):
            return LAWS[case.law].check(scene, Random(f"choices {case.law} {case.choices}")), None
    except LeftOutError:
        return NOT_ASKED, None
    except Difference as difference:
        signature, why = difference.kind, str(difference)
        scene = difference.scene or scene
    except TooSlow:
        signature, why = "hangs", f"no answer within {PATIENCE:.0f} s of processor time"
    except Exception as error:  # any exception is a finding
        signature, why = signed(error)
    return "fault", Fault(case, signature, why, scene, scene.vertex_count)


def shrunk(fault: Fault, seconds: float) -> Fault:
    """Return the same fault, of the same law and with the same signature, in a smaller scene.

    A fault that does not come again, such as a time that was too long once, is returned with the
    words for that.
    """
    if not fault.scene.bodies:
        return fault  # a law that draws its own cases, which are no scenes

    def fails(smaller: Scene) -> bool:
        found = look(fault.case, smaller).fault
        return found is not None and found.signature == fault.signature

    if not fails(fault.scene):
        return fault._replace(why=f"{fault.why}; once, and not when it was repeated")
    scene = shrink(fault.scene, fails, seconds=seconds)
    found = look(fault.case, scene).fault
    return fault if found is None else found._replace(vertices=fault.vertices)


def costs() -> dict[str, float]:
    """Return the recorded milliseconds of a case of each law."""
    recorded: dict[str, float] = json.loads(COSTS.read_text(encoding="utf-8"))
    return recorded


def cost_of(law: str) -> float:
    """Return the milliseconds of a case of a law, as recorded."""
    return costs().get(law, USUAL)


def count_of(law: str, tier: str) -> int:
    """Return the number of cases of a law in a tier: the same on every machine."""
    shares = sum(one.share for one in LAWS.values())
    seconds = TIERS[tier] * LAWS[law].share / shares
    count = max(len(LAWS[law].sources), round(1000 * seconds / cost_of(law)))
    most = LAWS[law].cases
    return count if most is None else min(count, most)


def runnable(laws: Iterable[str]) -> list[str]:
    """Return those of some laws whose programs are built."""
    return [law for law in laws if LAWS[law].is_runnable]


def laws_of_cases(needs: str = "") -> list[str]:
    """Return the laws about a kept case: those of any scene that need this other program.

    Laws that draw their own cases, and those about costs, are about other scenes.
    """
    return [
        name
        for name, law in LAWS.items()
        if law.needs == needs and law.sources != (OWN,) and not name.startswith(COST)
    ]


def favour(laws: Collection[str]) -> Worth:
    """Return that some laws have `FAVOUR` times their share."""
    return lambda law: FAVOUR if law in laws else 1.0


def run_for(
    laws: Sequence[str], seed: int, seconds: float, worth: Worth = lambda _: 1.0
) -> Iterator[Looked]:
    """Check cases of some laws in turn; that with the least time for its share is next.

    Args:
        laws: the laws; of those without a case so far, the first one here is next.
        seed: the seed of the cases.
        seconds: the processor time in all.
        worth: the factor of the share of a law, which may change from case to case.
    """
    spent, numbers = dict.fromkeys(laws, 0.0), dict.fromkeys(laws, 0)
    ends = clock.process_time() + seconds
    while spent and clock.process_time() < ends:
        law = min(spent, key=lambda name: spent[name] / (LAWS[name].share * worth(name)))
        if numbers[law] == LAWS[law].cases:
            del spent[law]
            continue
        looked = look(case_of(law, seed, numbers[law]))
        numbers[law] += 1
        spent[law] += looked.seconds + 1e-4
        yield looked


@dataclass
class Tally:
    """Counts of the cases of each law, by outcome.

    Attributes:
        outcomes: by law, the number of cases with each outcome.
        seconds: by law, the processor time.
        faults: by law, the number of faults that are not known.
    """

    outcomes: dict[str, Counter[str]] = field(default_factory=dict)
    seconds: dict[str, float] = field(default_factory=dict)
    faults: Counter[str] = field(default_factory=Counter)

    def add(self, looked: Looked) -> None:
        """Count a case."""
        law = looked.case.law
        is_known = looked.fault is not None and reason_of(str(looked.case)) is not None
        outcome = KNOWN_FAULT if is_known else looked.outcome
        self.outcomes.setdefault(law, Counter())[outcome] += 1
        self.seconds[law] = self.seconds.get(law, 0.0) + looked.seconds
        self.faults[law] += looked.fault is not None and not is_known

    def said(self, law: str) -> int:
        """Return the number of cases about which a law said something."""
        counted = self.outcomes.get(law, Counter())
        return sum(n for outcome, n in counted.items() if outcome not in SILENT)

    def milliseconds(self, law: str) -> float:
        """Return the processor time of a case."""
        return 1000 * self.seconds[law] / max(1, self.outcomes[law].total())

    def table(self, laws: Iterable[str] | None = None) -> list[str]:
        """Return one line for each law, with the shares of its outcomes."""
        lines = [f"{'law':26}{'cases':>7}{'s':>8}{'ms':>7}{'faults':>8}  outcomes"]
        for law in laws or self.outcomes:
            counted = self.outcomes.get(law, Counter())
            total = counted.total()
            shares = ", ".join(
                f"{outcome} {100 * n / total:.0f} %" for outcome, n in counted.most_common(6)
            )
            lines.append(
                f"{law:26}{total:>7}{self.seconds[law]:>8.1f}{self.milliseconds(law):>7.1f}"
                f"{self.faults[law]:>8}  {shares}"
            )
        return lines
