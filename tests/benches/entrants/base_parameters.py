#!/usr/bin/env python3
"""Entrant of CauseBench: FIGAROH, base parameters with friction, actuator inertia and offset of every joint.

    pip install numpy figaroh
    tests/benches/entrants/base_parameters.py SET ANSWERS

    tau = W_b phi_b,    W_b columns of [Y, qd, sign(qd), qdd, 1] that do not depend on each other

Its own functions in the order of `BaseIdentification.solve(wls=True)`: `build_regressor_basic`, `get_index_eliminate`
(1e-3), decimation of regressor and efforts to 20 Hz, `QRDecomposer.double_decomposition`, then least squares weighted by
the residual of every joint. The relative tolerance that drops barely excited parameters is 1e-2: its documentation has 1e-4
as an example, with which F1 of the smoke set is 55 % in place of 69.

A prediction is that of the base parameters, which are those of the logs alone. A base parameter that begins with one of a
drive is read as this one, the others in it as described; it is named where it is three standard deviations and 2 % of the
joint's effort away from the description, and its interval is 1.96 standard deviations.
"""

import sys
import warnings

try:
    import numpy as np
    from figaroh.backends.pinocchio import PinocchioBackend
    from figaroh.identification.parameter import add_standard_additional_parameters, get_standard_parameters
    from figaroh.tools.qrdecomposition import QRDecomposer
    from figaroh.tools.regressor import build_regressor_basic, build_regressor_reduced, get_index_eliminate
except ImportError as lack:
    sys.exit(f"skipped: {lack}; pip install numpy figaroh")

from bench_set import DRIVE, DescribedArm, answer_all, low_pass, sparse

ZERO, RELATIVE_TOLERANCE, ABSOLUTE_TOLERANCE = 1e-3, 1e-2, 1e-6
# The parameter of FIGAROH of each effect of a drive.
KEYS = {"IN03": "Ia", "FR01": "fv", "FR02": "fs", "DR03": "off"}


class Arm(DescribedArm):
    """The bodies of a trial for FIGAROH, and the drives as described."""

    def __init__(self, trial):
        super().__init__(trial)
        self.backend = PinocchioBackend.from_model(self.model)
        blocks = ["has_friction", "has_actuator_inertia", "has_joint_offset"]
        self.settings = {key: True for key in blocks} | {"act_idxv": self.at}
        for effect, _, attribute in DRIVE:
            self.settings[KEYS[effect]] = [self.described(joint, attribute) for joint in self.model.names[1:]]
        standard = get_standard_parameters(self.model)
        self.parameters = standard | add_standard_additional_parameters(self.model, self.settings)

    def regressor(self, log, every=1):
        """Regressor [joint, row, parameter], low-passed as the efforts where rows are left out."""
        w = build_regressor_basic(self, *self.motion(log), self.settings).reshape(self.model.nv, len(log.q), -1)
        return w if every == 1 else np.stack([low_pass(one, log.step)[::every] for one in w])


def fit(arm, logs):
    """Expressions of the base parameters, their columns among all, values, described values and standard deviations."""
    w, tau = [], []
    for log in logs:
        every = sparse(log)
        w.append(arm.regressor(log, every))
        efforts = np.zeros((arm.model.nv, len(w[-1][0])))
        efforts[arm.at] = log.tau.T[:, ::every]
        tau.append(efforts)
    w, tau = np.concatenate(w, axis=1)[arm.at], np.concatenate(tau, axis=1)[arm.at]
    rows = w.reshape(-1, w.shape[2])
    dropped, names = get_index_eliminate(rows, arm.parameters, tol_e=ZERO)
    kept = np.delete(np.arange(w.shape[2]), dropped)
    decomposer = QRDecomposer(tolerance=ABSOLUTE_TOLERANCE, relative_tolerance=RELATIVE_TOLERANCE)
    rest = build_regressor_reduced(rows, dropped)
    base, _, expressions, phi, nominal = decomposer.double_decomposition(tau.ravel(), rest, names, arm.parameters)
    left = (tau.ravel() - base @ phi).reshape(tau.shape)
    weight = np.repeat(1 / np.sqrt((left**2).mean(axis=1) + 1e-12), tau.shape[1])
    weighed = base * weight[:, None]
    covariance = np.linalg.inv(weighed.T @ weighed)
    phi = covariance @ (weighed.T @ (tau.ravel() * weight))
    return expressions, kept[decomposer.get_base_indices()], phi, nominal, np.sqrt(np.diag(covariance))


def answer(trial):
    arm, logs = Arm(trial), trial.logs()
    if any(log.tau is None for log in logs):
        return arm.as_described(trial)
    expressions, columns, phi, nominal, deviation = fit(arm, logs)
    first = [expression.split(" ")[0] for expression in expressions]
    change = {name: (float(change), float(error)) for name, change, error in zip(first, phi - nominal, deviation)}
    found = {}
    for joint in trial.joints:
        for effect, _, attribute in DRIVE:
            if f"{KEYS[effect]}_{joint}" in change:
                off, error = change[f"{KEYS[effect]}_{joint}"]
                found[joint, effect] = (arm.described(joint, attribute) + off, error, True)
    names = arm.name(logs, found)
    held_out = trial.held_out()
    tau = (arm.regressor(held_out)[arm.at][:, :, columns] @ phi).T
    return {"names": names, "prediction": trial.predict(held_out, tau), "model": trial.hand_in(arm.text())}


warnings.filterwarnings("ignore")
answer_all(answer)
