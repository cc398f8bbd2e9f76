"""A scan with a colour camera of its own becomes a mesh with a texture, in every format that has one."""

import base64
import json
import os
import shutil
import struct
import subprocess
import unittest
import zlib

import browser
import harness
import recordings
from harness import FAILED, NARROW, ROOT, USAGE

SCAN = ("--height", "100mm", "--frames", "10", "--distance", "0.6m",
        "--noise", "none", "--platter-radius", "80mm", *NARROW, "--scan-colour")
COARSE = ("--voxel-size", "3mm")
LOADERS = ROOT / "web" / "node_modules" / "three" / "examples" / "jsm" / "loaders"
VALIDATOR = ROOT / "web" / "node_modules" / "gltf-validator"
TURN = ("render", "m.obj", "--picture-width", "61", "--picture-height", "47", "--picture-samples", "1")


# Cells, whether they have places in a picture, pictures, and what VTK says of the file.
VTK_READS = """
import sys
from vtkmodules.vtkCommonCore import vtkOutputWindow, vtkStringOutputWindow
from vtkmodules.vtkIOGeometry import vtkGLTFReader
window = vtkStringOutputWindow()
vtkOutputWindow.SetInstance(window)
reader = vtkGLTFReader()
reader.SetFileName(sys.argv[1])
reader.Update()
mesh = reader.GetOutput()
while hasattr(mesh, "GetBlock"):
    mesh = mesh.GetBlock(0)
print(mesh.GetNumberOfCells(), mesh.GetPointData().GetTCoords() is not None, reader.GetNumberOfTextures(),
      window.GetOutput())
"""


def has_vtk():
    """Debian's module (python3-vtk9) is one of the system's Python."""
    return subprocess.run(["/usr/bin/python3", "-c", "import vtkmodules.vtkIOGeometry"],
                          capture_output=True).returncode == 0


def gltf_of(path):
    data = path.read_bytes()
    return json.loads(data[20:20 + struct.unpack_from("<I", data, 12)[0]])


