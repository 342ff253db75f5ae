"""Queries about the free space at one time: point location, ray shooting, shortest paths."""
