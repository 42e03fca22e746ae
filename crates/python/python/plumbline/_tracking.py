"""A motion tracked by a simulated arm, with models fed forward."""

from __future__ import annotations

import json
from collections.abc import Sequence
from os import PathLike
from pathlib import Path
from typing import Any, Optional, Union

from plumbline import _arguments, _plumbline
from plumbline._progress import Progress, shown


class Tracking:
    """How well an arm follows a motion with each feedforward; ``plumbline.track`` makes it."""

    def __init__(self, native: _plumbline.Tracking) -> None:
        self._native = native
        self.document: dict[str, Any] = json.loads(native.json())
        """All of ``tracking.json``."""

    @property
    def tip_rmse_m(self) -> dict[str, Optional[float]]:
        """RMS of the error of the last link's origin (m), by the name of what is fed forward."""
        return {model["name"]: model["tip_rmse_m"] for model in self.document["models"]}

    @property
    def out(self) -> Optional[Path]:
        """The folder that was written, if one was asked for."""
        return self._native.out

    @property
    def warnings(self) -> list[str]:
        """Doubts, and what of logs and recordings could not be written."""
        return list(self.document["warnings"])

    def json(self) -> str:
        """``tracking.json``, the bytes that the program writes."""
        return self._native.json()

    def html(self) -> str:
        """``report.html``, a page that opens offline."""
        return self._native.html()

    def __str__(self) -> str:
        return self._native.text()

    def __repr__(self) -> str:
        return f"<Tracking: {', '.join(self.tip_rmse_m)}>"


def track(
    scenario: Union[str, PathLike[str]],
    out: Optional[Union[str, PathLike[str]]] = None,
    *,
    learned: Optional[Union[str, PathLike[str]]] = None,
    feedforward: Sequence[str] = (),
    set: Sequence[str] = (),
    progress: Progress = None,
) -> Tracking:
    """Track the motion of a tracking scenario (TOML) with every feedforward, and compare them.

    With ``out`` the program's output folder is written: report, figures, models, and logs and recordings while the runs
    go on. ``learned`` is a folder of models that were learned before. ``feedforward`` holds names in the place of the
    scenario's (``none``, ``gravity``, or a model of ``learn``), ``set`` values such as ``"control.gains=stiff"``.

    Progress and Ctrl-C are those of ``diagnose``. Raises ``ValueError`` that names the argument, and ``PlumblineError``
    for a scenario, models or an arm that cannot be used.
    """
    with shown(progress) as told:
        tracked = _plumbline.track(
            _arguments.path("scenario", scenario),
            _arguments.path_or_none("out", out),
            learned=_arguments.path_or_none("learned", learned),
            feedforward=_arguments.texts("feedforward", feedforward),
            set=_arguments.texts("set", set),
            progress=told,
        )
    return Tracking(tracked)
