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
import xml.etree.ElementTree as ET

try:
    import numpy as np
    import pinocchio as pin
    from figaroh.backends.pinocchio import PinocchioBackend
    from figaroh.identification.parameter import add_standard_additional_parameters, get_standard_parameters
    from figaroh.tools.qrdecomposition import QRDecomposer
    from figaroh.tools.regressor import build_regressor_basic, build_regressor_reduced, get_index_eliminate
except ImportError as lack:
    sys.exit(f"skipped: {lack}; pip install numpy figaroh")

from bench_set import CUTOFF_HZ, answer_all, low_pass

ZERO, RELATIVE_TOLERANCE, ABSOLUTE_TOLERANCE = 1e-3, 1e-2, 1e-6
STANDARD_DEVIATIONS, LEAST_SHARE, Z = 3.0, 0.02, 1.96
# Of a parameter of FIGAROH the effect, its parameter, and the attribute of an MJCF joint that has the described value.
DRIVE = {
    "fv": ("FR01", "viscous", "damping"),
    "fs": ("FR02", "level", "frictionloss"),
    "Ia": ("IN03", "inertia", "armature"),
    "off": ("DR03", "offset", None),
}


class Arm:
    """The bodies of a trial for FIGAROH, and the drives as described."""

    def __init__(self, trial):
        text = trial.urdf.read_text().replace('type="continuous"', 'type="revolute"')
        self.model = pin.buildModelFromXML(text)
        self.xml = ET.fromstring(trial.mjcf.read_text())
        option = self.xml.find("option")
        gravity = option.get("gravity", "0 0 -9.81") if option is not None else "0 0 -9.81"
        self.model.gravity.linear = np.array([float(x) for x in gravity.split()])
        self.backend = PinocchioBackend.from_model(self.model)
        self.at = [self.model.joints[self.model.getJointId(name)].idx_v for name in trial.joints]
        self.in_xml = {one.get("name"): one for one in self.xml.iter("joint")}
        blocks = ["has_friction", "has_actuator_inertia", "has_joint_offset"]
        self.settings = {key: True for key in blocks} | {"act_idxv": self.at}
        for key, (_, _, attribute) in DRIVE.items():
            self.settings[key] = [self.described(joint, attribute) for joint in self.model.names[1:]]
        standard = get_standard_parameters(self.model)
        self.parameters = standard | add_standard_additional_parameters(self.model, self.settings)

    def described(self, joint, attribute):
        at = self.in_xml.get(joint)
        return 0.0 if attribute is None or at is None else float((at.get(attribute) or "0").split()[0])

    def regressor(self, log, every=1):
        """Regressor [joint, row, parameter], low-passed as the efforts where rows are left out."""
        q, qd, qdd = (np.zeros((len(log.q), self.model.nv)) for _ in range(3))
        q[:, self.at], qd[:, self.at], qdd[:, self.at] = log.q, log.qd, log.qdd
        w = build_regressor_basic(self, q, qd, qdd, self.settings).reshape(self.model.nv, len(q), -1)
        return w if every == 1 else np.stack([low_pass(one, log.step)[::every] for one in w])


def fit(arm, logs):
    """Expressions of the base parameters, their columns among all, values, described values and standard deviations."""
    w, tau = [], []
    for log in logs:
        every = max(1, round(1 / (2 * CUTOFF_HZ * log.step)))
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
    expressions, columns, phi, nominal, deviation = fit(arm, logs)
    first = [expression.split(" ")[0] for expression in expressions]
    found = {name: (float(change), float(error)) for name, change, error in zip(first, phi - nominal, deviation)}
    every = [np.concatenate([getattr(log, key) for log in logs]) for key in ("qd", "qdd", "tau")]
    names = []
    for j, joint in enumerate(trial.joints):
        qd, qdd, tau = (one[:, j] for one in every)
        torque = {"fv": np.sqrt((qd**2).mean()), "fs": 1.0, "Ia": np.sqrt((qdd**2).mean()), "off": 1.0}
        for key, (effect, parameter, attribute) in DRIVE.items():
            if f"{key}_{joint}" not in found:
                continue
            change, error = found[f"{key}_{joint}"]
            described = arm.described(joint, attribute)
            value = described + change
            if attribute:
                arm.in_xml[joint].set(attribute, repr(max(value, 0.0)))
            if abs(change) > STANDARD_DEVIATIONS * error and abs(change) * torque[key] > LEAST_SHARE * np.sqrt((tau**2).mean()):
                interval = [value - Z * error, value + Z * error]
                size = {"parameter": parameter, "value": value, "interval": interval, "described": described}
                names.append({"effect": effect, "joint": joint, "sizes": [size]})
    held_out = trial.held_out()
    tau = (arm.regressor(held_out)[arm.at][:, :, columns] @ phi).T
    model = trial.hand_in(ET.tostring(arm.xml, encoding="unicode"))
    return {"names": names, "prediction": trial.predict(held_out, tau), "model": model}


warnings.filterwarnings("ignore")
answer_all(answer)
