#!/usr/bin/env python3
"""A dataset as LeRobot 2.1 lays it out, of a servo arm that tells goals and positions and no torque, from logs that
`plumbline simulate --csv` wrote of it: an episode a log, every STEP-th row.

    python3 dataset.py ROBOT.toml STEP FOLDER LOG.csv ...

A servo makes its torque as `kp (goal - q) - kd qd`; the simulated arm was moved by `kp (q_ref - q) + kd (qd_ref - qd)`.
So its goals are `q_ref + kd / kp qd_ref` (rad), with the gains of ROBOT.toml.

    pip install pyarrow
"""

import csv
import json
import pathlib
import sys
import tomllib

import pyarrow
import pyarrow.parquet

robot, step, folder, *logs = sys.argv[1:]
folder = pathlib.Path(folder)
joints = tomllib.loads(pathlib.Path(robot).read_text())["joint"]


def episode(log, number):
    with open(log, newline="") as file:
        rows = list(csv.DictReader(file))[:: int(step)]
    names = [column.removesuffix(".position") for column in rows[0] if column.endswith(".position")]

    def goal(row, name):
        damped = joints[name]["kd_nm_s_per_rad"] / joints[name]["kp_nm_per_rad"]
        return float(row[f"{name}.desired_position"]) + damped * float(row[f"{name}.desired_velocity"])

    columns = {
        "observation.state": [[float(row[f"{name}.position"]) for name in names] for row in rows],
        "action": [[goal(row, name) for name in names] for row in rows],
        "timestamp": [float(row["time"]) for row in rows],
        "episode_index": [number] * len(rows),
    }
    return names, pyarrow.table(columns)


data = folder / "data/chunk-000"
data.mkdir(parents=True, exist_ok=True)
for number, log in enumerate(logs):
    names, table = episode(log, number)
    pyarrow.parquet.write_table(table, data / f"episode_{number:06}.parquet")
vector = {"dtype": "float64", "shape": [len(names)], "names": [f"{name}.pos" for name in names]}
number = {"dtype": "float64", "shape": [1], "names": None}
info = {
    "codebase_version": "v2.1",
    "data_path": "data/chunk-{episode_chunk:03d}/episode_{episode_index:06d}.parquet",
    "features": {
        "observation.state": vector, "action": vector, "timestamp": number, "episode_index": number,
    },
}
(folder / "meta").mkdir(exist_ok=True)
(folder / "meta/info.json").write_text(json.dumps(info, indent=1))
