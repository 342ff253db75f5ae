"""Time: event times, and the queue that orders them. Knows no geometry."""
