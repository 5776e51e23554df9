"""Materials of the room itself and of wood: plaster, tiles, planks, beams, bamboo, lacquer."""

from . import images
from .graph import material
from .groups import cloudy, crackle, grime, pits, scratches, smudges, wood_grain


@material("Clay Plaster")
def plaster(g):
    """Warm trowelled plaster with straw flecks, hairline cracks and a stain."""
    uv = g.uv()
    broad, fine, mixed = g.use(cloudy, uv, 1.6)
    color = g.ramp(mixed, [(0.3, (0.42, 0.305, 0.19)), (0.5, (0.53, 0.40, 0.265)), (0.7, (0.62, 0.49, 0.34))])
    trowel = g.noise(g.place(uv, (1.0, 2.6, 1.0), 0.5), 7.0, 4.0, 0.55, 1.4)
    color = g.mix(g.remap(trowel, 0.4, 0.65, 0.0, 0.3), color, (0.70, 0.58, 0.43))
    straw = None
    for turn, move in ((0.4, 0.0), (-0.9, 3.3), (1.5, 6.1)):
        cell = g.voronoi(g.place(uv, (16.0, 150.0, 1.0), turn, (move, move, 0)), 1.0)
        fleck = g.remap(cell, 0.16, 0.08)
        straw = fleck if straw is None else g.math("MAXIMUM", straw, fleck)
    straw = straw * g.remap(fine, 0.45, 0.6)
    color = g.mix(straw * 0.55, color, (0.74, 0.60, 0.33))
    bent = uv + g.vector_math("MULTIPLY", g.noise(uv, 5.0, 3.0, color=True), (0.12, 0.12, 0.0))
    crack = g.remap(g.voronoi(bent, 1.7, "DISTANCE_TO_EDGE"), 0.0, 0.006, 1.0, 0.0)
    crack = crack * g.remap(broad, 0.52, 0.62)
    color = g.mix(crack * 0.7, color, (0.16, 0.11, 0.07))
    dirt = g.use(grime, uv, 1.3, 0.3)
    color = g.mix(dirt * 0.22, color, (0.33, 0.24, 0.15), "MULTIPLY")
    color = g.hsv(color, 0.5, g.remap(broad, 0.3, 0.7, 0.9, 1.1), 1.0)
    height = trowel * 0.7 + fine * 0.25 + straw * 0.2 - crack * 0.6
    grain = g.noise(uv, 420.0, 3.0, 0.6)
    normal = g.bump(grain, 0.25, 0.001, g.bump(height, 0.5, 0.006))
    rough = g.remap(trowel, 0.35, 0.7, 0.95, 0.72)
    return g.principled(base_color=color, roughness=rough, normal=normal, specular_ior_level=0.3)


