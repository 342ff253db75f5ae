"""The collector rests within the context, and is afterwards what it was before."""

import gc

import pytest

from exactpt.kernel.collection import collector_at_rest


@pytest.fixture(autouse=True)
def _as_it_was():
    was_on = gc.isenabled()
    yield
    (gc.enable if was_on else gc.disable)()


def fail_within():
    with collector_at_rest():
        with collector_at_rest():
            assert not gc.isenabled()
        assert not gc.isenabled()
        raise ValueError("within")


@pytest.mark.parametrize("was_on", [True, False])
def test_it_is_afterwards_what_it_was(was_on):
    (gc.enable if was_on else gc.disable)()

    with pytest.raises(ValueError, match="within"):
        fail_within()

    assert gc.isenabled() is was_on
