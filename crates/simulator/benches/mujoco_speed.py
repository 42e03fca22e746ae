#!/usr/bin/env python3
"""MuJoCo's speed on the Barrett WAM at 0.1 ms: the figures that stand beside the simulator's.

Prints a table of simulated seconds per CPU second, on one core. The arm follows the motion of
tests/golden/make_mujoco.py once under its 500 Hz controller; the torques of that run are then
replayed by mujoco.rollout, in which no Python runs between steps. Replay starts from the same
state and so repeats the run. CPU time of the process is counted, which work elsewhere on the
machine lengthens through shared caches and clocks only: the best of five replays is printed.

An elastic or slack joint has a rotor of its own: two coaxial hinges, of which the first carries
rotor inertia, friction and torque and the second the deflection.

    pip install mujoco==4.0.0 numpy
    python3 crates/simulator/benches/mujoco_speed.py
"""

import sys
import time
from pathlib import Path

import mujoco
import mujoco.rollout
import numpy as np

sys.path.insert(0, str(Path(__file__).resolve().parents[3] / "tests/golden"))
sys.dont_write_bytecode = True
import make_mujoco as wam  # noqa: E402

STEP_S = 0.1e-3
REPLAYS = 5
NO_FRICTION = 0.0 * wam.COULOMB
STIFFNESS = {"j2_shoulder_pitch": 10_000.0, "j4_elbow_pitch": 4_000.0}  # N m/rad
HALF_GAP = {"j2_shoulder_pitch": 2e-3, "j4_elbow_pitch": 2e-3}  # rad

ARMS = {
    "plain arm": (NO_FRICTION, {}, {}),
    "dry friction": (wam.COULOMB, {}, {}),
    "two elastic joints": (NO_FRICTION, STIFFNESS, {}),
    "two elastic joints, dry friction": (wam.COULOMB, STIFFNESS, {}),
    "backlash at two joints, dry friction": (wam.COULOMB, {}, HALF_GAP),
}
INTEGRATORS = {
    "Euler": mujoco.mjtIntegrator.mjINT_EULER,
    "implicitfast": mujoco.mjtIntegrator.mjINT_IMPLICITFAST,
}


def arm(coulomb, stiffness, half_gap, integrator):
    """The model, and the index of each motor among its degrees of freedom."""
    spec = wam.arm_spec()
    names = [joint.name for joint in spec.joints]
    for motor in list(spec.joints):
        if motor.name in stiffness or motor.name in half_gap:
            joint = motor.parent.add_joint(name=f"{motor.name} deflection", axis=motor.axis)
            joint.pos = motor.pos
            joint.stiffness = [stiffness.get(motor.name, 0.0), 0.0, 0.0]
            if motor.name in half_gap:
                joint.limited = mujoco.mjtLimited.mjLIMITED_TRUE
                joint.range = [-half_gap[motor.name], half_gap[motor.name]]
    model = spec.compile()
    motors = np.array([model.joint(name).dofadr[0] for name in names])
    model.dof_frictionloss[motors] = coulomb
    # As stiff as the step allows: dry friction as in the golden file, stops closed in two steps.
    model.dof_solimp[:] = [0.9999, 0.9999, 0.001, 0.5, 2.0]
    model.dof_solref[:] = [-1.0, -0.5 / STEP_S]
    model.jnt_solref[:] = [2 * STEP_S, 1.0]
    model.opt.timestep = STEP_S
    model.opt.integrator = integrator
    return model, motors


def record(model, motors):
    """The torques of a run in closed loop, one row a step; and the state in which it ended."""
    data = mujoco.MjData(model)
    start(model, motors, data)
    tau_ff, held, rows = data.qfrc_bias[motors].copy(), round(wam.CONTROL_S / STEP_S), []
    for k in range(round(wam.DURATION_S / wam.CONTROL_S)):
        tau = wam.control(k * wam.CONTROL_S, data.qpos[motors], data.qvel[motors], tau_ff)
        data.qfrc_applied[motors] = tau
        mujoco.mj_step(model, data, held)
        rows.append(data.qfrc_applied.copy())
    return np.repeat(rows, held, axis=0), np.concatenate([data.qpos, data.qvel])


def start(model, motors, data):
    data.qpos[motors] = wam.Q0
    mujoco.mj_forward(model, data)


def replay(model, motors, torques):
    """CPU seconds of one replay, and the state in which it ended."""
    data = mujoco.MjData(model)
    start(model, motors, data)
    full = mujoco.mjtState.mjSTATE_FULLPHYSICS
    state = np.empty(mujoco.mj_stateSize(model, full))
    mujoco.mj_getState(model, data, state, full)
    states = np.empty((1, len(torques), len(state)))
    before = time.process_time()
    mujoco.rollout.rollout(
        model, data, state, torques[None], state=states,
        control_spec=mujoco.mjtState.mjSTATE_QFRC_APPLIED,
    )
    return time.process_time() - before, states[0, -1, 1 : 1 + model.nq + model.nv]


def speed(variant, integrator):
    """Simulated seconds per CPU second, degrees of freedom, and how far replay is from the run."""
    model, motors = arm(*variant, integrator)
    torques, end = record(model, motors)
    runs = [replay(model, motors, torques) for _ in range(REPLAYS)]
    apart = max(np.abs(replayed - end).max() for _, replayed in runs)
    if not apart < 1e-9:
        sys.exit(f"replay ended {apart:.3g} from the run that it repeats, expected less than 1e-9")
    return wam.DURATION_S / min(cpu for cpu, _ in runs), model.nv


def main():
    print(f"MuJoCo {mujoco.__version__}, step {STEP_S * 1e3:g} ms, simulated seconds per CPU second\n")
    print("| arm | degrees of freedom | " + " | ".join(INTEGRATORS) + " |")
    print("|---|---|" + "---|" * len(INTEGRATORS))
    for name, variant in ARMS.items():
        results = [speed(variant, integrator) for integrator in INTEGRATORS.values()]
        factors = " | ".join(f"{factor:.0f}" for factor, _ in results)
        print(f"| {name} | {results[0][1]} | {factors} |")


if __name__ == "__main__":
    main()
