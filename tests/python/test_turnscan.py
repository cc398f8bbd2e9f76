"""`import turnscan`: the same as the command line, with numpy's arrays.

PYTHONPATH names the folder of the package (CTest sets it), TURNSCAN_BIN the program.
"""

import gc
import json
import math
import os
import pathlib
import re
import signal
import subprocess
import sys
import tempfile
import threading
import time
import unittest

import numpy as np

import turnscan

ROOT = pathlib.Path(__file__).resolve().parents[2]
EXAMPLES = ROOT / "examples" / "python"
BIN = os.environ.get("TURNSCAN_BIN", "turnscan")
FAST = {"voxel_size": "6mm", "method": "volumetric"}


def memory_mb():
    pages = int(pathlib.Path("/proc/self/statm").read_text().split()[1])
    return pages * os.sysconf("SC_PAGESIZE") / 1e6


class InAFolder(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.kept = tempfile.TemporaryDirectory(prefix="turnscan-python-")
        cls.dir = pathlib.Path(cls.kept.name)
        cls.recording = str(cls.dir / "recording")
        cls.simulation = turnscan.simulate("builtin:cylinder", out=cls.recording, frames=24)

    @classmethod
    def tearDownClass(cls):
        cls.kept.cleanup()


class Recordings(InAFolder):
    def test_a_folder_of_another_program_is_opened_with_the_options_of_its_import(self):
        folder = self.dir / "views"
        folder.mkdir()
        for i, png in enumerate(sorted((pathlib.Path(self.recording) / "depth").iterdir())):
            (folder / f"depth_{i}.png").write_bytes(png.read_bytes())
        camera = turnscan.Recording(self.recording).sensors[0].intrinsics
        (folder / "views.json").write_text(json.dumps({
            "intrinsics": {name: getattr(camera, name)
                           for name in ("width", "height", "fx", "fy", "cx", "cy")},
            "times_s": [i / 30 for i in range(24)]}))
        with self.assertRaises(turnscan.Error):
            turnscan.Recording(str(folder))
        views = turnscan.Recording(str(folder), depth_unit="0.1mm")
        self.assertEqual((len(views), views.complete, views.sensors[0].depth_unit), (24, True, 1e-4))
        self.assertTrue((views[5].depth == turnscan.Recording(self.recording)[5].depth).all())
        self.assertIn("depth_unit", [option["name"] for option in turnscan.options("import")])
        with self.assertRaises(turnscan.Error):
            turnscan.Recording(self.recording, depth_unit="1mm")

    def test_frames_are_views_of_what_was_recorded(self):
        recording = turnscan.Recording(self.recording)
        self.assertEqual(len(recording), 24)
        self.assertTrue(recording.complete)
        frame = recording[3]
        self.assertEqual((frame.index, frame.depth.dtype, frame.depth.shape),
                         (3, np.uint16, (424, 512)))
        self.assertTrue((frame.depth == recording[3 - 24].depth).all())
        self.assertIs(frame.depth.base, frame, "no copy")
        with self.assertRaises(ValueError):
            frame.depth[0, 0] = 1
        depth = frame.depth
        del frame
        gc.collect()
        self.assertTrue((depth == recording[3].depth).all(), "a view keeps its frame")
        with self.assertRaises(IndexError):
            recording[24]
        self.assertEqual(sum(1 for _ in recording), 24)

    def test_cameras_poses_and_the_turntable_are_there(self):
        recording = turnscan.Recording(self.recording)
        sensor = recording.sensors[0]
        self.assertEqual((sensor.intrinsics.width, sensor.intrinsics.height), (512, 424))
        self.assertAlmostEqual(math.hypot(*recording.turntable.axis), 1.0)
        self.assertGreater(recording.turntable.radius, 0.1)

    def test_errors_have_a_code_and_a_path(self):
        with self.assertRaises(turnscan.Error) as caught:
            turnscan.Recording("nowhere")
        self.assertEqual(caught.exception.code, "not-found")
        self.assertIn("nowhere", caught.exception.path)
        with self.assertRaises(turnscan.OptionError) as caught:
            turnscan.reconstruct(self.recording, voxel_sise=1)
        self.assertIn("voxel-size", str(caught.exception))
        with self.assertRaises(ValueError):
            turnscan.reconstruct(self.recording, voxel_size="9km")
        with self.assertRaises(turnscan.OptionError):
            turnscan.reconstruct(self.recording, voxel_size=[1])


class Reconstructing(InAFolder):
    def command_line_mesh(self):
        out = self.dir / "command.ply"
        subprocess.run([BIN, "reconstruct", self.recording, "--voxel-size", "6mm", "--method",
                        "volumetric", "--out", out, "--quiet"], check=True, capture_output=True)
        return out.read_bytes()

    def test_numpy_frames_give_the_bytes_of_the_command_line(self):
        recording = turnscan.Recording(self.recording)
        frames = turnscan.Frames(recording.sensors, recording.turntable)
        for frame in recording:
            frames.add(np.array(frame.depth), frame.angle, time=frame.time, turn=frame.turn,
                       pose=frame.pose)
        made = turnscan.reconstruct(frames, **FAST)
        out = self.dir / "frames.ply"
        self.assertEqual(made.save(str(out)), [str(out)])
        self.assertEqual(out.read_bytes(), self.command_line_mesh())
        self.assertIn(made.verdicts[0], ("green", "amber", "red"))
        self.assertTrue(made.report["objects"][0]["mesh"]["watertight"])

    def test_frames_in_metres_are_rounded_to_the_sensors_unit(self):
        recording = turnscan.Recording(self.recording)
        unit = recording.sensors[0].depth_unit
        frames = turnscan.Frames(recording.sensors, recording.turntable)
        raw = recording[0].depth
        metres = raw * unit
        metres[raw == 0] = np.nan
        frames.add(metres, 0.0)
        self.assertTrue((frames[0].depth == np.where(raw < 65535, raw, 0)).all())
        with self.assertRaises(turnscan.Error):
            frames.add(np.zeros((3, 4), np.uint16))
        with self.assertRaises(turnscan.Error):
            frames.add(np.zeros(5, np.uint16))

    def refused(self, says, call, *args, **kwargs):
        with self.assertRaises((turnscan.Error, ValueError, TypeError, MemoryError)) as caught:
            call(*args, **kwargs)
        self.assertIn(says, str(caught.exception))

    def test_arrays_of_any_layout_are_read_and_what_numpy_would_cast_silently_is_refused(self):
        camera = turnscan.Intrinsics(8, 6, 10, 10, 4, 3)
        frames = turnscan.Frames([turnscan.Sensor(camera)])
        good = np.arange(1000, 1048, dtype=np.uint16).reshape(6, 8)
        frozen = good.copy()
        frozen.flags.writeable = False
        for depth in (good, frozen, np.asfortranarray(good), good[::-1, ::-1], good.astype(">u2"),
                      good.astype(np.int64), np.broadcast_to(np.uint16(7), (6, 8)),
                      good.repeat(2, axis=1)[:, ::2]):
            frames.add(depth)
            self.assertTrue((frames[len(frames) - 1].depth == depth).all())
        count = len(frames)
        huge = (1 << 20, 1 << 20)
        for says, depth in (
                ("16 bits", good.astype(np.int32) - 1001), ("16 bits", good.astype(np.uint32) + 65536),
                ("numbers", good.astype("U4")), ("numbers", good.astype(complex)),
                ("numbers", good > 0), ("numbers", good.astype(object)),
                ("shape", good[None]), ("shape", np.zeros((0, 8), np.uint16)), ("shape", good[:5]),
                ("shape", np.broadcast_to(np.uint16(7), huge)),
                ("shape", np.broadcast_to(np.float64(7), huge))):
            self.refused(says, frames.add, depth)
        for says, wrong in (
                ("angle", {"angle": math.nan}), ("angle", {"angle": math.inf}),
                ("time", {"time": math.inf}), ("sensor", {"sensor": 1}), ("sensor", {"sensor": -1}),
                ("pose", {"pose": np.full((4, 4), np.nan)}), ("pose", {"pose": np.eye(3)}),
                ("pose", {"pose": np.broadcast_to(1.0, (1, 1 << 40))}),
                ("pose", {"pose": np.eye(4) * 1j}), ("pose", {"pose": np.eye(4).astype(str)}),
                ("color", {"color": np.zeros((2, 2, 3), np.uint8)}),
                ("color", {"color": np.full((6, 8, 3), 300)}),
                ("color", {"color": np.full((6, 8, 3), 0.5)}),
                ("color", {"color": np.broadcast_to(np.uint8(1), (*huge, 3))})):
            self.refused(says, frames.add, good, **wrong)
        self.assertEqual(len(frames), count, "what was refused is not kept")
        for unit in (0, -1, math.nan, math.inf, 1e300):
            self.refused("depth_unit", turnscan.Sensor, camera, depth_unit=unit)
            self.refused("depth_unit", turnscan.Stream, depth_unit=unit)
        for axis in ((0, 0, 0), (math.nan, 0, 1), (math.inf, 0, 0)):
            self.refused("axis", turnscan.Turntable, axis, (0, 0, 0))

    def test_a_distortion_is_counted_before_it_is_copied(self):
        def made(distortion):
            return turnscan.Intrinsics(8, 6, 10, 10, 4, 3, distortion)

        for given in ([0.1, 0, 0, 0, 0], np.array([0.1, 0, 0, 0, 0], np.float32), (0.1, 0, 0, 0, 0, 0, 0, 1)):
            self.assertEqual(made(given).distortion, [float(k) for k in given])
        self.refused("not 5", made, np.broadcast_to(np.float64(0), 1 << 50))
        for wrong in ("12345", [None] * 5, np.broadcast_to(0.0, (5, 1 << 30))):
            self.refused("list of numbers", made, wrong)
        self.refused("distortion", made, None)

    def test_what_is_no_recording_is_refused(self):
        self.refused("no options", turnscan.options, "nonsense")
        for wrong in (None, (), 0, object()):
            self.refused("sequence of frames", turnscan.calibrate, wrong)
            self.refused("sequence of frames", turnscan.reconstruct, [wrong])

    def test_meshes_of_any_layout_are_read_and_what_numpy_would_cast_silently_is_refused(self):
        vertices = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0]], np.float32)
        triangles = np.array([[0, 1, 2]])
        for corners in (vertices, vertices.astype(float), np.asfortranarray(vertices),
                        vertices[::-1, ::-1], vertices.astype(int)):
            made = turnscan.Mesh(corners, triangles, colors=np.full((3, 3), 255))
            self.assertTrue((made.vertices == corners).all())
        for says, wrong in (("vertices", vertices.astype(str)), ("vertices", vertices.astype(complex)),
                            ("finite", vertices * np.nan), ("vertices", vertices[:, :2])):
            self.refused(says, turnscan.Mesh, wrong, triangles)
        for wrong in ([[-1, 1, 2]], [[0.5, 1, 2]], [[1 << 32, 1, 2]], [["0", "1", "2"]], [[0, 1]]):
            self.refused("triangles", turnscan.Mesh, vertices, np.array(wrong))
        self.refused("3", turnscan.Mesh, vertices, np.array([[0, 1, 3]]))
        for wrong in (np.full((3, 3), 256), np.full((3, 3), -1), np.full((2, 3), 1), np.eye(3) / 2):
            self.refused("colors", turnscan.Mesh, vertices, triangles, colors=wrong)

    def test_frames_keep_every_pixel_and_little_memory(self):
        camera = turnscan.Intrinsics(67, 41, 60, 60, 33, 20)
        frames = turnscan.Frames([turnscan.Sensor(camera)])
        random = np.random.default_rng(1)
        images = [np.zeros((41, 67), np.uint16), np.full((41, 67), 65535, np.uint16)]
        for share in (0.001, 0.02, 0.1, 0.5, 0.98):
            images.append(np.where(random.random((41, 67)) < share,
                                   random.integers(1, 65536, (41, 67)), 0).astype(np.uint16))
        for row, column in ((0, 0), (40, 66), (20, 0)):
            images.append(np.zeros((41, 67), np.uint16))
            images[-1][row, column] = 7
        for image in images:
            frames.add(image)
        for i, image in enumerate(images):
            self.assertTrue((frames[i].depth == image).all(), i)

        large = turnscan.Frames(turnscan.Recording(self.recording).sensors)
        raw = turnscan.Recording(self.recording)[0].depth
        before = memory_mb()
        for _ in range(200):
            large.add(raw)
        self.assertLess(memory_mb() - before, 40, "200 images of 0.4 MB, most of it no return")

    def test_a_stream_takes_frames_as_any_device_delivers_them(self):
        recording = turnscan.Recording(self.recording)
        sensor = recording.sensors[0]
        stream = turnscan.Stream(recording.turntable, sensor.depth_unit, **FAST)
        speed = recording.turntable.speed
        for frame in recording:
            angle = frame.angle if frame.angle is not None else frame.time * speed
            stream.add(frame.depth, sensor.intrinsics, angle)
        self.assertEqual(len(stream), 24)
        meshes = stream.finish()
        truth = self.simulation.truth[0]
        figures = turnscan.evaluate(meshes[0], truth, samples=2000)
        self.assertLess(figures["accuracy"]["median_m"], 2e-3)
        with self.assertRaises(turnscan.Error):
            stream.finish()

    def test_elements_are_fitted_to_a_mesh_of_arrays(self):
        u, v = np.meshgrid(np.arange(11), np.arange(11))
        vertices = np.stack([u, v, 0 * u + 3], -1).reshape(-1, 3) * 1e-3
        at = (u + 11 * v)[:-1, :-1].ravel()
        triangles = np.concatenate([np.stack([at, at + 1, at + 12], 1), np.stack([at, at + 12, at + 11], 1)])
        mesh = turnscan.Mesh(vertices, triangles)
        plane = {"name": "top", "type": "plane", "point_mm": [5, 5, 2.9], "direction": [0, 0, 1], "within_mm": 1}
        figures = turnscan.inspect(mesh, {"elements": [plane]})["elements"][0]
        self.assertEqual((figures["type"], figures["points"]), ("plane", 121))
        self.assertAlmostEqual(figures["z_m"]["value"], 3e-3, delta=1e-9)
        self.assertAlmostEqual(figures["z_m"]["deviation"], 0.1e-3, delta=1e-9)
        with self.assertRaisesRegex(turnscan.Error, "element 'top'"):
            turnscan.inspect(mesh, {"elements": [{**plane, "within_mm": -1}]})

    def test_progress_is_told_and_what_it_raises_cancels(self):
        phases = []
        turnscan.reconstruct(self.recording, progress=lambda phase, part: phases.append(part),
                             **FAST)
        self.assertGreater(len(phases), 2)
        self.assertTrue(all(0 <= part <= 1 for part in phases))

        def stop(phase, part):
            raise RuntimeError("enough")

        with self.assertRaisesRegex(RuntimeError, "enough"):
            turnscan.reconstruct(self.recording, progress=stop, **FAST)

    def test_ctrl_c_ends_a_call(self):
        # A test that was started in the background would ignore it.
        before = signal.signal(signal.SIGINT, signal.default_int_handler)
        self.addCleanup(signal.signal, signal.SIGINT, before)
        threading.Timer(0.2, lambda: os.kill(os.getpid(), signal.SIGINT)).start()
        begin = time.monotonic()
        with self.assertRaises(KeyboardInterrupt):
            turnscan.reconstruct(self.recording, voxel_size="0.4mm")
            time.sleep(20)  # had it ended before
        self.assertLess(time.monotonic() - begin, 15)

    def test_other_threads_run_meanwhile(self):
        counted, stop = [0], threading.Event()

        def count():
            while not stop.wait(0.001):
                counted[0] += 1

        thread = threading.Thread(target=count)
        thread.start()
        turnscan.reconstruct(self.recording, **FAST)
        stop.set()
        thread.join()
        self.assertGreater(counted[0], 5)

    def test_memory_does_not_grow_with_runs(self):
        recording = turnscan.Recording(self.recording)
        for _ in range(5):
            [frame.depth.sum() for frame in recording]
        before = memory_mb()
        for _ in range(20):
            [frame.depth.sum() for frame in recording]
        self.assertLess(memory_mb() - before, 20, "480 frames of 0.4 MB were read")

    def test_calibrate_finds_the_turntable(self):
        found = turnscan.calibrate(self.recording, way="platter")
        true = turnscan.Recording(self.recording).turntable
        self.assertGreater(np.dot(found.turntable.axis, true.axis), math.cos(math.radians(1)))
        self.assertLess(np.linalg.norm(np.subtract(found.turntable.center, true.center)), 5e-3)
        found.save(str(self.dir / "table.json"))
        self.assertTrue((self.dir / "table.json").exists())


