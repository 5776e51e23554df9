"""Matcha: exports scenes for the Matcha renderer (File > Export > Matcha)."""

bl_info = {
    "name": "Matcha",
    "author": "The Matcha authors",
    "version": (0, 1, 0),
    "blender": (4, 2, 0),
    "location": "File > Export > Matcha (.glb)",
    "description": "glTF with complete Cycles node trees",
    "category": "Import-Export",
}

import bpy
from bpy_extras.io_utils import ExportHelper

from .matcha_export import scene
from .matcha_export.report import ExportError, Report


class MATCHA_OT_export(bpy.types.Operator, ExportHelper):
    """Write the scene as glTF with everything that the Matcha renderer reads"""

    bl_idname = "export_scene.matcha"
    bl_label = "Export Matcha"
    bl_options = {"PRESET"}

    filename_ext = ".glb"
    filter_glob: bpy.props.StringProperty(default="*.glb", options={"HIDDEN"})

    def execute(self, context):
        report = Report()
        try:
            size = scene.export(bpy.path.abspath(self.filepath), report, context.scene)
        except ExportError as error:
            self.report({"ERROR"}, str(error))
            return {"CANCELLED"}
        for text in report.warnings:
            self.report({"WARNING"}, text)
        self.report({"INFO"}, f"{self.filepath}: {size / 1e6:.1f} MB")
        return {"FINISHED"}


def menu_entry(self, _context):
    """The line under File > Export."""
    self.layout.operator(MATCHA_OT_export.bl_idname, text="Matcha (.glb)")


def register():
    """Called when the add-on is switched on."""
    bpy.utils.register_class(MATCHA_OT_export)
    bpy.types.TOPBAR_MT_file_export.append(menu_entry)


def unregister():
    """Called when the add-on is switched off."""
    bpy.types.TOPBAR_MT_file_export.remove(menu_entry)
    bpy.utils.unregister_class(MATCHA_OT_export)
