"""Materials of the tea things: glazes, brushed copper, rusted iron, terracotta."""

from .graph import material
from .groups import cloudy, crackle, grime, pits, rust, scratches, smudges


@material("Celadon Glaze")
def celadon(g):
    """Grey-green crackled glaze, thin and brown at the rim, with iron specks."""
    uv = g.uv()
    broad, fine, mixed = g.use(cloudy, uv, 22.0)
    color = g.ramp(mixed, [(0.3, (0.21, 0.33, 0.25)), (0.5, (0.34, 0.47, 0.36)), (0.7, (0.47, 0.58, 0.45))])
    lines, cells = g.use(crackle, uv, 110.0, 0.035)
    color = g.mix(lines * 0.6, color, (0.13, 0.09, 0.05))
    color = g.hsv(color, 0.5, g.remap(cells, 0.0, 1.0, 0.85, 1.15), g.remap(cells, 0.0, 1.0, 0.92, 1.08))
    speck = g.use(pits, uv, 210.0, 0.12)
    color = g.mix(speck * 0.8, color, (0.10, 0.05, 0.02))
    flow = g.noise(g.place(uv, (30.0, 4.0, 1.0)), 1.0, 3.0, 0.5, 0.5)
    color = g.mix(g.remap(flow, 0.5, 0.75, 0.0, 0.35), color, (0.58, 0.66, 0.52))
    tea = g.use(grime, uv, 16.0, 0.25)
    color = g.mix(tea * 0.25, color, (0.30, 0.20, 0.09))
    rough = g.use(smudges, uv, 30.0, 0.06, 0.12) + lines * 0.15
    height = mixed * 0.6 + flow * 0.3 - lines * 0.25 - speck * 0.5
    normal = g.bump(height, 0.18, 0.0015)
    return g.principled(base_color=color, roughness=rough, normal=normal, coat_weight=0.5, coat_roughness=0.03)


@material("Tenmoku Glaze")
def tenmoku(g):
    """Black-brown iron glaze with oil spots, running thick over a bare clay foot."""
    uv = g.uv()
    x, y, _ = g.separate(uv)
    broad, fine, mixed = g.use(cloudy, uv, 16.0)
    streak = g.noise(g.place(uv, (70.0, 7.0, 1.0)), 1.0, 5.0, 0.6, 0.4)
    hare = g.remap(streak, 0.4, 0.7, smooth=True)
    glaze = g.ramp(hare * 0.35 + mixed * 0.55, [(0.15, (0.012, 0.008, 0.007)), (0.45, (0.055, 0.020, 0.010)), (0.7, (0.21, 0.075, 0.022)), (0.95, (0.42, 0.20, 0.06))])
    spots = g.voronoi(uv, 150.0)
    silver = g.remap(spots, 0.30, 0.22) * g.remap(broad, 0.48, 0.6)
    glaze = g.mix(silver, glaze, (0.28, 0.30, 0.31))
    drip = g.noise(g.combine(x * 26.0, 0.0), 1.0, 3.0, 0.6)
    line = y - (drip * 0.030 + 0.006)
    bare = g.remap(line, 0.0, 0.0016, 1.0, 0.0)
    lip = g.remap(line, 0.0, 0.006, 1.0, 0.0, smooth=True) * (1.0 - bare)
    clay = g.mix(fine, (0.20, 0.11, 0.065), (0.34, 0.21, 0.13))
    pinholes = g.use(pits, uv, 260.0, 0.2)
    color = g.mix(bare, g.mix(lip * 0.7, glaze, (0.02, 0.01, 0.008)), clay)
    color = g.mix(pinholes * bare * 0.6, color, (0.07, 0.035, 0.02))
    dust = g.use(grime, uv, 12.0, 0.3)
    color = g.mix(dust * 0.1, color, (0.4, 0.33, 0.26))
    rough = g.mix_value(bare, g.use(smudges, uv, 26.0, 0.07, 0.14), 0.85)
    rough = g.mix_value(silver, rough, 0.22)
    throwing = g.wave(g.place(uv, (1.0, 90.0, 1.0)), 1.0, 0.6, 2.0, "Y")
    height = throwing * 0.12 + lip * 0.7 + mixed * 0.25 - bare * 0.4 - pinholes * 0.4
    normal = g.bump(height, 0.3, 0.002)
    coat = g.mix_value(bare, 0.6, 0.0)
    return g.principled(base_color=color, roughness=rough, normal=normal, coat_weight=coat, coat_roughness=0.04)


