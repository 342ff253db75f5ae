"""Scenes, the input of every run: bodies and a time span, and their file format."""
