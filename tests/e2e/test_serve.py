"""turnscan serve: from the page to a mesh, and what must not be possible.

TURNSCAN_SCREENSHOTS=FOLDER keeps what the browser shows.
"""

import gzip
import http.client
import http.server
import json
import os
import pathlib
import pty
import re
import shutil
import signal
import socket
import ssl
import subprocess
import sys
import threading
import time

import browser
import harness
from harness import CANCELLED, FAILED, SENSOR, USAGE, run, start

DEVICE = f"virtual:doll?sensor={SENSOR}&fps=3&speed=24deg/s&calibration=true"
# A source that takes its time, so that something can happen to it meanwhile.
SLOW = f"virtual:doll?sensor={SENSOR}&fps=10&speed=6deg/s&calibration=true&realtime=1&prepared=8"
BRISK = f"virtual:doll?sensor={SENSOR}&fps=10&speed=36deg/s&calibration=true&realtime=1&prepared=8"
OPTIONS = ("--voxel-size", "4mm", "--min-free", "0")
SHOTS = os.environ.get("TURNSCAN_SCREENSHOTS")
SKIPPED = 77
TOKEN = "0123456789abcdef"
ENDS_WITHIN_S = 0.5
SURFACE_BYTES = 500_000  # that a phone gets once a second
MESHES = ("mesh.glb", "mesh.ply", "mesh.stl", "mesh.3mf")


# Share of the growing surface's pixels that are not its background.
DRAWN = """(() => {
  const from = document.getElementById('surface'), to = document.createElement('canvas');
  to.width = from.width;
  to.height = from.height;
  const pen = to.getContext('2d');
  pen.drawImage(from, 0, 0);
  const {data} = pen.getImageData(0, 0, to.width, to.height);
  let drawn = 0;
  for (let i = 0; i < data.length; i += 4) drawn += Math.abs(data[i] - data[0]) > 8;
  return drawn / (data.length / 4);
})()"""


