"""Batches: the same on this machine and on a Slurm of two nodes that the test starts.

TURNSCAN_BATCH_TASKS sets the number of recordings of the large test (default: a few).
"""

import csv
import json
import os
import pathlib
import signal
import time
import unittest

import harness
import slurm_cluster
from harness import CANCELLED, FAILED, USAGE, start
from recordings import shared_recording

TASKS = int(os.environ.get("TURNSCAN_BATCH_TASKS", "10"))
FAILING = "t-fails"


class Batch(harness.TestCase):
    """What holds for every engine; the classes below name one."""

    engine = ()
    env = None

    def batch(self, *args, fails=False, **more):
        result = harness.run("batch", *args, "--quiet", *self.engine, cwd=self.dir, env=self.env,
                             **more)
        self.assertEqual(result.returncode, FAILED if fails else 0,
                         f"{args}\n{result.stdout}\n{result.stderr}")
        return result.stdout + result.stderr

    def rows(self, folder="out"):
        with open(self.dir / folder / "summary.csv", newline="") as file:
            return {row["name"]: row for row in csv.DictReader(file)}

    def write_table(self, count, failing=0, frames=2):
        """A simulation each, and some whose object is no mesh."""
        lines = ["name,object,yaw,frames"]
        lines += [f"t{i},builtin:cylinder,{i % 360}deg,{frames}" for i in range(count)]
        lines += [f"{FAILING}{i},bad{i}.ply,,{frames}" for i in range(failing)]
        (self.dir / "table.csv").write_text("\n".join(lines) + "\n")
        for i in range(failing):
            (self.dir / f"bad{i}.ply").write_text("no mesh")
        return "table.csv", "--command", "simulate", "--out", "out"

    def start_batch(self, *args):
        process = start("batch", *args, "--quiet", *self.engine, cwd=self.dir, env=self.env)
        self.addCleanup(process.communicate)
        self.addCleanup(process.kill)
        return process

    def wait_for_done(self, count, folder="out"):
        end = time.monotonic() + 90
        while time.monotonic() < end:
            states = [p.read_text() for p in (self.dir / folder).glob("tasks/*/state.json")]
            if sum('"state": "done"' in text for text in states) >= count:
                return
            time.sleep(0.02)
        self.fail(f"{count} tasks were not done in time")


class Everywhere:
    def test_results_stand_beside_their_hash_and_are_made_once(self):
        table = self.write_table(3, failing=1)
        said = self.batch("run", *table, fails=True)
        self.assertIn("1 of 4 tasks failed", said)
        rows = self.rows()
        self.assertEqual([rows[f"t{i}"]["state"] for i in range(3)], ["done"] * 3)
        self.assertEqual(rows[FAILING + "0"]["state"], "failed")
        self.assertIn("bad0.ply", rows[FAILING + "0"]["reason"])
        before = {p: p.stat().st_mtime_ns for p in self.dir.glob("out/tasks/*/state.json")}
        said = self.batch("run", *table, fails=True)
        self.assertIn("3 done (3 of them before), 1 failed", said)
        self.assertEqual(before, {p: p.stat().st_mtime_ns for p in before}, "nothing was run")
        # One option changes: one task.
        text = (self.dir / "table.csv").read_text().replace(",1deg,", ",100deg,")
        (self.dir / "table.csv").write_text(text)
        self.batch("run", *table, fails=True)
        self.assertEqual([self.rows()[f"t{i}"]["attempts"] for i in range(3)], ["1", "2", "1"])
        # The cause of the failure goes: retry runs it alone.
        (self.dir / "bad0.ply").write_text(harness.ply_cube(0.1))
        said = self.batch("retry", "out")
        self.assertIn("4 done (3 of them before), 0 failed", said)
        self.assertIn("4 done, 0 failed", self.ok("batch", "status", "out").stdout)

    def test_a_killed_run_goes_on_where_it_was(self):
        table = self.write_table(6, frames=20)
        process = self.start_batch("run", *table)
        self.wait_for_done(2)
        process.kill()
        process.communicate()
        done = {p.parent.name for p in self.dir.glob("out/tasks/*/state.json")
                if '"state": "done"' in p.read_text()}
        self.batch("run", "out")
        rows = self.rows()
        self.assertEqual({row["state"] for row in rows.values()}, {"done"})
        for name in done:
            self.assertEqual(rows[name]["attempts"], "1", "what was done is not done again")

    def test_a_stopped_run_says_how_to_go_on_and_leaves_no_halves(self):
        process = self.start_batch("run", *self.write_table(5, frames=20))
        self.wait_for_done(1)
        process.send_signal(signal.SIGINT)
        _, err = process.communicate(timeout=120)
        self.assertEqual(process.returncode, CANCELLED, err)
        self.assertIn("run it again to go on", err)
        self.assertEqual(list(self.dir.glob("out/tasks/*/work-*")), [])
        status = self.ok("batch", "status", "out").stdout
        self.assertIn("0 running", status)


