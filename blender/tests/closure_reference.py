"""Measures Cycles' closures on tilted squares: the references of the renderer's tests.

    python closure_reference.py reference OUT.json    values and albedos of many closures
    python closure_reference.py sheen OUT.bin         the sheen's coefficients

Every square is seen under one angle by a parallel camera that looks down, sees only light
(squares are invisible to all but camera rays), and is lit either by a sun without extent,
which gives f · cos without noise, or by a white world, which gives the albedo.
"""

import json
import math
import os
import struct
import sys
import tempfile

import bpy
from mathutils import Vector

CELL = 4  # pixels a square
WHITE = (1.0, 1.0, 1.0, 1.0)


def new_scene(columns, rows, samples):
    bpy.ops.wm.read_factory_settings(use_empty=True)
    scene = bpy.context.scene
    scene.render.engine = "CYCLES"
    scene.render.resolution_x = columns * CELL
    scene.render.resolution_y = rows * CELL
    scene.render.resolution_percentage = 100
    scene.render.image_settings.file_format = "OPEN_EXR"
    scene.render.image_settings.color_depth = "32"
    settings = scene.cycles
    settings.device = "CPU"
    settings.samples = samples
    settings.use_adaptive_sampling = False
    settings.use_denoising = False
    settings.sample_clamp_direct = 0.0
    settings.sample_clamp_indirect = 0.0
    settings.blur_glossy = 0.0
    settings.light_sampling_threshold = 0.0
    settings.pixel_filter_type = "BOX"
    camera = bpy.data.cameras.new("camera")
    camera.type = "ORTHO"
    camera.ortho_scale = max(columns, rows)
    camera.clip_end = 1e4
    eye = bpy.data.objects.new("camera", camera)
    eye.location = (columns / 2, -rows / 2, 500.0)
    scene.collection.objects.link(eye)
    scene.camera = eye
    world = bpy.data.worlds.new("world")
    world.use_nodes = True
    world.cycles.sampling_method = "NONE"
    scene.world = world
    return scene


def white_world(scene, strength):
    background = scene.world.node_tree.nodes["Background"]
    background.inputs["Color"].default_value = WHITE
    background.inputs["Strength"].default_value = strength


def only_camera_sees(thing):
    thing.visible_diffuse = False
    thing.visible_glossy = False
    thing.visible_transmission = False
    thing.visible_volume_scatter = False
    thing.visible_shadow = False


def square(column, row, cosine):
    """Corners of a square that fills its cell, its normal tilted towards +X."""
    rise = -math.sqrt(1.0 - cosine * cosine) / cosine
    x, y = column + 0.5, -row - 0.5
    corners = [(-0.5, -0.5), (0.5, -0.5), (0.5, 0.5), (-0.5, 0.5)]
    return [(x + u, y + v, u * rise) for u, v in corners]


def sun(scene):
    light = bpy.data.lights.new("sun", "SUN")
    light.energy = 1.0
    light.angle = 0.0
    lamp = bpy.data.objects.new("sun", light)
    scene.collection.objects.link(lamp)
    return lamp


def aim(lamp, direction):
    lamp.rotation_mode = "QUATERNION"
    lamp.rotation_quaternion = Vector(direction).to_track_quat("Z", "Y")


def picture(scene, columns, rows):
    """Mean colour of the middle of every cell, rows first."""
    path = os.path.join(tempfile.mkdtemp(), "picture.exr")
    scene.render.filepath = path
    bpy.ops.render.render(write_still=True)
    image = bpy.data.images.load(path)
    width = columns * CELL
    pixels = list(image.pixels)
    bpy.data.images.remove(image)
    os.remove(path)
    out = []
    for row in range(rows):
        line = []
        for column in range(columns):
            total = [0.0, 0.0, 0.0]
            for dy in range(CELL):
                for dx in range(CELL):
                    y = (rows - 1 - row) * CELL + dy
                    at = 4 * (y * width + column * CELL + dx)
                    for c in range(3):
                        total[c] += pixels[at + c]
            line.append([t / CELL**2 for t in total])
        out.append(line)
    return out


def bsdf_material(name, kind, values, properties, color_attribute=None):
    material = bpy.data.materials.new(name)
    material.use_nodes = True
    tree = material.node_tree
    tree.nodes.clear()
    output = tree.nodes.new("ShaderNodeOutputMaterial")
    node = tree.nodes.new(kind)
    for key, value in properties.items():
        setattr(node, key, value)
    for key, value in values.items():
        if key == "Normal":
            vector = tree.nodes.new("ShaderNodeCombineXYZ")
            for axis, component in enumerate(value):
                vector.inputs[axis].default_value = component
            tree.links.new(vector.outputs[0], node.inputs["Normal"])
        else:
            node.inputs[key].default_value = value
    if "Tangent" in node.inputs:
        # Along the square's own x axis, which is the tangent of its slope.
        axis = tree.nodes.new("ShaderNodeTangent")
        axis.direction_type = "RADIAL"
        axis.axis = "Y"
        tree.links.new(axis.outputs[0], node.inputs["Tangent"])
    tree.links.new(node.outputs[0], output.inputs["Surface"])
    return material, node


