"""PNG and OpenEXR files of pixels that exist only in Blender's memory."""

import struct
import zlib

import numpy as np


def png(pixels):
    """(height, width, 4) bytes, top row first, as a PNG file."""
    height, width, _ = pixels.shape
    rows = np.zeros((height, 1 + 4 * width), dtype=np.uint8)
    rows[:, 1:] = pixels.reshape(height, 4 * width)

    def chunk(kind, data):
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))

    head = struct.pack(">IIBBBBB", width, height, 8, 6, 0, 0, 0)
    body = zlib.compress(rows.tobytes(), 6)
    return b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", head) + chunk(b"IDAT", body) + chunk(b"IEND", b"")


def exr(pixels):
    """(height, width, 4) floats, top row first, as an uncompressed scan-line OpenEXR file."""
    height, width, _ = pixels.shape

    def attribute(name, kind, data):
        return name + b"\0" + kind + b"\0" + struct.pack("<I", len(data)) + data

    # Channels are stored in alphabetical order; 2 is the 32-bit float type.
    channels = b"".join(name + b"\0" + struct.pack("<IIII", 2, 0, 1, 1) for name in (b"A", b"B", b"G", b"R"))
    window = struct.pack("<iiii", 0, 0, width - 1, height - 1)
    head = struct.pack("<II", 20000630, 2)
    head += attribute(b"channels", b"chlist", channels + b"\0")
    head += attribute(b"compression", b"compression", b"\0")
    head += attribute(b"dataWindow", b"box2i", window)
    head += attribute(b"displayWindow", b"box2i", window)
    head += attribute(b"lineOrder", b"lineOrder", b"\0")
    head += attribute(b"pixelAspectRatio", b"float", struct.pack("<f", 1.0))
    head += attribute(b"screenWindowCenter", b"v2f", struct.pack("<ff", 0.0, 0.0))
    head += attribute(b"screenWindowWidth", b"float", struct.pack("<f", 1.0)) + b"\0"

    line = 16 * width
    first = len(head) + 8 * height
    offsets = first + np.arange(height, dtype="<u8") * (8 + line)
    body = np.empty((height, 2 + 4 * width), dtype="<u4")
    body[:, 0] = np.arange(height)
    body[:, 1] = line
    planes = np.ascontiguousarray(pixels[:, :, [3, 2, 1, 0]].transpose(0, 2, 1), dtype="<f4")
    body[:, 2:] = planes.reshape(height, 4 * width).view("<u4")
    return head + offsets.tobytes() + body.tobytes()
