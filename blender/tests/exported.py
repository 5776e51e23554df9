"""Small scenes, exported and read back."""

import json
import os
import struct
import tempfile
import unittest

import bpy
import numpy as np

from matcha_export import scene
from matcha_export.report import Report

COMPONENT = {5126: np.float32, 5125: np.uint32, 5123: np.uint16}
WIDTH = {"SCALAR": 1, "VEC2": 2, "VEC3": 3, "VEC4": 4}
NAME = "MATCHA_cycles"


class Exported:
    """A GLB file's document and its arrays."""

    def __init__(self, data, warnings=()):
        magic, version, total = struct.unpack_from("<4sII", data)
        assert (magic, version, total) == (b"glTF", 2, len(data)), "not a GLB file"
        size, kind = struct.unpack_from("<I4s", data, 12)
        assert kind == b"JSON"
        self.json = json.loads(data[20 : 20 + size])
        self.binary = data[28 + size :]
        self.warnings = list(warnings)
        self.root = self.json["extensions"][NAME]

    def view(self, index):
        """Bytes of a buffer view."""
        view = self.json["bufferViews"][index]
        return self.binary[view["byteOffset"] : view["byteOffset"] + view["byteLength"]]

    def array(self, index):
        """An accessor's content, (n,) or (n, components)."""
        accessor = self.json["accessors"][index]
        flat = np.frombuffer(self.view(accessor["bufferView"]), COMPONENT[accessor["componentType"]])
        width = WIDTH[accessor["type"]]
        assert len(flat) == accessor["count"] * width
        return flat.reshape(-1, width) if width > 1 else flat

    def vertex(self, mesh, semantic):
        """A vertex array of a mesh."""
        return self.array(self.json["meshes"][mesh]["primitives"][0]["attributes"][semantic])

    def triangles(self, mesh):
        """Number of triangles of a mesh."""
        return sum(len(self.array(p["indices"])) for p in self.json["meshes"][mesh]["primitives"]) // 3

    def placed(self):
        """(node, global matrix) of every node with a mesh; crowds are not written out."""
        found = []

        def visit(index, outer):
            node = self.json["nodes"][index]
            world = outer @ local(node)
            if "mesh" in node:
                found.append((node, world))
            for child in node.get("children", ()):
                visit(child, world)

        for root in self.json["scenes"][0]["nodes"]:
            visit(root, np.eye(4))
        return found

    def about(self, kind, name):
        """Extension entry of a node: kind is object, light or camera."""
        entries = [n["extensions"][NAME][kind] for n in self.json["nodes"] if kind in n.get("extensions", {}).get(NAME, {})]
        return next(entry for entry in entries if entry["name"] == name)

    def tree(self, name):
        """A node tree by name."""
        return next(tree for tree in self.root["trees"] if tree["name"] == name)


def local(node):
    """Matrix of a node's translation, rotation and scale."""
    x, y, z, w = node.get("rotation", (0, 0, 0, 1))
    matrix = np.eye(4)
    matrix[:3, :3] = [
        [1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
        [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
        [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)],
    ]
    matrix[:3, :3] *= node.get("scale", (1, 1, 1))
    matrix[:3, 3] = node.get("translation", (0, 0, 0))
    return matrix


def node_named(tree, name):
    """(position, node) in an exported tree."""
    return next((i, node) for i, node in enumerate(tree["nodes"]) if node["name"] == name)


def linked(tree, source, target):
    """True if a link leads from one node to another."""
    pair = node_named(tree, source)[0], node_named(tree, target)[0]
    return any((link["from"][0], link["to"][0]) == pair for link in tree["links"])


class SceneTest(unittest.TestCase):
    """Starts each test with an empty scene and a camera."""

    def setUp(self):
        bpy.ops.wm.read_factory_settings(use_empty=True)
        self.scene = bpy.context.scene
        self.scene.render.engine = "CYCLES"
        self.camera = self.add("camera", bpy.data.cameras.new("camera"))
        self.scene.camera = self.camera
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = folder.name

    def add(self, name, data, location=(0, 0, 0)):
        """Links a new object to the scene."""
        obj = bpy.data.objects.new(name, data)
        obj.location = location
        self.scene.collection.objects.link(obj)
        return obj

    def quad(self, name="quad", uv=True):
        """A unit square in the XY plane, with UV equal to position."""
        mesh = bpy.data.meshes.new(name)
        mesh.from_pydata([(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0)], [], [(0, 1, 2, 3)])
        if uv:
            layer = mesh.uv_layers.new(name="UVMap")
            layer.uv.foreach_set("vector", [0, 0, 1, 0, 1, 1, 0, 1])
        return mesh

    def material(self, name="material"):
        """A material with an empty tree and an output; returns (material, tree, output)."""
        material = bpy.data.materials.new(name)
        material.use_nodes = True
        tree = material.node_tree
        tree.nodes.clear()
        return material, tree, tree.nodes.new("ShaderNodeOutputMaterial")

    def surface(self, name="material"):
        """A material with a diffuse closure, worn by a new square; returns (tree, colour input)."""
        material, tree, output = self.material(name)
        diffuse = tree.nodes.new("ShaderNodeBsdfDiffuse")
        tree.links.new(diffuse.outputs[0], output.inputs["Surface"])
        mesh = self.quad(name)
        mesh.materials.append(material)
        self.add(name, mesh)
        return tree, diffuse.inputs["Color"]

    def export(self):
        """Exports the scene and reads it back."""
        path = os.path.join(self.folder, "scene.glb")
        with open(os.devnull, "w", encoding="utf-8") as nowhere:
            report = Report(stream=nowhere)
            scene.export(path, report)
        self.assertEqual(os.listdir(self.folder), ["scene.glb"])
        with open(path, "rb") as file:
            return Exported(file.read(), report.warnings)
