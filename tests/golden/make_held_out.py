#!/usr/bin/env python3
"""What MuJoCo makes of the robot of the demo: writes held_out.json, held_out.xml and held_out.toml beside this file.

    plumbline demo --out DEMO
    pip install mujoco==4.0.0 pyarrow scipy
    python3 tests/golden/make_held_out.py DEMO plumbline

held_out.toml is the extended robot, held_out.xml its export. The states are those of run_4, which the diagnosis has not
seen: positions and efforts pass a zero-phase Butterworth low-pass of order 4 at 10 Hz, velocity and acceleration are
differences, and every tenth sample of 3 s is kept. The torques are those of mj_inverse without limits (N m).
"""

import json
import pathlib
import shutil
import subprocess
import sys
import tempfile

import mujoco
import numpy as np
import pyarrow.parquet
import scipy.signal

here = pathlib.Path(__file__).parent
demo, program = pathlib.Path(sys.argv[1]), sys.argv[2]
CUTOFF_HZ, EVERY, FROM_S, TO_S = 10.0, 10, 2.0, 5.0

shutil.copy(demo / "diagnosis/extended.toml", here / "held_out.toml")
with tempfile.TemporaryDirectory() as folder:
    subprocess.run([program, "export", demo, "--to", "mjcf", "--out", folder], check=True, stdout=subprocess.DEVNULL)
    shutil.copy(pathlib.Path(folder) / "extended.xml", here / "held_out.xml")

log = pyarrow.parquet.read_table(demo / "logs/run_4.parquet").to_pydict()
joints = [name.removesuffix(".position") for name in log if name.endswith(".position") and "." in name]
joints = [name for name in joints if f"{name}.effort" in log]
time = np.array(log["time"])
rate_hz = 1 / np.median(np.diff(time))
low_pass = scipy.signal.butter(4, CUTOFF_HZ, fs=rate_hz, output="sos")
of = lambda channel: np.array([log[f"{name}.{channel}"] for name in joints])
q, effort = (scipy.signal.sosfiltfilt(low_pass, of(channel)) for channel in ["position", "effort"])
qd = np.gradient(q, 1 / rate_hz, axis=1)
qdd = np.gradient(qd, 1 / rate_hz, axis=1)
kept = np.flatnonzero((time >= FROM_S) & (time < TO_S))[::EVERY]
numbers = lambda rows: [[float(f"{x:.7g}") for x in row] for row in rows]
states = {name: numbers(x[:, kept].T) for name, x in {"q": q, "qd": qd, "qdd": qdd, "effort": effort}.items()}

model = mujoco.MjModel.from_xml_path(str(here / "held_out.xml"))
model.opt.disableflags |= mujoco.mjtDisableBit.mjDSBL_LIMIT
data = mujoco.MjData(model)
places = [(model.joint(name).qposadr[0], model.joint(name).dofadr[0]) for name in joints]
torques = []
for row in zip(states["q"], states["qd"], states["qdd"]):
    for (p, d), x, v, a in zip(places, *row):
        data.qpos[p], data.qvel[d], data.qacc[d] = x, v, a
    mujoco.mj_inverse(model, data)
    torques.append([data.qfrc_inverse[d] for _, d in places])
told = {"program": "MuJoCo", "version": mujoco.__version__, "command": "python3 tests/golden/make_held_out.py DEMO plumbline"}
golden = {**told, "joints": joints, **states, "torque": numbers(torques)}
(here / "held_out.json").write_text(json.dumps(golden) + "\n")
error = np.sqrt(np.mean((np.array(torques) - np.array(states["effort"])) ** 2, axis=0))
print(len(kept), "states;", dict(zip(joints, error.round(4))), "N m RMS,", round(float(np.sqrt(np.sum(error**2))), 4), "over all")
