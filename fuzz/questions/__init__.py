"""Questions beside the first contact, against their definitions."""