class Textures(harness.TestCase):
    def test_a_texture_comes_out_of_every_format_that_has_one(self):
        recordings.link("colour-doll", self.dir / "rec")
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

    def test_the_highlight_of_a_lamp_is_named_and_taken_out(self):
        frames = ("--frames", "36", "--colour-width", "640", "--colour-fov", "20deg", "--colour-lamp-azimuth", "40deg", "--colour-lamp-elevation", "50deg")
        self.ok("simulate", recordings.mesh_of("doll"), *SCAN, *frames, "--colour-gloss", "0.6", "--out", "glossy")
        self.ok("simulate", recordings.mesh_of("doll"), *SCAN, *frames, "--out", "dull")

        def highlight_of(recording):
            text = self.ok("reconstruct", recording, "--texture", "-o", f"{recording}.glb",
                           "--report", "r.json").stdout
            found = json.loads((self.dir / "r.json").read_text())["objects"][0]["texture"]["highlight"]
            self.assertEqual("Highlight of a lamp" in text, found is not None)
            return found

        found = highlight_of("glossy")
        self.assertAlmostEqual(found["azimuth_deg"], 40, delta=12)
        self.assertAlmostEqual(found["elevation_deg"], 50, delta=12)
        self.assertIsNone(highlight_of("dull"))

    @unittest.skipUnless(shutil.which("node") and VALIDATOR.is_dir(),
                         "Khronos' validator is not installed (scripts/setup page)")
    def test_khronos_validator_finds_nothing_in_glb_files(self):
        recordings.link("colour-doll", self.dir / "rec")
        self.ok("reconstruct", "rec", *COARSE, "-o", "plain.glb")
        self.ok("reconstruct", "rec", *COARSE, "--colour", "-o", "colours.glb")
        self.ok("reconstruct", "rec", *COARSE, "--texture", "--texture-size", "256", "-o", "texture.glb")
        (self.dir / "damaged.glb").write_bytes((self.dir / "plain.glb").read_bytes()[:-64])

        def validated(*names):
            return subprocess.run(["node", str(ROOT / "web" / "validate.mjs"), *names], cwd=self.dir, text=True,
                                  capture_output=True, timeout=60)
        found = validated("plain.glb", "colours.glb", "texture.glb")
        self.assertEqual((found.returncode, found.stderr), (0, ""), found.stdout)
        self.assertIn("1 images", found.stdout)
        self.assertEqual(validated("damaged.glb").returncode, 1)

    @unittest.skipUnless(shutil.which("node") and LOADERS.is_dir() and browser.find(),
                         "three.js or a browser is not installed (scripts/setup page test)")
    def test_three_js_loads_what_is_written(self):
        recordings.link("colour-doll", self.dir / "rec")
        self.ok("reconstruct", "rec", *COARSE, "--colour", "-o", "colours.glb")
        for name in ("texture.glb", "texture.3mf"):
            self.ok("reconstruct", "rec", *COARSE, "--texture", "--texture-size", "256", "-o", name)
        subprocess.run(["node", str(ROOT / "web" / "bundle.mjs"), "load.bundle.js", "load.js"], cwd=self.dir,
                       check=True, timeout=60)
        (self.dir / "load.html").write_text('<!doctype html><script src="load.bundle.js"></script>\n')
        with browser.Browser() as program:
            page = program.open(self.dir / "load.html")

            def loaded(name):
                data = base64.b64encode((self.dir / name).read_bytes()).decode()
                meshes = page.evaluate(f"load({name.rpartition('.')[2]!r}, {data!r})")
                self.assertEqual(page.complaints(), [], name)
                self.assertEqual(len(meshes), 1, name)
                mesh = json.loads(self.ok("info", name, "--json").stdout)["objects"][0]
                self.assertEqual(meshes[0]["triangles"], mesh["triangles"], name)
                return meshes[0]
            colours = loaded("colours.glb")
            self.assertEqual((colours["colours"], colours["picture"]), (True, None))
            for name in ("texture.glb", "texture.3mf"):
                self.assertEqual(loaded(name)["picture"], [256, 256, "srgb"], name)

    @unittest.skipUnless(has_vtk(), "VTK for Python is not installed")
    def test_vtk_reads_a_textured_glb_without_a_word(self):
        recordings.link("colour-doll", self.dir / "rec")
        self.ok("reconstruct", "rec", *COARSE, "--texture", "--texture-size", "256", "-o", "m.glb")
        read = subprocess.run(["/usr/bin/python3", "-c", VTK_READS, "m.glb"], cwd=self.dir, text=True,
                              capture_output=True, timeout=60)
        triangles = json.loads(self.ok("info", "m.glb", "--json").stdout)["objects"][0]["triangles"]
        self.assertEqual((read.stdout.strip(), read.stderr), (f"{triangles} True 1", ""))

    @unittest.skipUnless(shutil.which("prusa-slicer"), "prusa-slicer is not installed")
    def test_a_slicer_takes_a_textured_3mf(self):
        recordings.link("colour-doll", self.dir / "rec")
        self.ok("reconstruct", "rec", *COARSE, "--texture", "--texture-size", "256", "-o", "m.3mf")
        said = subprocess.run(["prusa-slicer", "--info", "m.3mf"], cwd=self.dir, text=True, capture_output=True,
                              timeout=120)
        lines = [line.split("=") for line in said.stdout.splitlines() if line.count("=") == 1]
        facts = {name.strip(): value.strip() for name, value in lines}
        triangles = json.loads(self.ok("info", "m.3mf", "--json").stdout)["objects"][0]["triangles"]
        self.assertEqual((said.returncode, facts.get("manifold"), facts.get("number_of_parts")), (0, "yes", "1"),
                         said.stdout + said.stderr)
        self.assertEqual(facts["number_of_facets"], str(triangles))

    def test_what_cannot_have_a_texture_is_refused(self):
        self.ok("simulate", recordings.mesh_of("doll"), *SCAN[:-1], "--out", "rec")
        for name in ("m.stl", "m.ply"):
            self.refused(USAGE, "reconstruct", "rec", "--texture", "-o", name, says="no texture")
        self.refused(FAILED, "reconstruct", "rec", "--texture", "-o", "m.glb", says="no colour images")
        self.assertFalse((self.dir / "m.glb").exists())


