"""Mesh attributes as arrays over face corners."""

import numpy as np

# Blender's attribute types that a shader can read: components, RNA field, what they mean.
READABLE = {
    "FLOAT": (1, "value", "FLOAT"),
    "INT": (1, "value", "FLOAT"),
    "INT8": (1, "value", "FLOAT"),
    "BOOLEAN": (1, "value", "FLOAT"),
    "FLOAT2": (2, "vector", "VECTOR"),
    "FLOAT_VECTOR": (3, "vector", "VECTOR"),
    "FLOAT_COLOR": (4, "color", "COLOR"),
    # RNA's `color` of a byte colour is linear already.
    "BYTE_COLOR": (4, "color", "COLOR"),
}


def read(attribute):
    """(n, components) floats in the attribute's own domain, or None where it is not readable."""
    if attribute.data_type not in READABLE:
        return None
    width, name, _ = READABLE[attribute.data_type]
    count = len(attribute.data)
    dtype = {"INT": np.int32, "INT8": np.int32, "BOOLEAN": bool}.get(attribute.data_type, np.float32)
    flat = np.empty(count * width, dtype=dtype)
    attribute.data.foreach_get(name, flat)
    return flat.astype(np.float32).reshape(count, width)


def on_corners(mesh, attribute, corner_vertices, corner_faces):
    """The attribute at each face corner, or None."""
    values = read(attribute)
    if values is None or not len(values):
        return None
    if attribute.domain == "EDGE":
        at_vertex = any_at_vertices if attribute.data_type == "BOOLEAN" else at_vertices
        return at_vertex(mesh, values)[corner_vertices]
    if attribute.domain == "POINT":
        return values[corner_vertices]
    if attribute.domain == "FACE":
        return values[corner_faces]
    return values if attribute.domain == "CORNER" else None


def edge_ends(mesh):
    ends = np.empty(2 * len(mesh.edges), dtype=np.int32)
    mesh.edges.foreach_get("vertices", ends)
    return ends


def any_at_vertices(mesh, of_edges):
    """What Cycles makes of a yes or no at edges: yes at a vertex where one of its edges says so."""
    values = np.zeros((len(mesh.vertices), of_edges.shape[1]), dtype=np.float32)
    np.maximum.at(values, edge_ends(mesh), np.repeat(of_edges, 2, axis=0))
    return values


def at_vertices(mesh, of_edges):
    """What Cycles makes of an edge attribute: each vertex has the mean of its edges."""
    ends = edge_ends(mesh)
    total = np.zeros((len(mesh.vertices), of_edges.shape[1]))
    np.add.at(total, ends, np.repeat(of_edges, 2, axis=0))
    count = np.bincount(ends, minlength=len(mesh.vertices))
    return (total / np.maximum(count, 1)[:, None]).astype(np.float32)


def weights(mesh, groups):
    """Vertex groups, by their places in the object's list: a number at each vertex, by place."""
    values = {group: np.zeros((len(mesh.vertices), 1), dtype=np.float32) for group in groups}
    if not values:
        return values
    # There is no `foreach_get` for them; one way through the vertices is for all groups.
    for vertex in mesh.vertices:
        for member in vertex.groups:
            if member.group in values:
                values[member.group][vertex.index] = member.weight
    return values


def meaning(attribute):
    """`FLOAT`, `VECTOR` or `COLOR`."""
    return READABLE[attribute.data_type][2]
