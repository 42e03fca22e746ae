"""A simulated arm, as wrong as a real one."""

from __future__ import annotations

from collections.abc import Sequence
from os import PathLike
from typing import Optional, Union

from plumbline import _arguments, _plumbline
from plumbline._log import Log
from plumbline._progress import Progress, shown
from plumbline._robot import Robot


class Simulation:
    """The runs of a scenario; ``plumbline.simulate`` makes it."""

    def __init__(self, native: _plumbline.Simulation) -> None:
        self._native = native

    @property
    def logs(self) -> list[Log]:
        """The logs, which tell nothing of what was put in."""
        return [Log._of(log) for log in self._native.logs]

    @property
    def robot(self) -> Robot:
        """The robot as its files describe it, without what was put in."""
        return Robot._of(self._native.robot)

    def save(self, folder: Union[str, PathLike[str]], *, csv: bool = False) -> None:
        """Write what ``plumbline simulate`` writes, byte by byte: the logs (Parquet, or CSV), the scenario,
        and apart from them what was put in."""
        self._native.save(_arguments.path("folder", folder), csv=_arguments.flag("csv", csv))


def simulate(
    scenario: Union[str, PathLike[str]],
    *,
    seed: Optional[int] = None,
    set: Sequence[str] = (),
    progress: Progress = None,
) -> Simulation:
    """Simulate every run of a scenario (TOML); the same seed gives the logs of the program.

    ``set`` holds values in the place of the scenario's, such as ``"sensors.log_rate_hz=250"``. Progress,
    Ctrl-C and errors are those of ``diagnose``.
    """
    with shown(progress) as told:
        simulated = _plumbline.simulate(
            _arguments.path("scenario", scenario),
            seed=_arguments.count_or_none("seed", seed),
            set=_arguments.texts("set", set),
            progress=told,
        )
    return Simulation(simulated)
