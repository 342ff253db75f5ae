"""First contacts of a scene: the choice of the search, and the search by a tiling."""

import sys

from exactpt.pairs import contact, incidences

for _module in (contact, incidences):  # pickles of 0.2 have their names in this package
    sys.modules[_module.__name__.replace(".pairs.", ".collision.")] = _module
