"""From logs to named causes, and from one set of logs to another."""

from __future__ import annotations

import html
import json
from collections.abc import Sequence
from os import PathLike
from typing import TYPE_CHECKING, Any, Optional, Union

from plumbline import _arguments, _plumbline
from plumbline._findings import Findings, findings_of
from plumbline._log import Log, natives
from plumbline._progress import Progress, shown
from plumbline._robot import Export, Robot, native
from plumbline._torques import RunTorques

if TYPE_CHECKING:
    from matplotlib.figure import Figure


class Diagnosis:
    """What a robot's model gets wrong in logs; ``plumbline.diagnose`` makes it."""

    _native: _plumbline.Diagnosis

    @classmethod
    def _of(cls, native: _plumbline.Diagnosis) -> Diagnosis:
        diagnosis = cls.__new__(cls)
        diagnosis._native = native
        diagnosis._document = json.loads(native.json())
        return diagnosis

    _document: dict[str, Any]

    @property
    def verdict(self) -> str:
        """``consistent``, ``explained``, ``partly_explained``, ``unexplained`` or ``data_inadequate``."""
        return str(self._document["verdict"])

    @property
    def findings(self) -> Findings:
        """Named causes, the one with the largest share first."""
        return findings_of(self._document["findings"])

    @property
    def robot(self) -> Robot:
        """The robot with the findings in it."""
        return Robot._of(self._native.robot)

    @property
    def torques(self) -> tuple[RunTorques, ...]:
        """Measured, nominal and extended torque of every run, as arrays with their times."""
        joints = tuple(self.robot.joints)
        return tuple(RunTorques(joints=joints, **run) for run in self._native.traces())

    @property
    def warnings(self) -> list[str]:
        """Doubts about the input that did not stop the work."""
        return [*self._native.doubts, *self._document["warnings"]]

    @property
    def document(self) -> dict[str, Any]:
        """All of ``diagnosis.json``."""
        return self._document

    def json(self) -> str:
        """``diagnosis.json``; of logs in files the bytes that the program writes."""
        return self._native.json()

    def html(self) -> str:
        """``report.html``, a page that opens offline."""
        return self._native.html()

    def report(
        self,
        folder: Union[str, PathLike[str]],
        *,
        recording: bool = True,
        progress: Progress = None,
    ) -> None:
        """Write the program's output folder: report.html, recording.rrd, figure.svg, diagnosis.json,
        extended.toml with robot.urdf, and extended.urdf.

        Raises ``PlumblineError`` where it cannot be written or the motion cannot be recorded.
        """
        with shown(progress) as told:
            self._native.report(
                _arguments.path("folder", folder),
                recording=_arguments.flag("recording", recording),
                progress=told,
            )

    def export(self, format: str) -> Export:
        """The robot with the findings as ``"urdf"``, ``"mjcf"`` or another format of ``Robot.export``."""
        return self.robot.export(format)

    def plot(self, run: int = 0) -> Figure:
        """Measured, nominal and extended torque of every joint over time in one run, with what is left.

        Raises ``ImportError`` where matplotlib is not installed and ``IndexError`` where there are not as
        many runs.
        """
        from plumbline._plot import plotted

        return plotted(self.torques[run])

    def _repr_html_(self) -> str:
        return self._native.notebook()

    def __str__(self) -> str:
        return self._native.text()

    def __repr__(self) -> str:
        return f"<Diagnosis of {self._document['robot']}: {self.verdict}, {len(self.findings)} findings>"


class Comparison:
    """What changed from one set of logs to another; ``plumbline.compare`` makes it."""

    def __init__(self, native: _plumbline.Comparison) -> None:
        self._text = native.text
        self.before = Diagnosis._of(native.before)
        """What the first logs say of the robot."""
        self.after = Diagnosis._of(native.after)
        """What the others say of the robot as the first logs found it."""
        self.alike = findings_of(json.loads(native.alike))
        """Oscillations that both show with the same amplitude: no change."""

    @property
    def changes(self) -> Findings:
        """The findings that are changes; ``nominal`` is the size in the first logs."""
        return self.after.findings

    def _repr_html_(self) -> str:
        return f"<pre>{html.escape(self._text)}</pre>"

    def __str__(self) -> str:
        return self._text

    def __repr__(self) -> str:
        return f"<Comparison: {len(self.changes)} changes>"


def diagnose(
    robot: Robot,
    logs: Union[Log, Sequence[Log]],
    *,
    cutoff_hz: Optional[float] = None,
    without: Sequence[str] = (),
    only_findings: bool = False,
    progress: Progress = None,
) -> Diagnosis:
    """Name what the model of ``robot`` gets wrong in ``logs``, one run each::

        effort - nominal effort = sum over effects of columns weights + structure + noise

    ``cutoff_hz`` is the cut-off of the low-pass, chosen from the data where it is left out; ``without``
    names effects that the robot is known not to have; ``only_findings`` leaves out what is fitted beside the
    findings, without a name. ``progress`` is ``True`` for a bar of tqdm, ``False``
    for none, ``None`` for one where tqdm is installed, or a function(stage, done, steps).

    Other threads of Python run meanwhile; Ctrl-C ends the work. Raises ``ValueError`` and ``TypeError``
    that name the argument, and ``PlumblineError`` for logs that cannot be used.
    """
    with shown(progress) as told:
        found = _plumbline.diagnose(
            native(robot),
            natives("logs", logs),
            cutoff_hz=_arguments.number_or_none("cutoff_hz", cutoff_hz),
            without=_arguments.texts("without", without),
            only_findings=only_findings,
            progress=told,
        )
    return Diagnosis._of(found)


def compare(
    robot: Robot,
    before: Union[Log, Sequence[Log]],
    after: Union[Log, Sequence[Log]],
    *,
    cutoff_hz: Optional[float] = None,
    without: Sequence[str] = (),
    progress: Progress = None,
) -> Comparison:
    """Name what changed from the logs ``before`` to the logs ``after``; else as ``diagnose``.

    The motions need not be the same. Raises ``PlumblineError`` for a log that is in both as well.
    """
    with shown(progress) as told:
        compared = _plumbline.compare(
            native(robot),
            natives("before", before),
            natives("after", after),
            cutoff_hz=_arguments.number_or_none("cutoff_hz", cutoff_hz),
            without=_arguments.texts("without", without),
            progress=told,
        )
    return Comparison(compared)
