"""Meshes with texture coordinates in metres: lathed, swept, boxed, padded and sheet forms."""

import math
import random

import bpy
import numpy as np


def make_object(name, vertices, faces, corner_uv, material, smooth=True):
    """An object of vertices, faces (lists of indices) and one (u, v) for each face corner."""
    mesh = bpy.data.meshes.new(name)
    mesh.from_pydata([tuple(map(float, v)) for v in vertices], [], faces)
    layer = mesh.uv_layers.new(name="UVMap")
    layer.data.foreach_set("uv", np.asarray(corner_uv, np.float32).ravel())
    mesh.polygons.foreach_set("use_smooth", [smooth] * len(mesh.polygons))
    mesh.materials.append(material)
    mesh.validate()
    made = bpy.data.objects.new(name, mesh)
    bpy.context.scene.collection.objects.link(made)
    return made


def put(made, location=(0, 0, 0), turn=0.0, tilt=(0, 0), scale=1.0):
    """Places an object; turn is about z, tilt about x and y, in degrees."""
    made.location = location
    made.rotation_euler = (*map(math.radians, tilt), math.radians(turn))
    made.scale = (scale,) * 3
    return made


def again(made, location, turn=0.0, tilt=(0, 0), scale=1.0):
    """Another instance of the same mesh."""
    copy = made.copy()
    bpy.context.scene.collection.objects.link(copy)
    return put(copy, location, turn, tilt, scale)


def smooth_path(points, steps):
    """Points on a Catmull-Rom spline through `points`, `steps` to each span."""
    p = np.asarray(points, float)
    p = np.vstack([2 * p[0] - p[1], p, 2 * p[-1] - p[-2]])
    t = np.linspace(0, 1, steps, endpoint=False)[:, None]
    spans = []
    for a, b, c, d in zip(p, p[1:], p[2:], p[3:]):
        spans.append(0.5 * (2 * b + (c - a) * t + (2 * a - 5 * b + 4 * c - d) * t**2 + (3 * b - a - 3 * c + d) * t**3))
    return np.vstack([*spans, p[-2][None]])


def grid_faces(columns, rows):
    """Quads of a grid of vertices, numbered row by row."""
    at = lambda i, j: j * columns + i
    return [(at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)) for j in range(rows - 1) for i in range(columns - 1)]


def sheet(name, points, uv, material, smooth=True):
    """A surface of arrays [rows, columns, 3] and [rows, columns, 2]."""
    rows, columns = points.shape[:2]
    faces = grid_faces(columns, rows)
    flat = uv.reshape(-1, 2)
    corners = [flat[v] for face in faces for v in face]
    return make_object(name, points.reshape(-1, 3), faces, corners, material, smooth)


def arc_lengths(points):
    return np.concatenate([[0], np.cumsum(np.linalg.norm(np.diff(points, axis=0), axis=1))])


def lathe(name, profile, material, segments=40, steps=4, flute=None, offset=(0, 0)):
    """A turned form; `profile` is (radius, height) from the bottom outside to the inside.

    A point given twice makes a sharper edge. `flute` (angle, height) -> factor of the radius.
    """
    outline = smooth_path(profile, steps)
    outline[:, 0] = np.maximum(outline[:, 0], 0.0)
    angle = np.linspace(0, 2 * np.pi, segments + 1)
    radius = np.repeat(outline[:, :1], segments + 1, axis=1)
    if flute:
        radius = radius * flute(angle[None, :], outline[:, 1:2])
    height = np.repeat(outline[:, 1:2], segments + 1, axis=1)
    points = np.stack([radius * np.cos(angle), radius * np.sin(angle), height], axis=2)
    girth = outline[:, 0].max() * 0.9
    u = np.broadcast_to(angle * girth, radius.shape) + offset[0]
    v = np.broadcast_to(arc_lengths(outline)[:, None], radius.shape) + offset[1]
    made = sheet(name, points, np.stack([u, v], axis=2), material)
    weld(made)
    return made


def weld(made, distance=1e-5):
    """Joins the seam's vertices, so that shading has no line there; texture seams stay."""
    import bmesh

    mesh = bmesh.new()
    mesh.from_mesh(made.data)
    bmesh.ops.remove_doubles(mesh, verts=mesh.verts, dist=distance)
    mesh.to_mesh(made.data)
    mesh.free()
    made.data.polygons.foreach_set("use_smooth", [True] * len(made.data.polygons))


