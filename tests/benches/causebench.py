#!/usr/bin/env python3
"""CauseBench with all entrants that can run here: the set, the answers, the drifts, the scores, the page.

    tests/benches/causebench.py PLUMBLINE PLUMBLINE_BENCH --set smoke --out OUT
    tests/benches/causebench.py PLUMBLINE PLUMBLINE_BENCH --set recorded --data DIR --out OUT

PLUMBLINE and PLUMBLINE_BENCH are the programs. Entrants run by the Python that runs this script, two at a time; one whose
packages are absent is left out with a message. OUT gets set/, set.truth.json, answers/NAME/, drifts/NAME.json,
scores/NAME.json and benchmark.md, which is printed.
"""

import argparse
import importlib.metadata
import os
import subprocess
import sys
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

HERE = Path(__file__).resolve().parent
# Of each entrant its script, and what it is given beside set and answers.
ENTRANTS = {
    "plumbline": ["plumbline.py", "PROGRAM"],
    "least_squares": ["least_squares.py"],
    "figaroh": ["base_parameters.py"],
    "sysid_all": ["sysid.py"],
    "sysid_oracle": ["sysid.py", "TRUTH"],
    "gaussian_process": ["learned.py", "gp"],
    "neural_network": ["learned.py", "nn"],
    "nominal": ["nominal.py"],
    "coulomb": ["coulomb.py"],
}


# The packages whose versions the page tells.
PACKAGES = {
    "least_squares": ["pin", "numpy"],
    "figaroh": ["figaroh", "pin"],
    "sysid_all": ["mujoco"],
    "sysid_oracle": ["mujoco"],
    "gaussian_process": ["scikit-learn"],
    "neural_network": ["scikit-learn"],
    "nominal": ["mujoco"],
}


def program_of(name, options):
    """What answers, with versions."""
    if name == "plumbline":
        version = run([options.plumbline, "--version"]).stdout.strip()
        return f"{version}, {options.commit}" if options.commit else version
    return ", ".join(f"{one} {importlib.metadata.version(one)}" for one in PACKAGES.get(name, []))


def run(command, **more):
    # One thread each: the entrants share the processors.
    alone = dict(os.environ, OMP_NUM_THREADS="1", OPENBLAS_NUM_THREADS="1")
    return subprocess.run([str(one) for one in command], capture_output=True, text=True, env=alone, **more)


def enter(name, options):
    """Answers, drifts and scores of an entrant; says why there are none where it cannot run."""
    out, truth = options.out, options.out / "set.truth.json"
    script, *given = ENTRANTS[name]
    given = [{"PROGRAM": options.plumbline, "TRUTH": truth}.get(one, one) for one in given]
    answers = out / "answers" / name
    said = run([sys.executable, HERE / "entrants" / script, out / "set", answers, *given])
    told = (said.stdout + said.stderr).strip()
    if said.returncode != 0:
        return None, f"{name}: {told.splitlines()[-1] if told else 'it ended without a word'}"
    drifts = out / "drifts" / f"{name}.json"
    replayed = run([sys.executable, HERE / "replay_answers.py", out / "set", answers, truth, drifts])
    replay = ["--replay", drifts] if replayed.returncode == 0 else []
    words = program_of(name, options)
    program = ["--program", words] if words else []
    scored = run([options.bench, "score", out / "set", answers, "--truth", truth, *replay, *program, "--json"])
    if scored.returncode > 1:
        return None, f"{name}: {scored.stderr.strip()}"
    scores = out / "scores" / f"{name}.json"
    scores.write_text(scored.stdout)
    # What libraries say on the way is left out.
    lines = [f"{name}: {line}" for line in (told + "\n" + replayed.stdout).splitlines() if line.startswith("trial_")]
    return scores, "\n".join(lines + [f"{name}: done"])


parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
parser.add_argument("plumbline", type=Path)
parser.add_argument("bench", type=Path)
parser.add_argument("--set", default="smoke")
parser.add_argument("--data", type=Path, help="folder of the recorded logs, for the set recorded")
parser.add_argument("--commit", help="commit of PLUMBLINE, for the page")
parser.add_argument("--out", type=Path, required=True)
parser.add_argument("--entrants", nargs="+", choices=ENTRANTS, default=list(ENTRANTS))
options = parser.parse_args()
for folder in ("answers", "drifts", "scores"):
    (options.out / folder).mkdir(parents=True, exist_ok=True)
if not (options.out / "set/manifest.json").exists():
    data = ["--data", options.data] if options.data else []
    made = run([options.bench, "export", "--set", options.set, *data, "--out", options.out / "set", "--quiet"])
    if made.returncode != 0:
        sys.exit(made.stderr)
with ThreadPoolExecutor(2) as pool:
    entered = list(pool.map(lambda name: enter(name, options), options.entrants))
for _, told in entered:
    print(told, file=sys.stderr, flush=True)
scores = [path for path, _ in entered if path]
page = run([options.bench, "board", *scores], check=True).stdout
(options.out / "benchmark.md").write_text(page)
print(page)
