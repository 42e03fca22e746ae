#!/usr/bin/env python3
"""Trials of a population with the logs of another engine: MuJoCo.

    pip install mujoco numpy pyarrow
    plumbline-bench work PANEL --store LOGS                       # the trials, by the simulator
    tests/benches/mujoco_panel.py LOGS MUJOCO --trials 30         # the same ones, by MuJoCo
    plumbline-bench work PANEL_MUJOCO --store MUJOCO --stored     # a second folder of the same plan

Reads the entries of a store in the order of their keys and writes those that MuJoCo can make into a store of the
same layout: same keys, nominal model, motions, truth sheet. Logs and held-out logs are MuJoCo's, `corner.origin`
of the sheet is `another_engine`, `length_s` that of the new logs. What is left out is told with its reason.

    truth/robot.toml --plumbline export--> MJCF --effects of truth/scenario.toml--> model --motions--> logs

MuJoCo moves the arm by its own dynamics, its own law of dry friction (`frictionloss`, a constraint of the solver)
and its implicit integrator. Controller and sensors are written here:

    tau = clip(kp (q_ref - q_m) + kd (qd_ref - qd_m)), held for a period of the controller
    q_m = step round((q + noise) / step);  qd_m: difference of q_m through a first-order low pass
    effort = gain tau + offset as command or current; behind the drive: the torque of the bodies and springs alone
"""

import argparse
import hashlib
import json
import math
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

ENTRY = "entry.json"
# Longest step (s): the error of a semi-implicit step grows with it; a tenth of a millisecond is the shortest of
# the population's simulator.
STEP_S = 1e-4
# Faster than this (rad/s or m/s) an arm has run away: ten times the speed of arms.
RUNAWAY = 200.0
# Density of what hangs on an arm (kg/m3): a payload without a stated inertia is a ball of steel.
STEEL = 7850.0


class LeftOut(Exception):
    """Why a trial cannot be made with MuJoCo."""


class Drives:
    """What stands between the controller and the joints, by joint."""

    def __init__(self, names, described):
        joints = described.get("joint", {})
        lacks = [name for name in names if "kp_nm_per_rad" not in joints.get(name, {})]
        if lacks:
            raise LeftOut(f"joint {lacks[0]} has no gains")
        self.kp = np.array([joints[name]["kp_nm_per_rad"] for name in names])
        self.kd = np.array([joints[name]["kd_nm_s_per_rad"] for name in names])
        self.gain = np.ones(len(names))
        self.offset = np.zeros(len(names))
        # Constant part of dry friction that differs between directions (N m or N).
        self.bias = np.zeros(len(names))
        # What an encoder reads of a true position: q / ratio + zero.
        self.ratio = np.ones(len(names))
        self.zero = np.zeros(len(names))


