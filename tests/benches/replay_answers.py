#!/usr/bin/env python3
"""The models that entrants of CauseBench hand in, replayed in MuJoCo under the efforts of the held-out logs.

    pip install mujoco numpy
    tests/benches/replay_answers.py SET ANSWERS TRUTH DRIFTS.json

From starts 1.2 s apart, at the position and velocity of the held-out log, its efforts act on the joints of the model:

    drift(t) = root mean square over starts and joints of q_model(t) - q(t),   t = 50, 200, 1000 ms

in rad or m, at most 10. `plumbline-bench score --replay DRIFTS.json` reads what is written.
"""

import json
import sys
from pathlib import Path

try:
    import mujoco
    import numpy as np
except ImportError as lack:
    sys.exit(f"skipped: {lack}; pip install mujoco numpy")

TIMES_S = (0.05, 0.2, 1.0)
EVERY_S, STEP_S, MOST = 1.2, 1e-3, 10.0


def model_of(text):
    """A model of an entrant, which may name no other file and simulates by steps of 1 ms."""
    if len(text) > 4 << 20 or "<include" in text or "file=" in text:
        raise ValueError("a model of at most 4 MiB without other files was expected")
    model = mujoco.MjModel.from_xml_string(text)
    model.opt.timestep, model.opt.integrator = STEP_S, mujoco.mjtIntegrator.mjINT_IMPLICITFAST
    return model


def drift(model, joints, log, efforts):
    ids = [mujoco.mj_name2id(model, mujoco.mjtObj.mjOBJ_JOINT, joint) for joint in joints]
    if min(ids) < 0:
        raise ValueError(f"joints {joints} were expected")
    at, dof = model.jnt_qposadr[ids], model.jnt_dofadr[ids]
    time, q = log["time"], np.stack([log[f"{joint}.position"] for joint in joints], axis=1)
    qd = np.gradient(q, time, axis=0)
    tau = np.stack([efforts[joint] for joint in joints], axis=1)
    data, squares = mujoco.MjData(model), []
    for start in np.arange(time[0] + EVERY_S, time[-1] - TIMES_S[-1], EVERY_S):
        mujoco.mj_resetData(model, data)
        for j in range(len(joints)):
            data.qpos[at[j]], data.qvel[dof[j]] = np.interp(start, time, q[:, j]), np.interp(start, time, qd[:, j])
        off = []
        for k in range(round(TIMES_S[-1] / STEP_S)):
            # An effort is held from row to row.
            row = np.searchsorted(time, start + k * STEP_S, side="right") - 1
            data.qfrc_applied[dof] = tau[row]
            mujoco.mj_step(model, data)
            if any(abs((k + 1) * STEP_S - t) < 0.5 * STEP_S for t in TIMES_S):
                now = start + (k + 1) * STEP_S
                true = np.array([np.interp(now, time, q[:, j]) for j in range(len(joints))])
                off.append(np.mean(np.clip(np.nan_to_num(data.qpos[at] - true, nan=MOST), -MOST, MOST) ** 2))
        squares.append(off)
    return [float(x) for x in np.sqrt(np.mean(squares, axis=0))] if squares else None


folder, answers, truth, out = map(Path, sys.argv[1:5])
hidden, drifts = json.loads(truth.read_text())["trials"], {}
for trial in json.loads((folder / "manifest.json").read_text())["trials"]:
    name, file = trial["name"], answers / f"{trial['name']}.json"
    try:
        model = json.loads(file.read_text()).get("model") if file.exists() else None
        efforts = hidden[name]["held_out_effort"]
        if not model or not efforts:
            continue
        if "/" in model or "\\" in model:
            raise ValueError("the name of a file beside the answer was expected")
        with np.load(folder / trial["held_out"]["npz"]) as log:
            found = drift(model_of((answers / model).read_text()), trial["joints"], log, efforts)
        if found:
            drifts[name] = found
    except Exception as error:  # A model that cannot be used counts as none.
        print(f"{name}: {error}", flush=True)
out.write_text(json.dumps({"trials": drifts}, indent=1) + "\n")
