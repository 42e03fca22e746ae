"""Measures this project and its peers in turn and prints one table: `compare_peers.sh` beside this file builds what it needs.

    python3 compare_peers.py TARGET/release RNEA_TIME SPEED FOLDER_OF_PINOCCHIO ROUNDS

Every program has its turn in every round; its least time counts, since what disturbs a turn only adds to it. A floor is what
the additions and multiplications take at the peak of fused operations that the same run measures; no loop over the few numbers
of one state of an arm can reach it.
"""

import contextlib
import io
import json
import os
import re
import subprocess
import sys
import tempfile
import time
from pathlib import Path
from types import SimpleNamespace

ROOT = Path(__file__).resolve().parents[2]
GAUSSIAN_PROCESS = ROOT / "crates/gaussian_process/benches"
WAM = ROOT / "robots/wam7/robot.urdf"
HERE = "here"

POINTS, INPUTS, OUTPUTS, JOINTS = 3000, 21, 7, 7
# Fused operations of one exponential: `exp.rs` of gaussian_process.
EXPONENTIAL = 14
# Additions and multiplications of the recursive Newton-Euler method: 150 n - 48 and 131 n - 48 (Hollerbach 1980, table 1).
NEWTON_EULER = 281 * JOINTS - 96
# Three n by n matrices, each number the product of an axis and a force of six numbers, beside Newton-Euler.
DERIVATIVES = NEWTON_EULER + 3 * JOINTS**2 * 11
# A step of second order of the WAM, counted in the sources of crates/simulator/src/mechanics/tree.
STEP = 4200

STEP_MS = 0.1
ASKED_M = 1e-4
SAMPLES = 20_000

UNITS = {"s": 1.0, "ms": 1e-3, "µs": 1e-6, "ns": 1e-9}

release, rnea_time, speed, pinocchio_folder = Path(sys.argv[1]), sys.argv[2], sys.argv[3], Path(sys.argv[4])
rounds = int(sys.argv[5])
best, missing = {}, {}


def took(what, program, seconds):
    """Keeps the least time of a program at a task (s)."""
    of = best.setdefault(what, {})
    of[program] = min(seconds, of.get(program, float("inf")))


def left_out(program, why):
    missing.setdefault(program, str(why).strip().splitlines()[-1] if str(why).strip() else "no answer")


def lines(*command, threads=None):
    """The lines that a program prints, of JSON where they are."""
    several = {} if threads is None else {f"{name}_NUM_THREADS": str(threads) for name in ("RAYON", "OMP", "OPENBLAS", "MKL")}
    run = subprocess.run([str(part) for part in command], env=os.environ | several, capture_output=True, text=True)
    if run.returncode:
        raise OSError(run.stderr)
    printed = run.stdout.splitlines()
    return [json.loads(line) if line.startswith("{") else line for line in printed], run.stderr


def attempt(program, measure):
    try:
        measure()
    except (OSError, ImportError, KeyError, ValueError, AttributeError) as why:
        left_out(program, why)


def likelihood():
    what = f"log likelihood with gradient, {POINTS} points, {INPUTS} inputs, two threads"
    [[ours], _] = lines(release / "examples/evidence_speed", POINTS, 3, threads=2)
    took(what, HERE, ours["seconds"])
    [[alone], _] = lines(release / "examples/evidence_speed", 300, 3, threads=1)
    for threads, of in ((2, ours), (1, alone)):
        took(f"peak {threads}", HERE, 1 / of["fma_peak_gflops"])
    for peer, name in (("numpy", "NumPy with LAPACK, best form"), ("gpytorch", "GPyTorch"), ("scikit-learn", "scikit-learn")):

        def measure():
            printed, said = lines(sys.executable, "-W", "ignore", GAUSSIAN_PROCESS / "peers_likelihood.py", peer, POINTS, 1, 2)
            if not printed:
                raise OSError(said)
            value, expected = printed[0]["log_likelihood"], ours["log_likelihood"]
            if abs(value - expected) > 1e-6 * abs(expected):
                raise ValueError(f"log likelihood {value}, {expected} expected")
            took(what, name, printed[0]["seconds"])

        attempt(name, measure)
    return what


def query():
    what = f"one query of {OUTPUTS} outputs, {POINTS} points, {INPUTS} inputs, one thread"
    printed, _ = lines(release / "examples/query_speed", POINTS, threads=1)
    took(what, HERE, 1e-6 * printed[0]["microseconds_p50"])

    def measure():
        for line in lines(sys.executable, "-W", "ignore", GAUSSIAN_PROCESS / "peers_query.py", POINTS, threads=1)[0]:
            took(what, line["peer"], 1e-6 * line["microseconds_p50"])

    attempt("scikit-learn and NumPy at a query", measure)


