"""Random Per Island, as Cycles numbers islands: vertices that edges join."""

import bpy
import numpy as np


def random(mesh):
    """A number from 0 to 1 for each corner: a hash of its island's root."""
    ends, vertices, count = connectivity(mesh)
    roots = np.array(join(ends, count), dtype=np.uint32)
    return hashed(roots[vertices])


def connectivity(mesh):
    """Edges' vertices, corners' vertices and the number of vertices.

    Cycles splits meshes whose corners at a vertex have different normals at their sharp edges first.
    """
    if mesh.normals_domain != "CORNER":
        return arrays(mesh)
    split = mesh.copy()
    try:
        split.split_faces()
        return arrays(split)
    finally:
        bpy.data.meshes.remove(split)


def arrays(mesh):
    ends = np.empty(2 * len(mesh.edges), dtype=np.int32)
    mesh.edges.foreach_get("vertices", ends)
    vertices = np.empty(len(mesh.loops), dtype=np.int32)
    mesh.loops.foreach_get("vertex_index", vertices)
    return ends.reshape(-1, 2), vertices, len(mesh.vertices)


def join(ends, count):
    """The root of each vertex in a forest that edges join in their order, the lower tree below the
    higher one (of two equal ones, the second below the first)."""
    parents, heights = list(range(count)), [0] * count

    def root(vertex):
        while parents[vertex] != vertex:
            parents[vertex] = vertex = parents[parents[vertex]]
        return vertex

    for a, b in ends.tolist():
        above, below = root(a), root(b)
        if above == below:
            continue
        if heights[above] < heights[below]:
            above, below = below, above
        parents[below] = above
        heights[above] += heights[above] == heights[below]
    return [root(vertex) for vertex in range(count)]


def hashed(keys):
    """Jenkins' lookup3 (2006, public domain) of one word each, as single-precision fractions."""
    a = keys.astype(np.uint32) + np.uint32(0xDEADBEEF + (1 << 2) + 13)
    b = np.full_like(a, 0xDEADBEEF + (1 << 2) + 13)
    c = b.copy()

    def turned(x, bits):
        return (x << np.uint32(bits)) | (x >> np.uint32(32 - bits))

    # The words take turns: each is mixed with the one before.
    words = [c, b, a]
    for step, bits in enumerate((14, 11, 25, 16, 4, 14, 24)):
        to, by = (0, 2, 1)[step % 3], (1, 0, 2)[step % 3]
        words[to] = (words[to] ^ words[by]) - turned(words[by], bits)
    return words[0].astype(np.float32) * (np.float32(1.0) / np.float32(0xFFFFFFFF))
