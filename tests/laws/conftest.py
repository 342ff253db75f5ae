"""The tier of the laws: the cases of `make quick`, or those of `make test`."""

import pytest


@pytest.fixture
def tier(request):
    return "quick" if request.config.getoption("--quick") else "full"
