"""The cases of node_reference.py: every mode of every node, with inputs that vary."""


def case(kind, output, inputs, **more):
    """One case; `props` are properties of the node."""
    return {"type": kind, "output": output, "inputs": inputs, **more}


def math():
    """Math."""
    operations = (
        "ADD SUBTRACT MULTIPLY DIVIDE MULTIPLY_ADD POWER LOGARITHM SQRT INVERSE_SQRT ABSOLUTE"
        " EXPONENT MINIMUM MAXIMUM LESS_THAN GREATER_THAN SIGN COMPARE SMOOTH_MIN SMOOTH_MAX"
        " ROUND FLOOR CEIL TRUNC FRACT MODULO FLOORED_MODULO WRAP SNAP PINGPONG SINE COSINE"
        " TANGENT ARCSINE ARCCOSINE ARCTANGENT ARCTAN2 SINH COSH TANH RADIANS DEGREES"
    ).split()
    for operation in operations:
        inputs = {"Value": "a.x", "Value_001": "a.y", "Value_002": "b.z"}
        yield case("ShaderNodeMath", "Value", inputs, props={"operation": operation})
    for operation in ("POWER", "LOGARITHM", "MULTIPLY"):
        inputs = {"Value": "b.x", "Value_001": "b.y"}
        props = {"operation": operation, "use_clamp": operation == "MULTIPLY"}
        yield case("ShaderNodeMath", "Value", inputs, props=props)


def vector_math():
    """Vector Math."""
    vectors = (
        "ADD SUBTRACT MULTIPLY DIVIDE MULTIPLY_ADD CROSS_PRODUCT PROJECT REFLECT REFRACT"
        " FACEFORWARD SCALE NORMALIZE ABSOLUTE MINIMUM MAXIMUM FLOOR CEIL FRACTION MODULO WRAP"
        " SNAP SINE COSINE TANGENT"
    ).split()
    inputs = {"Vector": "a", "Vector_001": "c", "Vector_002": "b", "Scale": "b.x"}
    for operation in vectors:
        yield case("ShaderNodeVectorMath", "Vector", inputs, props={"operation": operation})
    for operation in ("DOT_PRODUCT", "DISTANCE", "LENGTH"):
        yield case("ShaderNodeVectorMath", "Value", inputs, props={"operation": operation})


def mixes():
    """Mix in its three types and all blend modes, and the older form."""
    modes = (
        "MIX DARKEN MULTIPLY BURN LIGHTEN SCREEN DODGE ADD OVERLAY SOFT_LIGHT LINEAR_LIGHT"
        " DIFFERENCE EXCLUSION SUBTRACT DIVIDE HUE SATURATION COLOR VALUE"
    ).split()
    for mode in modes:
        props = {"data_type": "RGBA", "blend_type": mode}
        inputs = {"Factor_Float": 0.7, "A_Color": "b", "B_Color": [0.2, 0.9, 0.55, 1.0]}
        yield case("ShaderNodeMix", "Result_Color", inputs, props=props)
        inputs = {"Fac": "b.y", "Color1": "a", "Color2": "b"}
        yield case("ShaderNodeMixRGB", "Color", inputs, props={"blend_type": mode, "use_clamp": True})
    for clamp in (False, True):
        props = {"data_type": "FLOAT", "clamp_factor": clamp}
        inputs = {"Factor_Float": "a.x", "A_Float": "b.x", "B_Float": "c.y"}
        yield case("ShaderNodeMix", "Result_Float", inputs, props=props)
        props = {"data_type": "VECTOR", "clamp_factor": clamp}
        inputs = {"Factor_Float": "a.x", "A_Vector": "b", "B_Vector": "c"}
        yield case("ShaderNodeMix", "Result_Vector", inputs, props=props)
        props = {"data_type": "VECTOR", "clamp_factor": clamp, "factor_mode": "NON_UNIFORM"}
        inputs = {"Factor_Vector": "a", "A_Vector": "b", "B_Vector": "c"}
        yield case("ShaderNodeMix", "Result_Vector", inputs, props=props)


def ranges():
    """Map Range and Clamp."""
    for kind in ("LINEAR", "STEPPED", "SMOOTHSTEP", "SMOOTHERSTEP"):
        for clamp in (False, True):
            props = {"interpolation_type": kind, "clamp": clamp}
            inputs = {"Value": "a.x", "From Min": -1.0, "From Max": "b.y", "To Min": 2.0}
            inputs |= {"To Max": "c.x", "Steps": 3.0}
            yield case("ShaderNodeMapRange", "Result", inputs, props=props)
            inputs = {"Vector": "a", "From_Min_FLOAT3": [-1.0, 2.0, 0.5], "To_Max_FLOAT3": "c"}
            inputs |= {"From_Max_FLOAT3": "b", "Steps_FLOAT3": [3.0, 4.0, 5.0]}
            props = {**props, "data_type": "FLOAT_VECTOR"}
            yield case("ShaderNodeMapRange", "Vector", inputs, props=props)
    for kind in ("MINMAX", "RANGE"):
        inputs = {"Value": "a.x", "Min": "b.x", "Max": "b.y"}
        yield case("ShaderNodeClamp", "Result", inputs, props={"clamp_type": kind})