class Meshes(unittest.TestCase):
    VERTICES = [[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]]
    TRIANGLES = [[0, 2, 1], [0, 1, 3], [1, 2, 3], [0, 3, 2]]

    def test_go_to_numpy_and_come_from_it(self):
        mesh = turnscan.Mesh(self.VERTICES, self.TRIANGLES, np.full((4, 3), 7, np.uint8))
        self.assertEqual(mesh.vertices.tolist(), self.VERTICES)
        self.assertEqual(mesh.triangles.tolist(), self.TRIANGLES)
        self.assertEqual(mesh.colors.max(), 7)
        self.assertEqual(mesh.normals.shape, (0, 3))
        self.assertEqual((mesh.vertices.dtype, mesh.triangles.dtype), (np.float32, np.uint32))

    def test_are_written_and_read(self):
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "mesh.stl")
            turnscan.Mesh(self.VERTICES, self.TRIANGLES).save(path)
            self.assertEqual(len(turnscan.Mesh.load(path).triangles), 4)
            self.assertAlmostEqual(float(turnscan.Mesh.load(path, unit="m").vertices.max()), 1e3,
                                   places=3)

    def test_come_back_whatever_is_up_in_the_file(self):
        mesh = turnscan.Mesh(np.float32(self.VERTICES) + np.float32([0, 2, 0]), self.TRIANGLES)
        with tempfile.TemporaryDirectory() as folder:
            for name, up in (("m.stl", "auto"), ("m.stl", "y"), ("m.ply", "z"), ("m.3mf", "z")):
                path = os.path.join(folder, name)
                mesh.save(path, up=up)
                self.assertEqual(turnscan.Mesh.load(path).vertices[:, 1].min(), 2, (name, up))
            for name, up in (("m.glb", "z"), ("m.stl", "x")):
                with self.assertRaises(turnscan.Error):
                    mesh.save(os.path.join(folder, name), up=up)

    def test_that_are_none_are_refused(self):
        with self.assertRaises(turnscan.Error):
            turnscan.Mesh(self.VERTICES, [[0, 1, 9]])
        with self.assertRaises(turnscan.Error):
            turnscan.Mesh([[0, 1]], self.TRIANGLES)


