"""Shapes that others keep in their files and libraries, as bodies at rest, and back."""
