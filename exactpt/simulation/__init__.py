"""A scene that runs: events as they happen, the tiling at any time, the first contact."""