@material("Glazed Wall Tiles")
def wall_tiles(g):
    """Hand-made 10 cm tiles, sea green, every few a painted one; pooled glaze and grout."""
    uv = g.uv()
    wobble = g.noise(uv, 9.0, 2.0, color=True)
    bent = uv + g.vector_math("MULTIPLY", wobble, (0.004, 0.004, 0.0))
    _, joint = g.brick(bent, (0.1, 0.1), 0.0022, (0, 0, 0), (1, 1, 1), (0, 0, 0), 0.0, 0.15, 0.0)
    cell = g.place(bent, 10.0)
    x, y, _ = g.separate(cell)
    column, row = g.math("FLOOR", x), g.math("FLOOR", y)
    number = g.white(g.combine(column, row))
    other = g.white(g.combine(row + 31.0, column))
    inside = g.combine(x - column, y - row)
    tone = g.ramp(number, [(0.0, (0.055, 0.185, 0.155)), (0.35, (0.085, 0.27, 0.225)), (0.7, (0.13, 0.35, 0.29)), (1.0, (0.20, 0.42, 0.33))])
    pool = g.noise(uv + g.combine(number * 7.0, other * 7.0), 24.0, 4.0, 0.55, 0.8)
    tone = g.mix(g.remap(pool, 0.35, 0.7), tone, (0.045, 0.16, 0.15), "MULTIPLY")
    tone = g.mix(g.remap(pool, 0.3, 0.75, 0.15, 0.75), tone, g.hsv(tone, 0.49, 0.85, 2.6))
    frieze = g.math("COMPARE", row, 8.0, 0.1)
    painted = g.math("MAXIMUM", frieze, g.math("GREATER_THAN", other, 2.0))
    motif = g.image(images.packed("tile motif", images.tile_motif), inside)
    tone = g.mix(painted, tone, g.mix(g.remap(pool, 0.3, 0.7, 0.0, 0.25), motif, (0.45, 0.5, 0.45), "MULTIPLY"))
    lines, _ = g.use(crackle, uv, 70.0, 0.025)
    tone = g.mix(lines * 0.3, tone, (0.05, 0.05, 0.035))
    edge = g.math("MAXIMUM", g.math("ABSOLUTE", x - column - 0.5), g.math("ABSOLUTE", y - row - 0.5))
    worn = g.remap(edge + g.noise(uv, 60.0, 3.0) * 0.05, 0.49, 0.515)
    tone = g.mix(worn, tone, (0.48, 0.40, 0.30))
    dirt = g.use(grime, uv, 5.0, 0.45)
    grout = g.mix(dirt, (0.42, 0.37, 0.30), (0.20, 0.16, 0.12))
    color = g.mix(joint, tone, grout)
    rough = g.mix_value(joint, g.use(smudges, uv, 9.0, 0.07, 0.16), 0.9)
    rough = g.mix_value(worn, rough, 0.6)
    dome = g.remap(edge, 0.36, 0.5, 1.0, 0.0, smooth=True)
    tilt = (x - column) * (number - 0.5) + (y - row) * (other - 0.5)
    height = g.mix_value(joint, dome * 0.35 + tilt * 0.7 + pool * 0.22 + 0.3, 0.0)
    normal = g.bump(height, 0.5, 0.006)
    return g.principled(base_color=color, roughness=rough, normal=normal, coat_weight=0.35, coat_roughness=0.05)


@material("Terracotta Floor")
def floor_tiles(g):
    """Square terracotta, laid diagonally, waxed and walked on."""
    uv = g.place(g.uv(), 1.0, 0.785)
    wobble = g.noise(uv, 6.0, 2.0, color=True)
    bent = uv + g.vector_math("MULTIPLY", wobble, (0.008, 0.008, 0.0))
    base, joint = g.brick(bent, (0.2, 0.2), 0.004, (0.30, 0.095, 0.045), (0.47, 0.20, 0.095), (0.2, 0.16, 0.12), 0.0, 0.2, 0.0)
    broad, fine, mixed = g.use(cloudy, uv, 5.0)
    tone = g.mix(g.remap(mixed, 0.35, 0.65), base, (0.62, 0.36, 0.19), "OVERLAY")
    flash = g.noise(g.place(uv, 1.0, 0.2, (4.0, 4.0, 0)), 8.0, 3.0, 0.5, 1.0)
    tone = g.mix(g.remap(flash, 0.5, 0.7, 0.0, 0.5), tone, (0.17, 0.065, 0.04))
    speck = g.use(pits, uv, 240.0, 0.3)
    tone = g.mix(speck, tone, (0.14, 0.07, 0.045))
    wear = g.use(grime, uv, 1.6, 0.5)
    tone = g.mix(wear * 0.3, tone, (0.66, 0.42, 0.28), "SOFT_LIGHT")
    lines = g.use(scratches, uv, 14.0, 0.5)
    tone = g.mix(lines * 0.25, tone, (0.7, 0.5, 0.38))
    grout = g.mix(fine, (0.10, 0.075, 0.055), (0.27, 0.22, 0.17))
    color = g.mix(joint, tone, grout)
    rough = g.mix_value(wear, g.use(smudges, uv, 5.0, 0.24, 0.2), 0.55)
    rough = g.mix_value(joint, rough, 0.95)
    height = g.mix_value(joint, 0.75 + broad * 0.2 - speck * 0.12, g.remap(fine, 0.2, 0.8, 0.0, 0.25))
    normal = g.bump(fine, 0.12, 0.001, g.bump(height, 0.6, 0.004))
    return g.principled(base_color=color, roughness=rough, normal=normal, coat_weight=g.remap(wear, 0.0, 1.0, 0.3, 0.05), coat_roughness=0.2)


