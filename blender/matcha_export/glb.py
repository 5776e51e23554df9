"""The GLB container: one JSON chunk and one binary chunk (glTF 2.0, section 4)."""

import hashlib
import json
import os
import struct

import numpy as np

from .report import ExportError

COMPONENT = {"float32": 5126, "uint32": 5125, "uint16": 5123, "uint8": 5121}
SHAPE = {1: "SCALAR", 2: "VEC2", 3: "VEC3", 4: "VEC4", 16: "MAT4"}
ARRAY_BUFFER = 34962
ELEMENT_ARRAY_BUFFER = 34963
LIMIT = 2**32 - 1


class Glb:
    """Gathers a glTF document and its binary chunk, then writes both."""

    def __init__(self, generator):
        self.root = {"asset": {"version": "2.0", "generator": generator}}
        self._chunks = []
        self._size = 0
        self._known = {}

    def append(self, name, entry):
        """Adds an object to a top-level array and returns its index."""
        entries = self.root.setdefault(name, [])
        entries.append(entry)
        return len(entries) - 1

    def use(self, extension):
        """Lists an extension under `extensionsUsed`."""
        used = self.root.setdefault("extensionsUsed", [])
        if extension not in used:
            used.append(extension)

    def view(self, data):
        """Stores bytes that no accessor describes, equal ones once; returns the view's index."""
        data = bytes(data)
        return self._once(("view", digest(data)), lambda: self._append_view(data, None))

    def accessor(self, array, target=ARRAY_BUFFER, bounds=False):
        """Stores an (n,) or (n, components) array, equal ones once; returns the accessor's index."""
        array = np.ascontiguousarray(array)
        data = array.tobytes()
        # Bounds are part of the key: an accessor has a buffer view of its own, since views that
        # several accessors share need a stride.
        key = (digest(data), array.dtype.name, array.shape, target, bounds)
        return self._once(key, lambda: self._append_accessor(array, data, target, bounds))

    def _once(self, key, append):
        if key not in self._known:
            self._known[key] = append()
        return self._known[key]

    def _append_view(self, data, target):
        entry = {"buffer": 0, "byteOffset": self._size, "byteLength": len(data)}
        if target is not None:
            entry["target"] = target
        padding = -len(data) % 4
        self._chunks.append(data + b"\0" * padding)
        self._size += len(data) + padding
        return self.append("bufferViews", entry)

    def _append_accessor(self, array, data, target, bounds):
        width = 1 if array.ndim == 1 else array.shape[1]
        entry = {
            "bufferView": self._append_view(data, target),
            "componentType": COMPONENT[array.dtype.name],
            "count": int(array.shape[0]),
            "type": SHAPE[width],
        }
        if bounds:
            rows = array.reshape(-1, width)
            entry["min"] = [x.item() for x in rows.min(axis=0)]
            entry["max"] = [x.item() for x in rows.max(axis=0)]
        return self.append("accessors", entry)

    def write(self, path):
        """Writes beside `path` and renames, so that no half-written file is ever seen."""
        if self._size:
            self.root["buffers"] = [{"byteLength": self._size}]
        text = json.dumps(self.root, separators=(",", ":"), ensure_ascii=False, allow_nan=False)
        head = text.encode("utf-8", "replace")
        head += b" " * (-len(head) % 4)
        total = 12 + 8 + len(head) + (8 + self._size if self._size else 0)
        if total > LIMIT:
            raise ExportError(f"{path}: the scene needs {total} bytes, more than a GLB can hold.")
        beside = f"{path}.{os.getpid()}.part"
        try:
            with open(beside, "wb") as file:
                file.write(struct.pack("<4sII", b"glTF", 2, total))
                file.write(struct.pack("<I4s", len(head), b"JSON"))
                file.write(head)
                if self._size:
                    file.write(struct.pack("<I4s", self._size, b"BIN\0"))
                    file.writelines(self._chunks)
            os.replace(beside, path)
        except OSError as error:
            if os.path.exists(beside):
                os.remove(beside)
            raise ExportError(f"{path}: cannot be written ({error.strerror}).") from error
        return total


def digest(data):
    """Identifies bytes."""
    return hashlib.blake2b(data, digest_size=16).digest()
