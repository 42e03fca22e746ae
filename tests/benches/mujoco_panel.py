#!/usr/bin/env python3
"""Trials of a population with the logs of another engine: MuJoCo.

    pip install mujoco numpy pyarrow
    plumbline-bench work PANEL --store LOGS                       # the trials, by the simulator
    tests/benches/mujoco_panel.py LOGS MUJOCO --trials 30         # the same ones, by MuJoCo
    plumbline-bench work PANEL_MUJOCO --store MUJOCO --stored     # a second folder of the same plan

Reads the entries of a store in the order of their keys and writes those that MuJoCo can make into a store of the
same layout: same keys, nominal model, motions, truth sheet. Logs and held-out logs are MuJoCo's, `corner.origin`
of the sheet is `another_engine`, `length_s` that of the new logs. What is left out is told with its reason:
strangers and spoilt logs, servos, columns that the logs mean otherwise than the arm.

    truth/robot.toml --plumbline export--> MJCF --causes of truth/scenario.toml--> model --motions--> logs

MuJoCo moves the arm by its own dynamics, its own law of dry friction (`frictionloss`, a constraint of the solver),
its own springs, stops and tendons (`mujoco_arm.py`) and its implicit integrator. Controller and sensors are those of
`mujoco_run.py`:

    tau = clip(kp (q_ref - q_m) + kd (qd_ref - qd_m)), held for a period of the controller
    q_m = step round((q + noise) / step);  qd_m: difference of q_m through a first-order low pass
    effort = gain tau + offset as command or current; behind the drive: the torque of the bodies and springs alone
"""

import argparse
import hashlib
import json
import shutil
import subprocess
import sys
import tempfile
import tomllib
from pathlib import Path

try:
    import mujoco
    import numpy as np
    import pyarrow as pa
    import pyarrow.parquet as pq
except ImportError as lack:
    sys.exit(f"skipped: {lack}; pip install mujoco numpy pyarrow")

from mujoco_arm import Arm
from mujoco_causes import LeftOut
from mujoco_run import Perfect, Reference, Sensors, follow, kept_rows

ENTRY = "entry.json"
# What makes the logs of a trial others than those of its arm.
CHANGED = {"columns_exchanged", "axis_turned", "held_values", "normalised_units"}


def log_of(source, arm, scenario, rates, random, silent):
    """A log with the columns of `source` and the motion that it asks for."""
    table = pq.read_table(source)
    control_hz, log_hz = rates
    reference = Reference(table.to_pydict(), arm.names, log_hz)
    sensors = Perfect() if silent else Sensors(scenario, arm.names, random)
    time, q, qd, effort, command, link = follow(arm, reference, sensors, scenario, control_hz)
    every = round(control_hz / log_hz)
    stated = {} if silent else scenario["sensors"]
    rows, late = kept_rows(len(time), every, stated, log_hz, random)
    desired = [reference.at(t) for t in time[rows]]
    signals = {
        "position": q[rows], "velocity": qd[rows], "effort": effort[rows], "commanded_effort": command[rows],
        "link_position": link[rows],
        "desired_position": np.array([one[0] for one in desired]),
        "desired_velocity": np.array([one[1] for one in desired]),
        "desired_acceleration": np.array([one[2] for one in desired]),
    }
    # Stamps stay in order: a fifth of a period is the least distance of two.
    least = 0.2 * np.arange(len(rows)) / log_hz
    stamps = np.maximum.accumulate(time[rows] + late - least) + least
    columns = {"time": stamps}
    for name in table.column_names:
        joint, _, signal = name.rpartition(".")
        if signal in signals:
            columns[name] = signals[signal][:, arm.names.index(joint)]
    return pa.table(columns)


