"""The signals behind a diagnosis."""

from __future__ import annotations

from dataclasses import dataclass

import numpy
import numpy.typing

_Array = numpy.typing.NDArray[numpy.float64]


@dataclass(frozen=True, eq=False)
class RunTorques:
    """Measured and expected torque of one run, low-passed alike. All but ``time`` are of the shape (samples, joints), in the
    order of ``joints``; they are rad or m, per s, N m or N."""

    name: str
    """Name of the run."""
    joints: tuple[str, ...]
    """Names of the columns."""
    time: _Array
    """Time of each sample (s), of the shape (samples,)."""
    position: _Array
    velocity: _Array
    measured: _Array
    """Torque that the log has."""
    nominal: _Array
    """Torque of the robot as it was described."""
    extended: _Array
    """Torque of the robot with the findings, fitted without this run."""

    def __repr__(self) -> str:
        return f"<RunTorques of {self.name}: {len(self.time)} samples, {len(self.joints)} joints>"
