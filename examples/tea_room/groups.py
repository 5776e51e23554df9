"""Node groups that the materials share: grain, grime, scratches, weave, crackle, and so on.

Vectors are texture coordinates in metres; scales are in features per metre.
"""

from .graph import node_group


@node_group("Cloudy", [("Vector", None), ("Scale", 1.0)], ["Broad", "Fine", "Mixed"])
def cloudy(g, vector, scale):
    """Variation at three sizes."""
    broad = g.noise(vector, scale, 4.0, 0.55)
    middle = g.noise(g.place(vector, 1.0, 0.7, (3.1, 7.7, 0)), scale * 4.3, 4.0, 0.6)
    fine = g.noise(g.place(vector, 1.0, 1.9, (11.3, 2.9, 0)), scale * 19.0, 3.0, 0.6)
    mixed = g.math("MULTIPLY_ADD", middle, 0.35, broad * 0.5) + fine * 0.15
    return broad, fine, mixed


@node_group("Grime", [("Vector", None), ("Scale", 4.0), ("Amount", 0.5)], ["Mask"])
def grime(g, vector, scale, amount):
    """Patches of dirt with ragged borders."""
    patches = g.noise(vector, scale, 6.0, 0.62, 0.4)
    specks = g.noise(g.place(vector, 1.0, 0.5, (5.0, 1.0, 0)), scale * 6.0, 3.0, 0.7)
    blobs = g.voronoi(vector, scale * 2.3, "SMOOTH_F1")
    mass = patches * 0.6 + specks * 0.3
    mass = g.math("MULTIPLY_ADD", blobs, -0.12, mass)
    return g.remap(mass + (amount * 0.4 - 0.2), 0.40, 0.56, smooth=True)


@node_group("Scratches", [("Vector", None), ("Scale", 20.0), ("Density", 0.5)], ["Mask"])
def scratches(g, vector, scale, density):
    """Fine lines in three directions, in patches."""
    lines = None
    for turn, move in ((0.35, 0.0), (-0.8, 4.0), (1.9, 9.0)):
        stretched = g.place(g.place(vector, 1.0, turn, (move, move, 0)), (0.35, 9.0, 1.0))
        layer = g.remap(g.noise(stretched, scale, 2.0, 0.4, 0.25), 0.63, 0.68)
        lines = layer if lines is None else g.math("MAXIMUM", lines, layer)
    patches = g.remap(g.noise(vector, scale * 0.4, 3.0), 0.62 - density * 0.3, 0.72, smooth=True)
    return lines * patches


@node_group("Wood Grain", [("Vector", None), ("Scale", 1.0), ("Waviness", 0.5)], ["Rings", "Fibre", "Pores", "Height"])
def wood_grain(g, vector, scale, waviness):
    """Growth rings, fibres and pores; the grain runs along u."""
    across = g.place(vector, (1.2, 9.0, 1.0))
    drift = g.noise(g.place(vector, (0.9, 3.5, 1.0)), scale * 1.5, 3.0, 0.5, 0.6)
    x, y, z = g.separate(across)
    bent = g.combine(x, y + (drift - 0.5) * waviness * 6.0, z)
    rings = g.wave(bent, scale * 1.1, 2.2, 3.0, "Y", "SAW")
    fibre = g.noise(g.place(vector, (4.0, 130.0, 1.0)), scale, 5.0, 0.65)
    cells = g.voronoi(g.place(vector, (14.0, 420.0, 1.0)), scale, "F1")
    pores = g.remap(cells, 0.34, 0.12) * g.remap(fibre, 0.4, 0.7)
    height = g.math("MULTIPLY_ADD", rings, 0.3, fibre * 0.6)
    return rings, fibre, pores, height - pores * 0.5


@node_group("Weave", [("Vector", None), ("Threads", 400.0), ("Slub", 0.4)], ["Height", "Over", "Thread"])
def weave(g, vector, threads, slub):
    """Plain weave: relief, whether warp lies over weft, and a number of each thread."""
    wander = g.noise(vector, threads * 0.06, 2.0, color=True)
    moved = g.vector_math("SCALE", vector)
    g.feed(moved.socket.node.inputs["Scale"], threads)
    x, y, _ = g.separate(moved + g.vector_math("MULTIPLY", wander, (0.7, 0.7, 0.0)))
    column, row = g.math("FLOOR", x), g.math("FLOOR", y)
    over = g.math("MODULO", g.math("ABSOLUTE", column + row), 2.0)
    across = g.math("SINE", (x - column) * 3.14159)
    along = g.math("SINE", (y - row) * 3.14159)
    warp_height = g.math("POWER", across, 0.6) * g.math("MULTIPLY_ADD", along, 0.5, 0.5)
    weft_height = g.math("POWER", along, 0.6) * g.math("MULTIPLY_ADD", across, 0.5, 0.5)
    number = g.white(g.combine(g.mix_value(over, 0.0, column), g.mix_value(over, row, 0.0)))
    height = g.mix_value(over, weft_height, warp_height)
    return height * (1.0 - number * slub), over, number


