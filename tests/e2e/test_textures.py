"""A scan with a colour camera of its own becomes a mesh with a texture, in every format that has one."""

import json
import struct

import harness
from harness import FAILED, USAGE

SCAN = ("simulate", "builtin:doll", "--height", "100mm", "--frames", "10", "--distance", "0.6m",
        "--noise", "none", "--platter-radius", "80mm", "--scan-colour")
CAMERA = ("--colour-width", "320", "--colour-fov", "20deg", "--colour-drift", "0.2")
COARSE = ("--voxel-size", "3mm")


def gltf_of(path):
    data = path.read_bytes()
    return json.loads(data[20:20 + struct.unpack_from("<I", data, 12)[0]])


class Textures(harness.TestCase):
    def test_a_texture_comes_out_of_every_format_that_has_one(self):
        self.ok(*SCAN, *CAMERA, "--out", "rec")
        text = self.ok("reconstruct", "rec", *COARSE, "--texture", "-o", "m.glb",
                       "--report", "r.json").stdout
        self.assertIn("Texture: ", text)
        texture = json.loads((self.dir / "r.json").read_text())["objects"][0]["texture"]
        self.assertEqual(texture["views"], 10)
        self.assertEqual(len(texture["gains"]), 10)
        self.assertGreater(max(g[1] for g in texture["gains"]), 1.05)
        self.assertLess(texture["filled_share"], 0.5)
        self.assertEqual(len(texture["colour_cameras"]), 1)
        gltf = gltf_of(self.dir / "m.glb")
        self.assertEqual(len(gltf["images"]), 1)
        self.assertIn("TEXCOORD_0", gltf["meshes"][0]["primitives"][0]["attributes"])

        for name in ("m.obj", "m.3mf"):
            self.ok("reconstruct", "rec", *COARSE, "--texture", "--texture-size", "256", "-o", name)
        self.assertTrue((self.dir / "m.mtl").is_file() and (self.dir / "m.png").is_file())
        for name in ("m.glb", "m.obj", "m.3mf"):
            mesh = json.loads(self.ok("info", name, "--json").stdout)["objects"][0]
            self.assertEqual(len(set(mesh["texture_px"])), 1, name)
            self.assertTrue(mesh["watertight"], f"{name}: the seams are open")
        self.assertIn("texture of 256 x 256", self.ok("info", "m.obj").stdout)
        self.ok("render", "m.obj", "--picture-width", "64", "--picture-height", "64", "-o", "p.png")

    def test_what_cannot_have_a_texture_is_refused(self):
        self.ok(*SCAN[:-1], "--out", "rec")
        for name in ("m.stl", "m.ply"):
            self.refused(USAGE, "reconstruct", "rec", "--texture", "-o", name, says="no texture")
        self.refused(FAILED, "reconstruct", "rec", "--texture", "-o", "m.glb", says="no colour images")
        self.assertFalse((self.dir / "m.glb").exists())


if __name__ == "__main__":
    harness.main()
