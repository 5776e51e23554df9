"""Values of shader nodes as Cycles gives them, for the Rust tests.

    /path/to/python-with-bpy blender/tests/node_reference.py OUT.json

Each case is one node with some inputs constant and some read from the mesh. A case is a row
of small squares that emit the node's output; each square has its own constant attributes
`a`, `b` and `c`, and covers one pixel of an orthographic picture of all cases.
"""

import json
import sys
import tempfile
from pathlib import Path

import bpy
import numpy as np

sys.path += [str(Path(__file__).parent), str(Path(__file__).parents[1])]
from matcha_export import node_values  # noqa: E402
from node_cases import CASES  # noqa: E402

POINTS = 24
ATTRIBUTES = ("a", "b", "c")


def points():
    """Vectors in different ranges, the same in every run: (3, POINTS, 3)."""
    rng = np.random.default_rng(20261123)
    a = rng.uniform(-3.0, 3.0, (POINTS, 3))
    b = rng.uniform(0.0, 1.0, (POINTS, 3))
    c = rng.uniform(-40.0, 40.0, (POINTS, 3))
    a[0] = (0.0, 0.0, 0.0)
    b[1] = (1.0, 0.0, 0.5)
    return np.stack([a, b, c]).astype(np.float32)


def row_mesh(values, y):
    """Squares from x = 0 on, at height y, with constant attributes each."""
    corners = []
    for x in range(POINTS):
        corners += [(x, y, 0), (x + 1, y, 0), (x + 1, y + 1, 0), (x, y + 1, 0)]
    mesh = bpy.data.meshes.new("row")
    mesh.from_pydata(corners, [], [[4 * i + k for k in range(4)] for i in range(POINTS)])
    for name, rows in zip(ATTRIBUTES, values):
        layer = mesh.attributes.new(name, "FLOAT_VECTOR", "POINT")
        layer.data.foreach_set("vector", np.repeat(rows, 4, axis=0).ravel())
    return mesh


class Builder:
    """The node tree of one case."""

    def __init__(self, material):
        material.use_nodes = True
        self.tree = material.node_tree
        self.tree.nodes.clear()

    def source(self, text):
        """`a`, or one of its components: `a.x`."""
        name, _, part = text.partition(".")
        node = self.tree.nodes.new("ShaderNodeAttribute")
        node.attribute_name = name
        if not part:
            return node.outputs["Vector"]
        split = self.tree.nodes.new("ShaderNodeSeparateXYZ")
        self.tree.links.new(node.outputs["Vector"], split.inputs[0])
        return split.outputs[part.upper()]

    def case(self, case):
        """The node, its inputs, and an emission of its output."""
        node = self.tree.nodes.new(case["type"])
        for name, value in case.get("props", {}).items():
            setattr(node, name, value)
        if "stops" in case:
            ramp(node.color_ramp, case["stops"])
        if "curves" in case:
            curves(node.mapping, case["curves"])
        if "value" in case:
            node.outputs[0].default_value = case["value"]
        for identifier, value in case.get("inputs", {}).items():
            socket = next(s for s in node.inputs if s.identifier == identifier)
            if isinstance(value, str):
                self.tree.links.new(self.source(value), socket)
            else:
                socket.default_value = value
        emission = self.tree.nodes.new("ShaderNodeEmission")
        output = self.tree.nodes.new("ShaderNodeOutputMaterial")
        result = next(s for s in node.outputs if s.identifier == case["output"])
        self.tree.links.new(result, emission.inputs["Color"])
        self.tree.links.new(emission.outputs[0], output.inputs["Surface"])
        return node


def ramp(widget, stops):
    """Sets a ramp's stops: (position, colour)."""
    while len(widget.elements) > 1:
        widget.elements.remove(widget.elements[-1])
    for i, (position, color) in enumerate(stops):
        stop = widget.elements[0] if i == 0 else widget.elements.new(position)
        stop.position = position
        stop.color = color


