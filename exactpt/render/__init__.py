"""Pictures: a scene and its tiling as SVG, PNG, or an animation in one HTML file."""
