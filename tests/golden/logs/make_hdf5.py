#!/usr/bin/env python3
"""Logs as arrays of HDF5: writes hdf5_* beside this file, with the numbers of make_matlab.py.

    pip install h5py==3.16.0
"""

import pathlib
import zlib

import h5py
import numpy as np

here = pathlib.Path(__file__).parent
k = np.arange(5.0)
time, q = 0.125 * k, np.stack([0.25 * k, 0.25 * k + 1], axis=1)
tau = np.stack([k, k - 2], axis=1)


def write(name, **options):
    (here / name).unlink(missing_ok=True)
    return h5py.File(here / name, "w", **options)


with write("hdf5_plain.h5") as file:
    file["time"], file["q"], file["tau"] = time, q, tau
    file["note"], file["picture"], file["rate"] = "text", np.zeros((3, 4, 5)), 8.0

# Groups in groups, one of which holds itself, behind a block of the user's own.
with write("hdf5_groups.h5", userblock_size=512) as file:
    log = file.create_group("log")
    log["time"], log["arm/q"], log["arm/tau"] = time, q, tau
    log["arm/self"] = log

# Packed in chunks, with other types; tau lies as 2 x 5.
with write("hdf5_packed.h5") as file:
    packed = {"chunks": True, "compression": 3}
    file.create_dataset("time", data=time, **packed)
    file.create_dataset("q", data=q.astype(">f4"), **packed)
    file.create_dataset("tau", data=tau.T.astype("i2"), shuffle=True, **packed)
    file["temperature"] = (20 + k).astype("u1")

# 8 GB of numbers that were never written, in some kilobytes.
with write("hdf5_large.h5") as file:
    file["tau"] = tau
    file.create_dataset("time", 10**9, "f8", chunks=1000, compression=9)

# A chunk of 8 kB that holds 100 MB.
with write("hdf5_bomb.h5") as file:
    file["tau"] = tau
    bomb = file.create_dataset("time", data=np.zeros(1000), chunks=1000, compression=9)
    bomb.id.write_direct_chunk((0,), zlib.compress(bytes(100_000_000), 9))
