"""collide --all: every interval of time in which two bodies meet."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Final

import click
from click.core import ParameterSource

from exactpt.cli.alarm import time_limit
from exactpt.cli.options import load, max_memory
from exactpt.cli.words import intervals_in_words
from exactpt.errors import InputError
from exactpt.kernel.numbers import QQ

__all__ = ["collide_all"]

TOGETHER: Final = {
    "scene", "every", "as_json", "until", "exit_code", "max_seconds", "max_memory", "max_bytes"
}  # fmt: skip
"""Options that go together with --all."""


def collide_all(
    path: Path, until: QQ | None, *, as_json: bool, exit_code: bool, max_seconds: float | None
) -> int:
    """Print all intervals of contact; the exit code."""
    from exactpt.proximity.intervals import contacts

    _check_alone(click.get_current_context())
    with time_limit(max_seconds, max_memory()):
        scene = load(path, until)
        found = contacts(scene)
        told = intervals_in_words(scene, found)
        answer = {"intervals": [i.to_json() for i in found], "until": str(scene._end)}
    click.echo(json.dumps(answer, indent=1) if as_json else "\n".join(told))
    return 1 if exit_code and found else 0


def _check_alone(context: click.Context) -> None:
    """Refuse options that concern the first contact alone."""
    for parameter in context.command.params:
        name = str(parameter.name)
        source = context.get_parameter_source(name)
        if name not in TOGETHER and source is ParameterSource.COMMANDLINE:
            raise InputError(f"--all: {parameter.opts[-1]} is for the first contact alone")
