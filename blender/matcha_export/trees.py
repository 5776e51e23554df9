"""Shader node trees: every node that reaches the output, groups once each."""

from dataclasses import dataclass, field

import bpy

from . import node_values as values
from .numbers import columns

GROUP_OUTPUT = "NodeGroupOutput"
IMAGE_NODES = {"ShaderNodeTexImage", "ShaderNodeTexEnvironment"}
HAND_ON = {"NodeGroupInput", "NodeReroute", "ShaderNodeGroup"}
RAMP_NODES = {"ShaderNodeValToRGB"}
CURVE_NODES = {"ShaderNodeRGBCurve", "ShaderNodeVectorCurve", "ShaderNodeFloatCurve"}


@dataclass
class Needs:
    """What a tree reads from the mesh that wears it."""

    attributes: set = field(default_factory=set)
    active_color: bool = False
    generated: bool = False
    islands: bool = False

    def include(self, other):
        """Adds another tree's needs."""
        self.attributes |= other.attributes
        self.active_color |= other.active_color
        self.generated |= other.generated
        self.islands |= other.islands


class Trees:
    """All trees of the file, in the order of `MATCHA_cycles.trees`."""

    def __init__(self, images, report):
        self.images = images
        self.report = report
        self.entries = []
        self.needs = []
        self._groups = {}

    def add(self, node_tree, name, target="CYCLES"):
        """Stores a material's, light's or world's own tree; returns its index."""
        return self._store(node_tree, name, node_tree.get_output_node(target))

    def add_built(self, entry, needs=None):
        """Stores a tree that exists in no node editor."""
        self.entries.append(entry)
        self.needs.append(needs or Needs())
        return len(self.entries) - 1

    def _group(self, node_tree):
        key = node_tree.original.as_pointer()
        if key not in self._groups:
            outputs = [n for n in node_tree.nodes if n.bl_idname == GROUP_OUTPUT]
            active = next((n for n in outputs if n.is_active_output), None)
            self._groups[key] = self._store(node_tree, node_tree.name, active, key)
        return self._groups[key]

    def _store(self, node_tree, name, output, group_key=None):
        index = len(self.entries)
        entry = {"name": name, "nodes": [], "links": []}
        needs = Needs()
        self.entries.append(entry)
        self.needs.append(needs)
        if group_key is not None:
            self._groups[group_key] = index
        if output is None:
            self.report.warning(f"{name}: the node tree has no active output for Cycles")
            return index
        links = [link for link in node_tree.links if carries(link)]
        kept = upstream(node_tree, links, output)
        place = {node.as_pointer(): i for i, node in enumerate(kept)}
        linked = {link.to_socket.as_pointer() for link in links if not hands_on(link.from_node)}
        entry["nodes"] = [self._node(node, name, needs, linked) for node in kept]
        ports = Ports(kept)
        entry["links"] = [
            {"from": ports.output(link, place), "to": ports.input(link, place)}
            for link in links
            if link.to_node.as_pointer() in place
        ]
        return index

    def _node(self, node, tree_name, needs, linked):
        kind = node.bl_idname

        def warn(text):
            self.report.warning(f"{tree_name}, node {node.name}: {text}")

        entry = {"name": node.name, "type": kind, "props": values.properties(node)}
        if node.inputs:
            entry["inputs"] = [values.socket(s, True) for s in node.inputs]
        if node.outputs:
            content = kind in values.CONTENT_IN_OUTPUT
            entry["outputs"] = [values.socket(s, content) for s in node.outputs]
        self._menus(node, entry["props"])
        if node.mute:
            entry["muted"] = True
            entry["internal_links"] = internal_links(node)
        self._references(node, entry, needs, warn)
        note_needs(node, needs, linked)
        return entry

    def _menus(self, node, props):
        # A menu socket's choice is a text, which a socket's value cannot hold.
        for sock in node.inputs:
            if sock.type == "MENU":
                props.setdefault(sock.identifier, sock.default_value)

    def _references(self, node, entry, needs, warn):
        kind = node.bl_idname
        inner = getattr(node, "node_tree", None)
        if inner is not None:
            entry["tree"] = self._group(inner)
            needs.include(self.needs[entry["tree"]])
        if kind in IMAGE_NODES and node.image is not None:
            entry["image"] = self.images.add(node.image, node.image_user, warn)
        if kind in RAMP_NODES:
            entry["ramp"] = values.ramp(node.color_ramp)
        if kind in CURVE_NODES:
            entry["curves"] = values.curves(node.mapping)
        if hasattr(node, "texture_mapping"):
            matrix = values.texture_mapping(node.texture_mapping, warn)
            if matrix is not None:
                entry["texture_mapping"] = matrix
        target = getattr(node, "object", None)
        if target is not None:
            entry["object_from_world"] = columns(target.matrix_world.inverted_safe())


