"""Pictures that the script draws: arrays of linear or sRGB values, packed as PNG."""

import bpy
import numpy as np


def packed(name, pixels, data=False):
    """An image of an array (rows from the bottom, columns, 1 or 3 channels, 0 to 1)."""
    found = bpy.data.images.get(name)
    if found:
        return found
    pixels = np.asarray(pixels() if callable(pixels) else pixels, np.float32)
    if pixels.ndim == 2:
        pixels = np.repeat(pixels[:, :, None], 3, axis=2)
    height, width = pixels.shape[:2]
    image = bpy.data.images.new(name, width, height, alpha=False)
    image.colorspace_settings.name = "Non-Color" if data else "sRGB"
    full = np.ones((height, width, 4), np.float32)
    full[:, :, :3] = np.clip(np.round(pixels * 63) / 63 if data else pixels, 0, 1)
    image.pixels.foreach_set(full.ravel())
    image.file_format = "PNG"
    image.pack()
    return image


def plane(width, height):
    """x and y of the pixels' centres, 0 to 1."""
    return np.meshgrid((np.arange(width) + 0.5) / width, (np.arange(height) + 0.5) / height)


def periodic_noise(width, height, cells, seed):
    """Smooth noise that tiles: random values on a grid, interpolated by a cosine."""
    grid = np.random.default_rng(seed).random((cells[1], cells[0]))
    x, y = plane(width, height)
    x, y = x * cells[0], y * cells[1]
    i, j = np.floor(x).astype(int), np.floor(y).astype(int)
    a, b = (0.5 - 0.5 * np.cos(np.pi * (v - np.floor(v))) for v in (x, y))
    at = lambda di, dj: grid[(j + dj) % cells[1], (i + di) % cells[0]]
    return (at(0, 0) * (1 - a) + at(1, 0) * a) * (1 - b) + (at(0, 1) * (1 - a) + at(1, 1) * a) * b


def stroke(x, y, points, widths):
    """Ink of a brush stroke along a polyline, width in picture heights at each point."""
    ink = np.zeros_like(x)
    for (p, q), (w0, w1) in zip(zip(points, points[1:]), zip(widths, widths[1:])):
        dx, dy = q[0] - p[0], q[1] - p[1]
        t = np.clip(((x - p[0]) * dx + (y - p[1]) * dy) / (dx * dx + dy * dy), 0, 1)
        distance = np.hypot(x - p[0] - t * dx, y - p[1] - t * dy)
        ink = np.maximum(ink, np.clip((w0 + (w1 - w0) * t - distance) / 0.006, 0, 1))
    return ink


def calligraphy():
    """The character for tea, written with a brush, over a red seal."""
    x, y = plane(256, 512)
    y = y * 2.0
    rough = periodic_noise(256, 512, (64, 128), 3) * 0.012 + periodic_noise(256, 512, (6, 12), 4) * 0.02
    bx, by = x + rough - 0.016, y + rough[::-1] - 0.016
    ink = np.zeros_like(x)
    strokes = [
        ([(0.16, 1.50), (0.5, 1.53), (0.86, 1.56)], [0.022, 0.016, 0.028]),
        ([(0.36, 1.66), (0.38, 1.53), (0.36, 1.42)], [0.030, 0.022, 0.010]),
        ([(0.66, 1.70), (0.62, 1.55), (0.58, 1.42)], [0.030, 0.022, 0.008]),
        ([(0.52, 1.40), (0.36, 1.20), (0.12, 1.04)], [0.030, 0.026, 0.006]),
        ([(0.50, 1.36), (0.68, 1.16), (0.92, 1.06)], [0.012, 0.032, 0.036]),
        ([(0.30, 1.03), (0.52, 1.05), (0.74, 1.07)], [0.020, 0.015, 0.024]),
        ([(0.53, 1.20), (0.53, 0.90), (0.52, 0.68), (0.44, 0.74)], [0.026, 0.024, 0.030, 0.006]),
        ([(0.40, 0.94), (0.32, 0.84), (0.22, 0.78)], [0.010, 0.026, 0.006]),
        ([(0.66, 0.94), (0.74, 0.84), (0.82, 0.76)], [0.010, 0.028, 0.022]),
    ]
    for points, widths in strokes:
        ink = np.maximum(ink, stroke(bx, by, points, widths))
    ink *= 0.82 + 0.18 * periodic_noise(256, 512, (90, 20), 5)
    paper = np.stack([np.full_like(x, v) for v in (0.90, 0.86, 0.76)], axis=2)
    picture = paper * (1 - ink[:, :, None]) + np.array([0.07, 0.06, 0.07]) * ink[:, :, None]
    seal = (np.abs(x - 0.70) < 0.09) & (np.abs(y - 0.42) < 0.09)
    marks = (np.abs(x - 0.70) < 0.012) | (np.abs(np.abs(y - 0.42) - 0.045) < 0.011)
    seal = (seal & ~(marks & (np.abs(x - 0.70) < 0.07) & (np.abs(y - 0.42) < 0.07)))[:, :, None]
    return np.where(seal, np.array([0.66, 0.13, 0.10]), picture)