# ---------------------------------------------------------------- sheen

SHEEN = 32


def sheen_coordinates():
    """Cosines and roughnesses that are measured; the ends are extrapolated from them."""
    step = 1.0 / (SHEEN - 1)
    cosines = [0.5 * step] + [j * step for j in range(1, SHEEN)]
    roughnesses = [1e-3] + [i * step for i in range(1, SHEEN)]
    return cosines, roughnesses


def sheen_scene(samples):
    scene = new_scene(SHEEN, SHEEN, samples)
    cosines, roughnesses = sheen_coordinates()
    points, faces, rough = [], [], []
    for i, roughness in enumerate(roughnesses):
        for j, cosine in enumerate(cosines):
            faces.append(range(len(points), len(points) + 4))
            points.extend(square(j, i, cosine))
            rough.extend([roughness] * 4)
    mesh = bpy.data.meshes.new("squares")
    mesh.from_pydata(points, [], [list(f) for f in faces])
    mesh.attributes.new("rough", "FLOAT", "POINT").data.foreach_set("value", rough)
    thing = bpy.data.objects.new("squares", mesh)
    only_camera_sees(thing)
    scene.collection.objects.link(thing)
    material, node = bsdf_material(
        "sheen", "ShaderNodeBsdfSheen", {"Color": WHITE}, {"distribution": "MICROFIBER"}
    )
    attribute = material.node_tree.nodes.new("ShaderNodeAttribute")
    attribute.attribute_name = "rough"
    material.node_tree.links.new(attribute.outputs["Fac"], node.inputs["Roughness"])
    mesh.materials.append(material)
    return scene


def solve_lobe(albedo, readings):
    """a and b of a linearly transformed cosine from (x, y, z, value) readings.

    value = albedo / π · z · (a / L)², L = (a x + b z)² + (a y)² + z²: Levenberg–Marquardt on
    the logarithm, weighted by the value.
    """
    peak = max(r[3] for r in readings)
    used = [r for r in readings if r[3] > 1e-4 * peak and r[2] > 1e-3]

    def residuals(a, b):
        out = []
        for x, y, z, value in used:
            length = (a * x + b * z) ** 2 + (a * y) ** 2 + z * z
            model = albedo / math.pi * z * (a / length) ** 2
            out.append((math.log(max(model, 1e-30)) - math.log(value)) * (value / peak) ** 0.25)
        return out

    def cost(a, b):
        return sum(r * r for r in residuals(a, b))

    best = None
    for a0 in (0.03, 0.1, 0.3, 1.0):
        for b0 in (-2.0, -0.5, 0.0, 0.5, 2.0):
            a, b, damping = a0, b0, 1e-2
            current = cost(a, b)
            for _ in range(60):
                r = residuals(a, b)
                ra = [(p - q) / 1e-5 for p, q in zip(residuals(a + 1e-5, b), r)]
                rb = [(p - q) / 1e-5 for p, q in zip(residuals(a, b + 1e-5), r)]
                aa = sum(v * v for v in ra) * (1 + damping) + 1e-20
                bb = sum(v * v for v in rb) * (1 + damping) + 1e-20
                ab = sum(p * q for p, q in zip(ra, rb))
                ga = sum(p * q for p, q in zip(ra, r))
                gb = sum(p * q for p, q in zip(rb, r))
                det = aa * bb - ab * ab
                if det == 0.0:
                    break
                da, db = -(bb * ga - ab * gb) / det, -(aa * gb - ab * ga) / det
                trial = max(a + da, 1e-6), b + db
                new = cost(*trial)
                if new < current:
                    a, b, current, damping = *trial, new, damping * 0.3
                else:
                    damping *= 4.0
            if best is None or current < best[0]:
                best = (current, a, b)
    return best


def local_directions():
    for elevation in (4, 10, 20, 35, 50, 65, 80, 90):
        for azimuth in (0, 45, 90, 135, 180):
            e, p = math.radians(elevation), math.radians(azimuth)
            yield math.cos(e) * math.cos(p), math.cos(e) * math.sin(p), math.sin(e)
            if elevation == 90:
                break


