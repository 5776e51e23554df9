"""Walks over everything that is placed in the scene."""

import numpy as np

from . import axes, lights, visibility
from .instancing import Placement

UNSUPPORTED = {"CURVES", "POINTCLOUD", "VOLUME", "GREASEPENCIL", "GPENCIL"}


class Objects:
    """Turns depsgraph instances into placements of meshes and into light nodes."""

    def __init__(self, glb, meshes, materials, trees, report, view_layer):
        self.glb = glb
        self.meshes = meshes
        self.materials = materials
        self.lights = lights.Lights(glb, trees, report)
        self.report = report
        self.view_layer = view_layer
        self.override = None
        self.placements = []
        self.light_nodes = []

    def collect(self, depsgraph):
        """Visits all instances once; Blender reuses each of them for the next."""
        override = self.view_layer.material_override
        self.override = override and override.evaluated_get(depsgraph)
        total = max(len(depsgraph.object_instances), 1)
        for number, instance in enumerate(depsgraph.object_instances):
            self.report.progress(0.05 + 0.85 * number / total, "meshes")
            kind = instance.object.type
            if not np.isfinite(np.array(instance.matrix_world)).all():
                self.report.warning(f"object {instance.object.name}: its place is not finite; it is left out")
            elif kind == "LIGHT":
                self.light_nodes.append(self.lights.node(instance))
            elif kind == "MESH" and instance.show_self:
                # Curves, surfaces, texts and metaballs come by a second time, as meshes.
                self._place(instance)
            elif kind in UNSUPPORTED:
                self.report.warning(f"object {instance.object.name}: {kind.lower()} objects are left out")
            self._hair(instance)
            self._linking(instance.object)

    def _linking(self, obj):
        linking = getattr(obj, "light_linking", None)
        if linking and (linking.receiver_collection or linking.blocker_collection):
            self.report.warning(f"object {obj.name}: light linking is left out; it lights and shadows everything")

    def _hair(self, instance):
        obj = instance.object
        if not instance.show_particles or obj.type != "MESH":
            return
        for modifier in obj.modifiers:
            system = getattr(modifier, "particle_system", None)
            if system and system.settings.type == "HAIR" and system.settings.render_type == "PATH":
                self.report.warning(f"object {obj.name}: hair strands are left out")

    def _place(self, instance):
        obj = instance.object
        entry = visibility.about(instance, self.view_layer)
        if not any(entry["visibility"].values()):
            return
        worn = tuple(self._material(slot.material) for slot in obj.material_slots)
        own = self._own_slots(obj) or worn
        # An object may have fewer or other slots than its data.
        slots = own or (self._material(None),)
        mesh = self.meshes.add(obj.data, slots, [group.name for group in obj.vertex_groups])
        if mesh is None:
            return
        if worn and worn != slots:
            entry["materials"] = list(worn)
        matrix = axes.placement(np.array(instance.matrix_world, dtype=np.float64))
        self.placements.append(Placement(mesh, matrix, visibility.random(instance), entry))

    def _own_slots(self, obj):
        slots = getattr(obj.data, "materials", None)
        return tuple(self._material(material) for material in slots) if slots else ()

    def _material(self, material):
        """Index of a slot's material; a view layer may put its own in place of all."""
        return self.materials.add(self.override or material)
