"""Former names of public arguments and attributes: they work for one minor version, and warn."""

from __future__ import annotations

from collections.abc import Callable
from functools import wraps
from typing import ParamSpec, TypeVar
from warnings import warn

P = ParamSpec("P")
R = TypeVar("R")


def warn_renamed(old: str, new: str, stacklevel: int = 3) -> None:
    """Warn the caller of the caller that a name has changed."""
    warn(f"{old}: the name is {new} now", DeprecationWarning, stacklevel=stacklevel)


def renamed(**names: str) -> Callable[[Callable[P, R]], Callable[P, R]]:
    """Return a decorator that accepts former keywords, with a `DeprecationWarning`.

    The attribute ``renamed`` of the function has them.

    Args:
        names: for each former keyword the one of today.
    """

    def decorate(function: Callable[P, R]) -> Callable[P, R]:
        @wraps(function)
        def call(*args: P.args, **keywords: P.kwargs) -> R:
            for old in keywords.keys() & names.keys():
                if names[old] in keywords:
                    raise TypeError(f"{function.__qualname__}({old}=, {names[old]}=): both are one")
                warn_renamed(f"{function.__qualname__}({old}=)", names[old])
                keywords[names[old]] = keywords.pop(old)
            return function(*args, **keywords)

        vars(call)["renamed"] = names
        return call

    return decorate
