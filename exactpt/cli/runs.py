"""collide and simulate: the first contact, and the events up to it."""

from __future__ import annotations

import json
from collections.abc import Callable
from contextlib import nullcontext
from pathlib import Path
from typing import TYPE_CHECKING

import click

from exactpt.cli.options import (
    AFTER_START,
    BETWEEN,
    IGNORE,
    QUIET,
    RATIONAL,
    SCENE,
    TILING,
    budget,
    fan_option,
    keep_input,
    load,
    names_in,
    two_names,
    within_budget,
)
from exactpt.cli.terminal import (
    answer_in_words,
    drop_standard_output,
    event_in_words,
    print_output,
    stats_in_words,
)
from exactpt.errors import BudgetExceeded, InputError
from exactpt.kernel.numbers import QQ, rational

if TYPE_CHECKING:
    from fractions import Fraction

    from exactpt.pair.contact import Contact
    from exactpt.scene.scene import Scene
    from exactpt.search.first import ContactQuery, Search
    from exactpt.simulation.event import RunEvent
    from exactpt.simulation.simulation import Simulation


@click.command()
@SCENE
@click.option("--json", "as_json", is_flag=True, help="Print the result as JSON.")
@click.option("--until", type=RATIONAL, help="Search up to this time.")
@click.option("--all", "every", is_flag=True, help="Print all intervals in which bodies meet.")
@click.option(
    "--enclosed",
    is_flag=True,
    help="Print bounds of the first contact's time, each spin turning at exactly its rate.",
)
@TILING
@click.option(
    "--method",
    default="auto",
    show_default=True,
    type=click.Choice(["kinetic", "pairs", "auto"]),
    help="kinetic keeps a tiling, pairs searches pairs of features; auto is pairs unless --tiling, "
    "--proof or, for bodies that a tiling can hold, --max-events is given, or many coefficients "
    "are out of the range of doubles.",
)
@IGNORE
@AFTER_START
@BETWEEN
@click.option("--since", type=RATIONAL, help="Search from this time on.")
@click.option(
    "--proof",
    type=click.Path(path_type=Path),
    help="Write a proof of the result; exactpt check --write-checker FILE writes what checks it.",
)
@click.option(
    "--certificate",
    type=click.Path(path_type=Path),
    help="Write a certificate that bodies are apart up to shortly before the contact, its scene "
    "beside it; exactpt check FILE checks it. For any method, not with --after-start.",
)
@click.option("--stats", is_flag=True, help="Print counts of events, certificates and decisions.")
@click.option("--exit-code", is_flag=True, help="Return 1 if there is a contact.")
@click.option("--exact-only", is_flag=True, help="Switch the float filters off.")
@budget
def collide(
    scene: Path,
    as_json: bool,
    until: QQ | None,
    every: bool,
    enclosed: bool,
    tiling: str,
    method: str,
    ignore: tuple[str, ...],
    after_start: bool,
    between: tuple[str, ...],
    since: QQ | None,
    proof: Path | None,
    certificate: Path | None,
    stats: bool,
    exit_code: bool,
    exact_only: bool,
    max_events: int | None,
    max_seconds: float | None,
) -> int:
    """Find the first contact of a scene, exactly.

    \b
    Examples:
      exactpt collide scene.json
      exactpt collide scene.json --json
      exactpt collide scene.json --stats
      exactpt collide scene.json --all
      exactpt collide scene.json --enclosed
      exactpt collide scene.json --until 7/2 --exit-code && echo "no contact"
      exactpt collide scene.json --proof contact.proof
      exactpt collide scene.json --certificate contact.apart
      exactpt collide scene.json --method pairs --ignore boat,buoy --ignore ball,wheel
      exactpt collide scene.json --after-start --between ball,wheel --since 1/2
    """
    keep_input(scene, proof, certificate)
    if every or enclosed:
        from exactpt.cli.intervals import collide_all, collide_enclosed

        answer = collide_all if every else collide_enclosed
        return answer(scene, until, as_json=as_json, exit_code=exit_code, max_seconds=max_seconds)
    from exactpt.search.first import ContactQuery

    if proof is not None and since is not None:
        raise InputError("--since: a proof is about the scene file, from its start on")
    question = ContactQuery(
        method,
        tiling,
        exact_only=exact_only,
        ignoring=[names_in(text, "--ignore") for text in ignore],
        after_start=after_start,
        between=[two_names(text, "--between") for text in between] or None,
        proof=proof,
        certificate=certificate,
        max_events=max_events,
        max_seconds=max_seconds,
    )
    contact = _first_contact(scene, until, since, question, as_json=as_json, stats=stats)
    return 1 if exit_code and contact is not None else 0


