"""Materials of soft things: leather, cloth, matting, paper, books, leaves, sweets, tea."""

from . import images
from .graph import material
from .groups import cloudy, grime, leather_folds, pits, scratches, smudges, weave


@material("Saddle Leather")
def leather(g):
    """Brown leather: pebbled, creased, rubbed pale where one leans, darker in folds."""
    uv = g.uv()
    height, creases = g.use(leather_folds, uv, 260.0)
    broad, fine, mixed = g.use(cloudy, uv, 5.0)
    hide = g.ramp(mixed, [(0.3, (0.075, 0.022, 0.009)), (0.52, (0.145, 0.045, 0.017)), (0.72, (0.23, 0.082, 0.031))])
    hide = g.mix(g.remap(height, 0.0, 0.5, 0.5, 0.0), hide, (0.05, 0.016, 0.008))
    rubbed = g.use(grime, uv, 4.0, 0.42)
    hide = g.mix(rubbed * 0.4, hide, (0.34, 0.155, 0.068))
    hide = g.mix(creases * 0.5, hide, (0.08, 0.026, 0.012))
    lines = g.use(scratches, uv, 20.0, 0.5)
    hide = g.mix(lines * 0.4, hide, (0.45, 0.24, 0.12))
    hide = g.rgb_curve(hide, [(0.0, 0.0), (0.4, 0.38), (1.0, 1.0)])
    rough = g.use(smudges, uv, 9.0, 0.3, 0.2) + creases * 0.2
    rough = g.mix_value(rubbed, rough, 0.34)
    swell = g.noise(uv, 14.0, 3.0)
    normal = g.bump(height, 0.35, 0.0012, g.bump(swell - creases * 0.5, 0.25, 0.006))
    return g.principled(base_color=hide, roughness=rough, normal=normal, coat_weight=0.1, coat_roughness=0.3)


@material("Indigo Runner")
def runner(g):
    """Indigo cloth with white diamond borders, faded on the folds, woven."""
    uv = g.uv()
    x, y, _ = g.separate(uv)
    relief, over, thread = g.use(weave, uv, 620.0, 0.35)
    broad, fine, mixed = g.use(cloudy, uv, 6.0)
    indigo = g.ramp(mixed, [(0.3, (0.018, 0.032, 0.105)), (0.55, (0.035, 0.06, 0.17)), (0.75, (0.075, 0.115, 0.26))])
    indigo = g.hsv(indigo, 0.5, g.remap(thread, 0.0, 1.0, 0.8, 1.1), g.remap(thread, 0.0, 1.0, 0.75, 1.25))
    pattern = g.image(images.packed("runner border", images.runner_border, True), g.place(uv, 12.5))
    pattern = g.wire(g.add("ShaderNodeRGBToBW", {0: pattern}))
    side = g.math("ABSOLUTE", x - 0.2)
    band = g.remap(g.math("ABSOLUTE", side - 0.145), 0.0395, 0.0405, 1.0, 0.0)
    stripes = g.remap(g.math("ABSOLUTE", g.math("ABSOLUTE", side - 0.145) - 0.046), 0.0025, 0.003, 1.0, 0.0)
    hem = g.remap(g.math("ABSOLUTE", y - 0.045), 0.005, 0.006, 1.0, 0.0)
    drawn = g.math("MAXIMUM", g.math("MAXIMUM", pattern * band, stripes), hem)
    frayed = drawn * g.remap(fine, 0.3, 0.45)
    white = g.mix(thread, (0.50, 0.46, 0.38), (0.72, 0.68, 0.58))
    cloth = g.mix(frayed, indigo, white)
    cloth = g.mix(g.remap(relief, 0.1, 0.8, 0.55, 0.0), cloth, (0.010, 0.014, 0.04))
    stain = g.use(grime, uv, 5.0, 0.2)
    cloth = g.mix(stain * 0.2, cloth, (0.4, 0.33, 0.22), "MULTIPLY")
    soft = g.noise(uv, 30.0, 3.0)
    normal = g.bump(relief + frayed * 0.3, 0.5, 0.0007, g.bump(soft, 0.2, 0.003))
    return g.principled(base_color=cloth, roughness=0.9, normal=normal, sheen_weight=0.1, sheen_roughness=0.4, specular_ior_level=0.2)


