"""Torque: of rigid bodies, as described, and learned."""

from __future__ import annotations

from collections.abc import Sequence
from os import PathLike
from typing import Optional, Union

import numpy
import numpy.typing

from plumbline import _arguments, _plumbline
from plumbline._log import Log, natives
from plumbline._progress import Progress, shown
from plumbline._robot import Robot, native

_Array = numpy.typing.NDArray[numpy.float64]


def inverse_dynamics(
    robot: Robot,
    q: numpy.typing.ArrayLike,
    qd: numpy.typing.ArrayLike,
    qdd: numpy.typing.ArrayLike,
) -> _Array:
    """The torque that moves the rigid bodies of ``robot`` so::

        tau = M(q) qdd + C(q, qd) qd + g(q)

    ``q``, ``qd``, ``qdd`` and the result are of the shape (samples, joints), or (joints,) for one sample;
    rad or m, per s, per s², N m or N. Rotors and friction are left out: ``Model.described`` has them. The
    arguments are copied before other threads run. Raises ``TypeError`` and ``ValueError`` that name the argument.
    """
    return _plumbline.inverse_dynamics(native(robot), q, qd, qdd)


class Model:
    """A model of the torque, for a feedforward: ``learn`` or ``Model.load`` makes it."""

    _native: _plumbline.Model

    @classmethod
    def _of(cls, native: _plumbline.Model) -> Model:
        model = cls.__new__(cls)
        model._native = native
        return model

    @classmethod
    def load(cls, path: Union[str, PathLike[str]], robot: Robot) -> Model:
        """The model of ``robot`` that ``save``, ``plumbline learn`` or ``plumbline track`` has written.

        Raises ``PlumblineError`` for a file that is none, or that is of a robot with other joints.
        """
        return cls._of(_plumbline.Model.load(_arguments.path("path", path), native(robot)))

    @classmethod
    def described(cls, robot: Robot, *, rest_speed: float = 1e-3) -> Model:
        """What the description of ``robot`` expects, with its rotors, friction, springs and gains::

            effort = torque_gain (M qdd + C qd + g + drive(q, qd, qdd, direction)) + torque_offset
            direction_j = clamp(qd_j / rest_speed, -1, 1)

        With ``diagnosis.robot`` this is the feedforward with all that was found. ``rest_speed`` (rad/s or
        m/s) is the speed at which dry friction has its whole size.
        """
        return cls._of(_plumbline.Model.described(native(robot), _arguments.number("rest_speed", rest_speed)))

    def save(self, path: Union[str, PathLike[str]]) -> None:
        """Write the model as Parquet. Raises ``PlumblineError`` where that cannot be."""
        self._native.save(_arguments.path("path", path))

    @property
    def kind(self) -> str:
        """Its kind, as ``plumbline learn`` names it."""
        return self._native.kind

    @property
    def joints(self) -> list[str]:
        """Names of the joints, in the order of every array."""
        return self._native.joints

    def predict(
        self,
        q: numpy.typing.ArrayLike,
        qd: numpy.typing.ArrayLike,
        qdd: numpy.typing.ArrayLike,
    ) -> _Array:
        """The torque in every state; shapes, units and errors as of ``inverse_dynamics``."""
        return self._native.predict(q, qd, qdd)

    def variance(
        self,
        q: numpy.typing.ArrayLike,
        qd: numpy.typing.ArrayLike,
        qdd: numpy.typing.ArrayLike,
    ) -> _Array:
        """The variance of a measured torque about the prediction (N² m² or N²), NaN where the model tells
        none; else as ``predict``."""
        return self._native.variance(q, qd, qdd)

    def error(self, logs: Union[Log, Sequence[Log]], *, cutoff_hz: Optional[float] = None) -> _Array:
        """RMS error of every joint (N m or N) in logs that the model was not learned from, behind a low-pass
        of ``cutoff_hz``, chosen from the logs where it is left out."""
        return self._native.error(
            natives("logs", logs), cutoff_hz=_arguments.number_or_none("cutoff_hz", cutoff_hz)
        )

    def __repr__(self) -> str:
        return repr(self._native)


def learn(
    robot: Robot,
    logs: Union[Log, Sequence[Log]],
    model: str = "gp-rbd",
    *,
    points: Optional[int] = None,
    named: Optional[Robot] = None,
    cutoff_hz: Optional[float] = None,
    progress: Progress = None,
) -> Model:
    """Learn the torque of ``robot`` from ``logs``::

        tau_k = phi_k(q, qd, qdd)' beta + f_k(x) + noise,   f_k ~ GP(0, k_k)

    ``model`` is a kind of ``plumbline learn``: rbd, gp, gp-rbd, gp-rbd-prior, rbd-kernel and others;
    ``points`` is how many samples a Gaussian process learns from, ``named`` the robot of a diagnosis for the
    models named. Progress, Ctrl-C and errors are those of ``diagnose``.
    """
    with shown(progress) as told:
        learned = _plumbline.learn(
            native(robot),
            natives("logs", logs),
            _arguments.text("model", model),
            points=_arguments.count_or_none("points", points),
            named=None if named is None else native(named, "named"),
            cutoff_hz=_arguments.number_or_none("cutoff_hz", cutoff_hz),
            progress=told,
        )
    return Model._of(learned)
