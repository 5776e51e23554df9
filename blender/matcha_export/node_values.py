"""What a shader node carries besides its links, read generically through RNA."""

import bpy
import mathutils
import numpy as np

from .numbers import columns, number, numbers

BASE = {prop.identifier for prop in bpy.types.Node.bl_rna.properties}
# Nodes whose output sockets hold the value that they give.
CONTENT_IN_OUTPUT = {"ShaderNodeValue", "ShaderNodeRGB", "ShaderNodeNormal"}
RAMP_SAMPLES = 257
CURVE_SAMPLES = 257


def properties(node):
    """Every editable simple property of the node's own type, by identifier."""
    found = {}
    for prop in node.bl_rna.properties:
        if prop.is_readonly or prop.identifier in BASE or prop.identifier.startswith("bl_"):
            continue
        value = simple_property(node, prop)
        if value is not None:
            found[prop.identifier] = value
    return found


def simple_property(node, prop):
    """A flag, number, text or list of numbers; None for pointers and collections."""
    if prop.type not in {"BOOLEAN", "INT", "FLOAT", "STRING", "ENUM"}:
        return None
    value = getattr(node, prop.identifier)
    if prop.type == "STRING" or (prop.type == "ENUM" and not prop.is_enum_flag):
        return value
    if prop.type == "ENUM":
        return " ".join(sorted(value))
    if prop.is_array:
        if len(prop.array_dimensions) > 1 and prop.array_dimensions[1]:
            return columns(value)
        return numbers(value)
    if prop.type == "BOOLEAN":
        return bool(value)
    return int(value) if prop.type == "INT" else number(value)


def socket(sock, with_value):
    """A socket's description; `with_value` for inputs and for outputs that are content."""
    entry = {"identifier": sock.identifier, "name": sock.name, "type": sock.type}
    value = socket_value(sock) if with_value else []
    if value:
        entry["value"] = value
    if sock.hide_value:
        entry["hide_value"] = True
    if not available(sock):
        entry["enabled"] = False
    return entry


def available(sock):
    """False where the node's mode switches the socket off."""
    return sock.enabled and not getattr(sock, "is_unavailable", False)


def socket_value(sock):
    """One to four numbers, or none for shaders, strings and data-blocks."""
    value = getattr(sock, "default_value", None)
    if value is None or isinstance(value, (str, bpy.types.ID)):
        return []
    if isinstance(value, (bool, int, float)):
        return [number(value)]
    return numbers(value)


def ramp(color_ramp):
    """Stops and a table of a colour ramp."""
    table = np.array([color_ramp.evaluate(i / (RAMP_SAMPLES - 1)) for i in range(RAMP_SAMPLES)])
    stops = [numbers((stop.position, *stop.color)) for stop in color_ramp.elements]
    return {
        "color_mode": color_ramp.color_mode,
        "interpolation": color_ramp.interpolation,
        "hue_interpolation": color_ramp.hue_interpolation,
        "stops": sorted(stops, key=lambda stop: stop[0]),
        "table": numbers(table.ravel()),
    }


def curves(mapping):
    """Control points and tables of a curve widget.

    Of four curves the last is the combined one, which Cycles applies before each of the
    other three.
    """
    mapping.initialize()
    all_curves = list(mapping.curves)
    low = min(curve.points[0].location[0] for curve in all_curves)
    high = max(curve.points[-1].location[0] for curve in all_curves)
    combined = all_curves[3] if len(all_curves) == 4 else None
    xs = [low + (high - low) * i / (CURVE_SAMPLES - 1) for i in range(CURVE_SAMPLES)]
    first = xs if combined is None else [mapping.evaluate(combined, x) for x in xs]
    tables = [
        numbers(first if curve is combined else (mapping.evaluate(curve, x) for x in first))
        for curve in all_curves
    ]
    return {
        "curves": [[control_point(point) for point in curve.points] for curve in all_curves],
        "extend": mapping.extend,
        "range": numbers((low, high)),
        "tables": tables,
    }


def control_point(point):
    """Position and handle type."""
    return {"location": numbers(point.location), "handle": point.handle_type}


def texture_mapping(mapping, warn):
    """The coordinate mapping inside an old texture node as a matrix, None for the identity.

    The order of the factors is that of Cycles' texture mapping: the projection to axes first,
    then scale, rotation and translation; texture type uses the inverse.
    """
    kind = mapping.vector_type
    scale = np.array(mapping.scale, dtype=np.float64)
    if kind in {"TEXTURE", "NORMAL"}:
        small = np.abs(scale) < 1e-5
        scale[small] = np.where(scale[small] < 0.0, -1e-5, 1e-5)
    scaling = np.diag([*scale, 1.0])
    euler = mathutils.Euler(tuple(mapping.rotation), "XYZ")
    rotation = np.array(euler.to_matrix().to_4x4(), dtype=np.float64)
    shift = np.eye(4)
    shift[:3, 3] = mapping.translation
    if kind == "TEXTURE":
        matrix = np.linalg.inv(shift @ rotation @ scaling)
    elif kind == "POINT":
        matrix = shift @ rotation @ scaling
    elif kind == "NORMAL":
        matrix = rotation @ np.linalg.inv(scaling)
    else:
        matrix = rotation @ scaling
    choice = np.zeros((4, 4))
    choice[3, 3] = 1.0
    for row, axis in enumerate((mapping.mapping_x, mapping.mapping_y, mapping.mapping_z)):
        if axis != "NONE":
            choice[row, "XYZ".index(axis)] = 1.0
    if mapping.use_min or mapping.use_max:
        warn("the minimum and maximum of its texture mapping are left out")
    matrix = matrix @ choice
    return None if np.allclose(matrix, np.eye(4), atol=1e-7) else columns(matrix)
