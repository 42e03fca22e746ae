#!/usr/bin/env python3
"""Bags of ROS 2 in MCAP: writes mcap_*.mcap beside this file.

Of two joints, j = 0 and 1, at t = 0.125 k s, k = 0 to 4, the numbers are exact:

    position = 0.25 k + j    effort = k - 2 j    velocity = 2    (rad, N m, rad/s)

The joints change places with every message. Between two messages lies one of a gripper, and one
of another topic. Stamps begin at 1700000000.5 s; the times of recording are others.

    pip install mcap==1.6.0 mcap-ros2-support==0.6.0
"""

import json
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

POINT = (
    "MSG: trajectory_msgs/JointTrajectoryPoint\nfloat64[] positions\nfloat64[] velocities\n"
    "float64[] accelerations\nfloat64[] effort\nbuiltin_interfaces/Duration time_from_start\n"
)
DURATION = "MSG: builtin_interfaces/Duration\nint32 sec\nuint32 nanosec\n"
CONTROLLER_STATE = "control_msgs/msg/JointTrajectoryControllerState"


def point(**channels):
    empty = {name: [] for name in ["positions", "velocities", "accelerations", "effort"]}
    return {**empty, "time_from_start": {"sec": 0, "nanosec": 0}, **channels}


def write_controller(name, fields, efforts_in):
    """The state of a controller, of these fields; the desired position is .5 rad above the measured one."""
    kinds = [f"trajectory_msgs/JointTrajectoryPoint {field}\n" for field in fields]
    text = "std_msgs/Header header\nstring[] joint_names\n" + "".join(kinds)
    text = LINE.join([text, HEADER, TIME, POINT, DURATION])
    with open(here / name, "wb") as file:
        writer = Writer(file, compression=CompressionType.NONE)
        schema = writer.register_msgdef(CONTROLLER_STATE, text)
        for k in range(5):
            of = state(k, [0, 1])
            measured = point(positions=of["position"], velocities=of["velocity"])
            points = [point(positions=[q + 0.5 for q in of["position"]]), measured, point(), point()]
            message = {"header": of["header"], "joint_names": of["name"]}
            message |= {field: value.copy() for field, value in zip(fields, points)}
            message[efforts_in]["effort"] = of["effort"]
            writer.write_message("/controller/state", schema, message, k, k)
        writer.finish()


write_controller("mcap_controller.mcap", ["reference", "feedback", "error", "output"], "output")
write_controller("mcap_controller_old.mcap", ["desired", "actual", "error"], "actual")


def write_json(name, schema_name, message):
    """Messages in JSON, recorded .125 s after one another."""
    with open(here / name, "wb") as file:
        writer = RawWriter(file, compression=CompressionType.NONE, use_chunking=False)
        writer.start()
        schema = writer.register_schema(schema_name, "jsonschema", b'{"type": "object"}')
        channel = writer.register_channel("/joint_states", "json", schema)
        for k in range(5):
            at = 1_700_000_000 * 10**9 + 125_000_000 * k
            writer.add_message(channel, at, json.dumps(message(k)).encode(), at)
        writer.finish()


def listed(k):
    """As foxglove.JointStates has it, the joints in changing order."""
    of = state(k, [0, 1] if k % 2 == 0 else [1, 0])
    joints = zip(of["name"], of["position"], of["velocity"], of["effort"])
    keys = ["name", "position", "velocity", "effort"]
    stamp = of["header"]["stamp"]
    stamp = {"sec": stamp["sec"], "nsec": stamp["nanosec"]}
    return {"timestamp": stamp, "joints": [dict(zip(keys, joint)) for joint in joints]}


def without_a_stamp(k):
    return {key: value for key, value in state(k, [0, 1]).items() if key != "header"}


write_json("mcap_json.mcap", "sensor_msgs/JointState", lambda k: state(k, [0, 1]))
write_json("mcap_json_listed.mcap", "foxglove.JointStates", listed)
write_json("mcap_json_no_stamp.mcap", "JointState", without_a_stamp)
write_json("mcap_json_other.mcap", "JointState", lambda k: {"name": ["j1", 2]})
