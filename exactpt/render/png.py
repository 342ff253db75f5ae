"""PNG: an SVG document as pixels, by resvg (the optional extra ``draw``)."""

from __future__ import annotations

from exactpt.errors import InputError


def png_of(svg: str, *, zoom: int = 2) -> bytes:
    """Return the PNG image of an SVG document, with ``zoom`` pixels per unit in each direction.

    Raises:
        InputError: if resvg is not installed; the message has the command to install it.
    """
    try:
        import resvg_py
    except ImportError:
        raise InputError(
            "PNG needs the library resvg_py, which is not installed: "
            "pip install 'exactpt[draw]' (SVG and HTML need nothing)"
        ) from None
    return bytes(resvg_py.svg_to_bytes(svg_string=svg, zoom=zoom, dpi=96))
