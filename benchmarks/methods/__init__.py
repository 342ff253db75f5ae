"""Methods that find a first contact: those of exactpt, and those of other programs."""