@material("White Slip Raku")
def raku(g):
    """Milky glaze with a smoked net of cracks over a rough, dark body."""
    uv = g.uv()
    x, y, _ = g.separate(uv)
    broad, fine, mixed = g.use(cloudy, uv, 13.0)
    milk = g.ramp(mixed, [(0.3, (0.60, 0.53, 0.44)), (0.5, (0.76, 0.71, 0.62)), (0.7, (0.83, 0.79, 0.71))])
    lines, cells = g.use(crackle, uv, 48.0, 0.05)
    smoke = g.remap(g.noise(uv, 9.0, 4.0, 0.6, 0.6), 0.42, 0.62, smooth=True)
    milk = g.mix(smoke * 0.4, milk, (0.46, 0.30, 0.19))
    milk = g.mix(lines * g.remap(smoke, 0.0, 1.0, 0.45, 0.95), milk, (0.045, 0.035, 0.03))
    wide = g.noise(g.place(uv, (24.0, 10.0, 1.0)), 1.0, 4.0)
    bare = g.remap(y - wide * 0.035, 0.012, 0.015, 1.0, 0.0)
    body = g.mix(fine, (0.03, 0.022, 0.018), (0.10, 0.07, 0.055))
    holes = g.use(pits, uv, 150.0, 0.22)
    color = g.mix(bare, milk, body)
    color = g.mix(holes * 0.7, color, (0.06, 0.045, 0.035))
    blue = g.wave(uv, 14.0, 7.0, 3.0, "Y", kind="RINGS")
    blush = g.remap(blue, 0.7, 1.0) * g.remap(broad, 0.5, 0.65)
    color = g.mix(blush * 0.3, color, (0.48, 0.42, 0.40))
    rough = g.mix_value(bare, g.use(smudges, uv, 24.0, 0.16, 0.2), 0.9)
    height = mixed * 0.5 - lines * 0.3 - holes * 0.8 - bare * 0.5 + cells * 0.08
    normal = g.bump(fine, 0.1, 0.0006, g.bump(height, 0.4, 0.002))
    return g.principled(base_color=color, roughness=rough, normal=normal, coat_weight=g.mix_value(bare, 0.3, 0.0), coat_roughness=0.08)


@material("Brushed Copper")
def copper(g):
    """Turned copper: brush lines round the body, heat tint, tarnish, dents."""
    uv = g.uv()
    x, y, _ = g.separate(uv)
    brush = g.noise(g.place(uv, (3.0, 900.0, 1.0)), 1.0, 4.0, 0.6)
    brush_wide = g.noise(g.place(uv, (1.2, 160.0, 1.0)), 1.0, 3.0, 0.6)
    grain = brush * 0.6 + brush_wide * 0.4
    broad, fine, mixed = g.use(cloudy, uv, 8.0)
    base = g.mix(g.remap(grain, 0.35, 0.65), (0.80, 0.38, 0.22), (0.96, 0.62, 0.45))
    heat = g.remap(y + (broad - 0.5) * 0.12, 0.10, 0.0, smooth=True)
    tint = g.ramp(heat, [(0.0, (0.95, 0.60, 0.42)), (0.4, (0.88, 0.42, 0.20)), (0.7, (0.55, 0.22, 0.25)), (1.0, (0.22, 0.14, 0.16))])
    base = g.mix(0.55, base, tint, "MULTIPLY")
    base = g.mix(0.5, base, tint)
    tarnish = g.use(grime, uv, 6.0, 0.42)
    base = g.mix(tarnish * 0.55, base, (0.30, 0.13, 0.07))
    green = g.use(grime, g.place(uv, 1.0, 0.4, (7.0, 3.0, 0)), 13.0, 0.1)
    green = green * g.remap(fine, 0.45, 0.65)
    base = g.mix(green * 0.8, base, (0.13, 0.34, 0.27))
    lines = g.use(scratches, uv, 28.0, 0.5)
    rough = g.use(smudges, uv, 14.0, 0.2, 0.18) + g.remap(grain, 0.3, 0.7, -0.06, 0.08) + tarnish * 0.15
    rough = g.mix_value(green, rough, 0.85) - lines * 0.1
    hammer = g.voronoi(uv, 38.0, "SMOOTH_F1")
    normal = g.bump(grain, 0.12, 0.0008, g.bump(hammer, 0.2, 0.003))
    return g.principled(base_color=base, metallic=1.0 - green, roughness=rough, normal=normal)


