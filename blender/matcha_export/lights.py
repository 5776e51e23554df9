"""Light objects: Cycles' own description, and KHR_lights_punctual where there is one."""

import math

import numpy as np

from . import axes, visibility
from .numbers import number, numbers
from .trees import tree_in_use

PUNCTUAL = "KHR_lights_punctual"
# Lumens of a watt at 555 nm, as glTF exporters agree on; glTF counts candela and lux.
LUMENS = 683.0


class Lights:
    """Light nodes and the punctual lights that they point at."""

    def __init__(self, glb, trees, report):
        self.glb = glb
        self.trees = trees
        self.report = report
        self._trees = {}

    def node(self, instance):
        """Appends the light's node; returns its index."""
        obj = instance.object
        light = obj.data
        matrix = np.array(instance.matrix_world, dtype=np.float64)
        chain = axes.node_chain(axes.aim(matrix))
        node = {**chain[-1], "name": obj.name, "extensions": {"MATCHA_cycles": {"light": self._about(instance)}}}
        if light.type in {"POINT", "SPOT", "SUN"}:
            self.glb.use(PUNCTUAL)
            lights = self.glb.root.setdefault("extensions", {}).setdefault(PUNCTUAL, {"lights": []})["lights"]
            lights.append(punctual(light))
            node["extensions"][PUNCTUAL] = {"light": len(lights) - 1}
        index = self.glb.append("nodes", node)
        if len(chain) == 2:
            index = self.glb.append("nodes", {"name": obj.name, **chain[0], "children": [index]})
        return index

    def _about(self, instance):
        obj = instance.object
        light = obj.data
        cycles = light.cycles
        entry = {
            "name": obj.name,
            "type": light.type,
            "energy": number(light.energy),
            "color": numbers(color(light)),
            "exposure": number(getattr(light, "exposure", 0.0)),
            "normalize": bool(getattr(light, "normalize", True)),
            "cast_shadow": casts_shadow(light),
            "use_mis": bool(cycles.use_multiple_importance_sampling),
            "max_bounces": int(cycles.max_bounces),
            "visibility": visibility.of_object(obj),
            "random": visibility.random(instance),
            "pass_index": int(obj.pass_index),
        }
        entry |= shape(light)
        if getattr(cycles, "is_portal", False):
            entry["portal"] = True
            self.report.warning(f"light {obj.name}: portals are left out")
        if tree_in_use(light) is not None:
            entry["tree"] = self._tree(light)
        return entry

    def _tree(self, light):
        key = light.original.as_pointer()
        if key not in self._trees:
            self._trees[key] = self.trees.add(light.node_tree, light.name)
        return self._trees[key]


def shape(light):
    """Geometry of the light, lengths before the node's scale."""
    if light.type == "SUN":
        return {"angle": number(light.angle)}
    if light.type == "AREA":
        square = light.shape in {"SQUARE", "DISK"}
        return {
            "shape": light.shape,
            "size": numbers((light.size, light.size if square else light.size_y)),
            "spread": number(light.spread),
        }
    entry = {"radius": number(light.shadow_soft_size), "soft_falloff": bool(getattr(light, "use_soft_falloff", True))}
    if light.type == "SPOT":
        entry |= {"angle": number(light.spot_size), "blend": number(light.spot_blend)}
    return entry


def color(light):
    """Linear colour, times that of the light's temperature where it has one."""
    rgb = list(light.color)
    if getattr(light, "use_temperature", False):
        rgb = [c * t for c, t in zip(rgb, light.temperature_color)]
    return rgb


def casts_shadow(light):
    """The flag moved from Cycles' settings to the light itself."""
    if hasattr(light.cycles, "cast_shadow"):
        return bool(light.cycles.cast_shadow)
    return bool(light.use_shadow)


def punctual(light):
    """The nearest standard light."""
    rgb = color(light)
    brightest = max(*rgb, 1e-9)
    power = light.energy * brightest * 2.0 ** getattr(light, "exposure", 0.0)
    entry = {"name": light.name, "color": [number(max(c, 0.0) / brightest) for c in rgb]}
    if light.type == "SUN":
        return {**entry, "type": "directional", "intensity": number(max(power, 0.0))}
    entry["intensity"] = number(max(power, 0.0) / (4.0 * math.pi) * LUMENS)
    if light.type == "POINT":
        return {**entry, "type": "point"}
    outer = min(light.spot_size / 2.0, math.pi / 2.0)
    cone = {"outerConeAngle": number(outer), "innerConeAngle": number(outer * (1.0 - light.spot_blend) * 0.999)}
    return {**entry, "type": "spot", "spot": cone}
