"""The tier of the laws: the cases of `make quick`, those of `make test`, or of --laws."""

import pytest

from fuzz.laws.runner import TIERS


@pytest.fixture
def tier(request):
    default = "quick" if request.config.getoption("--quick") else "full"
    name = request.config.getoption("--laws") or default
    if name not in TIERS:
        raise pytest.UsageError(f"--laws: unknown tier, got {name!r}; known: {', '.join(TIERS)}")
    return name