@material("Rusted Iron")
def iron(g):
    """Cast iron, black where it is handled, rust elsewhere."""
    uv = g.uv()
    color, mask, height = g.use(rust, uv, 11.0, 0.47)
    broad, fine, mixed = g.use(cloudy, uv, 20.0)
    bare = g.ramp(mixed, [(0.3, (0.035, 0.033, 0.034)), (0.6, (0.085, 0.08, 0.08)), (0.8, (0.16, 0.15, 0.15))])
    cast = g.noise(uv, 240.0, 3.0, 0.65)
    streak = g.remap(g.noise(g.place(uv, (60.0, 5.0, 1.0)), 1.0, 4.0), 0.52, 0.66)
    color = g.mix(streak * 0.5, color, (0.46, 0.17, 0.04))
    lines = g.use(scratches, uv, 30.0, 0.6)
    shown = g.math("MAXIMUM", 0.0, mask - lines * 0.6)
    whole = g.mix(shown, bare, color)
    dust = g.use(grime, uv, 8.0, 0.2)
    whole = g.mix(dust * 0.15, whole, (0.4, 0.33, 0.26))
    rough = g.mix_value(shown, g.use(smudges, uv, 18.0, 0.3, 0.2), 0.9)
    relief = height * shown + cast * 0.35
    normal = g.bump(relief, 0.5, 0.002)
    return g.principled(base_color=whole, metallic=1.0 - shown, roughness=rough, normal=normal)


@material("Garden Terracotta")
def flower_pot(g):
    """Unglazed pot: lime bloom, moss at the foot, thrown rings."""
    uv = g.uv()
    x, y, _ = g.separate(uv)
    broad, fine, mixed = g.use(cloudy, uv, 12.0)
    clay = g.ramp(mixed, [(0.3, (0.30, 0.10, 0.05)), (0.55, (0.44, 0.17, 0.085)), (0.75, (0.54, 0.25, 0.14))])
    lime = g.use(grime, uv, 9.0, 0.45)
    clay = g.mix(lime * 0.5, clay, (0.70, 0.60, 0.50))
    wet = g.remap(y + (broad - 0.5) * 0.14, 0.075, 0.02, smooth=True)
    clay = g.mix(wet * 0.5, clay, (0.30, 0.16, 0.10), "MULTIPLY")
    moss = wet * g.remap(g.noise(uv, 46.0, 5.0, 0.7), 0.48, 0.58)
    tufts = g.noise(uv, 420.0, 3.0)
    clay = g.mix(moss, clay, g.mix(tufts, (0.035, 0.07, 0.015), (0.13, 0.19, 0.04)))
    rings = g.wave(g.place(uv, (1.0, 50.0, 1.0)), 1.0, 0.8, 2.0, "Y")
    grit = g.use(pits, uv, 300.0, 0.2)
    clay = g.mix(grit * 0.4, clay, (0.2, 0.1, 0.06))
    lines, _ = g.use(crackle, uv, 14.0, 0.006)
    clay = g.mix(lines * lime * 0.25, clay, (0.15, 0.06, 0.04))
    height = rings * 0.2 + fine * 0.3 + moss * tufts - grit * 0.4
    normal = g.bump(height, 0.5, 0.002)
    return g.principled(base_color=clay, roughness=g.mix_value(wet, 0.9, 0.6), normal=normal)