class TurningPictures(harness.TestCase):
    """A body that looks different from all sides."""

    def setUp(self):
        super().setUp()
        corners = [(2 * x, y, z) for x in (0, 1) for y in (0, 1) for z in (0, 1)]
        corners[7] = (3, 1, 2)
        sides = [(0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)]
        lines = ["v %d %d %d" % c for c in corners]
        lines += ["f " + " ".join(str(i + 1) for i in side) for side in sides]
        (self.dir / "m.obj").write_text("\n".join(lines) + "\n")

    def test_an_animation_needs_no_other_program(self):
        self.ok(*TURN, "--turn-frames", "8", "--turn-time", "2s", "--turntable", "t.png", env={"PATH": "/nowhere"})
        data, at, chunks = (self.dir / "t.png").read_bytes(), 8, []
        while at < len(data):
            size, = struct.unpack_from(">I", data, at)
            name, content = data[at + 4:at + 8], data[at + 8:at + 8 + size]
            self.assertEqual(struct.unpack_from(">I", data, at + 8 + size)[0], zlib.crc32(name + content))
            chunks.append((name, content))
            at += 12 + size
        self.assertEqual([c for n, c in chunks if n == b"acTL"], [struct.pack(">II", 8, 0)])
        controls = [struct.unpack(">IIIIIHHBB", c) for n, c in chunks if n == b"fcTL"]
        self.assertEqual([c[1:7] for c in controls], [(61, 47, 0, 0, 250, 1000)] * 8)
        shown = [zlib.decompress(c) for n, c in chunks if n == b"IDAT"]
        shown += [zlib.decompress(c[4:]) for n, c in chunks if n == b"fdAT"]
        self.assertEqual(len(shown), 8)
        self.assertEqual(len(set(shown)), 8)

    def test_a_video_is_made_by_ffmpeg_or_refused_at_once(self):
        self.refused(FAILED, *TURN, "--turntable", "t.mp4", env={"PATH": "/nowhere"}, says="ffmpeg")
        broken = self.dir / "bin" / "ffmpeg"
        broken.parent.mkdir()
        broken.write_text("#!/bin/sh\ncase \"$*\" in *-version*) exit 0;; esac\necho no such encoder >&2\nexit 1\n")
        broken.chmod(0o755)
        self.refused(FAILED, *TURN, "--turn-frames", "2", "--turntable", "t.mp4",
                     env={"PATH": f"{broken.parent}:{os.environ['PATH']}"}, says="no such encoder")
        self.assertFalse((self.dir / "t.mp4").exists())
        if not shutil.which("ffmpeg"):
            return
        self.ok(*TURN, "--turn-frames", "6", "--turntable", "t.mp4")
        video = (self.dir / "t.mp4").read_bytes()
        self.assertEqual(video[4:8], b"ftyp")
        self.assertLess(video.index(b"moov"), video.index(b"mdat"), "it does not play while it loads")

    def test_what_makes_no_sense_is_refused(self):
        self.refused(USAGE, "render", "m.obj", says="nothing to write")
        self.refused(USAGE, *TURN, "--turntable", "t.gif", says=".mp4 or .png")
        self.refused(USAGE, *TURN, "--turntable", "t.png", "--picture-views", "2", says="one view")
        self.refused(USAGE, *TURN, "--turntable", "t.png", "--side-by-side", says="one view")


if __name__ == "__main__":
    harness.main()
