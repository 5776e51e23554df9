"""The room: floor, walls, beams, window, shelf, scroll, lantern, chair, plant."""

import math
import random

import numpy as np

from . import ceramics_and_metal as hard
from . import cloth_and_paper as soft
from . import wood_and_walls as wood
from .shapes import again, box, cushion, lathe, panel, put, sheet, tube

LEFT, RIGHT, BACK, FRONT, TOP = -1.4, 2.1, 1.75, -2.6, 2.5
WINDOW = (-2.2, 1.2, 0.86, 2.12)  # on the left wall: y from, y to, z from, z to


def build():
    shell()
    timbers()
    window()
    shelf()
    hanging_scroll()
    lantern()
    chair()
    plant()


def wall_piece(name, corner, width, height, turn, material):
    """A wall rectangle; texture coordinates follow the place on the wall, so that pieces join."""
    origin = (corner[0] if turn == 0 else corner[1], corner[2])
    return put(panel(name, width, height, material, origin), corner, turn)


def shell():
    plaster, tiles = wood.plaster(), wood.wall_tiles()
    depth = BACK - FRONT
    put(panel("Floor", RIGHT - LEFT, depth, wood.floor_tiles()), (LEFT, FRONT, 0), tilt=(-90, 0))
    put(panel("Ceiling", RIGHT - LEFT, depth, plaster), (LEFT, BACK, TOP), tilt=(90, 0))
    wall_piece("Back wall", (LEFT, BACK, 1.0), RIGHT - LEFT, TOP - 1.0, 0, plaster)
    wall_piece("Back tiles", (LEFT, BACK - 0.015, 0.0), RIGHT - LEFT, 1.0, 0, tiles)
    wall_piece("Right wall", (RIGHT, BACK, 0.0), depth, TOP, -90, plaster)
    near, far, low, high = WINDOW
    pieces = [(FRONT, near, 0, TOP), (far, BACK, 0, TOP), (near, far, 0, low), (near, far, high, TOP)]
    for a, b, z0, z1 in pieces:
        wall_piece("Left wall", (LEFT, a, z0), b - a, z1 - z0, 90, plaster)
    thick = 0.16
    reveal = [((LEFT - thick, near, low), thick, 0, 180), ((LEFT - thick, far, low), thick, 0, 0)]
    for (x, y, z), width, _, turn in reveal:
        x = x + width if turn == 180 else x
        put(panel("Reveal", width, high - low, plaster), (x, y, z), turn)
    put(panel("Reveal top", thick, far - near, plaster), (LEFT - thick, far, high), tilt=(90, 0))
    # Outside: closes the wall against light, and is what the window looks at.
    garden = put(panel("Garden", 8.0, 3.3, soft.garden()), (-6.0, -1.5, -0.6), 90)
    garden.visible_diffuse = False  # the sky's area light stands for it


def timbers():
    material = wood.beam()
    beam = lambda name, size, at, seed: put(box(name, size, material, 0.008, seed), at)
    beam("Corner post", (0.13, 0.13, TOP), (LEFT + 0.065, BACK - 0.065, TOP / 2), 1)
    beam("Right post", (0.14, 0.10, TOP), (1.08, BACK - 0.05, TOP / 2), 2)
    beam("Dado rail", (RIGHT - LEFT, 0.05, 0.07), ((LEFT + RIGHT) / 2, BACK - 0.025, 1.03), 3)
    beam("Upper rail", (RIGHT - LEFT, 0.07, 0.11), ((LEFT + RIGHT) / 2, BACK - 0.035, 2.02), 4)
    joist = beam("Joist", (RIGHT - LEFT, 0.12, 0.16), ((LEFT + RIGHT) / 2, -1.9, TOP - 0.08), 5)
    for n in range(1, 5):
        again(joist, ((LEFT + RIGHT) / 2, -1.9 + 0.8 * n, TOP - 0.08))


def window():
    frame, paper = wood.beam(), soft.shoji()
    near, far, low, high = WINDOW
    x = LEFT - 0.07
    middle_y, middle_z = (near + far) / 2, (low + high) / 2
    put(box("Sill", (0.30, far - near + 0.12, 0.04), wood.oak(), 0.006, 11), (LEFT - 0.03, middle_y, low))
    put(box("Lintel", (0.12, far - near, 0.07), frame, 0.005, 12), (x, middle_y, high - 0.035))
    upright = put(box("Jamb", (0.12, 0.06, high - low), frame, 0.005, 13), (x, near + 0.03, middle_z))
    again(upright, (x, far - 0.03, middle_z))
    again(upright, (x, 0.78, middle_z))
    # Open lattice in front, papered lattice behind.
    bar_height = high - low - 0.1
    bar = put(box("Bar", (0.026, 0.024, bar_height), frame, 0.003, 14), (x, 0.92, middle_z))
    open_bars = 7
    for y in (1.04, *(near + (0.78 - near) * n / (open_bars + 1) for n in range(1, open_bars + 1))):
        again(bar, (x, y, middle_z))
    rung = put(box("Rung", (0.024, 0.78 - near, 0.022), frame, 0.003, 15), (x, (0.78 + near) / 2, low + 0.42))
    again(rung, (x, (0.78 + near) / 2, low + 0.84))
    short = put(box("Short rung", (0.024, 0.40, 0.02), frame, 0.003, 16), (x, 0.98, low + 0.25))
    for n in range(2, 5):
        again(short, (x, 0.98, low + 0.25 * n))
    put(panel("Shoji", 0.38, high - low - 0.06, paper), (x - 0.02, 0.79, low + 0.02), 90)


