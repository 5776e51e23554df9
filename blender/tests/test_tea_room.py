"""The committed example is what it promises: small, and rich in materials."""

import os
import unittest

from tests.exported import Exported

PATH = os.path.join(os.path.dirname(__file__), "..", "..", "examples", "tea_room.glb")
NOT_CALCULATING = {"ShaderNodeGroup", "NodeGroupInput", "NodeGroupOutput", "NodeReroute", "NodeFrame"}


def expanded(trees, index):
    """Number of nodes of a tree, each group counted by what is in it."""
    nodes = trees[index]["nodes"]
    inner = sum(expanded(trees, node["tree"]) for node in nodes if node["type"] == "ShaderNodeGroup")
    return inner + sum(node["type"] not in NOT_CALCULATING for node in nodes)


class TeaRoom(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        with open(PATH, "rb") as file:
            cls.data = file.read()
        cls.scene = Exported(cls.data)

    def sizes(self):
        """Nodes of each material that some mesh uses."""
        used = {p["material"] for mesh in self.scene.json["meshes"] for p in mesh["primitives"]}
        materials = [self.scene.json["materials"][i] for i in sorted(used)]
        trees = self.scene.root["trees"]
        return {m["name"]: expanded(trees, m["extensions"]["MATCHA_cycles"]["tree"]) for m in materials}

    def test_materials_are_networks(self):
        sizes = self.sizes()
        rich = [name for name, nodes in sizes.items() if 40 <= nodes <= 150]
        self.assertGreaterEqual(len(rich), 16, sizes)
        self.assertLessEqual(max(sizes.values()), 150, sizes)

    def test_file_is_small(self):
        self.assertLess(len(self.data), 8_000_000)
        triangles = sum(self.scene.triangles(i) for i in range(len(self.scene.json["meshes"])))
        self.assertLess(triangles, 300_000)

    def test_textures_are_drawn(self):
        images = self.scene.root["images"]
        self.assertGreaterEqual(len(images), 6)
        self.assertFalse([image["name"] for image in images if image.get("missing")])


if __name__ == "__main__":
    unittest.main()
