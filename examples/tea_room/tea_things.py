"""The table and what stands on it."""

import math

import numpy as np

from . import ceramics_and_metal as hard
from . import cloth_and_paper as soft
from . import wood_and_walls as wood
from .shapes import again, box, cushion, lathe, put, sheet, tube

TOP = 0.74  # height of the table's surface
CENTRE = (-0.08, 0.05)
SIZE = (1.62, 0.90)


def build():
    table()
    runner()
    tray_and_pot()
    bowl_and_whisk()
    kettle()
    books()
    sweets()
    caddy()
    napkin()
    place_mat()


def on(x, y, z=0.0):
    return (x, y, TOP + z)


def table():
    width, depth = SIZE
    boards = 6
    each = depth / boards
    for n in range(boards):
        y = CENTRE[1] - depth / 2 + each * (n + 0.5)
        put(box("Board", (width, each - 0.0015, 0.036), wood.oak(), 0.0022, 40 + n), (CENTRE[0], y, TOP - 0.018))
    apron = put(box("Apron", (width - 0.16, 0.024, 0.085), wood.oak(), 0.004, 50), (CENTRE[0], CENTRE[1] - depth / 2 + 0.075, TOP - 0.079))
    again(apron, (CENTRE[0], CENTRE[1] + depth / 2 - 0.075, TOP - 0.079))
    leg = None
    for sx in (-1, 1):
        for sy in (-1, 1):
            at = (CENTRE[0] + sx * (width / 2 - 0.085), CENTRE[1] + sy * (depth / 2 - 0.085), (TOP - 0.036) / 2)
            leg = again(leg, at) if leg else put(box("Table leg", (0.075, 0.075, TOP - 0.036), wood.oak(), 0.008, 51), at)


def runner():
    """A cloth over the table's depth that hangs down in front, with soft folds."""
    width, front, back = 0.40, CENTRE[1] - SIZE[1] / 2, CENTRE[1] + SIZE[1] / 2
    hang, radius = 0.26, 0.010
    length = hang + (back - front) + 0.08
    v, u = np.meshgrid(np.linspace(0, 1, 90), np.linspace(0, 1, 30), indexing="ij")
    s = v * length
    bend = radius * math.pi / 2
    y, z = np.empty_like(s), np.empty_like(s)
    falling, turning = s < hang, (s >= hang) & (s < hang + bend)
    angle = (s - hang) / radius
    y[falling], z[falling] = front - radius, (s - hang - radius)[falling]
    y[turning], z[turning] = (front - radius * np.cos(angle))[turning], (radius * (np.sin(angle) - 1))[turning]
    flat = ~(falling | turning)
    y[flat], z[flat] = (front + s - hang - bend)[flat], 0.0
    drop = np.clip((hang - s) / hang, 0, 1)
    y = y - drop * (0.012 + 0.014 * np.sin(u * 11.0 + 0.6) + 0.006 * np.sin(u * 23.0))
    z = z + 0.0016 + flat * 0.0018 * np.maximum(0, np.sin(s * 17.0 + u * 3.0)) * np.sin(u * math.pi)
    x = (u - 0.5) * width * (1 - 0.03 * drop) - 0.12 + 0.004 * np.sin(s * 7.0)
    points = np.stack([x, y, z + TOP], axis=2)
    sheet("Runner", points, np.stack([u * width, s], axis=2), soft.runner())


