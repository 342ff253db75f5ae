"""The command line of the fuzzer."""

from __future__ import annotations

import signal
import sys
from itertools import cycle
from pathlib import Path

import click

from exactpt.files import write_atomically
from exactpt.testing.scenes import EVERY, SPINNING, families
from exactpt.tiling.start import TILINGS
from fuzz import battery, planted, soak
from fuzz.campaign import INTERRUPTS
from fuzz.cases import QUESTION, Scenes
from fuzz.changes import awkward
from fuzz.changes.thin import SUFFIX
from fuzz.drawings import drawings
from fuzz.hostile.run import hostile_files
from fuzz.laws.command import again, keep, record_costs, run
from fuzz.members import members
from fuzz.old_engine.build import is_built
from fuzz.options import FAILED, HELP, INTERRUPTED, Options, conduct, options, require_cgal
from fuzz.pair_record import pair_record
from fuzz.power.command import power
from fuzz.proofs.command import certificates, proof_both, proof_mutants, scene_readers
from fuzz.questions.checks import QUESTIONS
from fuzz.questions.command import questions
from fuzz.record import differences, record
from fuzz.small_scope.command import small_scope
from fuzz.space_queries import compare_public_queries, score_engines
from fuzz.transformations.command import transformations
from fuzz.witnesses import OLD, WITNESSES

EVERY_FAMILY = tuple(EVERY)
FAMILIES = tuple(families("convex", "simple", "points", "rounded", "rings", "touching"))
ASKED = tuple(QUESTION + name for name in QUESTIONS)
TWICE = (*FAMILIES, *(name + awkward.SUFFIX for name in FAMILIES))
MIXED = tuple(name for pair in zip(TWICE, cycle(ASKED), strict=False) for name in pair)
"""A scene and a question in turn: first of each family as it is, then an awkward one of each."""


@click.command("fuzz", context_settings=HELP)
@click.argument(
    "families", nargs=-1, type=click.Choice([*sorted(EVERY), *ASKED]), metavar="[FAMILY]..."
)
@click.option("--family", "more", multiple=True, type=click.Choice([*sorted(EVERY), *ASKED]))
@click.option("--thin", is_flag=True, help="Reduce half of the bodies to chains, segments, points.")
@click.option(
    "--awkward",
    "is_awkward",
    is_flag=True,
    help="Replace scenes by images in which no number is a double.",
)
@click.option("--witness", "witnesses", multiple=True, type=click.Choice(list(WITNESSES)))
@click.option("--shrink", default=60.0, show_default=True, help="Seconds for shrinking a failure.")
@options(None)
def fuzz(
    chosen: Options, families: tuple[str, ...], more: tuple[str, ...], witnesses: tuple[str, ...],
    shrink: float, *, thin: bool, is_awkward: bool,
) -> None:  # fmt: skip
    """Look for scenes on which the witnesses disagree, and questions with wrong answers.

    By default 200 cases, a scene of each family and a question in turn; in a second round scenes
    are awkward: no number is a double. A named family or witness leaves the questions out; a
    question is named as a family, questions/distance. The witness "old" is the engine of version
    0.2 (make old-engine), which alone takes all families by default.

    \b
    Examples:
      python -m fuzz --cases 1000 --jobs 2
      python -m fuzz row grazing --witness reference --minutes 5
      python -m fuzz --witness old --cases 2000
      python -m fuzz run tiling --seconds 600
      python -m fuzz battery
      python -m fuzz planted
      python -m fuzz small-scope
      python -m fuzz proof-mutants
      python -m fuzz questions
      python -m fuzz transformations
      python -m fuzz hostile --cases 100000
      python -m fuzz members --cases 20000
      python -m fuzz drawings --cases 5000
      python -m fuzz soak 60
    """
    names = (*families, *more)
    turning = [name for name in names if name in SPINNING]
    if turning and (is_awkward or thin or witnesses != (OLD,)):
        why = "bodies that spin are for --witness old alone, as they are"
        raise click.UsageError(f"{turning[0]}: {why}")
    if not names and witnesses == (OLD,):
        names = FAMILIES if is_awkward or thin else EVERY_FAMILY
    elif not names:
        names = FAMILIES if thin or is_awkward or witnesses else MIXED
    if thin:
        names = tuple(name if name in ASKED else name + SUFFIX for name in names)
    if is_awkward:
        names = tuple(name if name in ASKED else name + awkward.SUFFIX for name in names)
    witnesses = _present(witnesses)
    if not {"cgal", "proof"}.isdisjoint(witnesses):
        require_cgal("--witness")
    click.echo(f"seed {chosen.seed}, witnesses {', '.join(witnesses)}")
    check = Scenes(names, witnesses, chosen.seed, shrink)
    conduct(check, chosen, whole=200, again=f"--seed {chosen.seed}")