class Options(unittest.TestCase):
    def test_come_from_the_tables_of_the_command_line(self):
        reference = (ROOT / "docs" / "reference" / "options.md").read_text()
        for command in ("reconstruct", "calibrate", "simulate", "plan", "evaluate"):
            listed = turnscan.options(command)
            self.assertGreater(len(listed), 5)
            section = reference.split(f"## turnscan {command}\n")[1].split("\n## ")[0]
            for option in listed:
                self.assertIn("--" + option["name"].replace("_", "-"), section)


class Examples(unittest.TestCase):
    """examples/python, as they stand there; tests/consumer runs the others."""

    def test_the_sweep_on_dask_runs(self):
        try:
            import distributed  # noqa: F401
        except ImportError:
            self.skipTest("python3-distributed is not installed")
        with tempfile.TemporaryDirectory() as folder:
            result = subprocess.run([sys.executable, EXAMPLES / "sweep_on_dask.py", folder],
                                    cwd=folder, text=True, capture_output=True, timeout=300)
        self.assertEqual(result.returncode, 0, result.stdout + result.stderr)
        scores = re.findall(r"voxel size (\d) mm: F at 1 mm ([\d.]+)", result.stdout)
        self.assertEqual([size for size, _ in scores], ["3", "5", "8"])
        self.assertGreater(float(scores[0][1]), float(scores[2][1]), "smaller voxels are better")

    def test_the_notebook_is_whole_small_and_runs(self):
        path = EXAMPLES / "thesis.ipynb"
        notebook = json.loads(path.read_text())
        self.assertEqual((notebook["nbformat"], notebook["metadata"]["kernelspec"]["name"]),
                         (4, "python3"))
        self.assertLess(path.stat().st_size, 100_000)
        cells = [cell for cell in notebook["cells"] if cell["cell_type"] == "code"]
        self.assertEqual([cell["execution_count"] for cell in cells],
                         list(range(1, len(cells) + 1)), "run from above to below")
        for cell in cells:
            self.assertTrue(cell["outputs"])
            self.assertNotIn("error", [output["output_type"] for output in cell["outputs"]])
        # Coarsely, so that it takes seconds.
        code = "\n".join("".join(cell["source"]) for cell in cells)
        self.assertIn("FRAMES = 60", code)
        code = code.replace("FRAMES = 60", "FRAMES = 8").replace("samples=20000", "samples=2000") \
            .replace("(12, 24)", "(8,)").replace("(0, 20, 60)", "(20,)") \
            .replace("(0.002, 0.006, 0.02)", "(0.006,)").replace('"frames": 36', '"frames": 8')
        result = subprocess.run([sys.executable, "-c", code], text=True, capture_output=True,
                                timeout=300)
        self.assertEqual(result.returncode, 0, result.stdout + result.stderr)
        self.assertIn("volumetric", result.stdout)


