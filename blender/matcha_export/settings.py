"""Render settings and the world."""

from . import camera
from .numbers import number, numbers
from .trees import tree_in_use


def render_settings(scene, view_layer):
    """What the author asked of Cycles, with the names of the renderer's own settings."""
    render = scene.render
    cycles = scene.cycles
    view = scene.view_settings
    percent = render.resolution_percentage
    return {
        "resolution": [max(render.resolution_x * percent // 100, 1), max(render.resolution_y * percent // 100, 1)],
        "pixel_aspect": number(render.pixel_aspect_x / render.pixel_aspect_y),
        "samples": samples(scene, view_layer),
        "max_bounces": int(cycles.max_bounces),
        "diffuse_bounces": int(cycles.diffuse_bounces),
        "glossy_bounces": int(cycles.glossy_bounces),
        "transmission_bounces": int(cycles.transmission_bounces),
        "transparent_bounces": int(cycles.transparent_max_bounces),
        "min_bounces": int(cycles.min_light_bounces),
        "clamp_direct": number(cycles.sample_clamp_direct),
        "clamp_indirect": number(cycles.sample_clamp_indirect),
        "blur_glossy": number(cycles.blur_glossy),
        "reflective_caustics": bool(cycles.caustics_reflective),
        "refractive_caustics": bool(cycles.caustics_refractive),
        "light_threshold": number(cycles.light_sampling_threshold),
        "filter": {"type": cycles.pixel_filter_type, "width": number(cycles.filter_width)},
        "exposure": number(cycles.film_exposure),
        "transparent_film": bool(render.film_transparent),
        "view": {
            "transform": view.view_transform,
            "look": view.look,
            "exposure": number(view.exposure),
            "gamma": number(view.gamma),
        },
        "seed": int(cycles.seed),
    }


def warn_of_left_out(scene, report):
    """Says what changes the picture and is not exported."""
    if scene.render.use_motion_blur:
        report.warning("motion blur is left out")
    if scene.render.use_border:
        report.warning("the render region is left out; the whole picture is rendered")
    if camera.is_part_of_panorama(scene.camera.data):
        report.warning("the panorama's range of angles is left out; all around is rendered")
    if scene.cycles.use_fast_gi:
        report.warning("fast global illumination is left out; all light is traced")
    if scene.render.film_transparent and scene.cycles.film_transparent_glass:
        report.warning("Transparent Glass is left out; glass covers what is behind it")
    if scene.render.use_multiview:
        report.warning("stereoscopy is left out; the camera's own view is rendered")
    if composites(scene):
        report.warning("compositing is left out; the picture is as it is rendered")


def composites(scene):
    """Whether Blender would change the picture after rendering. Blender 5 keeps the nodes elsewhere."""
    if not scene.render.use_compositing:
        return False
    if hasattr(scene, "compositing_node_group"):
        tree = scene.compositing_node_group
    else:
        tree = scene.node_tree if scene.use_nodes else None
    # What joins the layers with the output changes nothing.
    passive = {"R_LAYERS", "COMPOSITE", "VIEWER", "OUTPUT_FILE", "REROUTE", "FRAME", "GROUP_OUTPUT"}
    return tree is not None and any(node.type not in passive and not node.mute for node in tree.nodes)


def samples(scene, view_layer):
    """Samples of a pixel; a view layer may have a number of its own."""
    asked, own = scene.cycles.samples, view_layer.samples
    use = scene.cycles.use_layer_samples
    if own == 0 or use == "IGNORE":
        return int(asked)
    return int(min(asked, own) if use == "BOUNDED" else own)


def world(scene, view_layer, depsgraph, trees):
    """The world's tree or colour, and who sees it. A scene without one is black."""
    # View layers have worlds of their own since Blender 4.3.
    used = getattr(view_layer, "world_override", None) or scene.world
    if used is None:
        return {"color": [0.0, 0.0, 0.0]}
    data = used.evaluated_get(depsgraph)
    cycles = data.cycles
    seen = data.cycles_visibility
    entry = {
        "name": data.name,
        "color": numbers(data.color),
        "visibility": {
            "camera": bool(seen.camera),
            "diffuse": bool(seen.diffuse),
            "glossy": bool(seen.glossy),
            "transmission": bool(seen.transmission),
            "shadow": True,
        },
        "importance_sample": cycles.sampling_method != "NONE",
        "map_resolution": int(cycles.sample_map_resolution) if cycles.sampling_method == "MANUAL" else 0,
        "max_bounces": int(cycles.max_bounces),
    }
    node_tree = tree_in_use(data)
    if node_tree is not None:
        entry["tree"] = trees.add(node_tree, data.name)
    return entry