def tray_and_pot():
    tray = lathe("Tray", [(0, 0.004), (0.15, 0.003), (0.19, 0.0), (0.205, 0.008), (0.214, 0.026), (0.211, 0.029), (0.206, 0.026),
                          (0.196, 0.013), (0.18, 0.0105), (0.10, 0.010), (0, 0.010)], wood.lacquer(), 64, 4)
    put(tray, on(-0.12, 0.0, 0.004), 15)
    teapot((-0.17, 0.055, TOP + 0.0145), 28)
    cup = lathe("Cup", [(0, 0.006), (0.021, 0.005), (0.0225, 0.0), (0.026, 0.001), (0.028, 0.008), (0.038, 0.028), (0.042, 0.055),
                        (0.0415, 0.066), (0.0395, 0.0675), (0.0385, 0.064), (0.038, 0.052), (0.034, 0.028), (0.02, 0.012), (0, 0.010)],
                hard.celadon(), 40, 4)
    put(cup, on(-0.055, -0.105, 0.0145), 30)
    again(cup, on(0.015, -0.015, 0.0145), 160)
    again(cup, on(0.215, 0.10, 0.0), 250)
    drink = lathe("Tea", [(0.0385, 0.0), (0.02, 0.0), (0.0, 0.0)][::1], soft.tea(), 32, 2)
    put(drink, on(-0.055, -0.105, 0.0145 + 0.05))
    again(drink, on(0.015, -0.015, 0.0145 + 0.048))


def teapot(at, turn):
    """Body, lid, spout and side handle of a small pot in Tenmoku glaze."""
    glaze = hard.tenmoku()
    body = lathe("Teapot", [(0, 0.004), (0.046, 0.003), (0.050, 0.0), (0.054, 0.004), (0.078, 0.025), (0.090, 0.058), (0.084, 0.090),
                            (0.060, 0.112), (0.044, 0.117), (0.041, 0.121), (0.037, 0.119), (0.036, 0.110)], glaze, 56, 5)
    put(body, at, turn)
    lid = lathe("Lid", [(0.034, 0.117), (0.042, 0.119), (0.043, 0.123), (0.036, 0.130), (0.018, 0.136), (0.009, 0.139), (0.008, 0.144),
                        (0.014, 0.152), (0.013, 0.160), (0.006, 0.164), (0, 0.1645)], glaze, 40, 4, offset=(0.0, 0.07))
    put(lid, at, turn)
    spout = tube("Spout", [(0.070, 0, 0.045), (0.098, 0, 0.058), (0.118, 0, 0.085), (0.133, 0, 0.112), (0.139, 0, 0.117)],
                 [0.026, 0.021, 0.014, 0.0105, 0.009], glaze, 22, 7, (0.0, 0.09))
    put(spout, at, turn)
    handle = tube("Handle", [(-0.066, 0, 0.102), (-0.098, 0, 0.118), (-0.128, 0, 0.100), (-0.130, 0, 0.062), (-0.105, 0, 0.036), (-0.080, 0, 0.034)],
                  [0.008, 0.0085, 0.0085, 0.008, 0.0075, 0.007], glaze, 18, 7, (0.0, 0.09), 1.35)
    put(handle, at, turn)


def bowl_and_whisk():
    wobble = lambda angle, z: 1.0 + 0.012 * np.sin(angle * 3 + 1.0) + 0.006 * np.sin(angle * 5 + z * 60)
    bowl = lathe("Tea bowl", [(0, 0.006), (0.030, 0.005), (0.032, 0), (0.036, 0.001), (0.038, 0.010), (0.058, 0.020), (0.066, 0.045),
                              (0.068, 0.075), (0.067, 0.083), (0.063, 0.085), (0.061, 0.078), (0.060, 0.05), (0.050, 0.026), (0, 0.016)],
                 hard.raku(), 56, 4, wobble)
    put(bowl, on(0.44, -0.14, 0.003), 200)
    put(lathe("Matcha", [(0.0605, 0.0), (0.03, 0.0), (0, 0.0)], soft.tea(), 40, 3), on(0.44, -0.14, 0.059))
    whisk(on(0.585, -0.06, 0.003))
    scoop = [(0, 0, 0.004), (0.06, 0, 0.005), (0.12, 0, 0.004), (0.155, 0, 0.005), (0.172, 0, 0.014)]
    put(tube("Scoop", scoop, [0.004, 0.0035, 0.004, 0.006, 0.004], wood.bamboo(), 10, 5, flat=0.9), on(0.43, -0.275, 0.003), 12)


