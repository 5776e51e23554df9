"""Meshes: what is evaluated, and what arrives."""

import bpy
import numpy as np
from mathutils import Matrix

from matcha_export import islands

from .exported import NAME, SceneTest


class Geometry(SceneTest):
    def test_axes_and_flipped_v(self):
        mesh = self.quad()
        mesh.transform(Matrix.Translation((0, 2, 3)))
        self.add("quad", mesh)
        file = self.export()
        positions, uv = file.vertex(0, "POSITION"), file.vertex(0, "TEXCOORD_0")
        self.assertEqual(len(positions), 4)
        np.testing.assert_allclose(positions[:, 1], 3.0)
        np.testing.assert_allclose(-positions[:, 2], uv_to_blender(uv)[:, 1] + 2.0)
        np.testing.assert_allclose(positions[:, 0], uv_to_blender(uv)[:, 0])
        np.testing.assert_allclose(file.vertex(0, "NORMAL"), [[0, 1, 0]] * 4, atol=1e-6)

    def test_modifiers_have_render_levels(self):
        obj = self.add("quad", self.quad())
        modifier = obj.modifiers.new("subdivision", "SUBSURF")
        modifier.subdivision_type = "SIMPLE"
        modifier.levels, modifier.render_levels = 1, 3
        hidden = obj.modifiers.new("viewport only", "ARRAY")
        hidden.show_render = False
        self.assertEqual(self.export().triangles(0), 2 * 4**3)

    def test_what_is_hidden_from_render_only(self):
        self.add("shown", self.quad("a")).hide_viewport = True
        self.add("hidden", self.quad("b")).hide_render = True
        names = [node["name"] for node, _ in self.export().placed()]
        self.assertEqual(names, ["shown"])

    def test_flat_and_smooth_faces(self):
        bpy.ops.mesh.primitive_cube_add()
        cube = bpy.context.object.data
        file = self.export()
        self.assertEqual(len(file.vertex(0, "POSITION")), 24)
        for layer in list(cube.uv_layers):
            cube.uv_layers.remove(layer)
        for face in cube.polygons:
            face.use_smooth = True
        file = self.export()
        self.assertEqual(len(file.vertex(0, "POSITION")), 8)
        directions = file.vertex(0, "POSITION") / np.sqrt(3.0)
        np.testing.assert_allclose(file.vertex(0, "NORMAL"), directions, atol=1e-5)

    def test_custom_normals(self):
        mesh = self.quad()
        tilted = np.array([0.6, 0.0, 0.8])
        mesh.normals_split_custom_set([tilted] * 4)
        self.add("quad", mesh)
        np.testing.assert_allclose(self.export().vertex(0, "NORMAL"), [[0.6, 0.8, 0.0]] * 4, atol=1e-3)

    def test_vertex_groups_and_edge_attributes(self):
        tree, color = self.surface()
        obj = bpy.data.objects["material"]
        edges = obj.data.attributes.new("edges", "FLOAT", "EDGE")
        edges.data.foreach_set("value", [float(0 in edge.vertices) for edge in obj.data.edges])
        marks = obj.data.attributes.new("marks", "BOOLEAN", "EDGE")
        marks.data.foreach_set("value", [0 in edge.vertices for edge in obj.data.edges])
        obj.vertex_groups.new(name="other").add([1], 0.75, "REPLACE")
        obj.vertex_groups.new(name="weight").add([2], 0.25, "REPLACE")
        mix = tree.nodes.new("ShaderNodeMix")
        mix.data_type = "RGBA"
        for name, socket in (("edges", mix.inputs[6]), ("weight", mix.inputs[7]), ("marks", mix.inputs[0])):
            node = tree.nodes.new("ShaderNodeAttribute")
            node.attribute_name = name
            tree.links.new(node.outputs["Color"], socket)
        tree.links.new(mix.outputs[2], color)
        file = self.export()
        (mesh,) = file.json["meshes"]
        about = {e["name"]: e for e in mesh["extensions"][NAME]["attributes"]}
        self.assertEqual(set(about), {"edges", "marks", "weight"})
        corners = uv_to_blender(file.vertex(0, "TEXCOORD_0"))
        found = {name: file.vertex(0, entry["semantic"]).ravel() for name, entry in about.items()}
        # Both edges of the corner at the origin have 1, one of each of its neighbours.
        np.testing.assert_allclose(found["edges"], 1.0 - 0.5 * corners.sum(axis=1))
        np.testing.assert_allclose(found["marks"], 1.0 - corners.prod(axis=1))
        np.testing.assert_allclose(found["weight"], 0.25 * corners.prod(axis=1))

    def test_only_attributes_that_are_read(self):
        tree, color = self.surface()
        mesh = bpy.data.meshes["material"]
        mesh.color_attributes.new("bytes", "BYTE_COLOR", "CORNER")
        for corner in mesh.color_attributes["bytes"].data:
            corner.color_srgb = (0.5, 0.5, 0.5, 1.0)
        floats = mesh.attributes.new("heights", "FLOAT", "POINT")
        floats.data.foreach_set("value", [1, 2, 3, 4])
        mesh.attributes.new("unread", "FLOAT", "POINT")
        read_color = tree.nodes.new("ShaderNodeVertexColor")
        read_color.layer_name = "bytes"
        read_float = tree.nodes.new("ShaderNodeAttribute")
        read_float.attribute_name = "heights"
        mix = tree.nodes.new("ShaderNodeMix")
        mix.data_type = "RGBA"
        tree.links.new(read_color.outputs["Color"], mix.inputs[6])
        tree.links.new(read_float.outputs["Fac"], mix.inputs[0])
        tree.links.new(mix.outputs[2], color)
        file = self.export()
        entries = {e["name"]: e for e in file.json["meshes"][0]["extensions"][NAME]["attributes"]}
        self.assertEqual(set(entries), {"bytes", "heights"})
        self.assertEqual(entries["bytes"]["kind"], "COLOR")
        linear = ((128 / 255 + 0.055) / 1.055) ** 2.4
        np.testing.assert_allclose(file.vertex(0, entries["bytes"]["semantic"])[:, :3], linear, rtol=1e-3)
        heights = file.vertex(0, entries["heights"]["semantic"])
        self.assertEqual(sorted(heights.ravel()), [1, 2, 3, 4])

    def test_islands_are_numbered_as_in_cycles(self):
        # Roots of the trees that these edges make: 1 (joined first), then 3.
        self.assertEqual(islands.join(np.array([[1, 0], [3, 4], [4, 2]]), 5), [1, 1, 3, 3, 3])
        tree, color = self.surface()
        node = tree.nodes.new("ShaderNodeNewGeometry")
        tree.links.new(node.outputs["Random Per Island"], color)
        file = self.export()
        self.assertEqual(file.json["meshes"][0]["extensions"][NAME]["island"], "_ISLAND")
        values = file.vertex(0, "_ISLAND").ravel()
        self.assertEqual(len(set(values)), 1)
        self.assertTrue(0.0 <= values[0] <= 1.0)

    def test_generated_coordinates(self):
        self.add("quad", self.quad())
        entry = self.export().json["meshes"][0]["extensions"][NAME]
        np.testing.assert_allclose(entry["generated_origin"][:2], [0, 0], atol=1e-6)
        np.testing.assert_allclose(entry["generated_size"][:2], [1, 1], atol=1e-6)

    def test_generated_coordinates_stay_under_deformation(self):
        tree, color = self.surface()
        coordinate = tree.nodes.new("ShaderNodeTexCoord")
        tree.links.new(coordinate.outputs["Generated"], color)
        group = bpy.data.objects["material"].modifiers.new("bend", "SIMPLE_DEFORM")
        group.deform_method, group.factor, group.deform_axis = "TAPER", 1.0, "X"
        file = self.export()
        self.assertEqual(file.json["meshes"][0]["extensions"][NAME]["generated"], "_GENERATED")
        generated = file.vertex(0, "_GENERATED")[:, :2]
        self.assertEqual(sorted(map(tuple, np.rint(generated * 1000))), [(0, 0), (0, 1000), (1000, 0), (1000, 1000)])

    def test_generated_coordinates_behind_a_group_input_that_nothing_feeds(self):
        inner = bpy.data.node_groups.new("inner", "ShaderNodeTree")
        inner.interface.new_socket("Vector", in_out="INPUT", socket_type="NodeSocketVector")
        inner.interface.new_socket("Color", in_out="OUTPUT", socket_type="NodeSocketColor")
        source, noise, sink = (
            inner.nodes.new(kind) for kind in ("NodeGroupInput", "ShaderNodeTexNoise", "NodeGroupOutput")
        )
        inner.links.new(source.outputs[0], noise.inputs["Vector"])
        inner.links.new(noise.outputs["Color"], sink.inputs[0])
        tree, color = self.surface()
        use = tree.nodes.new("ShaderNodeGroup")
        use.node_tree = inner
        tree.links.new(use.outputs[0], color)
        group = bpy.data.objects["material"].modifiers.new("bend", "SIMPLE_DEFORM")
        group.deform_method, group.factor, group.deform_axis = "TAPER", 1.0, "X"
        self.assertIn("generated", self.export().json["meshes"][0]["extensions"][NAME])

    def test_slots_and_materials_of_the_object(self):
        mesh = self.quad()
        red, blue = bpy.data.materials.new("red"), bpy.data.materials.new("blue")
        mesh.materials.append(red)
        self.add("as mesh", mesh)
        other = self.add("as object", mesh)
        other.material_slots[0].link = "OBJECT"
        other.material_slots[0].material = blue
        file = self.export()
        names = [material["name"] for material in file.json["materials"]]
        self.assertEqual(len(file.json["meshes"]), 1)
        slots = file.json["meshes"][0]["extensions"][NAME]["material_slots"]
        self.assertEqual([names[i] for i in slots], ["red"])
        self.assertNotIn("materials", file.about("object", "as mesh"))
        self.assertEqual([names[i] for i in file.about("object", "as object")["materials"]], ["blue"])

    def test_one_primitive_a_slot_sharing_vertices(self):
        bpy.ops.mesh.primitive_cube_add()
        cube = bpy.context.object.data
        for name in ("zero", "one", "two"):
            cube.materials.append(bpy.data.materials.new(name))
        cube.polygons[0].material_index = 2
        file = self.export()
        primitives = file.json["meshes"][0]["primitives"]
        self.assertEqual([p["extensions"][NAME]["slot"] for p in primitives], [0, 2])
        self.assertEqual([len(file.array(p["indices"])) // 3 for p in primitives], [10, 2])
        self.assertEqual(primitives[0]["attributes"], primitives[1]["attributes"])
        self.assertEqual(len(file.json["meshes"][0]["extensions"][NAME]["material_slots"]), 3)

    def test_texts_and_curves_arrive_once(self):
        bpy.ops.object.text_add()
        bpy.context.object.data.materials.append(bpy.data.materials.new("ink"))
        bpy.ops.curve.primitive_bezier_circle_add(location=(2, 0, 0))
        bpy.context.object.data.bevel_depth = 0.1
        bpy.ops.object.metaball_add(location=(5, 0, 0))
        file = self.export()
        self.assertEqual(len(file.placed()), 3)
        self.assertIn("ink", [material["name"] for material in file.json["materials"]])

    def test_nothing_to_see(self):
        self.add("empty mesh", bpy.data.meshes.new("empty"))
        edge = bpy.data.meshes.new("edge")
        edge.from_pydata([(0, 0, 0), (1, 0, 0)], [(0, 1)], [])
        self.add("edge", edge)
        self.assertEqual(self.export().placed(), [])

    def test_positions_that_are_not_finite(self):
        mesh = self.quad()
        mesh.vertices[0].co = (float("nan"), float("inf"), 0.0)
        self.add("quad", mesh)
        file = self.export()
        self.assertTrue(np.isfinite(file.vertex(0, "POSITION")).all())
        self.assertTrue(any("not finite" in text for text in file.warnings))


def uv_to_blender(uv):
    return np.stack([uv[:, 0], 1.0 - uv[:, 1]], axis=1)