class Wheel(unittest.TestCase):
    """pip makes a wheel of what was built, which works in an environment of its own."""

    def test_is_made_installed_and_used_without_a_network(self):
        build = os.environ.get("TURNSCAN_BUILD")
        if not build:
            self.skipTest("TURNSCAN_BUILD names no build folder")
        pip = [sys.executable, "-m", "pip", "--no-input", "--disable-pip-version-check"]
        if subprocess.run([*pip, "--version"], capture_output=True).returncode != 0:
            self.skipTest("python3-pip is not installed")
        alone = {name: value for name, value in os.environ.items()
                 if not name.startswith(("PYTHON", "TURNSCAN"))}
        with tempfile.TemporaryDirectory(prefix="turnscan-wheel-test-") as folder:
            folder = pathlib.Path(folder)

            def run(*command):
                result = subprocess.run(command, cwd=folder, env=alone, text=True,
                                        capture_output=True, timeout=300)
                self.assertEqual(result.returncode, 0, result.stdout + result.stderr)
                return result.stdout

            run(*pip, "wheel", "--no-index", "--no-deps", "--no-build-isolation", "--wheel-dir",
                folder, "--config-settings", f"build-dir={build}", ROOT)
            wheels = list(folder.glob("turnscan-*.whl"))
            self.assertEqual(len(wheels), 1)
            run(sys.executable, "-m", "venv", "--without-pip", "--system-site-packages", "own")
            python = folder / "own" / "bin" / "python"
            run(*pip, "--python", python, "install", "--no-index", "--no-deps", wheels[0])
            # A preset and a helper program, which are in it, too.
            said = run(python, "-c", """if True:
                import pathlib, turnscan
                print(turnscan.__file__)
                scan = turnscan.simulate("builtin:cylinder", scanners=["realsense-d435"], frames=8)
                made = turnscan.reconstruct(scan, voxel_size="8mm", method="concave-hull",
                                            allow_open=True)
                made.save("mesh.ply")
                print(len(turnscan.Mesh.load("mesh.ply").triangles) > 100)
                """)
            where, meshed = said.splitlines()[-2:]
            self.assertIn(str(folder / "own"), where)
            self.assertEqual(meshed, "True")


