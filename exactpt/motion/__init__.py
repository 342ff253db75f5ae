"""Points over time: motions, bodies, and the trajectories of their vertices."""