def colors():
    """Nodes that change colours."""
    inputs = {"Color": "b", "Hue": 0.3, "Saturation": 1.7, "Value": 0.8, "Fac": 0.9}
    yield case("ShaderNodeHueSaturation", "Color", inputs)
    yield case("ShaderNodeHueSaturation", "Color", {**inputs, "Hue": "a.x", "Saturation": "b.y"})
    yield case("ShaderNodeInvert", "Color", {"Color": "b", "Fac": 0.6})
    yield case("ShaderNodeBrightContrast", "Color", {"Color": "b", "Bright": 0.1, "Contrast": "a.y"})
    yield case("ShaderNodeGamma", "Color", {"Color": "b", "Gamma": 2.2})
    yield case("ShaderNodeGamma", "Color", {"Color": "a", "Gamma": "b.x"})
    yield case("ShaderNodeRGBToBW", "Val", {"Color": "b"})
    yield case("ShaderNodeMath", "Value", {"Value": "b"}, props={"operation": "ADD"})
    for mode in ("RGB", "HSV", "HSL"):
        inputs = {"Red": "b.x", "Green": "b.y", "Blue": "b.z"}
        yield case("ShaderNodeCombineColor", "Color", inputs, props={"mode": mode})
        for output in ("Red", "Green", "Blue"):
            yield case("ShaderNodeSeparateColor", output, {"Color": "b"}, props={"mode": mode})
    yield case("ShaderNodeBlackbody", "Color", {"Temperature": 5500.0})
    for kelvin in (900.0, 1800.0, 3000.0, 6500.0, 11000.0):
        yield case("ShaderNodeBlackbody", "Color", {"Temperature": kelvin})
    for length in (420.0, 480.0, 550.0, 600.0, 650.0):
        yield case("ShaderNodeWavelength", "Color", {"Wavelength": length})


def vectors():
    """Mapping, Vector Rotate, Normal, Combine and Separate."""
    turn = [0.4, -1.1, 2.3]
    for kind in ("POINT", "TEXTURE", "VECTOR", "NORMAL"):
        inputs = {"Vector": "a", "Rotation": turn, "Scale": [2.0, 0.5, -1.5]}
        if kind in ("POINT", "TEXTURE"):
            inputs["Location"] = [0.3, -0.2, 1.0]
        yield case("ShaderNodeMapping", "Vector", inputs, props={"vector_type": kind})
        inputs = {**inputs, "Rotation": "c"}
        yield case("ShaderNodeMapping", "Vector", inputs, props={"vector_type": kind})
    for invert in (False, True):
        for kind in ("AXIS_ANGLE", "X_AXIS", "Y_AXIS", "Z_AXIS", "EULER_XYZ"):
            inputs = {"Vector": "a", "Center": [0.5, 0.2, -0.1]}
            if kind == "EULER_XYZ":
                inputs["Rotation"] = turn
            else:
                inputs["Angle"] = "b.x"
            if kind == "AXIS_ANGLE":
                inputs["Axis"] = "c"
            props = {"rotation_type": kind, "invert": invert}
            yield case("ShaderNodeVectorRotate", "Vector", inputs, props=props)
    yield case("ShaderNodeNormal", "Dot", {"Normal": "a"}, value=[0.36, 0.48, 0.8])
    yield case("ShaderNodeCombineXYZ", "Vector", {"X": "a.z", "Y": "b.x", "Z": "c.y"})


def tables():
    """Ramps and curves."""
    stops = [(0.1, (0.1, 0.2, 0.9, 1.0)), (0.45, (0.9, 0.4, 0.1, 0.5)), (0.8, (0.0, 1.0, 0.3, 0.0))]
    yield case("ShaderNodeValToRGB", "Color", {"Fac": "b.x"}, stops=stops)
    yield case("ShaderNodeValToRGB", "Alpha", {"Fac": "a.x"}, stops=stops)
    points = [[(0.3, 0.7)], [(0.6, 0.2)], [(0.5, 0.5)], [(0.4, 0.6)]]
    yield case("ShaderNodeRGBCurve", "Color", {"Color": "b", "Fac": 0.8}, curves=points)
    yield case("ShaderNodeVectorCurve", "Vector", {"Vector": "b", "Fac": 1.0}, curves=points[:3])
    yield case("ShaderNodeFloatCurve", "Value", {"Value": "b.x", "Factor": 0.7}, curves=points[:1])