class Rigs(unittest.TestCase):
    """turnscan.Rig and the program that it asks."""

    @classmethod
    def setUpClass(cls):
        cls.kept = tempfile.TemporaryDirectory(prefix="turnscan-rig-")
        cls.dir = pathlib.Path(cls.kept.name)
        cls.token = "a-token-for-tests"
        (cls.dir / "token").write_text(cls.token)
        (cls.dir / "token").chmod(0o600)
        virtual = f"virtual:letter-a?sensor={ROOT / 'tests/e2e/small.toml'}&calibration=true"
        cls.quick = f"{virtual}&fps=3&speed=24deg/s"
        cls.slow = f"{virtual}&fps=10&speed=6deg/s&realtime=1&prepared=8"
        cls.server = subprocess.Popen(
            [BIN, "serve", cls.dir / "data", "--port", "0", "--token", cls.dir / "token",
             "--listen", "127.0.0.1", "--voxel-size", "6mm", "--min-free", "0",
             "--device", cls.quick, "--device", cls.slow],
            stdout=subprocess.PIPE, text=True)
        cls.server.stdout.readline()
        cls.address = cls.server.stdout.readline().split()[1].split("/?")[0]
        cls.rig = turnscan.Rig(cls.address, token=cls.token)

    @classmethod
    def tearDownClass(cls):
        cls.server.terminate()
        cls.server.communicate()
        cls.kept.cleanup()

    def test_a_scan_elsewhere_gives_the_bytes_that_are_there(self):
        self.assertIn(self.quick, [device["uri"] for device in self.rig.devices()])
        seen = []
        scan = self.rig.scan(self.quick, progress=lambda phase, part: seen.append((phase, part)))
        self.assertTrue(seen)
        self.assertEqual(self.rig.describe(scan)["state"], "done")
        self.assertIn({"id": scan, "state": "done"}, self.rig.scans())
        self.assertIn(self.rig.verdict(scan)["objects"][0]["verdict"]["colour"],
                      ("green", "amber", "red"))
        path = self.rig.download(scan, "mesh.ply", self.dir / "mine.ply")
        self.assertEqual(pathlib.Path(path).read_bytes(),
                         (self.dir / "data" / scan / "mesh.ply").read_bytes())
        self.assertEqual(self.rig.reconstruct(scan), scan)
        self.assertEqual(self.rig.wait(scan), scan)
        with self.assertRaises(turnscan.Error):
            self.rig.resume(scan)
        turnscan.Rig(self.address, token=self.token).delete(scan)  # nobody operates it any more
        self.assertNotIn(scan, [each["id"] for each in self.rig.scans()])
        self.assertFalse((self.dir / "data" / scan).exists())

    def test_a_recording_elsewhere_becomes_a_mesh_later(self):
        scan = self.rig.record(self.quick)
        self.assertEqual(self.rig.describe(scan)["state"], "recorded")
        self.assertEqual(self.rig.reconstruct(scan), scan)
        self.assertEqual(self.rig.describe(scan)["state"], "done")

    def test_each_pass_is_asked_for(self):
        asked = []

        def ask(advice, number):
            asked.append((bool(advice), number))
            return len(asked) < 2

        scan = self.rig.scan(self.quick, passes=None, ask=ask)
        self.assertEqual(asked, [(True, 1), (True, 2)])
        self.assertEqual(self.rig.describe(scan)["state"], "done")
        with self.assertRaises(turnscan.Error):
            self.rig.scan(self.quick, passes=None)

    def test_what_progress_raises_cancels_the_scan(self):
        class Enough(Exception):
            pass

        def progress(phase, part):
            if self.rig.state()["job"]["frames"] > 3:
                raise Enough

        with self.assertRaises(Enough):
            self.rig.scan(self.slow, progress=progress)
        until = time.monotonic() + 60
        while self.rig.state()["job"]["state"] == "running" and time.monotonic() < until:
            time.sleep(0.1)
        self.assertEqual(self.rig.state()["job"]["state"], "cancelled")

    def test_what_is_refused_says_why_and_leaves_no_file(self):
        for refused, code in ((lambda: self.rig.scan("virtual:nothing"), "invalid-option"),
                              (lambda: self.rig.verdict("20200101-000000"), "not-found"),
                              (lambda: self.rig.verdict("../data"), "not-found"),
                              (lambda: self.rig.download("../..", "passwd"), "not-found"),
                              (lambda: turnscan.Rig(self.address, token="wrong").scans(), "token"),
                              (lambda: turnscan.Rig("rig:8470"), "invalid-option"),
                              (lambda: turnscan.Rig("http://127.0.0.1:1").scans(), "io")):
            with self.assertRaises(turnscan.Error) as raised:
                refused()
            self.assertEqual(raised.exception.code, code, raised.exception)
        self.assertFalse(pathlib.Path("passwd").exists())

    def test_a_file_that_cannot_be_written_is_an_error_that_names_it(self):
        scan = self.rig.scan(self.quick)
        with self.assertRaises(turnscan.Error) as raised:
            self.rig.download(scan, "mesh.ply", self.dir / "nowhere" / "mesh.ply")
        self.assertIn("nowhere", str(raised.exception))
        self.assertEqual(raised.exception.path, str(self.dir / "nowhere" / "mesh.ply"))


