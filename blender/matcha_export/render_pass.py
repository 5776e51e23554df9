"""Access to the scene as a renderer sees it.

Outside of a render Blender evaluates for the viewport: subdivision levels, hidden objects and
particle counts are those of the editor. A render engine is handed a dependency graph evaluated
for rendering, so the exporter runs as one for a moment.
"""

import bpy

from .report import ExportError

ENGINE = "MATCHA_EXPORT"


class ExportEngine(bpy.types.RenderEngine):
    """Calls `task` with the render depsgraph instead of making a picture."""

    bl_idname = ENGINE
    bl_label = "Matcha export"
    bl_use_preview = False
    task = None

    def render(self, depsgraph):
        run = type(self).task
        if run is not None:
            type(self).task = None
            run(depsgraph)


def run(scene, view_layer, task):
    """Calls `task(depsgraph)` with a depsgraph in render mode; its exceptions come through."""
    outcome = {}

    def guarded(depsgraph):
        try:
            outcome["value"] = task(depsgraph)
        except BaseException as error:  # handed on below: Blender would only print it
            outcome["error"] = error

    render = scene.render
    kept = render.engine, render.use_compositing, render.use_sequencer
    bpy.utils.register_class(ExportEngine)
    ExportEngine.task = guarded
    try:
        render.engine = ENGINE
        render.use_compositing = False
        render.use_sequencer = False
        bpy.ops.render.render(scene=scene.name, layer=view_layer.name)
    except RuntimeError as error:
        raise ExportError(f"Blender could not evaluate the scene for rendering: {first_line(error)}") from error
    finally:
        ExportEngine.task = None
        render.engine, render.use_compositing, render.use_sequencer = kept
        bpy.utils.unregister_class(ExportEngine)
    if "error" in outcome:
        raise outcome["error"]
    if "value" not in outcome:
        raise ExportError("Blender did not evaluate the scene for rendering.")
    return outcome["value"]


def first_line(error):
    """Operators report several lines, each with a prefix of Blender's own."""
    return (str(error).strip().splitlines() or ["no reason given"])[0]
