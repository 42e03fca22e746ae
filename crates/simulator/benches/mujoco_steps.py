#!/usr/bin/env python3
"""Error after one second against the length of the steps, here and in MuJoCo: arms of 1, 6, 7 and 30 joints.

Every arm follows slow sines under the same 500 Hz controller without a model. The tip after one second is held against the
finest run here (second order, steps of 0.01 ms). MuJoCo's arm is what `plumbline export --to mjcf` writes; its
dry friction is as stiff as its step allows (tests/golden/make_mujoco.py), its time that of mujoco.rollout under the
torques of its own run, in which no Python runs between steps. The quickest of several runs counts on both sides.

    pip install mujoco==4.0.0 numpy
    cargo build --release && cargo build --release -p simulator --example steps
    python3 crates/simulator/benches/mujoco_steps.py target/release/plumbline target/release/examples/steps
"""

import itertools
import json
import subprocess
import sys
import tempfile
import time
from pathlib import Path

import mujoco
import mujoco.rollout
import numpy as np

ROBOTS = Path(__file__).resolve().parents[3] / "robots"
PERIOD_S = 2e-3
PERIODS = 500
STEPS_MS = [0.1, 0.2, 0.5, 1.0, 2.0]
TIP_IN_LINK_M = [0.05, 0.03, 0.1]
# Of the tip, for which the quickest run of each is sought (m).
ASKED_M = [1e-3, 1e-4, 1e-5, 1e-6]
REPLAYS = 5
INTEGRATORS = {
    "MuJoCo Euler": mujoco.mjtIntegrator.mjINT_EULER,
    "MuJoCo implicitfast": mujoco.mjtIntegrator.mjINT_IMPLICITFAST,
}


def chain(folder, joints):
    """Equal links that hang down, 1 m in all if there are several; axes turn by a right angle from joint to joint."""
    length, mass = 1.0 / max(joints, 3), 6.0 / max(joints, 3)
    about = mass * length**2 / 12
    lines = ['<robot name="chain"><link name="l0"/>']
    for i in range(joints):
        axis, at = ("0 1 0", "1 0 0")[i % 2], -length if i else 0
        lines.append(
            f'<link name="l{i + 1}"><inertial><origin xyz="0 0 {-length / 2}"/><mass value="{mass}"/>'
            f'<inertia ixx="{about}" iyy="{about}" izz="{about / 10}" ixy="0" ixz="0" iyz="0"/></inertial></link>'
            f'<joint name="j{i + 1}" type="continuous"><parent link="l{i}"/><child link="l{i + 1}"/>'
            f'<origin xyz="0 0 {at}"/><axis xyz="{axis}"/></joint>'
        )
    folder.mkdir(parents=True)
    (folder / "robot.urdf").write_text("\n".join(lines) + "\n</robot>\n")
    rotors = "".join(f"[joint.j{i + 1}]\nrotor_inertia_kg_m2 = 0.01\n" for i in range(joints))
    (folder / "robot.toml").write_text('urdf = "robot.urdf"\n' + rotors)
    return folder / "robot.toml"


def compiled(program, robot, folder):
    """MuJoCo's model of the exported arm, without limits, shapes and friction."""
    subprocess.run([program, "export", str(robot), "--to", "mjcf", "--out", str(folder)], check=True, capture_output=True)
    spec = mujoco.MjSpec.from_file(str(next(folder.glob("*.xml"))))
    for shape in list(spec.geoms):
        spec.delete(shape)
    for actuator in list(spec.actuators):
        spec.delete(actuator)
    for joint in spec.joints:
        joint.limited = mujoco.mjtLimited.mjLIMITED_FALSE
    model = spec.compile()
    model.dof_damping[:] = 0
    model.dof_frictionloss[:] = 0
    return model


def case(name, robot, model, with_friction):
    """Gains of 8 rad/s and three quarters of critical damping for each joint alone, and torques that hold the arm at rest."""
    joints = model.nv
    q0 = np.array([0.3 * (-1) ** i for i in range(joints)]) if joints < 30 else np.full(joints, 0.05)
    data = mujoco.MjData(model)
    data.qpos[:] = q0
    mujoco.mj_forward(model, data)
    full = np.zeros((joints, joints))
    mujoco.mj_fullM(model, data, full)
    # A long chain is governed by the inertia that each joint has with the others free.
    inertia = np.diag(full) if joints < 30 else 1 / np.diag(np.linalg.inv(full))
    return {
        "name": name,
        "robot": str(robot),
        "q0_rad": q0.tolist(),
        "amplitude_rad": [(0.25 if joints < 30 else 0.1) * (-1) ** i for i in range(joints)],
        "frequency_rad_per_s": [5.0 + 2.0 * i / joints for i in range(joints)],
        "kp_nm_per_rad": (64 * inertia).tolist(),
        "kd_nm_s_per_rad": (12 * inertia).tolist(),
        "tau_ff_nm": data.qfrc_bias.tolist(),
        "coulomb_nm": (2 * inertia * with_friction).tolist(),
        "tip_in_link_m": TIP_IN_LINK_M,
    }


