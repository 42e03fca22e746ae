"""Time of one log likelihood with gradient in a peer, as a line of JSON.

    python3 peers_likelihood.py PEER POINTS REPEATS THREADS

PEER is numpy, gpytorch or scikit-learn. Data, hyperparameters and what is counted are those of
examples/evidence_speed.rs: the values have to agree.
"""

import json
import os
import resource
import statistics
import sys
import time

PEER, POINTS, REPEATS, THREADS = sys.argv[1], *map(int, sys.argv[2:5])
for library in ("OMP", "OPENBLAS", "MKL"):
    os.environ[f"{library}_NUM_THREADS"] = str(THREADS)

import numpy as np  # noqa: E402, after the number of threads

LENGTH, SIGNAL, NOISE = 3.0, 1.0, 0.01


def arm(n):
    i = np.arange(n)
    t = 0.7 * i
    x = np.zeros((n, 21))
    for j in range(7):
        for k in range(1, 4):
            rate = 0.31 * k + 0.07 * j
            phase = rate * t + j * k
            x[:, j] += np.sin(phase)
            x[:, 7 + j] += rate * np.cos(phase)
            x[:, 14 + j] -= rate * rate * np.sin(phase)
    noise = np.sin(12.9898 * i) * 1000.0
    noise = noise - np.floor(noise) - 0.5
    y = (2 + np.cos(x[:, 1])) * x[:, 14] + np.sin(x[:, 0]) + 0.5 * x[:, 7] * x[:, 8] + 0.2 * noise
    return x, y


def numpy_peer(x, y):
    """One factorisation, one inverse from it, and all widths by one product of matrices."""
    from scipy.linalg import lapack

    z = x / LENGTH
    n = len(z)

    def evaluate():
        squares = np.einsum("ij,ij->i", z, z)
        k = z @ z.T
        k *= 2
        k -= squares[:, None]
        k -= squares
        np.minimum(k, 0, out=k)
        k *= 0.5
        np.exp(k, out=k)
        k *= SIGNAL
        a = k.copy(order="F")
        a[np.diag_indices(n)] += NOISE
        factor, info = lapack.dpotrf(a, lower=1, clean=0, overwrite_a=1)
        assert info == 0
        half_log_det = np.log(np.diag(factor)).sum()
        alpha = lapack.dpotrs(factor, y, lower=1)[0]
        value = -0.5 * y @ alpha - half_log_det - 0.5 * n * np.log(2 * np.pi)
        w, _ = lapack.dpotri(factor, lower=1, overwrite_c=1)
        trace = np.trace(w) - alpha @ alpha
        # Lower triangle of (K^-1 - alpha alpha') k, half of it on the diagonal.
        w = np.tril(w)
        w -= np.tril(np.outer(alpha, alpha))
        w *= k
        w[np.diag_indices(n)] *= 0.5
        rows = w.sum(0) + w.sum(1)
        gradient = np.empty(23)
        gradient[0] = -0.5 * rows.sum()
        gradient[1:22] = -(rows @ (z * z) - 2 * np.einsum("ij,ij->j", z, w @ z))
        gradient[22] = -0.5 * NOISE * trace
        return value

    return evaluate


def gpytorch_peer(x, y):
    import gpytorch
    import torch

    torch.set_num_threads(THREADS)
    torch.set_default_dtype(torch.float64)
    x, y = torch.tensor(x), torch.tensor(y)

    class Model(gpytorch.models.ExactGP):
        def __init__(self, likelihood):
            super().__init__(x, y, likelihood)
            self.mean = gpytorch.means.ZeroMean()
            kernel = gpytorch.kernels.RBFKernel(ard_num_dims=x.shape[1])
            self.kernel = gpytorch.kernels.ScaleKernel(kernel)

        def forward(self, at):
            return gpytorch.distributions.MultivariateNormal(self.mean(at), self.kernel(at))

    likelihood = gpytorch.likelihoods.GaussianLikelihood()
    model = Model(likelihood)
    model.kernel.base_kernel.lengthscale = LENGTH
    model.kernel.outputscale = SIGNAL
    likelihood.noise = NOISE
    model.train()
    likelihood.train()
    marginal = gpytorch.mlls.ExactMarginalLogLikelihood(likelihood, model)

    def evaluate():
        model.zero_grad()
        exact = gpytorch.settings.fast_computations(False, False, False)
        with gpytorch.settings.max_cholesky_size(10**9), exact:
            value = marginal(model(x), y)
            value.backward()
        return value.item() * len(y)

    return evaluate


def scikit_learn_peer(x, y):
    from sklearn.gaussian_process import GaussianProcessRegressor
    from sklearn.gaussian_process.kernels import RBF, ConstantKernel, WhiteKernel

    kernel = ConstantKernel(SIGNAL) * RBF(np.full(x.shape[1], LENGTH)) + WhiteKernel(NOISE)
    model = GaussianProcessRegressor(kernel, optimizer=None, alpha=0.0, copy_X_train=False)
    model.fit(x, y)
    theta = model.kernel_.theta
    return lambda: model.log_marginal_likelihood(theta, eval_gradient=True)[0]


def main():
    peers = {
        "numpy": numpy_peer,
        "gpytorch": gpytorch_peer,
        "scikit-learn": scikit_learn_peer,
    }
    try:
        evaluate = peers[PEER](*arm(POINTS))
    except ImportError as missing:
        print(f"{PEER} left out: {missing}", file=sys.stderr)
        return
    value, seconds = evaluate(), []
    for _ in range(REPEATS):
        start = time.perf_counter()
        value = evaluate()
        seconds.append(time.perf_counter() - start)
    peak = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss * 1024 / 1e9
    result = {"seconds": statistics.median(seconds), "peak_gb": peak, "log_likelihood": value}
    print(json.dumps(result))


main()
