"""The engine of version 0.2 as a witness: built once, and run in a process of its own.

`python -m fuzz.old_engine` builds it (`make old-engine`), `exactpt` of this checkout is asked the
same questions, and both answers must be the same text. It is kept until version 0.4.
"""
