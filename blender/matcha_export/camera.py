"""The scene's camera, as Blender has it and as glTF can say it."""

import math

import mathutils
import numpy as np

from . import axes
from .numbers import number, numbers


def node(glb, scene, depsgraph):
    """Appends camera and node of the active camera; returns the node's index."""
    obj = scene.camera.evaluated_get(depsgraph)
    chain = axes.node_chain(axes.aim(unscaled(obj.matrix_world)))
    data = obj.data
    index = glb.append("cameras", standard(data, scene))
    entry = {"name": obj.name, **chain[-1], "camera": index}
    entry["extensions"] = {"MATCHA_cycles": {"camera": about(obj, data)}}
    return glb.append("nodes", entry)


def unscaled(matrix):
    """Cameras ignore scale and shear, but one that is negative turns the picture over, as in Cycles."""
    translation, rotation, scale = matrix.decompose()
    # Blender tells a mirrored matrix by the sign of all three.
    sign = math.copysign(1.0, scale.x)
    return np.array(mathutils.Matrix.LocRotScale(translation, rotation, (sign, sign, sign)), dtype=np.float64)


def about(obj, camera):
    """Lengths in millimetres are marked by Blender's names: lens and sensor; all else is metres."""
    return {
        "name": obj.name,
        "type": camera.type,
        "lens": number(camera.lens),
        "sensor_fit": camera.sensor_fit,
        "sensor_width": number(camera.sensor_width),
        "sensor_height": number(camera.sensor_height),
        "shift": numbers((camera.shift_x, camera.shift_y)),
        "clip": numbers((camera.clip_start, camera.clip_end)),
        "ortho_scale": number(camera.ortho_scale),
        "panorama": panorama(camera),
        "dof": depth_of_field(obj, camera.dof),
    }


def panorama(camera):
    """Blender 5 moved the type out of Cycles' settings."""
    owner = camera if hasattr(camera, "panorama_type") else camera.cycles
    return owner.panorama_type


def is_part_of_panorama(camera):
    """True for an equirectangular camera that sees less than all around."""
    if camera.type != "PANO" or panorama(camera) != "EQUIRECTANGULAR":
        return False
    owner = camera if hasattr(camera, "panorama_type") else camera.cycles
    tall = owner.latitude_max - owner.latitude_min
    wide = owner.longitude_max - owner.longitude_min
    return not math.isclose(tall, math.pi, rel_tol=1e-4) or not math.isclose(wide, math.tau, rel_tol=1e-4)


def depth_of_field(obj, dof):
    """The lens opening; the distance is along the view axis, as Cycles measures it."""
    distance = dof.focus_distance
    if dof.focus_object is not None:
        target = dof.focus_object.matrix_world
        bone = dof.focus_subtarget and dof.focus_object.pose and dof.focus_object.pose.bones.get(dof.focus_subtarget)
        point = (target @ bone.matrix).translation if bone else target.translation
        view = obj.matrix_world.to_quaternion() @ mathutils.Vector((0.0, 0.0, -1.0))
        distance = abs(view.dot(point - obj.matrix_world.translation))
    return {
        "enabled": bool(dof.use_dof),
        "fstop": number(dof.aperture_fstop),
        "focus_distance": number(distance),
        "blades": int(dof.aperture_blades),
        "rotation": number(dof.aperture_rotation),
        "ratio": number(dof.aperture_ratio),
    }


def standard(camera, scene):
    """A glTF camera; panoramas become wide perspectives."""
    render = scene.render
    width = render.resolution_x * render.pixel_aspect_x
    height = render.resolution_y * render.pixel_aspect_y
    near = max(camera.clip_start, 1e-4)
    far = max(camera.clip_end, near * 2.0)
    horizontal = camera.sensor_fit == "HORIZONTAL" or (camera.sensor_fit == "AUTO" and width >= height)
    if camera.type == "ORTHO":
        x = camera.ortho_scale / 2.0 * (1.0 if horizontal else width / height)
        box = {"xmag": number(x), "ymag": number(x * height / width), "znear": number(near), "zfar": number(far)}
        return {"name": camera.name, "type": "orthographic", "orthographic": box}
    sensor = camera.sensor_height if camera.sensor_fit == "VERTICAL" else camera.sensor_width
    tangent = sensor / (2.0 * max(camera.lens, 1e-3))
    fov = 2.0 * math.atan(tangent * (height / width if horizontal else 1.0))
    lens = {"aspectRatio": number(width / height), "yfov": number(fov), "znear": number(near), "zfar": number(far)}
    return {"name": camera.name, "type": "perspective", "perspective": lens}
