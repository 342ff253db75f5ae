"""Two bodies, decided exactly and without a search: at one time, and features over time."""
