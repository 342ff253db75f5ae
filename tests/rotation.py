"""A part of the slow tests for each date, so that all of them run within a fortnight.

The parts are balanced by seconds of one processor, of which `SECONDS` has a number for each
test function, and for those of its cases that take much longer. The numbers are samples: they
decide when a test runs, not whether.
"""

import json
from pathlib import Path

DAYS = 14
SECONDS = json.loads((Path(__file__).parent / "data" / "slow_seconds.json").read_text())
UNKNOWN = 60.0
"""Seconds of a test that is not in the list."""


def name_of(item):
    """Tests of a group share a name: they are run by one process, in their order."""
    group = item.get_closest_marker("xdist_group")
    return group.args[0] if group else item.nodeid


def seconds_of(nodeid):
    return SECONDS.get(nodeid, SECONDS.get(nodeid.split("[")[0], UNKNOWN))


def parts(seconds):
    """`DAYS` sets of names, of about equal seconds: the longest first, to what has least."""
    sets = [set() for _ in range(DAYS)]
    loads = [0.0] * DAYS
    for name in sorted(seconds, key=lambda name: (-seconds[name], name)):
        least = loads.index(min(loads))
        sets[least].add(name)
        loads[least] += seconds[name]
    return sets


def turn_of(items, date):
    """Of some tests those whose turn it is on a date, the longest first."""
    seconds = {}
    for item in items:
        name = name_of(item)
        seconds[name] = seconds.get(name, 0.0) + seconds_of(item.nodeid.partition("@")[0])
    names = parts(seconds)[date.toordinal() % DAYS]
    turn = [item for item in items if name_of(item) in names]
    return sorted(turn, key=lambda item: -seconds[name_of(item)])
