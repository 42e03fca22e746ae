"""One recorded run."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from os import PathLike
from typing import Any, Optional, Union

import numpy
import numpy.typing

from plumbline import _arguments, _plumbline
from plumbline._robot import Robot, native

_Array = numpy.typing.NDArray[numpy.float64]


class Log:
    """One run in memory: ``time`` (s) of the shape (samples,), all else (samples, joints).

    ``q`` is the position (rad or m), ``tau`` the torque that the joints report (N m or N), ``qd`` and
    ``qdd`` velocity and acceleration where they were recorded, ``q_desired``, ``qd_desired``,
    ``qdd_desired`` and ``tau_commanded`` what the controller asked for, ``q_link`` the position of the
    link from a second encoder, behind the gear. ``joints`` names the columns; without it they are those of
    the robot, in its order.

    Real numbers of every type are taken, in every order in memory. Raises ``TypeError`` for what holds
    none, ``ValueError`` for a wrong shape and for a number that is not finite; each names the argument.
    What a log of this robot cannot be, a position out of reach or time that goes back, is a
    ``PlumblineError`` once it is used.
    """

    _native: _plumbline.Log

    def __init__(
        self,
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
    ) -> None:
        self._native = _plumbline.Log(
            time,
            q,
            tau,
            qd,
            qdd,
            joints=None if joints is None else _joints(joints),
            q_desired=q_desired,
            qd_desired=qd_desired,
            qdd_desired=qdd_desired,
            tau_commanded=tau_commanded,
            q_link=q_link,
            name=_arguments.text("name", name),
        )

    @classmethod
    def _of(cls, native: _plumbline.Log) -> Log:
        log = cls.__new__(cls)
        log._native = native
        return log

    @classmethod
    def read(
        cls,
        path: Union[str, PathLike[str]],
        *,
        map: Optional[Union[str, PathLike[str]]] = None,
        effort: str = "effort",
        topic: Optional[str] = None,
        episode: Optional[int] = None,
        from_s: Optional[float] = None,
        to_s: Optional[float] = None,
        until_damage: bool = False,
    ) -> Log:
        """A log in a file: CSV, Parquet, NumPy, MATLAB, a bag of ROS 2, an episode of a dataset of LeRobot.

        ``map`` names a column map or one that the program knows, ``effort`` the column of the torque,
        ``topic`` that of a bag, ``episode`` that of a dataset with several; ``from_s`` and ``to_s`` (s after the first row)
        bound the part that is read; with ``until_damage`` a damaged file is read up to there. The file is read when it is used with a robot. Raises ``PlumblineError`` where there
        is no file.
        """
        return cls._of(
            _plumbline.Log.read_file(
                _arguments.path("path", path),
                map=_arguments.path_or_none("map", map),
                effort=_arguments.text("effort", effort),
                topic=None if topic is None else _arguments.text("topic", topic),
                episode=_arguments.count_or_none("episode", episode),
                from_s=_arguments.number_or_none("from_s", from_s),
                to_s=_arguments.number_or_none("to_s", to_s),
                until_damage=_arguments.flag("until_damage", until_damage),
            )
        )

    @classmethod
    def from_frame(
        cls, frame: Any, *, map: Optional[Union[str, PathLike[str]]] = None, name: str = "log"
    ) -> Log:
        """A run from a frame of pandas or polars, or from arrays by name.

        Columns are called as in a file: ``time`` (s), ``<joint>.position``, ``<joint>.effort`` and, where
        they were recorded, ``.velocity``, ``.acceleration``, ``.desired_position``,
        ``.commanded_effort``, ``.link_position``; or as a column map (TOML) says whose file is ``map``. Without a column
        ``time`` the frame's index is the time where it is a ``DatetimeIndex`` or ``TimedeltaIndex`` of pandas. Dates and
        durations become seconds after the first. Columns without numbers are left out where their name is none of these.
        Raises ``TypeError``, ``ValueError`` and ``KeyError`` that name the column, ``PlumblineError`` for the map.
        """
        names = frame.keys() if isinstance(frame, Mapping) else getattr(frame, "columns", None)
        if not isinstance(names, Iterable):
            raise TypeError(
                f"frame: found {type(frame).__name__}, a frame of pandas or polars or a mapping was expected"
            )
        columns = [(_arguments.text("frame", str(column)), _numbers(str(column), frame[column])) for column in names]
        used = [c for c in columns if c[1].dtype.kind in "iuf" or c[0] == "time" or "." in c[0]]
        index = getattr(frame, "index", None)
        if all(column != "time" for column, _ in used) and _is_time(index):
            used.append(("time", _numbers("time", index)))
        return cls._of(
            _plumbline.Log.of_columns(
                used, map=_arguments.path_or_none("map", map), name=_arguments.text("name", name)
            )
        )

    def on(self, robot: Robot) -> Log:
        """The log as it is read and checked for a robot, its joints in the robot's order.

        Raises ``ValueError`` for other joints and ``PlumblineError`` for a log that cannot be used.
        """
        return Log._of(self._native.on(native(robot)))

    @property
    def name(self) -> str:
        """Name of the log."""
        return self._native.name

    @property
    def joints(self) -> Optional[list[str]]:
        """Names of the joints, where the log knows them."""
        return self._native.joints

    @property
    def mended(self) -> list[str]:
        """What was put right while it was read, in sentences."""
        return self._native.mended

    @property
    def time(self) -> _Array:
        """Time of each sample (s), a copy."""
        return self._native.time

    @property
    def q(self) -> Optional[_Array]:
        """Position (rad or m), of the shape (samples, joints), a copy."""
        return self._native.signal("q")

    @property
    def qd(self) -> Optional[_Array]:
        """Velocity (rad/s or m/s), likewise; ``None`` where it was not recorded."""
        return self._native.signal("qd")

    @property
    def qdd(self) -> Optional[_Array]:
        """Acceleration (rad/s² or m/s²), likewise; ``None`` where it was not recorded."""
        return self._native.signal("qdd")

    @property
    def tau(self) -> Optional[_Array]:
        """Torque (N m or N), likewise."""
        return self._native.signal("tau")

    def signal(self, name: str) -> Optional[_Array]:
        """A signal by the name of its argument, such as ``"q_desired"``, likewise."""
        return self._native.signal(_arguments.text("name", name))

    def __repr__(self) -> str:
        return repr(self._native)


def natives(argument: str, logs: Union[Log, Sequence[Log]]) -> list[_plumbline.Log]:
    """Logs as the functions of Rust take them; raises ``TypeError`` for anything else."""
    if isinstance(logs, Log):
        logs = [logs]
    if isinstance(logs, (str, bytes)) or not isinstance(logs, Iterable):
        raise TypeError(f"{argument}: found {type(logs).__name__}, logs in a list were expected")
    every = list(logs)
    for log in every:
        if not isinstance(log, Log):
            raise TypeError(f"{argument}: found {type(log).__name__}, a Log was expected")
    return [log._native for log in every]


def _is_time(values: Any) -> bool:
    # Dates with a zone have a type of pandas' own, of the same kind.
    return getattr(getattr(values, "dtype", None), "kind", "") in ("M", "m")


def _numbers(column: str, values: Any) -> numpy.typing.NDArray[Any]:
    """A column of a frame; dates and durations as seconds after the first."""
    array = numpy.asarray(values)
    if not _is_time(values) and not _is_time(array):
        return array
    kind = array.dtype.kind if _is_time(array) else values.dtype.kind
    moments = numpy.asarray(values, dtype="datetime64[ns]" if kind == "M" else "timedelta64[ns]")
    absent = numpy.flatnonzero(numpy.isnat(moments))
    if len(absent):
        raise ValueError(f"{column}: row {absent[0]}: found {moments[absent[0]]}, a time was expected")
    seconds: _Array = (moments - moments[:1]) / numpy.timedelta64(1, "s")
    return seconds


def _joints(joints: Sequence[str]) -> list[str]:
    names = _arguments.texts("joints", joints)
    if not names:
        raise ValueError("joints: found none, at least one name was expected")
    return names
