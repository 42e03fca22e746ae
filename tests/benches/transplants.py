#!/usr/bin/env python3
"""Changes put into recorded logs, and whether `compare` names them and nothing else.

    tests/benches/transplants.py PROGRAM [--null] [SET ...]

Needs NumPy, pandas with pyarrow, and Pinocchio (PyPI: numpy, pandas, pyarrow, pin). The sets lie in PLUMBLINE_DATA
(../shared/data where it is unset). With --null nothing is put in. Runs are cut into parts, of which every other is "before". To the efforts of the
others the torque of one change is added: dry friction or an offset of a joint, or a payload on the last link (inverse
dynamics of Pinocchio with and without it). In null pairs nothing is added.

A change is 3 or 10 times what the logs can show at all, 1.96 standard deviations by Cramer and Rao: with X the columns of
rigid bodies, friction, rotor and offset at the joint, c those of the change in the parts after, and noise of variance s2
whose samples count as n / time,

    sd = sqrt(s2 time / |c - X X^+ c|^2)
"""

import json
import os
import subprocess
import sys
import tempfile
from pathlib import Path

import numpy as np
import pandas as pd
import pinocchio as pin

ROOT = Path(__file__).resolve().parents[2]
DATA = Path(os.environ.get("PLUMBLINE_DATA", ROOT.parent / "shared" / "data"))

# Robot for the program, URDF, logs, and parts a run.
SETS = {
    "kuka_lwr4": ("robot.urdf", "robot.urdf", "*.parquet", 2),
    "kinova_gen3": ("robot.urdf", "robot.urdf", "*.parquet", 2),
    "ur10e_joint_by_joint": ("robot.urdf", "robot.urdf", "*.parquet", 2),
    "xmate7p": ("XM7p.urdf", "XM7p.urdf", "traj*.csv", 4),
    "panda": ("robot.toml", "robot.urdf", "*.parquet", 8),
    "ar5": ("robot.toml", "robot.urdf", "part*.csv", 4),
}
GRAVITY = {"ar5": [9.81, 0.0, 0.0]}
CODES = {"friction": {"FR01", "FR02", "FR03", "FR04", "FR05"}, "offset": {"DR03", "FR03"}, "payload": {"IN01", "IN02"}}