def measure_sheen(path):
    scene = sheen_scene(1)
    white_world(scene, 1.0)
    albedo = picture(scene, SHEEN, SHEEN)
    white_world(scene, 0.0)
    cosines, _ = sheen_coordinates()
    lamp = sun(scene)
    readings = [[[] for _ in range(SHEEN)] for _ in range(SHEEN)]
    for direction in local_directions():
        aim(lamp, direction)
        values = picture(scene, SHEEN, SHEEN)
        for i in range(SHEEN):
            for j in range(SHEEN):
                c = cosines[j]
                s = math.sqrt(1.0 - c * c)
                # Frame of the square: z its normal, x the azimuth of the camera.
                x = -direction[0] * c + direction[2] * s
                z = direction[0] * s + direction[2] * c
                if z > 0.0:
                    readings[i][j].append((x, direction[1], z, values[i][j][0]))
    planes = [[[0.0] * SHEEN for _ in range(SHEEN)] for _ in range(3)]
    worst = (0.0, 0, 0)
    for i in range(SHEEN):
        for j in range(SHEEN):
            value = albedo[i][j][0]
            lit = [r for r in readings[i][j] if r[3] > 0.0]
            if value < 1e-5 or len(lit) < 3:
                continue
            error, a, b = solve_lobe(value, lit)
            worst = max(worst, (math.sqrt(error / len(lit)), i, j))
            planes[0][i][j], planes[1][i][j], planes[2][i][j] = a, b, value
    # Where nothing is reflected the shape is unknown; the next rougher one keeps
    # interpolation smooth.
    for i in reversed(range(SHEEN - 1)):
        for j in range(SHEEN):
            if planes[0][i][j] == 0.0:
                planes[0][i][j] = planes[0][i + 1][j]
                planes[1][i][j] = planes[1][i + 1][j]
    print("largest residual of the logarithm (weighted):", worst)
    for plane in planes:
        for row in plane:
            row[0] = 2.0 * row[0] - row[1]
        near = 1e-3 * (SHEEN - 1)
        plane[0] = [(p - near * q) / (1.0 - near) for p, q in zip(plane[0], plane[1])]
    flat = [v for plane in planes for row in plane for v in row]
    with open(path, "wb") as out:
        out.write(struct.pack(f"<{len(flat)}f", *flat))


# ------------------------------------------------------------ references

COSINES = (0.95, 0.6, 0.25)
SUNS = [(55, 180), (80, 90), (30, 150), (20, 60), (60, 0), (-70, 180), (-40, 150), (-30, 0)]
COLOR = (0.9, 0.5, 0.2, 1.0)


def glossy_cases():
    for name in ("GGX", "MULTI_GGX", "BECKMANN", "ASHIKHMIN_SHIRLEY"):
        for roughness in (0.3, 0.8):
            yield "Glossy", name, {"Color": COLOR, "Roughness": roughness}
        yield (
            "Glossy",
            name,
            {"Color": COLOR, "Roughness": 0.5, "Anisotropy": 0.6, "Rotation": 0.1},
        )
    yield "Glossy", "GGX", {"Color": COLOR, "Roughness": 0.5, "Anisotropy": -0.5}


def transmissive_cases():
    for name in ("GGX", "MULTI_GGX", "BECKMANN"):
        for roughness, ior in ((0.3, 1.45), (0.6, 1.8), (0.4, 0.7)):
            yield "Glass", name, {"Color": COLOR, "Roughness": roughness, "IOR": ior}
    for name in ("GGX", "BECKMANN"):
        yield "Refraction", name, {"Color": COLOR, "Roughness": 0.35, "IOR": 1.33}


def principled_cases():
    base = {"Base Color": COLOR}
    for more in (
        {},
        {"Roughness": 0.2, "Specular IOR Level": 1.0},
        {"Roughness": 0.7, "IOR": 1.2, "Specular Tint": (0.9, 0.3, 0.6, 1.0)},
        {"Diffuse Roughness": 0.9},
        {"Metallic": 1.0, "Roughness": 0.4, "Specular Tint": (0.8, 0.9, 1.0, 1.0)},
        {"Metallic": 0.6, "Roughness": 0.5, "Anisotropic": 0.8, "Anisotropic Rotation": 0.2},
        {"Coat Weight": 1.0, "Coat Roughness": 0.2},
        {
            "Coat Weight": 0.6,
            "Coat Roughness": 0.5,
            "Coat IOR": 1.8,
            "Coat Tint": (0.9, 0.6, 0.3, 1.0),
        },
        {"Sheen Weight": 0.5, "Sheen Roughness": 0.3},
        {"Sheen Weight": 1.0, "Sheen Roughness": 0.8, "Sheen Tint": (0.2, 0.9, 0.5, 1.0)},
        {"Transmission Weight": 1.0, "Roughness": 0.4},
        {"Transmission Weight": 0.5, "Roughness": 0.6, "Metallic": 0.2, "Coat Weight": 0.3},
        {"Alpha": 0.6},
        {"Sheen Weight": 0.4, "Coat Weight": 0.5, "Coat Roughness": 0.3, "Emission Strength": 0.5},
    ):
        yield "Principled", "MULTI_GGX", base | more
    yield "Principled", "GGX", base | {"Metallic": 0.5, "Roughness": 0.7}