def curves(mapping, points_of):
    """Adds points to curves, by index."""
    for curve, added in zip(mapping.curves, points_of):
        for x, y in added:
            curve.points.new(x, y)
    mapping.update()


def content(node):
    """The parts of a node that its sockets and properties do not hold."""
    found = {}
    if hasattr(node, "color_ramp"):
        found["ramp"] = node_values.ramp(node.color_ramp)
    if hasattr(node, "mapping") and hasattr(node.mapping, "curves"):
        found["curves"] = node_values.curves(node.mapping)
        found["curves"]["curves"] = []
    return found


def render(width, height):
    """The scene's picture, linear, bottom row first."""
    scene = bpy.context.scene
    scene.render.engine = "CYCLES"
    scene.cycles.samples = 1
    scene.cycles.use_adaptive_sampling = False
    scene.cycles.use_denoising = False
    scene.cycles.pixel_filter_type = "BOX"
    scene.cycles.max_bounces = 0
    scene.render.resolution_x, scene.render.resolution_y = width, height
    scene.render.resolution_percentage = 100
    scene.view_settings.view_transform = "Raw"
    camera = bpy.data.objects.new("camera", bpy.data.cameras.new("camera"))
    camera.data.type = "ORTHO"
    camera.data.sensor_fit = "HORIZONTAL"
    camera.data.ortho_scale = width
    camera.location = (width / 2, height / 2, 10)
    scene.collection.objects.link(camera)
    scene.camera = camera
    settings = scene.render.image_settings
    settings.file_format, settings.color_depth, settings.exr_codec = "OPEN_EXR", "32", "NONE"
    with tempfile.TemporaryDirectory() as folder:
        scene.render.filepath = str(Path(folder) / "nodes.exr")
        bpy.ops.render.render(write_still=True)
        image = bpy.data.images.load(scene.render.filepath)
        image.colorspace_settings.name = "Non-Color"
        flat = np.empty(width * height * 4, np.float32)
        image.pixels.foreach_get(flat)
    return flat.reshape(height, width, 4)[:, :, :3]


def main(out):
    bpy.ops.wm.read_factory_settings(use_empty=True)
    values = points()
    described = []
    for y, case in enumerate(CASES):
        mesh = row_mesh(values, y)
        material = bpy.data.materials.new(f"case {y}")
        node = Builder(material).case(case)
        mesh.materials.append(material)
        bpy.context.scene.collection.objects.link(bpy.data.objects.new(f"case {y}", mesh))
        socket_types = {s.identifier: s.type for s in node.inputs}
        inputs = {k: [socket_types[k], v] for k, v in case.get("inputs", {}).items()}
        kept = {s.identifier: s for s in node.inputs}
        for identifier, socket in kept.items():
            if identifier in inputs or not hasattr(socket, "default_value"):
                continue
            value = socket.default_value
            plain = value if isinstance(value, (int, float, bool)) else [round(v, 6) for v in value]
            inputs[identifier] = [socket.type, plain]
        result = next(s for s in node.outputs if s.identifier == case["output"])
        entry = {"type": case["type"], "props": case.get("props", {}), "inputs": inputs}
        entry |= {"output": [case["output"], result.type], **content(node)}
        if "value" in case:
            entry["value"] = case["value"]
        described.append(entry)
    picture = render(POINTS, len(CASES))
    for y, entry in enumerate(described):
        entry["expected"] = [[float(f"{v:.8g}") for v in pixel] for pixel in picture[y].tolist()]
    data = {
        "blender": bpy.app.version_string,
        "points": [[[float(f"{v:.9g}") for v in p] for p in rows] for rows in values.tolist()],
        "cases": described,
    }
    text = json.dumps(data).replace('}, {"type"', '},\n{"type"')
    Path(out).write_text(text + "\n", encoding="utf-8")


if __name__ == "__main__":
    main(sys.argv[-1])
