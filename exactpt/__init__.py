"""Exact kinetic pseudo-triangulations and collision detection in the plane.

>>> import exactpt
>>> box = exactpt.Body("box", [(0, 0), (2, 0), (2, 1), (0, 1)], exactpt.Translation([0, "1/2"]))
>>> wall = exactpt.Body("wall", [(4, -5), (5, -5), (5, 5), (4, 5)])
>>> contact = exactpt.first_contact(exactpt.Scene([box, wall], time=(0, 10)))
>>> contact.time, contact.kind
(AlgebraicNumber('4'), 'vertex-edge')
"""

from exactpt.collision.contact import Contact, Pair
from exactpt.collision.detector import first_contact
from exactpt.errors import AuditError, BudgetExceeded, ExactPTError, InputError
from exactpt.kernel.algebraic import AlgebraicNumber
from exactpt.kernel.polynomial import Polynomial
from exactpt.motion.body import Body
from exactpt.motion.motions import Affine, Pieces, Rigid, Translation
from exactpt.query.answers import Hit, Path, Place
from exactpt.query.space import FreeSpace
from exactpt.scene.scene import Scene
from exactpt.simulation.event import Event
from exactpt.simulation.plans import onward
from exactpt.simulation.responses import Bounce, stop
from exactpt.simulation.simulation import Simulation

__all__ = [
    "Affine",
    "AlgebraicNumber",
    "AuditError",
    "Body",
    "Bounce",
    "BudgetExceeded",
    "Contact",
    "Event",
    "ExactPTError",
    "FreeSpace",
    "Hit",
    "InputError",
    "Pair",
    "Path",
    "Pieces",
    "Place",
    "Polynomial",
    "Rigid",
    "Scene",
    "Simulation",
    "Translation",
    "first_contact",
    "onward",
    "stop",
]