def whisk(at):
    """A handle of bamboo that splits into a crown of tines."""
    handle = lathe("Whisk handle", [(0, 0.098), (0.011, 0.098), (0.0125, 0.096), (0.0125, 0.08), (0.012, 0.06), (0.0125, 0.052)][::-1], wood.bamboo(), 20, 3)
    put(handle, at)
    tine = tube("Tine", [(0.0115, 0, 0.056), (0.021, 0, 0.040), (0.0255, 0, 0.020), (0.022, 0, 0.002)], [0.0009, 0.0009, 0.0008, 0.0005],
                wood.bamboo(), 5, 3)
    for n in range(44):
        (put if n == 0 else again)(tine, at, n * 360 / 44)
    for n in range(22):
        again(tine, at, n * 360 / 22 + 4, scale=1.0).scale = (0.55, 0.55, 1.0)


def kettle():
    """A copper kettle on a trivet of rusted iron."""
    metal, at = hard.copper(), np.array(on(-0.60, 0.24, 0.028))
    trivet()
    body = lathe("Kettle", [(0, 0), (0.085, 0), (0.092, 0.004), (0.104, 0.03), (0.110, 0.07), (0.100, 0.115), (0.070, 0.142), (0.052, 0.147),
                            (0.050, 0.153), (0.046, 0.153)], metal, 60, 5)
    put(body, at, 100)
    lid = lathe("Kettle lid", [(0.046, 0.151), (0.050, 0.153), (0.050, 0.156), (0.040, 0.164), (0.014, 0.172), (0.007, 0.174), (0.006, 0.180)], metal, 44, 4)
    put(lid, at, 0)
    put(lathe("Kettle knob", [(0.006, 0.178), (0.013, 0.186), (0.014, 0.194), (0.009, 0.201), (0, 0.203)], wood.beam(), 24, 4), at)
    spout = tube("Kettle spout", [(0.09, 0, 0.055), (0.122, 0, 0.070), (0.142, 0, 0.105), (0.160, 0, 0.138), (0.176, 0, 0.146)],
                 [0.027, 0.022, 0.015, 0.011, 0.0095], metal, 24, 7)
    put(spout, at, -28)
    bow = [(0.088, 0, 0.128), (0.098, 0, 0.165), (0.088, 0, 0.225), (0.05, 0, 0.262), (0, 0, 0.272), (-0.05, 0, 0.262), (-0.088, 0, 0.225), (-0.098, 0, 0.165), (-0.088, 0, 0.128)]
    put(tube("Bail", bow, [0.0045] * 9, metal, 12, 6), at, -28)
    put(tube("Grip", bow[3:6], [0.0105, 0.012, 0.0105], wood.bamboo(), 16, 8), at, -28)


def trivet():
    metal = hard.iron()
    at = on(-0.60, 0.24, 0.0)
    ring = lathe("Trivet", [(0.098, 0.014), (0.112, 0.014), (0.114, 0.016), (0.114, 0.026), (0.112, 0.028), (0.098, 0.028), (0.096, 0.026), (0.096, 0.016), (0.098, 0.014)],
                 metal, 48, 2)
    put(ring, at)
    bar = put(box("Trivet bar", (0.20, 0.012, 0.010), metal, 0.002, 61), (at[0], at[1], at[2] + 0.022))
    for n in (1, 2):
        again(bar, (at[0], at[1], at[2] + 0.022), n * 60)
    foot = lathe("Trivet foot", [(0, 0), (0.011, 0), (0.013, 0.003), (0.009, 0.012), (0.012, 0.018)], metal, 16, 3)
    for n in range(3):
        a = math.radians(n * 120 - 80)
        (put if n == 0 else again)(foot, (at[0] + 0.104 * math.cos(a), at[1] + 0.104 * math.sin(a), at[2]))


