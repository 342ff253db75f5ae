"""tile and check: the tiling at a time, and the verdict of CGAL on all tilings of a run."""

from __future__ import annotations

import hashlib
import json
import shlex
from functools import partial
from pathlib import Path
from typing import Any

import click

from exactpt.cli.options import (
    QUIET,
    RATIONAL,
    SCENE,
    TILING,
    budget,
    load,
    naming_at,
    output,
    within_budget,
)
from exactpt.cli.progress import progress
from exactpt.cli.terminal import print_error, print_output
from exactpt.errors import BudgetExceeded, InputError
from exactpt.kernel.numbers import QQ, rational


@click.command()
@SCENE
@click.option("--at", type=RATIONAL, help="The time; by default the start.")
@click.option("--run", "by_running", is_flag=True, help="Simulate from the start up to that time.")
@TILING
@output("Write to a file.")
@budget
def tile(
    scene: Path,
    at: QQ | None,
    by_running: bool,
    tiling: str,
    output: Path | None,
    max_events: int | None,
    max_seconds: float | None,
) -> int:
    """Print the tiling of the free space at a rational time, as JSON.

    The tiling is built at that time, or with --run reached by simulating from the start; for
    the canonical tilings both are equal.

    \b
    Examples:
      exactpt tile scene.json
      exactpt tile scene.json --at 5/2 -o tiling.json
      exactpt tile scene.json --at 5/2 --run
    """
    from exactpt.files import write_atomically
    from exactpt.simulation.tile import tile_at

    with within_budget(max_seconds), naming_at():
        given = load(scene)
        snapshot = tile_at(
            given,
            given._start if at is None else at,
            tiling=tiling,
            by_running=by_running,
            max_events=max_events,
            max_seconds=max_seconds,
        )
        text = json.dumps(snapshot.to_json(), indent=1) + "\n"
    if output is None:
        click.echo(text, nl=False)
    else:
        write_atomically(output, text)
    return 0


def _build(ctx: click.Context, _parameter: click.Parameter, folder: Path | None) -> None:
    """Build the program and end, before a scene is required."""
    if folder is None or ctx.resilient_parsing:
        return
    from exactpt.cgal import build_program

    print_error(f"building cgal_check in {folder}, which takes a minute")
    program = build_program(folder)
    print_output(f"export EXACTPT_CGAL_CHECK={shlex.quote(str(program.resolve()))}")
    ctx.exit()


def _write_checker(ctx: click.Context, option: click.Parameter, path: Path | None) -> None:
    """Write a checker of proofs or certificates and end, before a scene is required."""
    if path is None or ctx.resilient_parsing:
        return
    from exactpt import check_apart, proof_check
    from exactpt.files import write_atomically

    is_apart = option.name == "write_apart"
    kind = "CERTIFICATE" if is_apart else "PROOF"
    content = Path(check_apart.__file__ if is_apart else proof_check.__file__).read_bytes()
    write_atomically(path, content)
    print_output(f"{hashlib.sha256(content).hexdigest()}  {path}")
    print_error(f"run it as: python3 -I {path} SCENE {kind}")
    ctx.exit()


def _begins_as_certificate(path: Path) -> bool:
    """Return True for a file, not a pipe, that exactpt collide --certificate has written."""
    if not path.is_file():
        return False
    with path.open("rb") as file:
        return file.read(13) == b"exactpt-apart"


