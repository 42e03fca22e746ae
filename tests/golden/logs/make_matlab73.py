#!/usr/bin/env python3
"""Logs as arrays of MATLAB 7.3 (HDF5): writes matlab73_* beside this file, with the numbers of make_matlab.py.

    pip install hdf5storage==0.2.2 h5py==3.16.0
"""

import pathlib
import zlib

import h5py
import hdf5storage
import numpy as np

here = pathlib.Path(__file__).parent
k = np.arange(5.0)
time, q = 0.125 * k, np.stack([0.25 * k, 0.25 * k + 1], axis=1)
tau = np.stack([k, k - 2], axis=1)


def write(name, arrays, **options):
    (here / name).unlink(missing_ok=True)
    hdf5storage.savemat(str(here / name), arrays, format="7.3", oned_as="column", store_python_metadata=False, **options)
    # The header holds the date.
    content = (here / name).read_bytes()
    (here / name).write_bytes(b"MATLAB 7.3 MAT-file".ljust(116) + content[116:])


def number_of(file, name, numbers, kind="double", **options):
    """An array of MATLAB, its dimensions turned round."""
    array = file.create_dataset(name, data=np.atleast_2d(numbers), **options)
    array.attrs["MATLAB_class"] = np.bytes_(kind)
    return array


plain = {"time": time, "q": q, "tau": tau, "note": "text", "picture": np.zeros((3, 4, 5))}
write("matlab73_plain.mat", plain)
write("matlab73_struct.mat", {"log": {"time": time, "arm": {"q": q, "tau": tau}, "cells": np.array([1, "a"], dtype=object)}})

# Packed as MATLAB does: in chunks, by deflate. Arrays of two lie as 2 x 5.
write("matlab73_packed.mat", {"temperature": (20 + k).astype("u1"), "on": k > 2})
with h5py.File(here / "matlab73_packed.mat", "r+") as file:
    packed = {"chunks": True, "compression": 3}
    number_of(file, "time", time, **packed)
    number_of(file, "q", q.astype("f4"), "single", **packed)
    number_of(file, "tau", tau.astype("i2"), "int16", shuffle=True, **packed)

# 8 GB of numbers that were never written, in some kilobytes.
write("matlab73_large.mat", {"tau": tau})
with h5py.File(here / "matlab73_large.mat", "r+") as file:
    time_of = file.create_dataset("time", (1, 10**9), "f8", chunks=(1, 1000), compression=9)
    time_of.attrs["MATLAB_class"] = np.bytes_("double")

# A chunk of 8 kB that holds 100 MB.
write("matlab73_bomb.mat", {"tau": tau})
with h5py.File(here / "matlab73_bomb.mat", "r+") as file:
    bomb = number_of(file, "time", np.zeros(1000), chunks=(1, 1000), compression=9)
    bomb.id.write_direct_chunk((0, 0), zlib.compress(bytes(100_000_000), 9))
