"""Arguments: scene samples WxH picture. Prints "CYCLES seconds": the time of the samples alone."""
import sys
import time

import bpy

scene_path, samples, size, picture = sys.argv[1:5]
bpy.ops.wm.open_mainfile(filepath=scene_path)
scene = bpy.context.scene
width, height = (int(side) for side in size.lower().split("x"))
scene.render.engine = "CYCLES"
scene.cycles.device = "CPU"
scene.cycles.use_adaptive_sampling = False
scene.cycles.use_denoising = False
scene.render.resolution_x, scene.render.resolution_y = width, height
scene.render.resolution_percentage = 100
scene.render.use_persistent_data = True
scene.render.use_compositing = False
scene.render.use_sequencer = False
scene.render.image_settings.file_format = "OPEN_EXR"


def seconds(count):
    scene.cycles.samples = count
    # Cycles' settings alone do not tell the kept scene that it has changed.
    scene.render.filepath = picture
    scene.update_tag()
    start = time.perf_counter()
    bpy.ops.render.render(write_still=True)
    return time.perf_counter() - start


# The first render builds everything and keeps it (persistent data); of the next two,
# the difference is what the samples cost.
seconds(1)
base = seconds(1)
print("CYCLES", (seconds(int(samples)) - base) * int(samples) / (int(samples) - 1), flush=True)
