"""A Blender mesh as indexed triangles: equal face corners become one vertex."""

from dataclasses import dataclass

import numpy as np

from . import attributes, axes, islands


@dataclass
class Geometry:
    """Arrays of one mesh, in glTF's conventions."""

    positions: np.ndarray
    normals: np.ndarray
    uvs: list  # (name, array)
    extras: list  # (name, meaning, array)
    triangles: list  # (slot, indices) of the slots in use
    generated: np.ndarray | None
    islands: np.ndarray | None


def field(collection, name, width, dtype=np.float32):
    """A column of an RNA collection."""
    flat = np.empty(len(collection) * width, dtype=dtype)
    collection.foreach_get(name, flat)
    return flat.reshape(-1, width) if width > 1 else flat


def extract(mesh, slot_count, needs, groups, warn):
    """The geometry of an evaluated mesh, or None where it has no triangle.

    `groups` are the names of its object's vertex groups.
    """
    mesh.calc_loop_triangles()
    if not len(mesh.loop_triangles):
        return None
    corners = field(mesh.loop_triangles, "loops", 3, np.int32)
    slots = field(mesh.loop_triangles, "material_index", 1, np.int32)
    vertices = field(mesh.loops, "vertex_index", 1, np.int32)
    totals = field(mesh.polygons, "loop_total", 1, np.int32)
    faces = np.repeat(np.arange(len(totals), dtype=np.int32), totals)

    normals = unit(field(mesh.corner_normals, "vector", 3))
    uvs = [(layer.name, uv_corners(layer)) for layer in mesh.uv_layers]
    extras = wanted(mesh, needs, groups, vertices, faces)
    columns = [vertices[:, None], normals, *(a for _, a in uvs), *(a for _, _, a in extras)]
    of_islands = islands.random(mesh) if needs.islands else None
    if of_islands is not None:
        columns.append(of_islands[:, None])
    keep, inverse = distinct(columns)

    positions = field(mesh.vertices, "co", 3)
    if not np.isfinite(positions).all():
        warn("some positions are not finite; they are put at the origin")
        positions = np.where(np.isfinite(positions), positions, 0.0).astype(np.float32)
    of_vertex = vertices[keep]
    return Geometry(
        positions=axes.points(positions[of_vertex]),
        normals=axes.points(normals[keep]),
        uvs=[(name, flipped(array[keep])) for name, array in uvs],
        extras=[(name, kind, array[keep]) for name, kind, array in extras],
        triangles=by_slot(inverse[corners], np.clip(slots, 0, max(slot_count - 1, 0))),
        generated=generated(mesh, positions, of_vertex) if needs.generated else None,
        islands=None if of_islands is None else of_islands[keep],
    )


def uv_corners(layer):
    """UV of each corner; numbers that are not finite become zero."""
    return np.nan_to_num(field(layer.uv, "vector", 2), posinf=0.0, neginf=0.0)


def flipped(uv):
    """glTF's v runs down."""
    return np.stack([uv[:, 0], 1.0 - uv[:, 1]], axis=1).astype(np.float32)


def unit(vectors):
    """Unit vectors; those without a direction point up."""
    length = np.linalg.norm(vectors, axis=1, keepdims=True)
    good = np.isfinite(length[:, 0]) & (length[:, 0] > 1e-20)
    out = np.zeros_like(vectors)
    out[:, 2] = 1.0
    out[good] = vectors[good] / length[good]
    return out


def wanted(mesh, needs, groups, vertices, faces):
    """The attributes, other than UV layers, that the mesh's materials read; vertex groups are some."""
    names = needs.attributes - {layer.name for layer in mesh.uv_layers}
    if needs.active_color and render_color(mesh):
        names = names | {render_color(mesh)}
    names = sorted(names - {""})
    # An attribute wins over a group of its name.
    of_groups = [groups.index(name) for name in names if name in groups and name not in mesh.attributes]
    weights = attributes.weights(mesh, of_groups)
    found = []
    for name in names:
        attribute = mesh.attributes.get(name)
        if attribute is not None:
            kind, array = attributes.meaning(attribute), attributes.on_corners(mesh, attribute, vertices, faces)
        elif name in groups:
            kind, array = "FLOAT", weights[groups.index(name)][vertices]
        else:
            continue
        if array is not None:
            found.append((name, kind, np.nan_to_num(array, posinf=0.0, neginf=0.0)))
    return found


def render_color(mesh):
    """Name of the colour attribute that nodes without a name mean; empty where there is none."""
    index = mesh.color_attributes.render_color_index
    return mesh.color_attributes[index].name if 0 <= index < len(mesh.color_attributes) else ""


def generated(mesh, positions, of_vertex):
    """Generated coordinates where modifiers moved the vertices; None where positions give them."""
    original = field(mesh.vertices, "undeformed_co", 3)
    origin, size = texture_space(mesh)
    if np.abs(original - positions).max() <= 1e-5 * max(size):
        return None
    return ((original - origin) / size)[of_vertex].astype(np.float32)


def texture_space(mesh):
    """Origin and size, such that (p - origin) / size runs from 0 to 1, as Cycles has it."""
    centre = np.array(mesh.texspace_location, dtype=np.float64)
    half = np.array(mesh.texspace_size, dtype=np.float64)
    half[half == 0.0] = 0.5
    return centre - half, 2.0 * half


def by_slot(triangles, slots):
    """Triangle indices of each slot in use."""
    order = np.argsort(slots, kind="stable")
    used, starts = np.unique(slots[order], return_index=True)
    parts = np.split(triangles[order], starts[1:])
    small = triangles.max() < 65535
    dtype = np.uint16 if small else np.uint32
    return [(int(slot), part.astype(dtype).ravel()) for slot, part in zip(used, parts)]


def distinct(columns):
    """Rows that differ: (positions of one row of each kind, each row's kind).

    Rows are compared by a 64-bit hash first; should two different rows share one, all rows
    are kept apart.
    """
    words = [
        (np.ascontiguousarray(c, dtype=c.dtype) + c.dtype.type(0)).view(np.uint32) for c in columns
    ]
    table = np.concatenate(words, axis=1)
    code = np.zeros(len(table), dtype=np.uint64)
    for column in table.T:
        # Steele, Lea and Flood's SplitMix64 finaliser mixes each column in.
        code = (code ^ column) + np.uint64(0x9E3779B97F4A7C15)
        code = (code ^ (code >> np.uint64(30))) * np.uint64(0xBF58476D1CE4E5B9)
        code = (code ^ (code >> np.uint64(27))) * np.uint64(0x94D049BB133111EB)
        code ^= code >> np.uint64(31)
    _, keep, inverse = np.unique(code, return_index=True, return_inverse=True)
    inverse = inverse.reshape(-1)
    if not np.array_equal(table[keep][inverse], table):
        return np.arange(len(table)), np.arange(len(table))
    # In order of appearance: vertices that are used together stay together.
    rank = np.empty(len(keep), dtype=np.int64)
    order = np.argsort(keep)
    rank[order] = np.arange(len(keep))
    return keep[order], rank[inverse]