def noises():
    """Noise and White Noise."""
    for dims in ("1D", "2D", "3D", "4D"):
        inputs = {"Scale": 3.0, "Detail": 2.6, "Roughness": 0.6, "Lacunarity": 2.1}
        if dims != "1D":
            inputs["Vector"] = "a"
        if dims in ("1D", "4D"):
            inputs["W"] = "b.x"
        for kind in ("FBM", "MULTIFRACTAL", "HYBRID_MULTIFRACTAL", "RIDGED_MULTIFRACTAL", "HETERO_TERRAIN"):
            props = {"noise_dimensions": dims, "noise_type": kind, "normalize": kind == "FBM"}
            more = {**inputs, "Distortion": 0.7 if kind == "FBM" else 0.0}
            if kind != "FBM":
                more |= {"Offset": 0.4, "Gain": 1.3}
            yield case("ShaderNodeTexNoise", "Fac", more, props=props)
        props = {"noise_dimensions": dims, "noise_type": "FBM", "normalize": False}
        far = {**inputs, "Vector": "c"} if dims != "1D" else inputs
        yield case("ShaderNodeTexNoise", "Color", far, props=props)
    for dims in ("1D", "2D", "3D", "4D"):
        inputs = {"Vector": [0.5, -1.25, 3.0]} if dims != "1D" else {}
        if dims in ("1D", "4D"):
            inputs["W"] = 0.75
        for output in ("Value", "Color"):
            yield case("ShaderNodeTexWhiteNoise", output, inputs, props={"noise_dimensions": dims})


def voronois():
    """Voronoi."""
    for dims in ("1D", "2D", "3D", "4D"):
        base = {"Scale": 2.5, "Randomness": 0.9}
        if dims != "1D":
            base["Vector"] = "a"
        if dims in ("1D", "4D"):
            base["W"] = "b.x"
        for feature in ("F1", "F2", "SMOOTH_F1"):
            for output in ("Distance", "Color", "Position") + (("W",) if dims in ("1D", "4D") else ()):
                if dims == "1D" and output == "Position":
                    continue
                inputs = dict(base)
                if feature == "SMOOTH_F1":
                    inputs["Smoothness"] = 0.6
                props = {"voronoi_dimensions": dims, "feature": feature}
                yield case("ShaderNodeTexVoronoi", output, inputs, props=props)
        for feature in ("DISTANCE_TO_EDGE", "N_SPHERE_RADIUS"):
            output = "Distance" if feature == "DISTANCE_TO_EDGE" else "Radius"
            props = {"voronoi_dimensions": dims, "feature": feature}
            yield case("ShaderNodeTexVoronoi", output, base, props=props)
        octaves = {**base, "Detail": 2.3, "Roughness": 0.6, "Lacunarity": 1.9}
        for feature in ("F1", "DISTANCE_TO_EDGE"):
            for output in ("Distance",) if feature != "F1" else ("Distance", "Color"):
                props = {"voronoi_dimensions": dims, "feature": feature, "normalize": True}
                yield case("ShaderNodeTexVoronoi", output, octaves, props=props)
        if dims != "1D":
            for metric in ("MANHATTAN", "CHEBYCHEV", "MINKOWSKI"):
                for feature in ("F1", "F2", "SMOOTH_F1"):
                    if feature == "SMOOTH_F1" and dims == "4D":
                        continue
                    inputs = {**base, **({"Exponent": 1.7} if metric == "MINKOWSKI" else {})}
                    props = {"voronoi_dimensions": dims, "feature": feature, "distance": metric}
                    props["normalize"] = True
                    yield case("ShaderNodeTexVoronoi", "Distance", inputs, props=props)


def patterns():
    """Wave, Gradient, Checker, Brick, Magic."""
    for profile in ("SIN", "SAW", "TRI"):
        for kind, name, directions in (
            ("BANDS", "bands_direction", ("X", "Y", "Z", "DIAGONAL")),
            ("RINGS", "rings_direction", ("X", "Y", "Z", "SPHERICAL")),
        ):
            for direction in directions:
                props = {"wave_type": kind, name: direction, "wave_profile": profile}
                inputs = {"Vector": "a", "Scale": 0.7, "Phase Offset": 0.3}
                inputs["Distortion"] = 1.4 if direction in ("X", "SPHERICAL") else 0.0
                yield case("ShaderNodeTexWave", "Fac", inputs, props=props)
    for kind in ("LINEAR", "QUADRATIC", "EASING", "DIAGONAL", "RADIAL", "QUADRATIC_SPHERE", "SPHERICAL"):
        for vector in ("a", "b"):
            yield case("ShaderNodeTexGradient", "Fac", {"Vector": vector}, props={"gradient_type": kind})
    yield case("ShaderNodeTexChecker", "Fac", {"Vector": "c", "Scale": 1.3})
    yield case("ShaderNodeTexChecker", "Color", {"Vector": "a", "Scale": 5.0, "Color1": "b"})
    for output in ("Color", "Fac"):
        inputs = {"Vector": "a", "Scale": 2.0, "Mortar Size": 0.05, "Mortar Smooth": 0.4, "Bias": 0.1}
        props = {"offset": 0.3, "offset_frequency": 2, "squash": 1.4, "squash_frequency": 3}
        yield case("ShaderNodeTexBrick", output, inputs, props=props)
    for depth in range(0, 11):
        inputs = {"Vector": "a", "Scale": 0.8, "Distortion": 1.2}
        yield case("ShaderNodeTexMagic", "Color", inputs, props={"turbulence_depth": depth})


CASES = [
    *math(), *vector_math(), *mixes(), *ranges(), *colors(), *vectors(), *tables(), *noises(),
    *voronois(), *patterns(),
]