def _present(chosen: tuple[str, ...]) -> tuple[str, ...]:
    """Return the chosen witnesses, by default all; without the old engine if it is not built.

    Raises:
        UsageError: if it is chosen, and not built.
    """
    if is_built():
        return chosen or tuple(WITNESSES)
    if OLD in chosen:
        raise click.UsageError("the witness old is not built; to build it: make old-engine")
    if not chosen:
        click.echo("the witness old is left out: it is not built (make old-engine)")
    return chosen or tuple(name for name in WITNESSES if name != OLD)


@click.command("battery", context_settings=HELP)
@click.argument("words", nargs=-1, metavar="[WORD]...")
@click.option("--large", is_flag=True, help="Include the largest scenes (minutes).")
@click.option("--samples", type=click.IntRange(min=0), default=5, show_default=True)
def run_battery(words: tuple[str, ...], large: bool, samples: int) -> None:  # noqa: FBT001
    """Run the highly degenerate scenes of the battery (those with a WORD in their names)."""
    require_cgal("another command")
    click.echo(battery.table([])[0])
    differences = 0
    for name, trial in battery.BATTERY.items():
        if (trial.large and not large) or (words and not any(word in name for word in words)):
            continue
        for row in battery.play(name, samples=samples):
            differences += len(row.differences)
            click.echo("\n".join(battery.table([row])[1:]))
    click.echo(f"{differences} differences")
    sys.exit(FAILED if differences else 0)


@click.command("planted", context_settings=HELP)
@click.argument("words", nargs=-1, metavar="[WORD]...")
@click.option(
    "--cases", "most", type=click.IntRange(min=1), default=planted.MOST, show_default=True
)
@click.option("--seed", type=int, default=0, show_default=True)
def find_planted(words: tuple[str, ...], most: int, seed: int) -> None:
    """Plant classic bugs one at a time, and count the cases until the fuzzer finds them.

    A few are masked: no answer can show them, for the reason that fuzz/planted.py gives. One of
    these that is found counts as one that has escaped.
    """
    click.echo(planted.table([])[0])
    escaped = 0
    for bug in planted.PLANTED:
        if not words or any(word in bug for word in words):
            found = planted.hunt(bug, most, seed=seed)
            escaped += not found.is_as_expected
            click.echo(planted.table([found])[1])
    click.echo(f"{escaped} escaped")
    sys.exit(FAILED if escaped else 0)


