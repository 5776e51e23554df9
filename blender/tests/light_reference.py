"""Irradiance that Cycles' lights bring to points of a plane, as JSON.

Run with a Python that has bpy: `python light_reference.py OUT.json`. A white diffuse floor at
z = 0 is rendered around each point from straight above, direct light only; its radiance times
π is the irradiance that is stored. Read by the tests of `crates/matcha-render/src/light`.
"""

import json
import math
import os
import sys
import tempfile

import bpy
from mathutils import Euler, Matrix

POINTS = [(0.0, 0.0), (0.7, 0.3), (-1.2, 0.9), (2.0, -1.5)]
SAMPLES = 4096
TILTED = Matrix.Translation((0.3, -0.2, 1.6)) @ Euler((0.35, -0.25, 0.6)).to_matrix().to_4x4()
SCALED = TILTED @ Matrix.Diagonal((1.0, 1.8, 1.3, 1.0))
LIGHTS = {
    "point": ("POINT", TILTED, {"shadow_soft_size": 0.0}),
    "sphere": ("POINT", TILTED, {"shadow_soft_size": 0.5}),
    "sphere scaled": ("POINT", SCALED, {"shadow_soft_size": 0.4}),
    "sphere not normalized": ("POINT", TILTED, {"shadow_soft_size": 0.5, "normalize": False}),
    "point not normalized": ("POINT", TILTED, {"shadow_soft_size": 0.0, "normalize": False}),
    "disc": ("POINT", TILTED, {"shadow_soft_size": 0.5, "use_soft_falloff": True}),
    "spot": ("SPOT", TILTED, {"shadow_soft_size": 0.1, "spot_size": 1.8, "spot_blend": 0.4}),
    "spot point": ("SPOT", TILTED, {"shadow_soft_size": 0.0, "spot_size": 2.2, "spot_blend": 1.0}),
    "spot soft": (
        "SPOT",
        TILTED,
        {"shadow_soft_size": 0.3, "spot_size": 1.8, "spot_blend": 0.4, "use_soft_falloff": True},
    ),
    "spot scaled": ("SPOT", SCALED, {"shadow_soft_size": 0.1, "spot_size": 1.5, "spot_blend": 0.7}),
    "spot large": ("SPOT", TILTED, {"shadow_soft_size": 1.0, "spot_size": 0.9, "spot_blend": 0.9}),
    "sun": ("SUN", TILTED, {"angle": 0.0}),
    "sun wide": ("SUN", TILTED, {"angle": 0.6}),
    "sun not normalized": ("SUN", TILTED, {"angle": 0.6, "normalize": False}),
    "rectangle": ("AREA", TILTED, {"shape": "RECTANGLE", "size": 1.1, "size_y": 0.4}),
    "square scaled": ("AREA", SCALED, {"shape": "SQUARE", "size": 0.8}),
    "rectangle not normalized": (
        "AREA",
        TILTED,
        {"shape": "RECTANGLE", "size": 1.1, "size_y": 0.4, "normalize": False},
    ),
    "rectangle spread": (
        "AREA",
        TILTED,
        {"shape": "RECTANGLE", "size": 1.1, "size_y": 0.8, "spread": 1.6},
    ),
    "ellipse": ("AREA", TILTED, {"shape": "ELLIPSE", "size": 1.1, "size_y": 0.6}),
    "disk spread": ("AREA", TILTED, {"shape": "DISK", "size": 1.4, "spread": 1.4}),
    "ellipse spread": (
        "AREA",
        TILTED,
        {"shape": "ELLIPSE", "size": 1.4, "size_y": 0.5, "spread": 1.0},
    ),
}


