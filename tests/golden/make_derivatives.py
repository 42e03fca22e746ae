#!/usr/bin/env python3
"""Derivatives of the inverse dynamics of the Barrett WAM from Pinocchio: writes derivatives_wam7.json.

The states are those of dynamics_wam7.json beside this file; rotors are left out. Of every state

    dq, dqd, dqdd: rows of d tau / d q, d tau / d qd and d tau / d qdd   (N m/rad, N m s/rad, kg m2)

    pip install pin==4.1.0
    python3 tests/golden/make_derivatives.py
"""

import json
import pathlib

import numpy as np
import pinocchio

here = pathlib.Path(__file__).parent
model = pinocchio.buildModelFromUrdf(str(here / "../../robots/wam7/robot.urdf"))
data = model.createData()
states = json.loads((here / "dynamics_wam7.json").read_text())["states"]
rows = []
for state in states:
    q, qd, qdd = (np.array(state[name]) for name in ("q", "qd", "qdd"))
    pinocchio.computeRNEADerivatives(model, data, q, qd, qdd)
    mass = np.triu(data.M) + np.triu(data.M, 1).T
    matrices = {"dq": data.dtau_dq, "dqd": data.dtau_dv, "dqdd": mass}
    rows.append({name: matrix.tolist() for name, matrix in matrices.items()})
out = {"program": "Pinocchio", "version": pinocchio.__version__, "states": rows}
(here / "derivatives_wam7.json").write_text(json.dumps(out) + "\n")
print(f"{len(rows)} states")