def books():
    lying_book((-0.62, -0.12), 0.0, 12, (0.17, 0.24), 0.032, soft.book_red)
    lying_book((-0.612, -0.115), 0.032, 24, (0.15, 0.21), 0.026, soft.book_green)
    cup = lathe("Small cup", [(0, 0.004), (0.02, 0.003), (0.022, 0), (0.025, 0.002), (0.033, 0.025), (0.036, 0.045), (0.034, 0.047), (0.031, 0.026), (0.018, 0.009), (0, 0.008)],
                hard.raku(), 36, 4)
    put(cup, on(-0.655, -0.07, 0.058), 80)


def lying_book(at, height, turn, size, thick, cloth):
    x, y = at
    width, length = size
    cover = lambda z: put(box("Cover", (width, length, 0.003), cloth(), 0.0012), on(x, y, height + z), turn)
    cover(0.0015)
    cover(thick - 0.0015)
    side = (-(width / 2 - 0.0015) * math.cos(math.radians(turn)), -(width / 2 - 0.0015) * math.sin(math.radians(turn)))
    put(box("Spine", (0.003, length, thick), cloth(), 0.0012, 71), on(x + side[0], y + side[1], height + thick / 2), turn)
    put(box("Leaves", (width - 0.009, length - 0.008, thick - 0.006), soft.pages(), 0, 72), on(x, y, height + thick / 2), turn)


def sweets():
    plate = lathe("Plate", [(0, 0.005), (0.05, 0.004), (0.052, 0), (0.056, 0.002), (0.085, 0.012), (0.105, 0.021), (0.106, 0.0235), (0.10, 0.0225), (0.08, 0.0145), (0, 0.0105)],
                  hard.celadon(), 56, 4)
    put(plate, on(0.40, 0.22), 30)
    ball = [(0, 0.0), (0.014, 0.0005), (0.023, 0.008), (0.0255, 0.019), (0.020, 0.031), (0.009, 0.037), (0, 0.0378)]
    rose = lathe("Rose sweet", ball, soft.mochi_rose(), 32, 4)
    green = lathe("Green sweet", ball, soft.mochi_green(), 32, 4)
    put(rose, on(0.375, 0.205, 0.012))
    again(rose, on(0.43, 0.245, 0.0125), 70)
    put(green, on(0.428, 0.19, 0.0125), 20)
    again(green, on(0.378, 0.26, 0.0125), 100)


def caddy():
    """A lacquered tea caddy."""
    form = [(0, 0), (0.030, 0), (0.034, 0.003), (0.0375, 0.02), (0.0385, 0.042), (0.0385, 0.0435), (0.0378, 0.044), (0.0385, 0.0445), (0.0385, 0.06), (0.034, 0.071), (0.02, 0.076), (0, 0.077)]
    put(lathe("Caddy", form, wood.lacquer(), 48, 4, offset=(0.3, 0.065)), on(0.13, 0.285))


def napkin():
    """A folded cloth beside the bowl, with a wave in it."""
    v, u = np.meshgrid(np.linspace(0, 1, 22), np.linspace(0, 1, 22), indexing="ij")
    for layer in range(3):
        size = 0.15 - 0.003 * layer
        z = 0.002 + 0.0035 * layer + 0.0025 * np.sin(u * 7 + layer) * np.sin(v * 5) * (layer + 1) * 0.4
        points = np.stack([(u - 0.5) * size, (v - 0.5) * size, z], axis=2)
        put(sheet("Napkin", points, np.stack([u, v], axis=2) * size + layer * 0.2, soft.linen()), on(0.22, -0.28), -18 + layer * 2)


def place_mat():
    """A rush mat under the bowl, its edges a little raised."""
    v, u = np.meshgrid(np.linspace(-0.5, 0.5, 14), np.linspace(-0.5, 0.5, 18), indexing="ij")
    z = 0.003 + 0.004 * np.abs(u * 2) ** 6 + 0.002 * np.abs(v * 2) ** 8
    points = np.stack([u * 0.36, v * 0.27, z], axis=2)
    put(sheet("Place mat", points, np.stack([u * 0.36, v * 0.27], axis=2), soft.rush()), on(0.485, -0.15), -4)
