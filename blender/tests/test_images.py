"""Images: the bytes that Blender has."""

import os
import tempfile

import bpy
import numpy as np

from matcha_export import encode, images

from .exported import SceneTest


class Images(SceneTest):
    def textured(self, image):
        """A material that shows the image as colour."""
        tree, color = self.surface()
        node = tree.nodes.new("ShaderNodeTexImage")
        node.image = image
        tree.links.new(node.outputs["Color"], color)
        return node

    def file(self, data, name):
        """A file beside, whose folder is not the exported one's."""
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        path = os.path.join(folder.name, name)
        with open(path, "wb") as out:
            out.write(data)
        return path

    def picture(self, width=3, height=2):
        """Distinct pixels, top row first."""
        return np.arange(width * height * 4, dtype=np.uint8).reshape(height, width, 4) * 5

    def test_file_bytes_are_kept(self):
        data = encode.png(self.picture())
        image = bpy.data.images.load(self.file(data, "a.png"))
        image.colorspace_settings.name = "Non-Color"
        self.textured(image).extension = "CLIP"
        file = self.export()
        (entry,) = file.root["images"]
        self.assertEqual((entry["colorspace"], entry["mime"]), ("Non-Color", "image/png"))
        self.assertEqual(file.view(file.json["images"][entry["source"]]["bufferView"]), data)
        node = next(n for n in file.tree("material")["nodes"] if n["type"] == "ShaderNodeTexImage")
        self.assertEqual((node["image"], node["props"]["extension"]), (0, "CLIP"))

    def test_packed_bytes_are_kept(self):
        data = encode.png(self.picture())
        path = self.file(data, "a.png")
        image = bpy.data.images.load(path)
        image.pack()
        os.remove(path)
        self.textured(image)
        file = self.export()
        self.assertEqual(file.view(file.json["images"][0]["bufferView"]), data)

    def test_webp_files_count_as_multiplied_by_alpha_unless_they_are_packed(self):
        # The exporter looks at the first bytes only.
        path = self.file(b"RIFF\0\0\0\0WEBPVP8L", "a.webp")
        for pack, wanted in ((False, "PREMUL"), (True, "STRAIGHT")):
            image = bpy.data.images.load(path)
            image.alpha_mode = "STRAIGHT"
            if pack:
                image.pack()
            self.assertEqual(images.alpha_mode(image, "image/webp", self.fail), wanted)

    def test_equal_files_are_stored_once(self):
        data = encode.png(self.picture())
        first = bpy.data.images.load(self.file(data, "a.png"))
        second = bpy.data.images.load(self.file(data, "b.png"))
        second.colorspace_settings.name = "Non-Color"
        node = self.textured(first)
        other = node.id_data.nodes.new("ShaderNodeTexImage")
        other.image = second
        node.id_data.links.new(other.outputs["Color"], node.inputs["Vector"])
        file = self.export()
        self.assertEqual([entry["source"] for entry in file.root["images"]], [0, 0])

    def test_generated_image(self):
        image = bpy.data.images.new("made", 3, 2, alpha=True)
        wanted = self.picture()
        image.pixels.foreach_set((wanted[::-1].astype(np.float32) / 255).ravel())
        self.textured(image)
        file = self.export()
        data = file.view(file.json["images"][0]["bufferView"])
        self.assertEqual(data, encode.png(wanted))
        np.testing.assert_allclose(self.read_back(data, "a.png"), wanted / 255, atol=1e-6)

    def test_float_image(self):
        image = bpy.data.images.new("bright", 3, 2, alpha=True, float_buffer=True)
        wanted = (np.arange(24, dtype=np.float32) * 0.7).reshape(2, 3, 4)
        image.pixels.foreach_set(wanted[::-1].ravel())
        self.textured(image)
        file = self.export()
        (entry,) = file.root["images"]
        self.assertEqual(entry["mime"], "image/x-exr")
        self.assertNotIn("images", file.json)
        got = self.read_back(file.view(entry["bufferView"]), "a.exr")
        np.testing.assert_allclose(got, wanted, rtol=1e-6)

    def read_back(self, data, name):
        """Blender's reading of a file, top row first."""
        image = bpy.data.images.load(self.file(data, name))
        width, height = image.size
        return np.array(image.pixels[:]).reshape(height, width, 4)[::-1]

    def test_missing_file(self):
        image = bpy.data.images.load(self.file(encode.png(self.picture()), "a.png"))
        image.filepath = "/nowhere/lost.png"
        node = self.textured(image)
        file = self.export()
        (entry,) = file.root["images"]
        self.assertTrue(entry["missing"])
        self.assertNotIn("source", entry)
        (warning,) = [text for text in file.warnings if "lost.png" in text]
        self.assertIn(f"material, node {node.name}", warning)

    def test_broken_file(self):
        image = bpy.data.images.load(self.file(b"no picture at all, just words", "a.png"))
        self.textured(image)
        file = self.export()
        self.assertTrue(file.root["images"][0]["missing"])
        self.assertTrue(any("unknown format" in text for text in file.warnings))