@material("Oiled Oak")
def oak(g):
    """Table boards: grain, pores, scanned streaks, cup rings, scratches, darker hollows."""
    uv = g.uv()
    rings, fibre, pores, height = g.use(wood_grain, uv, 1.0, 0.55)
    scan = g.image(images.packed("wood scan", images.wood_scan, True), g.place(uv, (1.3, 6.0, 1.0)))
    scan = g.wire(g.add("ShaderNodeRGBToBW", {0: scan}))
    base = g.ramp(rings * 0.55 + scan * 0.45, [(0.1, (0.40, 0.205, 0.085)), (0.5, (0.29, 0.132, 0.05)), (0.85, (0.175, 0.072, 0.027))])
    base = g.mix(g.remap(fibre, 0.35, 0.7, 0.0, 0.6), base, (0.45, 0.26, 0.12), "SOFT_LIGHT")
    base = g.mix(pores * 0.75, base, (0.06, 0.025, 0.012))
    broad, _, mixed = g.use(cloudy, g.place(uv, (0.5, 1.0, 1.0)), 3.0)
    base = g.hsv(base, g.remap(broad, 0.3, 0.7, 0.492, 0.508), g.remap(mixed, 0.35, 0.65, 0.85, 1.12), g.remap(mixed, 0.3, 0.7, 0.82, 1.2))
    stain = g.voronoi(g.place(uv, 1.0, 0.3, (0.35, 0.8, 0)), 3.1, "F1", random=0.9)
    stain = g.curve(stain, [(0.0, 0.0), (0.155, 0.0), (0.165, 0.9), (0.172, 0.25), (0.18, 0.0), (1.0, 0.0)])
    stain = stain * g.remap(g.noise(uv, 14.0, 3.0), 0.42, 0.6)
    base = g.mix(stain * 0.5, base, (0.075, 0.03, 0.014))
    lines = g.use(scratches, uv, 16.0, 0.45)
    base = g.mix(lines * 0.35, base, (0.50, 0.32, 0.18))
    dirt = g.use(grime, uv, 3.2, 0.3)
    base = g.mix(dirt * 0.35, base, (0.35, 0.22, 0.14), "MULTIPLY")
    rough = g.use(smudges, uv, 7.0, 0.26, 0.22) + pores * 0.2
    rough = g.mix_value(lines, rough, 0.6)
    normal = g.bump(height, 0.28, 0.0012, g.bump(broad, 0.12, 0.01))
    return g.principled(base_color=base, roughness=rough, normal=normal, coat_weight=0.18, coat_roughness=0.22)


@material("Smoked Beam")
def beam(g):
    """Old dark timber: adze marks, checks along the grain, dust in the hollows."""
    uv = g.uv()
    rings, fibre, pores, height = g.use(wood_grain, uv, 0.8, 0.8)
    base = g.ramp(rings * 0.5 + fibre * 0.5, [(0.2, (0.085, 0.043, 0.023)), (0.55, (0.052, 0.025, 0.0135)), (0.85, (0.022, 0.0115, 0.007))])
    adze = g.voronoi(g.place(uv, (7.0, 16.0, 1.0)), 1.0, "SMOOTH_F1")
    split = g.noise(g.place(uv, (0.7, 26.0, 1.0)), 1.0, 3.0, 0.5, 0.3, "RIDGED_MULTIFRACTAL")
    split = g.remap(split, 1.12, 1.3) * g.remap(g.noise(uv, 1.4), 0.42, 0.55)
    base = g.mix(split, base, (0.006, 0.004, 0.003))
    broad, fine, mixed = g.use(cloudy, uv, 2.4)
    dust = g.remap(adze, 0.4, 0.75, smooth=True) * g.remap(mixed, 0.4, 0.62)
    base = g.mix(dust * 0.35, base, (0.21, 0.145, 0.095))
    sheen = g.use(grime, uv, 2.2, 0.4)
    base = g.mix(sheen * 0.3, base, (0.12, 0.055, 0.025))
    base = g.contrast(base, 0.0, 0.04)
    rough = g.mix_value(sheen, g.use(smudges, uv, 6.0, 0.5, 0.22), 0.3)
    relief = height * 0.4 - split * 0.8 + fine * 0.1
    normal = g.bump(relief, 0.45, 0.003, g.bump(adze, 0.5, 0.008))
    return g.principled(base_color=base, roughness=g.math("MAXIMUM", rough, dust * 0.8), normal=normal)


