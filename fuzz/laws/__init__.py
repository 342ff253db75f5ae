"""Laws: what must be equal, in which scenes; one table, one runner.

A law is a row of `fuzz.laws.table`. Its cases are texts, ``LAW SOURCE:SEED:NUMBER``: pytest,
``python -m fuzz run`` and the nightly job differ only in the seed and in the number of cases.
"""