def dynamics():
    tasks = {"rnea": "inverse dynamics of the WAM", "derivatives": "its derivatives by q, qd and qdd"}
    for line in lines(rnea_time, "--bench")[0]:
        kind, nanoseconds, _ = line.split()
        if kind in tasks:
            took(tasks[kind], HERE, 1e-9 * float(nanoseconds))
        else:
            took("inverse dynamics of the WAM, a sample of an array", "here, from Rust", 1e-9 * float(nanoseconds))
    for program, name in (("headers", "Pinocchio, headers compiled -O3"), ("library", "Pinocchio, the code in its wheel")):

        def measure():
            for line in lines(pinocchio_folder / program, WAM)[0]:
                kind, nanoseconds, _ = line.split()
                took(tasks[kind], name, 1e-9 * float(nanoseconds))

        attempt(name, measure)


def arrays():
    what = "inverse dynamics of the WAM, a sample of an array"
    import numpy as np

    random = np.random.default_rng(1)
    q, qd, qdd = (random.uniform(-2, 2, (SAMPLES, JOINTS)) for _ in range(3))

    def ours():
        import plumbline

        robot = plumbline.Robot(WAM)
        begin = time.perf_counter()
        plumbline.inverse_dynamics(robot, q, qd, qdd)
        took(what, "here, from Python", (time.perf_counter() - begin) / SAMPLES)

    def loop():
        import pinocchio

        model = pinocchio.buildModelFromUrdf(str(WAM))
        data, tau, begin = model.createData(), np.empty_like(q), time.perf_counter()
        for k in range(SAMPLES):
            tau[k] = pinocchio.rnea(model, data, q[k], qd[k], qdd[k])
        took(what, "a loop of Python over Pinocchio", (time.perf_counter() - begin) / SAMPLES)

    attempt("the module of Python (pip install a wheel)", ours)
    attempt("Pinocchio in Python", loop)


def simulation(folder):
    sys.path.insert(0, str(ROOT / "crates/simulator/benches"))
    import mujoco_steps
    import numpy as np

    robot = ROOT / "robots/wam7/robot.toml"
    model = mujoco_steps.compiled(release / "plumbline", robot, folder / "mjcf")
    for with_friction in (False, True):
        arm = mujoco_steps.case("wam7", robot, model, with_friction)
        (folder / "case.json").write_text(json.dumps(arm))
        outcomes = lines(release / "examples/steps", folder / "case.json")[0] + list(mujoco_steps.peers(model, arm))
        truth = next(o for o in outcomes if o["order"] == "second" and o["step_ms"] == 0.01)
        worn = "with dry friction" if with_friction else "without friction"
        names = {"second": HERE, "first": "here, rapier (first order)"}
        for one in outcomes:
            name = names.get(one["order"], one["order"])
            if one["step_ms"] == STEP_MS:
                took(f"a step of the WAM {worn}, {STEP_MS} ms", name, 1e-6 * one["us_per_step"])
            error = np.linalg.norm(np.subtract(one["tip_m"], truth["tip_m"]))
            if error <= ASKED_M and one is not truth:
                steps = 1e3 / one["step_ms"]
                took(f"a second of the WAM {worn}, tip to {ASKED_M} m", name, 1e-6 * one["us_per_step"] * steps)


def other_drives():
    """Arms with springs and gaps at two joints, which rapier alone steps, beside the same in MuJoCo."""
    sys.path.insert(0, str(ROOT / "crates/simulator/benches"))
    what = "a second of the WAM, {}, {} ms, processor time".format
    for line in lines(speed, "--bench", "--noplot", "joints")[0]:
        found = re.match(r"one second of the WAM/(.*?)\s*time:\s+\[\S+ \S+ (\S+) (\S+)", line)
        if found:
            took(what(found[1], STEP_MS), "here, rapier (first order)", float(found[2]) * UNITS[found[3]])
    import mujoco_speed

    for name, variant in mujoco_speed.ARMS.items():
        if what(name, STEP_MS) in best:
            for integrator, kind in mujoco_speed.INTEGRATORS.items():
                took(what(name, STEP_MS), f"MuJoCo {integrator}", 1 / mujoco_speed.speed(variant, kind)[0])


