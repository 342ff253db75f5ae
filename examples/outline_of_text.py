"""The outline of a text in a font, as an SVG drawing with a path for each letter.

    python examples/outline_of_text.py exactpt --font DejaVuSerif.ttf -o letters.svg

It needs: pip install fonttools
"""

from __future__ import annotations

import argparse
from pathlib import Path
from xml.sax.saxutils import quoteattr

from fontTools.pens.svgPathPen import SVGPathPen
from fontTools.ttLib import TTFont


def outline(text: str, font: TTFont) -> str:
    """The drawing: units of the font, letters side by side on the line y = 0."""
    glyphs, names = font.getGlyphSet(), font.getBestCmap()
    paths, x = [], 0
    for letter in text:
        name = names[ord(letter)]
        pen = SVGPathPen(glyphs)
        glyphs[name].draw(pen)
        if commands := pen.getCommands():
            place = f'transform="translate({x} 0) scale(1 -1)"'
            paths.append(f'<path id={quoteattr(letter)} {place} d="{commands}"/>')
        x += glyphs[name].width
    size, top = font["head"].unitsPerEm, font["hhea"].ascent
    box = f'viewBox="0 {-top} {x} {top + size // 4}"'
    return "\n".join([f'<svg xmlns="http://www.w3.org/2000/svg" {box}>', *paths, "</svg>", ""])


def main() -> None:
    """Read the command line, write the drawing."""
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("text")
    parser.add_argument("--font", required=True)
    parser.add_argument("-o", "--output", type=Path, required=True)
    given = parser.parse_args()
    given.output.write_text(outline(given.text, TTFont(given.font)), encoding="utf-8")


if __name__ == "__main__":
    main()
