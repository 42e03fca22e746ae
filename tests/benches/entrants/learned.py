#!/usr/bin/env python3
"""Entrants of CauseBench: a Gaussian process and a neural network on (q, qd, qdd). They predict and name nothing.

    pip install numpy scikit-learn
    tests/benches/entrants/learned.py SET ANSWERS gp|nn

Settings, one model a joint, inputs and output scaled to mean 0 and deviation 1:

- gp: squared exponential with a length an input, and white noise; 400 rows spread evenly, hyperparameters by the
  likelihood from one start, as the documentation of scikit-learn has them;
- nn: two layers of 64 units with tanh, L-BFGS, alpha 1e-3, at most 500 iterations, 4000 rows spread evenly.
"""

import sys

try:
    import numpy as np
    from sklearn.compose import TransformedTargetRegressor
    from sklearn.gaussian_process import GaussianProcessRegressor
    from sklearn.gaussian_process.kernels import RBF, ConstantKernel, WhiteKernel
    from sklearn.neural_network import MLPRegressor
    from sklearn.pipeline import make_pipeline
    from sklearn.preprocessing import StandardScaler
except ImportError as lack:
    sys.exit(f"skipped: {lack}; pip install numpy scikit-learn")

import warnings

from bench_set import answer_all

ROWS = {"gp": 400, "nn": 4000}
SEED = 1


def model(kind, inputs):
    if kind == "gp":
        kernel = ConstantKernel(1.0) * RBF(np.full(inputs, 3.0), (0.1, 1e3)) + WhiteKernel(0.01, (1e-6, 1.0))
        one = GaussianProcessRegressor(kernel, random_state=SEED)
    else:
        one = MLPRegressor(hidden_layer_sizes=(64, 64), activation="tanh", solver="lbfgs", alpha=1e-3, max_iter=500, random_state=SEED)
    return TransformedTargetRegressor(make_pipeline(StandardScaler(), one), transformer=StandardScaler())


def inputs(log):
    return np.hstack([log.q, log.qd, log.qdd])


def answer(trial):
    kind = sys.argv[3]
    logs, held_out = trial.logs(), trial.held_out()
    x, tau = np.vstack([inputs(log) for log in logs]), np.vstack([log.tau for log in logs])
    rows = np.linspace(0, len(x) - 1, min(len(x), ROWS[kind])).astype(int)
    predicted = np.empty_like(held_out.q)
    for j in range(len(trial.joints)):
        predicted[:, j] = model(kind, x.shape[1]).fit(x[rows], tau[rows, j]).predict(inputs(held_out))
    return {"prediction": trial.predict(held_out, predicted)}


warnings.filterwarnings("ignore")
answer_all(answer)