@click.command("record", context_settings=HELP)
@click.argument("output", type=click.Path(dir_okay=False, path_type=Path))
@click.option("--cases", "count", type=click.IntRange(min=1), default=2000, show_default=True)
@click.option("--seed", type=int, default=0, show_default=True, help="Seed of the first scenes.")
@click.option(
    "--against",
    type=click.Path(exists=True, dir_okay=False, path_type=Path),
    help="Print the differences from this record.",
)
@click.option("--pairs", is_flag=True, help="Record the questions about pairs of bodies.")
def make_record(output: Path, count: int, seed: int, against: Path | None, *, pairs: bool) -> None:
    """Write a digest of all events, contacts, tilings and saved runs of many scenes.

    With --pairs: of the answers to all questions that need no tiling, about as many scenes of all
    families (the seeds from 0 on) and half as many on an integer grid.
    """
    if pairs:
        names = sorted(EVERY)
        lines = list(pair_record(names, max(1, count // len(names)), count // 2))
    else:
        lines = list(record(FAMILIES, count, seed))
    write_atomically(output, "\n".join(lines) + "\n")
    click.echo(f"{len(lines)} lines")
    if against is not None:
        changed = differences(against.read_text(encoding="utf-8").splitlines(), lines)
        click.echo("\n".join([*changed, f"{len(changed)} differences"]))
        sys.exit(FAILED if changed else 0)


@click.command("space-queries", context_settings=HELP)
@click.argument("folder", type=click.Path(exists=True, file_okay=False, path_type=Path))
@click.option("--repeat", "count", type=click.IntRange(min=1), help="Number of queries in arrays.")
@click.option("--engines", is_flag=True, help="Score other programs, too.")
def public_queries(folder: Path, count: int | None, *, engines: bool) -> None:
    """Compare first contacts in space with the answers of a public benchmark.

    The CSV files of FOLDER have eight rows a query, seven integers a row: x, y and z as numerator
    and denominator, and 1 if there is a contact; "vertex-face" in the name of a file, or not.
    """
    differences = compare_public_queries(folder, count, click.echo)
    if engines:
        score_engines(folder, click.echo)
    sys.exit(FAILED if differences else 0)


@click.command("soak", context_settings=HELP)
@click.argument("minutes", type=click.FloatRange(min=0, min_open=True))
@click.option("--seed", type=int, default=0, show_default=True)
@click.option("--tiling", default="lazy", show_default=True, type=click.Choice(TILINGS))
def run_soak(minutes: float, seed: int, tiling: str) -> None:
    """Let one simulation go on for MINUTES while motions, bodies and files come and go."""
    soaked = soak.Soak(seed, tiling)
    try:
        soaked.run(60 * minutes, lambda _: None)
        ended = True
    except KeyboardInterrupt:
        ended = False
    grown = soak.verdict(soaked)
    click.echo("\n".join([*soak.table(soaked), *(f"GROWN: {line}" for line in grown)]))
    if not ended:
        click.echo(f"interrupted; a soak begins anew: --seed {seed}", err=True)
        sys.exit(INTERRUPTED)
    sys.exit(FAILED if grown else 0)


COMMANDS = {
    "run": run,
    "again": again,
    "keep": keep,
    "costs": record_costs,
    "power": power,
    "soak": run_soak,
    "hostile": hostile_files,
    "members": members,
    "drawings": drawings,
    "record": make_record,
    "space-queries": public_queries,
    "battery": run_battery,
    "planted": find_planted,
    "certificates": certificates,
    "proof-both": proof_both,
    "proof-mutants": proof_mutants,
    "scene-readers": scene_readers,
    "small-scope": small_scope,
    "questions": questions,
    "transformations": transformations,
}


def main() -> None:
    """Run a subcommand; without its name, a campaign.

    A termination signal acts like Ctrl-C, so that worker processes are ended too.
    """
    for number in (signal.SIGINT, signal.SIGTERM):
        if signal.getsignal(number) is not signal.SIG_IGN:  # as in the background of a shell
            signal.signal(number, INTERRUPTS)
    name, *rest = [*sys.argv[1:], ""]
    name = {"--soak": "soak", "--hostile": "hostile"}.get(name, name)  # as they were once
    command = COMMANDS.get(name, fuzz)
    words = rest[:-1] if name in COMMANDS else sys.argv[1:]
    own = f" {name}" if name in COMMANDS else ""
    try:
        sys.exit(command.main(words, prog_name=f"python -m fuzz{own}", standalone_mode=False))
    except click.ClickException as error:
        error.show()
        sys.exit(error.exit_code)
    except click.Abort:
        click.echo("interrupted; nothing to go on from", err=True)
        sys.exit(INTERRUPTED)


if __name__ == "__main__":
    main()
