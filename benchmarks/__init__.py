"""Benchmarks: speed and accuracy, in comparison with other programs."""
