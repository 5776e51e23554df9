"""Materials: their node trees, and what Cycles does where there is none."""

from . import fallback
from .numbers import number
from .trees import Needs, tree_in_use


class Materials:
    """All materials of the file, in glTF's order."""

    def __init__(self, glb, trees, images, report):
        self.glb = glb
        self.trees = trees
        self.images = images
        self.report = report
        self._known = {}
        self._needs = {}
        self._default = None

    def add(self, material):
        """Stores a material once; None is Cycles' default surface. Returns its index."""
        if material is None:
            if self._default is None:
                self._default = self._store_plain("Default Surface", (0.8, 0.8, 0.8, 1.0), {})
            return self._default
        key = material.original.as_pointer()
        if key not in self._known:
            self._known[key] = self._store(material)
        return self._known[key]

    def needs(self, indices):
        """What the materials together read from a mesh."""
        total = Needs()
        for index in indices:
            total.include(self._needs[index])
        return total

    def _store(self, material):
        # Blender 4.1 moved this out of Cycles' settings.
        owner = material if hasattr(material, "displacement_method") else material.cycles
        displacement = owner.displacement_method
        if displacement != "BUMP":
            self.report.warning(f"{material.name}: displacement is rendered as bump")
        about = {
            "pass_index": int(material.pass_index),
            "emission_sampling": material.cycles.emission_sampling,
            "displacement_method": displacement,
            "use_backface_culling": bool(material.use_backface_culling),
            "use_transparent_shadow": bool(getattr(material, "use_transparent_shadow", True)),
            "use_bump_map_correction": bool(
                getattr(material, "use_bump_map_correction", True)
            ),
        }
        node_tree = tree_in_use(material)
        if node_tree is None:
            return self._store_plain(material.name, material.diffuse_color, about)
        tree = self.trees.add(node_tree, material.name)
        looks = fallback.material(material, self.images, self.glb)
        return self._append(material.name, looks, {"tree": tree, **about}, self.trees.needs[tree])

    def _store_plain(self, name, color, about):
        tree = self.trees.add_built(diffuse_tree(name, color))
        looks = fallback.plain(color)
        return self._append(name, looks, {"tree": tree, **about}, Needs())

    def _append(self, name, looks, extension, needs):
        entry = {"name": name, **looks}
        entry.setdefault("extensions", {})["MATCHA_cycles"] = extension
        index = self.glb.append("materials", entry)
        self._needs[index] = needs
        return index


def diffuse_tree(name, color):
    """The tree that Cycles puts in place of a missing one."""
    rgba = [number(c) for c in color[:3]] + [1.0]
    diffuse = {
        "name": "Diffuse BSDF",
        "type": "ShaderNodeBsdfDiffuse",
        "inputs": [
            {"identifier": "Color", "name": "Color", "type": "RGBA", "value": rgba},
            {"identifier": "Roughness", "name": "Roughness", "type": "VALUE", "value": [0.0]},
            {"identifier": "Normal", "name": "Normal", "type": "VECTOR", "value": [0.0, 0.0, 0.0], "hide_value": True},
        ],
        "outputs": [{"identifier": "BSDF", "name": "BSDF", "type": "SHADER"}],
    }
    output = {
        "name": "Material Output",
        "type": "ShaderNodeOutputMaterial",
        "props": {"is_active_output": True, "target": "ALL"},
        "inputs": [{"identifier": "Surface", "name": "Surface", "type": "SHADER"}],
    }
    links = [{"from": [0, 0], "to": [1, 0]}]
    return {"name": name, "nodes": [diffuse, output], "links": links}
