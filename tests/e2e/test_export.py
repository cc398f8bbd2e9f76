"""Images and poses for other programs, read here as those programs document them: what the poses and
intrinsics say of the mesh's vertices is what the depth images and masks show. An export that is imported
again reconstructs to the same object."""

import functools
import json
import math
import pathlib
import struct
import zlib

import harness
import recordings
from harness import COARSE, FAILED, USAGE
from test_coverage import read_ply

LAYOUTS = ("colmap", "nerfstudio", "bop", "tum")


def read_png(path):
    """Rows of values of a grey PNG of 8 or 16 bits, as turnscan filters them: not at all, or by the row above."""
    data, at, packed = path.read_bytes(), 8, b""
    while at < len(data):
        size, kind = struct.unpack_from(">I4s", data, at)
        body = data[at + 8:at + 8 + size]
        if kind == b"IHDR":
            width, height, bits, colour = struct.unpack_from(">IIBB", body)
            assert colour == 0
        packed += body if kind == b"IDAT" else b""
        at += 12 + size
    raw, pitch, rows = zlib.decompress(packed), bits // 8 * width, []
    above = bytes(pitch)
    for y in range(height):
        kind, line = raw[y * (pitch + 1)], raw[y * (pitch + 1) + 1:(y + 1) * (pitch + 1)]
        assert kind in (0, 2)
        above = bytes((a + b) & 255 for a, b in zip(line, above)) if kind == 2 else line
        rows.append(struct.unpack(f">{width}H", above) if bits == 16 else above)
    return rows


