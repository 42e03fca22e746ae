#!/usr/bin/env python3
"""Processor time of the program at its limits, one thread: robots of many joints and links, wide tables, more and shorter
logs of the same samples.

    tests/benches/limits.py PROGRAM
"""

import math
import os
import resource
import subprocess
import sys
import tempfile
from pathlib import Path

ARM = """<robot name="arm"><link name="base"/><link name="a"><inertial><origin xyz="0.2 0 0"/><mass value="2"/>
<inertia ixx="0.1" iyy="0.1" izz="0.1" ixy="0" ixz="0" iyz="0"/></inertial></link>
<joint name="shoulder" type="revolute"><parent link="base"/><child link="a"/><axis xyz="0 1 0"/>
<limit lower="-3" upper="3" effort="50" velocity="5"/></joint>{}</robot>"""


def chain(joints: int) -> str:
    """So many joints, each about another axis than the one before."""
    text = '<robot name="chain"><link name="l0"/>'
    for k in range(1, joints + 1):
        axis = ("0 0 1", "0 1 0", "1 0 0")[k % 3]
        text += (
            f'<link name="l{k}"><inertial><origin xyz="0.01 0.02 0.1"/><mass value="{k}"/><inertia ixx="2" iyy="3" izz="2" '
            f'ixy="0.1" ixz="0" iyz="0"/></inertial></link><joint name="j{k}" type="continuous"><parent link="l{k - 1}"/>'
            f'<child link="l{k}"/><origin xyz="0 0 0.1" rpy="0.1 0.2 0"/><axis xyz="{axis}"/></joint>'
        )
    return text + "</robot>"


def fixed(links: int) -> str:
    one = '<link name="f{0}"/><joint name="g{0}" type="fixed"><parent link="base"/><child link="f{0}"/></joint>'
    return ARM.format("".join(one.format(k) for k in range(links)))


def table(columns: int, rows: int) -> str:
    line = ",".join(["0.5"] * columns)
    return "time," + ",".join(f"c{k}" for k in range(1, columns)) + "\n" + "\n".join([line] * rows)


def log(seconds: float, phase: float, start: float = 0.0) -> str:
    """The motion of a phase, from `start` (s) of it on."""
    lines = ["time,shoulder.position,shoulder.effort"]
    for k in range(int(100 * seconds)):
        t = start + 0.01 * k
        q = 0.8 * math.sin(2.1 * t + phase) + 0.3 * math.sin(5.3 * t + 2 * phase)
        lines.append(f"{t - start:.2f},{q:.9g},{-3.92 * math.cos(q) + 0.01 * math.sin(37 * t + phase):.9g}")
    return "\n".join(lines)


def main() -> None:
    program = os.path.abspath(sys.argv[1])
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)

        def write(file: str, text: str) -> str:
            (folder / file).write_text(text)
            return file

        def show(what: str, *arguments: str) -> None:
            before = resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime
            environment = {**os.environ, "RAYON_NUM_THREADS": "1"}
            run = subprocess.run([program, *arguments], cwd=folder, capture_output=True, env=environment)
            seconds = resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime - before
            print(f"{what:42} {seconds:7.2f} s   exit {run.returncode}", flush=True)

        write("arm.urdf", ARM.format(""))
        for joints in (50, 100):
            show(f"robot check, {joints} joints", "robot", "check", write("chain.urdf", chain(joints)))
        for links in (50_000, 200_000):
            show(f"robot check, {links} fixed links", "robot", "check", write("fixed.urdf", fixed(links)))
        show("log info, 10,000 columns", "log", "info", write("wide.csv", table(10_000, 400)))
        show("log info, 10,001 columns", "log", "info", write("wider.csv", table(10_001, 2)))
        diagnose = ("diagnose", "--robot", "arm.urdf", "--no-recording", "--quiet", "--out", "out", "--log")
        for count, seconds in ((100, 60.0), (200, 30.0), (400, 15.0), (2000, 3.0)):
            logs = [write(f"log_{count}_{k}.csv", log(seconds, 0.1 * k)) for k in range(count)]
            show(f"diagnose, {count} logs of {seconds:.0f} s", *diagnose, *logs)
        logs = [write(f"stretch_{k}.csv", log(3.0, 0.0, 3.0 * k)) for k in range(2000)]
        show("diagnose, 2000 stretches of one motion", *diagnose, *logs)


if __name__ == "__main__":
    main()
