"""Temporary changes of one function: of its text, or of the whole function."""

from __future__ import annotations

import ast
import contextlib
import inspect
import textwrap
from collections.abc import Callable, Iterator
from contextlib import AbstractContextManager
from dataclasses import dataclass
from pathlib import Path
from types import FunctionType
from typing import Any, Final, NamedTuple
from unittest.mock import patch

from exactpt.errors import InputError
from fuzz.power.probe import NAME, PROBE, insert_probe, probed

__all__ = ["Edit", "Function", "Lines", "Replacement"]

Function = Callable[..., Any]

ROOT: Final = Path(__file__).parents[2]


class Lines(NamedTuple):
    """Lines of a file of the package.

    Attributes:
        file: the file, relative to the checkout.
        first, last: the numbers of the lines.
    """

    file: str
    first: int
    last: int

    def __str__(self) -> str:
        return f"{self.file}:{self.first}"


@dataclass(frozen=True, slots=True)
class Edit:
    """A function, or the one of a property, has another text, of which one part is replaced.

    The code of the function is exchanged, not the function: whoever has imported it by name makes
    the mistake too. A text outlives renumbered lines and renamed modules.

    Attributes:
        owner: the module or class.
        name: the name of the function in it.
        old, new: the part, which is there once, and what it is replaced by.
    """

    owner: Any
    name: str
    old: str
    new: str

    def _function(self) -> FunctionType:
        return _function(getattr(self.owner, self.name))

    def _text(self) -> str:
        """Return the text of the function.

        Raises:
            InputError: unless it has the old part once.
        """
        text = textwrap.dedent(inspect.getsource(self._function()))
        if text.count(self.old) != 1:
            times = f"{self.name} has {text.count(self.old)} times the text {self.old!r}"
            raise InputError(f"planted: {times}")
        return text

    @property
    def lines(self) -> Lines:
        """The lines of the old part."""
        function, text = self._function(), self._text()
        _, start = inspect.getsourcelines(function)
        first = start + text[: text.index(self.old)].count("\n")
        return Lines(_file_of(function), first, first + self.old.count("\n"))

    @contextlib.contextmanager
    def made(self) -> Iterator[None]:
        """A context in which the function has the other text, and sets the probe there."""
        right, made = self._function(), dict[str, Any]()
        text = self._text()
        tree = ast.parse(text.replace(self.old, self.new))
        (function,) = tree.body
        assert isinstance(function, ast.FunctionDef)  # noqa: S101 - the text of a function
        insert_probe(function, 1 + text[: text.index(self.old)].count("\n"))
        exec(compile(tree, f"<{self.name}, planted>", "exec"), right.__globals__, made)
        code = right.__code__
        right.__globals__[NAME] = PROBE
        right.__code__ = _function(made[self.name]).__code__
        try:
            yield
        finally:
            right.__code__ = code
            del right.__globals__[NAME]


@dataclass(frozen=True, slots=True)
class Replacement:
    """A function is replaced by a wrong one made from it.

    Attributes:
        owner: the module or class.
        name: the name of the function in it.
        make: makes the wrong function of the right one.
    """

    owner: Any
    name: str
    make: Callable[[Function], Function]

    @property
    def lines(self) -> Lines:
        """The lines of the body of the function."""
        function: FunctionType = inspect.unwrap(getattr(self.owner, self.name))
        code = function.__code__
        numbers = [line for *_, line in code.co_lines() if line and line > code.co_firstlineno]
        return Lines(_file_of(function), min(numbers), max(numbers))

    def made(self) -> AbstractContextManager[object]:
        """A context in which the function is replaced."""
        wrong = probed(self.make(getattr(self.owner, self.name)))
        replaced: AbstractContextManager[object] = patch.object(self.owner, self.name, wrong)
        return replaced


def _function(found: Function | property) -> FunctionType:
    """Return a function without its decorators, or the one that gets a property."""
    getter = found.fget if isinstance(found, property) else found
    assert getter is not None  # noqa: S101 - a property without it has no text
    function: FunctionType = inspect.unwrap(getter)
    return function


def _file_of(function: FunctionType) -> str:
    return str(Path(function.__code__.co_filename).relative_to(ROOT))
