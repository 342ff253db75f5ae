"""The truth that others test against: hard questions about two bodies, and certain answers.

`check` calls any function for the time of impact of two bodies, over families of hard
questions (`FAMILIES`), and counts right, missed, invented, early, late and crashed; what
it finds is shrunken, and becomes a pytest file. `assert_same_contact` compares one answer;
`shrink` makes a scene smaller as long as something fails. `audit` compares the state of a run with
the tiling built from nothing; `ending_at` ends a limit of time at a chosen look at the clock.
`exactpt.testing.reference` answers from definitions, and `exactpt.testing.agreement` compares
answers of exactpt with these. `exactpt.testing.strategies` has what Hypothesis draws scenes from
(pip install 'exactpt[testing]'), and `exactpt.testing.scenes` the families of scenes of
``exactpt generate``. docs/testing.md is the tutorial.
"""

from importlib import import_module
from typing import TYPE_CHECKING, Final

if TYPE_CHECKING:
    from exactpt.testing.audits import audit
    from exactpt.testing.checking import Counterexample, Report, check
    from exactpt.testing.comparing import assert_same_contact
    from exactpt.testing.ending import ending_at
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
    "audit",
    "check",
    "ending_at",
    "make_question",
    "shrink",
    "truths",
]

_MODULE_OF: Final = {
    "Counterexample": "checking",
    "Report": "checking",
    "check": "checking",
    "assert_same_contact": "comparing",
    "audit": "audits",
    "ending_at": "ending",
    "FAMILIES": "families",
    "LINEAR": "families",
    "make_question": "families",
    "Moving": "questions",
    "Question": "questions",
    "shrink": "shrinking",
    "Table": "table",
    "Truth": "truth",
    "truths": "truth",
}
"""Names are imported on first use: whoever generates a scene needs none of them."""

_PARTS: Final = ("agreement", "reference", "scenes", "space", "strategies")
"""Subpackages and modules that are public by themselves."""


def __getattr__(name: str) -> object:
    """Return a public name or part of the package, imported on first use (PEP 562)."""
    if name in _PARTS:
        return import_module(f"exactpt.testing.{name}")
    if name in _MODULE_OF:
        return getattr(import_module(f"exactpt.testing.{_MODULE_OF[name]}"), name)
    raise AttributeError(f"module {__name__!r} has no attribute {name!r}")


def __dir__() -> list[str]:
    return sorted({*__all__, *_PARTS})
