"""Constants of rounding and sums without error: doubles only, below exact numbers."""
