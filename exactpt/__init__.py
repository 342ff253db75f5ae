"""Exact kinetic pseudo-triangulations and collision detection in the plane.

>>> import exactpt
>>> box = exactpt.Body("box", [(0, 0), (2, 0), (2, 1), (0, 1)], exactpt.Translation([0, "1/2"]))
>>> wall = exactpt.Body("wall", [(4, -5), (5, -5), (5, 5), (4, 5)])
>>> contact = exactpt.first_contact(exactpt.Scene([box, wall], time=(0, 10)))
>>> contact.time, contact.kind
(AlgebraicNumber('4'), 'vertex-edge')
"""

from importlib import import_module
from os.path import isfile
from typing import TYPE_CHECKING, Final

from exactpt.extensions import register
from exactpt.interpreters import refuse_subinterpreters

if TYPE_CHECKING:
    __version__: str
    __compiled__: bool
    from exactpt import arrays as arrays
    from exactpt import batch as batch
    from exactpt.errors import (
        AuditError,
        BudgetExceeded,
        ExactPTError,
        InputError,
        UnreachableError,
    )
    from exactpt.exchange.features import to_features
    from exactpt.exchange.files import read_shapes, write_shapes
    from exactpt.exchange.instants import from_datetime, to_datetime
    from exactpt.kernel.algebraic import AlgebraicNumber
    from exactpt.kernel.polynomial import Polynomial
    from exactpt.motion.body import Body
    from exactpt.motion.local_time import Velocity, in_local_time, spline
    from exactpt.motion.motions import Affine, Pieces, Rigid, Translation
    from exactpt.motion.pose_path import PosePath
    from exactpt.motion.spin import Spin
    from exactpt.pair.contact import Contact, ContactPoint
    from exactpt.pair.distance import Distance, distance
    from exactpt.proof.certified import certify
    from exactpt.proof.written import Proof, prove
    from exactpt.query.answers import Hit, Place, ShortestPath
    from exactpt.query.space import FreeSpace
    from exactpt.scene.scene import Scene
    from exactpt.scene.union import union
    from exactpt.scene.units import Units
    from exactpt.search.clearance import Clearance
    from exactpt.search.enclosed import EnclosedContact, first_contact_enclosed
    from exactpt.search.first import first_contact
    from exactpt.search.intervals import ContactInterval, contact_intervals, contacts
    from exactpt.search.planner import Planner
    from exactpt.search.surroundings import Surroundings, clearance
    from exactpt.search.within import Approach, first_within
    from exactpt.simulation.event import RunEvent
    from exactpt.simulation.history import History
    from exactpt.simulation.motion_changes import onward
    from exactpt.simulation.responses import Bounce, stop
    from exactpt.simulation.simulation import Simulation

refuse_subinterpreters()
if isfile(f"{__path__[0]}/compiled.txt"):  # a checkout after `make compiled`
    import_module("exactpt.compiled").compare()

__all__ = [
    "Affine",
    "AlgebraicNumber",
    "Approach",
    "AuditError",
    "Body",
    "Bounce",
    "BudgetExceeded",
    "Clearance",
    "Contact",
    "ContactInterval",
    "ContactPoint",
    "Distance",
    "EnclosedContact",
    "ExactPTError",
    "FreeSpace",
    "History",
    "Hit",
    "InputError",
    "Pieces",
    "Place",
    "Planner",
    "Polynomial",
    "PosePath",
    "Proof",
    "Rigid",
    "RunEvent",
    "Scene",
    "ShortestPath",
    "Simulation",
    "Spin",
    "Surroundings",
    "Translation",
    "Units",
    "UnreachableError",
    "Velocity",
    "certify",
    "clearance",
    "contact_intervals",
    "contacts",
    "distance",
    "first_contact",
    "first_contact_enclosed",
    "first_within",
    "from_datetime",
    "in_local_time",
    "onward",
    "prove",
    "read_shapes",
    "spline",
    "stop",
    "to_datetime",
    "to_features",
    "union",
    "write_shapes",
]