@material("Rush Mat")
def rush(g):
    """Plaited rush in a herringbone of thick strands."""
    uv = g.uv()
    relief, over, strand = g.use(weave, g.place(uv, 1.0, 0.785), 105.0, 0.3)
    broad, fine, mixed = g.use(cloudy, uv, 7.0)
    fibre_a = g.noise(g.place(uv, (8.0, 600.0, 1.0), 0.785), 1.0, 3.0)
    fibre_b = g.noise(g.place(uv, (600.0, 8.0, 1.0), 0.785), 1.0, 3.0)
    fibre = g.mix_value(over, fibre_a, fibre_b)
    straw = g.ramp(strand * 0.6 + fibre * 0.4, [(0.15, (0.30, 0.20, 0.075)), (0.5, (0.46, 0.34, 0.145)), (0.85, (0.58, 0.48, 0.25))])
    straw = g.mix(g.remap(mixed, 0.4, 0.65, 0.0, 0.4), straw, (0.36, 0.36, 0.15))
    straw = g.mix(g.remap(relief, 0.0, 0.5, 0.85, 0.0), straw, (0.055, 0.033, 0.013))
    dirt = g.use(grime, uv, 5.0, 0.35)
    straw = g.mix(dirt * 0.4, straw, (0.20, 0.13, 0.06))
    normal = g.bump(relief + fibre * 0.15, 0.8, 0.0035)
    return g.principled(base_color=straw, roughness=g.remap(fibre, 0.3, 0.7, 0.55, 0.8), normal=normal)


@material("Hemp Linen")
def linen(g):
    """Undyed cloth that lets some light through."""
    uv = g.uv()
    relief, over, thread = g.use(weave, uv, 480.0, 0.6)
    broad, fine, mixed = g.use(cloudy, uv, 4.0)
    slub = g.remap(g.noise(g.place(uv, (12.0, 420.0, 1.0)), 1.0, 3.0), 0.58, 0.7)
    slub = g.math("MAXIMUM", slub, g.remap(g.noise(g.place(uv, (420.0, 12.0, 1.0)), 1.0, 3.0), 0.6, 0.7))
    flax = g.ramp(thread * 0.5 + mixed * 0.5, [(0.2, (0.48, 0.41, 0.30)), (0.5, (0.63, 0.56, 0.44)), (0.8, (0.74, 0.68, 0.57))])
    flax = g.mix(slub * 0.5, flax, (0.42, 0.33, 0.21))
    flax = g.mix(g.remap(relief, 0.05, 0.6, 0.6, 0.0), flax, (0.25, 0.20, 0.14))
    stain = g.use(grime, uv, 6.0, 0.22)
    flax = g.mix(stain * 0.25, flax, (0.5, 0.38, 0.22), "MULTIPLY")
    normal = g.bump(relief + slub * 0.6, 0.5, 0.0008, g.bump(fine, 0.2, 0.002))
    front = g.principled(base_color=flax, roughness=0.95, normal=normal, sheen_weight=0.2, specular_ior_level=0.15)
    back = g.shader("BsdfTranslucent", {"Color": g.hsv(flax, 0.5, 1.2, 0.9), "Normal": normal})
    return g.mix_shader(0.25, front, back)


def washi(g, uv):
    """Handmade paper: its colour, where it is thin, and its fibres."""
    broad, fine, mixed = g.use(cloudy, uv, 10.0)
    long_a = g.noise(g.place(uv, (3.0, 40.0, 1.0), 0.5), 4.0, 2.0, 0.5, 1.6, "RIDGED_MULTIFRACTAL")
    long_b = g.noise(g.place(uv, (40.0, 3.0, 1.0), 0.2, (5.0, 2.0, 0)), 4.0, 2.0, 0.5, 1.6, "RIDGED_MULTIFRACTAL")
    fibres = g.math("MAXIMUM", g.remap(long_a, 1.1, 1.35), g.remap(long_b, 1.15, 1.35))
    color = g.ramp(mixed, [(0.3, (0.66, 0.58, 0.45)), (0.55, (0.78, 0.72, 0.60)), (0.75, (0.85, 0.80, 0.70))])
    color = g.mix(fibres * 0.35, color, (0.52, 0.42, 0.28))
    specks = g.use(pits, uv, 160.0, 0.06)
    color = g.mix(specks * 0.6, color, (0.33, 0.22, 0.11))
    return color, g.remap(mixed, 0.35, 0.65), fibres


