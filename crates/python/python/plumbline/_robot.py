"""A robot, as its files describe it or as a diagnosis extends it."""

from __future__ import annotations

import json
import warnings
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from os import PathLike
from pathlib import Path
from typing import Any, Optional, Union

import numpy
import numpy.typing

from plumbline import _arguments, _plumbline


@dataclass(frozen=True)
class Export:
    """A robot in the file of another program."""

    text: str
    """The file."""
    quantities: tuple[Mapping[str, Any], ...]
    """What became of every quantity that is more than a rigid body's: exact, approximated (how),
    dropped (why)."""

    def save(self, path: Union[str, PathLike[str]]) -> None:
        """Write the file."""
        Path(_arguments.path("path", path)).write_text(self.text, encoding="utf-8")


class Robot:
    """A robot from a URDF, an MJCF, or a ``robot.toml`` that names one.

    ``joints`` are the names of those that move; the others are locked at zero, or where ``locked`` (rad or m, by the name of
    the joint) or the ``robot.toml`` says. ``packages`` are folders by the name of the ROS package whose meshes are there;
    with ``allow_outside`` meshes may lie in any folder.

    Arrays have one column a joint, in the order of ``robot.joints``; units are rad or m, per s, per s²,
    N m or N; a positive torque accelerates its joint positively.

    Raises ``PlumblineError`` for files that cannot be used or a joint that they lack.
    """

    _native: _plumbline.Robot

    def __init__(
        self,
        path: Union[str, PathLike[str]],
        joints: Optional[Sequence[str]] = None,
        *,
        locked: Optional[Mapping[str, float]] = None,
        packages: Optional[Mapping[str, Union[str, PathLike[str]]]] = None,
        allow_outside: bool = False,
    ) -> None:
        self._native = _plumbline.Robot(
            _arguments.path("path", path),
            None if joints is None else _arguments.texts("joints", joints),
            locked=_positions(locked),
            packages=_folders(packages),
            allow_outside=_arguments.flag("allow_outside", allow_outside),
        )

    @classmethod
    def _of(cls, native: _plumbline.Robot) -> Robot:
        robot = cls.__new__(cls)
        robot._native = native
        return robot

    @classmethod
    def init(
        cls,
        path: Union[str, PathLike[str]],
        folder: Union[str, PathLike[str]],
        joints: Optional[Sequence[str]] = None,
        *,
        locked: Optional[Mapping[str, float]] = None,
        packages: Optional[Mapping[str, Union[str, PathLike[str]]]] = None,
        allow_outside: bool = False,
        force: bool = False,
    ) -> Robot:
        """Write ``robot.toml``, with what a URDF or MJCF cannot say guessed from it, and ``scenario.toml``, which moves the
        robot, into ``folder``, as ``plumbline robot init`` does, and read the robot.

        A ``robot.toml`` that is there is kept but with ``force``. What the program warns of is raised as ``UserWarning``.
        The other arguments and errors are those of ``Robot``.
        """
        where = _arguments.path("folder", folder)
        told = _plumbline.Robot.init(
            _arguments.path("path", path),
            where,
            None if joints is None else _arguments.texts("joints", joints),
            locked=_positions(locked),
            packages=_folders(packages),
            allow_outside=_arguments.flag("allow_outside", allow_outside),
            force=_arguments.flag("force", force),
        )
        for sentence in told:
            warnings.warn(sentence, stacklevel=2)
        return cls(Path(where, "robot.toml"), packages=packages, allow_outside=allow_outside)

    @property
    def name(self) -> str:
        """Name of the robot."""
        return self._native.name

    @property
    def path(self) -> Path:
        """The file that was named."""
        return Path(self._native.path)

    @property
    def joints(self) -> list[str]:
        """Names of the joints that move, in the order of every array."""
        return self._native.joints

    @property
    def links(self) -> list[str]:
        """Names of the links that they move."""
        return self._native.links

    @property
    def locked(self) -> dict[str, float]:
        """Joints that are locked, and where (rad or m)."""
        return dict(self._native.locked)

    @property
    def warnings(self) -> list[str]:
        """What the owner of the files should know, in sentences."""
        return self._native.warnings

    @property
    def limits(self) -> numpy.typing.NDArray[numpy.float64]:
        """Limits, of the shape (joints, 4): lowest and highest position, speed and torque; NaN where the
        files say none."""
        return self._native.limits

    def export(self, format: str) -> Export:
        """The robot as ``"urdf"``, ``"mjcf"``, ``"sdf"`` or ``"isaac"`` (USD), or its servos alone: actuators of
        MuJoCo (``"actuator_mjcf"``), of Isaac Lab (``"actuator_isaac"``, Python) or parameters of BAM
        (``"actuator_bam"``, JSON; its ``text`` is empty where BAM has the law of none of them).

        Raises ``ValueError`` for another format, and ``PlumblineError`` where the robot has no such form, as servos
        without a position loop.
        """
        text, quantities = self._native.export(_arguments.text("format", format))
        return Export(text, tuple(json.loads(quantities)))

    def __repr__(self) -> str:
        return repr(self._native)


def _folders(packages: Optional[Mapping[str, Union[str, PathLike[str]]]]) -> list[tuple[str, str]]:
    if packages is not None and not isinstance(packages, Mapping):
        raise TypeError(f"packages: found {type(packages).__name__}, folders by name were expected")
    return [
        (_arguments.text("packages", name), _arguments.path("packages", folder))
        for name, folder in (packages or {}).items()
    ]


def _positions(locked: Optional[Mapping[str, float]]) -> list[tuple[str, float]]:
    if locked is not None and not isinstance(locked, Mapping):
        raise TypeError(f"locked: found {type(locked).__name__}, positions by name were expected")
    return [
        (_arguments.text("locked", name), _arguments.number("locked", position))
        for name, position in (locked or {}).items()
    ]


def native(robot: Robot, argument: str = "robot") -> _plumbline.Robot:
    """The robot as the functions of Rust take it; raises ``TypeError`` for anything else."""
    if not isinstance(robot, Robot):
        raise TypeError(f"{argument}: found {type(robot).__name__}, a Robot was expected")
    return robot._native
