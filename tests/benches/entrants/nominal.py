#!/usr/bin/env python3
"""Entrant of CauseBench: the description as it is, simulated by MuJoCo. It names nothing.

    pip install mujoco numpy
    tests/benches/entrants/nominal.py SET ANSWERS
"""

import sys

try:
    import mujoco
    import numpy  # noqa: F401
except ImportError as lack:
    sys.exit(f"skipped: {lack}; pip install mujoco numpy")

from bench_set import answer_all, mjcf_torque


def answer(trial):
    text = trial.mjcf.read_text()
    held_out = trial.held_out()
    tau = mjcf_torque(mujoco.MjModel.from_xml_string(text), trial.joints, held_out)
    return {"prediction": trial.predict(held_out, tau), "model": trial.hand_in(text)}


answer_all(answer)
