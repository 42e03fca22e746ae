#!/usr/bin/env python3
"""Bags of ROS 2 in SQLite: writes sqlite_*.db3 beside this file, with the numbers of make_mcap.py.

    pip install rosbags==0.11.9
"""

import pathlib
import shutil
import sqlite3
import tempfile

from rosbags.rosbag2 import StoragePlugin, Writer
from rosbags.typesys import Stores, get_typestore

here = pathlib.Path(__file__).parent
types = get_typestore(Stores.ROS2_HUMBLE)
State, Note = types.types["sensor_msgs/msg/JointState"], types.types["std_msgs/msg/String"]
Header, Time = types.types["std_msgs/msg/Header"], types.types["builtin_interfaces/msg/Time"]


def state(k, names, position, velocity, effort, frame="base"):
    import numpy as np

    seconds, nanoseconds = divmod(500_000_000 + 125_000_000 * k, 10**9)
    header = Header(stamp=Time(sec=1_700_000_000 + seconds, nanosec=nanoseconds), frame_id=frame)
    of = lambda numbers: np.array(numbers, dtype=np.float64)
    return State(header=header, name=names, position=of(position), velocity=of(velocity), effort=of(effort))


def arm(k, frame):
    joints = [0, 1] if k % 2 == 0 else [1, 0]
    names = [f"j{j + 1}" for j in joints]
    return state(k, names, [0.25 * k + j for j in joints], [2.0, 2.0], [k - 2.0 * j for j in joints], frame)


def write(name, frame="base", notes=1, note="", page=4096):
    with tempfile.TemporaryDirectory() as folder:
        bag = pathlib.Path(folder) / "bag"
        with Writer(bag, version=8, storage_plugin=StoragePlugin.SQLITE3) as writer:
            states = writer.add_connection("/joint_states", State.__msgtype__, typestore=types)
            texts = writer.add_connection("/note", Note.__msgtype__, typestore=types)
            for k in range(5):
                at = 10**9 * (k + 1)
                pack = lambda message, kind: types.serialize_cdr(message, kind.__msgtype__)
                writer.write(states, at, pack(arm(k, frame), State))
                gripper = state(k, ["finger"], [0.1], [], [])
                writer.write(states, at + 1, pack(gripper, State))
                for count in range(notes):
                    writer.write(texts, at + 2 + count, pack(Note(data=f"k = {k} {note}"), Note))
        database = next(bag.glob("*.db3"))
        connection = sqlite3.connect(database, isolation_level=None)
        connection.execute(f"PRAGMA page_size = {page}")
        connection.execute("VACUUM")
        connection.close()
        shutil.copy(database, here / name)


write("sqlite_bag.db3", page=1024)
# Rows that go on in further pages, and a tree of three floors.
write("sqlite_small_pages.db3", frame="base" * 200, notes=15, note="." * 500, page=512)

connection = sqlite3.connect(here / "sqlite_other.db3")
connection.executescript("PRAGMA page_size = 512; DROP TABLE IF EXISTS t; CREATE TABLE t(a INTEGER); VACUUM;")
connection.close()
