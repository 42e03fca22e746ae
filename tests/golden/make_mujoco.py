#!/usr/bin/env python3
"""Reference motions of the Barrett WAM from MuJoCo: writes mujoco_wam7.json beside this file.

The arm of robots/wam7 (URDF; rotor inertias and gains of robot.toml) follows cosines for 5 s under
a sampled controller whose torque is held between samples,

    q_ref(t) = q0 + a (1 - cos(w t))                                          (rad)
    tau(t_k) = kp (q_ref - q) + kd (qd_ref - qd) + tau_ff,   t_k = k / 500 Hz  (N m)

from rest at q0, where tau_ff is the gravity torque. Joints have no limits, bodies do not touch.
Cases: `plain`; `coulomb` and `viscous` friction at every joint; a `payload` fixed to the last
link. q, qd and all that a case needs are in the file, in SI units, joints in the order of the URDF.

Integrator: Runge-Kutta 4, whose steps divide the sample time, so that the controller reads the
velocity at t_k itself. MuJoCo's dry friction is a constraint that creeps at rest; here it is as
stiff as the step allows and so tends to Coulomb's law with the step, to first order. How close it
came is in the file: against twice the step, and against the same law solved event by event
(`stick_slip`, with MuJoCo's inertia and bias but neither its friction nor its integrator).

    pip install mujoco==4.0.0 numpy
    python3 tests/golden/make_mujoco.py              write the file (about 15 s)
    python3 tests/golden/make_mujoco.py --stdout     print it instead
    python3 tests/golden/make_mujoco.py --check      compute again and compare with the file
"""

import argparse
import datetime
import json
import sys
import tomllib
from pathlib import Path
from typing import NamedTuple

import mujoco
import numpy as np

ROBOT = Path(__file__).resolve().parents[2] / "robots/wam7"
FILE = Path(__file__).resolve().parent / "mujoco_wam7.json"

DURATION_S, SAMPLE_S = 5.0, 0.02
SMOOTH_STEP_S, FRICTION_STEP_S = 0.125e-3, 10e-6
# Processors round differently; a change of the model or the motion shows far above this.
SAME = 1e-8

Q0 = np.array([-0.5, -0.2, 0.4, 0.8, 0.3, -0.4, 0.5])  # rad
AMPLITUDE = np.array([0.5, 0.45, -0.4, 0.5, -0.5, 0.35, -0.6])  # rad
FREQUENCY = np.array([2.4, 2.9, 3.3, 2.6, 3.7, 4.1, 3.1])  # rad/s

COULOMB = np.array([1.6, 0.53, 0.37, 0.64, 0.036, 0.071, 0.0125])  # N m
VISCOUS = np.array([1.65, 2.36, 0.81, 0.60, 0.139, 0.134, 0.056])  # N m s/rad


class Payload(NamedTuple):
    """A rigid body fixed to the last link, written in the frame of that link."""

    mass_kg: float
    com_m: tuple
    inertia_about_com_kg_m2: tuple  # xx xy yy xz yz zz


PAYLOAD = Payload(1.5, (0.02, -0.01, 0.1), (0.0035, 0.0002, 0.003, -0.0003, 0.0001, 0.002))


class Case(NamedTuple):
    """What the arm has beyond the rigid bodies and rotors of its files."""

    coulomb: np.ndarray = 0.0 * COULOMB
    viscous: np.ndarray = 0.0 * VISCOUS
    payload: Payload | None = None

    def step(self):
        return FRICTION_STEP_S if self.coulomb.any() else SMOOTH_STEP_S


CASES = {
    "plain": Case(),
    "coulomb": Case(coulomb=COULOMB),
    "viscous": Case(viscous=VISCOUS),
    "payload": Case(payload=PAYLOAD),
}

with open(ROBOT / "robot.toml", "rb") as file:
    SETTINGS = tomllib.load(file)
ROTORS = np.array([joint["rotor_inertia_kg_m2"] for joint in SETTINGS["joint"].values()])
KP = np.array(SETTINGS["gains"]["compliant"]["kp_nm_per_rad"])
KD = np.array(SETTINGS["gains"]["compliant"]["kd_nm_s_per_rad"])
CONTROL_S = 1.0 / SETTINGS["control_rate_hz"]


def arm_spec(payload=None):
    """The arm with its rotors and what it carries, without shapes and without limits."""
    spec = mujoco.MjSpec.from_file(str(ROBOT / SETTINGS["urdf"]))
    spec.option.gravity = [0.0, 0.0, -9.81]
    for shape in list(spec.geoms):
        spec.delete(shape)
    for joint, rotor in zip(spec.joints, ROTORS, strict=True):
        joint.armature = rotor
        joint.limited = mujoco.mjtLimited.mjLIMITED_FALSE
    if payload is not None:
        xx, xy, yy, xz, yz, zz = payload.inertia_about_com_kg_m2
        body = spec.joints[-1].parent.add_body(name="payload", explicitinertial=True)
        body.mass, body.ipos, body.fullinertia = payload.mass_kg, payload.com_m, [xx, yy, zz, xy, xz, yz]
    return spec


