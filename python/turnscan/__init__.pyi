import os
from typing import Any, Callable, Iterable, Mapping, Optional, Sequence as _List, Union

import numpy as np
import numpy.typing as npt

from .errors import Error as Error, OptionError as OptionError

__version__: str
_Path = Union[str, os.PathLike[str]]
_Progress = Optional[Callable[[str, float], Any]]
_Option = Union[str, float, bool, None]
_Pose = npt.NDArray[np.float64]

class Mesh:
    def __init__(self, vertices: npt.ArrayLike, triangles: npt.ArrayLike,
                 colors: Optional[npt.ArrayLike] = None) -> None: ...
    @staticmethod
    def load(path: str, unit: Optional[str] = None) -> Mesh: ...
    def save(self, path: str, up: str = "auto") -> None: ...
    @property
    def vertices(self) -> npt.NDArray[np.float32]: ...
    @property
    def triangles(self) -> npt.NDArray[np.uint32]: ...
    @property
    def normals(self) -> npt.NDArray[np.float32]: ...
    @property
    def colors(self) -> npt.NDArray[np.uint8]: ...
    @property
    def name(self) -> str: ...

class Intrinsics:
    def __init__(self, width: int, height: int, fx: float, fy: float, cx: float, cy: float,
                 distortion: _List[float] = ...) -> None: ...
    width: int
    height: int
    fx: float
    fy: float
    cx: float
    cy: float
    distortion: list[float]

class Sensor:
    def __init__(self, intrinsics: Intrinsics, depth_unit: float = 1e-4,
                 pose: Optional[npt.ArrayLike] = None, model: str = "") -> None: ...
    intrinsics: Intrinsics
    depth_unit: float
    depth_bias: float
    model: str
    @property
    def pose(self) -> Optional[_Pose]: ...

class Turntable:
    def __init__(self, axis: _List[float], center: _List[float], radius: Optional[float] = None,
                 speed: Optional[float] = None) -> None: ...
    axis: list[float]
    center: list[float]
    radius: Optional[float]
    speed: Optional[float]

class Frame:
    depth: npt.NDArray[np.uint16]
    color: npt.NDArray[np.uint8]
    points: npt.NDArray[np.float32]
    index: int
    time: float
    sensor: int
    pass_: int
    turn: int
    angle: Optional[float]
    pose: Optional[_Pose]
    dropped: bool

class Sequence:
    def __len__(self) -> int: ...
    def __getitem__(self, position: int) -> Frame: ...
    @property
    def sensors(self) -> list[Sensor]: ...
    @property
    def turntable(self) -> Optional[Turntable]: ...

class Recording(Sequence):
    def __init__(self, path: str, **import_options: _Option) -> None: ...
    path: str
    notes: list[str]
    complete: bool

class Simulation(Sequence):
    @property
    def truth(self) -> list[Mesh]: ...
    def evaluate(self, mesh: Mesh, progress: _Progress = None,
                 **options: _Option) -> dict[str, Any]: ...

class Source:
    def __init__(self, uri: str) -> None: ...
    def __iter__(self) -> Source: ...
    def __next__(self) -> Frame: ...
    def stop(self) -> None: ...
    @property
    def sensors(self) -> list[Sensor]: ...
    @property
    def turntable(self) -> Optional[Turntable]: ...

class Frames(Sequence):
    def __init__(self, sensors: _List[Sensor], turntable: Optional[Turntable] = None) -> None: ...
    def add(self, depth: npt.ArrayLike, angle: Optional[float] = None, *,
            time: Optional[float] = None, sensor: int = 0, pass_: int = 0, turn: int = 0,
            pose: Optional[npt.ArrayLike] = None,
            color: Optional[npt.ArrayLike] = None) -> None: ...
    def save(self, path: str, progress: _Progress = None) -> None: ...

class Stream:
    def __init__(self, turntable: Optional[Turntable] = None, depth_unit: float = 1e-4,
                 pose: Optional[npt.ArrayLike] = None, **options: _Option) -> None: ...
    def add(self, depth: npt.ArrayLike, intrinsics: Intrinsics, angle: Optional[float] = None, *,
            time: Optional[float] = None, pose: Optional[npt.ArrayLike] = None,
            color: Optional[npt.ArrayLike] = None) -> None: ...
    def preview(self) -> Mesh: ...
    def finish(self, progress: _Progress = None) -> list[Mesh]: ...
    def __len__(self) -> int: ...

class Reconstruction:
    @property
    def meshes(self) -> list[Mesh]: ...
    @property
    def notes(self) -> list[str]: ...
    @property
    def verdicts(self) -> list[str]: ...
    @property
    def report(self) -> dict[str, Any]: ...
    def save(self, path: str, report: str = "", page: str = "",
             up: str = "auto") -> list[str]: ...

class Calibration:
    @property
    def turntable(self) -> Turntable: ...
    angles: list[float]
    notes: list[str]
    center_sigma: float
    axis_sigma: float
    def save(self, path: str) -> None: ...

_Frames = Union[_Path, Sequence]

def reconstruct(recordings: Union[_Frames, Iterable[_Frames]], *, calibration: str = "auto",
                turntable: _Path = "", allow_open: bool = False, progress: _Progress = None,
                **options: _Option) -> Reconstruction: ...
def calibrate(recording: _Frames, *, way: str = "auto", progress: _Progress = None,
              **options: _Option) -> Calibration: ...
def simulate(object: _Path, *, scanners: Iterable[str] = (), out: Optional[_Path] = None,
             progress: _Progress = None, **options: _Option) -> Simulation: ...
def plan(objects: Union[_Path, Iterable[_Path]], *, scanners: Iterable[str],
         out: Optional[_Path] = None, unit: str = "", progress: _Progress = None,
         **options: _Option) -> dict[str, Any]: ...
def evaluate(mesh: Mesh, reference: Mesh, *, progress: _Progress = None,
             **options: _Option) -> dict[str, Any]: ...
def batch(inputs: Union[_Path, Iterable[_Path]], out: _Path, *, command: str = "",
          sweep: Mapping[str, Iterable[Any]] = ..., engine: Mapping[str, Any] = ...,
          program: _Path = "turnscan", progress: _Progress = None,
          **options: Any) -> dict[str, Any]: ...
def options(command: str) -> list[dict[str, Any]]: ...
def set_threads(count: int) -> None: ...
