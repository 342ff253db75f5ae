"""The names under which pickles of 0.2 have answers of `exactpt.pairs`."""

import sys

from exactpt.pairs import clearance, distance, features, intervals

for _module in (clearance, distance, features, intervals):
    sys.modules[_module.__name__.replace(".pairs.", ".proximity.")] = _module