class Documentation(unittest.TestCase):
    """The Python examples of each page run in order, in one folder, as one program."""

    def run_examples(self, *page, **replaced):
        text = (ROOT / "docs").joinpath(*page).read_text()
        for written, used in replaced.items():
            self.assertIn(written, text)
            text = text.replace(written, used)
        blocks = re.findall(r"^```python\n(.*?)^```", text, re.M | re.S)
        path = os.pathsep.join((os.path.dirname(BIN), os.environ.get("PATH", "")))
        with tempfile.TemporaryDirectory() as folder:
            result = subprocess.run([sys.executable, "-c", "\n".join(blocks)], cwd=folder,
                                    env={**os.environ, "PATH": path},
                                    text=True, capture_output=True, timeout=300)
            self.assertEqual(result.returncode, 0, result.stdout + result.stderr)
        return len(blocks)

    def test_examples_of_the_reference_run(self):
        self.assertGreater(self.run_examples("reference", "python.md"), 3)

    def test_examples_of_how_to_pages_run(self):
        for page in ("python.md", "own-driver.md"):
            self.assertGreater(self.run_examples("how-to", page), 0)

    def test_the_example_of_a_rig_runs(self):
        Rigs.setUpClass()
        self.addCleanup(Rigs.tearDownClass)
        self.run_examples("how-to", "remote-rig.md", **{
            "http://rig:8470\"": f"{Rigs.address}\"", "virtual:doll": Rigs.quick,
            "4f0c2a7d9e1b3856": Rigs.token})


if __name__ == "__main__":
    unittest.main(verbosity=2)