def _check_by_both(path: Path, *, quiet: bool, max_seconds: float | None) -> int:
    """Have two checkers verify the proofs in a folder, or a certificate; they must agree.

    Where cgal_check is not installed, a certificate is verified by one.
    """
    from exactpt import check_apart, proof_check
    from exactpt.cgal import check_proof, check_proofs, find_program
    from exactpt.files import read_bytes
    from exactpt.proof.emit import beside

    checker: Any = proof_check if path.is_dir() else check_apart
    try:
        if path.is_dir():
            by_python = str(checker.check_chain(path))
        else:
            by_python = str(checker.check(read_bytes(beside(path)), read_bytes(path)))
    except checker.Rejected as rejected:
        by_python = str(rejected)
    except checker.NoProofError as refused:
        raise InputError(f"{path}: {refused}") from None
    except checker.Exhausted as exhausted:
        raise BudgetExceeded(str(exhausted), None) from None
    accepted, lines, agree = by_python.startswith("accepted: "), [by_python], True
    try:
        find_program()
    except InputError as missing:
        if path.is_dir():
            raise
        print_error(f"verified by one checker: {missing}")
    else:
        check = check_proofs if path.is_dir() else partial(check_proof, beside(path))
        verdict = check(path, max_seconds=max_seconds)
        agree = by_python == verdict.line if accepted else not verdict.accepted
        lines.append(f"cgal_check {'agrees' if agree else 'DISAGREES: ' + verdict.line}")
    if not quiet:
        print_output(*lines)
    return 0 if accepted and agree else 1


@click.command()
@SCENE
@click.option(
    "--write-checker",
    metavar="FILE",
    type=click.Path(path_type=Path, dir_okay=False),
    is_eager=True,
    expose_value=False,
    callback=_write_checker,
    help="Write the checker of proofs, one file of Python, to this path instead.",
)
@click.option(
    "--write-apart",
    metavar="FILE",
    type=click.Path(path_type=Path, dir_okay=False),
    is_eager=True,
    expose_value=False,
    callback=_write_checker,
    help="Write the checker of certificates, one file of Python, to this path instead.",
)
@click.option(
    "--build",
    metavar="DIR",
    type=click.Path(path_type=Path, file_okay=False),
    is_eager=True,
    expose_value=False,
    callback=_build,
    help="Build cgal_check in this folder instead, and say how to have it found.",
)
@click.option("--json", "as_json", is_flag=True, help="Print the report as JSON.")
@QUIET
@TILING
@budget
def check(
    scene: Path,
    as_json: bool,
    quiet: bool,
    tiling: str,
    max_events: int | None,
    max_seconds: float | None,
) -> int:
    """Have an independent program verify a proof, every tiling and every event time.

    Of a folder that exactpt simulate --proof has written: have two checkers verify its proofs,
    and that each part goes on where the one before ends. Of a certificate that exactpt collide
    --certificate has written, with FILE.scene.json beside it: have both verify it.

    \b
    Examples:
      exactpt check scene.json
      exactpt check contact.apart
      exactpt check scene.json --json
      exactpt check folder
      exactpt check --write-checker check.py
      exactpt check scene.json --quiet && echo "CGAL agrees"
      eval "$(exactpt check --build ~/.cache/exactpt/cgal_check)"

    This needs the program cgal_check: the one that EXACTPT_CGAL_CHECK names, that of the
    checkout (make test builds it), or one on PATH. --build builds it from the sources that
    come with the package; on Debian and Ubuntu, after
    apt-get install g++ cmake make libcgal-dev nlohmann-json3-dev.
    """
    from exactpt.check import check_scene

    if scene.is_dir() or _begins_as_certificate(scene):
        with within_budget(max_seconds):
            return _check_by_both(scene, quiet=quiet, max_seconds=max_seconds)
    try:
        with within_budget(max_seconds):
            given = load(scene)
            with progress(given, "checking", quiet=quiet) as reached:
                report = check_scene(
                    given,
                    tiling=tiling,
                    scene_file=scene.read_bytes(),
                    max_events=max_events,
                    max_seconds=max_seconds,
                    reached=reached,
                )
    except BudgetExceeded as spent:
        if as_json and not quiet:
            reached_by = None if spent.reached is None else str(rational(spent.reached))
            click.echo(json.dumps({"ok": None, "reached": reached_by}))
        raise
    if not quiet:
        print_output(
            *(json.dumps(report.to_json(), indent=1).split("\n") if as_json else report.lines())
        )
    return 0 if report.ok else 1