@material("Lantern Paper")
def lantern(g):
    """Washi over ribs, lit from inside: warm, brighter at the middle, darker on fibres."""
    uv = g.uv()
    x, y, _ = g.separate(uv)
    color, thin, fibres = washi(g, uv)
    rib = g.remap(g.math("PINGPONG", y, 0.024), 0.0, 0.0022, 1.0, 0.0, smooth=True)
    color = g.mix(rib * 0.6, color, (0.30, 0.19, 0.09))
    height = g.remap(y, 0.02, 0.33)
    glow = g.curve(height, [(0.0, 0.25), (0.3, 0.85), (0.5, 1.0), (0.75, 0.75), (1.0, 0.2)])
    patch = g.remap(g.noise(uv, 7.0, 3.0), 0.3, 0.7, 0.8, 1.1)
    stamp = g.use(grime, uv, 10.0, 0.2)
    glow = glow * patch * (1.0 - rib * 0.55) * (1.0 - fibres * 0.25)
    warm = g.mix(glow, (1.0, 0.25, 0.05), (1.0, 0.55, 0.20))
    color = g.mix(stamp * 0.15, color, (0.5, 0.36, 0.2))
    skin = g.principled(base_color=color, roughness=0.8, normal=g.bump(rib + fibres * 0.2, 0.3, 0.001))
    through = g.shader("BsdfTranslucent", {"Color": color})
    light = g.shader("Emission", {"Color": warm, "Strength": glow * 1.0 + thin * 0.1})
    return g.add_shader(g.mix_shader(0.4, skin, through), light)


@material("Shoji Paper")
def shoji(g):
    """The window's paper panes: the sun glows in them."""
    uv = g.uv()
    color, thin, fibres = washi(g, g.place(uv, 1.0, 0.1))
    x, y, _ = g.separate(uv)
    aged = g.remap(y + (thin - 0.5) * 0.2, 0.25, 0.0)
    color = g.mix(aged * 0.3, color, (0.66, 0.48, 0.28))
    stain = g.use(grime, uv, 3.0, 0.2)
    color = g.mix(stain * 0.2, color, (0.60, 0.46, 0.29))
    ripple = g.noise(g.place(uv, (1.0, 0.4, 1.0)), 9.0, 2.0)
    normal = g.bump(ripple + fibres * 0.1, 0.25, 0.003)
    front = g.shader("BsdfDiffuse", {"Color": color, "Normal": normal})
    back = g.shader("BsdfTranslucent", {"Color": g.hsv(color, 0.5, 1.25, g.remap(thin, 0.0, 1.0, 0.8, 1.0))})
    return g.mix_shader(0.55, front, back)


@material("Calligraphy Scroll")
def scroll(g):
    """A paper scroll on brocade, hung on the wall; the picture is 0.30 m by 0.60 m."""
    uv = g.uv()
    x, y, _ = g.separate(uv)
    paper, thin, fibres = washi(g, uv)
    writing = g.image(images.packed("calligraphy", images.calligraphy), g.place(uv, (4.0, 2.0, 1.0), 0.0, (-0.16, -0.30, 0)), extension="EXTEND")
    paper = g.mix(0.85, paper, writing, "MULTIPLY")
    relief, over, thread = g.use(weave, uv, 700.0, 0.3)
    motif = g.voronoi(uv, 42.0, random=0.0)
    gold = g.remap(g.math("ABSOLUTE", motif - 0.3), 0.06, 0.05, 0.0, 1.0)
    silk = g.mix(gold, (0.060, 0.085, 0.060), (0.42, 0.31, 0.13))
    silk = g.hsv(silk, 0.5, 1.0, g.remap(thread, 0.0, 1.0, 0.75, 1.2))
    inside = g.math("LESS_THAN", g.math("ABSOLUTE", x - 0.165), 0.125) * g.math("LESS_THAN", g.math("ABSOLUTE", y - 0.40), 0.25)
    color = g.mix(inside, silk, paper)
    aged = g.use(grime, uv, 3.0, 0.35)
    color = g.mix(aged * 0.18, color, (0.6, 0.44, 0.25), "MULTIPLY")
    relief = g.mix_value(inside, relief, fibres * 0.4)
    rough = g.mix_value(inside, 0.55, 0.9)
    return g.principled(base_color=color, roughness=rough, normal=g.bump(relief, 0.3, 0.0006), sheen_weight=0.1)


