"""Node trees: what is kept, and that its numbers are Blender's."""

import bpy
import numpy as np
from mathutils import Matrix

from matcha_export.numbers import number

from .exported import SceneTest, linked, node_named


class Trees(SceneTest):
    def test_nodes_that_nothing_reaches_are_dropped(self):
        tree, color = self.surface()
        tree.nodes.new("ShaderNodeTexNoise").name = "lost"
        noise = tree.nodes.new("ShaderNodeTexNoise")
        noise.name = "kept"
        noise.noise_dimensions = "4D"
        noise.inputs["Scale"].default_value = 12.5
        tree.links.new(noise.outputs["Color"], color)
        frame = tree.nodes.new("NodeFrame")
        noise.parent = frame
        entry = self.export().tree("material")
        self.assertEqual(len(entry["nodes"]), 3)
        _, node = node_named(entry, "kept")
        self.assertEqual(node["props"]["noise_dimensions"], "4D")
        values = {s["identifier"]: s.get("value") for s in node["inputs"]}
        self.assertEqual(values["Scale"], [12.5])
        self.assertTrue(linked(entry, "kept", "Diffuse BSDF"))
        vector = next(s for s in node["inputs"] if s["identifier"] == "Vector")
        self.assertTrue(vector["hide_value"])
        w = next(s for s in node["inputs"] if s["identifier"] == "W")
        self.assertTrue(w.get("enabled", True))

    def test_sockets_that_are_switched_off(self):
        tree, color = self.surface()
        noise = tree.nodes.new("ShaderNodeTexNoise")
        tree.links.new(noise.outputs["Color"], color)
        _, node = node_named(self.export().tree("material"), noise.name)
        w = next(s for s in node["inputs"] if s["identifier"] == "W")
        self.assertFalse(w.get("enabled", True))

    def test_the_output_for_cycles(self):
        tree, color = self.surface()
        color.default_value = (1, 0, 0, 1)
        other = tree.nodes.new("ShaderNodeOutputMaterial")
        other.name, other.target = "for eevee", "EEVEE"
        emission = tree.nodes.new("ShaderNodeEmission")
        tree.links.new(emission.outputs[0], other.inputs[0])
        names = [node["name"] for node in self.export().tree("material")["nodes"]]
        self.assertEqual(sorted(names), ["Diffuse BSDF", "Material Output"])

    def test_groups_are_stored_once(self):
        inner = bpy.data.node_groups.new("inner", "ShaderNodeTree")
        inner.interface.new_socket("Amount", in_out="INPUT", socket_type="NodeSocketFloat")
        inner.interface.new_socket("Result", in_out="OUTPUT", socket_type="NodeSocketColor")
        source, sink = inner.nodes.new("NodeGroupInput"), inner.nodes.new("NodeGroupOutput")
        inner.links.new(source.outputs[0], sink.inputs[0])
        outer = bpy.data.node_groups.new("outer", "ShaderNodeTree")
        outer.interface.new_socket("Result", in_out="OUTPUT", socket_type="NodeSocketColor")
        use = outer.nodes.new("ShaderNodeGroup")
        use.node_tree = inner
        outer.links.new(use.outputs[0], outer.nodes.new("NodeGroupOutput").inputs[0])
        for name, group in (("first", inner), ("second", outer), ("third", inner)):
            tree, color = self.surface(name)
            node = tree.nodes.new("ShaderNodeGroup")
            node.name, node.node_tree = "group", group
            tree.links.new(node.outputs[0], color)
        file = self.export()
        names = [tree["name"] for tree in file.root["trees"]]
        self.assertEqual(sorted(n for n in names if n in {"inner", "outer"}), ["inner", "outer"])
        _, node = node_named(file.tree("first"), "group")
        self.assertEqual(names[node["tree"]], "inner")
        (socket,) = node["inputs"]
        _, group_input = node_named(file.tree("inner"), source.name)
        self.assertEqual(group_input["outputs"][0]["identifier"], socket["identifier"])
        _, nested = node_named(file.tree("outer"), use.name)
        self.assertEqual(names[nested["tree"]], "inner")

    def test_ramp(self):
        tree, color = self.surface()
        node = tree.nodes.new("ShaderNodeValToRGB")
        node.color_ramp.interpolation = "B_SPLINE"
        node.color_ramp.elements.new(0.3).color = (1, 0, 0, 0.5)
        tree.links.new(node.outputs["Color"], color)
        _, entry = node_named(self.export().tree("material"), node.name)
        ramp = entry["ramp"]
        self.assertEqual(ramp["interpolation"], "B_SPLINE")
        np.testing.assert_allclose([stop[0] for stop in ramp["stops"]], [0, 0.3, 1], rtol=1e-6)
        table = np.array(ramp["table"]).reshape(257, 4)
        np.testing.assert_allclose(table[77], node.color_ramp.evaluate(77 / 256), rtol=1e-6)

    def test_combined_curve_is_applied_first(self):
        tree, color = self.surface()
        node = tree.nodes.new("ShaderNodeRGBCurve")
        curves = node.mapping.curves
        curves[0].points.new(0.25, 0.75)
        curves[3].points.new(0.5, 0.2)
        node.mapping.update()
        tree.links.new(node.outputs["Color"], color)
        _, entry = node_named(self.export().tree("material"), node.name)
        tables = np.array(entry["curves"]["tables"])
        self.assertEqual(tables.shape, (4, 257))
        mapping = node.mapping
        combined = mapping.evaluate(curves[3], 100 / 256)
        self.assertAlmostEqual(tables[3, 100], combined, places=6)
        self.assertAlmostEqual(tables[0, 100], mapping.evaluate(curves[0], combined), places=6)
        self.assertAlmostEqual(tables[1, 100], combined, places=3)
        self.assertEqual(len(entry["curves"]["curves"][0]), 3)

    def test_curves_beyond_the_unit_range(self):
        tree, color = self.surface()
        node = tree.nodes.new("ShaderNodeFloatCurve")
        node.mapping.use_clip = False
        node.mapping.curves[0].points[0].location = (-2, 1)
        node.mapping.curves[0].points[1].location = (3, 2)
        node.mapping.update()
        tree.links.new(node.outputs[0], color)
        _, entry = node_named(self.export().tree("material"), node.name)
        self.assertEqual(entry["curves"]["range"], [-2, 3])
        np.testing.assert_allclose(entry["curves"]["tables"][0], np.linspace(1, 2, 257), atol=1e-5)

    def test_muted_nodes_and_links(self):
        tree, color = self.surface()
        hue = tree.nodes.new("ShaderNodeHueSaturation")
        hue.mute = True
        dropped, kept = tree.nodes.new("ShaderNodeTexNoise"), tree.nodes.new("ShaderNodeRGB")
        kept.outputs[0].default_value = (0.25, 0.5, 0.75, 1)
        tree.links.new(dropped.outputs[0], hue.inputs["Hue"]).is_muted = True
        tree.links.new(kept.outputs[0], hue.inputs["Color"])
        tree.links.new(hue.outputs[0], color)
        entry = self.export().tree("material")
        _, node = node_named(entry, hue.name)
        self.assertTrue(node["muted"])
        position = [s["identifier"] for s in node["inputs"]].index("Color")
        self.assertEqual(node["internal_links"], [[position, 0]])
        self.assertNotIn(dropped.name, [n["name"] for n in entry["nodes"]])
        self.assertEqual(node_named(entry, kept.name)[1]["outputs"][0]["value"], [0.25, 0.5, 0.75, 1])

    def test_texture_mapping(self):
        tree, color = self.surface()
        noise = tree.nodes.new("ShaderNodeTexNoise")
        noise.texture_mapping.scale = (2, 3, 4)
        noise.texture_mapping.translation = (5, 6, 7)
        tree.links.new(noise.outputs[0], color)
        _, node = node_named(self.export().tree("material"), noise.name)
        matrix = np.array(node["texture_mapping"]).reshape(4, 4).T
        np.testing.assert_allclose(matrix @ [1, 1, 1, 1], [7, 9, 11, 1])

    def test_object_of_a_texture_coordinate(self):
        tree, color = self.surface()
        target = self.add("target", None, (1, 2, 3))
        node = tree.nodes.new("ShaderNodeTexCoord")
        node.object = target
        tree.links.new(node.outputs["Object"], color)
        _, entry = node_named(self.export().tree("material"), node.name)
        matrix = np.array(entry["object_from_world"]).reshape(4, 4).T
        np.testing.assert_allclose(matrix, Matrix.Translation((-1, -2, -3)))

    def test_material_without_nodes_and_face_without_material(self):
        material = bpy.data.materials.new("plain")
        if bpy.app.version < (5, 0):
            material.use_nodes = False
            material.diffuse_color = (0.1, 0.2, 0.3, 1)
            mesh = self.quad("with")
            mesh.materials.append(material)
            self.add("with", mesh)
        self.add("without", self.quad("without"))
        file = self.export()
        _, node = node_named(file.tree("Default Surface"), "Diffuse BSDF")
        self.assertEqual(node["inputs"][0]["value"], [0.8, 0.8, 0.8, 1.0])
        if bpy.app.version < (5, 0):
            _, node = node_named(file.tree("plain"), "Diffuse BSDF")
            np.testing.assert_allclose(node["inputs"][0]["value"], (0.1, 0.2, 0.3, 1), rtol=1e-6)

    def test_numbers_are_finite_and_single_precision(self):
        self.assertEqual(number(float("-inf")), -3.4028235e38)
        self.assertEqual(number(float("nan")), 0.0)
        for value in np.float32([0.1, 1 / 3, 3.4028235e38, 1e-42]):
            self.assertEqual(np.float32(number(value)), value)

    def test_animated_values_are_those_of_the_frame(self):
        tree, color = self.surface()
        value = tree.nodes.new("ShaderNodeValue")
        tree.links.new(value.outputs[0], color)
        for frame in (1, 11):
            value.outputs[0].default_value = frame
            value.outputs[0].keyframe_insert("default_value", frame=frame)
        self.scene.frame_set(11)
        _, node = node_named(self.export().tree("material"), value.name)
        self.assertEqual(node["outputs"][0]["value"], [11])
