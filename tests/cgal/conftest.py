"""The witness as a fixture. Where the program is missing the tests fail: they are not skipped."""

import pytest

from exactpt.cgal import CgalCheck, find_program
from exactpt.errors import InputError


@pytest.fixture(scope="session")
def program():
    try:
        return find_program()
    except InputError as error:
        return pytest.fail(str(error))


@pytest.fixture(scope="module")
def witness(program):
    with CgalCheck(program) as running:
        yield running