def bookcloth(g, dark, light, label_at):
    """Cover cloth with a printed label of 9 cm at `label_at`, scuffed at its edges."""
    uv = g.uv()
    relief, over, thread = g.use(weave, uv, 900.0, 0.4)
    broad, fine, mixed = g.use(cloudy, uv, 10.0)
    cloth = g.mix(g.remap(mixed, 0.35, 0.65), dark, light)
    cloth = g.hsv(cloth, 0.5, 1.0, g.remap(thread, 0.0, 1.0, 0.8, 1.2))
    cloth = g.mix(g.remap(relief, 0.0, 0.6, 0.4, 0.0), cloth, (0.02, 0.015, 0.012))
    local = g.place(uv, 1 / 0.09, 0.0, tuple(-v / 0.09 for v in label_at) + (0.0,))
    print_color = g.image(images.packed("book label", images.book_label), local, extension="CLIP")
    x, y, _ = g.separate(local)
    half = g.math("MAXIMUM", g.math("ABSOLUTE", x - 0.5), g.math("ABSOLUTE", y - 0.5))
    label = g.math("LESS_THAN", half + (fine - 0.5) * 0.02, 0.49)
    cloth = g.mix(label, cloth, g.mix(g.remap(mixed, 0.4, 0.7, 0.0, 0.35), print_color, (0.6, 0.45, 0.28), "MULTIPLY"))
    worn = g.use(grime, uv, 14.0, 0.25)
    cloth = g.mix(worn * 0.3, cloth, (0.45, 0.38, 0.29))
    lines = g.use(scratches, uv, 30.0, 0.4)
    cloth = g.mix(lines * 0.3, cloth, (0.6, 0.5, 0.4))
    normal = g.bump(g.mix_value(label, relief, fine * 0.3 + 0.6), 0.35, 0.0006)
    return g.principled(base_color=cloth, roughness=g.mix_value(label, 0.8, 0.6), normal=normal)


@material("Book Cloth Green")
def book_green(g):
    return bookcloth(g, (0.022, 0.060, 0.045), (0.045, 0.105, 0.075), (-0.06, 0.575))


@material("Book Cloth Red")
def book_red(g):
    return bookcloth(g, (0.15, 0.022, 0.016), (0.25, 0.045, 0.028), (-0.03, 0.565))


@material("Book Pages")
def pages(g):
    """Edges of leaves: thin lines, foxing, some gathered into signatures."""
    uv = g.uv()
    x, y, _ = g.separate(uv)
    leaf = g.noise(g.place(uv, (2.0, 1800.0, 1.0)), 1.0, 3.0, 0.7)
    bands = g.wave(uv, 40.0, 1.2, 2.0, "Y")
    broad, fine, mixed = g.use(cloudy, uv, 16.0)
    paper = g.ramp(leaf * 0.6 + bands * 0.15 + mixed * 0.25, [(0.25, (0.40, 0.30, 0.18)), (0.5, (0.66, 0.56, 0.40)), (0.75, (0.78, 0.70, 0.55))])
    foxing = g.use(grime, uv, 20.0, 0.25)
    paper = g.mix(foxing * 0.4, paper, (0.42, 0.25, 0.11))
    gaps = g.remap(leaf, 0.38, 0.3)
    paper = g.mix(gaps * 0.6, paper, (0.12, 0.08, 0.045))
    spots = g.use(pits, uv, 300.0, 0.06)
    paper = g.mix(spots * 0.5, paper, (0.3, 0.17, 0.08))
    normal = g.bump(leaf + bands * 0.4, 0.5, 0.0008)
    return g.principled(base_color=paper, roughness=0.9, normal=normal, specular_ior_level=0.2)


