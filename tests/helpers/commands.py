"""Commands of `exactpt` in this process."""

import pytest
from click.testing import CliRunner

from exactpt.cli import cli, main


def run(*arguments):
    """Return click's result of a command; errors are raised."""
    return CliRunner().invoke(cli, list(map(str, arguments)), catch_exceptions=False)


def code_of(*arguments):
    """Return the exit code of `exactpt` with these arguments; it prints as it does for a user."""
    with pytest.raises(SystemExit) as ended:
        main(list(map(str, arguments)))
    return ended.value.code
