"""Camera, lights, world, settings, and the command line."""

import contextlib
import io
import json
import math
import os
import subprocess
import sys
import unittest

import bpy
import numpy as np
from mathutils import Matrix

import export_cli
from matcha_export import axes, scene
from matcha_export.report import ExportError, Report

from .exported import NAME, Exported, SceneTest, local, node_named

HERE = os.path.dirname(os.path.abspath(__file__))
SCHEMA = os.path.join(HERE, "..", "..", "docs", "gltf-extension", "MATCHA_cycles.schema.json")


class Scene(SceneTest):
    def test_no_camera(self):
        for no_camera in (None, self.add("empty", None), self.add("lamp", bpy.data.lights.new("lamp", "SPOT"))):
            self.scene.camera = no_camera
            with self.assertRaisesRegex(ExportError, "has no camera"):
                scene.export(os.path.join(self.folder, "scene.glb"), Report())
        self.assertEqual(os.listdir(self.folder), [])

    def test_folder_that_does_not_exist(self):
        with self.assertRaisesRegex(ExportError, "cannot be written"):
            scene.export(os.path.join(self.folder, "nowhere", "scene.glb"), Report())

    def test_scene_is_left_as_it_was(self):
        self.add("quad", self.quad())
        self.scene.render.use_compositing = True
        self.export()
        self.assertEqual(self.scene.render.engine, "CYCLES")
        self.assertTrue(self.scene.render.use_compositing)

    def test_camera(self):
        self.camera.matrix_world = Matrix.LocRotScale((1, 2, 3), Matrix.Rotation(0.7, 3, "X").to_quaternion(), (2, 2, 2))
        data = self.camera.data
        data.lens, data.shift_x, data.sensor_fit = 35.0, 0.25, "VERTICAL"
        data.dof.use_dof, data.dof.aperture_fstop, data.dof.aperture_blades = True, 1.5, 6
        focus = self.add("focus", None)
        focus.location = self.camera.matrix_world @ Matrix.Translation((3, 4, -5)).translation
        data.dof.focus_object = focus
        file = self.export()
        entry = file.about("camera", "camera")
        self.assertEqual((entry["lens"], entry["shift"], entry["sensor_fit"]), (35.0, [0.25, 0.0], "VERTICAL"))
        self.assertEqual(entry["dof"]["blades"], 6)
        self.assertAlmostEqual(entry["dof"]["focus_distance"], 10.0, places=4)
        node = next(n for n in file.json["nodes"] if "camera" in n)
        turned = Matrix.LocRotScale((1, 2, 3), Matrix.Rotation(0.7, 3, "X").to_quaternion(), None)
        np.testing.assert_allclose(local(node), axes.TO_GLTF @ np.array(turned), atol=1e-6)
        half = entry["sensor_height"] / 2 / 35.0
        self.assertAlmostEqual(file.json["cameras"][0]["perspective"]["yfov"], 2 * math.atan(half), places=6)

    def test_lights(self):
        area = bpy.data.lights.new("area", "AREA")
        area.shape, area.size, area.size_y, area.spread, area.energy = "ELLIPSE", 2.0, 3.0, 1.0, 50.0
        self.add("area", area, (0, 0, 2))
        spot = bpy.data.lights.new("spot", "SPOT")
        spot.spot_size, spot.spot_blend, spot.shadow_soft_size = 1.0, 0.5, 0.1
        self.add("spot", spot)
        sun = bpy.data.lights.new("sun", "SUN")
        sun.angle, sun.color = 0.02, (1, 0.5, 0.25)
        self.add("sun", sun).visible_glossy = False
        file = self.export()
        entry = file.about("light", "area")
        self.assertEqual((entry["shape"], entry["size"], entry["energy"]), ("ELLIPSE", [2, 3], 50))
        entry = file.about("light", "spot")
        self.assertEqual((entry["angle"], entry["blend"]), (1.0, 0.5))
        entry = file.about("light", "sun")
        self.assertEqual(entry["color"], [1, 0.5, 0.25])
        self.assertFalse(entry["visibility"]["glossy"])
        types = [light["type"] for light in file.json["extensions"]["KHR_lights_punctual"]["lights"]]
        self.assertEqual(sorted(types), ["directional", "spot"])
        node = next(n for n in file.json["nodes"] if n["name"] == "area")
        np.testing.assert_allclose(local(node)[:3, :3], axes.TO_GLTF[:3, :3], atol=1e-6)
        self.assertNotIn("KHR_lights_punctual", node["extensions"])

    def test_light_temperature(self):
        light = bpy.data.lights.new("warm", "POINT")
        if not hasattr(light, "use_temperature"):
            self.skipTest("lights have no temperature before Blender 4.5")
        light.use_temperature, light.temperature, light.color = True, 2700.0, (1, 1, 0.5)
        self.add("warm", light)
        color = self.export().about("light", "warm")["color"]
        np.testing.assert_allclose(color, np.array(light.temperature_color) * (1, 1, 0.5), rtol=1e-6)

    def test_light_tree(self):
        light = bpy.data.lights.new("lamp", "POINT")
        light.use_nodes = True
        self.add("lamp", light)
        file = self.export()
        tree = file.root["trees"][file.about("light", "lamp")["tree"]]
        self.assertEqual({n["type"] for n in tree["nodes"]}, {"ShaderNodeOutputLight", "ShaderNodeEmission"})

    def test_world(self):
        self.assertEqual(self.export().root["world"], {"color": [0, 0, 0]})
        world = self.scene.world = bpy.data.worlds.new("sky")
        world.use_nodes = True
        world.node_tree.nodes["Background"].inputs["Strength"].default_value = 2.5
        world.cycles.sampling_method = "NONE"
        world.cycles_visibility.diffuse = False
        file = self.export()
        entry = file.root["world"]
        self.assertFalse(entry["importance_sample"])
        self.assertFalse(entry["visibility"]["diffuse"])
        _, node = node_named(file.root["trees"][entry["tree"]], "Background")
        self.assertEqual(node["inputs"][1]["value"], [2.5])

    def test_settings(self):
        self.scene.render.resolution_x, self.scene.render.resolution_y = 301, 200
        self.scene.render.resolution_percentage = 50
        self.scene.cycles.pixel_filter_type, self.scene.cycles.filter_width = "GAUSSIAN", 2.0
        self.scene.cycles.transparent_max_bounces = 17
        self.scene.cycles.min_light_bounces = 3
        entry = self.export().root["settings"]
        self.assertEqual(entry["resolution"], [150, 100])
        self.assertEqual(entry["filter"], {"type": "GAUSSIAN", "width": 2.0})
        self.assertEqual(entry["transparent_bounces"], 17)
        self.assertEqual(entry["min_bounces"], 3)

    def test_view_layers_own_samples_world_and_material(self):
        self.surface("own")
        layer, cycles = self.scene.view_layers[0], self.scene.cycles
        cycles.samples, layer.samples = 100, 16
        worlds = [bpy.data.worlds.new(name) for name in ("scene's", "layer's")]
        self.scene.world = worlds[0]
        layer.material_override, _, _ = self.material("override")
        if hasattr(layer, "world_override"):
            layer.world_override = worlds[1]
        file = self.export()
        self.assertEqual(file.root["settings"]["samples"], 16)
        self.assertEqual([m["name"] for m in file.json["materials"]], ["override"])
        if hasattr(layer, "world_override"):
            self.assertEqual(file.root["world"]["name"], "layer's")
        cycles.use_layer_samples = "BOUNDED"
        layer.samples = 200
        self.assertEqual(self.export().root["settings"]["samples"], 100)
        cycles.use_layer_samples = "IGNORE"
        self.assertEqual(self.export().root["settings"]["samples"], 100)

    def test_glass_that_lets_the_film_through_is_said(self):
        self.scene.cycles.film_transparent_glass = True
        self.assertEqual(self.export().warnings, [])
        self.scene.render.film_transparent = True
        self.assertIn("Transparent Glass", " ".join(self.export().warnings))

    def test_compositing_is_said_where_it_changes_something(self):
        if hasattr(self.scene, "compositing_node_group"):
            tree = bpy.data.node_groups.new("composite", "CompositorNodeTree")
            self.scene.compositing_node_group = tree
        else:
            self.scene.use_nodes = True
            tree = self.scene.node_tree
        tree.nodes.new("CompositorNodeRLayers")
        self.assertEqual(self.export().warnings, [])
        glare = tree.nodes.new("CompositorNodeGlare")
        self.assertIn("compositing", " ".join(self.export().warnings))
        glare.mute = True
        self.assertEqual(self.export().warnings, [])

    def test_a_mirrored_camera_stays_mirrored(self):
        turn = Matrix.Rotation(0.7, 3, "X").to_quaternion()
        self.camera.matrix_world = Matrix.LocRotScale((1, 2, 3), turn, (-2, 1, 3))
        node = next(n for n in self.export().json["nodes"] if "camera" in n)
        mirrored = Matrix.LocRotScale((1, 2, 3), turn, (-1, 1, 1))
        np.testing.assert_allclose(local(node), axes.TO_GLTF @ np.array(mirrored), atol=1e-6)

    def test_what_changes_the_picture_and_is_left_out_is_said(self):
        self.assertEqual(self.export().warnings, [])
        self.scene.render.use_motion_blur = True
        self.scene.render.use_border = True
        self.scene.cycles.use_fast_gi = True
        self.scene.render.use_multiview = True
        camera = self.camera.data
        camera.type = "PANO"
        owner = camera if hasattr(camera, "panorama_type") else camera.cycles
        owner.panorama_type, owner.latitude_min = "EQUIRECTANGULAR", -0.5
        lamp = self.add("lamp", bpy.data.lights.new("lamp", "POINT"))
        if hasattr(lamp, "light_linking"):
            lamp.light_linking.receiver_collection = bpy.data.collections.new("lit")
        said = " ".join(self.export().warnings)
        for what in ("motion blur", "render region", "fast global illumination", "range of angles", "stereoscopy"):
            self.assertIn(what, said)
        self.assertEqual("light linking" in said, hasattr(lamp, "light_linking"))

    def test_standard_likeness(self):
        _, color = self.surface()
        color.default_value = (0.25, 0.5, 0.75, 1)
        (material,) = self.export().json["materials"]
        self.assertEqual(material["pbrMetallicRoughness"]["baseColorFactor"], [0.25, 0.5, 0.75, 1.0])

    @unittest.skipUnless(os.path.isfile(SCHEMA), "the specification is not beside the exporter")
    def test_schema(self):
        try:
            import jsonschema
        except ImportError:
            self.skipTest("jsonschema is not installed: the file is NOT checked against its schema")
        self.surface()
        self.add("lamp", bpy.data.lights.new("lamp", "AREA"))
        file = self.export()
        with open(SCHEMA, encoding="utf-8") as text:
            schema = json.load(text)

        def check(place, value):
            jsonschema.validate(value, {**schema, "$ref": f"#/$defs/{place}"})

        check("root", file.root)
        for place, entries in (("material", "materials"), ("mesh", "meshes"), ("node", "nodes")):
            for entry in file.json[entries]:
                check(place, entry["extensions"][NAME])


