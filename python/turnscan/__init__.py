"""turnscan: from frames of an object on a turntable to a watertight mesh.

Metres, radians and seconds throughout; depth images are of type uint16 in units of their sensor.
Options are keyword arguments with the names of the command line, hyphens written as underscores:
`voxel_size="1.5mm"` or `voxel_size=0.0015`. `options("reconstruct")` lists them.
"""

import os as _os

import numpy as _np


def _name_folders():
    """The library looks beside the running program, which is Python: tell it where presets and
    helper programs are: in a wheel, in the build tree, in an installation below any prefix."""
    package = _os.path.dirname(_os.path.abspath(__file__))
    for up in (".", "../..", "../../../.."):
        prefix = _os.path.normpath(_os.path.join(package, up))
        if _os.path.isdir(_os.path.join(prefix, "share", "turnscan")):
            _os.environ.setdefault("TURNSCAN_DATA", _os.path.join(prefix, "share", "turnscan"))
            _os.environ.setdefault("TURNSCAN_LIBEXEC",
                                   _os.path.join(prefix, "libexec", "turnscan"))
            return


_name_folders()

from . import _turnscan  # noqa: E402
from ._turnscan import (Calibration, Frame, Intrinsics, Mesh, Reconstruction, Recording, Sensor,
                        Sequence, Simulation, Source, Turntable, set_threads, __version__)
from .errors import Error, OptionError
from .rig import Rig

__all__ = ["Calibration", "Error", "Frame", "Frames", "Intrinsics", "Mesh", "OptionError",
           "Reconstruction", "Recording", "Rig", "Sensor", "Sequence", "Simulation", "Source", "Stream",
           "Turntable", "batch", "calibrate", "evaluate", "inspect", "options", "plan",
           "reconstruct", "set_threads", "simulate"]

_NO_RETURN, _LARGEST = 0, 65534  # 65535 means a return outside the crop


def _raw_depth(depth, unit, camera):
    """Depth as the sensor counts it. Floating-point images are metres; what is not finite or not
    positive is no return."""
    depth = _np.asarray(depth)
    if depth.shape != (camera.height, camera.width):
        raise Error(f"depth: the array has the shape {depth.shape}, and its camera {camera.height} "
                    f"rows of {camera.width} pixels", "format")
    if depth.dtype.kind in "ui":
        if depth.dtype != _np.uint16 and (depth.min() < 0 or depth.max() > 65535):
            raise Error("depth: values must fit into 16 bits; give metres, or another unit",
                        "format")
        return depth
    if depth.dtype.kind != "f":
        raise Error(f"depth: numbers are needed, not {depth.dtype}", "format")
    with _np.errstate(invalid="ignore", over="ignore"):
        steps = _np.rint(depth / unit)
        steps[~((steps > 0) & (steps <= _LARGEST))] = _NO_RETURN
    return steps.astype(_np.uint16)


def _sequence(frames):
    if isinstance(frames, (str, _os.PathLike)):
        return Recording(_os.fspath(frames))
    if not isinstance(frames, Sequence):
        raise TypeError(f"a recording is a path or a sequence of frames, not {type(frames).__name__}")
    return frames


class Frames(_turnscan._Frames):
    """A sequence of frames from numpy arrays: Frames([Sensor(...)], turntable)."""

    def add(self, depth, angle=None, *, time=None, sensor=0, pass_=0, turn=0, pose=None,
            color=None):
        """Appends a frame (its arrays are copied). angle: how far the platter has turned since
        the first frame; pose: 4x4, sensor to table, takes precedence over the angle."""
        sensors = self.sensors
        if not 0 <= sensor < len(sensors):
            raise OptionError(f"sensor: there is no {sensor}", "invalid-option")
        of = sensors[sensor]
        self._add(_raw_depth(depth, of.depth_unit, of.intrinsics), angle, time, sensor, pass_, turn,
                  pose, color)


class Stream(_turnscan._Stream):
    """Reconstruction of frames as they come: Stream(turntable=..., depth_unit=1e-4, **options)."""

    def __init__(self, turntable=None, depth_unit=1e-4, pose=None, **options):
        super().__init__(turntable, depth_unit, pose, **options)
        self._depth_unit = depth_unit

    def add(self, depth, intrinsics, angle=None, *, time=None, pose=None, color=None):
        """Works on a frame. Needs its angle or its pose, or the turntable's speed and a time."""
        self._add(_raw_depth(depth, self._depth_unit, intrinsics), intrinsics, angle, time, pose, color)


