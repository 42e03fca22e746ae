#!/usr/bin/env python3
"""Packed logs: writes packed_* beside this file, from a text and from what make_numpy.py wrote.

    pip install zstandard==0.25.0
"""

import gzip
import pathlib

import zstandard

here = pathlib.Path(__file__).parent
rows = "".join(f"{0.125 * k},{0.25 * k},{k},{0.25 * k + 1},{k - 2}\n" for k in range(5))
text = ("time,j1.position,j1.effort,j2.position,j2.effort\n" + rows).encode()
npz = (here / "numpy_turned.npz").read_bytes()


def zstd(content):
    return zstandard.ZstdCompressor(level=19).compress(content)


def gz(content):
    return gzip.compress(content, mtime=0)


write = {
    "packed_log.csv.gz": gz(text),
    # Two parts, as `cat a.gz b.gz` makes them.
    "packed_parts.csv.gz": gz(text[:100]) + gz(text[100:]),
    "packed_log.csv.zst": zstd(text[:100]) + zstd(text[100:]),
    "packed_log.npz.gz": gz(npz),
    "packed_twice.csv.gz": gz(zstd(text)),
    "packed_pickle.gz": gz(b"\x80\x04\x95" + bytes(100)),
    "packed_nothing.gz": gz(b""),
    # 200 MB of text in some kilobytes.
    "packed_bomb.csv.zst": zstd(text + rows.encode() * 3_000_000),
}
for name, content in write.items():
    (here / name).write_bytes(content)