def torque(arm, tick, q, qd):
    swing = 1 - np.cos(np.array(arm["frequency_rad_per_s"]) * tick * PERIOD_S)
    wanted = np.array(arm["q0_rad"]) + np.array(arm["amplitude_rad"]) * swing
    return np.array(arm["kp_nm_per_rad"]) * (wanted - q) - np.array(arm["kd_nm_s_per_rad"]) * qd + np.array(arm["tau_ff_nm"])


def simulate(model, arm, step_s):
    """The tip after one second, and the torques of the run, one row a step."""
    data, held, rows = mujoco.MjData(model), round(PERIOD_S / step_s), []
    data.qpos[:] = arm["q0_rad"]
    mujoco.mj_forward(model, data)
    for tick in range(PERIODS):
        data.qfrc_applied[:] = torque(arm, tick, data.qpos, data.qvel)
        mujoco.mj_step(model, data, held)
        rows.append(data.qfrc_applied.copy())
    mujoco.mj_kinematics(model, data)
    rotation = data.xmat[-1].reshape(3, 3)
    return data.xpos[-1] + rotation @ TIP_IN_LINK_M, np.repeat(rows, held, axis=0)


def seconds(model, arm, torques):
    data = mujoco.MjData(model)
    data.qpos[:] = arm["q0_rad"]
    mujoco.mj_forward(model, data)
    full = mujoco.mjtState.mjSTATE_FULLPHYSICS
    state = np.empty(mujoco.mj_stateSize(model, full))
    mujoco.mj_getState(model, data, state, full)
    states, best = np.empty((1, len(torques), len(state))), np.inf
    for _ in range(REPLAYS):
        start = time.perf_counter()
        mujoco.rollout.rollout(
            model, data, state, torques[None], state=states, control_spec=mujoco.mjtState.mjSTATE_QFRC_APPLIED
        )
        best = min(best, time.perf_counter() - start)
    return best


def peers(model, arm):
    for (name, integrator), step_ms in itertools.product(INTEGRATORS.items(), STEPS_MS):
        model.opt.timestep, model.opt.integrator = 1e-3 * step_ms, integrator
        model.dof_frictionloss[:] = arm["coulomb_nm"]
        model.dof_solimp[:] = [0.9999, 0.9999, 0.001, 0.5, 2.0]
        model.dof_solref[:] = [-1.0, -0.5 / (1e-3 * step_ms)]
        tip, torques = simulate(model, arm, 1e-3 * step_ms)
        yield {
            "order": name, "step_ms": step_ms, "tip_m": tip.tolist(),
            "us_per_step": 1e6 * seconds(model, arm, torques) / len(torques),
        }


def table(arm, joints, outcomes):
    truth = next(o for o in outcomes if o["order"] == "second" and o["step_ms"] == 0.01)
    error = lambda o: float(np.linalg.norm(np.subtract(o["tip_m"], truth["tip_m"])))
    cost = lambda o: o["us_per_step"] * 1e3 / o["step_ms"] * 1e-3
    kinds = ["first", "second", *INTEGRATORS]
    print(f"\n{arm['name']}: {joints} joints\n\n| | us a step | " + " | ".join(f"{s:g} ms" for s in STEPS_MS) + " |")
    print("|---|---|" + "---|" * len(STEPS_MS))
    for kind in kinds:
        of = {o["step_ms"]: o for o in outcomes if o["order"] == kind}
        cells = [f"{error(of[s]):.1e} m" if s in of else "ran away" for s in STEPS_MS]
        print(f"| {kind} | {of[0.1]['us_per_step']:.2f} | " + " | ".join(cells) + " |")
    print("\n| tip error at most | " + " | ".join(f"{k}: step, ms a second" for k in kinds) + " |")
    print("|---|" + "---|" * len(kinds))
    for asked in ASKED_M:
        cells = []
        for kind in kinds:
            good = [o for o in outcomes if o["order"] == kind and error(o) <= asked and o is not truth]
            # The longest step from which on every shorter one is as good.
            longest = max((o for o in good if all(error(p) <= asked for p in outcomes
                           if p["order"] == kind and p["step_ms"] <= o["step_ms"])), key=lambda o: o["step_ms"], default=None)
            cells.append(f"{longest['step_ms']:g} ms, {cost(longest):.2f}" if longest else "–")
        print(f"| {asked:g} m | " + " | ".join(cells) + " |")


def main():
    program, steps = sys.argv[1:3]
    print(f"MuJoCo {mujoco.__version__}")
    with tempfile.TemporaryDirectory() as folder:
        folder = Path(folder)
        robots = {
            "pendulum": chain(folder / "pendulum", 1),
            "ur5e": ROBOTS / "ur5e/robot.toml",
            "wam7": ROBOTS / "wam7/robot.toml",
            "chain": chain(folder / "chain", 30),
        }
        asked = sys.argv[3:] or list(robots)
        for name, robot in ((name, robots[name]) for name in asked):
            model = compiled(program, robot, folder / f"{name}_mjcf")
            for with_friction in (False, True):
                arm = case(name + (", dry friction" if with_friction else ""), robot, model, with_friction)
                file = folder / "case.json"
                file.write_text(json.dumps(arm))
                run = subprocess.run([steps, str(file)], check=True, stdout=subprocess.PIPE, text=True)
                outcomes = [json.loads(line) for line in run.stdout.splitlines()]
                table(arm, model.nv, outcomes + list(peers(model, arm)))


if __name__ == "__main__":
    main()
