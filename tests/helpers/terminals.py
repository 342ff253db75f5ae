"""A terminal and a progress bar that tests can look at."""

import io


class Terminal(io.StringIO):
    def isatty(self):
        return True


class Bar:
    """A progress bar that appends its positions to a list."""

    def __init__(self, shown):
        self.pos = 0
        self._shown = shown

    def __enter__(self):
        return self

    def __exit__(self, *_):
        return None

    def update(self, steps):
        self.pos += steps
        self._shown.append(self.pos)
