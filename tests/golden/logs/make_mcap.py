#!/usr/bin/env python3
"""Bags of ROS 2 in MCAP: writes mcap_*.mcap beside this file.

Of two joints, j = 0 and 1, at t = 0.125 k s, k = 0 to 4, the numbers are exact:

    position = 0.25 k + j    effort = k - 2 j    velocity = 2    (rad, N m, rad/s)

The joints change places with every message. Between two messages lies one of a gripper, and one
of another topic. Stamps begin at 1700000000.5 s; the times of recording are others.

    pip install mcap==1.6.0 mcap-ros2-support==0.6.0
"""

import pathlib
import struct

from mcap.writer import CompressionType
from mcap.writer import Writer as RawWriter
from mcap_ros2.writer import Writer

here = pathlib.Path(__file__).parent
TIME = "MSG: builtin_interfaces/Time\nint32 sec\nuint32 nanosec\n"
HEADER = "MSG: std_msgs/Header\nbuiltin_interfaces/Time stamp\nstring frame_id\n"
LINE = "=" * 80 + "\n"
STATE = (
    "std_msgs/Header header\nstring[] name\nfloat64[] position\nfloat64[] velocity\n"
    "float64[] effort\n" + LINE + HEADER + LINE + TIME
)
JOINT_STATE = "sensor_msgs/msg/JointState"


def state(k, joints):
    seconds, nanoseconds = divmod(500_000_000 + 125_000_000 * k, 10**9)
    stamp = {"sec": 1_700_000_000 + seconds, "nanosec": nanoseconds}
    return {
        "header": {"stamp": stamp, "frame_id": "base"},
        "name": [f"j{j + 1}" for j in joints],
        "position": [0.25 * k + j for j in joints],
        "velocity": [2.0 for _ in joints],
        "effort": [float(k - 2 * j) for j in joints],
    }


GRIPPER = {"name": ["finger"], "position": [0.1], "velocity": [], "effort": []}


def write(name, compression, topics=("/joint_states",), ks=range(5), **options):
    with open(here / name, "wb") as file:
        writer = Writer(file, compression=compression, **options)
        schema = writer.register_msgdef(JOINT_STATE, STATE)
        note = writer.register_msgdef("std_msgs/msg/String", "string data\n")
        for k in ks:
            at = 10**9 * (k + 1)
            for topic in topics:
                message = state(k, [0, 1] if k % 2 == 0 else [1, 0])
                writer.write_message(topic, schema, message, at, at)
                if topic == "/joint_states":
                    writer.write_message(topic, schema, {**message, **GRIPPER}, at + 1, at + 1)
            writer.write_message("/note", note, {"data": f"k = {k}"}, at + 2, at + 2)
        writer.finish()


write("mcap_zstd.mcap", CompressionType.ZSTD, chunk_size=500)
write("mcap_lz4.mcap", CompressionType.LZ4, chunk_size=500)
write("mcap_none.mcap", CompressionType.NONE)
write("mcap_one_topic.mcap", CompressionType.NONE, topics=["/arm/joint_states"])
write("mcap_two_topics.mcap", CompressionType.NONE, topics=["/left/states", "/right/states"])
write("mcap_0_to_2.mcap", CompressionType.NONE, ks=range(3))
write("mcap_3_to_4.mcap", CompressionType.NONE, ks=range(3, 5))

# Each joint in messages of its own.
with open(here / "mcap_apart.mcap", "wb") as file:
    writer = Writer(file, compression=CompressionType.NONE)
    schema = writer.register_msgdef(JOINT_STATE, STATE)
    for k in range(5):
        for j in [0, 1]:
            writer.write_message("/joint_states", schema, state(k, [j]), k, k)
    writer.finish()

# A note of 100 MB in some kilobytes.
with open(here / "mcap_bomb.mcap", "wb") as file:
    writer = Writer(file, compression=CompressionType.ZSTD)
    note = writer.register_msgdef("std_msgs/msg/String", "string data\n")
    writer.write_message("/note", note, {"data": " " * 100_000_000}, 0, 0)
    writer.finish()


def big_endian(k):
    """The message as CDR, the largest byte first."""
    body = b""

    def put(form, *values):
        nonlocal body
        size = struct.calcsize(">" + form)
        for value in values:
            body += bytes(-len(body) % size) + struct.pack(">" + form, value)

    def text(value):
        nonlocal body
        put("I", len(value) + 1)
        body += value.encode() + b"\0"

    message = state(k, [0, 1])
    put("i", message["header"]["stamp"]["sec"])
    put("I", message["header"]["stamp"]["nanosec"])
    text("base")
    put("I", 2)
    for name in message["name"]:
        text(name)
    for channel in ["position", "velocity", "effort"]:
        put("I", 2)
        put("d", *message[channel])
    return b"\0\0\0\0" + body


def write_raw(name, messages):
    with open(here / name, "wb") as file:
        writer = RawWriter(file, compression=CompressionType.NONE, use_chunking=False)
        writer.start("ros2")
        schema = writer.register_schema(JOINT_STATE, "ros2msg", STATE.encode())
        channel = writer.register_channel("/joint_states", "cdr", schema)
        for k, message in enumerate(messages):
            writer.add_message(channel, k, message, k)
        writer.finish()


write_raw("mcap_big_endian.mcap", [big_endian(k) for k in range(5)])
write_raw("mcap_short_message.mcap", [big_endian(0), big_endian(1)[:-9]])
