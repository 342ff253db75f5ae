"""The power of the laws: how soon they find mistakes that are planted in the package."""

from __future__ import annotations

import json
import os
import resource
import sys
import time as clock
import traceback
from collections.abc import Sequence
from random import Random
from typing import Final, NamedTuple

import click

from exactpt.errors import InputError
from exactpt.kernel import filters
from fuzz import quick_worth
from fuzz.laws.known import reason_of
from fuzz.laws.runner import PATIENCE, run_for, runnable
from fuzz.laws.scenes import made
from fuzz.laws.table import LAWS
from fuzz.options import FAILED, HELP
from fuzz.planted import PLANTED
from fuzz.quick_worth import Fault

__all__ = ["Found", "hunt", "power"]

PLANTED_PREFIX: Final = "planted: "


class Found(NamedTuple):
    """What the laws found of a mistake.

    Attributes:
        law: the law that is broken; "" if none is, and "the process" if it died.
        case: the case.
        why: the fault.
        cases: the number of cases checked.
        seconds: processor time.
    """

    law: str
    case: str
    why: str
    cases: int
    seconds: float


def hunt(mistake: Fault, laws: Sequence[str], seed: int, seconds: float) -> Found:
    """Check cases of laws in a process in which a mistake is made, until a law is broken.

    Raises:
        InputError: if the package is compiled: compiled functions cannot be changed.
    """
    if not filters.__file__.endswith(".py"):
        raise InputError("mistakes are planted in the plain package only; run make plain")
    receiving, sending = os.pipe()
    child = os.fork()
    if child == 0:
        os.close(receiving)
        try:
            found = _hunt_here(mistake, laws, seed, seconds)
            os.write(sending, json.dumps(found).encode())
        except BaseException:
            traceback.print_exc()
        finally:
            os._exit(0)
    os.close(sending)
    with os.fdopen(receiving) as pipe:
        text = pipe.read()
    _, status, used = os.wait4(child, 0)
    if text:
        return Found(*json.loads(text))
    spent = used.ru_utime + used.ru_stime
    return Found("the process", "", f"it ended without a result, status {status}", 0, spent)


def _hunt_here(mistake: Fault, laws: Sequence[str], seed: int, seconds: float) -> Found:
    began = clock.process_time()
    most = int(began + seconds + 2 * PATIENCE)
    resource.setrlimit(resource.RLIMIT_CPU, (most, most + 5))
    mistake.make()
    cases = 0
    for looked in run_for(laws, seed, seconds):
        cases += 1
        fault = looked.fault
        if fault is not None and reason_of(str(looked.case)) is None:
            spent = clock.process_time() - began
            return Found(fault.case.law, fault.case.place, fault.why[:200], cases, spent)
    return Found("", "", "", cases, clock.process_time() - began)


def _is_masked(mistake: Fault) -> bool:
    """Return True if no answer can show a planted mistake, for the reason that it states."""
    name = mistake.name.removeprefix(PLANTED_PREFIX)
    return name in PLANTED and bool(PLANTED[name].masked)


@click.command("power", context_settings=HELP)
@click.argument("words", nargs=-1, metavar="[WORD]...")
@click.option("--seconds", default=60.0, show_default=True, help="Processor time a mistake.")
@click.option("--seed", type=int, default=0, show_default=True, help="Seed of the cases.")
@click.option("--law", "chosen", multiple=True, help="Only laws whose names begin so.")
@click.option("--mutants", "count", default=0, show_default=True, help="Number of mutants, too.")
@click.option("--mutant-seed", type=int, default=0, show_default=True)
def power(
    words: tuple[str, ...], seconds: float, seed: int, chosen: tuple[str, ...], count: int,
    mutant_seed: int,
) -> None:  # fmt: skip
    """Plant mistakes one at a time, and count the seconds until a law is broken.

    The mistakes are those of fuzz/planted.py (with a WORD in their names), and mutants of random
    places of the package. A few are masked: no answer can show them. One of these that is found
    counts as one that has escaped.
    """
    laws = runnable(law for law in LAWS if not chosen or law.startswith(chosen))
    mutants = quick_worth.mutants(count, mutant_seed) if count else []
    mistakes = [*quick_worth.planted(), *mutants]
    made("scope", Random(0))  # the small scope is numbered once, before processes are made
    escaped = 0
    for mistake in mistakes:
        if words and not any(word in mistake.name for word in words):
            continue
        found = hunt(mistake, laws, seed, seconds)
        is_masked = _is_masked(mistake)
        escaped += bool(found.law) == is_masked
        by = found.law or ("masked" if is_masked else "NOTHING")
        click.echo(
            f"{mistake.name.removeprefix(PLANTED_PREFIX):54}{found.cases:>7}{found.seconds:>8.1f}"
            f"  {by}, {found.case}: {found.why}"
        )
    click.echo(f"{escaped} escaped")
    sys.exit(FAILED if escaped else 0)