def _first_contact(
    path: Path,
    until: QQ | None,
    since: QQ | None,
    question: ContactQuery,
    *,
    as_json: bool,
    stats: bool,
) -> Contact | None:
    """Find the first contact, and print it."""
    from exactpt.search.first import search_for

    given: Scene | None = None
    search: Search | None = None
    answer: dict[str, object] = {"contact": None}
    uncertified: BudgetExceeded | None = None
    try:
        with within_budget(question.max_seconds):
            given = load(path, until, since)
            answer |= {"until": str(given.exact_end), "tiling": question.tiling}
            if question.proof is not None or question.certificate is not None:
                question = question._replace(scene_file=path.read_bytes())
            search = search_for(given, question)
            answer["tiling"] = search.name
            try:
                contact = search.run_to_contact()
            except BudgetExceeded as spent:
                if spent.answer is None:
                    raise
                (contact,), uncertified = spent.answer, spent
            stated = contact and contact.to_json()
            lines = answer_in_words(given, contact, "new " if question.after_start else "")
    except BudgetExceeded as spent:
        _add_time_reached(spent, None if search is None else search.contact_free_until)
        reached = None if spent.reached is None else str(rational(spent.reached))
        if as_json:
            answer |= {"stats": {} if search is None else search.stats, "reached": reached}
            click.echo(json.dumps(answer, indent=1))
        elif reached is not None:
            print_output(f"no contact up to t = {reached}")
        raise
    if as_json:
        answer |= {"contact": stated, "stats": search.stats}
        answer |= {"certificate": None} if uncertified else {}
        click.echo(json.dumps(answer, indent=1))
    else:
        print_output(*lines)
        if stats:
            print_output(*stats_in_words(search.stats))
    if uncertified is not None:
        raise uncertified
    return contact


@click.command()
@SCENE
@click.option("--events", type=click.Path(path_type=Path), help="Write one event per line (JSON).")
@click.option("--until", type=RATIONAL, help="Stop at this time.")
@click.option("-v", "--verbose", is_flag=True, help="Print one event per line, in words.")
@QUIET
@TILING
@fan_option('Report the changes of the fan triangulation as events of kind "fan"')
@click.option(
    "--proof",
    metavar="FOLDER",
    type=click.Path(path_type=Path),
    help="Write a proof of the run into a new folder, with its scene: 1.proof, 1.scene.json.",
)
@budget
def simulate(
    scene: Path,
    events: Path | None,
    until: QQ | None,
    verbose: bool,
    quiet: bool,
    tiling: str,
    fan: bool,
    proof: Path | None,
    max_events: int | None,
    max_seconds: float | None,
) -> int:
    """Run a scene to the end of its time span or its first contact.

    \b
    Examples:
      exactpt simulate scene.json
      exactpt simulate scene.json --events events.jsonl --until 5
      exactpt simulate scene.json --verbose --max-events 20
      exactpt simulate scene.json --proof folder
      exactpt simulate points.json --fan --events events.jsonl
    """
    import exactpt.simulation.simulation  # noqa: F401 - BLAS ends a process that has no memory
    from exactpt.files import writing

    keep_input(scene, events)
    with writing(events) if events is not None else nullcontext() as log:

        def report(event: RunEvent) -> None:
            if log is not None:
                log(f"{json.dumps(event.to_json())}\n")
            if verbose:
                _print_line(event_in_words(event), go_on=log is not None)

        lines = _run(
            scene,
            until,
            report,
            quiet=quiet or verbose,
            tiling=tiling,
            fan=fan,
            proof=proof,
            max_events=max_events,
            max_seconds=max_seconds,
        )
    if not quiet:
        print_output(*lines)
    return 0


def _print_line(line: str, *, go_on: bool) -> None:
    """Print a line; if the reader is gone, continue only if there is a file to complete."""
    try:
        print_output(line)
    except BrokenPipeError:
        if not go_on:
            raise
        drop_standard_output()


def _run(
    path: Path,
    until: QQ | None,
    report: Callable[[RunEvent], None],
    *,
    quiet: bool,
    tiling: str,
    fan: bool,
    proof: Path | None,
    max_events: int | None,
    max_seconds: float | None,
) -> list[str]:
    """Simulate and report every event; the lines to print at the end."""
    from exactpt.cli.progress import progress
    from exactpt.simulation.simulation import Simulation

    simulation: Simulation | None = None
    try:
        with within_budget(max_seconds):
            given = load(path, until)
            simulation = Simulation(
                given,
                tiling=tiling,
                fan=fan,
                max_events=max_events,
                max_seconds=max_seconds,
                proof=proof,
            )
            with progress(given, "simulating", quiet=quiet) as reached:
                for event in simulation.run():
                    report(event)
                    if reached is not None:
                        reached(event.time)
            return [*answer_in_words(given, simulation.contact), *stats_in_words(simulation.stats)]
    except BudgetExceeded as spent:
        _add_time_reached(spent, None if simulation is None else simulation.passed)
        raise


def _add_time_reached(spent: BudgetExceeded, until: Callable[[], Fraction | None] | None) -> None:
    """Complete an interruption by the time up to which there is provably no contact."""
    if spent.reached is None and until is not None:
        spent.reached = until()