def tile_motif():
    """One painted tile: an eight-pointed star in a ring of petals, blue and ochre on white."""
    x, y = plane(256, 256)
    x, y = x * 2 - 1, y * 2 - 1
    angle, radius = np.arctan2(y, x), np.hypot(x, y)
    soft = lambda d: np.clip(d / 0.025 + 0.5, 0, 1)
    picture = np.ones((256, 256, 3)) * np.array([0.87, 0.87, 0.82])

    def paint(mask, color):
        nonlocal picture
        picture = picture * (1 - mask[:, :, None]) + np.array(color) * mask[:, :, None]

    blue, light, ochre = (0.10, 0.22, 0.45), (0.42, 0.62, 0.72), (0.80, 0.58, 0.22)
    corner = np.hypot(np.abs(x) - 1, np.abs(y) - 1)
    paint(soft(0.42 - corner), blue)
    paint(soft(0.34 - corner), (0.87, 0.87, 0.82))
    paint(soft(0.22 - corner), ochre)
    paint(soft(0.60 + 0.17 * np.cos(angle * 8) - radius), blue)
    paint(soft(0.50 + 0.15 * np.cos(angle * 8) - radius), light)
    paint(soft(0.33 + 0.07 * np.cos(angle * 8 + np.pi) - radius), (0.87, 0.87, 0.82))
    paint(soft(0.20 - radius), ochre)
    paint(soft(0.09 - radius), blue)
    brush = periodic_noise(256, 256, (40, 40), 8)[:, :, None]
    return picture * (0.93 + 0.07 * brush)


def wood_scan():
    """Grain as a scanner sees it: streaks along x, with rays and darker rings."""
    streaks = sum(periodic_noise(256, 256, (3 + n, 16 << n), 20 + n) / (1.5**n) for n in range(4)) / 2.6
    x, y = plane(256, 256)
    wander = periodic_noise(256, 256, (2, 3), 30) * 0.18
    rings = 0.5 + 0.5 * np.sin(2 * np.pi * (y + wander) * 9)
    return np.clip(0.62 * streaks + 0.3 * rings**2 + 0.05, 0, 1)


def scratch_map():
    """Hairlines and a few arcs on black."""
    random = np.random.default_rng(12)
    x, y = plane(256, 256)
    picture = np.zeros_like(x)
    for _ in range(70):
        cx, cy, turn = random.random(2).tolist() + [random.normal(0.2, 0.7)]
        dx, dy = (x - cx + 0.5) % 1 - 0.5, (y - cy + 0.5) % 1 - 0.5
        along, across = dx * np.cos(turn) + dy * np.sin(turn), dy * np.cos(turn) - dx * np.sin(turn)
        across += random.normal(0, 0.6) * along**2
        length = random.uniform(0.04, 0.3)
        line = np.clip(1.2 - np.abs(across) * 256, 0, 1) * np.clip((length - np.abs(along)) * 20, 0, 1)
        picture = np.maximum(picture, line * random.uniform(0.3, 1))
    return picture


