"""What is written in Rust; ``plumbline`` is what a user imports.

Made of the sources by ``python3 crates/python/stubs.py``.
"""

from collections.abc import Callable, Sequence
from os import PathLike
from pathlib import Path
from typing import Any, Optional, Union

import numpy
import numpy.typing

_Path = Union[str, PathLike[str]]
_Array = numpy.typing.NDArray[numpy.float64]
_Progress = Optional[Callable[[str, int, int], object]]

__version__: str

class PlumblineError(ValueError): ...

class Comparison:
    @property
    def before(self) -> Diagnosis: ...
    @property
    def after(self) -> Diagnosis: ...
    @property
    def alike(self) -> str: ...
    @property
    def text(self) -> str: ...

class Design:
    def text(self) -> str: ...
    @property
    def worth(self) -> list[tuple[str, float, Optional[float]]]: ...
    @property
    def log(self) -> Optional[Log]: ...
    def save(self, folder: _Path) -> Optional[str]: ...

class Diagnosis:
    @property
    def robot(self) -> Robot: ...
    @property
    def doubts(self) -> list[str]: ...
    def json(self) -> str: ...
    def text(self) -> str: ...
    def html(self) -> str: ...
    def notebook(self) -> str: ...
    def figure(self) -> str: ...
    def report(
        self,
        folder: _Path,
        *,
        recording: bool = True,
        progress: _Progress = None,
    ) -> None: ...
    def traces(self) -> list[dict[str, Any]]: ...

class Effect:
    @property
    def code(self) -> str: ...
    @property
    def name(self) -> str: ...
    @property
    def facts(self) -> list[tuple[str, str]]: ...
    @property
    def text(self) -> str: ...

class Log:
    def __new__(
        cls,
        time: numpy.typing.ArrayLike,
        q: numpy.typing.ArrayLike,
        tau: numpy.typing.ArrayLike,
        qd: Optional[numpy.typing.ArrayLike] = None,
        qdd: Optional[numpy.typing.ArrayLike] = None,
        *,
        joints: Optional[Sequence[str]] = None,
        q_desired: Optional[numpy.typing.ArrayLike] = None,
        qd_desired: Optional[numpy.typing.ArrayLike] = None,
        qdd_desired: Optional[numpy.typing.ArrayLike] = None,
        tau_commanded: Optional[numpy.typing.ArrayLike] = None,
        q_link: Optional[numpy.typing.ArrayLike] = None,
        name: str = "log",
    ) -> Log: ...
    @staticmethod
    def read_file(
        path: _Path,
        *,
        map: Optional[_Path] = None,
        effort: str = ...,
        topic: Optional[str] = None,
        episode: Optional[int] = None,
        from_s: Optional[float] = None,
        to_s: Optional[float] = None,
        until_damage: bool = False,
    ) -> Log: ...
    @staticmethod
    def of_columns(
        columns: Sequence[tuple[str, numpy.typing.ArrayLike]],
        *,
        map: Optional[_Path] = None,
        name: str = "log",
    ) -> Log: ...
    def on(self, robot: Robot) -> Log: ...
    @property
    def name(self) -> str: ...
    @property
    def joints(self) -> Optional[list[str]]: ...
    @property
    def mended(self) -> list[str]: ...
    @property
    def time(self) -> _Array: ...
    def signal(self, name: str) -> Optional[_Array]: ...

class Model:
    @staticmethod
    def load(path: _Path, robot: Robot) -> Model: ...
    @staticmethod
    def described(robot: Robot, rest_speed: float) -> Model: ...
    def save(self, path: _Path) -> None: ...
    @property
    def kind(self) -> str: ...
    @property
    def joints(self) -> list[str]: ...
    def predict(
        self,
        q: numpy.typing.ArrayLike,
        qd: numpy.typing.ArrayLike,
        qdd: numpy.typing.ArrayLike,
    ) -> _Array: ...
    def variance(
        self,
        q: numpy.typing.ArrayLike,
        qd: numpy.typing.ArrayLike,
        qdd: numpy.typing.ArrayLike,
    ) -> _Array: ...
    def error(self, logs: Sequence[Log], *, cutoff_hz: Optional[float] = None) -> _Array: ...