def tree_in_use(owner):
    """The node tree of a material, light or world, None where it is rendered without one."""
    # Since Blender 5 materials and worlds always use theirs, and asking is deprecated.
    always = bpy.app.version >= (5, 0) and not isinstance(owner, bpy.types.Light)
    return owner.node_tree if always or owner.use_nodes else None


def carries(link):
    """False for links that Cycles ignores."""
    return (
        link.is_valid
        and not link.is_muted
        and values.available(link.from_socket)
        and values.available(link.to_socket)
    )


def upstream(node_tree, links, output):
    """The nodes from which links lead to `output`, in the tree's own order."""
    sources = {}
    for link in links:
        sources.setdefault(link.to_node.as_pointer(), []).append(link.from_node)
    reached = {output.as_pointer()}
    waiting = [output]
    while waiting:
        for node in sources.get(waiting.pop().as_pointer(), ()):
            if node.as_pointer() not in reached:
                reached.add(node.as_pointer())
                waiting.append(node)
    return [node for node in node_tree.nodes if node.as_pointer() in reached]


class Ports:
    """Positions of sockets in their nodes."""

    def __init__(self, nodes):
        self._inputs = {s.as_pointer(): i for n in nodes for i, s in enumerate(n.inputs)}
        self._outputs = {s.as_pointer(): i for n in nodes for i, s in enumerate(n.outputs)}

    def output(self, link, place):
        """(node, socket) where the link starts."""
        return [place[link.from_node.as_pointer()], self._outputs[link.from_socket.as_pointer()]]

    def input(self, link, place):
        """(node, socket) where the link ends."""
        return [place[link.to_node.as_pointer()], self._inputs[link.to_socket.as_pointer()]]


def hands_on(node):
    """True for nodes behind which nothing may be linked: a default then stays in place."""
    return node.mute or node.bl_idname in HAND_ON


def internal_links(node):
    """Pairs (input, output) that a muted node connects."""
    ins = {s.as_pointer(): i for i, s in enumerate(node.inputs)}
    outs = {s.as_pointer(): i for i, s in enumerate(node.outputs)}
    return [
        [ins[link.from_socket.as_pointer()], outs[link.to_socket.as_pointer()]]
        for link in node.internal_links
    ]


def note_needs(node, needs, linked):
    """Records which mesh data the node reads."""
    kind = node.bl_idname
    if kind == "ShaderNodeAttribute" and node.attribute_type == "GEOMETRY":
        needs.attributes.add(node.attribute_name)
    elif kind == "ShaderNodeVertexColor":
        needs.attributes.add(node.layer_name)
        needs.active_color |= not node.layer_name
    elif kind in {"ShaderNodeUVMap", "ShaderNodeNormalMap", "ShaderNodeTangent"}:
        needs.attributes.add(node.uv_map)
    elif kind == "ShaderNodeTexCoord":
        needs.generated |= any(s.is_linked for s in node.outputs if s.identifier == "Generated")
    elif kind == "ShaderNodeNewGeometry":
        needs.islands |= node.outputs["Random Per Island"].is_linked
    elif kind.startswith("ShaderNodeTex") and kind not in IMAGE_NODES:
        vector = node.inputs.get("Vector")
        needs.generated |= vector is not None and vector.as_pointer() not in linked
