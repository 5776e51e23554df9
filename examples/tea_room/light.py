"""Sun, sky, camera, and the settings of the picture."""

import math

import bpy
from mathutils import Vector

from . import room

SUN_DIRECTION = Vector((0.68, 0.58, -0.33))
EYE = Vector((0.72, -1.80, 1.27))
TARGET = Vector((-0.14, 0.30, 0.92))
FOCUS = Vector((-0.12, -0.05, 0.80))


def build():
    sun()
    sky()
    camera()
    settings()


def light(name, kind, energy, color):
    data = bpy.data.lights.new(name, kind)
    data.energy, data.color = energy, color
    made = bpy.data.objects.new(name, data)
    bpy.context.scene.collection.objects.link(made)
    return made, data


def sun():
    made, data = light("Sun", "SUN", 14.0, (1.0, 0.66, 0.36))
    data.angle = math.radians(1.4)
    made.rotation_euler = SUN_DIRECTION.to_track_quat("-Z", "Y").to_euler()


def sky():
    """A soft area outside of the window, and a world that fills in from the room's open side.

    Only the sun and this area are sampled as lights. World, lantern and garden are wide and dim:
    scattered rays find them with little noise, and more samples are left for the sun.
    """
    near, far, low, high = room.WINDOW
    made, data = light("Sky", "AREA", 52.0, (0.72, 0.85, 1.0))
    data.shape, data.size, data.size_y = "RECTANGLE", far - near, high - low
    made.location = (room.LEFT - 0.35, (near + far) / 2, (low + high) / 2 + 0.15)
    made.rotation_euler = Vector((1, 0.0, -0.25)).to_track_quat("-Z", "Y").to_euler()
    made.visible_camera = False
    world = bpy.data.worlds.new("Evening")
    world.use_nodes = True
    ground = world.node_tree.nodes["Background"]
    ground.inputs[0].default_value = (1.0, 0.93, 0.86, 1.0)
    ground.inputs[1].default_value = 0.60
    world.cycles.sampling_method = "NONE"
    for name in ("Lantern Paper", "Garden View"):
        bpy.data.materials[name].cycles.emission_sampling = "NONE"
    bpy.context.scene.world = world


def camera():
    data = bpy.data.cameras.new("Camera")
    made = bpy.data.objects.new("Camera", data)
    bpy.context.scene.collection.objects.link(made)
    bpy.context.scene.camera = made
    aim = TARGET - EYE
    made.location, made.rotation_euler = EYE, aim.to_track_quat("-Z", "Y").to_euler()
    data.lens, data.sensor_width = 33.5, 36.0
    data.dof.use_dof = True
    data.dof.focus_distance = (FOCUS - EYE).dot(aim.normalized())
    data.dof.aperture_fstop = 4.0


def settings():
    scene = bpy.context.scene
    scene.render.engine = "CYCLES"
    scene.render.resolution_x, scene.render.resolution_y = 640, 360
    scene.render.resolution_percentage = 100
    scene.render.filter_size = 1.5
    scene.view_settings.view_transform = "AgX"
    scene.view_settings.look = "None"
    scene.view_settings.exposure = 0.3
    cycles = scene.cycles
    cycles.samples, cycles.use_adaptive_sampling, cycles.use_denoising = 64, False, False
    cycles.max_bounces, cycles.diffuse_bounces, cycles.glossy_bounces = 6, 4, 4
    cycles.transmission_bounces, cycles.transparent_max_bounces = 4, 8
    cycles.sample_clamp_indirect, cycles.sample_clamp_direct = 5.0, 0.0
    cycles.caustics_reflective = cycles.caustics_refractive = False
    cycles.pixel_filter_type, cycles.filter_width = "BLACKMAN_HARRIS", 1.5
    cycles.light_sampling_threshold = 0.0
