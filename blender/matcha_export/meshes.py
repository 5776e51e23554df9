"""glTF meshes, each evaluated mesh once."""

import json

from . import geometry
from .glb import ELEMENT_ARRAY_BUFFER
from .numbers import numbers


class Meshes:
    """Meshes by data-block and slots; equal content is stored once."""

    def __init__(self, glb, materials, report):
        self.glb = glb
        self.materials = materials
        self.report = report
        self._known = {}
        self._by_content = {}

    def add(self, mesh, slots, groups):
        """Index of a glTF mesh, or None where there is nothing to see.

        `slots` are the material indices of the mesh's own slots, `groups` the names of its vertex groups.
        """
        key = (mesh.as_pointer(), slots)
        if key not in self._known:
            self._known[key] = self._store(mesh, slots, groups)
        return self._known[key]

    def _store(self, mesh, slots, groups):
        def warn(text):
            self.report.warning(f"mesh {mesh.name}: {text}")

        needs = self.materials.needs(slots)
        parts = geometry.extract(mesh, len(slots), needs, groups, warn)
        if parts is None:
            return None
        semantics, about = self._accessors(parts)
        origin, size = geometry.texture_space(mesh)
        about |= {
            "generated_origin": numbers(origin),
            "generated_size": numbers(size),
            "active_uv": active_uv(mesh),
            "active_color": geometry.render_color(mesh),
            "material_slots": list(slots),
        }
        primitives = [
            {
                "attributes": semantics,
                "indices": self.glb.accessor(indices, ELEMENT_ARRAY_BUFFER),
                "material": slots[slot],
                "extensions": {"MATCHA_cycles": {"slot": slot}},
            }
            for slot, indices in parts.triangles
        ]
        return self._unique({"name": mesh.name, "primitives": primitives, "extensions": {"MATCHA_cycles": about}})

    def _unique(self, entry):
        # Equal arrays share an accessor, so equal entries are equal meshes, whatever their names.
        key = json.dumps([entry["primitives"], entry["extensions"]], sort_keys=True)
        if key not in self._by_content:
            self._by_content[key] = self.glb.append("meshes", entry)
        return self._by_content[key]

    def _accessors(self, parts):
        glb = self.glb
        semantics = {
            "POSITION": glb.accessor(parts.positions, bounds=True),
            "NORMAL": glb.accessor(parts.normals),
        }
        about = {"uv": [], "attributes": []}
        for i, (name, array) in enumerate(parts.uvs):
            semantics[f"TEXCOORD_{i}"] = glb.accessor(array)
            about["uv"].append({"name": name, "semantic": f"TEXCOORD_{i}"})
        for i, (name, kind, array) in enumerate(parts.extras):
            semantics[f"_ATTRIBUTE_{i}"] = glb.accessor(array)
            about["attributes"].append({"name": name, "semantic": f"_ATTRIBUTE_{i}", "kind": kind})
        if parts.generated is not None:
            semantics["_GENERATED"] = glb.accessor(parts.generated)
            about["generated"] = "_GENERATED"
        if parts.islands is not None:
            semantics["_ISLAND"] = glb.accessor(parts.islands)
            about["island"] = "_ISLAND"
        return semantics, about


def active_uv(mesh):
    """Position of the UV layer that is rendered where a node names none."""
    return next((i for i, layer in enumerate(mesh.uv_layers) if layer.active_render), 0)
