"""tile and check: the tiling at a time, and the verdict of CGAL on all tilings of a run."""

from __future__ import annotations

import hashlib
import json
import shlex
from dataclasses import dataclass
from pathlib import Path
from typing import Any, NamedTuple

import click

from exactpt.brief import cut_words
from exactpt.cli.options import (
    QUIET,
    RATIONAL,
    SCENE,
    TILING,
    budget,
    fan_option,
    keep_input,
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
@fan_option('Require "fan", the edges of the fan triangulation that the tiling lacks')
@output("Write to a file.")
@budget
def tile(
    scene: Path,
    at: QQ | None,
    by_running: bool,
    tiling: str,
    fan: bool,
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
      exactpt tile points.json --fan
    """
    from exactpt.files import write_atomically
    from exactpt.simulation.tile import tile_at

    keep_input(scene, output)
    with within_budget(max_seconds), naming_at():
        given = load(scene)
        snapshot = tile_at(
            given,
            given.exact_start if at is None else at,
            tiling=tiling,
            by_running=by_running,
            fan=fan,
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
    from exactpt.files import write_atomically
    from exactpt.proof.handout import checker_file

    is_apart = option.name == "write_apart"
    kind = "CERTIFICATE" if is_apart else "PROOF"
    content = checker_file("check_apart" if is_apart else "proof_check")
    write_atomically(path, content)
    print_output(f"{hashlib.sha256(content).hexdigest()}  {path}")
    print_error(f"run it as: python3 -I {path} SCENE {kind}")
    ctx.exit()


def _begins_with(path: Path, word: bytes) -> bool:
    """Return True for a file, not a pipe, that begins with a word."""
    if not path.is_file():
        return False
    with path.open("rb") as file:
        return file.read(len(word)) == word


class _ProofFiles(NamedTuple):
    """The file of a scene, and that of its proof or certificate."""

    scene: Path
    proof: Path


def _files_of_proof(scene: Path, proof: Path | None) -> _ProofFiles | None:
    """Return the files of a proof or certificate; None to check a scene.

    A proof that is given alone has its scene beside it.

    Raises:
        InputError: if there is none beside it.
    """
    from exactpt.proof.emit import beside

    if proof is not None:
        return _ProofFiles(scene, proof)
    is_proof = _begins_with(scene, b"exactpt-proof")
    if not is_proof and not _begins_with(scene, b"exactpt-apart"):
        return None
    if not beside(scene).is_file():
        kind = "proof" if is_proof else "certificate"
        raise InputError(
            f"{scene}: a {kind} needs its scene, and {beside(scene).name} is not beside it: "
            f"exactpt check SCENE {scene}"
        )
    return _ProofFiles(beside(scene), scene)


@dataclass(frozen=True)
class _Verdict:
    """The verdict of two checkers about a proof.

    Attributes:
        accepted: True if both accept it.
        statement: the proved statement, or the reason of the rejection, by the checker in Python.
        by_cgal: the verdict of `cgal_check`: "agrees", or "DISAGREES: ..."; None if it is not
            installed.
        why: the reason why it is not found.
    """

    accepted: bool
    statement: str
    by_cgal: str | None
    why: str = ""

    def lines(self) -> list[str]:
        """Return the verdict in words, in which long names are cut."""
        lines = [self.statement]
        if self.by_cgal is not None:
            lines.append(f"cgal_check {self.by_cgal}")
        return list(map(cut_words, lines))

    def to_json(self) -> dict[str, object]:
        """Return the verdict as a JSON object, see docs/format.md."""
        return {"ok": self.accepted, "statement": self.statement, "cgal_check": self.by_cgal}


def _verdict_of_both(given: Path | _ProofFiles, max_seconds: float | None) -> _Verdict:
    """Have two checkers verify the proofs in a folder, or a proof of a scene; they must agree.

    Where cgal_check is not installed, a certificate or a proof is verified by one.
    """
    from exactpt.cgal import check_proof, check_proofs, find_program

    statement = _statement_by_python(given)
    accepted = statement.startswith("accepted: ")
    try:
        find_program()
    except InputError as missing:
        if isinstance(given, Path):
            raise
        return _Verdict(accepted, statement, None, str(missing))
    if isinstance(given, _ProofFiles):
        verdict = check_proof(given.scene, given.proof, max_seconds=max_seconds)
    else:
        verdict = check_proofs(given, max_seconds=max_seconds)
    agrees = statement == verdict.line if accepted else not verdict.accepted
    by_cgal = "agrees" if agrees else f"DISAGREES: {verdict.line}"
    return _Verdict(accepted and agrees, statement, by_cgal)


def _statement_by_python(given: Path | _ProofFiles) -> str:
    """Return the statement that the checker in Python accepts, or its reason to reject a proof."""
    from exactpt import check_apart, proof_check
    from exactpt.files import read_bytes

    file = given.proof if isinstance(given, _ProofFiles) else given
    checker: Any = check_apart if _begins_with(file, b"exactpt-apart") else proof_check
    try:
        if isinstance(given, _ProofFiles):
            return str(checker.check(read_bytes(given.scene), read_bytes(given.proof)))
        return str(checker.check_chain(given))
    except checker.Rejected as rejected:
        return str(rejected)
    except checker.NoProofError as refused:
        raise InputError(f"{file}: {refused}") from None
    except checker.Exhausted as exhausted:
        raise BudgetExceeded(str(exhausted), None) from None


@click.command()
@SCENE
@click.argument("proof", type=click.Path(path_type=Path), metavar="[PROOF]", required=False)
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
    proof: Path | None,
    as_json: bool,
    quiet: bool,
    tiling: str,
    max_events: int | None,
    max_seconds: float | None,
) -> int:
    """Have independent programs verify a proof, or of a scene every tiling and event time.

    A scene is simulated; cgal_check verifies a proof of it, every tiling and every event time. A
    proof or a certificate that exactpt collide --proof or --certificate has written is verified
    by two checkers; if its scene is not given, it is FILE.scene.json beside it. So are all proofs
    in a folder that exactpt simulate --proof has written, each of which must go on where the one
    before ends.

    \b
    Examples:
      exactpt check scene.json
      exactpt check scene.json contact.proof
      exactpt check contact.apart --json
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

    if scene.is_dir() and proof is not None:
        raise InputError(f"{scene}: a folder has its own proofs, leave {proof} out")
    files = scene if scene.is_dir() else _files_of_proof(scene, proof)
    if files is not None:
        with within_budget(max_seconds):
            verdict = _verdict_of_both(files, max_seconds)
        if verdict.why:
            print_error(f"verified by one checker: {verdict.why}")
        if not quiet:
            print_output(*([json.dumps(verdict.to_json())] if as_json else verdict.lines()))
        return 0 if verdict.accepted else 1
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