class Arm:
    """The model of a trial, and one without drives for the torque behind them."""

    def __init__(self, mjcf, scenario, described):
        self.model = mujoco.MjModel.from_xml_string(mjcf)
        # Limits would push; the population's simulator has no joint stops.
        self.model.opt.disableflags |= mujoco.mjtDisableBit.mjDSBL_LIMIT
        self.model.opt.integrator = mujoco.mjtIntegrator.mjINT_IMPLICITFAST
        self.names = [self.model.joint(j).name for j in range(self.model.njnt)]
        self.drives = Drives(self.names, described)
        for effect in scenario.get("effect", []):
            (kind, values), = effect.items()
            put = EFFECTS.get(kind)
            if put is None:
                raise LeftOut(f"the MJCF holds no {kind}")
            put(self, values)
        self.bare = mujoco.MjModel.from_xml_string(mjcf)
        for of in ("body_mass", "body_ipos", "body_iquat", "body_inertia", "jnt_stiffness", "qpos_spring"):
            getattr(self.bare, of)[:] = getattr(self.model, of)
        self.bare.opt.gravity[:] = self.model.opt.gravity
        self.bare.opt.disableflags |= mujoco.mjtDisableBit.mjDSBL_LIMIT
        for of in ("dof_armature", "dof_damping", "dof_frictionloss"):
            getattr(self.bare, of)[:] = 0.0
        for model in (self.model, self.bare):
            mujoco.mj_setConst(model, mujoco.MjData(model))
        self.behind = mujoco.MjData(self.bare)
        limits = self.model.jnt_actfrcrange
        self.limit = np.where(self.model.jnt_actfrclimited[:] > 0, limits[:, 1], np.inf)

    def torque_behind_drives(self, q, qd, qdd):
        """M(q) qdd + C(q, qd) qd + g(q) + springs, without rotors and friction (N m or N)."""
        self.behind.qpos[:], self.behind.qvel[:], self.behind.qacc[:] = q, qd, qdd
        mujoco.mj_inverse(self.bare, self.behind)
        return self.behind.qfrc_inverse.copy()

    def joint(self, values):
        return self.names.index(values["joint"])

    def body_of(self, link):
        """Mass, centre of mass and inertia about it, in the frame of the link."""
        body = self.model.body(link).id
        turn = np.zeros(9)
        mujoco.mju_quat2Mat(turn, self.model.body_iquat[body])
        turn = turn.reshape(3, 3)
        about_com = turn @ np.diag(self.model.body_inertia[body]) @ turn.T
        return self.model.body_mass[body], self.model.body_ipos[body].copy(), about_com

    def add_body(self, link, mass, com, about_com):
        """Adds a body to a link; one that is taken away has a negative mass. Mass, first moment and inertia about
        the link's origin add."""
        parts = [self.body_of(link), (mass, com, about_com)]
        body, total = self.model.body(link).id, sum(m for m, _, _ in parts)
        centre = sum(m * c for m, c, _ in parts) / total
        inertia = sum(i + m * steiner(c - centre) for m, c, i in parts)
        moments, axes = np.linalg.eigh(inertia)
        axes[:, 2] *= np.sign(np.linalg.det(axes))
        quat = np.zeros(4)
        mujoco.mju_mat2Quat(quat, axes.flatten())
        self.model.body_mass[body], self.model.body_ipos[body] = total, centre
        self.model.body_inertia[body], self.model.body_iquat[body] = moments, quat


def steiner(r):
    """r . r E - r r^T"""
    return r @ r * np.eye(3) - np.outer(r, r)


def symmetric(values):
    xx, yy, zz, xy, xz, yz = values
    return np.array([[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]])


def ball(mass):
    """2/5 m r^2 of a ball of steel (kg m2)."""
    radius = (3.0 * mass / (4.0 * math.pi * STEEL)) ** (1.0 / 3.0)
    return 0.4 * mass * radius**2 * np.eye(3)


def coulomb(arm, values):
    arm.model.dof_frictionloss[arm.joint(values)] += values["level_nm"]


def asymmetric(arm, values):
    """-forward for qd > 0, backward for qd < 0: the mean as friction, half the difference as a constant torque."""
    joint, forward, backward = arm.joint(values), values["forward_nm"], values["backward_nm"]
    arm.model.dof_frictionloss[joint] += 0.5 * (forward + backward)
    arm.drives.bias[joint] += 0.5 * (backward - forward)


def viscous(arm, values):
    arm.model.dof_damping[arm.joint(values)] += values["viscous_nm_s_per_rad"]


def rotor(arm, values):
    arm.model.dof_armature[arm.joint(values)] += values["inertia_kg_m2"]


def payload(arm, values):
    stated = values.get("inertia_kg_m2")
    about_com = ball(values["mass_kg"]) if stated is None else symmetric(stated)
    arm.add_body(values["link"], values["mass_kg"], np.array(values["com_m"]), about_com)


def bodies(arm, values):
    """The body that a link truly has, in place of the described one."""
    mass, com, described = arm.body_of(values["link"])
    stated = values.get("inertia_kg_m2")
    about_com = values["mass_kg"] / mass * described if stated is None else symmetric(stated)
    arm.add_body(values["link"], values["mass_kg"], np.array(values["com_m"]), about_com)
    arm.add_body(values["link"], -mass, com, -described)


def tilt(arm, values):
    """g = exp((tilt_1 e_1 + tilt_2 e_2) x) g, e_1 the level part of x (of y where x is within 26 degrees of the
    vertical), e_2 = up x e_1."""
    gravity = arm.model.opt.gravity.copy()
    up = -gravity / np.linalg.norm(gravity)
    first = np.eye(3)[0 if abs(up[0]) <= 0.9 else 1]
    first = first - up * (up @ first)
    first /= np.linalg.norm(first)
    turn = values["tilt_x_rad"] * first + values["tilt_y_rad"] * np.cross(up, first)
    angle = np.linalg.norm(turn)
    if angle > 0.0:
        quat, turned = np.zeros(4), np.zeros(3)
        mujoco.mju_axisAngle2Quat(quat, turn / angle, angle)
        mujoco.mju_rotVecQuat(turned, gravity, quat)
        arm.model.opt.gravity[:] = turned


