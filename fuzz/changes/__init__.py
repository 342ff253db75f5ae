"""Changes of scenes: images whose results follow from those of the scene, and harder scenes.

`fuzz.changes.registry` has all of them by name. `fuzz.changes.variants` maps space and time, with
the image of a contact; `fuzz.changes.images` the description of a scene, with the feature that each
new vertex and edge stands for.
"""
