"""Many small cases in one test: a loop that reports every miss."""

import functools
import inspect

import pytest


def every(names, cases):
    """Run a test for each of some cases, as `pytest.mark.parametrize` does, but as one test.

    Fixtures of the test are made once.

    Raises:
        BaseExceptionGroup: what failed, each with its case as a note; all cases have run.
    """
    names = [name.strip() for name in names.split(",")]

    def fold(test):
        @functools.wraps(test)
        def folded(**fixtures):
            misses = []
            for case in cases:
                values = case if len(names) > 1 else (case,)
                try:
                    test(**dict(zip(names, values, strict=True)), **fixtures)
                except (Exception, pytest.fail.Exception, BaseExceptionGroup) as miss:
                    miss.add_note(f"case: {', '.join(map(repr, values))}")
                    misses.append(miss)
            if misses:
                raise BaseExceptionGroup(f"{len(misses)} of {len(cases)} cases", misses)

        signature = inspect.signature(test)
        others = [p for name, p in signature.parameters.items() if name not in names]
        folded.__signature__ = signature.replace(parameters=others)
        return folded

    return fold