def torque_constant(arm, values):
    arm.drives.gain[arm.joint(values)] *= values["gain"]


def torque_offset(arm, values):
    arm.drives.offset[arm.joint(values)] += values["offset_nm"]


def transmission(arm, values):
    """Reported positions are q / ratio, and the torque is effort / ratio."""
    arm.drives.gain[arm.joint(values)] *= values["ratio"]
    arm.drives.ratio[arm.joint(values)] *= values["ratio"]


def encoder_zero(arm, values):
    arm.drives.zero[arm.joint(values)] += values["offset_rad"]


EFFECTS = {
    "coulomb_friction": coulomb,
    "asymmetric_friction": asymmetric,
    "viscous_friction": viscous,
    "rotor_inertia": rotor,
    "payload": payload,
    "inertial_parameters": bodies,
    "gravity_direction": tilt,
    "torque_constant": torque_constant,
    "torque_offset": torque_offset,
    "transmission_ratio": transmission,
    "encoder_offset": encoder_zero,
}


class Reference:
    """The motion of a log between its rows: the polynomial of degree 5 with position, velocity and acceleration of
    both ends."""

    def __init__(self, table, names, rate_hz):
        stamps = np.array(table["time"])
        # Jitter is far below half a period, so that a stamp tells its tick.
        self.times = np.round(stamps * rate_hz) / rate_hz
        column = lambda kind: np.stack([np.array(table[f"{name}.desired_{kind}"]) for name in names], axis=1)
        self.q, self.qd, self.qdd = column("position"), column("velocity"), column("acceleration")

    def end_s(self):
        return self.times[-1]

    def at(self, t):
        k = int(np.clip(np.searchsorted(self.times, t, side="right") - 1, 0, len(self.times) - 2))
        h = self.times[k + 1] - self.times[k]
        x = (t - self.times[k]) / h
        a0, a1, a2 = self.q[k], self.qd[k] * h, 0.5 * self.qdd[k] * h * h
        p = self.q[k + 1] - a0 - a1 - a2
        v = self.qd[k + 1] * h - a1 - 2.0 * a2
        a = self.qdd[k + 1] * h * h - 2.0 * a2
        a3, a4, a5 = 10 * p - 4 * v + 0.5 * a, -15 * p + 7 * v - a, 6 * p - 3 * v + 0.5 * a
        q = a0 + x * (a1 + x * (a2 + x * (a3 + x * (a4 + x * a5))))
        qd = (a1 + x * (2 * a2 + x * (3 * a3 + x * (4 * a4 + x * 5 * a5)))) / h
        return q, qd


class Sensors:
    """What controller and log read, in the words of `truth/scenario.toml`."""

    def __init__(self, scenario, names, random):
        stated = scenario["sensors"]
        of = lambda key: np.array([stated.get(key, {}).get(name, 0.0) for name in names])
        if stated.get("link_position_lag_ms", 0.0) > 0.0:
            raise LeftOut("second encoders that lag are not made here")
        self.step, self.noise = of("position_resolution_rad"), of("position_noise_rad")
        self.link_step, self.link_noise = of("link_position_resolution_rad"), of("link_position_noise_rad")
        self.effort_step, self.effort_noise = of("effort_resolution_nm"), of("effort_noise_nm")
        self.velocity, self.random = stated["velocity"], random
        self.last, self.low = None, np.zeros(len(names))

    def read(self, q, qd, period_s):
        measured = rounded(q + self.noise * self.random.standard_normal(len(q)), self.step)
        if self.velocity == "ideal":
            return measured, qd
        cutoff_hz = self.velocity["filtered_difference"]["cutoff_hz"]
        kept = math.exp(-2.0 * math.pi * cutoff_hz * period_s)
        if self.last is not None:
            self.low = kept * self.low + (1.0 - kept) * (measured - self.last) / period_s
        self.last = measured
        return measured, self.low

    def effort(self, effort):
        return rounded(effort + self.effort_noise * self.random.standard_normal(len(effort)), self.effort_step)

    def link(self, q):
        return rounded(q + self.link_noise * self.random.standard_normal(len(q)), self.link_step)


class Perfect:
    """Sensors without error, of a held-out log."""

    def read(self, q, qd, _period_s):
        return q, qd

    def effort(self, effort):
        return effort

    def link(self, q):
        return q


