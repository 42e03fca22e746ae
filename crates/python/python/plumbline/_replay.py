"""The simulation of a robot beside what was recorded."""

from __future__ import annotations

import json
from collections.abc import Sequence
from os import PathLike
from typing import Any, Optional, Union

import numpy
import numpy.typing

from plumbline import _arguments, _plumbline
from plumbline._log import Log, natives
from plumbline._progress import Progress, shown
from plumbline._robot import Robot, native

_Array = numpy.typing.NDArray[numpy.float64]


class Replay:
    """How far a simulation is from recorded runs; ``plumbline.replay`` makes it."""

    def __init__(self, native: _plumbline.Replay) -> None:
        self._native = native
        self.document: dict[str, Any] = json.loads(native.json())
        """All of ``replay.json``."""

    @property
    def drift_rms(self) -> dict[str, dict[float, Optional[_Array]]]:
        """Drift by the name of the run and the length of time (ms, a whole number of samples): simulated minus measured position at its end, RMS over
        all such windows of the run, of the shape (joints,) (rad or m); ``None`` where a joint ran away in all of them."""
        return {name: dict(windows) for name, windows in self._native.drift()}

    @property
    def warnings(self) -> list[str]:
        """Doubts about the logs, and what was put right in them."""
        return [*self._native.doubts, *self.document["warnings"]]

    def json(self) -> str:
        """``replay.json``."""
        return self._native.json()

    def html(self) -> str:
        """``report.html``, a page that opens offline."""
        return self._native.html()

    def save(self, folder: Union[str, PathLike[str]]) -> None:
        """Write the program's output folder: ``report.html``, ``replay.json``, and simulated motion and torque of every run
        as Parquet. Raises ``PlumblineError`` where it cannot be written."""
        self._native.save(_arguments.path("folder", folder))

    def __str__(self) -> str:
        return self._native.text()

    def __repr__(self) -> str:
        return f"<Replay of {self.document['robot']}: {len(self.document['runs'])} runs>"


def replay(
    robot: Robot,
    logs: Union[Log, Sequence[Log]],
    *,
    window_ms: Sequence[float] = (50.0, 200.0, 1000.0),
    progress: Progress = None,
) -> Replay:
    """Simulate ``robot`` beside recorded runs, and measure how far it drifts.

    The simulation starts at measured states and is moved by the measured torque for each length of ``window_ms``; where the
    robot has gains, it follows the recorded motion as well, and its torque is held against the measured one. Progress,
    Ctrl-C and errors are those of ``diagnose``.
    """
    if isinstance(window_ms, (str, bytes)) or not isinstance(window_ms, Sequence):
        raise TypeError(f"window_ms: found {type(window_ms).__name__}, a list of numbers was expected")
    windows = [_arguments.number("window_ms", ms) for ms in window_ms]
    with shown(progress) as told:
        replayed = _plumbline.replay(native(robot), natives("logs", logs), window_ms=windows, progress=told)
    return Replay(replayed)