def reconstruct(recordings, *, calibration="auto", turntable="", allow_open=False, progress=None,
                **options):
    """Meshes of what stands on the table: as the command `turnscan reconstruct`.

    recordings: a path, a sequence of frames, or a list of them (the passes of one object).
    progress(phase, fraction) may raise to cancel."""
    if isinstance(recordings, (str, _os.PathLike, Sequence)):
        recordings = [recordings]
    return _turnscan._reconstruct([_sequence(r) for r in recordings], progress,
                                  calibration=calibration, turntable=_os.fspath(turntable),
                                  allow_open=allow_open, **options)


def calibrate(recording, *, way="auto", progress=None, **options):
    """Where the turntable stands and how it turns: as `turnscan calibrate`.

    way: "auto", "motion" (of the object), "platter" (its surface and rim)."""
    ways = {"auto": {}, "motion": {"from_motion": True}, "platter": {"detect": True}}
    if way not in ways:
        raise OptionError(f"way: there is no '{way}'; use auto, platter or motion",
                          "invalid-option")
    return _turnscan.calibrate(_sequence(recording), progress, **ways[way], **options)


def simulate(object, *, scanners=(), out=None, progress=None, **options):
    """A virtual scan of a mesh file or "builtin:NAME": a sequence of frames that are rendered when
    they are read. out: folder of a recording to write as well."""
    return _turnscan.simulate(_os.fspath(object), None if out is None else _os.fspath(out),
                              progress, scanner=list(scanners), **options)


def plan(objects, *, scanners, out=None, unit="", progress=None, **options):
    """Where to put which sensors for how many passes: plan.json of `turnscan plan` as a dict.

    objects: a mesh file or "builtin:NAME", or a list of them. out: folder for scenes and pictures;
    None: none are written. Trials run in this process."""
    if isinstance(objects, (str, _os.PathLike)):
        objects = [objects]
    return _turnscan.plan([_os.fspath(o) for o in objects], progress, scanner=list(scanners),
                          out="" if out is None else _os.fspath(out), unit=unit, **options)


def evaluate(mesh, reference, *, progress=None, **options):
    """How far a mesh is from a reference: the figures of `turnscan evaluate --json` as a dict."""
    return _turnscan.evaluate(mesh, reference, progress, **options)


def inspect(mesh, elements, *, progress=None):
    """Fits elements to a mesh and measures their distances and angles: the figures of
    `turnscan evaluate --elements --json` as a dict.

    elements: what the file of --elements holds, as a dict of lists and dicts."""
    return _turnscan.inspect(mesh, elements, progress)


def batch(inputs, out, *, command="", sweep=(), engine=(), program="turnscan", progress=None,
          **options):
    """Many recordings with the same options, or one with many: as `turnscan batch run`.

    inputs: recordings, folders of recordings, or a table; out: the folder of the results. sweep:
    {option: values}, engine: {"jobs": 2, ...}; program: the turnscan program, which runs the tasks.
    Values of options are texts, as on the command line. Returns counts and the summary's files."""
    if isinstance(inputs, (str, _os.PathLike)):
        inputs = [inputs]
    pairs = [[(name.replace("_", "-"), value) for name, value in dict(given).items()]
             for given in (options, sweep, engine)]
    text = [[(name, str(value)) for name, value in given] for given in (pairs[0], pairs[2])]
    swept = [(name, [str(value) for value in values]) for name, values in pairs[1]]
    return _turnscan._batch([_os.fspath(i) for i in inputs], _os.fspath(out), command, text[0],
                            swept, text[1], _os.fspath(program), progress)


def options(command):
    """Names, defaults, ranges and help of the options of "reconstruct", "calibrate", "simulate",
    "plan", "evaluate", "import"."""
    described = getattr(_turnscan, f"_{command}_options", None)
    if described is None:
        raise OptionError(f"command: there are no options of '{command}'", "invalid-option")
    return described()
