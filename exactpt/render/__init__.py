"""Pictures of a scene and its tiling: SVG, PNG, or an animation in one HTML file."""
