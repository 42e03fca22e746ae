#!/usr/bin/env python3
"""Logs as NumPy writes them: writes numpy_*.np[yz] beside this file.

Of two joints, j = 0 and 1, at t = 0.125 k s, k = 0 to 4, the numbers are exact in every format:

    q[j] = 0.25 k + j        tau[j] = k - 2 j        (rad, N m)

    pip install numpy==2.4.6
"""

import pathlib

import numpy as np

here = pathlib.Path(__file__).parent
k = np.arange(5)
time = 0.125 * k
q = np.stack([0.25 * k, 0.25 * k + 1], axis=1)
tau = np.stack([k, k - 2], axis=1)

# Beside the columns: a scalar, names, an object (pickled), a picture, an array of another length,
# complex numbers, truths and no numbers at all.
others = {
    "dt": np.float64(0.125),
    "joint_names": np.array(["j1", "j2"]),
    "robot": np.array([{"name": "arm"}], dtype=object),
    "picture": np.zeros((5, 4, 3), "u1"),
    "short": np.zeros(3),
    "phase": np.zeros(5, "c16"),
    "contact": np.zeros(5, "?"),
    "nothing": np.zeros((5, 0)),
}
np.savez(here / "numpy_plain.npz", time=time, q=q, tau=tau, **others)
np.savez_compressed(
    here / "numpy_turned.npz",
    tau=tau.T.astype(">i4"),
    time=time.astype(">f8"),
    q=np.asfortranarray(q.astype("<f4")),
    temperature=(20 + k).astype("u2"),
)
record = np.zeros(5, dtype=[("time", "<f4"), ("note", "U3"), ("q", ">f8", (2,)), ("tau", "i1", 2)])
record["time"], record["q"], record["tau"] = time, q, tau
np.savez(here / "numpy_records.npz", log=record)
np.save(here / "numpy_records.npy", record)
np.save(here / "numpy_columns.npy", np.column_stack([time, q, tau]))
# Ten million zeros in ten kilobytes.
np.savez_compressed(here / "numpy_bomb.npz", time=np.zeros(10_000_000, "u1"))
np.save(here / "numpy_objects.npy", np.array([{"time": 0.0}], dtype=object))