def wave_crest():
    """Overlapping rings of sea waves, as on old lacquer: gold is white."""
    x, y = plane(256, 256)
    picture = np.zeros_like(x)
    covered = np.zeros_like(x, bool)
    for row in range(-2, 7):
        for column in range(-1, 4):
            cx, cy = (column + 0.5 * (row % 2)) / 2.0, row / 4.0
            radius = np.hypot(x - cx, y - cy) * 4.0
            inside = (radius < 1.0) & ~covered
            ring = np.clip(1.6 - np.abs((radius * 4.0 + 0.5) % 1.0 - 0.5) * 9.0, 0, 1)
            picture = np.where(inside, ring, picture)
            covered |= inside
    return picture


def runner_border():
    """Indigo cloth pattern with stitched diamonds: white is the undyed thread."""
    x, y = plane(256, 256)
    u, v = (x * 4) % 1 - 0.5, (y * 4) % 1 - 0.5
    diamond = np.abs(u) + np.abs(v)
    lines = (np.abs(diamond - 0.44) < 0.035) | (np.abs(diamond - 0.28) < 0.03) | (diamond < 0.1)
    stitch = ((x * 64) % 1 < 0.72) & ((y * 64) % 1 < 0.86)
    return np.where(lines & stitch, 1.0, 0.0)


def book_label():
    """A cover's printed label: frame, a mountain, a sun and lines of text."""
    x, y = plane(256, 256)
    picture = np.ones((256, 256, 3)) * np.array([0.86, 0.80, 0.66])
    frame = np.maximum(np.abs(x - 0.5), np.abs(y - 0.5))
    picture[np.abs(frame - 0.45) < 0.008] = (0.30, 0.16, 0.10)
    picture[np.abs(frame - 0.42) < 0.004] = (0.30, 0.16, 0.10)
    picture[np.hypot(x - 0.62, y - 0.68) < 0.10] = (0.72, 0.22, 0.12)
    ridge = 0.44 + 0.28 * np.exp(-((x - 0.42) / 0.16) ** 2) + 0.02 * np.sin(x * 60)
    mountain = (y < ridge) & (y > 0.34) & (frame < 0.40)
    picture[mountain] = (0.20, 0.30, 0.36)
    picture[mountain & (y > ridge - 0.05) & (x > 0.28) & (x < 0.56)] = (0.88, 0.86, 0.80)
    for line, width in ((0.27, 0.26), (0.21, 0.18), (0.16, 0.22)):
        picture[(np.abs(y - line) < 0.012) & (np.abs(x - 0.5) < width) & ((x * 37 + line * 9) % 1 > 0.2)] = (0.2, 0.12, 0.1)
    return picture


def garden():
    """What the window looks at: hazy trees under an evening sky."""
    x, y = plane(512, 256)
    cloud = sum(periodic_noise(512, 256, (6 << n, 3 << n), 40 + n) / 2**n for n in range(5)) / 1.94
    leaves = periodic_noise(512, 256, (128, 64), 60) * 0.6 + periodic_noise(512, 256, (256, 128), 61) * 0.4
    top = 0.50 + 0.42 * (cloud - 0.5) + 0.05 * leaves
    sky = np.stack([0.98 - 0.12 * y, 0.92 - 0.06 * y, 0.82 + 0.1 * y], axis=2)
    far = np.array([0.64, 0.70, 0.55]) * (0.8 + 0.3 * cloud[:, :, None])
    near = np.array([0.42, 0.47, 0.27]) * (0.5 + 0.8 * leaves[:, :, None])
    mix = lambda a, b, m: a * (1 - m[:, :, None]) + b * m[:, :, None]
    picture = mix(sky, far, np.clip((top - y) / 0.03, 0, 1))
    second = 0.30 + 0.4 * (cloud[:, ::-1] - 0.5) + 0.05 * leaves
    return mix(picture, near, np.clip((second - y) / 0.02, 0, 1))
