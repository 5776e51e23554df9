"""A metallic-roughness likeness of a Cycles material, for viewers without the extension."""

from .numbers import number

SEARCH_DEPTH = 24


def material(source, images, glb):
    """glTF properties that come near the node tree's first opaque closure."""
    output = source.node_tree.get_output_node("CYCLES")
    closure = first_closure(output.inputs["Surface"]) if output else None
    if closure is None:
        return plain((0.0, 0.0, 0.0, 1.0))
    kind = closure.bl_idname
    if kind == "ShaderNodeEmission":
        return emission(closure)
    look = {"pbrMetallicRoughness": {}}
    pbr = look["pbrMetallicRoughness"]
    color = closure.inputs.get("Base Color") or closure.inputs.get("Color")
    set_color(pbr, color, images, glb)
    pbr["roughnessFactor"] = clamp(constant(closure.inputs.get("Roughness"), 1.0))
    pbr["metallicFactor"] = metalness(closure)
    alpha = alpha_of(closure, pbr)
    if alpha < 1.0:
        look["alphaMode"] = "BLEND"
    if not source.use_backface_culling:
        look["doubleSided"] = True
    return look


def plain(color):
    """A matt surface."""
    rgba = [clamp(c) for c in color[:3]] + [1.0]
    return {"pbrMetallicRoughness": {"baseColorFactor": rgba, "metallicFactor": 0.0, "roughnessFactor": 1.0}}


def emission(node):
    """A black surface that glows, brightness clipped to what glTF's core allows."""
    color = constant_color(node.inputs["Color"])
    strength = constant(node.inputs["Strength"], 1.0)
    look = plain((0.0, 0.0, 0.0))
    look["emissiveFactor"] = [clamp(c * strength) for c in color]
    return look


def metalness(closure):
    """Metals are what Cycles calls glossy."""
    if closure.bl_idname == "ShaderNodeBsdfPrincipled":
        return clamp(constant(closure.inputs["Metallic"], 0.0))
    return 1.0 if closure.bl_idname in {"ShaderNodeBsdfAnisotropic", "ShaderNodeBsdfMetallic"} else 0.0


def alpha_of(closure, pbr):
    """Glass and transparency become an alpha of the base colour."""
    alpha = constant(closure.inputs.get("Alpha"), 1.0)
    if closure.bl_idname in {"ShaderNodeBsdfGlass", "ShaderNodeBsdfRefraction", "ShaderNodeBsdfTransparent"}:
        alpha = 0.3
    if alpha < 1.0:
        pbr.setdefault("baseColorFactor", [1.0, 1.0, 1.0, 1.0])[3] = clamp(alpha)
    return alpha


def set_color(pbr, sock, images, glb):
    """Base colour: the nearest standard texture upstream, or a constant."""
    if sock is None:
        return
    node = upstream_image(sock)
    if node is not None:
        index = images.add(node.image, node.image_user, lambda text: images.report.warning(f"{node.name}: {text}"))
        source = images.entries[index].get("source")
        if source is not None:
            pbr["baseColorTexture"] = {"index": texture(glb, source, node.extension)}
            return
    pbr["baseColorFactor"] = [clamp(c) for c in constant_color(sock)] + [1.0]


def texture(glb, source, extension):
    """A glTF texture with the node's wrap mode, each pair once."""
    wrap = {"REPEAT": 10497, "MIRROR": 33648}.get(extension, 33071)
    sampler = index_of(glb, "samplers", {"wrapS": wrap, "wrapT": wrap})
    return index_of(glb, "textures", {"sampler": sampler, "source": source})


def index_of(glb, name, entry):
    """The index of an equal entry, appended where there is none."""
    entries = glb.root.get(name, [])
    return entries.index(entry) if entry in entries else glb.append(name, entry)


def first_closure(sock, depth=0):
    """The first closure upstream that is not transparent, where there is one."""
    if not sock.links or depth > SEARCH_DEPTH:
        return None
    node = sock.links[0].from_node
    if node.bl_idname in {"ShaderNodeMixShader", "ShaderNodeAddShader", "NodeReroute"}:
        shaders = [s for s in node.inputs if s.type == "SHADER"]
        found = [c for c in (first_closure(s, depth + 1) for s in shaders) if c is not None]
        solid = [c for c in found if c.bl_idname != "ShaderNodeBsdfTransparent"]
        return next(iter(solid or found), None)
    return node if not getattr(node, "node_tree", None) else first_in_group(node, depth)


def first_in_group(node, depth):
    """Looks behind a group's output."""
    outputs = [n for n in node.node_tree.nodes if n.bl_idname == "NodeGroupOutput" and n.is_active_output]
    shaders = [s for n in outputs for s in n.inputs if s.type == "SHADER"]
    return next((c for c in (first_closure(s, depth + 1) for s in shaders) if c is not None), None)


def upstream_image(sock):
    """The nearest image texture, breadth first."""
    level = [sock]
    for _ in range(SEARCH_DEPTH):
        nodes = [link.from_node for s in level for link in s.links]
        for node in nodes:
            if node.bl_idname == "ShaderNodeTexImage" and node.image is not None:
                return node
        level = [s for node in nodes for s in node.inputs][:256]
        if not level:
            return None
    return None


def constant(sock, otherwise):
    """The value of an unlinked number socket."""
    if sock is None or sock.is_linked:
        return otherwise if sock is None else 0.5
    return float(sock.default_value)


def constant_color(sock):
    """The value of an unlinked colour socket; middle grey where something drives it."""
    return (0.5, 0.5, 0.5) if sock.is_linked else tuple(sock.default_value)[:3]


def clamp(value):
    """glTF's factors live in 0 to 1."""
    return number(min(max(value, 0.0), 1.0))
