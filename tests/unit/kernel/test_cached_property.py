"""Properties that are computed once, without a lock."""

import copy
import pickle
import threading

import pytest

from exactpt.cached_property import cached_property


class Square:
    def __init__(self, side):
        self.side, self.computed = side, 0

    @cached_property
    def area(self):
        """The area."""
        self.computed += 1
        return [self.side**2]

    double = cached_property(lambda self: 2 * self.side)


def test_a_value_is_computed_once_for_each_instance():
    three, four = Square(3), Square(4)

    assert (three.area, three.area, four.area) == ([9], [9], [16])
    assert (three.computed, three.double) == (1, 6)
    assert isinstance(Square.area, cached_property)
    assert Square.area.__doc__ == "The area."


def test_a_value_is_kept_in_copies_and_pickles():
    square = Square(3)
    square.area  # noqa: B018 - computed now

    for other in (copy.copy(square), copy.deepcopy(square), pickle.loads(pickle.dumps(square))):
        assert (other.area, other.computed) == ([9], 1)


def test_a_value_can_be_deleted_and_an_error_is_not_kept():
    square = Square(3)
    square.area  # noqa: B018
    del square.area
    assert (square.area, square.computed) == ([9], 2)

    broken = Square("x")
    for _ in range(2):
        with pytest.raises(TypeError):
            broken.area  # noqa: B018


def test_threads_that_compute_at_once_get_the_same_object():
    barrier, found = threading.Barrier(2), []

    class Slow:
        @cached_property
        def value(self):
            barrier.wait()  # both are inside
            return object()

    slow = Slow()
    threads = [threading.Thread(target=lambda: found.append(slow.value)) for _ in range(2)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()

    assert found[0] is found[1] is slow.value