def arm(case, step):
    """The compiled model. Dry friction is as stiff as an explicit step can follow.

    At rest MuJoCo creeps under the torque f at v = f (1 - d) / (d b M), with d at most 0.9999 and
    b dt < 2.8 for Runge-Kutta 4 to be stable; b = 1 / (2 dt) keeps well below.
    """
    model = arm_spec(case.payload).compile()
    model.dof_damping[:] = case.viscous
    model.dof_frictionloss[:] = case.coulomb
    model.dof_solimp[:] = [0.9999, 0.9999, 0.001, 0.5, 2.0]
    model.dof_solref[:] = [-1.0, -0.5 / step]
    model.opt.timestep = step
    model.opt.integrator = mujoco.mjtIntegrator.mjINT_RK4
    model.opt.tolerance = 1e-15
    return model


def gravity_torque(model):
    data = mujoco.MjData(model)
    data.qpos = Q0
    mujoco.mj_forward(model, data)
    return data.qfrc_bias.copy()


def control(t, q, qd, tau_ff):
    q_ref = Q0 + AMPLITUDE * (1.0 - np.cos(FREQUENCY * t))
    qd_ref = AMPLITUDE * FREQUENCY * np.sin(FREQUENCY * t)
    return KP * (q_ref - q) + KD * (qd_ref - qd) + tau_ff


def closed_loop(hold, tau_ff):
    """q and qd every 20 ms; `hold(q, qd, tau)` is the state after one control period."""
    q, qd, rows = Q0.copy(), 0.0 * Q0, []
    every = round(SAMPLE_S / CONTROL_S)
    for k in range(round(DURATION_S / CONTROL_S) + 1):
        if k % every == 0:
            rows.append((q, qd))
        q, qd = hold(q, qd, control(k * CONTROL_S, q, qd, tau_ff))
    return np.array(rows).swapaxes(0, 1)


def simulate(case, step):
    model = arm(case, step)
    data = mujoco.MjData(model)
    data.qpos = Q0

    def hold(q, qd, tau):
        data.qfrc_applied = tau
        mujoco.mj_step(model, data, round(CONTROL_S / step))
        return data.qpos.copy(), data.qvel.copy()

    return closed_loop(hold, gravity_torque(model))


def stick_slip(case):
    """The motion under Coulomb's law itself, solved from event to event.

    Each joint sticks (`sign` 0: no acceleration, |friction| <= level) or slips (`sign` of its
    velocity: friction = -sign * level). Between events the motion is smooth and Runge-Kutta 4 is
    exact to 1e-11 rad; a step in which a velocity turns or a hold breaks is cut there by bisection.
    """
    model = arm(Case(), SMOOTH_STEP_S)
    data, inertia = mujoco.MjData(model), np.zeros((model.nv, model.nv))

    def acceleration(q, qd, tau, sign):
        """Accelerations, and the friction torques that hold the sticking joints."""
        data.qpos, data.qvel = q, qd
        mujoco.mj_fwdPosition(model, data)
        mujoco.mj_fwdVelocity(model, data)
        mujoco.mj_fullM(model, data, inertia)
        drive, slips, qdd = tau - data.qfrc_bias - case.coulomb * sign, sign != 0, 0.0 * q
        qdd[slips] = np.linalg.solve(inertia[np.ix_(slips, slips)], drive[slips])
        return qdd, inertia @ qdd - drive

    def step(q, qd, tau, sign, h):
        a1, _ = acceleration(q, qd, tau, sign)
        a2, _ = acceleration(q + h / 2 * qd, qd + h / 2 * a1, tau, sign)
        a3, _ = acceleration(q + h / 2 * qd + h * h / 4 * a1, qd + h / 2 * a2, tau, sign)
        a4, _ = acceleration(q + h * qd + h * h / 2 * a2, qd + h * a3, tau, sign)
        return q + h * qd + h * h / 6 * (a1 + a2 + a3), qd + h / 6 * (a1 + 2 * a2 + 2 * a3 + a4)

    def excess(q, qd, tau, sign):
        """How far each sticking joint's hold is beyond its level, and the torque of the hold."""
        hold = acceleration(q, qd, tau, sign)[1]
        return np.where(sign == 0, np.abs(hold) / case.coulomb - 1.0, -1.0), hold

    def release(q, qd, tau, sign):
        """Lets go of the sticking joints that cannot hold, the most loaded one first."""
        while True:
            over, hold = excess(q, qd, tau, sign)
            worst = over.argmax()
            if over[worst] <= 1e-12:
                return sign
            sign[worst] = -np.sign(hold[worst])

    sign = 0.0 * Q0

    def breaks(q, qd, tau, h):
        q, qd = step(q, qd, tau, sign, h)
        return (qd * sign < 0).any() or (excess(q, qd, tau, sign)[0] > 1e-12).any()

    def first_break(q, qd, tau, h):
        """The end, to rounding, of the part of the step `h` in which no joint turns or lets go."""
        before = 0.0
        for _ in range(45):
            middle = (before + h) / 2
            before, h = (before, middle) if breaks(q, qd, tau, middle) else (middle, h)
        return h

    def hold(q, qd, tau):
        nonlocal sign
        left, sign = CONTROL_S, release(q, qd, tau, sign)
        while left > 1e-15:
            h = min(left, 2 * SMOOTH_STEP_S)
            event = breaks(q, qd, tau, h)
            h = first_break(q, qd, tau, h) if event else h
            q, qd = step(q, qd, tau, sign, h)
            if event:
                turned = qd * sign < 0
                qd[turned], sign[turned] = 0.0, 0.0
                sign = release(q, qd, tau, sign)
            left -= h
        return q, qd

    return closed_loop(hold, gravity_torque(model))


