"""Questions about pairs of bodies: first contacts, approaches, distances, intervals."""
