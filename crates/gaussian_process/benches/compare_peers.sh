#!/usr/bin/env bash
# One log likelihood with gradient, here and in its peers, in turn, on two threads.
# Needs: pip install numpy scipy scikit-learn torch gpytorch; what is missing is left out.
# About three minutes: compare_peers.sh [POINTS] [ROUNDS]
set -euo pipefail
cd "$(dirname "$0")"
cargo build -q --release -p gaussian_process --example evidence_speed
target=$(cargo metadata --no-deps --offline --format-version 1 |
    python3 -c 'import json, sys; print(json.load(sys.stdin)["target_directory"])')
python3 - "$target/release/examples/evidence_speed" "${1:-3000}" "${2:-3}" <<'PYTHON'
import json
import os
import statistics
import subprocess
import sys

program, points, rounds = sys.argv[1], sys.argv[2], int(sys.argv[3])
threads = "2"


def run(*command):
    environment = os.environ | {"RAYON_NUM_THREADS": threads}
    output = subprocess.run(command, env=environment, check=True, stdout=subprocess.PIPE).stdout
    return json.loads(output) if output.strip() else None


peers = {"numpy": 5, "gpytorch": 3, "scikit-learn": 1}
ours, theirs = [], {peer: [] for peer in peers}
ratios = {peer: [] for peer in peers}
for _ in range(rounds):
    for peer, repeats in peers.items():
        here = run(program, points, "7")
        there = run("python3", "-W", "ignore", "peers_likelihood.py", peer, points, str(repeats), threads)
        ours.append(here)
        if there:
            theirs[peer].append(there)
            ratios[peer].append(there["seconds"] / here["seconds"])

median = statistics.median
print(f"log likelihood and gradient, {points} points, 21 inputs, {threads} threads, medians\n")
print("| program | seconds | times ours | peak memory (GB) | log likelihood |\n|---|---|---|---|---|")


def line(name, runs, ratio):
    seconds, memory = (median(run[key] for run in runs) for key in ("seconds", "peak_gb"))
    print(f"| {name} | {seconds:.3f} | {ratio:.1f} | {memory:.2f} | {runs[-1]['log_likelihood']:.6f} |")


line("here", ours, 1.0)
for peer, runs in theirs.items():
    if runs:
        line(peer, runs, median(ratios[peer]))
share, rate = (median(run[key] for run in ours) for key in ("share", "gflops"))
print(f"\nHere n³ operations at {rate:.0f} GF/s, {100 * share:.0f} % of the peak of the same runs.")
PYTHON