def reset():
    bpy.ops.wm.read_factory_settings(use_empty=True)
    scene = bpy.context.scene
    scene.render.engine = "CYCLES"
    scene.render.resolution_x = scene.render.resolution_y = 4
    scene.render.resolution_percentage = 100
    scene.render.image_settings.file_format = "OPEN_EXR"
    scene.render.image_settings.color_depth = "32"
    cycles = scene.cycles
    cycles.samples = SAMPLES
    cycles.use_adaptive_sampling = False
    cycles.use_denoising = False
    cycles.max_bounces = cycles.diffuse_bounces = 0
    cycles.sample_clamp_direct = cycles.sample_clamp_indirect = 0.0
    cycles.light_sampling_threshold = 0.0
    cycles.pixel_filter_type = "BOX"
    scene.world = bpy.data.worlds.new("world")
    scene.world.use_nodes = True
    scene.world.node_tree.nodes["Background"].inputs["Color"].default_value = (0, 0, 0, 1)
    return scene


def add_floor(scene):
    mesh = bpy.data.meshes.new("floor")
    mesh.from_pydata([(-9, -9, 0), (9, -9, 0), (9, 9, 0), (-9, 9, 0)], [], [(0, 1, 2, 3)])
    material = bpy.data.materials.new("white")
    material.use_nodes = True
    nodes = material.node_tree.nodes
    nodes.clear()
    diffuse = nodes.new("ShaderNodeBsdfDiffuse")
    diffuse.inputs["Color"].default_value = (1, 1, 1, 1)
    output = nodes.new("ShaderNodeOutputMaterial")
    material.node_tree.links.new(diffuse.outputs[0], output.inputs["Surface"])
    mesh.materials.append(material)
    scene.collection.objects.link(bpy.data.objects.new("floor", mesh))


def add_camera(scene):
    data = bpy.data.cameras.new("camera")
    data.type, data.ortho_scale, data.clip_end = "ORTHO", 0.004, 100.0
    camera = bpy.data.objects.new("camera", data)
    scene.collection.objects.link(camera)
    scene.camera = camera
    return camera


def measure(scene, camera, folder):
    irradiance = []
    for x, y in POINTS:
        camera.location = (x, y, 20.0)
        scene.render.filepath = os.path.join(folder, "floor.exr")
        bpy.ops.render.render(write_still=True)
        image = bpy.data.images.load(scene.render.filepath)
        image.colorspace_settings.name = "Non-Color"
        pixels = image.pixels[:]
        bpy.data.images.remove(image)
        means = [sum(pixels[c::4]) / (len(pixels) / 4) for c in range(3)]
        irradiance.append([round(m * math.pi, 7) for m in means])
    return irradiance


def main():
    cases = []
    with tempfile.TemporaryDirectory() as folder:
        for name, (kind, matrix, properties) in LIGHTS.items():
            scene = reset()
            add_floor(scene)
            camera = add_camera(scene)
            data = bpy.data.lights.new("light", kind)
            data.energy = 3.0 if kind == "SUN" else 40.0
            data.color = (1.0, 0.5, 0.25)
            for key, value in properties.items():
                setattr(data, key, value)
            if kind in ("POINT", "SPOT") and "use_soft_falloff" not in properties:
                data.use_soft_falloff = False
            light = bpy.data.objects.new("light", data)
            light.visible_camera = False
            light.matrix_world = matrix
            scene.collection.objects.link(light)
            columns = [[matrix[r][c] for r in range(3)] for c in range(4)]
            power = [data.energy * c for c in data.color]
            irradiance = measure(scene, camera, folder)
            cases.append(
                {
                    "name": name,
                    "kind": kind,
                    "matrix": columns,
                    "power": power,
                    "properties": properties,
                    "irradiance": irradiance,
                }
            )
            print(name, irradiance, file=sys.stderr)
    with open(sys.argv[-1], "w", encoding="utf-8") as file:
        lines = ",\n".join("    " + json.dumps(case) for case in cases)
        header = json.dumps({"blender": bpy.app.version_string, "points": POINTS})[1:-1]
        file.write(f'{{{header}, "lights": [\n{lines}\n]}}\n')


main()
