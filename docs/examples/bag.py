#!/usr/bin/env python3
"""Bags of ROS 2 (MCAP) from logs that `plumbline simulate --csv` wrote: every STEP-th row of LOG.csv becomes a
`sensor_msgs/msg/JointState` (rad, rad/s, N m) of the topic /joint_states in LOG.mcap, as a driver publishes it.

    python3 bag.py STEP LOG.csv ...

Nothing but Python is needed. Format of the file: mcap.dev/spec; of a message: OMG CDR, the smallest byte first.
"""

import csv
import pathlib
import struct
import sys

MAGIC = b"\x89MCAP0\r\n"
HEADER, FOOTER, SCHEMA, CHANNEL, MESSAGE, DATA_END = 1, 2, 3, 4, 5, 15
# Of the first row (s since 1970).
START_S = 1_700_000_000
JOINT_STATE = """std_msgs/Header header
string[] name
float64[] position
float64[] velocity
float64[] effort
================================================================================
MSG: std_msgs/Header
builtin_interfaces/Time stamp
string frame_id
================================================================================
MSG: builtin_interfaces/Time
int32 sec
uint32 nanosec
"""


def text(value):
    return struct.pack("<I", len(value.encode())) + value.encode()


def record(kind, body):
    return struct.pack("<BQ", kind, len(body)) + body


def joint_state(stamp_ns, names, channels):
    """A message in CDR: every number lies at a multiple of its size, counted behind the four bytes of the kind."""
    body = b""

    def put(form, *values):
        nonlocal body
        size = struct.calcsize("<" + form)
        for value in values:
            body += bytes(-len(body) % size) + struct.pack("<" + form, value)

    def word(value):
        nonlocal body
        put("I", len(value) + 1)
        body += value.encode() + b"\0"

    put("I", *divmod(stamp_ns, 10**9))
    word("base")
    put("I", len(names))
    for name in names:
        word(name)
    for values in channels:
        put("I", len(values))
        put("d", *values)
    return b"\0\1\0\0" + body


def messages(rows):
    """Time (ns) and body of every row."""
    names = [column.removesuffix(".position") for column in rows[0] if column.endswith(".position")]
    for row in rows:
        stamp_ns = START_S * 10**9 + round(1e9 * float(row["time"]))
        channels = [
            [float(row[f"{name}.{channel}"]) for name in names]
            for channel in ("position", "velocity", "effort")
        ]
        yield stamp_ns, joint_state(stamp_ns, names, channels)


def bag(rows):
    yield MAGIC
    yield record(HEADER, text("ros2") + text("bag.py"))
    schema = JOINT_STATE.encode()
    yield record(SCHEMA, struct.pack("<H", 1) + text("sensor_msgs/msg/JointState") + text("ros2msg")
                 + struct.pack("<I", len(schema)) + schema)
    yield record(CHANNEL, struct.pack("<HH", 1, 1) + text("/joint_states") + text("cdr") + struct.pack("<I", 0))
    for number, (stamp_ns, body) in enumerate(messages(rows)):
        yield record(MESSAGE, struct.pack("<HIQQ", 1, number, stamp_ns, stamp_ns) + body)
    yield record(DATA_END, struct.pack("<I", 0))
    yield record(FOOTER, struct.pack("<QQI", 0, 0, 0))
    yield MAGIC


for log in map(pathlib.Path, sys.argv[2:]):
    with open(log, newline="") as file:
        rows = list(csv.DictReader(file))[:: int(sys.argv[1])]
    log.with_suffix(".mcap").write_bytes(b"".join(bag(rows)))