def rounded(values, step):
    safe = np.where(step > 0.0, step, 1.0)
    return np.where(step > 0.0, safe * np.round(values / safe), values)


def follow(arm, reference, sensors, scenario, rates):
    """The rows of a run at the controller's rate: time, position, velocity, effort, command, link position."""
    control_hz, _ = rates
    period_s = 1.0 / control_hz
    substeps = math.ceil(period_s / STEP_S - 1e-9)
    arm.model.opt.timestep = period_s / substeps
    data, drives = mujoco.MjData(arm.model), arm.drives
    q, qd = reference.at(0.0)
    data.qpos[:], data.qvel[:] = q, qd
    at_rest = np.all(np.abs(qd) <= 1e-9)
    lead_in = round(max(run.get("lead_in_s", 1.0) for run in scenario["run"]) * control_hz) if at_rest else 0
    before, rows = None, []
    for tick in range(-lead_in, round(reference.end_s() * control_hz) + 1):
        q_ref, qd_ref = reference.at(max(tick, 0) * period_s)
        truth = data.qpos.copy(), data.qvel.copy()
        measured = sensors.read(truth[0] / drives.ratio + drives.zero, truth[1] / drives.ratio, period_s)
        command = np.clip(drives.kp * (q_ref - measured[0]) + drives.kd * (qd_ref - measured[1]), -arm.limit, arm.limit)
        torque = (command - drives.offset) / drives.gain
        # The velocity of a semi-implicit step belongs to its middle: the first torque is that of both periods.
        data.qfrc_applied[:] = drives.bias + (torque if before is None else 0.5 * (before + torque))
        mujoco.mj_step(arm.model, data)
        accelerated = (data.qvel - truth[1]) / arm.model.opt.timestep
        data.qfrc_applied[:] = drives.bias + torque
        if substeps > 1:
            mujoco.mj_step(arm.model, data, substeps - 1)
        before = torque
        if not np.all(np.abs(data.qvel) < RUNAWAY):
            raise LeftOut("the arm runs away")
        if tick >= 0:
            effort = command
            if scenario["sensors"]["effort"] == "link":
                effort = drives.gain * arm.torque_behind_drives(*truth, accelerated) + drives.offset
            rows.append((tick * period_s, *measured, sensors.effort(effort), command, sensors.link(truth[0])))
    return [np.array(column) for column in zip(*rows)]


def kept_rows(count, every, sensors, rate_hz, random):
    """Rows that a logger keeps, and what its clock adds to their times (s)."""
    ticks = np.arange(0, count, every)
    kept = random.random(len(ticks)) >= sensors.get("dropped_share", 0.0)
    dropouts = sensors.get("dropouts")
    if dropouts:
        start_s = random.exponential(60.0 / dropouts["per_minute"])
        while start_s <= ticks[-1] / (every * rate_hz):
            at_s = ticks / (every * rate_hz)
            kept &= ~((start_s <= at_s) & (at_s < start_s + 1e-3 * dropouts["length_ms"]))
            start_s += random.exponential(60.0 / dropouts["per_minute"])
    return ticks[kept], 1e-3 * sensors.get("time_jitter_ms", 0.0) * random.standard_normal(kept.sum())


def log_of(source, arm, scenario, rates, random, silent):
    """A log with the columns of `source` and the motion that it asks for."""
    table = pq.read_table(source)
    control_hz, log_hz = rates
    reference = Reference(table.to_pydict(), arm.names, log_hz)
    sensors = Perfect() if silent else Sensors(scenario, arm.names, random)
    time, q, qd, effort, command, link = follow(arm, reference, sensors, scenario, rates)
    every = round(control_hz / log_hz)
    stated = {} if silent else scenario["sensors"]
    rows, late = kept_rows(len(time), every, stated, log_hz, random)
    desired = [reference.at(t) for t in time[rows]]
    signals = {
        "position": q[rows], "velocity": qd[rows], "effort": effort[rows], "commanded_effort": command[rows],
        "link_position": link[rows],
        "desired_position": np.array([one[0] for one in desired]),
        "desired_velocity": np.array([one[1] for one in desired]),
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
    scenario = tomllib.loads((source / "truth/scenario.toml").read_text())
    described = tomllib.loads((source / "truth/robot.toml").read_text())
    arm = Arm(mjcf_of(source, program), scenario, described)
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
