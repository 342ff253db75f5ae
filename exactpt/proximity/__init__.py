"""Two bodies over time: distance, clearance, and the intervals in which they meet."""
