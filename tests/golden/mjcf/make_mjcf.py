"""Torques of arm.xml by MuJoCo's inverse dynamics.

    python3 tests/golden/mjcf/make_mjcf.py > tests/golden/mjcf/arm.json

Dry friction is left out of MuJoCo's model and added as level sign(qd): its solver softens it.
"""

import json
import pathlib
import sys

import mujoco
import numpy as np

model = mujoco.MjModel.from_xml_path(str(pathlib.Path(__file__).parent / "arm.xml"))
levels = model.dof_frictionloss.copy()
model.dof_frictionloss[:] = 0
data = mujoco.MjData(model)
random = np.random.default_rng(7)
states = []
for _ in range(10):
    data.qpos = [0, 0, 0.1, 0] + random.uniform(-1, 1, model.nq) * [1, 1, 0.05, 1]
    data.qvel = random.uniform(-2, 2, model.nv)
    data.qacc = random.uniform(-5, 5, model.nv)
    mujoco.mj_inverse(model, data)
    torque = data.qfrc_inverse + levels * np.sign(data.qvel)
    # A limit that is reached pushes.
    assert not np.any(data.qfrc_constraint), data.qfrc_constraint
    states.append([list(map(float, x)) for x in (data.qpos, data.qvel, data.qacc, torque)])
json.dump(
    {
        "program": "MuJoCo",
        "version": mujoco.__version__,
        "command": "tests/golden/mjcf/make_mjcf.py",
        "joints": [model.joint(i).name for i in range(model.njnt)],
        "q_qd_qdd_tau": states,
    },
    sys.stdout,
    indent=1,
)