def shelf():
    put(box("Shelf", (1.10, 0.20, 0.032), wood.oak(), 0.005, 21), (0.02, BACK - 0.10, 1.40))
    bracket = put(box("Bracket", (0.035, 0.16, 0.05), wood.beam(), 0.006, 22), (-0.40, BACK - 0.08, 1.36))
    again(bracket, (0.44, BACK - 0.08, 1.36))
    top = 1.416
    x = -0.46
    for width, height, depth, turn, which in ((0.034, 0.215, 0.15, 0, 0), (0.028, 0.235, 0.16, 0, 1), (0.042, 0.20, 0.14, 0, 0),
                                              (0.026, 0.225, 0.15, 0, 1), (0.036, 0.21, 0.15, -9, 0)):
        standing_book((x + width / 2, BACK - 0.11, top), width, height, depth, turn, which)
        x += width + (0.003 if turn == 0 else 0.0)
    jar = lathe("Jar", [(0, 0), (0.045, 0), (0.05, 0.004), (0.075, 0.06), (0.082, 0.12), (0.06, 0.17), (0.042, 0.185),
                        (0.046, 0.20), (0.040, 0.203), (0.036, 0.19), (0.03, 0.16)], hard.tenmoku(), 36, 4)
    put(jar, (-0.08, BACK - 0.105, top), 20)
    stack = lathe("Bowl", [(0, 0.006), (0.028, 0.004), (0.03, 0), (0.034, 0.006), (0.055, 0.02), (0.073, 0.05), (0.078, 0.07),
                           (0.075, 0.072), (0.068, 0.05), (0.05, 0.025), (0, 0.015)], hard.celadon(), 36, 3)
    put(stack, (0.13, BACK - 0.105, top))
    again(stack, (0.13, BACK - 0.105, top + 0.024), 50)
    again(stack, (0.13, BACK - 0.105, top + 0.048), 110)
    bottle = lathe("Bottle", [(0, 0), (0.045, 0), (0.052, 0.006), (0.058, 0.05), (0.05, 0.10), (0.02, 0.14), (0.014, 0.19),
                              (0.022, 0.225), (0.017, 0.226), (0.010, 0.19)], hard.raku(), 32, 4)
    put(bottle, (0.33, BACK - 0.11, top), 70)
    put(lathe("Weight", [(0, 0), (0.03, 0), (0.034, 0.004), (0.034, 0.03), (0.03, 0.036), (0.012, 0.04), (0.014, 0.055), (0, 0.062)],
              hard.iron(), 28, 4), (0.47, BACK - 0.12, top))


def standing_book(at, thick, height, depth, turn, which):
    """Cover boards, spine and leaves, spine towards the room."""
    cover = (soft.book_green if which == 0 else soft.book_red)()
    x, y, z = at
    lean = (0, turn)
    seed = round(x * 1000)
    put(box("Spine", (thick, 0.006, height), cover, 0.002, seed), (x, y - depth / 2, z + height / 2), tilt=lean)
    for side in (-1, 1):
        put(box("Board", (0.003, depth, height), cover, 0.001, seed + side),
            (x + side * (thick / 2 - 0.0015), y, z + height / 2), tilt=lean)
    put(box("Leaves", (thick - 0.006, depth - 0.012, height - 0.008), soft.pages(), 0, seed), (x, y, z + height / 2), tilt=lean)


def hanging_scroll():
    width, height = 0.33, 0.80
    v, u = np.meshgrid(np.linspace(0, 1, 24), np.linspace(0, 1, 8), indexing="ij")
    bulge = 0.012 + 0.01 * np.sin(v * 5.0) * (u - 0.3)
    points = np.stack([u * width, -bulge, v * height], axis=2)
    put(sheet("Scroll", points, np.stack([u * width, v * height], axis=2), soft.scroll()), (-1.06, BACK - 0.005, 1.14))
    rod = tube("Rod", [(-0.03, 0, 0), (0.15, 0, 0), (width + 0.03, 0, 0)], [0.012] * 3, wood.beam(), 12, 3)
    put(rod, (-1.06, BACK - 0.025, 1.135))
    again(rod, (-1.06, BACK - 0.025, 1.94), scale=1.0)