class CommandLine(SceneTest):
    def run_cli(self, *words):
        return subprocess.run(
            [sys.executable, os.path.join(HERE, "..", "export_cli.py"), *words],
            capture_output=True,
            text=True,
            timeout=120,
            check=False,
        )

    def test_export_of_a_file(self):
        self.add("quad", self.quad())
        blend, out = os.path.join(self.folder, "a.blend"), os.path.join(self.folder, "a.glb")
        with contextlib.redirect_stdout(io.StringIO()):
            bpy.ops.wm.save_as_mainfile(filepath=blend)
        done = self.run_cli(blend, out, "--progress")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertRegex(done.stdout, r"(?m)^MATCHA progress 1\.00 done$")
        with open(out, "rb") as file:
            self.assertEqual(len(Exported(file.read()).placed()), 1)

    def test_failures_are_one_sentence(self):
        broken = os.path.join(self.folder, "broken.blend")
        with open(broken, "wb") as file:
            file.write(b"BLENDER is what this is not")
        out = os.path.join(self.folder, "a.glb")
        for path, reason in ((broken, "cannot open this file"), ("/nowhere/a.blend", "no such file")):
            done = self.run_cli(path, out)
            self.assertEqual(done.returncode, 2)
            (line,) = [text for text in done.stderr.splitlines() if text.startswith("MATCHA error ")]
            self.assertIn(reason, line)
            self.assertFalse(os.path.exists(out))

    def test_arguments(self):
        self.assertEqual(export_cli.arguments(["cli", "a", "b"]), ("a", "b", False))
        self.assertEqual(export_cli.arguments(["blender", "a", "--", "b", "--progress"]), (None, "b", True))
        self.assertIsNone(export_cli.arguments(["cli", "a"]))
        self.assertIsNone(export_cli.arguments(["cli", "a", "b", "--unknown"]))
