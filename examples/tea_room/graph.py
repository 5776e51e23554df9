"""Shader graphs written as expressions: wires with arithmetic, one method for each node."""

import bpy


class Wire:
    """An output socket that can be calculated with."""

    def __init__(self, graph, socket):
        self.graph, self.socket = graph, socket

    def _math(self, operation, left, right):
        vector = any(isinstance(w, Wire) and w.socket.type == "VECTOR" for w in (left, right))
        return (self.graph.vector_math if vector else self.graph.math)(operation, left, right)

    def __add__(self, other):
        return self._math("ADD", self, other)

    def __radd__(self, other):
        return self._math("ADD", other, self)

    def __sub__(self, other):
        return self._math("SUBTRACT", self, other)

    def __rsub__(self, other):
        return self._math("SUBTRACT", other, self)

    def __mul__(self, other):
        return self._math("MULTIPLY", self, other)

    def __rmul__(self, other):
        return self._math("MULTIPLY", other, self)


class Graph:
    """A node tree under construction; columns of nodes are laid out left to right."""

    def __init__(self, tree):
        self.tree, self.count = tree, 0

    def add(self, kind, inputs=(), **props):
        """A node with properties set, and inputs (by index or identifier) linked or set."""
        node = self.tree.nodes.new(kind)
        node.location = (220 * (self.count // 6), -240 * (self.count % 6))
        self.count += 1
        for name, value in props.items():
            setattr(node, name, value)
        for key, value in dict(inputs).items():
            if value is not None:
                self.feed(find(node.inputs, key), value)
        return node

    def feed(self, socket, value):
        """Links a wire to an input, or sets the input's value."""
        if isinstance(value, Wire):
            self.tree.links.new(value.socket, socket)
        elif socket.type == "RGBA":
            socket.default_value = (*(value if hasattr(value, "__len__") else (value,) * 3), 1.0)
        elif socket.type == "VECTOR":
            socket.default_value = value if hasattr(value, "__len__") else (value,) * 3
        else:
            socket.default_value = value

    def wire(self, node, key=0):
        return Wire(self, find(node.outputs, key))

    # Coordinates

    def uv(self, name="UVMap"):
        """Texture coordinates in metres."""
        return self.wire(self.add("ShaderNodeUVMap", uv_map=name))

    def place(self, vector, scale=1.0, turn=0.0, move=(0, 0, 0)):
        """Mapping, for points: scale, then turn about z (radians), then move."""
        scale = scale if hasattr(scale, "__len__") else (scale,) * 3
        values = {0: vector, 1: move, 2: (0, 0, turn), 3: (*scale, 1.0)[:3]}
        return self.wire(self.add("ShaderNodeMapping", values))

    def separate(self, vector):
        node = self.add("ShaderNodeSeparateXYZ", {0: vector})
        return [self.wire(node, i) for i in range(3)]

    def combine(self, x, y, z=0.0):
        return self.wire(self.add("ShaderNodeCombineXYZ", {0: x, 1: y, 2: z}))

    # Textures

    def noise(self, vector, scale, detail=3.0, rough=0.5, warp=0.0, kind="FBM", dims="2D", color=False):
        values = {"Vector": vector, "Scale": scale, "Detail": detail, "Roughness": rough, "Distortion": warp}
        node = self.add("ShaderNodeTexNoise", noise_dimensions=dims, noise_type=kind)
        for key, value in values.items():
            self.feed(find(node.inputs, key), value)
        return self.wire(node, "Color" if color else 0)

    def voronoi(self, vector, scale, feature="F1", out=0, random=1.0, metric="EUCLIDEAN"):
        props = {"voronoi_dimensions": "2D", "feature": feature}
        if feature in ("F1", "F2", "SMOOTH_F1"):
            props["distance"] = metric
        node = self.add("ShaderNodeTexVoronoi", **props)
        for key, value in {"Vector": vector, "Scale": scale, "Randomness": random}.items():
            self.feed(find(node.inputs, key), value)
        return self.wire(node, out)

    def wave(self, vector, scale, warp=0.0, detail=2.0, axis="X", profile="SIN", kind="BANDS"):
        values = {"Vector": vector, "Scale": scale, "Distortion": warp, "Detail": detail}
        props = {"wave_type": kind, "wave_profile": profile}
        props["bands_direction" if kind == "BANDS" else "rings_direction"] = axis
        return self.wire(self.add("ShaderNodeTexWave", values, **props), 1)

    def brick(self, vector, size, mortar, a, b, joint, bias=0.0, smooth=0.1, offset=0.5, out=0):
        """Bricks of `size` (width, height) with joints of width `mortar`, in the vector's units."""
        values = {"Vector": vector, "Color1": a, "Color2": b, "Mortar": joint, "Scale": 1.0}
        values |= {"Mortar Size": mortar, "Mortar Smooth": smooth, "Bias": bias}
        values |= {"Brick Width": size[0], "Row Height": size[1]}
        node = self.add("ShaderNodeTexBrick", values, offset=offset, squash=1.0)
        return self.wire(node, 0), self.wire(node, 1)

    def checker(self, vector, scale):
        return self.wire(self.add("ShaderNodeTexChecker", {"Vector": vector, "Scale": scale}), 1)

    def gradient(self, vector, kind="LINEAR"):
        return self.wire(self.add("ShaderNodeTexGradient", {0: vector}, gradient_type=kind), 1)

    def magic(self, vector, scale, warp=1.0, depth=2):
        values = {"Vector": vector, "Scale": scale, "Distortion": warp}
        return self.wire(self.add("ShaderNodeTexMagic", values, turbulence_depth=depth), 1)

    def white(self, vector, color=False):
        node = self.add("ShaderNodeTexWhiteNoise", {"Vector": vector}, noise_dimensions="2D")
        return self.wire(node, "Color" if color else "Value")

    def image(self, image, vector, out="Color", extension="REPEAT"):
        props = {"image": image, "interpolation": "Linear", "extension": extension}
        return self.wire(self.add("ShaderNodeTexImage", {0: vector}, **props), out)

    # Numbers

    def math(self, operation, a, b=None, c=None, clamp=False):
        values = {0: a, 1: b, 2: c}
        return self.wire(self.add("ShaderNodeMath", values, operation=operation, use_clamp=clamp))

    def vector_math(self, operation, a, b=None):
        if operation == "MULTIPLY" and not isinstance(b, Wire) and not hasattr(b, "__len__"):
            b = (b,) * 3
        return self.wire(self.add("ShaderNodeVectorMath", {0: a, 1: b}, operation=operation))

    def remap(self, value, low, high, to_low=0.0, to_high=1.0, smooth=False):
        values = {0: value, 1: low, 2: high, 3: to_low, 4: to_high}
        kind = "SMOOTHSTEP" if smooth else "LINEAR"
        return self.wire(self.add("ShaderNodeMapRange", values, interpolation_type=kind, clamp=True))

    def clamp(self, value, low=0.0, high=1.0):
        return self.wire(self.add("ShaderNodeClamp", {0: value, 1: low, 2: high}))

    def mix_value(self, factor, a, b):
        values = {"Factor_Float": factor, "A_Float": a, "B_Float": b}
        return self.wire(self.add("ShaderNodeMix", values, data_type="FLOAT"), "Result_Float")

    def curve(self, value, points):
        """Float curve through points (x, y), x from 0 to 1."""
        node = self.add("ShaderNodeFloatCurve", {"Value": value})
        set_points(node.mapping, 0, points)
        return self.wire(node)

    # Colours

    def mix(self, factor, a, b, blend="MIX"):
        values = {"Factor_Float": factor, "A_Color": a, "B_Color": b}
        props = {"data_type": "RGBA", "blend_type": blend}
        return self.wire(self.add("ShaderNodeMix", values, **props), "Result_Color")

    def ramp(self, factor, stops, interpolation="LINEAR"):
        """Colour ramp; stops are (position, grey or colour)."""
        node = self.add("ShaderNodeValToRGB", {0: factor})
        elements = node.color_ramp.elements
        while len(elements) < len(stops):
            elements.new(0.5)
        for element, (position, color) in zip(elements, stops):
            element.position = position
            element.color = (*(color if hasattr(color, "__len__") else (color,) * 3), 1.0)
        node.color_ramp.interpolation = interpolation
        return self.wire(node)

    def hsv(self, color, hue=0.5, saturation=1.0, value=1.0):
        values = {"Hue": hue, "Saturation": saturation, "Value": value, "Color": color}
        return self.wire(self.add("ShaderNodeHueSaturation", values))

    def contrast(self, color, bright, contrast):
        return self.wire(self.add("ShaderNodeBrightContrast", {0: color, 1: bright, 2: contrast}))

    def gamma(self, color, power):
        return self.wire(self.add("ShaderNodeGamma", {0: color, 1: power}))

    def invert(self, color, factor=1.0):
        return self.wire(self.add("ShaderNodeInvert", {0: factor, 1: color}))

    def rgb_curve(self, color, points):
        """The combined curve of an RGB Curves node."""
        node = self.add("ShaderNodeRGBCurve", {1: color})
        set_points(node.mapping, 3, points)
        return self.wire(node)

    # Surfaces

    def bump(self, height, strength, distance, normal=None):
        """Bump of a height from 0 to 1; `distance` in metres."""
        values = {"Strength": strength, "Distance": distance, "Height": height, "Normal": normal}
        return self.wire(self.add("ShaderNodeBump", values))

    def facing(self, blend=0.5, normal=None):
        return self.wire(self.add("ShaderNodeLayerWeight", {0: blend, 1: normal}), "Facing")

    def fresnel(self, ior, normal=None):
        return self.wire(self.add("ShaderNodeFresnel", {0: ior, 1: normal}))

    def principled(self, **inputs):
        """Principled BSDF; base_color=… is its input Base Color, and so on."""
        values = {key.replace("_", " ").title(): value for key, value in inputs.items()}
        values = {key.replace("Ior", "IOR"): value for key, value in values.items()}
        return self.wire(self.add("ShaderNodeBsdfPrincipled", values))

    def shader(self, kind, inputs):
        return self.wire(self.add(f"ShaderNode{kind}", inputs))

    def mix_shader(self, factor, a, b):
        return self.wire(self.add("ShaderNodeMixShader", {0: factor, 1: a, 2: b}))

    def add_shader(self, a, b):
        return self.wire(self.add("ShaderNodeAddShader", {0: a, 1: b}))

    # Groups

    def use(self, group, *inputs):
        """The outputs of a node group, in order; one wire where there is only one."""
        node = self.add("ShaderNodeGroup", node_tree=group())
        for socket, value in zip(node.inputs, inputs):
            self.feed(socket, value)
        wires = [Wire(self, socket) for socket in node.outputs if socket.type != "CUSTOM"]
        return wires[0] if len(wires) == 1 else wires


def find(sockets, key):
    """A socket by index, identifier or name."""
    if isinstance(key, int):
        return sockets[key]
    for socket in sockets:
        if socket.identifier == key:
            return socket
    for socket in sockets:
        if socket.name == key and socket.enabled:
            return socket
    raise KeyError(f"{key} among {[s.identifier for s in sockets]}")


def set_points(mapping, index, points):
    curve = mapping.curves[index].points
    while len(curve) < len(points):
        curve.new(0.5, 0.5)
    for point, location in zip(curve, points):
        point.location = location
    mapping.update()


def node_group(name, inputs, outputs):
    """Makes a function (graph, *inputs) -> outputs into a shared node group.

    Inputs are (name, default) with a default of None for a vector; outputs are names of numbers,
    or of colours where they start with a capital C and a space.
    """

    def wrap(build):
        def get():
            tree = bpy.data.node_groups.get(name)
            return tree or fill(bpy.data.node_groups.new(name, "ShaderNodeTree"))

        def fill(tree):
            for label, default in inputs:
                kind = "NodeSocketVector" if default is None else "NodeSocketFloat"
                item = tree.interface.new_socket(label, in_out="INPUT", socket_type=kind)
                if default is not None:
                    item.default_value = default
            for label in outputs:
                kind = "NodeSocketColor" if label.startswith("C ") else "NodeSocketFloat"
                tree.interface.new_socket(label.removeprefix("C "), in_out="OUTPUT", socket_type=kind)
            graph = Graph(tree)
            entry = graph.add("NodeGroupInput")
            results = build(graph, *(graph.wire(entry, i) for i in range(len(inputs))))
            results = results if isinstance(results, tuple) else (results,)
            graph.add("NodeGroupOutput", dict(enumerate(results)))
            return tree

        return get

    return wrap


def material(name):
    """Makes a function graph -> shader into a function that returns the material."""

    def wrap(build):
        def get():
            found = bpy.data.materials.get(name)
            if found:
                return found
            made = bpy.data.materials.new(name)
            made.use_nodes = True
            made.node_tree.nodes.clear()
            graph = Graph(made.node_tree)
            graph.add("ShaderNodeOutputMaterial", {0: build(graph)})
            return made

        return get

    return wrap


def expanded(tree):
    """Number of nodes that calculate, groups counted by what is in them."""
    count = 0
    for node in tree.nodes:
        if node.type == "GROUP":
            count += expanded(node.node_tree)
        elif node.type not in ("GROUP_INPUT", "GROUP_OUTPUT", "REROUTE", "FRAME"):
            count += 1
    return count
