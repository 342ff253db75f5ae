"""Hostile input: damaged files of every format, read by every command and reader.

Each is read or refused, in one line and with exit code 2, within bounds of time and memory.
"""
