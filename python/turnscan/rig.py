"""A rig elsewhere: what `turnscan serve` offers, by its interface /api/v1."""

import json as _json
import os as _os
import time as _time
import urllib.error as _error
import urllib.parse as _parse
import urllib.request as _request

from .errors import Error

_ANSWERS_WITHIN_S = 30.0
_BETWEEN_LOOKS_S = 0.25
_PIECE = 1 << 16


def _path(*names):
    """Of what belongs to a scan. No name becomes more than one part of it."""
    return "/".join(["scans", *(_parse.quote(name, safe="") for name in names)])


class Rig:
    """The rig that `turnscan serve` makes of a computer: Rig("http://rig:8470", token="...").

    What is answered in JSON is returned as it is; `turnscan serve --openapi` describes it."""

    def __init__(self, url, token=None):
        parts = _parse.urlsplit(url)
        if parts.scheme not in ("http", "https") or not parts.hostname:
            raise Error(f"{url}: the address of a rig looks like http://rig:8470", "invalid-option")
        self._token = token or next(iter(_parse.parse_qs(parts.query).get("token", [])), None)
        self._url = f"{parts.scheme}://{parts.netloc}"
        self._key = ""
        # No proxy: the token is for the rig alone.
        self._opener = _request.build_opener(_request.ProxyHandler({}))

    def _open(self, method, path, body=None):
        headers = {"Authorization": f"Bearer {self._token}"} if self._token else {}
        if self._key:
            headers["Turnscan-Operator"] = self._key
        data = None if body is None else _json.dumps(body).encode()
        if data:
            headers["Content-Type"] = "application/json"
        asked = _request.Request(f"{self._url}/api/v1/{path}", data, headers, method=method)
        try:
            return self._opener.open(asked, timeout=_ANSWERS_WITHIN_S)
        except _error.HTTPError as refused:
            with refused:
                try:
                    why = _json.load(refused)["error"]
                    raise Error(f"{self._url}: {why['message']}", why["code"]) from None
                except (ValueError, KeyError, TypeError):
                    raise Error(f"{self._url}: answers with status {refused.code}; is it turnscan "
                                "serve?", "format") from None
        except OSError as failed:
            raise Error(f"{self._url}: does not answer ({getattr(failed, 'reason', failed)})",
                        "io") from None

    def _json(self, method, path, body=None):
        with self._open(method, path, body) as answer:
            try:
                return _json.load(answer) if answer.length != 0 else None
            except (ValueError, OSError) as failed:
                raise Error(f"{self._url}: answers with something else than JSON ({failed}); is it "
                            "turnscan serve?", "format") from None

    def _operate(self, path, body=None, method="POST"):
        """The operator's key lapses after a while without use: it is taken again for each call."""
        self._key = self._json("POST", "operator")["key"]
        try:
            return self._json(method, path, body)
        except Error:
            self._leave()
            raise

    def _leave(self):
        """So that the next program need not wait until the key lapses."""
        try:
            if self._key:
                self._json("DELETE", "operator")
        except Error:
            pass
        self._key = ""

    def devices(self):
        """The sensors that can be scanned with: a list of {"uri", "model", "kind"}."""
        return self._json("GET", "devices")["devices"]

    def scans(self):
        """The scans on its disk, the newest first: a list of {"id", "state"}."""
        return self._json("GET", "scans")["scans"]

    def describe(self, scan):
        """One scan: state, frames, bytes, files."""
        return self._json("GET", _path(scan))

    def verdict(self, scan):
        """How good each object of a scan is, and how to lay it for another pass."""
        return self._json("GET", _path(scan, "verdict"))

    def state(self):
        """What the rig does now, and whether somebody operates it."""
        return self._json("GET", "state")

    def scan(self, device, *, passes=1, ask=None, progress=None):
        """Scans what is on the turntable and returns the scan's id when its mesh is there.

        device: a uri of devices(). passes=None asks after each: ask(advice, pass) says whether the
        object lies another way now. progress(phase, fraction) may raise to cancel; fraction is None
        where it is not known."""
        if passes is None and ask is None:
            raise Error("passes: say how many, or give ask, which is called after each pass",
                        "invalid-option")
        body = {"device": device, **({} if passes is None else {"passes": passes})}
        return self.wait(self._operate("scans", body)["id"], ask=ask, progress=progress)

    def record(self, device, *, progress=None):
        """Records what is on the turntable and returns the scan's id; reconstruct() makes its mesh."""
        body = {"device": device, "record_only": True}
        return self.wait(self._operate("scans", body)["id"], progress=progress, record_only=True)

    def resume(self, scan, *, ask=None, progress=None):
        """Goes on with a recording that was not finished; without ask it is the last pass."""
        return self.wait(self._operate(_path(scan, "resume"))["id"], ask=ask, progress=progress)

    def reconstruct(self, scan, *, progress=None):
        """Makes meshes and report of a recording again."""
        return self.wait(self._operate(_path(scan, "reconstruct"))["id"], progress=progress)

    def wait(self, scan, *, ask=None, progress=None, record_only=False):
        """Until its scan or reconstruction has ended; returns the scan's id. A scan goes on while
        nobody waits, so that this may be called again after the network failed: with record_only
        for what record() began."""
        try:
            return self._wait(scan, ask, progress, record_only)
        finally:
            self._leave()

    def _wait(self, scan, ask, progress, record_only):
        while True:
            job = self.state()["job"]
            if job is None or job["id"] != scan:  # of another since, or the server is a new one
                left = self.describe(scan)["state"]
                if left == "done" or (record_only and left == "recorded"):
                    return scan
                raise Error(f"{self._url}: nothing is at work on {scan}, which is {left}",
                            "missing-data")
            if job["state"] == "done":
                return scan
            if job["state"] == "cancelled":
                raise Error(f"{scan} was cancelled", "cancelled")
            if job["state"] == "failed":
                raise Error(job["error"], "library")
            try:
                if progress:
                    progress(job["phase"], job["fraction"])
                more = None
                if job["state"] == "asking":
                    question = job["question"]
                    more = bool(ask(question["advice"], question["pass"])) if ask else False
                _time.sleep(_BETWEEN_LOOKS_S)
            except BaseException:
                try:
                    self.cancel()
                except Error:  # it has ended meanwhile
                    pass
                raise
            if more is not None:
                self._operate("job/answer", {"another_side": more})

    def delete(self, scan):
        """Deletes a scan, its recording and all that was made of it."""
        self._operate(_path(scan), method="DELETE")
        self._leave()

    def cancel(self):
        """Ends what the rig does; what was recorded is kept."""
        self._operate("job/cancel")
        self._leave()

    def download(self, scan, name, path=None):
        """Copies a file of a scan ("mesh.3mf") to a path, whole or not at all; returns the path."""
        path = _os.fspath(name if path is None else path)
        part = f"{path}.{_os.getpid()}.part"
        where = _path(scan, "files", name)
        with self._open("GET", where) as answer:
            left = answer.length
            try:
                with open(part, "xb") as out:
                    while piece := answer.read(_PIECE):
                        out.write(piece)
                        left -= len(piece)
                if left:
                    raise Error(f"{self._url}: {name} ended {left} bytes too early", "io", path)
                _os.replace(part, path)
            except OSError as failed:
                raise Error(f"{path}: {failed.strerror or failed}", "io", path) from None
            finally:
                if _os.path.exists(part):
                    _os.unlink(part)
        return path
