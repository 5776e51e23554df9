"""Prints where Blender's camera puts known points, as the table of
`crates/matcha-render/src/camera/blender_projection.rs`.

Run with a Python that has bpy: `python camera_reference.py > …/blender_projection.rs`.
"""

import itertools

import bpy
from bpy_extras.object_utils import world_to_camera_view
from mathutils import Euler, Matrix, Vector

POINTS = [(0.1, 0.3, 0.2), (-0.8, 1.0, 0.5), (0.7, -0.4, 1.9)]
LENS, SENSOR_WIDTH, SENSOR_HEIGHT, ORTHO_SCALE = 35.0, 32.0, 18.0, 7.5
FITS = {"AUTO": "Auto", "HORIZONTAL": "Horizontal", "VERTICAL": "Vertical"}


def main():
    scene = bpy.context.scene
    data = bpy.data.cameras.new("camera")
    camera = bpy.data.objects.new("camera", data)
    scene.collection.objects.link(camera)
    camera.matrix_world = (
        Matrix.Translation((1.5, -4.0, 2.25)) @ Euler((1.2, 0.1, 0.35)).to_matrix().to_4x4()
    )
    data.lens, data.ortho_scale = LENS, ORTHO_SCALE
    data.sensor_width, data.sensor_height = SENSOR_WIDTH, SENSOR_HEIGHT
    columns = [[camera.matrix_world[r][c] for r in range(3)] for c in range(4)]
    print("//! Written by `blender/tests/camera_reference.py`; Blender", bpy.app.version_string + ".")
    print("use super::tests::Case;")
    print("use crate::scene::SensorFit::{Auto, Horizontal, Vertical};\n")
    print("/// Columns of the camera's matrix.")
    print("#[rustfmt::skip]")
    rows = ",\n    ".join(str([round(v, 8) for v in column]) for column in columns)
    print(f"pub const MATRIX: [[f32; 3]; 4] = [\n    {rows},\n];")
    print("/// Points in the world.")
    print("#[rustfmt::skip]")
    print(f"pub const POINTS: [[f32; 3]; {len(POINTS)}] = {[list(p) for p in POINTS]};")
    print("/// Pixels from the top left at which each camera sees the points.")
    print("#[rustfmt::skip]\npub const CASES: &[Case] = &[")
    for parallel, fit, size, aspect, shift in itertools.product(
        (False, True), FITS, ((640, 360), (360, 640)), (1, 2), ((0.0, 0.0), (0.15, -0.3))
    ):
        data.type = "ORTHO" if parallel else "PERSP"
        data.sensor_fit = fit
        data.shift_x, data.shift_y = shift
        render = scene.render
        render.resolution_x, render.resolution_y, render.resolution_percentage = *size, 100
        render.pixel_aspect_x, render.pixel_aspect_y = aspect, 1
        bpy.context.view_layer.update()
        sensor = SENSOR_HEIGHT if fit == "VERTICAL" else SENSOR_WIDTH
        fitted = ORTHO_SCALE if parallel else sensor / 2 / LENS
        seen = [world_to_camera_view(scene, camera, Vector(p)) for p in POINTS]
        pixels = [[round(v.x * size[0], 3), round((1 - v.y) * size[1], 3)] for v in seen]
        print(
            f"    Case {{ parallel: {str(parallel).lower()}, fit: {FITS[fit]}, size: {list(size)},"
            f" aspect: {aspect}.0, shift: {list(shift)}, fitted: {fitted:.6f}, pixels: {pixels} }},"
        )
    print("];")


main()
