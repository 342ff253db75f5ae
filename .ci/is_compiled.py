"""Fails unless the installed exactpt is compiled: a wheel must not be plain by accident."""

import sys

from exactpt.planar import halfedge

sys.exit(None if halfedge.__file__.endswith((".so", ".pyd")) else f"plain: {halfedge.__file__}")
