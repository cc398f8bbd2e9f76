"""Recordings that several tests look at, each made once and not to be changed.

CTest makes them before the suites that need them (fixtures), in the folder that TURNSCAN_RECORDINGS
names; TURNSCAN_RECORDINGS_MADE lists those. A suite that is started by hand makes what it needs itself.

    recordings.py make NAME    makes one in that folder
    recordings.py check        says which of them were changed since
"""

import atexit
import functools
import hashlib
import json
import os
import pathlib
import shutil
import sys
import tempfile

import harness
from harness import NARROW

# What each is made by, but for its folder.
COMMANDS = {
    # For what needs a recording that can be reconstructed, and not its finest detail.
    "cylinder": ("simulate", "builtin:cylinder", "--scanner",
                 pathlib.Path(__file__).with_name("small.toml"), "--frames", 24, "--noise",
                 "gaussian:1mm"),
    # A demo of a built-in object: the recording, its mesh and the truth.
    "demo-cylinder": ("demo", "--object", "cylinder", "--frames", 60, *NARROW, *harness.SMALL_PICTURE),
    "demo-pair": ("demo", "--object", "pair", "--frames", 48, *NARROW, *harness.COARSE, *harness.SMALL_PICTURE),
    "letter-a": ("simulate", "builtin:letter-a", "--frames", 60, *NARROW, "--aim-height", "90mm",
                 "--mixed-pixels", 0.5),
    # For what needs a recording and does not look at its frames.
    "three-frames": ("simulate", "builtin:cylinder", "--frames", 3, *NARROW),
    # For the truth.
    "doll": ("simulate", "builtin:doll", "--frames", 2, *NARROW),
    "skull": ("simulate", "builtin:skull", "--frames", 24, *NARROW, "--seed", 3, "--noise",
              "gaussian:1mm"),
    "skull-twice": ("simulate", "builtin:skull", "--frames", 24, *NARROW, "--seed", 3, "--noise",
                    "gaussian:1mm", "--next-pass", "tip=90deg,yaw=40deg"),
    "colour-doll": ("simulate", "builtin:doll", "--height", "100mm", "--frames", 10, *NARROW, "--distance",
                    "0.6m", "--noise", "none", "--platter-radius", "80mm", "--scan-colour",
                    "--colour-width", 320, "--colour-fov", "20deg", "--colour-drift", 0.2),
}
PLACE = os.environ.get("TURNSCAN_RECORDINGS")
MADE = os.environ.get("TURNSCAN_RECORDINGS_MADE", "").split(",")


def sums(folder):
    """The SHA-256 of every file below."""
    return {str(path.relative_to(folder)): hashlib.sha256(path.read_bytes()).hexdigest()
            for path in sorted(folder.rglob("*")) if path.is_file()}


def make(name, parent):
    """Makes the recording anew and protects it; its folder."""
    folder = parent / name
    harness.remove(folder)
    result = harness.run(*COMMANDS[name], "--out", folder, "--quiet")
    if result.returncode != 0:
        raise AssertionError(f"recording {name}: {result.stderr}")
    for path in [folder, *folder.rglob("*")]:
        path.chmod(0o555 if path.is_dir() else 0o444)
    return folder


@functools.lru_cache(maxsize=None)
def folder_of(name):
    """Where the recording is."""
    if not PLACE:
        parent = pathlib.Path(tempfile.mkdtemp(prefix="turnscan-e2e-recording-"))
        atexit.register(harness.remove, parent)
        return make(name, parent)
    if name not in MADE:
        raise AssertionError(f"tests/e2e/CMakeLists.txt does not say that this suite needs {name}")
    return pathlib.Path(PLACE) / name


def shared_demo(name="cylinder"):
    """Folder of a demo of a built-in object."""
    return folder_of(f"demo-{name}") / name


def shared_recording():
    """A recording of a cylinder of 80 x 160 mm in small images."""
    return folder_of("cylinder")


def mesh_of(name):
    """The object of a recording, for `simulate` and behind `virtual:`: to make the doll or the skull takes
    three seconds and more."""
    return folder_of(name) / "truth/object.ply"


def link(name, target):
    """The recording under another name, which commands say and write beside."""
    target.symlink_to(folder_of(name), target_is_directory=True)


def copy(folder, target):
    """A copy that may be changed."""
    shutil.copytree(folder, target, copy_function=shutil.copyfile)
    for path in [target, *target.rglob("*")]:
        if path.is_dir():
            path.chmod(0o755)
    return target


def sums_file(parent, name):
    return parent / f"{name}.sha256"


def main(action, *names):
    parent = pathlib.Path(PLACE)
    if action == "make":
        parent.mkdir(parents=True, exist_ok=True)
        for name in names:
            sums_file(parent, name).write_text(json.dumps(sums(make(name, parent))))
        return 0
    # The superuser may write what is protected.
    changed = [name for name in COMMANDS if sums_file(parent, name).exists() and
               sums_file(parent, name).read_text() != json.dumps(sums(parent / name))]
    for name in changed:
        print(f"{parent / name} was changed by a test, which must copy it first")
    return 1 if changed else 0


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
