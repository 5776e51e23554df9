"""The add-on as Blender switches it on."""

import importlib.util
import os
import sys

import bpy

from .exported import SceneTest

FOLDER = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))


def load():
    """Imports the folder under the kind of name that Blender gives to extensions."""
    name = "matcha_as_extension"
    path = os.path.join(FOLDER, "__init__.py")
    spec = importlib.util.spec_from_file_location(name, path, submodule_search_locations=[FOLDER])
    module = importlib.util.module_from_spec(spec)
    sys.modules[name] = module
    spec.loader.exec_module(module)
    return module


class AddOn(SceneTest):
    def setUp(self):
        super().setUp()
        self.module = load()
        self.module.register()
        self.addCleanup(self.module.unregister)

    def test_operator_writes_the_file(self):
        self.add("quad", self.quad())
        path = os.path.join(self.folder, "a.glb")
        self.assertEqual(bpy.ops.export_scene.matcha(filepath=path), {"FINISHED"})
        with open(path, "rb") as file:
            self.assertEqual(file.read(4), b"glTF")

    def test_operator_reports_failure(self):
        self.scene.camera = None
        with self.assertRaisesRegex(RuntimeError, "has no camera"):
            bpy.ops.export_scene.matcha(filepath=os.path.join(self.folder, "a.glb"))

    def test_manifest_agrees(self):
        if sys.version_info < (3, 11):
            self.skipTest("no TOML reader")
        import tomllib

        with open(os.path.join(FOLDER, "blender_manifest.toml"), "rb") as file:
            manifest = tomllib.load(file)
        info = self.module.bl_info
        self.assertEqual(manifest["version"], ".".join(map(str, info["version"])))
        self.assertEqual(manifest["blender_version_min"], ".".join(map(str, info["blender"])))
        self.assertTrue(os.path.isfile(os.path.join(FOLDER, "matcha_export", "scene.py")))
