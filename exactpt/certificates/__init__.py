"""Certificates of moving vertices: signs just after now and times of failure. No mesh.

Public names, for your own kinetic data structures (docs/howto/kinetic.md): `CertificateQueue`,
and the polynomials of moving points, `orientation`, `x_order` and `squared_distance`.
"""

from exactpt.certificates.kinetic import CertificateQueue
from exactpt.certificates.moving_points import (
    MovingPoint,
    orientation,
    squared_distance,
    x_order,
)

__all__ = ["CertificateQueue", "MovingPoint", "orientation", "squared_distance", "x_order"]