def rotation(w, x, y, z):
    return [[1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
            [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
            [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)]]


def product(matrix, vector):
    return [sum(m * v for m, v in zip(row, vector)) for row in matrix]


def transposed(matrix):
    return [list(column) for column in zip(*matrix)]


class View:
    """Where an image sees a point of the mesh: u and v (the middle of the top left pixel at 0), and z."""

    def __init__(self, folder, camera, r, t, depth, unit_m, mask, to_world=None):
        self.camera, self.r, self.t, self.unit_m = camera, r, t, unit_m
        self.to_world = to_world
        self.depth = read_png(folder / depth) if depth else None
        self.mask = read_png(folder / mask) if mask else None

    def project(self, p):
        x, y, z = (a + b for a, b in zip(product(self.r, self.to_world(p) if self.to_world else p), self.t))
        fx, fy, cx, cy = self.camera
        return fx * x / z + cx, fy * y / z + cy, z


def colmap_views(folder, model="sparse"):
    def lines(name):
        return [line.split() for line in (folder / model / "0" / name).read_text().splitlines()
                if not line.startswith("#")]

    cameras = {}
    for number, kind, width, height, *k in lines("cameras.txt"):
        assert kind == "PINHOLE", kind
        fx, fy, cx, cy = map(float, k)
        cameras[number] = (fx, fy, cx - 0.5, cy - 0.5)
    images = lines("images.txt")
    assert all(line == [] for line in images[1::2])
    depth_here = model != "sparse" or not (folder / "sparse_depth").exists()
    for _, w, x, y, z, tx, ty, tz, camera, name in images[::2]:
        mask = f"masks/{name}.png"
        yield View(folder, cameras[camera], rotation(*map(float, (w, x, y, z))), [*map(float, (tx, ty, tz))],
                   f"depth/{name[:6]}.png" if depth_here else None, 1e-3,
                   mask if (folder / mask).exists() and model == "sparse" else None)


def nerfstudio_views(folder, name="transforms.json"):
    root = json.loads((folder / name).read_text())
    for frame in root["frames"]:
        k = {**root, **frame}
        matrix = frame["transform_matrix"]
        # Camera to world, x right, y up, z backward.
        columns = transposed([row[:3] for row in matrix[:3]])
        r = [columns[0], [-v for v in columns[1]], [-v for v in columns[2]]]
        yield View(folder, (k["fl_x"], k["fl_y"], k["cx"] - 0.5, k["cy"] - 0.5), r,
                   [-v for v in product(r, [row[3] for row in matrix[:3]])], frame.get("depth_file_path"),
                   root.get("depth_unit_scale_factor"), frame.get("mask_path"),
                   lambda p: (p[0], -p[2], p[1]))  # its world has z up


def bop_views(folder):
    scene = folder / "test/000001"
    cameras, truth = (json.loads((scene / f"scene_{name}.json").read_text()) for name in ("camera", "gt"))
    for key, camera in cameras.items():
        fx, _, cx, _, fy, cy, *_ = camera["cam_K"]
        (object,) = truth[key]
        r, t = object["cam_R_m2c"], object["cam_t_m2c"]
        assert (r, t) == (camera["cam_R_w2c"], camera["cam_t_w2c"])
        name = f"{int(key):06}"
        yield View(scene, (fx, fy, cx, cy), [r[:3], r[3:6], r[6:]], [v / 1000 for v in t],
                   f"depth/{name}.png", camera["depth_scale"] / 1000, f"mask/{name}_000000.png")


def tum_views(folder):
    def lines(name):
        return [line.split() for line in (folder / name).read_text().splitlines() if line[0] != "#"]

    k = [float(v) for v in (folder / "cam_K.txt").read_text().split()]
    poses = {time: [*map(float, values)] for time, *values in lines("groundtruth.txt")}
    for time, depth in lines("depth.txt"):
        x, y, z, *q = poses[time]
        r = transposed(rotation(q[3], *q[:3]))
        yield View(folder, (k[0], k[4], k[2], k[5]), r, [-v for v in product(r, (x, y, z))], depth,
                   1 / 5000, depth.replace("depth", "mask"))


def meshroom_views(folder):
    root = json.loads((folder / "cameras.sfm").read_text())
    cameras = {camera["intrinsicId"]: camera for camera in root["intrinsics"]}
    poses = {pose["poseId"]: pose["pose"]["transform"] for pose in root["poses"]}
    for view in root["views"]:
        camera, pose = cameras[view["intrinsicId"]], poses[view["poseId"]]
        assert pathlib.Path(view["path"]).is_file()
        (fx, fy), (x, y) = camera["pxFocalLength"], camera["principalPoint"]
        r = [pose["rotation"][i::3] for i in range(3)]  # column by column
        yield View(folder, (fx, fy, x + camera["width"] / 2 - 0.5, y + camera["height"] / 2 - 0.5), r,
                   [-v for v in product(r, pose["center"])], None, None,
                   f"masks/{pathlib.Path(view['path']).stem}.png")


VIEWS = {"colmap": colmap_views, "nerfstudio": nerfstudio_views, "bop": bop_views, "tum": tum_views,
         "meshroom": meshroom_views}


@functools.lru_cache(maxsize=None)
def vertices_of(name):
    truth = recordings.folder_of(name) / "truth/object.ply"
    return [tuple(v[k] for k in "xyz") for v in read_ply(truth)["vertex"]]


class Export(harness.TestCase):
    def export(self, name, layout, *options):
        rec = recordings.folder_of(name)
        out = self.ok("export", rec, "--to", layout, "--mesh", rec / "truth/object.ply", "-o", layout,
                      *options).stdout
        return out, vertices_of(name)

    def check_depth(self, views, mesh, least):
        """Visible vertices lie where depth was measured, and none lies before it."""
        on = before = count = 0
        for view in views:
            for p in mesh[::max(1, len(mesh) // 400)]:
                u, v, z = view.project(p)
                column, row = round(u), round(v)
                self.assertTrue(0 <= row < len(view.depth) and 0 <= column < len(view.depth[0]))
                measured = view.depth[row][column] * view.unit_m
                if not measured:
                    continue
                count += 1
                on += abs(z - measured) < 0.002
                # At an edge the pixel may see what lies behind.
                around = [view.depth[y][x] * view.unit_m for y in range(row - 1, row + 2)
                          for x in range(column - 1, column + 2)]
                before += z < min(a for a in around if a) - 0.002
        self.assertGreater(on, least * count)
        self.assertLess(before, 0.01 * count)

    def check_masks(self, views, mesh):
        """The mask is as large as the mesh appears, and where it appears."""
        off = []
        for view in views:
            places = [view.project(p)[:2] for p in mesh]
            rows = [y for y, row in enumerate(view.mask) if any(row)]
            columns = [x for x, column in enumerate(zip(*view.mask)) if any(column)]
            for axis, seen in ((0, columns), (1, rows)):
                ends = min(p[axis] for p in places), max(p[axis] for p in places)
                self.assertTrue(-0.1 <= ends[1] - ends[0] - (seen[-1] - seen[0]) <= 3)
                off.append((seen[0] + seen[-1]) / 2 - sum(ends) / 2)
        self.assertLess(abs(sum(off) / len(off)), 0.2)

    def test_every_layout_shows_the_mesh_where_depth_and_masks_do(self):
        for layout in VIEWS:
            _, mesh = self.export("colour-doll", layout, "--every", 3)
            folder = self.dir / layout
            views = list(VIEWS[layout](folder))
            self.assertEqual(len(views), 4)
            self.check_masks(views, mesh)
            if layout == "colmap":
                views = list(colmap_views(folder, "sparse_depth"))
            if layout == "nerfstudio":
                views = list(nerfstudio_views(folder, "transforms_depth.json"))
            if layout != "meshroom":  # no program reads depth there
                self.check_depth(views, mesh, 0.25)

    def test_without_colour_the_poses_are_those_of_depth(self):
        for layout in LAYOUTS:
            out, mesh = self.export("skull", layout, "--every", 6)
            self.assertIn("0 colour images, 4 depth images, 4 masks", out)
            views = list(VIEWS[layout](self.dir / layout))
            self.check_masks(views, mesh)
            self.check_depth(views, mesh, 0.2)

    def test_a_lens_is_kept_where_the_layout_has_one_and_taken_out_elsewhere(self):
        (self.dir / "lens.toml").write_text(harness.SENSOR.read_text() + "k1 = 0.8\nk2 = -0.3\np1 = 0.004\n")
        self.ok("simulate", recordings.mesh_of("skull"), "--scanner", "lens.toml", "--height", "320mm",
                "--frames", 3, "--noise", "none", "-o", "rec", "--quiet")
        truth = self.dir / "rec/truth/object.ply"
        mesh = [tuple(v[k] for k in "xyz") for v in read_ply(truth)["vertex"]]
        for layout in LAYOUTS:
            out = self.ok("export", "rec", "--to", layout, "--mesh", truth, "-o", layout, "--quiet").stdout
            self.assertEqual("distortion was taken out" in out, layout in ("bop", "tum"))
        for layout in ("bop", "tum"):
            views = list(VIEWS[layout](self.dir / layout))
            self.check_masks(views, mesh)
            self.check_depth(views, mesh, 0.2)
        root = json.loads((self.dir / "nerfstudio/transforms.json").read_text())
        self.assertEqual([root[k] for k in ("k1", "k2", "p1", "p2", "k3")], [0.8, -0.3, 0.004, 0, 0])
        self.assertIn("FULL_OPENCV", (self.dir / "colmap/sparse/0/cameras.txt").read_text())

    def test_initial_points_are_the_mesh(self):
        _, mesh = self.export("colour-doll", "colmap")
        points = [line.split() for line in (self.dir / "colmap/sparse/0/points3D.txt").read_text().splitlines()
                  if line[0] != "#"]
        self.assertEqual(len(points), len(mesh))
        self.assertLess(math.dist([float(v) for v in points[7][1:4]], mesh[7]), 1e-6)
        self.export("colour-doll", "nerfstudio")
        cloud = read_ply(self.dir / "nerfstudio/sparse_pc.ply")["vertex"]
        self.assertLess(math.dist([cloud[7][k] for k in "xyz"], (mesh[7][0], -mesh[7][2], mesh[7][1])), 1e-6)
        self.export("colour-doll", "bop")
        model = read_ply(self.dir / "bop/models/obj_000001.ply")["vertex"]
        self.assertLess(math.dist([model[7][k] for k in "xyz"], [1000 * v for v in mesh[7]]), 1e-3)

    def share(self, mesh, truth):
        self.ok("evaluate", mesh, "--reference", truth, "--samples", 20000, "--thresholds", "1mm", "--json",
                "e.json", "--quiet")
        return json.loads((self.dir / "e.json").read_text())["scores"][0]["f"]

    def test_what_is_imported_again_is_the_same_object(self):
        rec = recordings.folder_of("skull")
        truth = rec / "truth/object.ply"
        self.ok("reconstruct", rec, *COARSE, "-o", "m.ply", "--quiet")
        native = self.share("m.ply", truth)
        for layout, scene in (("nerfstudio", "nerfstudio"), ("bop", "bop/test/000001"), ("tum", "tum")):
            self.ok("export", rec, "--to", layout, "-o", layout, "--quiet")
            # No layout says how large the platter is; its middle is that of their world.
            self.ok("reconstruct", scene, *COARSE, "--crop-radius", "150mm", "-o", f"{layout}.ply", "--quiet")
            self.assertGreater(self.share(f"{layout}.ply", truth), native - 0.02, layout)

    def test_depth_of_a_scene_with_masks_is_that_of_its_objects(self):
        self.export("skull", "bop", "--every", 12)
        scene = self.dir / "bop/test/000001"
        self.ok("import", scene, "--out", "all", "--quiet")
        (scene / "mask").rename(scene / "mask_visib")
        self.ok("import", scene, "--out", "masked", "--quiet")
        self.assertIn("mask_visib", (self.dir / "masked/recording.json").read_text())
        for i in range(2):
            mask = read_png(scene / f"mask_visib/{i:06}_000000.png")
            every, some = (read_png(self.dir / f"{name}/depth/{i:06}.png") for name in ("all", "masked"))
            self.assertEqual([list(row) for row in some],
                             [[d if m else 0 for d, m in zip(*rows)] for rows in zip(every, mask)])
        (scene / "mask_visib/000001_000000.png").unlink()
        self.refused(FAILED, "info", scene, says=["image 1 has no mask", "move the folder away"])

    def test_what_cannot_be_exported_is_refused(self):
        rec = recordings.folder_of("skull")
        self.refused(FAILED, "export", rec, "--to", "meshroom", "-o", "x", says="has no colour")
        self.refused(USAGE, "export", rec, "--to", "gltf", "-o", "x", says=["gltf", "nerfstudio"])
        self.refused(USAGE, "export", rec, "--to", "tum", "--pass", 3, "-o", "x", says="--pass 3")
        (self.dir / "far.obj").write_text("v 9 9 9\nv 9 9 8\nv 9 8 9\nf 1 2 3\n")
        self.refused(FAILED, "export", rec, "--to", "tum", "--mesh", "far.obj", "-o", "x",
                     says=["far.obj", "none of the images"])
        self.refused(USAGE, "export", rec, "--to", "tum", "--depth-unit", "10um", "-o", "x", says="longer step")
        twice = recordings.folder_of("skull-twice")
        self.refused(FAILED, "export", twice, "--to", "tum", "-o", "x", says="--pass")
        self.assertFalse((self.dir / "x").exists())
        self.ok("export", twice, "--to", "tum", "--pass", 1, "-o", "x", "--quiet")
        self.refused(FAILED, "export", twice, "--to", "tum", "--pass", 1, "-o", "x", says="has content")


if __name__ == "__main__":
    harness.main()