_MODULES: Final = {
    "exactpt.search.within": ("Approach", "first_within"),
    "exactpt.pair.contact": ("Contact", "ContactPoint"),
    "exactpt.search.first": ("first_contact",),
    "exactpt.search.enclosed": ("EnclosedContact", "first_contact_enclosed"),
    "exactpt.search.planner": ("Planner",),
    "exactpt.errors": (
        "AuditError",
        "BudgetExceeded",
        "ExactPTError",
        "InputError",
        "UnreachableError",
    ),
    "exactpt.exchange.features": ("to_features",),
    "exactpt.exchange.instants": ("from_datetime", "to_datetime"),
    "exactpt.exchange.files": ("read_shapes", "write_shapes"),
    "exactpt.kernel.algebraic": ("AlgebraicNumber",),
    "exactpt.kernel.polynomial": ("Polynomial",),
    "exactpt.motion.body": ("Body",),
    "exactpt.motion.local_time": ("Velocity", "in_local_time", "spline"),
    "exactpt.motion.motions": ("Affine", "Pieces", "Rigid", "Translation"),
    "exactpt.motion.pose_path": ("PosePath",),
    "exactpt.motion.spin": ("Spin",),
    "exactpt.proof.certified": ("certify",),
    "exactpt.proof.written": ("Proof", "prove"),
    "exactpt.search.clearance": ("Clearance",),
    "exactpt.search.surroundings": ("Surroundings", "clearance"),
    "exactpt.pair.distance": ("Distance", "distance"),
    "exactpt.search.intervals": ("ContactInterval", "contact_intervals", "contacts"),
    "exactpt.query.answers": ("Hit", "Place", "ShortestPath"),
    "exactpt.query.space": ("FreeSpace",),
    "exactpt.scene.scene": ("Scene",),
    "exactpt.scene.union": ("union",),
    "exactpt.scene.units": ("Units",),
    "exactpt.simulation.event": ("RunEvent",),
    "exactpt.simulation.history": ("History",),
    "exactpt.simulation.motion_changes": ("onward",),
    "exactpt.simulation.responses": ("Bounce", "stop"),
    "exactpt.simulation.simulation": ("Simulation",),
}


def _version() -> str:
    """Return the version of the installed package."""
    from importlib.metadata import version

    return version("exactpt")


def _is_compiled() -> bool:
    """Return True if the most used modules are compiled, False if they are plain Python."""
    from importlib.util import find_spec

    spec = find_spec("exactpt.planar.halfedge")
    return spec is not None and spec.origin is not None and not spec.origin.endswith(".py")


_ABOUT: Final = {"__version__": _version, "__compiled__": _is_compiled}
"""Values that are computed when they are read: ``__version__``, and whether it is compiled."""

_MODULE_OF: Final = {name: module for module, names in _MODULES.items() for name in names}


for _name, _place in {
    "body from shapely": "exactpt.exchange.shapely_adapter:body_from",
    "scene from a file": "exactpt.scene.format:load",
    "scene from JSON": "exactpt.scene.format:from_json",
    "scene from shapely": "exactpt.exchange.shapely_adapter:scene_from",
    "scene to shapely": "exactpt.exchange.shapely_adapter:geometries_of",
    "picture of a scene": "exactpt.render.notebook:scene_svg",
    "picture of a simulation": "exactpt.render.notebook:simulation_svg",
    "player of a scene": "exactpt.render.notebook:scene_player",
    "player of a simulation": "exactpt.render.notebook:simulation_player",
    "drawing of a scene": "exactpt.render.draw:draw",
    "drawing of a simulation": "exactpt.render.draw:draw_run",
    "search that writes a proof": "exactpt.proof.emit:ProofRun",
    "search that writes a certificate": "exactpt.proof.certified:CertifiedSearch",
    "proofs of a simulation": "exactpt.proof.segments:ProofFolder",
    "table of a contact": "exactpt.render.notebook:contact_html",
}.items():
    register(_name, _place)


def __getattr__(name: str) -> object:
    """Return a public name or subpackage, imported on first use (PEP 562)."""
    if name in ("arrays", "batch"):
        return import_module(f"exactpt.{name}")
    if name in _ABOUT:
        return _ABOUT[name]()
    if name not in _MODULE_OF:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    value: object = getattr(import_module(_MODULE_OF[name]), name)
    globals()[name] = value
    return value


def __dir__() -> list[str]:
    return sorted({*_MODULE_OF, *_ABOUT, "arrays", "batch"})