@material("Split Bamboo")
def bamboo(g):
    """Culms, whisk and scoop: fibres along v, nodes every 20 cm, honey patches."""
    uv = g.uv()
    x, y, _ = g.separate(uv)
    fibre = g.noise(g.place(uv, (260.0, 5.0, 1.0)), 1.0, 4.0, 0.6)
    broad, fine, mixed = g.use(cloudy, uv, 14.0)
    base = g.ramp(mixed, [(0.3, (0.42, 0.27, 0.10)), (0.5, (0.58, 0.41, 0.18)), (0.72, (0.70, 0.55, 0.29))])
    base = g.mix(g.remap(fibre, 0.35, 0.68, 0.0, 0.55), base, (0.40, 0.24, 0.09), "MULTIPLY")
    section = g.math("PINGPONG", y + 0.02, 0.1)
    ring = g.remap(section, 0.0, 0.0035, 1.0, 0.0, smooth=True)
    below = g.remap(section, 0.0, 0.018, 0.7, 0.0)
    base = g.mix(ring, base, (0.20, 0.11, 0.045))
    base = g.mix(below * 0.5, base, (0.78, 0.70, 0.50))
    spots = g.use(pits, uv, 130.0, 0.25)
    base = g.mix(spots * 0.6, base, (0.23, 0.12, 0.04))
    dirt = g.use(grime, uv, 11.0, 0.3)
    base = g.mix(dirt * 0.3, base, (0.30, 0.17, 0.06))
    rough = g.use(smudges, uv, 20.0, 0.28, 0.2) + ring * 0.3
    normal = g.bump(fibre * 0.4 + ring - below * 0.3, 0.3, 0.0012)
    return g.principled(base_color=base, roughness=rough, normal=normal, specular_ior_level=0.5)


@material("Red Lacquer")
def lacquer(g):
    """Vermilion over black, rubbed through at edges, with a band of gold waves."""
    uv = g.uv()
    x, y, _ = g.separate(uv)
    broad, fine, mixed = g.use(cloudy, uv, 18.0)
    red = g.ramp(mixed, [(0.3, (0.26, 0.014, 0.008)), (0.55, (0.42, 0.026, 0.012)), (0.75, (0.52, 0.045, 0.018))])
    rubbed = g.remap(broad * 0.6 + fine * 0.4, 0.53, 0.60, smooth=True)
    color = g.mix(rubbed * 0.8, red, (0.012, 0.008, 0.008))
    crest = g.image(images.packed("wave crest", images.wave_crest, True), g.place(uv, (18.0, 18.0, 1.0)))
    crest = g.wire(g.add("ShaderNodeRGBToBW", {0: crest}))
    caddy_band = g.math("ABSOLUTE", y - 0.135)
    tray_band = g.math("ABSOLUTE", y - 0.35) * 0.6
    band = g.remap(g.math("MINIMUM", caddy_band, tray_band), 0.022, 0.024, 1.0, 0.0)
    flakes = g.remap(g.noise(uv, 260.0, 2.0), 0.38, 0.46)
    gold = g.math("GREATER_THAN", crest, 0.45) * band * flakes
    gold = gold * g.remap(broad, 0.66, 0.56)
    tint = g.mix(g.noise(uv, 60.0), (0.80, 0.48, 0.13), (0.95, 0.70, 0.30))
    hair = g.image(images.packed("scratches", images.scratch_map, True), g.place(uv, 9.0, 0.3))
    hair = g.wire(g.add("ShaderNodeRGBToBW", {0: hair}))
    color = g.mix(hair * 0.3, color, (0.5, 0.2, 0.15))
    rough = g.use(smudges, uv, 22.0, 0.12, 0.2) + hair * 0.2
    rough = g.mix_value(gold, rough, 0.28)
    dust = g.use(grime, uv, 9.0, 0.2)
    color = g.mix(dust * 0.08, color, (0.5, 0.4, 0.33))
    normal = g.bump(gold * 0.5 + g.noise(uv, 35.0) * 0.3 - hair * 0.1, 0.2, 0.001)
    under = g.principled(base_color=color, roughness=rough, normal=normal, coat_weight=0.6, coat_roughness=0.06)
    metal = g.principled(base_color=tint, roughness=rough, metallic=1.0, normal=normal)
    return g.mix_shader(gold, under, metal)
