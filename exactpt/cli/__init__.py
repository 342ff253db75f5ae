"""The command line: parses arguments, calls the library, prints results."""

from __future__ import annotations

import json
import sys
import tempfile
import traceback
from collections.abc import Sequence
from importlib import import_module
from pathlib import Path
from typing import Final

import click

import exactpt
from exactpt.brief import cut, cut_words
from exactpt.cli.options import SCENE_FILE
from exactpt.cli.terminal import (
    drop_standard_output,
    drop_unwritten_output,
    encodable,
    endings,
    print_error,
)
from exactpt.errors import AuditError, BudgetExceeded, InputError, RoundingError

__all__ = ["all_commands", "cli", "main"]

OK, BAD_INPUT, BROKEN, SPENT, INTERRUPTED = 0, 2, 3, 4, 130
"""Exit codes; code 1 is set by commands: a contact (collide --exit-code), or a failed check."""
LONGEST: Final = 5000
"""Maximum number of characters of a message; a word of it has at most those of `brief.LONGEST`."""


_MODULES: Final = {
    "batch": "batch", "check": "tilings", "collide": "runs", "convert": "files",
    "demo": "pictures", "draw": "pictures", "generate": "files", "judge": "truths",
    "oracle": "truths", "questions": "truths", "simulate": "runs", "tile": "tilings",
}  # fmt: skip
"""The module of each command, which is imported when the command is run, or its help shown."""


class _Commands(click.Group):
    """The group of commands; reports internal errors."""

    def list_commands(self, ctx: click.Context) -> list[str]:  # noqa: ARG002
        """Return the names of all commands."""
        return list(_MODULES)

    def get_command(self, ctx: click.Context, cmd_name: str) -> click.Command | None:  # noqa: ARG002
        """Return a command; None if there is none of this name."""
        if cmd_name not in _MODULES:
            return None
        command: click.Command = getattr(
            import_module(f"exactpt.cli.{_MODULES[cmd_name]}"), cmd_name
        )
        return command

    def invoke(self, ctx: click.Context) -> object:
        """Run a command and return its exit code, if it has one."""
        try:
            code = super().invoke(ctx)
            if sys.stdout is not None:
                sys.stdout.flush()  # a failure belongs to the command, not to the end of Python
            return code
        except BrokenPipeError:  # the reader of the output has closed the pipe
            drop_standard_output()
            return OK
        except InputError as error:
            raise _naming_file(error, ctx.meta.get(SCENE_FILE)) from None
        except (RoundingError, BudgetExceeded, MemoryError, OSError):
            raise
        except (click.exceptions.Exit, click.Abort, click.ClickException):
            raise
        except Exception as error:
            if not isinstance(error, AuditError):
                print_error(*traceback.format_exc().splitlines())
            _report_bug(error, ctx.meta.get(SCENE_FILE))
            return BROKEN


_FIRST = """\
Three commands to try:

  exactpt demo --open                     a scene of nine bodies, up to its first contact
  exactpt generate stars -o scene.json    a scene of your own
  exactpt collide scene.json              its first contact, exactly

All commands: exactpt --help"""


@click.group(
    cls=_Commands,
    invoke_without_command=True,
    context_settings={"help_option_names": ["-h", "--help"]},
)
@click.version_option(
    package_name="exactpt",
    prog_name="exactpt",
    message=f"%(prog)s, version %(version)s, {'compiled' if exactpt.__compiled__ else 'plain'}",
)
@click.pass_context
def cli(context: click.Context) -> None:
    """Exact collision detection of moving and deforming polygons in the plane.

    \b
    Examples:
      exactpt demo
      exactpt generate stars -o scene.json
      exactpt collide scene.json
      exactpt draw scene.json -o scene.html

    Tab completion of commands, options and files is enabled by (for bash; zsh and fish
    likewise):

    \b
      eval "$(_EXACTPT_COMPLETE=bash_source exactpt)"
    """
    if context.invoked_subcommand is None:
        click.echo(_FIRST)


def all_commands() -> dict[str, click.Command]:
    """Return all commands by name."""
    modules = {name: import_module(f"exactpt.cli.{module}") for name, module in _MODULES.items()}
    return {name: getattr(module, name) for name, module in modules.items()}


def _naming_file(error: InputError, scene: Path | None) -> InputError:
    """Return an error about a body with the scene file before it; others are as they were."""
    message = str(error)
    if scene is None or not message.startswith("body "):
        return error
    return InputError(f"{scene}: {message}")


def _report_bug(error: Exception, scene: Path | None) -> None:
    """Report a broken invariant, and save the scene that caused it."""
    print_error(f"exactpt: an invariant broke: {error}")
    content = _scene_of(error, scene)
    if content is not None:
        with tempfile.NamedTemporaryFile(
            "wb", prefix="exactpt-bug-", suffix=".json", delete=False
        ) as file:
            file.write(content)
        print_error(f"exactpt: the scene is saved in {file.name}")
    print_error(
        "exactpt: this is a bug in exactpt; please report it with the command and the scene"
    )


def _scene_of(error: Exception, scene: Path | None) -> bytes | None:
    """Return the scene file; the scene of the error if that is not a file."""
    if scene is not None and scene.is_file():
        return scene.read_bytes()
    if isinstance(error, AuditError) and error.scene is not None:
        return json.dumps(error.scene.to_json()).encode()
    return None


def _where_to_look(error: click.ClickException) -> str:
    context = getattr(error, "ctx", None)
    return f" (see {context.command_path} --help)" if context is not None else ""


def _cut(message: str) -> str:
    """Return a message in which each word of an argument, and the whole, is not too long."""
    return cut(cut_words(message), LONGEST)


def main(
    arguments: Sequence[str] | None = None, command: click.Command = cli, name: str = "exactpt"
) -> None:
    """Run the command line, or another command, and exit with its code."""
    given = None if arguments is None else list(arguments)
    try:
        with endings(), encodable():
            code = command.main(given, prog_name=name, standalone_mode=False)
    except click.exceptions.NoArgsIsHelpError as error:
        error.show()
        code = BAD_INPUT
    except click.ClickException as error:
        print_error(f"exactpt: {_cut(error.format_message())}{_where_to_look(error)}")
        code = BAD_INPUT
    except (InputError, RoundingError) as error:
        print_error(f"exactpt: {_cut(str(error))}")
        code = BAD_INPUT
    except (BudgetExceeded, MemoryError) as error:
        print_error(
            f"exactpt: {error if isinstance(error, BudgetExceeded) else 'memory limit exceeded'}"
        )
        code = SPENT
    except OSError as error:
        print_error(f"exactpt: {error.strerror or error}")
        drop_unwritten_output()
        code = BAD_INPUT
    except (KeyboardInterrupt, click.Abort):
        print_error("exactpt: interrupted")
        code = INTERRUPTED
    sys.exit(code if isinstance(code, int) else OK)
