"""Questions about the plane around the bodies at one time: where, what next, which way."""