@node_group("Crackle", [("Vector", None), ("Scale", 60.0), ("Width", 0.03)], ["Lines", "Cells"])
def crackle(g, vector, scale, width):
    """Crazing of a glaze: a coarse net and a finer, fainter one."""
    wobble = g.noise(vector, scale * 0.8, 2.0, color=True)
    bent = vector + g.vector_math("MULTIPLY", wobble, (0.006, 0.006, 0.0))
    coarse = g.voronoi(bent, scale, "DISTANCE_TO_EDGE")
    fine = g.voronoi(bent, scale * 2.7, "DISTANCE_TO_EDGE")
    cells = g.voronoi(bent, scale, "F1", "Color")
    lines = g.math("MAXIMUM", 1.0 - g.math("DIVIDE", coarse, width, clamp=True),
                   g.remap(fine, 0.0, width, 0.35, 0.0))
    return lines, g.remap(g.wire(g.add("ShaderNodeRGBToBW", {0: cells})), 0.1, 0.9)


@node_group("Smudges", [("Vector", None), ("Scale", 15.0), ("Base", 0.3), ("Range", 0.2)], ["Roughness"])
def smudges(g, vector, scale, base, spread):
    """Roughness with wipes and finger marks."""
    wipes = g.noise(g.place(vector, (0.4, 2.0, 1.0), 0.6), scale, 4.0, 0.6, 1.2)
    dabs = g.voronoi(g.place(vector, 1.0, 0.2, (2.0, 6.0, 0)), scale * 1.4, "SMOOTH_F1")
    worn = g.remap(wipes, 0.35, 0.7, smooth=True) * 0.7 + g.remap(dabs, 0.5, 0.2) * 0.3
    return g.math("MULTIPLY_ADD", worn, spread, base)


@node_group("Pits", [("Vector", None), ("Scale", 200.0), ("Amount", 0.3)], ["Depth"])
def pits(g, vector, scale, amount):
    """Pinholes, only some of the cells."""
    distance = g.voronoi(vector, scale, "F1")
    some = g.wire(g.add("ShaderNodeRGBToBW", {0: g.voronoi(vector, scale, "F1", "Color")}))
    hole = g.remap(distance, 0.32, 0.1, smooth=True)
    return hole * g.math("LESS_THAN", some, amount)


@node_group("Leather Folds", [("Vector", None), ("Scale", 220.0)], ["Height", "Creases"])
def leather_folds(g, vector, scale):
    """Pebbled grain with creases between the pebbles."""
    bent = vector + g.vector_math("MULTIPLY", g.noise(vector, scale * 0.4, 3.0, color=True), (0.004, 0.004, 0))
    edge = g.voronoi(bent, scale, "DISTANCE_TO_EDGE")
    small = g.voronoi(bent, scale * 2.2, "SMOOTH_F1")
    pebble = g.curve(g.remap(edge, 0.0, 0.35), [(0.0, 0.0), (0.35, 0.75), (1.0, 1.0)])
    long_folds = g.noise(g.place(vector, (1.0, 3.0, 1.0), 0.4), scale * 0.05, 4.0, 0.5, 0.8, "RIDGED_MULTIFRACTAL")
    creases = g.remap(long_folds, 0.9, 1.25, smooth=True)
    height = pebble * 0.6 + small * 0.2
    return height - creases * 0.5, creases


@node_group("Rust", [("Vector", None), ("Scale", 9.0), ("Amount", 0.5)], ["C Color", "Mask", "Height"])
def rust(g, vector, scale, amount):
    """Rust that blooms in patches, with its own relief."""
    bloom = g.noise(vector, scale, 8.0, 0.65, 0.5)
    grains = g.noise(g.place(vector, 1.0, 0.3), scale * 14.0, 4.0, 0.7)
    spots = g.voronoi(vector, scale * 5.0, "SMOOTH_F1")
    mass = g.math("MULTIPLY_ADD", spots, -0.22, bloom) + grains * 0.2
    mask = g.remap(mass + (amount - 0.5) * 0.5, 0.42, 0.55, smooth=True)
    color = g.ramp(grains, [(0.25, (0.045, 0.014, 0.007)), (0.5, (0.19, 0.052, 0.013)),
                            (0.66, (0.36, 0.115, 0.025)), (0.82, (0.5, 0.21, 0.06))])
    color = g.mix(g.remap(bloom, 0.35, 0.7), color, (0.1, 0.03, 0.012), "MULTIPLY")
    color = g.mix(0.45, color, g.ramp(spots, [(0.0, (0.42, 0.16, 0.04)), (0.6, (0.09, 0.028, 0.012))]))
    return color, mask, grains * 0.5 + spots * 0.4