def remake(source, target, program):
    """One entry of a store with MuJoCo's logs."""
    sheet = json.loads((source / "sheet.json").read_text())
    if sheet["corner"]["origin"] != "simulated":
        raise LeftOut(f"its logs are {sheet['corner']['origin']}")
    if sheet["strangers"]:
        raise LeftOut(f"it has a stranger or a spoilt log, {sheet['strangers'][0]['name']}")
    changed = CHANGED.intersection(sheet["corner"].get("field", []) + sheet["corner"].get("log_kinds", []))
    if changed:
        raise LeftOut(f"its logs have {sorted(changed)[0]}")
    scenario = tomllib.loads((source / "truth/scenario.toml").read_text())
    if "servo" in scenario.get("control", {}):
        raise LeftOut("its joints are servos")
    described = tomllib.loads((source / "truth/robot.toml").read_text())
    mjcf = mjcf_of(source, program)
    in_run = {run["name"]: run.get("effect", []) for run in scenario["run"]}
    control_hz = scenario.get("control", {}).get("rate_hz") or described.get("control_rate_hz", 500.0)
    rates = control_hz, scenario["sensors"].get("log_rate_hz", control_hz)
    making = target.with_name("making-" + target.name)
    shutil.rmtree(making, ignore_errors=True)
    for folder in ("nominal", "truth"):
        shutil.copytree(source / folder, making / folder)
    length_s = 0.0
    for folder in ("logs", "held_out"):
        (making / folder).mkdir()
        for number, log in enumerate(sorted((source / folder).glob("*.parquet"))):
            random = np.random.default_rng([sheet["seed"], number])
            arm = Arm(mjcf, scenario.get("effect", []) + in_run[log.stem], described)
            table = log_of(log, arm, scenario, rates, random, silent=folder == "held_out")
            pq.write_table(table, making / folder / log.name)
            times = table["time"].to_numpy()
            length_s += times[-1] - times[0] if folder == "logs" else 0.0
    sheet["corner"] |= {"origin": "another_engine", "length_s": length_s}
    (making / "sheet.json").write_text(json.dumps(sheet, indent=2) + "\n")
    files = sorted(path for path in making.rglob("*") if path.is_file())
    hashes = {str(path.relative_to(making)): hashlib.sha256(path.read_bytes()).hexdigest() for path in files}
    entry = {"format": json.loads((source / ENTRY).read_text())["format"], "files": hashes}
    (making / ENTRY).write_text(json.dumps(entry, indent=2))
    shutil.rmtree(target, ignore_errors=True)
    target.parent.mkdir(parents=True, exist_ok=True)
    making.rename(target)


def mjcf_of(source, program):
    with tempfile.TemporaryDirectory() as folder:
        command = [program, "export", source / "truth/robot.toml", "--to", "mjcf", "--out", folder]
        done = subprocess.run(command, capture_output=True, text=True)
        if done.returncode != 0:
            raise LeftOut(f"it is not exported: {done.stderr.strip()}")
        return (Path(folder) / "extended.xml").read_text()


def main():
    arguments = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    arguments.add_argument("store", type=Path, help="store of `plumbline-bench work --store`")
    arguments.add_argument("out", type=Path, help="store for the trials that MuJoCo makes")
    arguments.add_argument("--trials", type=int, default=30, help="how many to make")
    arguments.add_argument("--plumbline", default="plumbline", help="the program that exports the MJCF")
    given = arguments.parse_args()
    (given.out / "locks").mkdir(parents=True, exist_ok=True)
    made, left_out = [], {}
    for entry in sorted(given.store.glob(f"??/*/{ENTRY}")):
        if len(made) == given.trials:
            break
        key = entry.parent.name
        target = given.out / key[:2] / key
        try:
            target.parent.mkdir(exist_ok=True)
            remake(entry.parent, target, given.plumbline)
            made.append(key)
        except LeftOut as reason:
            left_out[key] = str(reason)
    for key, reason in left_out.items():
        print(f"left out  {key[:12]}  {reason}")
    print(f"{len(made)} trials made by MuJoCo {mujoco.__version__}, {len(left_out)} left out")
    return 0 if made else 1


if __name__ == "__main__":
    sys.exit(main())
