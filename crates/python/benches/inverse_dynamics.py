"""Times inverse dynamics of the WAM on 100,000 samples from Python, from Rust and in a loop over Pinocchio, turn by turn in
one run, and prints the least time of each. Needs the wheel, ``pip install pin``, and cargo."""

import subprocess
import time
from pathlib import Path

import numpy as np
import pinocchio

import plumbline

SAMPLES, TURNS, ROUNDS = 100_000, 5, 10
ROOT = Path(__file__).parents[3]
URDF = ROOT / "robots/wam7/robot.urdf"
BENCH = ["cargo", "bench", "-q", "--workspace", "--bench", "rnea_time"]

robot = plumbline.Robot(URDF)
model = pinocchio.buildModelFromUrdf(str(URDF))
data = model.createData()
random = np.random.default_rng(1)
q, qd, qdd = (random.uniform(-2, 2, (SAMPLES, len(robot.joints))) for _ in range(3))


def from_rust():
    """Seconds of the best of ten rounds, whose states are as random."""
    printed = subprocess.run(BENCH, cwd=ROOT, check=True, capture_output=True, text=True).stdout
    (line,) = (line for line in printed.splitlines() if line.startswith("arrays "))
    return 1e-9 * SAMPLES * float(line.split()[1])


def from_python():
    return plumbline.inverse_dynamics(robot, q, qd, qdd)


def pinocchio_loop():
    tau = np.empty_like(q)
    for k in range(SAMPLES):
        tau[k] = pinocchio.rnea(model, data, q[k], qd[k], qdd[k])
    return tau


def least(call, rounds):
    taken = []
    for _ in range(rounds):
        begin = time.perf_counter()
        call()
        taken.append(time.perf_counter() - begin)
    return min(taken)


difference = np.abs(from_python() - pinocchio_loop()).max()
from_rust()
turns = [(from_rust(), least(from_python, ROUNDS), least(pinocchio_loop, 1)) for _ in range(TURNS)]
rust, python, loop = map(min, zip(*turns))
print(f"from Rust                          {1e3 * rust:7.1f} ms")
print(f"from Python                        {1e3 * python:7.1f} ms   {python / rust:.2f} of Rust")
print(f"a loop over Pinocchio {pinocchio.__version__:12s} {1e3 * loop:7.1f} ms   {loop / python:.1f} of Python's")
print(f"largest difference to Pinocchio    {difference:.1e} N m")
