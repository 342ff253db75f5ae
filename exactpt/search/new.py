"""When two bodies that touch at the start come into a new contact.

They do when they touch after they have parted, or when they begin to overlap: just after a time
they do, just before it they did not (at the start of the time span: then they did not). Whether two
bodies intersect or overlap changes only at times of incidences (`exactpt.search.intervals`): a
rational time between any two consecutive ones decides for all times between.
"""

from __future__ import annotations

from itertools import chain

from exactpt.kernel.algebraic import AlgebraicNumber, rational_between
from exactpt.kernel.numbers import QQ
from exactpt.motion.body import Body
from exactpt.pair.overlap import bodies_meet, overlap
from exactpt.search.intervals import incidence_times


def new_contact_time(a: Body, b: Body, start: QQ, end: QQ) -> AlgebraicNumber | None:
    """Return the first time of a new contact of two bodies that touch at the start, or None.

    It is the start itself if the bodies only touch there and overlap just after it. Bodies that
    overlap at the start count again only when they have parted, or have only touched.
    """
    last = AlgebraicNumber(start)
    overlaps = overlap(a, b, start)
    stop = AlgebraicNumber(end)
    for time in chain(incidence_times(a, b, start, end), (stop,)):
        if time.compare(last) <= 0:
            return None  # the end, once more
        between = rational_between(last, time)
        if not bodies_meet(a, b, between):
            if time.compare(stop) < 0 or bodies_meet(a, b, end):
                return time
            return None
        if overlap(a, b, between) and not overlaps:
            return last
        overlaps = overlap(a, b, between)
        last = time
    return None