class Local(Everywhere, Batch):
    def test_a_mesh_of_a_batch_has_the_bytes_of_the_command(self):
        recording = shared_recording()
        self.batch("run", recording, "--out", "out", "--set", "voxel-size=6mm", "--set",
                   "method=volumetric")
        self.ok("reconstruct", recording, "--voxel-size", "6mm", "--method", "volumetric", "--out",
                "alone.ply")
        result = self.dir / "out" / "tasks" / "cylinder" / "result"
        self.assertEqual((result / "mesh.ply").read_bytes(),
                         (self.dir / "alone.ply").read_bytes())
        self.assertTrue((result / "thumbnail.png").exists())
        page = (self.dir / "out" / "summary.html").read_text()
        self.assertIn("tasks/cylinder/result/thumbnail.png", page)
        row = json.loads((self.dir / "out" / "summary.json").read_text())["results"][0]
        self.assertTrue(row["watertight"])
        self.assertIn(row["verdict"], ("green", "amber", "red"))
        self.assertGreater(row["estimated_peak_bytes"], row["peak_bytes"])

    def test_two_runs_do_not_share_a_folder(self):
        process = self.start_batch("run", *self.write_table(4, frames=20))
        self.wait_for_done(1)
        self.refused(FAILED, "batch", "run", "out", says="another turnscan")
        process.communicate(timeout=120)
        self.assertEqual(process.returncode, 0)

    def test_wrong_use_is_refused_before_the_work(self):
        self.write_table(1)
        self.refused(USAGE, "batch", "melt", "table.csv", says="ACTION")
        self.refused(FAILED, "batch", "run", "nowhere", says="no batch")
        self.refused(FAILED, "batch", "run", "nowhere", "--out", "out", says="nowhere")
        self.refused(USAGE, "batch", "run", "table.csv", "--out", "out", "--command", "simulate",
                     "--set", "frames=none", says="frames")
        self.refused(USAGE, "batch", "run", "table.csv", "--out", "out", "--command", "simulate",
                     "--detach", says="--detach")
        (self.dir / "mine").mkdir()
        (self.dir / "mine" / "letter.txt").write_text("keep")
        self.refused(FAILED, "batch", "run", "table.csv", "--command", "simulate", "--out", "mine",
                     says="something else")

    @unittest.skipIf(slurm_cluster.why_not() == "", "Slurm is installed")
    def test_without_slurm_it_says_what_to_install(self):
        self.write_table(1)
        self.refused(FAILED, "batch", "run", "table.csv", "--command", "simulate", "--out", "out",
                     "--engine", "slurm", says="slurm-client")


class Slurm(Everywhere, Batch):
    engine = ("--engine", "slurm", "--engine-options", "--partition=main --time=10")

    @classmethod
    def setUpClass(cls):
        why = slurm_cluster.why_not()
        if why:
            raise unittest.SkipTest(why)
        cls.cluster = slurm_cluster.Cluster(cpus=max(2, os.cpu_count() // 2))
        cls.env = cls.cluster.env

    @classmethod
    def tearDownClass(cls):
        cls.cluster.stop()

    def setUp(self):
        super().setUp()
        self.cluster.wait_for_idle_nodes()

    def test_nothing_is_lost_when_a_node_dies_and_the_controller_restarts(self):
        table = self.write_table(TASKS, failing=5, frames=60)
        process = self.start_batch("run", *table)
        self.wait_for_done(2)
        self.cluster.kill("n2")
        running = {p.parent.name for p in self.dir.glob("out/tasks/*/state.json")
                   if '"state": "running"' in p.read_text()}
        self.cluster.stop_daemon("slurmctld")  # it saves its state; killed, it forgets jobs
        time.sleep(1)
        self.cluster.start_controller()
        self.wait_for_done(TASKS // 2)
        self.cluster.start_node("n2")
        # Slurm begins what it requeues after two minutes.
        out, err = process.communicate(timeout=240 + 3 * TASKS)
        self.assertEqual(process.returncode, FAILED, out + err)
        self.assertIn(f"5 of {TASKS + 5} tasks failed", err)
        rows = self.rows()
        self.assertEqual(sum(row["state"] == "done" for row in rows.values()), TASKS)
        again = {name for name, row in rows.items() if int(row["attempts"]) > 1}
        self.assertLessEqual(again, running, "only what was running is done twice")

    def test_jobs_handed_over_are_followed_by_the_next_run(self):
        table = self.write_table(4, frames=20)
        self.batch("run", *table, "--detach")
        self.batch("run", "out")
        rows = self.rows()
        self.assertEqual({(row["state"], row["attempts"]) for row in rows.values()},
                         {("done", "1")}, "none was handed over twice")

    def test_one_element_may_run_several_tasks(self):
        self.batch("run", *self.write_table(5), "--tasks-per-job", "2")
        self.assertEqual({row["state"] for row in self.rows().values()}, {"done"})
        lists = sorted(pathlib.Path(self.dir / "out" / "engine").glob("slurm-*.list"))
        self.assertEqual([len(p.read_text().splitlines()) for p in lists], [3])


del Batch  # it has no engine

if __name__ == "__main__":
    harness.main()