def demo(folder):
    """The logs of `plumbline demo`, as `mujoco.sysid` and a diagnosis read them."""
    made, program = folder / "demo", release / "plumbline"
    subprocess.run([program, "demo", "--quiet", "--out", made], check=True, capture_output=True)
    logs = sorted((made / "logs").glob("*.parquet"))
    robot = next(iter(sorted(made.glob("**/source/robot.toml")) + sorted(made.glob("**/robot.toml"))))
    subprocess.run([program, "export", robot, "--to", "mjcf", "--out", folder / "arm"], check=True, capture_output=True)
    return robot, logs[:3], next((folder / "arm").glob("*.xml"))


def identification(folder, robot, logs, mjcf):
    what = f"what is wrong with the demo's arm, from {len(logs)} logs, processor time"

    def processor(command):
        before = os.times()
        subprocess.run([str(part) for part in command], capture_output=True)
        after = os.times()
        return after.children_user + after.children_system - before.children_user - before.children_system

    out = folder / "diagnosis"
    took(what, HERE, processor([release / "plumbline", "diagnose", "--quiet", "--robot", robot, "--out", out, "--log", *logs]))

    def measure():
        sys.path.insert(0, str(ROOT / "tests/benches/entrants"))
        import mujoco
        import numpy as np
        import pyarrow.parquet
        import sysid

        if not hasattr(sysid.sysid, "optimize"):
            raise ImportError('pip install "mujoco[sysid]"')
        files = []
        for log in logs:
            table = pyarrow.parquet.read_table(log)
            files.append(folder / f"{log.stem}.npz")
            np.savez(files[-1], **{name: table[name].to_numpy() for name in table.column_names})
        model = mujoco.MjModel.from_xml_path(str(mjcf))
        joints = [model.joint(j).name for j in range(model.njnt)]
        links = [model.body(b).name for b in range(1, model.nbody)]
        trial = SimpleNamespace(name="demo", mjcf=mjcf, joints=joints, links=links, log_files=files)
        begin = time.process_time()
        with contextlib.redirect_stdout(io.StringIO()):
            sysid.identify(trial)
        took(what, "mujoco.sysid, every parameter free", time.process_time() - begin)

    attempt("mujoco.sysid", measure)


def spoken(seconds):
    unit, size = next((one for one in UNITS.items() if seconds >= one[1]), ("ns", 1e-9))
    return f"{seconds / size:.3g} {unit}"


def machine():
    text = Path("/proc/cpuinfo").read_text() if Path("/proc/cpuinfo").exists() else ""
    name = next((line.split(": ")[1] for line in text.splitlines() if line.startswith("model name")), "unknown")
    load = ", ".join(f"{one:.1f}" for one in os.getloadavg())
    return f"{name}, {os.cpu_count()} processors, load {load} (1, 5, 15 minutes)"


def main():
    print(f"{machine()} before")
    with tempfile.TemporaryDirectory() as folder:
        folder = Path(folder)
        found = {}
        attempt("the demo's logs", lambda: found.update(demo=demo(folder)))
        for _ in range(rounds):
            of_all = likelihood()
            query()
            dynamics()
            attempt("arrays in Python", arrays)
            attempt("MuJoCo", lambda: simulation(folder))
            attempt("MuJoCo with other drives", other_drives)
            if "demo" in found:
                identification(folder, *found["demo"])
    peaks = {threads: 1e9 / best.pop(f"peak {threads}")[HERE] for threads in (1, 2)}
    floors = {of_all: POINTS**3 / peaks[2]}
    counts = {
        "one query": 2 * OUTPUTS * POINTS * (INPUTS + EXPONENTIAL + 1),
        "inverse dynamics": NEWTON_EULER,
        "its derivatives": DERIVATIVES,
        "a step": STEP,
    }
    for what in best:
        for start, operations in counts.items():
            if what.startswith(start):
                floors[what] = operations / peaks[1]
    print(f"{machine()} after; {rounds} rounds, least times")
    print(f"peak of fused operations: {1e-9 * peaks[1]:.1f} GF/s on one thread, {1e-9 * peaks[2]:.1f} on two, two operations each\n")
    print("| measured | program | time | times ours | floor | times the floor |\n|---|---|---|---|---|---|")
    for what, of in best.items():
        own = of.get(HERE) or min(t for program, t in of.items() if program.startswith(HERE))
        for program, seconds in sorted(of.items(), key=lambda one: (not one[0].startswith(HERE), one[1])):
            floor = floors.get(what) if seconds == own else None
            cells = [spoken(floor), f"{seconds / floor:.1f}"] if floor else ["", ""]
            print(f"| {what} | {program} | {spoken(seconds)} | {seconds / own:.2f} | {cells[0]} | {cells[1]} |")
    for program, why in missing.items():
        print(f"\nleft out: {program}: {why}")


main()
