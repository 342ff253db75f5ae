"""Other programs: one file each, of which nothing else calls the program.

Each answers questions about two bodies (see `benchmarks.engines`); below "# Whole scenes" are the
calls of the benchmarks of whole scenes. The files import nothing of this project.
"""
