"""Points over time: motions, bodies, and the tracks of their vertices."""
