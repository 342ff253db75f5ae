"""The truth that others test against: hard questions about two bodies, and certain answers.

`check` calls any function for the time of impact of two bodies, over families of hard
questions (`FAMILIES`), and counts right, missed, invented, early, late and crashed; what
it finds is shrunken, and becomes a pytest file. `assert_same_contact` compares one answer;
`shrink` makes a scene smaller as long as something fails. `exactpt.testing.strategies` has what
Hypothesis draws scenes from (pip install 'exactpt[testing]'). docs/testing.md is the tutorial.
"""

from importlib import import_module

from exactpt.testing.checking import Counterexample, Report, check
from exactpt.testing.comparing import assert_same_contact
from exactpt.testing.families import FAMILIES, LINEAR, make_question
from exactpt.testing.questions import Moving, Question
from exactpt.testing.shrinking import shrink
from exactpt.testing.table import Table
from exactpt.testing.truth import Truth, truths

__all__ = [
    "FAMILIES",
    "LINEAR",
    "Counterexample",
    "Moving",
    "Question",
    "Report",
    "Table",
    "Truth",
    "assert_same_contact",
    "check",
    "make_question",
    "shrink",
    "truths",
]


def __getattr__(name: str) -> object:
    """Return the subpackage `space` or the module `strategies`, imported on first use (PEP 562)."""
    if name in ("space", "strategies"):
        return import_module(f"exactpt.testing.{name}")
    raise AttributeError(f"module {__name__!r} has no attribute {name!r}")


def __dir__() -> list[str]:
    return sorted({*__all__, "space", "strategies"})