@material("Leaf")
def leaf(g):
    """Leaves 11 cm long, u across from -0.5 to 0.5 of the width; ribs, blotches, back light."""
    uv = g.uv()
    x, y, _ = g.separate(uv)
    side = g.math("ABSOLUTE", x)
    rib = g.remap(side, 0.0005, 0.0016, 1.0, 0.0)
    veins = g.wave(g.combine(y - side * 0.8, 0.0), 26.0, 0.5, 1.0, "X", "SIN")
    veins = g.remap(veins, 0.9, 0.99)
    broad, fine, mixed = g.use(cloudy, uv, 30.0)
    green = g.ramp(mixed, [(0.3, (0.022, 0.070, 0.016)), (0.55, (0.05, 0.13, 0.028)), (0.75, (0.12, 0.21, 0.045))])
    green = g.mix(g.math("MAXIMUM", rib, veins * 0.5) * 0.6, green, (0.26, 0.36, 0.12))
    dry = g.use(grime, uv, 24.0, 0.15)
    green = g.mix(dry * 0.5, green, (0.32, 0.22, 0.06))
    rough = g.use(smudges, uv, 40.0, 0.3, 0.2)
    net = g.voronoi(uv, 420.0, "DISTANCE_TO_EDGE")
    normal = g.bump(rib * 0.6 + veins * 0.4 - g.remap(net, 0.0, 0.2) * 0.2, 0.35, 0.001)
    face = g.principled(base_color=green, roughness=rough, normal=normal)
    through = g.shader("BsdfTranslucent", {"Color": g.hsv(green, 0.48, 1.2, 2.2), "Normal": normal})
    return g.mix_shader(0.35, face, through)


def sweet(g, base, dusting):
    """A soft rice cake, dusted with flour."""
    uv = g.uv()
    broad, fine, mixed = g.use(cloudy, uv, 40.0)
    flour = g.remap(mixed + g.noise(uv, 700.0, 2.0) * 0.3, 0.55, 0.75)
    color = g.mix(flour * 0.7, base, dusting)
    normal = g.bump(fine * 0.5 + flour * 0.4, 0.25, 0.001)
    return g.principled(base_color=color, roughness=g.remap(flour, 0.0, 1.0, 0.4, 0.9), normal=normal)


@material("Rose Mochi")
def mochi_rose(g):
    return sweet(g, (0.72, 0.34, 0.33), (0.88, 0.78, 0.72))


@material("Mugwort Mochi")
def mochi_green(g):
    return sweet(g, (0.30, 0.40, 0.16), (0.80, 0.80, 0.66))


@material("Matcha Tea")
def tea(g):
    """Whisked tea: pale foam over deep green."""
    uv = g.uv()
    broad, fine, mixed = g.use(cloudy, uv, 30.0)
    foam = g.remap(mixed, 0.42, 0.6, smooth=True)
    bubble = g.voronoi(uv, 420.0, "DISTANCE_TO_EDGE")
    color = g.mix(foam, (0.09, 0.16, 0.015), (0.32, 0.42, 0.07))
    color = g.mix(g.remap(bubble, 0.0, 0.08, 0.35, 0.0) * foam, color, (0.5, 0.58, 0.2))
    return g.principled(base_color=color, roughness=g.remap(foam, 0.0, 1.0, 0.08, 0.4), normal=g.bump(bubble * foam, 0.3, 0.001))


@material("Garden View")
def garden(g):
    """Light from the picture of a garden, 8 m by 3.3 m."""
    picture = g.image(images.packed("garden", images.garden), g.place(g.uv(), (1 / 8.0, 1 / 3.3, 1.0)))
    return g.shader("Emission", {"Color": g.gamma(picture, 1.15), "Strength": 1.7})
