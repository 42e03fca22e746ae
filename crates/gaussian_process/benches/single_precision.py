#!/usr/bin/env python3
"""What single precision costs a query in digits: points, distances and exponentials in f32, sums in f64.

Learns the torque of joints of a recorded arm from 3000 points by a Gaussian process of 21 inputs, and prints the largest
difference from f64 at 300 points of another log, as a share of the root mean square of the torque.

    pip install numpy pyarrow pandas scipy
    python3 crates/gaussian_process/benches/single_precision.py DATA/kuka_lwr4
"""

import sys
from pathlib import Path

import numpy as np
import pyarrow.parquet
from scipy.ndimage import gaussian_filter1d

JOINTS = [1, 3, 6]
NOISE = [1e-1, 1e-2, 1e-3, 1e-4]  # of the signal's variance
WIDTH = 3.0  # of every input, in its standard deviations


def read(file):
    table = pyarrow.parquet.read_table(file).to_pandas().to_numpy()
    step_s = np.median(np.diff(table[:, 0]))
    qd = gaussian_filter1d(table[:, 8:15], 3, axis=0)
    inputs = np.hstack([table[:, 1:8], qd, np.gradient(qd, step_s, axis=0)])
    return inputs, gaussian_filter1d(table[:, 15:22], 3, axis=0)


def thinned(inputs, torque, count):
    rows = np.linspace(0, len(inputs) - 1, count).astype(int)
    return inputs[rows], torque[rows]


def query(points, alpha, weights, x):
    return np.exp(((points - x) ** 2) @ weights) @ alpha


def query_in_single(points, alpha, weights, x, differences_first):
    """With each exponent summed by fused operations: rounded once an input."""
    difference = (points - x if differences_first else points.astype("f4") - x.astype("f4")).astype("f4")
    exponent = np.zeros(len(points), "f4")
    for d, weight in enumerate(weights.astype("f4").astype("f8")):
        square = (difference[:, d] * difference[:, d]).astype("f8")
        exponent = (exponent.astype("f8") + square * weight).astype("f4")
    return np.exp(exponent.astype("f8")).astype("f4").astype("f8") @ alpha


def main():
    folder = Path(sys.argv[1])
    points, torque = thinned(*read(folder / "measurements_1.parquet"), 3000)
    queries, truth = thinned(*read(folder / "measurements_2.parquet"), 300)
    mean, deviation = points.mean(0), points.std(0)
    points, queries = (points - mean) / deviation, (queries - mean) / deviation
    weights = np.full(21, -0.5 / WIDTH**2)
    scaled = points * np.sqrt(-2 * weights)
    squares = (scaled**2).sum(1)
    kernel = np.exp(-0.5 * np.maximum(squares[:, None] + squares - 2 * scaled @ scaled.T, 0))
    print("| noise | joint | sum of abs(alpha) | f32 | f32 of differences in f64 |\n|---|---|---|---|---|")
    for noise in NOISE:
        kernel[np.diag_indices_from(kernel)] = 1 + noise
        for joint in JOINTS:
            y = torque[:, joint]
            alpha = np.linalg.solve(kernel, (y - y.mean()) / y.std())
            exact = np.array([query(points, alpha, weights, x) for x in queries])
            size = np.sqrt((truth[:, joint] ** 2).mean()) / y.std()
            errors = []
            for first in (False, True):
                single = np.array([query_in_single(points, alpha, weights, x, first) for x in queries])
                errors.append(f"{np.abs(single - exact).max() / size:.1e}")
            print(f"| {noise:g} | {joint + 1} | {np.abs(alpha).sum():.1e} | " + " | ".join(errors) + " |")


if __name__ == "__main__":
    main()
