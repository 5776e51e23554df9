"""The whole export: Blender's current scene to a GLB file."""

import bpy

from . import camera, instancing, render_pass, settings
from .glb import Glb
from .images import Images
from .materials import Materials
from .meshes import Meshes
from .objects import Objects
from .report import ExportError
from .trees import Trees

EXTENSION = "MATCHA_cycles"
VERSION = 1
# Settings of a scene that was made for another engine are Cycles' defaults; they are used.
CYCLES = "CYCLES"


def export(path, report, scene=None):
    """Writes the scene (default: the current one) to `path`; returns the file's size in bytes."""
    scene = scene or bpy.context.scene
    if scene is None:
        raise ExportError("The file holds no scene.")
    if scene.camera is None or scene.camera.type != "CAMERA":
        raise ExportError(f"The scene '{scene.name}' has no camera; add one or make one active.")
    if not hasattr(scene, "cycles"):
        raise ExportError("Blender's Cycles add-on is switched off; the exporter reads its settings.")
    if scene.render.engine != CYCLES:
        report.warning(f"the scene was made for {scene.render.engine}, not for Cycles; colours may differ")
    view_layer = used_layer(scene, report)
    asked = settings.render_settings(scene, view_layer)
    settings.warn_of_left_out(scene, report)
    report.progress(0.0, "evaluating")

    def task(depsgraph):
        glb = build(depsgraph, scene, view_layer, asked, report)
        report.progress(0.95, "writing")
        return glb.write(path)

    size = render_pass.run(scene, view_layer, task)
    for source in sorted(set(bpy.utils.blend_paths(absolute=True, packed=False, local=False))):
        report.source(source)
    report.progress(1.0, "done")
    return size


def used_layer(scene, report):
    """The first view layer that is rendered."""
    layers = [layer for layer in scene.view_layers if layer.use]
    if not layers:
        raise ExportError(f"The scene '{scene.name}' has no view layer that is rendered.")
    if len(layers) > 1:
        report.warning(f"only the view layer '{layers[0].name}' is exported")
    return layers[0]


def build(depsgraph, scene, view_layer, asked, report):
    """The glTF document of an evaluated scene."""
    glb = Glb(f"Matcha exporter, Blender {bpy.app.version_string}")
    glb.use(EXTENSION)
    images = Images(glb, report)
    trees = Trees(images, report)
    materials = Materials(glb, trees, images, report)
    meshes = Meshes(glb, materials, report)
    objects = Objects(glb, meshes, materials, trees, report, view_layer)

    roots = [camera.node(glb, scene, depsgraph)]
    around = settings.world(scene, view_layer, depsgraph, trees)
    objects.collect(depsgraph)
    roots += objects.light_nodes
    roots += instancing.nodes(glb, objects.placements)
    report.progress(0.92, "nodes")

    glb.root["scene"] = 0
    glb.append("scenes", {"name": scene.name, "nodes": roots})
    glb.root.setdefault("extensions", {})[EXTENSION] = {
        "version": VERSION,
        "settings": asked,
        "world": around,
        "trees": trees.entries,
        "images": images.entries,
    }
    return glb
