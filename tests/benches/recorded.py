#!/usr/bin/env python3
"""Diagnoses of recorded sets in one table: held-out error, nMSE by joint, and how many findings of each effect.

    tests/benches/recorded.py PROGRAM [SET ...]

The sets lie in PLUMBLINE_DATA (../shared/data where it is unset); those that are absent are left out, which is said.
`rms` is the root of the sum over all joints of the squared held-out RMS errors (N m); the figures beside it are the
held-out nMSE of every joint in order.
"""

import json
import os
import subprocess
import sys
import tempfile
from collections import Counter
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
DATA = Path(os.environ.get("PLUMBLINE_DATA", ROOT.parent / "shared" / "data"))

# Robot and logs of every set, in DATA.
SETS = {
    "control_ur": ("field_threads/control_ur/robot.urdf", "field_threads/control_ur/run*.csv.gz"),
    "control_panda": ("field_threads/control_panda/robot.urdf", "field_threads/control_panda/run*.csv.gz"),
    "rotor_unknown": ("field_bugs/rotor_unknown/robot.urdf", "field_bugs/rotor_unknown/run*.csv.gz"),
    "ur10_bag": ("ur10_bag/ur10_robot.urdf", "ur10_bag/*.db3.gz"),
    "xmate7p": ("xmate7p/XM7p.urdf", "xmate7p/traj*.csv"),
    "ar5": ("ar5/robot.toml", "ar5/part*.csv"),
    "panda": ("panda/robot.toml", "panda/*.parquet"),
    "kuka_lwr4": ("kuka_lwr4/robot.toml", "kuka_lwr4/*.parquet"),
    "kinova_gen3": ("kinova_gen3/robot.urdf", "kinova_gen3/*.parquet"),
    "staubli_tx40": ("staubli_tx40/robot.toml", "staubli_tx40/*.parquet"),
    "ur10e_joint_by_joint": ("ur10e_joint_by_joint/robot.toml", "ur10e_joint_by_joint/*.parquet"),
    "dfki_pendulum": ("dfki_pendulum/robot.urdf", "dfki_pendulum/d*.parquet"),
}


def find_robot(path: Path) -> Path:
    """The robot at `path`, or beside it under the other name that a set may have."""
    return path if path.exists() else path.with_name("robot.urdf")


def diagnose(program: str, robot: Path, logs: list[Path]) -> dict | str:
    """What the program says of the logs; its last line where it refuses them."""
    with tempfile.TemporaryDirectory() as folder:
        command = [program, "diagnose", "--robot", robot, "--log", *logs, "--out", folder, "--quiet"]
        run = subprocess.run(command, capture_output=True, text=True)
        answer = Path(folder) / "diagnosis.json"
        if answer.exists():
            return json.loads(answer.read_text())
    return (run.stderr.strip().splitlines() or ["no answer"])[-1]


def row(name: str, answer: dict) -> str:
    gain = answer["gain"]["inverse"]
    rms = sum(error**2 for error in gain["rms_after_nm"]) ** 0.5
    nmse = " ".join(f"{error:.4f}" for error in gain["nmse_after"])
    names = Counter(finding["effect"] for finding in answer["findings"])
    named = ", ".join(f"{effect} {count}" for effect, count in sorted(names.items()))
    return f"{name:22} rms {rms:8.4g}  nmse {nmse}  {named}"


def main() -> None:
    program, *wanted = sys.argv[1:]
    for name in wanted or SETS:
        robot, pattern = SETS[name]
        logs = sorted(DATA.glob(pattern))
        if not logs:
            print(f"{name:22} absent")
            continue
        answer = diagnose(os.path.abspath(program), find_robot(DATA / robot), logs)
        print(row(name, answer) if isinstance(answer, dict) else f"{name:22} {answer}", flush=True)


if __name__ == "__main__":
    main()
