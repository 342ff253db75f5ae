"""The name under which pickles of 0.2 know `exactpt.pairs.approach`."""

from exactpt.pairs.approach import Approach

__all__ = ["Approach"]
