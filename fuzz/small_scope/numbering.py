"""Numbers in an evenly spread order: any initial part of it covers all ranges."""

from __future__ import annotations

from functools import cache
from math import gcd

__all__ = ["mixed", "spread"]


@cache
def _stride(n: int) -> int:
    """A number coprime to n, near its golden section."""
    stride = n * 618_034 // 1_000_000
    while gcd(stride, n) != 1:
        stride += 1
    return stride


def spread(i: int, n: int) -> int:
    """The i-th number below n; any n consecutive i give each number once."""
    return i * _stride(n) % n


def mixed(i: int) -> int:
    """A number below 2^32 whose bits are nearly independent of those of i."""
    i = (i + 1) * 0x9E3779B97F4A7C15 & 0xFFFF_FFFF_FFFF_FFFF
    i = (i ^ i >> 31) * 0xBF58476D1CE4E5B9 & 0xFFFF_FFFF_FFFF_FFFF
    return i >> 32
