"""Images: the bytes of their files, wherever Blender keeps them."""

import os

import bpy
import numpy as np

from . import encode

# What a glTF image may hold; all else travels in a buffer view of our own.
STANDARD = {"image/png", "image/jpeg"}


class Images:
    """All images of the file, in the order of `MATCHA_cycles.images`."""

    def __init__(self, glb, report):
        self.glb = glb
        self.report = report
        self.entries = []
        self._known = {}
        self._gltf_images = {}

    def add(self, image, image_user, warn):
        """Stores an image data-block once; returns its index."""
        key = image.original.as_pointer()
        if key not in self._known:
            self._known[key] = len(self.entries)
            self.entries.append(self._entry(image, image_user, warn))
        return self._known[key]

    def _entry(self, image, image_user, warn):
        entry = {
            "name": image.name,
            "colorspace": image.colorspace_settings.name,
            "alpha_mode": image.alpha_mode,
        }
        if image.source in {"SEQUENCE", "MOVIE", "TILED"}:
            warn(f"image {image.name} is a {image.source.lower()} image; its first picture is used")
        data = contents(image, image_user)
        mime = media_type(data) if data else None
        if mime is None:
            found = "cannot be found" if not data else "has an unknown format"
            warn(f"image {image.name} ({image.filepath or image.source.lower()}) {found}")
            entry["missing"] = True
            return entry
        entry["mime"] = mime
        entry["alpha_mode"] = alpha_mode(image, mime, warn)
        if mime in STANDARD:
            entry["source"] = self._standard(data, mime, image.name)
        else:
            entry["bufferView"] = self.glb.view(data)
        return entry

    def _standard(self, data, mime, name):
        view = self.glb.view(data)
        if view not in self._gltf_images:
            image = {"bufferView": view, "mimeType": mime, "name": name}
            self._gltf_images[view] = self.glb.append("images", image)
        return self._gltf_images[view]


def is_packed(image):
    return image.packed_file is not None or any(packed.packed_file for packed in image.packed_files)


def alpha_mode(image, mime, warn):
    """How Cycles takes the picture's alpha.

    It reads WebP files as if their colour were multiplied by alpha, whatever the image says; packed
    ones come from Blender.
    """
    if mime != "image/webp" or image.alpha_mode not in {"STRAIGHT", "PREMUL"}:
        return image.alpha_mode
    if not is_packed(image):
        return "PREMUL"
    if image.alpha_mode == "PREMUL":
        warn(f"image {image.name} is a packed WebP with premultiplied alpha; straight alpha is used")
    return "STRAIGHT"


def contents(image, image_user):
    """The bytes of the image's file, or of one made from its pixels; None where it is missing."""
    if image.source in {"GENERATED", "VIEWER"} or image.is_dirty:
        return from_pixels(image)
    if image.packed_file is not None:
        return bytes(image.packed_file.data)
    for packed in image.packed_files:
        if packed.packed_file is not None:
            return bytes(packed.packed_file.data)
    for path in candidate_paths(image, image_user):
        try:
            with open(path, "rb") as file:
                return file.read()
        except OSError:
            continue
    return from_pixels(image) if image.has_data else None


def candidate_paths(image, image_user):
    """Absolute paths under which the file may lie."""
    paths = []
    if image.source == "TILED" and len(image.tiles):
        number = image.tiles[0].number
        u, v = (number - 1001) % 10 + 1, (number - 1001) // 10 + 1
        tile = image.filepath.replace("<UDIM>", str(number)).replace("<UVTILE>", f"u{u}_v{v}")
        paths.append(tile)
    elif image_user is not None:
        paths.append(image.filepath_from_user(image_user=image_user))
    paths.append(image.filepath)
    library = image.original.library
    absolute = [bpy.path.abspath(path.replace("\\", "/"), library=library) for path in paths if path]
    return [os.path.normpath(path) for path in absolute]


def from_pixels(image):
    """A PNG of an 8-bit image, an OpenEXR of a float one."""
    width, height = image.size
    if not width or not height or not image.channels:
        return None
    flat = np.empty(width * height * image.channels, dtype=np.float32)
    image.pixels.foreach_get(flat)
    pixels = np.ones((height, width, 4), dtype=np.float32)
    got = flat.reshape(height, width, image.channels)[::-1]
    pixels[:, :, : image.channels] = got
    if image.channels < 3:
        pixels[:, :, :3] = got[:, :, :1]
    if image.is_float:
        return encode.exr(pixels)
    return encode.png(np.rint(np.clip(pixels, 0.0, 1.0) * 255.0).astype(np.uint8))


def media_type(data):
    """The format by its first bytes; None where it is none that a renderer would read."""
    if data.startswith(b"\x89PNG\r\n\x1a\n"):
        return "image/png"
    if data.startswith(b"\xff\xd8\xff"):
        return "image/jpeg"
    if data.startswith(b"\x76\x2f\x31\x01"):
        return "image/x-exr"
    if data.startswith((b"#?RADIANCE", b"#?RGBE")):
        return "image/vnd.radiance"
    if data.startswith((b"II*\0", b"MM\0*")):
        return "image/tiff"
    if data[:4] == b"RIFF" and data[8:12] == b"WEBP":
        return "image/webp"
    if data.startswith(b"BM"):
        return "image/bmp"
    if data.startswith(b"DDS "):
        return "image/vnd-ms.dds"
    if looks_like_targa(data):
        return "image/x-tga"
    return None


def looks_like_targa(data):
    """Targa has no magic number; its header's fields have few legal values."""
    return len(data) > 18 and data[1] <= 1 and data[2] in {1, 2, 3, 9, 10, 11} and data[16] in {8, 16, 24, 32}
