"""Render settings and the world."""

from .numbers import number, numbers
from .trees import tree_in_use


def render_settings(scene):
    """What the author asked of Cycles, with the names of the renderer's own settings."""
    render = scene.render
    cycles = scene.cycles
    view = scene.view_settings
    percent = render.resolution_percentage
    return {
        "resolution": [max(render.resolution_x * percent // 100, 1), max(render.resolution_y * percent // 100, 1)],
        "pixel_aspect": number(render.pixel_aspect_x / render.pixel_aspect_y),
        "samples": int(cycles.samples),
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


def world(scene, depsgraph, trees):
    """The world's tree or colour, and who sees it. A scene without one is black."""
    if scene.world is None:
        return {"color": [0.0, 0.0, 0.0]}
    data = scene.world.evaluated_get(depsgraph)
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
