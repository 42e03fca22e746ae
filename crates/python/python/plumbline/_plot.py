"""Pictures by matplotlib, which is there when this is imported."""

from __future__ import annotations

import io

from matplotlib.figure import Figure

from plumbline._torques import RunTorques

# Those of reports on white.
_COLOURS = {"measured": "#1f2328", "nominal": "#b84a00", "extended": "#0072b2"}


class Picture(Figure):
    """A figure that a notebook shows, also where nobody has imported ``pyplot``."""

    def _repr_png_(self) -> bytes:
        png = io.BytesIO()
        self.savefig(png, format="png")
        return png.getvalue()


def plotted(run: RunTorques) -> Figure:
    """Torque over time, and below it the error of both models, joint by joint."""
    time, joints = run.time, run.joints
    figure = Picture(figsize=(9, 2.6 * len(joints)), layout="constrained")
    axes = figure.subplots(2 * len(joints), 1, sharex=True, squeeze=False, height_ratios=[2, 1] * len(joints))
    for index, joint in enumerate(joints):
        torque, left = axes[2 * index, 0], axes[2 * index + 1, 0]
        measured = run.measured[:, index]
        for name, colour in _COLOURS.items():
            signal = getattr(run, name)[:, index]
            torque.plot(time, signal, color=colour, linewidth=0.8, label=name)
            if name != "measured":
                left.plot(time, measured - signal, color=colour, linewidth=0.8)
        torque.set_title(joint, loc="left")
        torque.set_ylabel("torque\n(N·m or N)")
        left.set_ylabel("left")
    figure.legend(handles=axes[0, 0].get_lines(), loc="outside upper right", ncols=3, frameon=False)
    axes[-1, 0].set_xlabel("time (s)")
    figure.suptitle(run.name, x=0.01, ha="left")
    return figure
