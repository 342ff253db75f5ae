"""Topology: a planar map of half-edges, without coordinates or time."""