def lantern():
    ribs = lambda angle, z: 1.0 - 0.018 * np.abs(np.cos(z * math.pi / 0.042)) + 0 * angle
    paper = lathe("Lantern", [(0.06, 0.0), (0.10, 0.02), (0.132, 0.07), (0.145, 0.14), (0.132, 0.21), (0.10, 0.26), (0.06, 0.28)],
                  soft.lantern(), 36, 7, ribs)
    at = (0.70, 1.15, 1.315)
    put(paper, at)
    ring = lathe("Lantern ring", [(0.052, 0), (0.063, 0), (0.065, 0.006), (0.065, 0.018), (0.061, 0.022), (0.052, 0.018), (0.052, 0.0)],
                 wood.lacquer(), 36, 2)
    put(ring, (at[0], at[1], at[2] - 0.014))
    again(ring, (at[0], at[1], at[2] + 0.272))
    put(tube("Cord", [(0, 0, 0.28), (0, 0, 0.7), (0, 0, 1.1)], [0.004] * 3, wood.beam(), 8, 2), at)


def chair():
    hide, frame = soft.leather(), wood.oak()
    at = np.array([0.60, 0.98, 0.0])
    buttons = [(x * 0.115 + (0.0575 if row % 2 else 0.0), -0.13 + row * 0.095, 0.042)
               for row in range(4) for x in (range(-2, 3) if row % 2 == 0 else range(-2, 2))]
    back = cushion("Chair back", (0.60, 0.15, 0.52), hide, 6.0, 34, buttons, 0.035)
    put(back, at + (0, 0.26, 0.82), tilt=(-8, 0))
    stud = lathe("Button", [(0, 0), (0.011, 0), (0.012, 0.003), (0.007, 0.008), (0, 0.0095)], hide, 12, 2)
    for number, (x, z, _) in enumerate(buttons):
        place = at + (x, 0.26 - 0.040 + z * 0.139, 0.82 + z * 0.99)
        put(stud, place, tilt=(90 - 8, 0)) if number == 0 else again(stud, place, tilt=(90 - 8, 0))
    put(cushion("Seat", (0.60, 0.56, 0.14), hide, 6.0, 18), at + (0, -0.03, 0.43))
    arm = put(cushion("Arm", (0.09, 0.56, 0.07), hide, 5.0, 14), at + (-0.34, -0.02, 0.66))
    again(arm, at + (0.34, -0.02, 0.66))
    leg = put(box("Chair leg", (0.05, 0.05, 0.63), frame, 0.006, 31), at + (-0.34, -0.26, 0.315))
    for x, y in ((0.34, -0.26), (-0.34, 0.24), (0.34, 0.24)):
        again(leg, at + (x, y, 0.315))
    rail = put(box("Chair rail", (0.66, 0.035, 0.07), frame, 0.006, 32), at + (0, -0.26, 0.33))
    again(rail, at + (0, 0.24, 0.33))


def plant():
    """A pot on the sill with arching stems."""
    pot = lathe("Pot", [(0, 0), (0.05, 0), (0.055, 0.004), (0.075, 0.10), (0.086, 0.105), (0.088, 0.13), (0.080, 0.132), (0.074, 0.10), (0.0, 0.095)],
                hard.flower_pot(), 36, 3)
    at = np.array([LEFT + 0.0, 0.98, 0.88])
    put(pot, at, 40)
    blade = leaf_blade()
    place, chance = None, random.Random(5)
    for stem in range(7):
        heading = stem * 2.4 + 0.4
        reach, rise = chance.uniform(0.10, 0.24), chance.uniform(0.20, 0.42)
        out = np.array([math.cos(heading), math.sin(heading), 0.0])
        curve = [at + (0, 0, 0.09), at + out * reach * 0.3 + (0, 0, 0.09 + rise * 0.6), at + out * reach + (0, 0, 0.09 + rise)]
        tube("Stem", curve, [0.0035, 0.0028, 0.0015], soft.leaf(), 6, 4)
        for n in range(8):
            t = 0.35 + 0.65 * n / 7
            base = curve[0] * (1 - t) ** 2 + 2 * curve[1] * t * (1 - t) + curve[2] * t * t
            turn = math.degrees(heading) - 90 + (n % 2 * 2 - 1) * chance.uniform(25, 70)
            args = (base, turn, (chance.uniform(-20, 40), chance.uniform(-25, 25)), chance.uniform(0.6, 1.05))
            place = put(blade, *args) if place is None else again(blade, *args)


def leaf_blade():
    v, u = np.meshgrid(np.linspace(0, 1, 9), np.linspace(-1, 1, 5), indexing="ij")
    half = 0.019 * np.sin(np.pi * v**0.75) ** 0.8 + 0.0004
    x, y = u * half, v * 0.11
    z = 0.012 * np.abs(u) * np.sin(np.pi * v) - 0.035 * v**2
    return sheet("Leaf blade", np.stack([x, y, z], axis=2), np.stack([x, y], axis=2), soft.leaf())