def run(case):
    """One case as it stands in the file."""
    q, qd = simulate(case, case.step())
    q_twice = simulate(case, 2 * case.step())[0]
    return {
        "coulomb_nm": case.coulomb,
        "viscous_nm_s_per_rad": case.viscous,
        "payload": case.payload._asdict() if case.payload else None,
        "tau_ff_nm": gravity_torque(arm(case, case.step())),
        "step_s": case.step(),
        "largest_change_from_twice_the_step_rad": np.abs(q - q_twice).max(),
        "largest_difference_from_exact_stick_slip_rad":
            np.abs(q - stick_slip(case)[0]).max() if case.coulomb.any() else None,
        "q_rad": q,
        "qd_rad_per_s": qd,
    }


def golden():
    return {
        "program": "MuJoCo",
        "version": mujoco.__version__,
        "command": "python3 tests/golden/make_mujoco.py",
        "date": datetime.date.today().isoformat(),
        "urdf": "robots/wam7/robot.urdf",
        "joints": list(SETTINGS["joint"]),
        "gravity_m_per_s2": [0.0, 0.0, -9.81],
        "rotor_inertia_kg_m2": ROTORS,
        "kp_nm_per_rad": KP,
        "kd_nm_s_per_rad": KD,
        "control_period_s": CONTROL_S,
        "reference": {"q0_rad": Q0, "amplitude_rad": AMPLITUDE, "frequency_rad_per_s": FREQUENCY},
        "sample_period_s": SAMPLE_S,
        "cases": {name: run(case) for name, case in CASES.items()},
    }


def as_text(value, indent=0):
    """JSON with numbers to 12 digits and one line for each list of numbers."""
    if isinstance(value, dict):
        pad = " " * (indent + 1)
        lines = [f"{pad}{json.dumps(key)}: {as_text(item, indent + 1)}" for key, item in value.items()]
        return "{\n" + ",\n".join(lines) + "\n" + " " * indent + "}"
    if isinstance(value, np.ndarray) and value.ndim == 2:
        pad = " " * (indent + 1)
        return "[\n" + ",\n".join(pad + as_text(row) for row in value) + "\n" + " " * indent + "]"
    if isinstance(value, (np.ndarray, list, tuple)):
        return "[" + ", ".join(as_text(item) for item in value) + "]"
    return f"{value:.12g}" if isinstance(value, float) else json.dumps(value)


def differences(found, kept, name=""):
    """Sentences about what is not the same in two golden files; date and version may differ."""
    if isinstance(found, dict) and isinstance(kept, dict) and found.keys() == kept.keys():
        for key in found:
            if key not in ("date", "version"):
                yield from differences(found[key], kept[key], f"{name}.{key}".lstrip("."))
    elif found != kept:
        try:
            difference = np.abs(np.subtract(found, kept)).max()
        except (TypeError, ValueError):
            yield f"{name} is {json.dumps(found)[:80]}, the file has {json.dumps(kept)[:80]}"
            return
        if not difference <= SAME:
            yield f"{name} differs by {difference:.3g}, expected at most {SAME:g}"


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    where = parser.add_mutually_exclusive_group()
    where.add_argument("--stdout", action="store_true", help="print the file instead of writing it")
    where.add_argument("--check", action="store_true", help="compute again and compare with the file")
    options = parser.parse_args()
    text = as_text(golden()) + "\n"
    if options.stdout:
        sys.stdout.write(text)
    elif options.check:
        sys.exit("\n".join(differences(json.loads(text), json.loads(FILE.read_text()))) or None)
    else:
        FILE.write_text(text)


if __name__ == "__main__":
    main()