def tube(name, path, radii, material, segments=14, steps=6, offset=(0, 0), flat=1.0):
    """A swept round form; `radii` for each point of the path, `flat` squeezes it sideways."""
    whole = smooth_path(np.hstack([np.asarray(path, float), np.asarray(radii, float)[:, None]]), steps)
    centre, radius = whole[:, :3], whole[:, 3]
    tangent = np.gradient(centre, axis=0)
    tangent /= np.linalg.norm(tangent, axis=1)[:, None]
    side = np.cross(tangent[0], (0, 0, 1) if abs(tangent[0][2]) < 0.9 else (0, 1, 0))
    rows = []
    angle = np.linspace(0, 2 * np.pi, segments + 1)
    for c, t, r in zip(centre, tangent, radius):
        side = side - t * np.dot(side, t)
        side /= np.linalg.norm(side)
        up = np.cross(t, side)
        rows.append(c + r * (flat * np.cos(angle)[:, None] * side - np.sin(angle)[:, None] * up))
    rows = np.array([np.broadcast_to(centre[0], rows[0].shape), *rows, np.broadcast_to(centre[-1], rows[0].shape)])
    along = arc_lengths(centre)
    along = np.concatenate([[-radius[0]], along, [along[-1] + radius[-1]]])
    u = np.broadcast_to(angle * radius.max(), rows.shape[:2]) + offset[0]
    v = np.broadcast_to(along[:, None], rows.shape[:2]) + offset[1]
    made = sheet(name, rows[:, ::-1], np.stack([v, u], axis=2)[:, ::-1], material)
    weld(made)
    return made


def box(name, size, material, bevel=0.004, seed=None):
    """A box with rounded edges; grain runs along its longest side, texture shifted by `seed`.

    Each side is a grid of 3 x 3 quads. A point of the sharp box is carried onto the round one along
    the line from the nearest point of the inner box, which is where the normals come from too.
    """
    half = np.asarray(size, float) / 2
    inner = half - bevel
    shift = random.Random(seed).uniform(0, 9) if seed is not None else 0.0
    order = sorted(range(3), key=lambda axis: -size[axis])
    vertices, faces, uv = [], [], []
    for number, (axis, sign) in enumerate(((2, -1), (2, 1), (1, -1), (0, 1), (1, 1), (0, -1))):
        first, second = (axis + 1) % 3, (axis + 2) % 3
        steps = [np.array([-half[a], -inner[a], inner[a], half[a]] if bevel else [-half[a], half[a]]) for a in (first, second)]
        p = np.empty((len(steps[1]), len(steps[0]), 3))
        p[..., axis] = sign * half[axis]
        p[..., first], p[..., second] = np.meshgrid(steps[0] * sign, steps[1])
        along, across = [a for a in order if a != axis]
        sharp = p.reshape(-1, 3)
        start = len(vertices)
        new = [tuple(v + start for v in f) for f in grid_faces(len(steps[0]), len(steps[1]))]
        uv += [(sharp[v - start][along] + shift, sharp[v - start][across] + shift * 0.37 + number * 0.61) for f in new for v in f]
        vertices += rounded(sharp, inner, bevel).tolist()
        faces += new
    made = make_object(name, vertices, faces, uv, material, bool(bevel))
    if bevel:
        weld(made)
        found = np.array([v.co for v in made.data.vertices])
        away = found - np.clip(found, -inner, inner)
        made.data.normals_split_custom_set_from_vertices(away / np.linalg.norm(away, axis=1)[:, None])
    return made


def rounded(points, inner, radius):
    """Points of a sharp box on the box of the same size with rounded edges."""
    if not radius:
        return points
    nearest = np.clip(points, -inner, inner)
    away = points - nearest
    return nearest + away / np.linalg.norm(away, axis=1)[:, None] * radius


def cushion(name, size, material, power=5.0, cells=14, dimples=None, depth=0.0):
    """A padded box: a superellipsoid on a cube's grid, with buttons drawn in on its front (−y)."""
    half = np.asarray(size, float) / 2
    a, b = np.meshgrid(np.linspace(-1, 1, cells + 1), np.linspace(-1, 1, cells + 1))
    vertices, faces, uv = [], [], []
    for axis in range(3):
        for sign in (-1.0, 1.0):
            p = np.zeros((*a.shape, 3))
            p[..., axis], p[..., (axis + 1) % 3], p[..., (axis + 2) % 3] = sign, a * sign, b
            p = p / (np.sum(np.abs(p) ** power, axis=2) ** (1 / power))[..., None] * half
            if dimples and axis == 1 and sign < 0:
                for x, z, r in dimples:
                    distance = np.hypot(p[..., 0] - x, p[..., 2] - z)
                    p[..., 1] += depth * np.exp(-((distance / r) ** 1.2))
            start = len(vertices)
            vertices += p.reshape(-1, 3).tolist()
            new = [tuple(v + start for v in f) for f in grid_faces(cells + 1, cells + 1)]
            faces += new
            s, t = [x for x in range(3) if x != axis]
            uv += [(vertices[v][s] + axis * 0.7, vertices[v][t] + sign * 0.9) for f in new for v in f]
    made = make_object(name, vertices, faces, uv, material)
    weld(made, 1e-4)
    return made


def panel(name, width, height, material, origin=(0.0, 0.0)):
    """A flat rectangle in xz, facing −y, its lower left corner at the origin."""
    points = np.array([[(0, 0, 0), (width, 0, 0)], [(0, 0, height), (width, 0, height)]], float)
    return sheet(name, points, points[..., [0, 2]] + np.asarray(origin), material, False)
