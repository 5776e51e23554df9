"""Writes what a view transform of Blender's makes of colours, as a test's reference.

    python view_reference.py AgX OUT.csv        (a Python with bpy and numpy)
"""

import os
import sys
import tempfile

import bpy
import numpy as np

SIDE = 32


def colours():
    """Greys and colours of all hues and saturations over 16 stops."""
    random = np.random.default_rng(7)
    count = SIDE * SIDE
    stops = random.uniform(-9.0, 5.0, (count, 1))
    saturation = random.uniform(0.0, 1.0, (count, 1)) ** 0.5
    mixed = (1 - saturation) + saturation * random.uniform(0.0, 1.0, (count, 3))
    mixed[: SIDE * 2] = 1.0
    return (mixed * 2.0**stops).astype(np.float32)


def main(view, out):
    linear = colours()
    image = bpy.data.images.new("colours", SIDE, SIDE, float_buffer=True)
    rgba = np.ones((SIDE * SIDE, 4), np.float32)
    rgba[:, :3] = linear
    image.pixels.foreach_set(rgba.ravel())
    scene = bpy.context.scene
    scene.view_settings.view_transform = view
    scene.view_settings.look = "None"
    settings = scene.render.image_settings
    settings.file_format, settings.color_mode, settings.color_depth = "PNG", "RGB", "16"
    with tempfile.TemporaryDirectory() as folder:
        path = os.path.join(folder, "colours.png")
        image.save_render(path, scene=scene)
        saved = bpy.data.images.load(path)
        saved.colorspace_settings.name = "Non-Color"
        shown = np.empty(SIDE * SIDE * 4, np.float32)
        saved.pixels.foreach_get(shown)
    shown = shown.reshape(-1, 4)[:, :3] * 255.0
    with open(out, "w", encoding="utf-8") as file:
        file.write("r,g,b,display_r,display_g,display_b\n")
        for a, b in zip(linear, shown):
            file.write(",".join([f"{x:.6g}" for x in a] + [f"{x:.2f}" for x in b]) + "\n")


main(*sys.argv[-2:])
