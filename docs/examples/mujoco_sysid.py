#!/usr/bin/env python3
"""The logs of a simulated arm given to the system identification of MuJoCo: friction of every joint by least squares
over windows of simulation, positions and velocities as what is matched.

    python3 mujoco_sysid.py ROBOT.toml LOG ...

Prints a row a parameter: its value, the half-width of its 95 % interval as that library works it out, and at the end
the processor time. What Plumbline is not asked has to be chosen here: which parameters, their bounds and start values,
the windows, and what velocity is.

    pip install plumbline-robotics "mujoco[sysid]"

``plumbline-robotics`` is not published yet: README.md says how its wheel is built.
"""

import sys
import time

import mujoco
import numpy as np
import plumbline
from mujoco import sysid

WINDOW_S = 0.2  # Length of a simulation that starts at a measured state.
EVERY_S = 0.8  # From the start of a window to the next.
CUTOFF_HZ = 20  # Of the velocity that a window starts with.
BOUNDS = {"damping": (0.0, 50.0), "frictionloss": (0.0, 30.0)}


def derivative(x, step):
    """Central difference behind a Gaussian low-pass, forward and back in frequency."""
    turned = np.concatenate([x, x[::-1]])  # Without a jump at the ends.
    frequency = np.fft.rfftfreq(len(turned), step)
    kept = np.exp(-0.5 * (frequency / CUTOFF_HZ) ** 2)
    smooth = np.fft.irfft(np.fft.rfft(turned, axis=0) * kept[:, None], len(turned), axis=0)
    return np.gradient(smooth[: len(x)], step, axis=0)


def model_of(robot):
    """The robot as described, with a motor and sensors of position and velocity at every joint."""
    spec = mujoco.MjSpec.from_string(robot.export("mjcf").text)
    for actuator in list(spec.actuators):
        spec.delete(actuator)
    for name in robot.joints:
        motor = spec.add_actuator(name=name, target=name, trntype=mujoco.mjtTrn.mjTRN_JOINT)
        motor.set_to_motor()
        for kind, words in ((mujoco.mjtSensor.mjSENS_JOINTPOS, "q"), (mujoco.mjtSensor.mjSENS_JOINTVEL, "qd")):
            spec.add_sensor(
                name=f"{name}_{words}", type=kind, objtype=mujoco.mjtObj.mjOBJ_JOINT, objname=name
            )
    return spec


def windows(spec, logs):
    model = spec.compile()
    starts, controls, measured = [], [], []
    for log in logs:
        step = log.time[1] - log.time[0]
        q, qd = log.q, derivative(log.q, step)
        length, every = round(WINDOW_S / step), round(EVERY_S / step)
        for start in range(every, len(q) - length, every):
            rows = slice(start, start + length)
            clock = np.arange(length) * step
            sensed = np.empty((length, 2 * q.shape[1]))
            sensed[:, 0::2], sensed[:, 1::2] = q[rows], qd[rows]
            starts.append(sysid.create_initial_state(model, q[start], qd[start]))
            controls.append(sysid.TimeSeries(clock, log.tau[rows]))
            measured.append(sysid.TimeSeries.from_names(clock, sensed, model))
    names = [f"window_{k}" for k in range(len(starts))]
    return sysid.ModelSequences("arm", spec, names, starts, controls, measured)


def change(name, kind):
    def of(spec, parameter):
        value = parameter.value[0]
        # Damping is linear, quadratic and cubic in the speed.
        setattr(spec.joint(name), kind, [value, 0, 0] if kind == "damping" else value)

    return of


def parameters_of(robot):
    parameters = sysid.ParameterDict()
    for name in robot.joints:
        for kind, (low, high) in BOUNDS.items():
            one = sysid.Parameter(
                f"{name} {kind}", nominal=0.0, min_value=low, max_value=high, modifier=change(name, kind)
            )
            one.value[:] = 0.05 * high
            parameters.add(one)
    return parameters


robot = plumbline.Robot(sys.argv[1])
logs = [plumbline.Log.read(path).on(robot) for path in sys.argv[2:]]
begin = time.process_time()
sequences = windows(model_of(robot), logs)
residual = sysid.build_residual_fn(models_sequences=[sequences])
found, result = sysid.optimize(parameters_of(robot), residual, optimizer="mujoco", verbose=False)
left, _, _ = residual(result.x, found)
_, half = sysid.calculate_intervals(left, result.jac)
print(f"{len(sequences.sequence_name)} windows of {WINDOW_S} s, {found.size} parameters")
for (name, one), width in zip(found.items(), half):
    value = float(np.ravel(one.value)[0])
    print(f"{name:34} {value:8.3f} +- {width:.3f}{'' if value - width > 0 else '   zero is within'}")
print(f"{time.process_time() - begin:.0f} s of processor")