class Server(harness.TestCase):
    def setUp(self):
        super().setUp()
        self.process = None
        self.operator = {}
        self.tls = None

    def serve(self, *args, folder="data"):
        self.process = start("serve", folder, "--port", "0", "--device", DEVICE, "--device", SLOW, "--device", BRISK,
                             *OPTIONS, *args, cwd=self.dir)
        self.addCleanup(self.kill, self.process)
        self.process.stdout.readline()
        self.address = self.process.stdout.readline().split()[1]
        self.port = int(self.address.split(":")[2].split("/")[0])

    @staticmethod
    def kill(process):
        process.kill()
        process.wait()
        process.stdout.close()
        process.stderr.close()

    def ask(self, method, path, body=None, **headers):
        """Status, headers and content: JSON where it is."""
        headers = {k.replace("_", "-"): v for k, v in headers.items()}
        if body is not None:
            headers.setdefault("Content-Type", "application/json")
            body = body if isinstance(body, (str, bytes)) else json.dumps(body)
        connection = (http.client.HTTPSConnection("127.0.0.1", self.port, timeout=60, context=self.tls) if self.tls
                      else http.client.HTTPConnection("127.0.0.1", self.port, timeout=60))
        try:
            connection.request(method, path, body, {**self.operator, **headers})
            response = connection.getresponse()
            content = response.read()
        finally:
            connection.close()
        if response.headers.get_content_type() == "application/json":
            content = json.loads(content)
        return response.status, response.headers, content

    def got(self, method, path, body=None, status=200, **headers):
        answer = self.ask(method, path, body, **headers)
        self.assertEqual(answer[0], status, answer[2])
        return answer[2]

    def become_operator(self):
        self.operator = {"Turnscan-Operator": self.got("POST", "/api/v1/operator")["key"]}

    def start_scan(self, device=DEVICE, **more):
        return self.got("POST", "/api/v1/scans", {"device": device, **more}, 202)["id"]

    def wait_for(self, true, seconds=harness.HANG_S):
        until = time.monotonic() + seconds
        while time.monotonic() < until:
            job = self.got("GET", "/api/v1/state")["job"]
            if true(job):
                return job
            time.sleep(0.1)
        raise AssertionError(f"it did not come to that: {job}")

    def ended(self):
        return self.wait_for(lambda job: job["state"] not in ("running", "asking"))

    def raw(self, text, timeout=30):
        """What comes back for these bytes, until the server closes."""
        with socket.create_connection(("127.0.0.1", self.port), timeout) as peer:
            try:
                peer.sendall(text)
            except OSError:
                pass
            content = b""
            try:
                while piece := peer.recv(65536):
                    content += piece
            except OSError:
                pass
            return content

    def schema_holds(self, schema, value, where):
        """The part of JSON schema that the description uses."""
        if "$ref" in schema:
            return self.schema_holds(self.schemas[schema["$ref"].rsplit("/", 1)[1]], value, where)
        if "oneOf" in schema:
            if value is None:
                return self.assertIn({"type": "null"}, schema["oneOf"], where)
            return self.schema_holds(schema["oneOf"][1], value, where)
        if "enum" in schema:
            self.assertIn(value, schema["enum"], where)
        kinds = {"object": dict, "array": list, "string": str, "integer": int, "boolean": bool,
                 "number": (int, float), "null": type(None)}
        named = schema.get("type", [])
        for_type = tuple(k for n in ([named] if isinstance(named, str) else named)
                         for k in (kinds[n] if isinstance(kinds[n], tuple) else (kinds[n],)))
        if for_type:
            self.assertIsInstance(value, for_type, where)
        if isinstance(value, dict):
            for name in schema.get("required", []):
                self.assertIn(name, value, where)
            for name, inner in schema.get("properties", {}).items():
                if name in value:
                    self.schema_holds(inner, value[name], f"{where}.{name}")
        if isinstance(value, list):
            for one in value:
                self.schema_holds(schema.get("items", {}), one, where)

    def test_from_start_to_meshes_of_the_same_bytes(self):
        self.serve()
        self.become_operator()
        scan = self.start_scan()
        picture = self.wait_for(lambda job: job["picture"] or job["state"] == "asking")
        if picture["picture"]:
            self.assertEqual(self.got("GET", "/api/v1/picture.jpg")[:2], b"\xff\xd8")
        asked = self.wait_for(lambda job: job["state"] not in ("running",))
        self.assertEqual(asked["state"], "asking", asked)
        self.assertIn("lay it", asked["question"]["advice"])
        self.got("POST", "/api/v1/job/answer", {"another_side": 1}, 400)
        self.got("POST", "/api/v1/job/answer", {"another_side": False}, 202)
        job = self.ended()
        self.assertEqual((job["id"], job["state"], job["error"]), (scan, "done", None))
        described = self.got("GET", f"/api/v1/scans/{scan}")
        names = [f["name"] for f in described["files"]]
        for name in (*MESHES, "report.html", "report.json", "advice.png"):
            self.assertIn(name, names)
        verdict = self.got("GET", f"/api/v1/scans/{scan}/verdict")
        self.assertIn(verdict["objects"][0]["verdict"]["colour"], ("green", "amber", "red"))
        before = {name: self.got("GET", f"/api/v1/scans/{scan}/files/{name}") for name in MESHES}
        for name in ("mesh.glb", "mesh.3mf"):
            own = name.replace("mesh", "own")
            self.ok("reconstruct", f"data/{scan}/recording", "--out", own, *OPTIONS[:2])
            self.assertEqual((self.dir / own).read_bytes(), before[name], name)
        # Nobody asked for the growing surface, so that none was made.
        self.assertEqual(self.got("GET", "/api/v1/surface"), {"number": 0, "frames": 0, "model": None})
        # Once more from the kept recording.
        self.got("POST", f"/api/v1/scans/{scan}/reconstruct", status=202)
        self.assertEqual(self.ended()["state"], "done")
        for name in MESHES:
            self.assertEqual(self.got("GET", f"/api/v1/scans/{scan}/files/{name}"), before[name])
        self.answers_are_as_described(scan)

    def test_the_surface_grows_while_somebody_asks(self):
        self.serve()
        self.become_operator()
        self.start_scan(BRISK)
        seen = []
        while (job := self.got("GET", "/api/v1/state")["job"])["state"] == "running":
            have = seen[-1]["number"] if seen else 0
            content = self.got("GET", f"/api/v1/surface?have={have}")
            if content["model"]:
                self.assertLess(len(json.dumps(content)), SURFACE_BYTES)
                seen.append(content)
            time.sleep(0.05)
        self.assertEqual(job["state"], "asking", job)
        self.assertGreater(len(seen), 1)
        for before, after in zip(seen, seen[1:]):
            self.assertGreater(after["number"], before["number"])
            self.assertGreaterEqual(after["frames"], before["frames"])
        self.assertGreater(seen[-1]["frames"], seen[0]["frames"])
        # The doll, in millimetres.
        box = seen[-1]["model"]["objects"][0]
        self.assertGreater(box["vertices"], 500)
        self.assertGreater(65534 * box["step_mm"], 80)
        self.assertLess(65534 * box["step_mm"], 500)
        # It stays, for a page that comes later, until something else is done.
        last = self.got("GET", "/api/v1/surface")
        self.assertEqual(last["number"], seen[-1]["number"])
        self.assertEqual(last["model"], seen[-1]["model"])
        self.got("POST", "/api/v1/job/cancel", status=202)
        self.ended()
        self.start_scan(DEVICE)
        self.assertIsNone(self.got("GET", "/api/v1/surface")["model"])

    def answers_are_as_described(self, scan):
        described = self.got("GET", "/api/v1/openapi.json")
        self.assertEqual(described, json.loads(self.ok("serve", "--openapi").stdout))
        self.schemas = described["components"]["schemas"]
        for path, operations in described["paths"].items():
            content = operations.get("get", {}).get("responses", {}).get("200", {}).get("content", {})
            for schema in [c["schema"] for c in content.values() if "schema" in c]:
                self.schema_holds(schema, self.got("GET", path.replace("{id}", scan)), path)
            unknown = path.replace("{id}", "20000101-000000").replace("{name}", "mesh.glb")
            if unknown != path:
                method = next(iter(operations)).upper()
                self.schema_holds(self.schemas["Error"], self.got(method, unknown, status=404), path)

    def test_the_command_line_scans_on_a_rig_elsewhere(self):
        self.write_token()
        self.serve("--token", "token")
        there = ("--server", f"http://127.0.0.1:{self.port}")
        env = {"TURNSCAN_TOKEN": TOKEN}
        self.assertIn(DEVICE, self.ok("devices", *there, "--json", "devices.json", env=env).stdout)
        self.assertIn(DEVICE, [d["uri"] for d in json.loads((self.dir / "devices.json").read_text())["devices"]])
        scan = ("scan", *there, "--device", DEVICE)
        before = self.files()
        self.refused(FAILED, "devices", *there, says="TURNSCAN_TOKEN")
        self.refused(FAILED, *scan, "-o", "mine.ply", says="TURNSCAN_TOKEN")
        self.refused(USAGE, *scan, "-o", "mine.ply", "--voxel-size", "4mm", says="--voxel-size: does not go with", env=env)
        self.refused(USAGE, *scan, "-o", "mine.obj", says=".3mf", env=env)
        self.refused(USAGE, "scan", *there, "--device", "virtual:none", "-o", "mine.ply", says="device", env=env)
        self.refused(USAGE, "devices", "--server", "rig:8470", says="http://rig:8470")
        self.refused(USAGE, "devices", "--server", f"http://rig:8470/?token={TOKEN}", says="TURNSCAN_TOKEN")
        self.refused(FAILED, "devices", "--server", "http://127.0.0.1:1", says="does not answer")
        self.assertEqual(self.files(), before)
        done = self.ok(*scan, "-o", "mine.ply", "--recording", "mine.recording", "--report", "mine.json",
                       "--report", "mine.html", env=env)
        for said in ("1.0", "watertight", "Wrote mine.ply", "Wrote mine.recording"):
            self.assertIn(said, done.stdout)
        self.assertNotIn(str(self.dir), done.stdout)
        self.assertEqual(done.stdout.count("recording\n"), 1)  # not where it is on the rig
        self.assertIn("objects", json.loads((self.dir / "mine.json").read_text())["reconstruction"])
        self.ok("info", "mine.recording")
        self.ok("reconstruct", "mine.recording", "--out", "own.ply", *OPTIONS[:2])
        self.assertEqual((self.dir / "own.ply").read_bytes(), (self.dir / "mine.ply").read_bytes())
        listed = self.got("GET", "/api/v1/scans", Authorization=f"Bearer {TOKEN}")["scans"]
        kept = self.dir / "data" / listed[0]["id"] / "recording"
        for path in [p for p in kept.rglob("*") if p.is_file()]:
            mine = self.dir / "mine.recording" / path.relative_to(kept)
            self.assertEqual(mine.read_bytes(), path.read_bytes(), path)
        self.refused(FAILED, *scan, "-o", "more.ply", "--recording", "mine.recording", says="mine.recording", env=env)
        # What failed there fails here in the same way, and Ctrl-C ends both.
        self.assertEqual(len(self.got("GET", "/api/v1/scans", Authorization=f"Bearer {TOKEN}")["scans"]), 1)
        slow = start("scan", *there, "--device", SLOW, "-o", "slow.ply", "--quiet", cwd=self.dir, env=env)
        self.operator = {"Authorization": f"Bearer {TOKEN}"}
        self.wait_for(lambda job: job["state"] == "running" and job["frames"] > 5)
        slow.send_signal(signal.SIGINT)
        error = slow.communicate(timeout=60)[1]
        self.assertEqual(slow.returncode, CANCELLED)
        self.assert_one_line_error(error)
        self.assertEqual(self.ended()["state"], "cancelled")
        self.assertFalse((self.dir / "slow.ply").exists())

    def test_a_recording_on_a_rig_elsewhere_is_copied_here(self):
        self.serve()
        there = ("capture", "--server", self.address, "--device", DEVICE)
        before = self.files()
        self.refused(USAGE, *there, "-o", "mine", "--turns", "2", says="--turns: does not go with")
        self.refused(USAGE, *there, "--resume", "mine", says="--resume: does not go with")
        self.refused(FAILED, "capture", "--server", "http://127.0.0.1:1", "--device", DEVICE, "-o", "mine", says="not answer")
        self.assertEqual(self.files(), before)
        done = self.ok(*there, "-o", "mine")
        self.assertIn("mine", done.stdout)
        self.assertNotIn(str(self.dir), done.stdout)
        [scan] = self.got("GET", "/api/v1/scans")["scans"]
        self.assertEqual(scan["state"], "recorded")
        self.assertEqual(self.got("GET", "/api/v1/state")["job"]["kind"], "record")
        kept = self.dir / "data" / scan["id"] / "recording"
        names = sorted(str(path.relative_to(kept)) for path in kept.rglob("*") if path.is_file())
        self.assertGreater(len(names), 5)
        for name in names:
            self.assertEqual((self.dir / "mine" / name).read_bytes(), (kept / name).read_bytes(), name)
        self.ok("info", "mine")
        self.refused(FAILED, *there, "-o", "mine", says="mine")
        self.ok(*there, "-o", "a/b/more/")
        self.ok("info", "a/b/more")
        (self.dir / "next.part").mkdir()
        scans = self.got("GET", "/api/v1/scans")["scans"]
        self.refused(FAILED, *there, "-o", "next", says="next.part")
        self.assertEqual(self.got("GET", "/api/v1/scans")["scans"], scans)  # before the table turned
        self.refused(USAGE, *there, "--device", "virtual:none", "-o", "more", says="--device")

    def test_a_rig_that_is_none_writes_nowhere_else(self):
        job = {"id": "s", "state": "done", "text": "made\n", "notes": [], "error": None, "code": None}
        sound = {"POST operator": {"key": "k"}, "POST scans": {"id": "s"}, "GET state": {"job": job},
                 "GET scans/s": {"files": [{"name": "mesh.ply"}]},
                 "GET scans/s/recording": {"files": [{"name": "frames.csv"}]}}
        answers = {}

        class Fake(http.server.BaseHTTPRequestHandler):
            def answer(self):
                answer = answers.get(f"{self.command} {self.path.removeprefix('/api/v1/')}", "content")
                content = answer if isinstance(answer, bytes) else json.dumps(answer).encode()
                self.send_response(200)
                self.send_header("Content-Length", str(len(content)))
                self.end_headers()
                self.wfile.write(content)
            do_GET = do_POST = do_DELETE = answer

            def log_message(self, *_):
                pass

        server = http.server.ThreadingHTTPServer(("127.0.0.1", 0), Fake)
        self.addCleanup(server.server_close)
        self.addCleanup(server.shutdown)
        threading.Thread(target=server.serve_forever, daemon=True).start()
        work = self.dir / "work" / "here"
        work.mkdir(parents=True)

        def scan(**changed):
            answers.clear()
            answers.update(sound, **{k.replace("_", " ", 1): v for k, v in changed.items()})
            return run("scan", "--server", f"http://127.0.0.1:{server.server_port}", "--device", "x", "--quiet", "-o", "m.ply",
                       "--recording", "r", cwd=work)
        self.assertEqual(scan().returncode, 0)
        self.assertEqual(self.files(), ["work", "work/here", "work/here/m.ply", "work/here/r", "work/here/r/frames.csv"])
        harness.remove(work / "r")
        (work / "m.ply").unlink()
        nonsense = (b"", b"[]", b"null", b"{", b"[" * 100000, {"job": None}, {"job": 1}, {"job": {**job, "notes": [1]}},
                    {"job": {**job, "state": 7}}, {"job": {**job, "error": "x"}}, {"key": 1}, {"files": [{}]})
        for place in ("POST operator", "POST scans", "GET state", "GET scans/s", "GET scans/s/recording"):
            for content in nonsense:
                result = scan(**{place.replace(" ", "_", 1): content})
                self.assertEqual(result.returncode, FAILED, (place, content))
                self.assert_one_line_error(result.stderr)
        for name in ("../x", "a/../../x", "/x", "..", "a/b/c", "a/..", ".hidden", "", "a\0b", "a\nb"):
            self.assertEqual(scan(**{"GET_scans/s/recording": {"files": [{"name": name}]}}).returncode, FAILED, name)
        for name in ("mesh/../../x.ply", "../mesh.ply", "meshx.ply", "mesh-/x.ply"):
            self.assertEqual(scan(**{"GET_scans/s": {"files": [{"name": name}]}}).returncode, FAILED, name)
        self.assertEqual(scan(**{"POST_scans": {"id": "../x"}}).returncode, FAILED)
        (work / "m.ply").unlink(missing_ok=True)
        self.assertEqual(self.files(), ["work", "work/here"])

    def test_an_error_of_the_rig_is_that_of_the_command(self):
        broken = "virtual:doll?sensor=none-of-this-name"
        self.serve("--device", broken)
        here = run("scan", "--device", broken, "-o", "here.ply", "--quiet", cwd=self.dir)
        there = run("scan", "--device", broken, "-o", "there.ply", "--quiet", "--server", self.address, cwd=self.dir)
        self.assertEqual(there.returncode, here.returncode)
        self.assert_one_line_error(there.stderr)
        self.assertIn("none-of-this-name", there.stderr)

    def write_token(self):
        (self.dir / "token").write_text(TOKEN + "\n")
        (self.dir / "token").chmod(0o600)

    def test_it_is_for_this_machine_and_its_own_page_alone(self):
        self.serve()
        state = "/api/v1/state"
        for host in ("evil.example", f"evil.example:{self.port}", "192.168.1.7", "localhost.evil.example",
                     "", "[::1", "127.0.0.1.evil.example"):
            self.got("GET", state, status=421, Host=host)
        for host in ("localhost", f"127.0.0.1:{self.port}", "[::1]:80", "LOCALHOST:1"):
            self.got("GET", state, Host=host)
        self.assertIn(b" 421 ", self.raw(b"GET /api/v1/state HTTP/1.1\r\n\r\n"))
        for origin in ("http://example.com", "null", f"https://127.0.0.1:{self.port}"):
            self.got("POST", "/api/v1/operator", status=403, Origin=origin)
        self.got("GET", state, status=403, Sec_Fetch_Site="cross-site")
        self.got("GET", state, Origin=f"http://127.0.0.1:{self.port}")
        self.got("POST", "/api/v1/scans", "device=x", 415, Content_Type="text/plain")
        status, headers, _ = self.ask("GET", "/")
        self.assertEqual(status, 200)
        self.assertIn("default-src 'none'", headers["Content-Security-Policy"])
        self.assertEqual(headers["X-Content-Type-Options"], "nosniff")
        self.assertNotIn("Access-Control-Allow-Origin", headers)

    def test_elsewhere_it_needs_a_token(self):
        self.refused(USAGE, "serve", "--listen", "0.0.0.0", says="--token auto")
        (self.dir / "token").write_text("short\n")
        (self.dir / "token").chmod(0o600)
        self.refused(USAGE, "serve", "--token", "token", says="is no token")
        self.write_token()
        (self.dir / "token").chmod(0o604)
        self.refused(FAILED, "serve", "--token", "token", says="everybody can read")
        (self.dir / "token").chmod(0o600)
        self.serve("--listen", "0.0.0.0", "--token", "token")
        for path in ("/", "/api/v1/state", "/api/v1/openapi.json", "/nothing", "/?token=0123456789abcdeX"):
            self.got("GET", path, status=401)
        self.got("GET", "/api/v1/state", status=401, Authorization="Bearer 0123456789abcdeX")
        self.got("GET", "/api/v1/state", Authorization="Bearer 0123456789abcdef")
        status, headers, _ = self.ask("GET", "/?token=0123456789abcdef")
        self.assertEqual((status, headers["Location"]), (303, "/"))
        self.assertIn("HttpOnly; SameSite=Lax", headers["Set-Cookie"])
        cookie = headers["Set-Cookie"].split(";")[0]
        self.assertIn(str(self.port), cookie.split("=")[0])  # of another server on this host is another's
        self.got("GET", "/", Cookie="a=b; " + cookie)
        self.got("GET", "/", status=401, Cookie=cookie[:-1])
        self.got("GET", "/api/v1/state", Cookie=cookie, Host=f"192.168.1.7:{self.port}")
        self.got("GET", "/api/v1/state", status=401, Cookie=cookie, Host="192.168.1.7:1")
        self.got("GET", "/api/v1/state", status=421, Cookie=cookie, Host="evil.example")

    def make_certificate(self):
        subprocess.run(["openssl", "req", "-x509", "-newkey", "ec", "-pkeyopt", "ec_paramgen_curve:prime256v1", "-nodes",
                        "-subj", "/CN=rig", "-addext", "subjectAltName=DNS:localhost,IP:127.0.0.1", "-days", "2",
                        "-keyout", "key.pem", "-out", "cert.pem"], cwd=self.dir, check=True, capture_output=True)
        (self.dir / "key.pem").chmod(0o600)

    def test_with_a_certificate_it_is_reached_by_https_alone(self):
        if not shutil.which("openssl"):
            self.skipTest("there is no openssl to make a certificate with")
        self.make_certificate()
        pair = ("--tls-cert", "cert.pem", "--tls-key", "key.pem")
        self.refused(USAGE, "serve", *pair[:2], says="belong together")
        self.refused(USAGE, "serve", "--tls-cert", "key.pem", "--tls-key", "key.pem", says="no certificate")
        (self.dir / "cert.pem").chmod(0o600)
        self.refused(USAGE, "serve", "--tls-cert", "cert.pem", "--tls-key", "cert.pem", says="not the key")
        self.refused(FAILED, "serve", "--tls-cert", "none.pem", "--tls-key", "key.pem", says="none.pem")
        (self.dir / "key.pem").chmod(0o604)
        self.refused(FAILED, "serve", *pair, says="everybody can read")
        (self.dir / "key.pem").chmod(0o600)
        # No token is needed to listen elsewhere.
        self.serve("--listen", "0.0.0.0", *pair)
        self.assertTrue(self.address.startswith("https://"), self.address)
        self.assertEqual(self.raw(b"GET / HTTP/1.1\r\nHost: localhost\r\n\r\n"), b"")
        trusted = ssl.create_default_context(cafile=self.dir / "cert.pem")
        self.tls = trusted
        self.got("GET", "/api/v1/state")
        self.got("GET", "/api/v1/state", Host="rig.lab.example")  # the certificate says who it is
        self.got("POST", "/api/v1/operator", Origin=f"https://127.0.0.1:{self.port}")
        self.got("POST", "/api/v1/operator", status=403, Origin=f"http://127.0.0.1:{self.port}")
        with self.assertRaises(ssl.SSLError):
            self.tls = ssl.create_default_context()
            self.got("GET", "/api/v1/state")
        self.tls = trusted
        # Peers that agree on nothing keep nobody out, and a large answer comes whole.
        stalled = [socket.create_connection(("127.0.0.1", self.port), 10) for _ in range(60)]
        self.addCleanup(lambda: [peer.close() for peer in stalled])
        begun = time.monotonic()
        page = self.got("GET", "/")
        self.assertLess(time.monotonic() - begun, 5.0)
        if has_page():
            self.assertIn(b"</html>", page[-20:])
        elsewhere = f"https://127.0.0.1:{self.port}"
        self.refused(FAILED, "devices", "--server", elsewhere, says="does not answer")
        self.assertIn(DEVICE, self.ok("devices", "--server", elsewhere, env={"SSL_CERT_FILE": "cert.pem"}).stdout)
        # Who has left is noticed, so that watchers do not pile up.
        for _ in range(20):
            with trusted.wrap_socket(socket.create_connection(("127.0.0.1", self.port), 10),
                                     server_hostname="localhost") as peer:
                peer.sendall(b"GET /api/v1/events HTTP/1.1\r\nHost: localhost\r\n\r\n")
                self.assertIn(b"200 OK", peer.recv(4096))
            time.sleep(0.2)

    def test_a_terminal_shows_the_address_as_a_qr_code(self):
        terminal, end = pty.openpty()
        self.addCleanup(os.close, terminal)
        process = start("serve", "data", "--port", "0", "--listen", "0.0.0.0", "--token", "auto", cwd=self.dir, stdout=end, stderr=end)
        self.addCleanup(process.wait)
        self.addCleanup(process.kill)
        os.close(end)
        text = b""
        while b"Ctrl-C" not in text:
            text += os.read(terminal, 65536)
        rows = [re.sub("\033\\[[0-9;]*m|\r", "", row) for row in text.decode().splitlines() if "\033" in row]
        # The light border of four modules, and within it the three corners of a code.
        size = len(rows[0])
        self.assertEqual({len(row) for row in rows}, {size})
        self.assertEqual(len(rows), (size + 1) // 2)
        self.assertEqual({row[:4] + row[-4:] for row in rows} | set(rows[:2]),
                         {" " * 8, " " * size})
        corner = ["█▀▀▀▀▀█", "█ ███ █", "█ ▀▀▀ █"]
        self.assertEqual([row[4:11] for row in rows[2:5]], corner)
        self.assertEqual([row[-11:-4] for row in rows[2:5]], corner)
        self.assertEqual(len([1 for row in rows if row[4:11] == corner[1]]), 2)

    def test_no_path_leads_out_of_a_recording(self):
        self.serve()
        own = self.dir / "data" / "20260101-000000" / "recording"
        (own / "depth").mkdir(parents=True)
        (own / "frames.csv").write_text("frames")
        (own / "depth" / "000000.png").write_text("image")
        (self.dir / "secret").write_text("secret")
        (own / "linked.csv").symlink_to(self.dir / "secret")
        (own / "folder").symlink_to(self.dir)
        os.mkfifo(own / "pipe")
        base = "/api/v1/scans/20260101-000000/recording"
        self.assertEqual(self.got("GET", base), {"files": [{"name": "frames.csv", "bytes": 6},
                                                           {"name": "depth/000000.png", "bytes": 5}]})
        self.assertEqual(self.got("GET", base + "/depth/000000.png"), b"image")
        self.assertEqual(self.got("GET", base + "/frames.csv"), b"frames")
        for path in ("linked.csv", "folder/secret", "pipe", "depth", "../secret", "..%2fsecret", "depth/..",
                     "..", ".", "../..", "%2e%2e/%2e%2e", "depth/%00", "", "/"):
            status, _, content = self.ask("GET", f"{base}/{path}")
            self.assertIn(status, (400, 404), path)
            self.assertNotIn("secret", str(content))
        self.got("GET", "/api/v1/scans/../recording", status=404)

    def test_no_path_leads_out_of_the_folder(self):
        self.serve()
        (self.dir / "mesh.ply").write_text("secret")
        other = self.dir / "data" / "20260101-000000"
        (other / "recording").mkdir(parents=True)
        (other / "mesh.ply").symlink_to(self.dir / "mesh.ply")
        (other / "notes.txt").write_text("secret")
        (self.dir / "data" / "linked").symlink_to(self.dir)
        for path in ("../mesh.ply", "..%2fmesh.ply", "....//mesh.ply", "%2e%2e/mesh.ply", "%00", "mesh.ply",
                     "notes.txt", "recording", ".", "..", "%c0%ae%c0%ae/mesh.ply"):
            for scan in ("20260101-000000", "..", "%2e%2e", "linked", ".", "", "20260101-000000%2f.."):
                status, _, content = self.ask("GET", f"/api/v1/scans/{scan}/files/{path}")
                self.assertIn(status, (400, 404), (scan, path))
                self.assertNotIn("secret", str(content))
        for device in (f"replay:{self.dir}", "virtual:/etc/passwd", None, ["x"], 1):
            self.become_operator()
            self.got("POST", "/api/v1/scans", {"device": device}, 400)
        self.assertEqual(self.got("GET", "/api/v1/scans")["scans"], [{"id": "20260101-000000", "state": "damaged"}])

    def test_malformed_and_oversized_requests_are_refused(self):
        self.serve()
        self.become_operator()
        for body in (b"", b"{", b"[]", b"null", b"[" * 50000, b"\xff\xfe", b'{"device": {}}'):
            self.got("POST", "/api/v1/scans", body, 400)
        for passes in (0, 101, 1.5, "1", -1, 1e99):
            self.got("POST", "/api/v1/scans", {"device": DEVICE, "passes": passes}, 400)
        self.got("PUT", "/api/v1/state", status=405)
        self.got("DELETE", "/api/v1/state", status=405)
        self.got("GET", "/api/v1/" + "a" * 300, status=414)
        self.got("GET", "/api/v2/state", status=404)
        line = b"POST /api/v1/scans HTTP/1.1\r\nHost: localhost\r\nContent-Type: application/json\r\n"
        huge = b"x" * (8 << 20)
        packed = gzip.compress(b'{"device":' + b"[" * 400000 + b"]" * 400000 + b"}")
        deep = b'{"device":' + b"[" * 30000 + b"]" * 30000 + b"}"
        self.got("POST", "/api/v1/scans", deep, 400)
        self.got("POST", "/api/v1/scans", packed, 415, Content_Encoding="gzip")
        # As curl sends it, without a length.
        begun = time.monotonic()
        self.assertIn(b" 403 ", self.raw(b"POST /api/v1/job/cancel HTTP/1.1\r\nHost: localhost\r\n\r\n"))
        self.assertLess(time.monotonic() - begun, 5.0)
        for text in (line + b"Content-Length: 8388608\r\n\r\n" + huge,
                     line + b"Transfer-Encoding: chunked\r\n\r\n800000\r\n" + huge,
                     line + b"Content-Length: 99999999999999999999\r\n\r\n{}",
                     line + b"Content-Length: -1\r\n\r\n{}",
                     b"GET /" + huge, huge, b"GET / HTTP/1.1\r\nX: " + huge, b"\0" * 1000, b"GET\r\n\r\n",
                     b"GET / HTTP/1.1\r\nHost: localhost\r\nRange: bytes=" + b"1" * 8000 + b"\r\n\r\n",
                     b"GET / HTTP/1.1\r\nHost: localhost\r\nRange: bytes=" + b"0-," * 2600 + b"0-\r\n\r\n",
                     b"GET / HTTP/1.1\r\n" + b"A: b\r\n" * 20000 + b"\r\n"):
            self.raw(text)
            self.assertIsNone(self.process.poll(), f"it ended after {text[:60]}")
        self.assertIsNone(self.got("GET", "/api/v1/state")["job"])

    def test_the_command_of_the_unit_starts_it(self):
        unit = (harness.ROOT / "apps/turnscan/serve/turnscan.service").read_text()
        words = re.search("^ExecStart=turnscan (.+)$", unit, re.M)[1]
        (self.dir / "turnscan").mkdir()
        for options in ("", "--listen 0.0.0.0 --token auto --port 0"):
            words_now = words.replace("%S", str(self.dir)).replace("$TURNSCAN_OPTIONS", options).split()
            process = start(*words_now, *([] if options else ["--port", "0"]), cwd=self.dir)
            self.addCleanup(self.kill, process)
            self.assertEqual(process.stdout.readline(), f"Scans are in {self.dir}/turnscan/scans\n")
            self.assertIn("http://", process.stdout.readline())
            process.send_signal(signal.SIGTERM)
            self.assertEqual(process.wait(timeout=10), 0)

    def test_a_second_server_does_not_take_the_port(self):
        self.serve()
        second = start("serve", "other", "--port", str(self.port), cwd=self.dir)
        self.addCleanup(self.kill, second)
        self.assertEqual(second.wait(timeout=30), FAILED)
        self.assertIn("cannot listen", second.stderr.read())

    def test_peers_that_stall_do_not_keep_others_out(self):
        self.serve()
        stalled = []
        self.addCleanup(lambda: [s.close() for s in stalled])
        for i in range(120):  # more than there are connections
            peer = socket.create_connection(("127.0.0.1", self.port), 10)
            if i % 2:
                peer.sendall(b"GET /api/v1/state HTTP/1.1\r\nHost: loc")
            stalled.append(peer)
        begun = time.monotonic()
        self.got("GET", "/api/v1/state")
        self.assertLess(time.monotonic() - begun, 5.0)

    def test_watchers_see_the_state_and_are_limited(self):
        self.serve()
        self.become_operator()
        streams = []
        for _ in range(16):
            peer = socket.create_connection(("127.0.0.1", self.port), 60)
            peer.sendall(b"GET /api/v1/events HTTP/1.1\r\nHost: localhost\r\n\r\n")
            self.assertIn(b"200 OK", peer.recv(4096))
            streams.append(peer)
            self.addCleanup(peer.close)
        self.got("GET", "/api/v1/events", status=503)
        self.start_scan(SLOW)
        seen = b""
        while b'"record"' not in seen:
            seen += streams[3].recv(65536)
        self.assertIn(b"event: state\ndata: {", seen)
        streams.pop().close()
        deadline = time.monotonic() + 5.0
        while True:  # its place is free
            peer = socket.create_connection(("127.0.0.1", self.port), 60)
            self.addCleanup(peer.close)
            peer.sendall(b"GET /api/v1/events HTTP/1.1\r\nHost: localhost\r\n\r\n")
            if b"200 OK" in peer.recv(4096):
                break
            self.assertLess(time.monotonic(), deadline)
        self.wait_for(lambda job: job["frames"] > 0)
        self.assertIn("running", [scan["state"] for scan in self.got("GET", "/api/v1/scans")["scans"]])
        self.got("POST", "/api/v1/job/cancel", status=202)
        self.assertEqual(self.ended()["state"], "cancelled")

    def test_one_operates_and_leaving_stops_nothing(self):
        self.serve()
        self.got("POST", "/api/v1/scans", {"device": SLOW}, 403)
        self.become_operator()
        first = self.operator
        self.operator = {}
        self.got("POST", "/api/v1/operator", status=409)
        self.got("POST", "/api/v1/operator", status=409, Turnscan_Operator="0" * 32)
        self.got("POST", "/api/v1/scans", {"device": SLOW}, 403, Turnscan_Operator="0" * 32)
        self.operator = first
        scan = self.start_scan(SLOW)
        self.got("POST", "/api/v1/scans", {"device": SLOW}, 409)
        self.got("POST", "/api/v1/job/answer", {"another_side": True}, 409)
        self.got("DELETE", "/api/v1/operator")
        self.become_operator()
        self.assertNotEqual(self.operator, first)
        self.wait_for(lambda job: job["frames"] > 5)
        self.got("POST", "/api/v1/job/cancel", status=403, **{"Turnscan-Operator": "x"})
        self.got("POST", "/api/v1/job/cancel", status=202)
        self.assertEqual(self.ended()["state"], "cancelled")
        self.got("POST", "/api/v1/job/cancel", status=409)
        described = self.got("GET", f"/api/v1/scans/{scan}")
        self.assertEqual(described["state"], "recorded")
        self.assertGreater(described["frames"], 5)
        self.ok("info", f"data/{scan}/recording")

    def test_a_device_that_fails_is_said_and_leaves_nothing(self):
        broken = "virtual:doll?sensor=none-of-this-name"
        self.serve("--device", broken)
        self.become_operator()
        self.start_scan(broken)
        job = self.ended()
        self.assertEqual(job["state"], "failed")
        self.assertIn("none-of-this-name", job["error"])
        self.assertEqual(list((self.dir / "data").iterdir()), [])

    def end_in_mid_scan(self, how, device=SLOW):
        self.serve()
        self.become_operator()
        scan = self.start_scan(device)
        self.wait_for(lambda job: job["frames"] > 5)
        peer = socket.create_connection(("127.0.0.1", self.port), 10)
        self.addCleanup(peer.close)
        peer.sendall(b"GET /api/v1/events HTTP/1.1\r\nHost: localhost\r\n\r\n")
        begun = time.monotonic()
        self.process.send_signal(how)
        code = self.process.wait(10)
        took = time.monotonic() - begun
        self.serve()
        return scan, code, took

    def test_sigterm_ends_it_at_once_and_keeps_the_recording(self):
        scan, code, took = self.end_in_mid_scan(signal.SIGTERM)
        self.assertEqual(code, 0)
        self.assertLess(took, ENDS_WITHIN_S)
        described = self.got("GET", f"/api/v1/scans/{scan}")
        self.assertIn(described["state"], ("recorded", "unfinished"))
        self.assertGreater(described["frames"], 5)

    def test_a_killed_server_lists_what_it_left(self):
        scan, _, _ = self.end_in_mid_scan(signal.SIGKILL)
        self.assertEqual(self.got("GET", "/api/v1/scans")["scans"], [{"id": scan, "state": "unfinished"}])
        described = self.got("GET", f"/api/v1/scans/{scan}")
        self.assertGreater(described["frames"], 5)
        self.assertNotIn(str(self.dir), json.dumps(described))

    def test_the_scan_of_a_killed_server_goes_on_and_can_be_deleted(self):
        scan, _, _ = self.end_in_mid_scan(signal.SIGKILL, BRISK)
        before = self.got("GET", f"/api/v1/scans/{scan}")["frames"]
        path = f"/api/v1/scans/{scan}"
        for method, where in (("POST", path + "/resume"), ("DELETE", path)):
            self.got(method, where, status=403)
        self.become_operator()
        self.assertEqual(self.got("POST", path + "/resume", status=202), {"id": scan})
        self.got("DELETE", path, status=409)
        self.got("POST", path + "/resume", status=409)
        self.wait_for(lambda job: job["state"] == "asking")
        self.got("POST", "/api/v1/job/answer", {"another_side": False}, 202)
        self.assertEqual(self.ended()["state"], "done")
        described = self.got("GET", path)
        self.assertEqual(described["state"], "done")
        self.assertGreater(described["frames"], before)
        self.assertIn("mesh.3mf", [file["name"] for file in described["files"]])
        self.got("POST", path + "/resume", status=409)
        self.got("DELETE", path)
        self.got("GET", path, status=404)
        self.got("DELETE", path, status=404)
        self.assertEqual(list((self.dir / "data").iterdir()), [])

    def test_what_is_not_a_scan_is_neither_deleted_nor_gone_on_with(self):
        self.serve()
        self.become_operator()
        kept = self.dir / "kept"
        (kept / "recording").mkdir(parents=True)
        (self.dir / "data" / "20200101-000000").symlink_to(kept)
        (self.dir / "data" / "Notes").mkdir()
        for name in ("20200101-000000", "Notes", "..", "%2e%2e", "20200101-000001"):
            self.assertIn(self.ask("DELETE", f"/api/v1/scans/{name}")[0], (404, 405), name)
            self.assertIn(self.ask("POST", f"/api/v1/scans/{name}/resume")[0], (404, 405), name)
        self.assertTrue((kept / "recording").exists())
        self.assertTrue((self.dir / "data" / "Notes").exists())
        # A recording that names a device that was not offered: it would open what it likes.
        run("simulate", "builtin:letter-a", "--frames", "4", "-o", self.dir / "data/a/recording", cwd=self.dir)
        self.got("POST", "/api/v1/scans/a/resume", status=409)
        header = self.dir / "data/a/recording/recording.json"
        header.write_text(header.read_text().replace('"complete": true', '"complete": false'))
        self.assertEqual(self.got("GET", "/api/v1/scans/a")["state"], "unfinished")
        self.got("POST", "/api/v1/scans/a/resume", status=400)

    def test_the_page_leads_to_a_mesh(self):
        if not browser.find() or not has_page():
            self.skipTest("there is no chromium, or turnscan was built without its page")
        self.serve()
        with browser.Browser() as chromium:
            page = chromium.open_address(self.address, 360, 640)
            title = "document.getElementById('title').textContent"
            press = "document.querySelector('#buttons button').click()"
            page.wait(f"{title} === 'Place the object' && document.querySelector('#device').options.length")
            self.keep(page, "place-360")
            # One that takes its time, so that the page cannot miss the recording.
            page.evaluate("document.querySelector('#device').selectedIndex = 2")
            page.evaluate(press)
            page.wait(f"{title} === 'Recording'", harness.HANG_S)
            page.wait("!document.getElementById('live').hidden")
            # What the page shows with each title that follows, however briefly.
            page.evaluate("steps = []; new MutationObserver(() => "
                          f"steps.push([{title}, document.getElementById('surface').hidden].join()))"
                          ".observe(document.getElementById('title'), {childList: true})")
            frames = "+(document.getElementById('surface').dataset.frames ?? 0)"
            page.wait(f"!document.getElementById('surface').hidden && {frames} > 0")
            before = page.evaluate(frames)
            page.wait(f"{frames} > {before} || {title} !== 'Recording'")  # a slow machine may see one alone
            self.assertGreater(page.evaluate(DRAWN), 0.02)
            self.keep(page, "record-360")
            self.assertLessEqual(page.evaluate("document.documentElement.scrollWidth"), 360)
            page.resize(1440, 900)
            self.keep(page, "record-1440")
            page.resize(360, 640)
            page.wait(f"{title} !== 'Recording'", harness.HANG_S)
            page.wait(f"{title} === 'Turn it over?'", harness.HANG_S)
            self.assertIn("Computing the model,false", page.evaluate("steps.join(';')"))
            self.assertTrue(page.evaluate("document.getElementById('surface').hidden"))
            page.wait("!document.getElementById('advice').hidden")
            self.keep(page, "turn-360")
            page.evaluate(press)
            page.wait(f"{title} === 'The model is ready'")
            page.wait("document.getElementById('model').dataset.state === 'drawn'")
            page.wait("[...document.querySelectorAll('#files a')].some((a) => a.href.endsWith('mesh.3mf'))")
            self.keep(page, "ready-360")
            self.assertLessEqual(page.evaluate("document.documentElement.scrollWidth"), 360)
            self.assertEqual(page.complaints(), [])
            for address in page.requests():
                self.assertTrue(address.startswith((self.address, "blob:" + self.address)), address)
            for width, height in ((768, 1024), (1440, 900)):
                # Further pages, of somebody who only watches; the browser remembers their language.
                other = chromium.open_address(self.address, width, height)
                other.wait("document.getElementById('model').dataset.state === 'drawn'")
                other.evaluate("(l => { l.value = 'de'; l.dispatchEvent(new Event('change')); })"
                               "(document.getElementById('language'))")
                other.wait(f"{title} === 'Das Modell ist fertig'")
                other.wait("document.getElementById('model').dataset.state === 'drawn'")
                self.assertNotIn("Weiteres Objekt", other.evaluate("document.body.innerText"))
                self.assertEqual(other.complaints(), [])
                self.keep(other, f"ready-{width}")
                self.assertEqual(other.evaluate("document.querySelectorAll('#result-buttons button').length"), 0)
            # Deleting takes two presses, and the first of the two buttons then keeps it.
            buttons = "[...document.querySelectorAll('#result-buttons button')].map((b) => b.textContent).join()"
            last = "[...document.querySelectorAll('#result-buttons button')].at(-1).click()"
            page.wait(f"{buttons} === 'Delete this scan'")
            page.evaluate(last)
            page.wait(f"{buttons} === 'Keep it,Delete'")
            self.keep(page, "delete-360")
            page.evaluate(last)
            page.wait("document.getElementById('result').hidden && document.getElementById('scans').hidden")
            self.assertEqual(page.complaints(), [])

    def test_the_page_computes_the_model_of_what_was_only_recorded(self):
        if not browser.find() or not has_page():
            self.skipTest("there is no chromium, or turnscan was built without its page")
        self.serve()
        self.ok("capture", "--server", self.address, "--device", DEVICE, "-o", "mine")
        with browser.Browser() as chromium:
            page = chromium.open_address(self.address, 360, 640)
            title = "document.getElementById('title').textContent"
            page.wait(f"{title} === 'Recorded'")
            # Dismissed: the end of another job of the same scan is said all the same.
            page.evaluate("document.querySelector('#buttons button').click()")
            page.wait(f"{title} === 'Place the object'")
            compute = "[...document.querySelectorAll('#result-buttons button')].find((b) => b.textContent === 'Compute the model')"
            page.wait(f"{compute} !== undefined")
            self.keep(page, "recorded-360")
            page.evaluate(f"{compute}.click()")
            page.wait(f"{title} === 'The model is ready'", harness.HANG_S)
            page.wait("document.getElementById('model').dataset.state === 'drawn'")
            self.assertEqual(page.complaints(), [])

    def keep(self, page, name):
        if SHOTS:
            page.screenshot(pathlib.Path(SHOTS) / f"serve-{name}.png")


def has_page():
    folders = pathlib.Path(shutil.which(harness.BIN) or harness.BIN).resolve().parents
    return any((f / "share/turnscan/page/serve.html").exists() for f in list(folders)[:4])


if __name__ == "__main__":
    if run("serve", "--openapi").returncode == USAGE:
        print("skipped: turnscan was built without its server")
        sys.exit(SKIPPED)
    harness.main()
