#!/usr/bin/env python3
"""Logs as arrays of MATLAB: writes matlab_* beside this file.

    pip install scipy
"""

import pathlib
import sys

import numpy as np
import scipy.io

here = pathlib.Path(__file__).parent
k = np.arange(5.0)
time, q = 0.125 * k, np.stack([0.25 * k, 0.25 * k + 1], axis=1)
tau = np.stack([k, k - 2], axis=1)


def write(name, arrays, **options):
    scipy.io.savemat(here / name, arrays, **options)
    # The header holds the date.
    content = (here / name).read_bytes()
    (here / name).write_bytes(b"MATLAB 5.0 MAT-file".ljust(116) + content[116:])


plain = {"time": time, "q": q, "tau": tau, "note": "text", "picture": np.zeros((3, 4, 5))}
write("matlab_plain.mat", plain)
turned = {"time": time[:, None], "q": q.T.astype("f4"), "tau": tau.T.astype("i2"), "temperature": (20 + k).astype("u1")}
write("matlab_packed.mat", turned, do_compression=True)
write("matlab_struct.mat", {"log": {"time": time, "arm": {"q": q, "tau": tau}, "cells": np.array([1, "a"], dtype=object)}})
write("matlab_bomb.mat", {"time": np.zeros(15_000_000)}, do_compression=True)
sys.stdout.write("written\n")
