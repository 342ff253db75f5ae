"""collide --all and --enclosed: all intervals of contact; bounds of the first contact's time."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Final

import click
from click.core import ParameterSource

from exactpt.cli.options import load, within_budget
from exactpt.cli.terminal import bounds_in_words, intervals_in_words
from exactpt.errors import InputError
from exactpt.kernel.numbers import QQ

TOGETHER: Final = {
    "scene", "as_json", "until", "exit_code", "max_seconds", "max_memory", "max_bytes"
}  # fmt: skip
"""Options that go together with --all, and with --enclosed."""


def collide_all(
    path: Path, until: QQ | None, *, as_json: bool, exit_code: bool, max_seconds: float | None
) -> int:
    """Print all intervals of contact; the exit code."""
    from exactpt.search.intervals import contacts

    _check_alone("every")
    with within_budget(max_seconds):
        scene = load(path, until)
        found = contacts(scene)
        lines = intervals_in_words(scene, found)
        answer = {"intervals": [i.to_json() for i in found], "until": str(scene.exact_end)}
    click.echo(json.dumps(answer, indent=1) if as_json else "\n".join(lines))
    return 1 if exit_code and found else 0


def collide_enclosed(
    path: Path, until: QQ | None, *, as_json: bool, exit_code: bool, max_seconds: float | None
) -> int:
    """Print bounds of the first contact, bodies turning at their true rates; the exit code."""
    from exactpt.search.enclosed import first_contact_enclosed

    _check_alone("enclosed")
    with within_budget(max_seconds):
        scene = load(path, until)
        found = first_contact_enclosed(scene)
        lines = bounds_in_words(scene, found)
        answer = {"enclosed": found and found.to_json(), "until": str(scene.exact_end)}
    click.echo(json.dumps(answer, indent=1) if as_json else "\n".join(lines))
    return 1 if exit_code and found is not None else 0


def _check_alone(option_name: str) -> None:
    """Refuse options that cannot be combined with the given one."""
    context = click.get_current_context()
    option = {str(p.name): p.opts[-1] for p in context.command.params}
    for name, written in option.items():
        source = context.get_parameter_source(name)
        if name not in {*TOGETHER, option_name} and source is ParameterSource.COMMANDLINE:
            raise InputError(
                f"{option[option_name]}: {written} is supported only for the first contact"
            )
