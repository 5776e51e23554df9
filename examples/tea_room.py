"""Builds the tea room and exports it.

    python tea_room.py tea_room.glb [--blend scene.blend]        (a Python with bpy)
"""

import argparse
import os
import sys

import bpy

HERE = os.path.dirname(os.path.abspath(__file__))
sys.path[:0] = [HERE, os.path.join(HERE, "..", "blender")]

from matcha_export import report, scene  # noqa: E402
from tea_room import graph, light, room, tea_things  # noqa: E402


def build():
    """The whole scene, in an empty file."""
    bpy.ops.wm.read_factory_settings(use_empty=True)
    room.build()
    tea_things.build()
    light.build()


def print_materials():
    sizes = sorted((graph.expanded(m.node_tree), m.name) for m in bpy.data.materials if m.node_tree)
    for nodes, name in sizes:
        print(f"{nodes:4} nodes  {name}")
    print(f"{sum(40 <= n <= 150 for n, _ in sizes)} materials of 40 to 150 nodes")


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("glb", help="file to write")
    parser.add_argument("--blend", help="also save the scene as a .blend file")
    asked = parser.parse_args()
    build()
    print_materials()
    size = scene.export(os.path.abspath(asked.glb), report.Report(False))
    print(f"{asked.glb}: {size / 1e6:.2f} MB")
    if asked.blend:
        bpy.ops.wm.save_as_mainfile(filepath=os.path.abspath(asked.blend))


if __name__ == "__main__":
    main()
    sys.stdout.flush()
    os._exit(0)  # some builds of bpy hang while Python shuts down
