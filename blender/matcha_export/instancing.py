"""Placements of meshes as glTF nodes, many copies as EXT_mesh_gpu_instancing."""

import json
from dataclasses import dataclass

import numpy as np

from . import axes

MANY = 64
EXTENSION = "EXT_mesh_gpu_instancing"


@dataclass
class Placement:
    """One copy of a mesh; the matrix is in glTF's axes."""

    mesh: int
    matrix: np.ndarray
    random: float
    about: dict


def nodes(glb, placements):
    """Appends a node for each placement or crowd of copies; returns the roots."""
    crowds = {}
    for placement in placements:
        key = (placement.mesh, json.dumps(placement.about, sort_keys=True))
        crowds.setdefault(key, []).append(placement)
    roots = []
    for crowd in crowds.values():
        if len(crowd) > MANY:
            parts = [axes.decompose(p.matrix) for p in crowd]
            regular = [(p, part) for p, part in zip(crowd, parts) if part is not None]
            if len(regular) > MANY:
                roots.append(crowd_node(glb, regular))
                crowd = [p for p, part in zip(crowd, parts) if part is None]
        roots.extend(single_node(glb, placement) for placement in crowd)
    return roots


def single_node(glb, placement):
    """A node, with a child for a sheared matrix; returns the outer one's index."""
    chain = axes.node_chain(placement.matrix)
    node = {**chain[-1], **content(placement)}
    node["extensions"]["MATCHA_cycles"]["object"]["random"] = placement.random
    index = glb.append("nodes", node)
    if len(chain) == 2:
        index = glb.append("nodes", {"name": node["name"], **chain[0], "children": [index]})
    return index


def crowd_node(glb, regular):
    """One node for many copies; what differs between them are accessors."""
    glb.use(EXTENSION)

    def column(values):
        return glb.accessor(np.array(values, dtype=np.float32), None)

    node = content(regular[0][0])
    node["extensions"][EXTENSION] = {
        "attributes": {
            "TRANSLATION": column([part[0] for _, part in regular]),
            "ROTATION": column([part[1] for _, part in regular]),
            "SCALE": column([part[2] for _, part in regular]),
            "_RANDOM": column([placement.random for placement, _ in regular]),
        }
    }
    return glb.append("nodes", node)


def content(placement):
    """What the node shows."""
    return {
        "name": placement.about["name"],
        "mesh": placement.mesh,
        "extensions": {"MATCHA_cycles": {"object": dict(placement.about)}},
    }
