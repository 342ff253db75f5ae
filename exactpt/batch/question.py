"""The module in which `Options` stood in 0.2: pickles of that version contain its name."""

from exactpt.batch.options import Options as Question

__all__ = ["Question"]
