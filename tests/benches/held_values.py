#!/usr/bin/env python3
"""Logs of a Panda whose values are held in faster rows, in seventeen ways, and what a program says of them.

    tests/benches/held_values.py PROGRAM

The logs are `field_threads/control_panda` of PLUMBLINE_DATA (../shared/data where it is unset), three runs at 200 Hz. The
true dry friction is .4 .5 .4 .6 .3 .25 .25 N m. A row has the verdict, how many findings of each effect there are, and the
largest error of a dry friction that is named. Needs NumPy and pandas.
"""

import json
import os
import subprocess
import sys
import tempfile
from collections import Counter
from pathlib import Path

import numpy as np
import pandas as pd

ROOT = Path(__file__).resolve().parents[2]
DATA = Path(os.environ.get("PLUMBLINE_DATA", ROOT.parent / "shared" / "data"))
LOGS = DATA / "field_threads" / "control_panda"
COULOMB = [0.4, 0.5, 0.4, 0.6, 0.3, 0.25, 0.25]

rng = np.random.default_rng(7)


def repeat(rate_hz, jitter_s=0.0, lost=0.0, phase_s=0.0):
    """Rows of a rate, each with the last message that came before it."""

    def change(log):
        time = log.time.values
        late = phase_s + np.abs(rng.normal(0.0, jitter_s, len(time)))
        kept = rng.random(len(time)) >= lost
        kept[0] = True
        kept = np.flatnonzero(kept)
        arrival = np.maximum.accumulate(time + late)[kept]
        rows = np.arange(time[0] + 0.02, time[-1], 1.0 / rate_hz)
        held = log.iloc[kept[np.searchsorted(arrival, rows + 1e-9, side="right") - 1]].copy()
        held["time"] = rows - rows[0]
        return held

    return change


def hold(columns, rows, phase=lambda number: 0):
    """Columns that are new in every few rows alone."""

    def change(log):
        for number, name in enumerate(name for name in log.columns if columns(name)):
            at = phase(number) % rows
            last = np.maximum((np.arange(len(log)) - at) // rows * rows + at, 0)
            log[name] = log[name].values[last]
        return log

    return change


def hold_at(rate_hz):
    """Efforts of a rate that is in no ratio to that of the rows."""

    def change(log):
        time = log.time.values
        new = np.arange(time[0], time[-1] + 0.1, 1.0 / rate_hz)
        last = np.searchsorted(new, time + 1e-9, side="right") - 1
        for name in filter(is_effort, log.columns):
            log[name] = np.interp(new, time, log[name].values)[last]
        return log

    return change


def repeat_some(share):
    """Rows that repeat the one before, at random."""

    def change(log):
        values = log.values.copy()
        for row in np.flatnonzero(rng.random(len(log)) < share):
            if row > 0:
                values[row, 1:] = values[row - 1, 1:]
        return pd.DataFrame(values, columns=log.columns)

    return change


def is_effort(name):
    return name.endswith("effort")


WAYS = {
    "200 Hz in 300 Hz": repeat(300.0),
    "200 Hz in 333 Hz": repeat(333.33),
    "200 Hz in 500 Hz": repeat(500.0),
    "200 Hz in 1000 Hz": repeat(1000.0),
    "and jitter of .5 ms": repeat(1000.0, jitter_s=5e-4),
    "and 5 % lost": repeat(1000.0, lost=0.05),
    "and .3 ms late": repeat(1000.0, phase_s=3e-4),
    "efforts of 50 Hz": hold(is_effort, 4),
    "efforts of 20 Hz": hold(is_effort, 10),
    "efforts of 63 Hz": hold_at(63.0),
    "positions of 50 Hz": hold(lambda name: name.endswith("position"), 4),
    "each at another phase": hold(lambda name: name != "time", 4, lambda number: number // 2),
    "one effort of 50 Hz": hold(lambda name: name == "panda_joint4.effort", 4),
    "1 % of rows": repeat_some(0.01),
    "10 % of rows": repeat_some(0.1),
    "30 % of rows": repeat_some(0.3),
    "50 % of rows": repeat_some(0.5),
}


def row(answer):
    friction = [f for f in answer["findings"] if f["effect"] == "coulomb_friction"]
    truth = {f"panda_joint{k}": level for k, level in enumerate(COULOMB, 1)}
    off = [abs(f["parameters"]["level"]["value"] / truth[f["joint"]] - 1.0) for f in friction]
    names = Counter(f["effect"] for f in answer["findings"])
    named = ", ".join(f"{effect} {count}" for effect, count in sorted(names.items()))
    return f"{answer['verdict']:17} {100.0 * max(off, default=float('nan')):5.1f} %  {named}"


def main():
    program = os.path.abspath(sys.argv[1])
    runs = [pd.read_csv(path) for path in sorted(LOGS.glob("run*.csv.gz"))]
    if not runs:
        sys.exit(f"{LOGS} is absent")
    for name, change in WAYS.items():
        with tempfile.TemporaryDirectory() as folder:
            logs = [Path(folder, f"run_{k}.csv") for k in range(1, len(runs) + 1)]
            for log, path in zip(runs, logs):
                change(log.copy()).to_csv(path, index=False)
            out = Path(folder, "out")
            command = [program, "diagnose", "--robot", LOGS / "robot.urdf", "--log", *logs]
            ended = subprocess.run([*command, "--out", out, "--quiet"], capture_output=True, text=True)
            answer = out / "diagnosis.json"
            said = row(json.loads(answer.read_text())) if answer.exists() else ended.stderr.strip()
            print(f"{name:22} {said}", flush=True)


if __name__ == "__main__":
    main()
