#!/usr/bin/env python3
"""Entrants of CauseBench: `mujoco.sysid`, the system identification of MuJoCo.

    pip install "mujoco[sysid]" numpy
    tests/benches/entrants/sysid.py SET ANSWERS              # every parameter free
    tests/benches/entrants/sysid.py SET ANSWERS TRUTH        # those alone that an oracle sees to be wrong

Free are damping, frictionloss and armature of every joint and the mass of every body, from the description on, by
least squares over at most 24 windows of 0.2 s that start at measured states; bounds are twice the torque of the joint, and
0.3 to 3 of a mass. What the drive of a joint has that stands in all logs stays as described. A parameter is named where its
interval excludes the described value and what it changes is 2 % of the joint's effort, or 5 % of the mass.
"""

import json
import sys
from pathlib import Path

try:
    import mujoco
    import numpy as np
    from mujoco import sysid
except ImportError as lack:
    sys.exit(f'skipped: {lack}; pip install "mujoco[sysid]" numpy')

from bench_set import Log, answer_all, mjcf_torque

WINDOW_S, MOST_WINDOWS, CUTOFF_HZ = 0.2, 24, 20.0
KINDS = {"damping": ("FR01", "viscous"), "frictionloss": ("FR02", "level"), "armature": ("IN03", "inertia")}
MASS = ("IN02", "mass")
STANDS = 1e-3  # Speed (rad/s or m/s, root mean square) of a joint whose drive no log shows.


def spec_of(trial):
    """The described arm with a motor and sensors of position and velocity at every joint."""
    spec = mujoco.MjSpec.from_string(trial.mjcf.read_text())
    for actuator in list(spec.actuators):
        spec.delete(actuator)
    spec.option.timestep, spec.option.integrator = 1e-3, mujoco.mjtIntegrator.mjINT_IMPLICITFAST
    for name in trial.joints:
        spec.add_actuator(name=name, target=name, trntype=mujoco.mjtTrn.mjTRN_JOINT).set_to_motor()
        for kind, words in ((mujoco.mjtSensor.mjSENS_JOINTPOS, "q"), (mujoco.mjtSensor.mjSENS_JOINTVEL, "qd")):
            spec.add_sensor(name=f"{name}_{words}", type=kind, objtype=mujoco.mjtObj.mjOBJ_JOINT, objname=name)
    return spec


def sequences_of(trial, spec):
    model = spec.compile()
    starts, controls, measured = [], [], []
    logs = [Log(path, trial.joints, CUTOFF_HZ) for path in trial.log_files]
    for log in logs:
        length = max(2, round(WINDOW_S / log.step))
        count = max(1, MOST_WINDOWS // len(logs))
        for start in np.linspace(length, len(log.q) - 2 * length, count).astype(int):
            rows, clock = slice(start, start + length), np.arange(length) * log.step
            sensed = np.empty((length, 2 * log.q.shape[1]))
            # What stands has no size to compare with: a millionth keeps the residual finite.
            shake = 1e-6 * np.sin(np.arange(length))[:, None]
            sensed[:, 0::2], sensed[:, 1::2] = log.q[rows] + shake, log.qd[rows] + shake
            starts.append(sysid.create_initial_state(model, log.q[start], log.qd[start]))
            controls.append(sysid.TimeSeries(clock, log.raw[rows]))
            measured.append(sysid.TimeSeries.from_names(clock, sensed, model))
    names = [f"window_{k}" for k in range(len(starts))]
    return logs, sysid.ModelSequences("arm", spec, names, starts, controls, measured)


def of_joint(name, kind):
    def change(spec, parameter):
        value = float(np.ravel(parameter.value)[0])
        # Damping is linear, quadratic and cubic in the speed.
        setattr(spec.joint(name), kind, [value, 0, 0] if kind == "damping" else value)

    return change


def of_body(name):
    def change(spec, parameter):
        spec.body(name).mass = float(np.ravel(parameter.value)[0])

    return change


def free(trial, spec, logs, truth):
    """Every parameter: its effect and place, value in the description, bounds, least change, and how a model gets it."""
    model = spec.compile()
    rms = {key: np.sqrt(np.mean(np.concatenate([getattr(log, key) for log in logs]) ** 2, axis=0)) for key in ("qd", "qdd", "tau")}
    moving = [(j, joint) for j, joint in enumerate(trial.joints) if rms["qd"][j] > STANDS]
    for j, joint in moving:
        dof = model.joint(joint).dofadr[0]
        for kind, (effect, parameter) in KINDS.items():
            torque = {"damping": rms["qd"][j], "frictionloss": 1.0, "armature": rms["qdd"][j]}[kind]
            described, most = float(getattr(model, f"dof_{kind}")[dof]), float(rms["tau"][j] / max(torque, 1e-9))
            at = {"effect": effect, "joint": joint}
            yield at, parameter, described, (0.0, described + 2 * most), 0.02 * most, of_joint(joint, kind)
    for link in trial.links:
        described = float(model.body(link).mass[0])
        if described > 0:
            at = {"effect": MASS[0], "link": link}
            yield at, MASS[1], described, (0.3 * described, 3 * described), 0.05 * described, of_body(link)


def seen(trial, truth):
    """Codes and places that an oracle sees to be wrong."""
    causes = json.loads(Path(truth).read_text())["trials"][trial.name]["sheet"]["causes"]
    names = {"viscous_friction": "FR01", "coulomb_friction": "FR02", "rotor_inertia": "IN03", "inertial_parameters": "IN02"}
    visible = [c for c in causes if c["strength"]["sigmas"] >= 5 and c["strength"]["share"] >= 0.02]
    return [(names.get(c["effect"]), c.get("joint") or c.get("link")) for c in visible]


def identify(trial, wanted=None):
    """The arm with what was found, the logs, and the names; `wanted` are the effects and places that are free, else all."""
    spec = spec_of(trial)
    logs, sequences = sequences_of(trial, spec)
    is_free = lambda at: wanted is None or (at["effect"], at.get("joint") or at.get("link")) in wanted
    listed = [one for one in free(trial, spec, logs, wanted) if is_free(one[0])]
    parameters, names = sysid.ParameterDict(), []
    for at, parameter, described, (low, high), _, change in listed:
        one = sysid.Parameter(
            f"{parameter} {at.get('joint') or at.get('link')}", nominal=described, min_value=low, max_value=high, modifier=change
        )
        one.value[:] = np.clip(described, low + 0.02 * (high - low), high)
        parameters.add(one)
    if listed:
        residual = sysid.build_residual_fn(models_sequences=[sequences])
        found, result = sysid.optimize(parameters, residual, optimizer="mujoco", verbose=False)
        left, _, _ = residual(result.x, found)
        _, half = sysid.calculate_intervals(left, result.jac)
        for (at, parameter, described, _, least, change), (_, one), width in zip(listed, found.items(), half):
            value, width = float(np.ravel(one.value)[0]), float(width)
            change(spec, one)
            if np.isfinite(width) and abs(value - described) > max(least, width):
                size = {"parameter": parameter, "value": value, "interval": [value - width, value + width], "described": described}
                names.append(at | {"sizes": [size]})
    return spec, logs, names


def answer(trial):
    spec, _, names = identify(trial, seen(trial, sys.argv[3]) if len(sys.argv) > 3 else None)
    held_out = trial.held_out()
    tau = mjcf_torque(spec.compile(), trial.joints, held_out)
    return {"names": names, "prediction": trial.predict(held_out, tau), "model": trial.hand_in(spec.to_xml())}


if __name__ == "__main__":
    answer_all(answer)
