"""Doors for tests that look inside: the audit of a run, a clock that ends limits of time."""

import threading
import time

import pytest

from exactpt import AuditError, Body, BudgetExceeded, Scene, Simulation, first_contact, testing
from exactpt.testing import audit, ending_at
from exactpt.testing.scenes import generate
from fuzz.planted import PLANTED


def audited_steps(scene, tiling):
    """Audit a run at its start and after each step; return the number of steps."""
    run = Simulation(scene, tiling=tiling)
    audit(run)
    steps = 0
    while run.step():
        audit(run)
        steps += 1
    return steps


@pytest.mark.parametrize("tiling", ["lazy", "greedy", "mixed"])
def test_audit_run_of_a_family_passes_after_each_step(tiling):
    assert audited_steps(generate("mixed_shapes", 2), tiling) > 3


@pytest.mark.plain
def test_audit_run_with_lost_certificates_raises():
    missing = pytest.raises(AuditError, match="certificates missing or superfluous")
    with PLANTED["events dropped"].made(), missing:
        audited_steps(generate("mixed_shapes", 2), "lazy")


def test_audit_contact_at_the_start_has_no_tiling():
    square = [(0, 0), (2, 0), (2, 2), (0, 2)]
    run = Simulation(Scene([Body("a", square), Body("b", square)], (0, 1)), tiling="lazy")

    audit(run)

    assert run.contact is not None


def test_ending_at_each_look_in_turn_ends_a_search_there():
    with ending_at(None) as whole:
        first_contact(generate("row", 3), max_seconds=1)

    ended = []
    for look in range(1, whole.looks + 1):
        with ending_at(look) as clock:
            try:
                first_contact(generate("row", 3), max_seconds=1)  # a scene keeps what was read
            except BudgetExceeded:
                ended.append(clock.looks_after)

    # The limit begins at the first look, so a clock that strikes there ends it at the second.
    assert ended == [1] + [0] * (whole.looks - 1)


def test_ending_at_leaves_searches_without_a_limit_alone():
    scene = generate("row", 3)

    with ending_at(1):
        contact = first_contact(scene)

    assert contact == first_contact(scene)


def test_ending_at_other_threads_and_later_calls_have_the_real_time():
    real, seen = time.monotonic, []
    with ending_at(2):
        thread = threading.Thread(target=lambda: seen.append(time.monotonic()))
        thread.start()
        thread.join()
        assert time.monotonic() == 0.0

    assert time.monotonic is real
    assert 0.0 < seen[0] <= time.monotonic()


def test_name_that_testing_does_not_have_is_an_attribute_error():
    with pytest.raises(AttributeError, match=r"exactpt\.testing' has no attribute 'no_such"):
        testing.no_such_name  # noqa: B018 - it raises
