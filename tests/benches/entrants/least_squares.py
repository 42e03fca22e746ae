#!/usr/bin/env python3
"""Entrant of CauseBench: the textbook of robot identification, by NumPy and the regressor of Pinocchio.

    pip install numpy pin
    tests/benches/entrants/least_squares.py SET ANSWERS

    tau = Y pi + rotor qdd + viscous qd + coulomb tanh(qd / v0) + offset

Weighted least squares over all joints, once by the deviation of the efforts and once by that of what is left (Swevers
et al. 1997), on signals low-passed to 10 Hz and taken at 20 Hz. What the logs leave open stays as described: singular
values below a twentieth of the largest are left out. A parameter of a drive is named where a hundredth of its column is
its own, and where it is three standard errors and 2 % of the joint's effort away from the description; its interval
is 1.96 standard errors of independent rows.
"""

import sys

try:
    import numpy as np
    import pinocchio as pin
except ImportError as lack:
    sys.exit(f"skipped: {lack}; pip install numpy pin")

from bench_set import DRIVE, DescribedArm, answer_all, low_pass, sparse

DEPENDENT = 1e-2  # Rest of a column beside the others, as a share of it.
LEFT_OPEN, EMPTY = 5e-2, 1e-6
SLOW = 1e-2  # v0 (rad/s or m/s).


class Arm(DescribedArm):
    """The bodies of a trial, and its drives as described."""

    dry = staticmethod(lambda qd: np.tanh(qd / SLOW))

    def parameters(self):
        """The described value of every column."""
        bodies = [self.model.inertias[k].toDynamicParameters() for k in range(1, self.model.njoints)]
        return np.concatenate(bodies + [[self.described(j, one[2]) for one in DRIVE] for j in self.joints])

    def columns(self, log):
        """Columns [joint][row, column]: ten a body, then four a drive, joint by joint."""
        n, bodies = len(self.joints), 10 * self.model.nv
        all = np.zeros((n, len(log.q), bodies + 4 * n))
        q, qd, qdd = self.motion(log)
        data = self.model.createData()
        for row in range(len(q)):
            y = pin.computeJointTorqueRegressor(self.model, data, q[row], qd[row], qdd[row])
            all[:, row, :bodies] = y[self.at]
        for j in range(n):
            drive = [log.qdd[:, j], log.qd[:, j], self.dry(log.qd[:, j]), np.ones(len(q))]
            all[j, :, bodies + 4 * j : bodies + 4 * j + 4] = np.stack(drive, axis=1)
        return all


def independent(a):
    """Columns that do not depend on those before them (modified Gram-Schmidt)."""
    kept, basis = [], []
    for k in range(a.shape[1]):
        size = np.linalg.norm(a[:, k])
        rest = a[:, k].copy()
        for q in basis + basis:
            rest -= q * (q @ rest)
        if size > 0 and np.linalg.norm(rest) > DEPENDENT * size:
            kept.append(k)
            basis.append(rest / np.linalg.norm(rest))
    return kept


def solve(a, b, deviation, described):
    """Parameters of all columns, their covariance, and the weighed columns."""
    weighed = np.concatenate(a / deviation[:, None, None])
    scale = np.linalg.norm(weighed, axis=0)
    scale = np.where(scale > EMPTY * scale.max(), scale, np.inf)  # What the logs hardly show stays as described.
    scaled = weighed / scale
    left = np.concatenate(b / deviation[:, None]) - weighed @ described
    inverse = np.linalg.pinv(scaled, rcond=LEFT_OPEN) / scale[:, None]
    return described + inverse @ left, inverse @ inverse.T, weighed


def fit(arm, logs):
    """Parameters of all columns, their covariance, and the columns that have something of their own."""
    a, b = [], []
    for log in logs:
        every = sparse(log)
        columns = arm.columns(log)
        a.append(np.stack([low_pass(one, log.step)[::every] for one in columns]))
        b.append(log.tau.T[:, ::every])
    a, b = np.concatenate(a, axis=1), np.concatenate(b, axis=1)
    deviation = np.maximum(np.sqrt((b**2).mean(axis=1)), 1e-9)
    floor, described = 1e-4 * deviation, arm.parameters()
    x, _, _ = solve(a, b, deviation, described)
    deviation = np.maximum(np.sqrt(((b - a @ x) ** 2).mean(axis=1)), floor)
    x, covariance, weighed = solve(a, b, deviation, described)
    return x, covariance, independent(weighed)


def answer(trial):
    arm, logs = Arm(trial), trial.logs()
    if any(log.tau is None for log in logs):
        return arm.as_described(trial)
    x, covariance, known = fit(arm, logs)
    at = lambda j, k: 10 * arm.model.nv + 4 * j + k
    found = {
        (joint, effect): (x[at(j, k)], np.sqrt(covariance[at(j, k), at(j, k)]), at(j, k) in known)
        for j, joint in enumerate(trial.joints)
        for k, (effect, _, _) in enumerate(DRIVE)
    }
    names = arm.name(logs, found)
    held_out = trial.held_out()
    tau = (arm.columns(held_out) @ x).T
    return {"names": names, "prediction": trial.predict(held_out, tau), "model": trial.hand_in(arm.text())}


answer_all(answer)