def bent_cases():
    """Normals that lean towards one side; the second needs turning back on steep squares."""
    for normal in ((0.5, 0.4, 0.768), (-0.6, 0.2, 0.7746)):
        bent = {"Normal": normal}
        yield "Diffuse", None, bent | {"Color": COLOR, "Roughness": 0.0}
        yield "Glossy", "GGX", bent | {"Color": COLOR, "Roughness": 0.5}
        yield "Glossy", "ASHIKHMIN_SHIRLEY", bent | {"Color": COLOR, "Roughness": 0.4}
        yield "Glass", "BECKMANN", bent | {"Color": COLOR, "Roughness": 0.4, "IOR": 1.5}
        yield "Sheen", "MICROFIBER", bent | {"Color": COLOR, "Roughness": 0.5}
        yield "Principled", "MULTI_GGX", bent | {"Base Color": COLOR, "Coat Weight": 0.5}


def cases():
    for roughness in (0.0, 0.5, 1.0):
        yield "Diffuse", None, {"Color": COLOR, "Roughness": roughness}
    yield "Translucent", None, {"Color": COLOR}
    yield from glossy_cases()
    yield from transmissive_cases()
    for roughness in (0.1, 0.4, 1.0):
        yield "Sheen", "MICROFIBER", {"Color": COLOR, "Roughness": roughness}
        yield "Sheen", "ASHIKHMIN", {"Color": COLOR, "Roughness": roughness}
    yield from principled_cases()
    yield from bent_cases()


NODES = {
    "Diffuse": "ShaderNodeBsdfDiffuse",
    "Translucent": "ShaderNodeBsdfTranslucent",
    "Glossy": "ShaderNodeBsdfAnisotropic",
    "Glass": "ShaderNodeBsdfGlass",
    "Refraction": "ShaderNodeBsdfRefraction",
    "Sheen": "ShaderNodeBsdfSheen",
    "Principled": "ShaderNodeBsdfPrincipled",
}


def direction(elevation, azimuth):
    e, p = math.radians(elevation), math.radians(azimuth)
    return [math.cos(e) * math.cos(p), math.cos(e) * math.sin(p), math.sin(e)]


def reference_scene(every, samples):
    scene = new_scene(len(COSINES), len(every), samples)
    for row, (kind, distribution, values) in enumerate(every):
        properties = {"distribution": distribution} if distribution else {}
        material, _ = bsdf_material(f"{row}", NODES[kind], values, properties)
        for column, cosine in enumerate(COSINES):
            mesh = bpy.data.meshes.new("square")
            mesh.from_pydata(square(column, row, cosine), [], [(0, 1, 2, 3)])
            mesh.materials.append(material)
            thing = bpy.data.objects.new("square", mesh)
            only_camera_sees(thing)
            scene.collection.objects.link(thing)
    return scene


def rounded(color):
    return [float(f"{c:.6g}") for c in color]


def measure_references(path):
    every = list(cases())
    scene = reference_scene(every, 4096)
    white_world(scene, 1.0)
    albedo = picture(scene, len(COSINES), len(every))
    scene.cycles.samples = 1
    white_world(scene, 0.0)
    dark = picture(scene, len(COSINES), len(every))
    lamp = sun(scene)
    lit = []
    for angles in SUNS:
        aim(lamp, direction(*angles))
        lit.append(picture(scene, len(COSINES), len(every)))
    out = []
    for row, (kind, distribution, values) in enumerate(every):
        for column, cosine in enumerate(COSINES):
            out.append(
                {
                    "kind": kind,
                    "distribution": distribution,
                    "inputs": {k: list(v) if hasattr(v, "__len__") else v for k, v in values.items()},
                    "cosine": cosine,
                    "albedo": rounded(albedo[row][column]),
                    "emission": rounded(dark[row][column]),
                    "lit": [rounded(picture[row][column]) for picture in lit],
                }
            )
    head = {"blender": bpy.app.version_string, "suns": [rounded(direction(*s)) for s in SUNS]}
    with open(path, "w") as file:
        file.write(json.dumps(head)[:-1] + ', "squares": [\n')
        file.write(",\n".join(json.dumps(o) for o in out) + "\n]}\n")


if __name__ == "__main__":
    if sys.argv[1] == "sheen":
        measure_sheen(sys.argv[2])
    elif sys.argv[1] == "reference":
        measure_references(sys.argv[2])
    else:
        sys.exit(__doc__)
