"""The power of laws and of tests: which mistakes they find, made on purpose one at a time."""
