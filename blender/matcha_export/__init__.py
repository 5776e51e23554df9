"""Writes a Blender scene as glTF 2.0 with the MATCHA_cycles extension.

The format is specified in docs/gltf-extension. `scene.export` is the entry.
"""
