"""Properties that are computed once, without a lock.

Before Python 3.12 `functools.cached_property` has one lock for all instances of a class. A child
that is forked while another thread computes such a property inherits the lock, and nobody in the
child releases it: the child hangs at its first use of the property.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, Generic, Self, TypeVar, final, overload

T = TypeVar("T")


@final
class cached_property(Generic[T]):  # noqa: N801 - the name that it has in functools
    """A property that is computed at its first use, and is an entry of the instance from then on.

    Two threads may compute it at the same time. The value must therefore be pure: it depends on
    nothing that changes. All threads get the value that was stored first.

    >>> class Square:
    ...     side = 3
    ...
    ...     @cached_property
    ...     def area(self):
    ...         return self.side**2
    >>> square = Square()
    >>> square.area, vars(square)
    (9, {'area': 9})

    Args:
        compute: the method that returns the value.
    """

    def __init__(self, compute: Callable[[Any], T]) -> None:
        self._compute = compute
        self._name = compute.__name__
        self.__doc__ = compute.__doc__

    def __set_name__(self, owner: type, name: str) -> None:
        self._name = name

    @overload
    def __get__(self, instance: None, owner: type) -> Self: ...

    @overload
    def __get__(self, instance: object, owner: type) -> T: ...

    def __get__(self, instance: object | None, owner: type) -> Self | T:
        if instance is None:
            return self
        # Python looks in the instance first: from now on this method is not called for it.
        value: T = vars(instance).setdefault(self._name, self._compute(instance))
        return value
