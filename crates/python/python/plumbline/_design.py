"""The motion to run next."""

from __future__ import annotations

from dataclasses import dataclass
from os import PathLike
from typing import Optional, Union

from plumbline import _arguments, _plumbline
from plumbline._diagnosis import Diagnosis
from plumbline._log import Log
from plumbline._progress import Progress, shown
from plumbline._robot import Robot, native


@dataclass(frozen=True)
class Prospect:
    """What a motion is worth for one question."""

    question: str
    """What is to be settled, such as ``FR01 viscous friction at elbow or FR02 Coulomb friction at elbow``."""
    before: float
    """What the logs at hand say of it (nats of log evidence), 0 without any."""
    after: Optional[float]
    """What one run of the motion says of it (nats), of a size together with the logs; ``None`` where no motion helps."""


class Design:
    """The motion that settles what a diagnosis left open; ``plumbline.design`` makes it."""

    def __init__(self, native: _plumbline.Design) -> None:
        self._native = native
        self.log: Optional[Log] = None if native.log is None else Log._of(native.log)
        """The motion: ``time``, ``q``, ``qd``, ``qdd`` and the torque ``tau`` to expect; ``None`` where no motion helps."""

    @property
    def prospects(self) -> list[Prospect]:
        """What the motion is worth, question by question."""
        return [Prospect(*worth) for worth in self._native.worth]

    def save(self, folder: Union[str, PathLike[str]]) -> None:
        """Write ``motion.csv``, ``motion.parquet`` and ``motion.toml``, which ``simulate`` runs.

        Raises ``ValueError`` where no motion helps, and ``PlumblineError`` where the folder cannot be written.
        """
        if self._native.save(_arguments.path("folder", folder)) is None:
            raise ValueError("save: no motion was found that helps, there is nothing to write")

    def __str__(self) -> str:
        return self._native.text()

    def __repr__(self) -> str:
        return f"<Design: {len(self.prospects)} questions, {'no ' if self.log is None else 'a '}motion>"


def design(
    robot: Robot,
    diagnosis: Optional[Diagnosis] = None,
    *,
    separate: Optional[tuple[str, str]] = None,
    duration_s: Optional[float] = None,
    seed: Optional[int] = None,
    progress: Progress = None,
) -> Design:
    """Search the motion within the limits of ``robot`` that settles what ``diagnosis`` left open.

    ``separate`` names two causes to tell apart instead, such as ``("FR01@elbow", "FR02@elbow")``, also before there is
    a diagnosis. The motion is ``duration_s`` long, 1 to 120 s, by default 20; the same ``seed`` gives the motion of the
    program.

    Raises ``ValueError`` and ``TypeError`` that name the argument, and ``PlumblineError`` where nothing is open, a
    cause has no such place, or the robot has no limits to move in.
    """
    if diagnosis is not None and not isinstance(diagnosis, Diagnosis):
        raise TypeError(f"diagnosis: found {type(diagnosis).__name__}, a Diagnosis was expected")
    causes = None if separate is None else _arguments.texts("separate", separate)
    if causes is not None and len(causes) != 2:
        raise ValueError(
            f"separate: found {len(causes)}, two causes such as ('FR01@elbow', 'FR02@elbow') were expected"
        )
    with shown(progress) as told:
        found = _plumbline.design(
            native(robot),
            None if diagnosis is None else diagnosis._native,
            separate=causes,
            duration_s=_arguments.number_or_none("duration_s", duration_s),
            seed=_arguments.count_or_none("seed", seed),
            progress=told,
        )
    return Design(found)
