#!/usr/bin/env python3
"""Prediction time of seven Gaussian processes of 21 inputs in scikit-learn and NumPy.

Prints one line of JSON for each peer and number of points: the time of one query for all seven
outputs on one thread, and with --batch M the time of M queries on the threads of the machine.
"""

import argparse
import json
import sys
import time

try:
    import numpy as np
    from sklearn.gaussian_process import GaussianProcessRegressor
    from sklearn.gaussian_process.kernels import RBF, ConstantKernel, WhiteKernel
    from threadpoolctl import threadpool_limits
except ImportError as missing:
    print(f"the peers cannot be timed without scikit-learn and NumPy: {missing}", file=sys.stderr)
    sys.exit(3)

INPUTS, OUTPUTS = 21, 7


class Problem:
    def __init__(self, n):
        draw = np.random.default_rng(1).uniform
        self.x = draw(-(3**0.5), 3**0.5, (n, INPUTS))
        self.length_scales = draw(2.0, 5.0, (OUTPUTS, INPUTS))
        self.alpha = draw(-1.0, 1.0, (OUTPUTS, n))
        self.w = -0.5 / self.length_scales**2
        self.queries = draw(-(3**0.5), 3**0.5, (3000, INPUTS))


def scikit_learn(p):
    """Seven models whose weights are set, so that 30,000 points need no factorisation."""
    models = []
    for length_scale, alpha in zip(p.length_scales, p.alpha):
        kernel = ConstantKernel(1.0) * RBF(length_scale) + WhiteKernel(1e-2)
        model = GaussianProcessRegressor(kernel, optimizer=None).fit(p.x[:1], [1.0])
        model.X_train_, model.alpha_ = p.x, alpha
        models.append(model)
    return lambda q: np.stack([model.predict(np.atleast_2d(q)) for model in models])


def numpy_plain(p):
    """The formula as it is written, all outputs by one matrix product."""
    w, alpha = p.w.T.copy(), p.alpha.T.copy()
    return lambda q: (alpha * np.exp((p.x - q) ** 2 @ w)).sum(0)


def numpy_best(p):
    """The square expanded, w x_i² stored, outputs along rows, everything in place."""
    x = np.ascontiguousarray(np.vstack([p.x.T, np.ones(len(p.x))]))
    stored, k, b = p.w @ p.x.T**2, np.empty_like(p.alpha), np.empty((OUTPUTS, INPUTS + 1))
    twice = -2 * p.w
    dot = getattr(np, "vecdot", lambda k, alpha: np.einsum("ij,ij->i", k, alpha))

    def predict(q):
        np.multiply(twice, q, out=b[:, :-1])
        np.matmul(p.w, q * q, out=b[:, -1])
        np.matmul(b, x, out=k)
        np.add(k, stored, out=k)
        np.exp(k, out=k)
        return dot(k, p.alpha)

    return predict


def numpy_best_batch(p):
    """The same, one output after the other."""
    def predict(q):
        f = np.empty((OUTPUTS, len(q)))
        for c, w in enumerate(p.w):
            k = (-2 * w * q) @ p.x.T
            k += (q**2 @ w)[:, None]
            k += p.x**2 @ w
            f[c] = np.exp(k, out=k) @ p.alpha[c]
        return f

    return predict


def times(predict, arguments, seconds, least):
    """Sorted times of calls (s), for about `seconds`."""
    found, start = [], time.perf_counter()
    predict(arguments[0])
    while len(found) < least or time.perf_counter() - start < seconds:
        begin = time.perf_counter()
        predict(arguments[len(found) % len(arguments)])
        found.append(time.perf_counter() - begin)
    return sorted(found)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--batch", type=int, metavar="M", help="time M queries at once as well")
    parser.add_argument("n", type=int, nargs="+", help="number of points")
    arguments = parser.parse_args()
    for n in arguments.n:
        p = Problem(n)
        single = {"scikit-learn": scikit_learn, "NumPy": numpy_plain, "NumPy, best form": numpy_best}
        reference = None
        for peer, build in single.items():
            predict = build(p)
            f = predict(p.queries[0]).ravel()
            reference = f if reference is None else reference
            assert np.allclose(f, reference, rtol=1e-8), peer
            with threadpool_limits(1):
                t = times(predict, p.queries, seconds=1.0, least=50)
            line = {"peer": peer, "n": n, "microseconds_p50": t[len(t) // 2] * 1e6}
            line["microseconds_p99"] = t[len(t) * 99 // 100] * 1e6
            print(json.dumps(line), flush=True)
        if arguments.batch:
            xs = np.resize(p.queries, (arguments.batch, INPUTS))
            many = {"scikit-learn": scikit_learn, "NumPy, best form": numpy_best_batch}
            for peer, build in many.items():
                t = times(build(p), [xs], seconds=1.0, least=3)
                line = {"peer": peer, "n": n, "batch": arguments.batch}
                print(json.dumps(line | {"milliseconds": t[len(t) // 2] * 1e3}), flush=True)


main()
