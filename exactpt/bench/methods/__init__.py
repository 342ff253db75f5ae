"""Ways to find a first contact: those of exactpt, and what a user would pick instead."""
