"""Drawings: the ending of a file says what, a picture (SVG, PNG) or an animation (HTML)."""

from __future__ import annotations

import contextlib
import os
import tempfile
from pathlib import Path
from typing import TYPE_CHECKING, Final, Literal

from exactpt.errors import InputError
from exactpt.render.film import film_of
from exactpt.render.frame import frame_of
from exactpt.render.page import page_of
from exactpt.render.png import png_of
from exactpt.render.still import still
from exactpt.render.svg import svg_of
from exactpt.scene.format import write_atomically

if TYPE_CHECKING:
    from exactpt.kernel.numbers import QQ
    from exactpt.scene.scene import Scene

__all__ = ["ENDINGS", "draw"]

ENDINGS: Final = (".svg", ".html", ".png")
