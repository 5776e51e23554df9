"""Placement: instances keep their mesh, matrices survive."""

import os

import bpy
import numpy as np
from mathutils import Matrix

from matcha_export import axes

from .exported import NAME, SceneTest


def random_matrix(generator):
    """A sheared, scaled, perhaps mirrored placement."""
    matrix = np.eye(4)
    matrix[:3, :] = generator.uniform(-2.0, 2.0, (3, 4))
    return matrix


class Instances(SceneTest):
    def test_objects_share_a_mesh(self):
        mesh = self.quad()
        for i in range(3):
            self.add(f"copy {i}", mesh, (i, 0, 0))
        file = self.export()
        self.assertEqual(len(file.json["meshes"]), 1)
        self.assertEqual(len(file.placed()), 3)

    def test_equal_modified_meshes_are_stored_once(self):
        mesh = self.quad()
        for i in range(2):
            obj = self.add(f"copy {i}", mesh, (i, 0, 0))
            obj.modifiers.new("subdivision", "SUBSURF").render_levels = 2
        file = self.export()
        self.assertEqual((len(file.json["meshes"]), len(file.placed())), (1, 2))

    def test_collection_instances(self):
        inner = bpy.data.collections.new("inner")
        inner.objects.link(bpy.data.objects.new("part", self.quad()))
        for i in range(3):
            empty = self.add(f"place {i}", None, (0, 0, i))
            empty.instance_type = "COLLECTION"
            empty.instance_collection = inner
        bpy.data.objects["place 0"].visible_glossy = False
        file = self.export()
        self.assertEqual((len(file.json["meshes"]), len(file.placed())), (1, 3))
        heights = sorted(world[1, 3] for _, world in file.placed())
        np.testing.assert_allclose(heights, [0, 1, 2])
        entries = [node["extensions"][NAME]["object"] for node, _ in file.placed()]
        self.assertEqual(sorted(e["visibility"]["glossy"] for e in entries), [False, True, True])
        self.assertEqual(len({e["random"] for e in entries}), 3)

    def test_many_copies_become_a_crowd(self):
        tiny = self.add("leaf", self.quad("leaf"))
        ground = bpy.data.meshes.new("ground")
        ground.from_pydata([(i, 0, 0) for i in range(100)], [], [])
        parent = self.add("ground", ground)
        tiny.parent = parent
        parent.instance_type = "VERTS"
        file = self.export()
        (node,) = [node for node, _ in file.placed()]
        columns = node["extensions"]["EXT_mesh_gpu_instancing"]["attributes"]
        self.assertEqual(sorted(file.array(columns["TRANSLATION"])[:, 0]), list(range(100)))
        self.assertEqual(len(set(file.array(columns["_RANDOM"]))), 100)
        self.assertIn("EXT_mesh_gpu_instancing", file.json["extensionsUsed"])

    def test_any_matrix_survives(self):
        generator = np.random.default_rng(7)
        mesh = self.quad()
        wanted = {}
        for i in range(40):
            name = f"odd {i}"
            matrix = random_matrix(generator)
            if i % 4 == 0:
                matrix[:3, :3] = np.diag([1.0, -2.0, 3.0])
            if i % 4 == 1:
                matrix[:3, 2] = 0.0
            obj = self.add(name, mesh)
            # Parents with scale are how shear comes about; the inverse matrix takes any.
            obj.parent = self.camera
            obj.matrix_parent_inverse = Matrix(matrix)
            wanted[name] = matrix
        for node, world in self.export().placed():
            expected = axes.TO_GLTF @ wanted[node["name"]] @ axes.TO_GLTF.T
            np.testing.assert_allclose(world, expected, atol=2e-5)

    def test_ray_visibility_and_holdout(self):
        obj = self.add("quad", self.quad())
        obj.visible_shadow = False
        obj.is_holdout = True
        obj.pass_index = 7
        obj.color = (0.1, 0.2, 0.3, 0.4)
        entry = self.export().about("object", "quad")
        self.assertEqual(entry["visibility"], dict(camera=True, diffuse=True, glossy=True, transmission=True, shadow=False))
        self.assertTrue(entry["holdout"])
        self.assertEqual(entry["pass_index"], 7)
        np.testing.assert_allclose(entry["color"], (0.1, 0.2, 0.3, 0.4), rtol=1e-6)

    def test_random_number_is_that_of_cycles(self):
        _, tree, output = self.material()
        emission, info = tree.nodes.new("ShaderNodeEmission"), tree.nodes.new("ShaderNodeObjectInfo")
        value = tree.nodes.new("ShaderNodeValue")
        tree.links.new(emission.outputs[0], output.inputs["Surface"])
        mesh = self.quad()
        mesh.transform(Matrix.Diagonal((100, 100, 1, 1)) @ Matrix.Translation((-0.5, -0.5, 0)))
        mesh.materials.append(bpy.data.materials["material"])
        obj = self.add("quad", mesh, (0, 0, -1))
        for name in ("quad", "Stuhl.001", "Grün €"):
            obj.name = name
            random = self.export().about("object", name)["random"]
            tree.links.new(info.outputs["Random"], emission.inputs["Color"])
            measured = self.render()
            value.outputs[0].default_value = random
            tree.links.new(value.outputs[0], emission.inputs["Color"])
            np.testing.assert_allclose(measured, self.render(), rtol=1e-5)

    def render(self):
        """The middle of a tiny picture by Cycles."""
        render = self.scene.render
        render.resolution_x = render.resolution_y = 4
        self.scene.cycles.samples = 1
        self.scene.cycles.device = "CPU"
        render.image_settings.file_format = "OPEN_EXR"
        render.image_settings.color_depth = "32"
        render.filepath = f"{self.folder}/picture.exr"
        bpy.ops.render.render(write_still=True)
        image = bpy.data.images.load(render.filepath)
        pixels = np.array(image.pixels[:])
        bpy.data.images.remove(image)
        os.remove(render.filepath)
        return pixels[:3]
