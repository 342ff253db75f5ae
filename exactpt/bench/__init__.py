"""Benchmarks: how fast, how exact, and beside what a user would pick instead."""