def smooth(x: np.ndarray, width: int) -> np.ndarray:
    kernel = np.hanning(width + 2)[1:-1]
    return np.apply_along_axis(lambda c: np.convolve(np.pad(c, width // 2, "edge"), kernel / kernel.sum(), "valid"), 0, x)[: len(x)]


class Part:
    """A stretch of a run with its motion and efforts."""

    def __init__(self, frame: pd.DataFrame, joints: list[str]):
        self.frame = frame.reset_index(drop=True)
        t = self.frame["time"].to_numpy()
        width = 2 * int(0.06 / np.median(np.diff(t))) + 3
        self.q = smooth(self.frame[[f"{j}.position" for j in joints]].to_numpy(), width)
        self.qd = np.gradient(self.q, t, axis=0)
        self.qdd = np.gradient(self.qd, t, axis=0)
        self.tau = smooth(self.frame[[f"{j}.effort" for j in joints]].to_numpy(), width)


class Set:
    def __init__(self, name: str):
        robot, urdf, pattern, parts = SETS[name]
        self.robot = DATA / name / robot
        full = pin.buildModelFromUrdf(str(DATA / name / urdf))
        frames = [pd.read_parquet(p) if p.suffix == ".parquet" else pd.read_csv(p) for p in sorted((DATA / name).glob(pattern))]
        named = [j for j in full.names[1:] if f"{j}.position" in frames[0] and f"{j}.effort" in frames[0]]
        others = [full.getJointId(j) for j in full.names[1:] if j not in named]
        self.model = pin.buildReducedModel(full, others, pin.neutral(full)) if others else full
        self.model.gravity.linear = np.array(GRAVITY.get(name, [0.0, 0.0, -9.81]))
        self.joints = list(self.model.names[1:])
        cut = [np.array_split(np.arange(len(f)), parts) for f in frames]
        self.parts = [[Part(f.iloc[rows], self.joints) for rows in all] for f, all in zip(frames, cut)]

    def inverse(self, model, part: Part) -> np.ndarray:
        data = model.createData()
        return np.array([pin.rnea(model, data, *state) for state in zip(part.q, part.qd, part.qdd)])

    def torque(self, kind: str, joint: int, part: Part) -> np.ndarray:
        """The torque of a change of size one."""
        out = np.zeros_like(part.tau)
        if kind == "friction":
            out[:, joint] = np.sign(part.qd[:, joint])
        elif kind == "offset":
            out[:, joint] = 1.0
        else:
            loaded = self.model.copy()
            body = pin.Inertia(1.0, np.array([0.0, 0.0, 0.05]), 1e-3 * np.eye(3))
            loaded.inertias[self.model.njoints - 1] = loaded.inertias[self.model.njoints - 1] + body
            out = self.inverse(loaded, part) - self.inverse(self.model, part)
        return out

    def least(self, kind: str, joint: int, sides: list[list[Part]]) -> float:
        """1.96 standard deviations of the size of a change by Cramer and Rao."""
        data = self.model.createData()
        information = 0.0
        for j in range(len(self.joints)) if kind == "payload" else [joint]:
            x, c, y = [], [], []
            for after, side in enumerate(sides):
                for part in side:
                    for k in range(0, len(part.q), max(1, len(part.q) // 1500)):
                        bodies = pin.computeJointTorqueRegressor(self.model, data, part.q[k], part.qd[k], part.qdd[k])[j]
                        x.append([*bodies, np.sign(part.qd[k, j]), part.qd[k, j], part.qdd[k, j], 1.0])
                        y.append(part.tau[k, j])
                    change = self.torque(kind, joint, part)[:: max(1, len(part.q) // 1500), j]
                    c.extend(after * change[: len(x) - len(c)])
            x, c, y = np.array(x), np.array(c), np.array(y)
            left = y - x @ np.linalg.lstsq(x, y, rcond=1e-8)[0]
            alone = c - x @ np.linalg.lstsq(x, c, rcond=1e-8)[0]
            power, time, lag = left @ left, 1.0, 1
            while lag < 5 * time and lag < len(left) // 4:
                time += 2 * (left[lag:] @ left[:-lag]) / power
                lag += 1
            information += (alone @ alone) / (power / len(left) * max(time, 1.0))
        return 1.96 / np.sqrt(information) if information > 0 else np.inf


def compare(program: str, of: Set, sides: list[list[Part]], change=None) -> list[dict] | str:
    with tempfile.TemporaryDirectory() as folder:
        names = []
        for side, parts in zip(("before", "after"), sides):
            for k, part in enumerate(parts):
                frame = part.frame.copy()
                if change is not None and side == "after":
                    kind, joint, size = change
                    added = size * of.torque(kind, joint, part)
                    for j, name in enumerate(of.joints):
                        frame[f"{name}.effort"] += added[:, j]
                names.append(f"{folder}/{side}_{k}.parquet")
                frame.to_parquet(names[-1])
        before = [n for n in names if "/before_" in n]
        after = [n for n in names if "/after_" in n]
        command = [program, "compare", "--robot", of.robot, "--before", *before, "--after", *after]
        command += ["--out", f"{folder}/out", "--json", "--quiet", "--joints", ",".join(of.joints)]
        run = subprocess.run(command, capture_output=True, text=True)
        if run.stdout.startswith("{"):
            return json.loads(run.stdout)["changes"]
        return run.stderr.strip().splitlines()[-1] if run.stderr.strip() else "no answer"


def is_named(kind: str, place: str | None, found: dict, of: Set) -> bool:
    if found["code"] not in CODES[kind]:
        return False
    return kind == "payload" or found.get("joint") == place


def label(found: dict) -> str:
    return f"{found['code']}@{found.get('joint') or found.get('link') or ''}"


def main() -> None:
    program, *wanted = sys.argv[1:]
    only_null = "--null" in wanted
    wanted = [name for name in wanted if name in SETS]
    rng = np.random.default_rng(1)
    total = {"named": 0, "changed": 0, "beside": 0, "quiet": 0, "null": 0}
    for name in wanted or SETS:
        of = Set(name)
        flat = [part for run in of.parts for part in run]
        pairs = [[flat[0::2], flat[1::2]], [flat[1::2], flat[0::2]]]
        if len(flat) >= 4:
            half = len(flat) // 2
            pairs += [[flat[:half], flat[half:]], [flat[half:], flat[:half]]]
        for k, sides in enumerate(pairs):
            found = compare(program, of, sides)
            total["null"] += 1
            total["quiet"] += found == []
            print(name, "null", k, found if isinstance(found, str) else [label(f) for f in found], flush=True)
        for kind in () if only_null else ("friction", "offset", "payload"):
            for factor in (3.0, 10.0):
                for k, sides in enumerate(pairs[:2]):
                    joint = int(rng.integers(len(of.joints)))
                    least = of.least(kind, joint, sides)
                    found = compare(program, of, sides, (kind, joint, factor * least))
                    total["changed"] += 1
                    place = None if kind == "payload" else of.joints[joint]
                    if isinstance(found, str):
                        print(name, kind, place, found, flush=True)
                        continue
                    right = [f for f in found if is_named(kind, place, f, of)]
                    total["named"] += bool(right)
                    total["beside"] += len(found) > len(right)
                    print(name, kind, place, f"{factor:.0f} x {least:.3g}", "named" if right else "MISSED", [label(f) for f in found], flush=True)
    print(f"changes named {total['named']} of {total['changed']}, with another beside {total['beside']}; nothing in {total['quiet']} of {total['null']} null pairs")


if __name__ == "__main__":
    main()
