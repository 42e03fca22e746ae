#!/usr/bin/env python3
"""Entrant of CauseBench: Plumbline, by its program, as a user runs it.

    tests/benches/entrants/plumbline.py SET ANSWERS PROGRAM

    robot.toml, logs --plumbline diagnose--> diagnosis.json --> names, sizes
                                       \\--plumbline export--> MJCF --> model, and with MuJoCo the predicted efforts

Of the rivals of a name the first four are handed in, as many as an answer may have. What an MJCF leaves out of the
findings is left out of the prediction as well. Settings are the program's own.
"""

import json
import resource
import subprocess
import sys
import tempfile
from pathlib import Path

try:
    import numpy  # noqa: F401
except ImportError as lack:
    sys.exit(f"skipped: {lack}; pip install numpy, and mujoco for predictions")

from bench_set import answer_all, mjcf_torque

REFUSED = 3  # Exit code of logs or a robot that cannot be used.
MOST_RIVALS = 4


def place(at):
    return {key: at[key] for key in ("effect", "joint", "link") if key in at}


def sizes(finding):
    key = {"value": "value", "ci95": "interval", "nominal": "described"}
    told = [(name, one) for name, one in finding["parameters"].items() if one["determined"]]
    known = [(name, one) for name, one in told if None not in (one["value"], *one["ci95"])]
    return [{"parameter": name} | {key[k]: one[k] for k in key if one[k] is not None} for name, one in known]


def predict(trial, text):
    try:
        import mujoco
    except ImportError:
        return None
    held_out = trial.held_out()
    return trial.predict(held_out, mjcf_torque(mujoco.MjModel.from_xml_string(text), trial.joints, held_out))


def processor_s():
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    return used.ru_utime + used.ru_stime


def answer(trial):
    program, begin = sys.argv[3], processor_s()
    with tempfile.TemporaryDirectory() as out:
        logs = [str(path.with_suffix(".parquet")) for path in trial.log_files]
        diagnose = [program, "diagnose", "--robot", str(trial.description), "--log", *logs, "--out", out]
        ended = subprocess.run([*diagnose, "--no-recording", "--quiet"], capture_output=True, text=True)
        seconds = processor_s() - begin
        if ended.returncode == REFUSED:
            text = trial.mjcf.read_text()
            said = {"refused": True}
        else:
            if ended.returncode > 1:
                raise RuntimeError(ended.stderr.strip())
            found = json.loads((Path(out) / "diagnosis.json").read_text())
            names = [
                place(one) | {"sizes": sizes(one), "rivals": [place(at) for at in one["not_separable_from"]][:MOST_RIVALS]}
                for one in found["findings"]
            ]
            said = {"names": names, "left_open": found["verdict"] in ("unexplained", "partly_explained")}
            export = [program, "export", str(Path(out) / "extended.toml"), "--to", "mjcf"]
            subprocess.run(export, check=True, capture_output=True)
            text = next(Path(out).glob("*.xml")).read_text()
    return said | {"prediction": predict(trial, text), "model": trial.hand_in(text), "seconds": seconds}


answer_all(answer)
