"""What `pip wheel` and `python3 -m build` call (PEP 517): makes a wheel of the module with CMake.

It needs nothing but Python itself, so that it works without a network. A build folder that is
there already is taken with `--config-settings build-dir=build/release`; otherwise the module is
built in a folder of its own. A wheel holds the module, the presets of scanners and the helper
programs; the libraries that these link are Debian's, and stay where they are.
"""

import base64
import hashlib
import pathlib
import re
import shutil
import stat
import subprocess
import sys
import sysconfig
import tempfile
import zipfile

ROOT = pathlib.Path(__file__).resolve().parents[1]
# Folders of a build and of the package.
PARTS = [("python/turnscan", "turnscan"), ("libexec/turnscan", "turnscan/libexec/turnscan")]
PRESETS = "turnscan/share/turnscan/scanners"


def version():
    text = (ROOT / "CMakeLists.txt").read_text()
    return re.search(r"^project\(turnscan VERSION ([0-9.]+)", text, re.M).group(1)


def tag():
    python = f"cp{sys.version_info.major}{sys.version_info.minor}"
    platform = sysconfig.get_platform().replace("-", "_").replace(".", "_")
    return f"{python}-{python}-{platform}"


def metadata():
    major, minor = sys.version_info[:2]
    return (f"Metadata-Version: 2.1\nName: turnscan\nVersion: {version()}\n"
            "Summary: From an object on a turntable to a watertight mesh\n"
            "License: Apache-2.0\n"
            f"Requires-Python: >={major}.{minor},<{major}.{minor + 1}\n"
            "Requires-Dist: numpy\nDescription-Content-Type: text/markdown\n\n"
            + (ROOT / "docs" / "reference" / "python.md").read_text())


def wheel_text():
    return f"Wheel-Version: 1.0\nGenerator: turnscan\nRoot-Is-Purelib: false\nTag: {tag()}\n"


class WheelFile:
    """A wheel that is being written: a zip with the hash of each file in RECORD. Its files have no
    times, so that the same build gives the same bytes."""

    def __init__(self, path):
        self.zip = zipfile.ZipFile(path, "w", zipfile.ZIP_DEFLATED)
        self.record = []
        self.info = f"turnscan-{version()}.dist-info"

    def add(self, name, data, executable=False):
        entry = zipfile.ZipInfo(name)
        entry.compress_type = zipfile.ZIP_DEFLATED
        entry.external_attr = (stat.S_IFREG | (0o755 if executable else 0o644)) << 16
        self.zip.writestr(entry, data)
        digest = base64.urlsafe_b64encode(hashlib.sha256(data).digest()).rstrip(b"=").decode()
        self.record.append(f"{name},sha256={digest},{len(data)}\n")

    def close(self):
        self.add(f"{self.info}/METADATA", metadata().encode())
        self.add(f"{self.info}/WHEEL", wheel_text().encode())
        self.add(f"{self.info}/LICENSE", (ROOT / "LICENSE").read_bytes())
        name = f"{self.info}/RECORD"
        self.zip.writestr(zipfile.ZipInfo(name), "".join(self.record) + f"{name},,\n")
        self.zip.close()


def run(*command):
    subprocess.run([str(part) for part in command], check=True)


def built_in(folder):
    run("cmake", "-S", ROOT, "-B", folder, "-DCMAKE_BUILD_TYPE=Release",
        "-DCMAKE_CXX_FLAGS_RELEASE=-O2 -DNDEBUG", "-DTURNSCAN_UNITY=ON", "-DTURNSCAN_BUILD_APPS=OFF",
        "-DTURNSCAN_BUILD_TESTS=OFF", "-DTURNSCAN_BUILD_STUDIO=OFF",
        f"-DPython_EXECUTABLE={sys.executable}")
    run("cmake", "--build", folder, "--parallel")
    return folder


def stripped(path, scratch):
    """The bytes of a program or library without symbols, where there is a strip."""
    if shutil.which("strip") is None or path.suffix not in ("", ".so"):
        return path.read_bytes()
    copy = scratch / "stripped"
    run("strip", "--strip-unneeded", "-o", copy, path)
    return copy.read_bytes()


def add_built(wheel, build, scratch):
    if not list((build / "python/turnscan").glob("_turnscan*.so")):
        raise SystemExit(f"turnscan: {build} holds no Python module; it needs pybind11-dev, "
                         "python3-dev and python3-numpy (scripts/setup python)")
    for source, target in PARTS:
        for path in sorted((build / source).iterdir()):
            if path.is_file():
                binary = path.suffix == ".so" or "libexec" in target
                data = stripped(path, scratch) if binary else path.read_bytes()
                wheel.add(f"{target}/{path.name}", data, executable="libexec" in target)
    for path in sorted((ROOT / "data/scanners").glob("*.toml")):
        wheel.add(f"{PRESETS}/{path.name}", path.read_bytes())


def build_wheel(wheel_directory, config_settings=None, metadata_directory=None):
    given = (config_settings or {}).get("build-dir")
    with tempfile.TemporaryDirectory(prefix="turnscan-wheel-") as scratch:
        scratch = pathlib.Path(scratch)
        build = pathlib.Path(given).resolve() if given else built_in(scratch / "build")
        name = f"turnscan-{version()}-{tag()}.whl"
        wheel = WheelFile(pathlib.Path(wheel_directory) / name)
        add_built(wheel, build, scratch)
        wheel.close()
    return name


def get_requires_for_build_wheel(config_settings=None):
    return []


def build_sdist(sdist_directory, config_settings=None):
    raise SystemExit("turnscan: there is no source distribution; take the repository")