class Replay:
    def drift(self) -> list[tuple[str, list[tuple[float, Optional[_Array]]]]]: ...
    @property
    def doubts(self) -> list[str]: ...
    def json(self) -> str: ...
    def html(self) -> str: ...
    def text(self) -> str: ...
    def save(self, folder: _Path) -> None: ...

class Robot:
    def __new__(
        cls,
        path: _Path,
        joints: Optional[Sequence[str]] = None,
        *,
        locked: Sequence[tuple[str, float]] = ...,
        packages: Sequence[tuple[str, _Path]] = ...,
        allow_outside: bool = False,
    ) -> Robot: ...
    @staticmethod
    def init(
        path: _Path,
        folder: _Path,
        joints: Optional[Sequence[str]] = None,
        *,
        locked: Sequence[tuple[str, float]] = ...,
        packages: Sequence[tuple[str, _Path]] = ...,
        allow_outside: bool = False,
        force: bool = False,
    ) -> list[str]: ...
    @property
    def name(self) -> str: ...
    @property
    def path(self) -> Path: ...
    @property
    def joints(self) -> list[str]: ...
    @property
    def links(self) -> list[str]: ...
    @property
    def locked(self) -> list[tuple[str, float]]: ...
    @property
    def warnings(self) -> list[str]: ...
    @property
    def limits(self) -> _Array: ...
    def export(self, format: str) -> tuple[str, str]: ...

class Simulation:
    @property
    def logs(self) -> list[Log]: ...
    @property
    def robot(self) -> Robot: ...
    def save(self, folder: _Path, *, csv: bool = False) -> None: ...

class Tracking:
    def json(self) -> str: ...
    def text(self) -> str: ...
    def html(self) -> str: ...
    @property
    def out(self) -> Optional[Path]: ...

def compare(
    robot: Robot,
    before: Sequence[Log],
    after: Sequence[Log],
    *,
    cutoff_hz: Optional[float] = None,
    without: Sequence[str] = ...,
    progress: _Progress = None,
) -> Comparison: ...
def design(
    robot: Robot,
    diagnosis: Optional[Diagnosis] = None,
    *,
    separate: Optional[Sequence[str]] = None,
    duration_s: Optional[float] = None,
    seed: Optional[int] = None,
    progress: _Progress = None,
) -> Design: ...
def diagnose(
    robot: Robot,
    logs: Sequence[Log],
    *,
    cutoff_hz: Optional[float] = None,
    without: Sequence[str] = ...,
    only_findings: bool = False,
    progress: _Progress = None,
) -> Diagnosis: ...
def effects() -> list[Effect]: ...
def explain(effect: str) -> Effect: ...
def inverse_dynamics(
    robot: Robot,
    q: numpy.typing.ArrayLike,
    qd: numpy.typing.ArrayLike,
    qdd: numpy.typing.ArrayLike,
) -> _Array: ...
def learn(
    robot: Robot,
    logs: Sequence[Log],
    model: str = "gp-rbd",
    *,
    points: Optional[int] = None,
    named: Optional[Robot] = None,
    cutoff_hz: Optional[float] = None,
    progress: _Progress = None,
) -> Model: ...
def main(command_line: Sequence[str]) -> int: ...
def replay(
    robot: Robot,
    logs: Sequence[Log],
    *,
    window_ms: Sequence[float],
    progress: _Progress = None,
) -> Replay: ...
def simulate(
    scenario: _Path,
    *,
    seed: Optional[int] = None,
    set: Sequence[str] = ...,
    progress: _Progress = None,
) -> Simulation: ...
def track(
    scenario: _Path,
    out: Optional[_Path] = None,
    *,
    learned: Optional[_Path] = None,
    feedforward: Sequence[str] = ...,
    set: Sequence[str] = ...,
    progress: _Progress = None,
) -> Tracking: ...
