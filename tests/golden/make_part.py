"""Joint torques of the whole arm of part.urdf with some joints held, by Pinocchio.

    python3 tests/golden/make_part.py > tests/golden/part.json
"""

import datetime
import json
import pathlib

import numpy as np
import pinocchio as pin

URDF = pathlib.Path(__file__).with_name("part.urdf")
# Joints that are held and where (m or rad).
CASES = [
    {"grip": 0.03},
    {"lift": 0.25},
    {"lift": 0.25, "grip": 0.0, "pan": -0.7},
    {"shoulder": 0.6, "wrist": 1.1},
    {"lift": 0.1, "shoulder": -0.4, "elbow": 2.5, "pan": 0.3},
]
STATES_PER_CASE = 4

model = pin.buildModelFromUrdf(str(URDF))
data = model.createData()
random = np.random.default_rng(32)
cases = []
for locked in CASES:
    states = []
    for _ in range(STATES_PER_CASE):
        q, qd, qdd = (dict() for _ in range(3))
        configuration = pin.neutral(model)
        velocity, acceleration = np.zeros(model.nv), np.zeros(model.nv)
        for name, joint in zip(model.names[1:], model.joints[1:]):
            free = name not in locked
            q[name] = round(float(random.uniform(-1, 1)), 3) if free else locked[name]
            qd[name] = round(float(random.uniform(-2, 2)), 3) if free else 0.0
            qdd[name] = round(float(random.uniform(-5, 5)), 3) if free else 0.0
            # A continuous joint is held as a cosine and a sine.
            place = [q[name]] if joint.nq == 1 else [np.cos(q[name]), np.sin(q[name])]
            configuration[joint.idx_q : joint.idx_q + joint.nq] = place
            velocity[joint.idx_v], acceleration[joint.idx_v] = qd[name], qdd[name]
        tau = pin.rnea(model, data, configuration, velocity, acceleration)
        tau = {n: float(tau[j.idx_v]) for n, j in zip(model.names[1:], model.joints[1:])}
        keep = lambda values: {n: v for n, v in values.items() if n not in locked}
        states.append({"q": keep(q), "qd": keep(qd), "qdd": keep(qdd), "tau": keep(tau)})
    cases.append({"locked": locked, "states": states})
print(
    json.dumps(
        {
            "program": "Pinocchio",
            "version": pin.__version__,
            "command": "python3 tests/golden/make_part.py > tests/golden/part.json",
            "date": str(datetime.date.today()),
            "cases": cases,
        },
        indent=1,
    )
)
