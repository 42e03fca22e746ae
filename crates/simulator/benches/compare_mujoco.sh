#!/usr/bin/env bash
# Simulated seconds per second of one core, here and in MuJoCo, for the same arms at 0.1 ms.
# Needs: pip install mujoco==4.0.0 numpy. About two minutes.
set -euo pipefail
cd "$(dirname "$0")/../../.."
rm -rf "target/criterion/one second of the WAM"
cargo bench -q -p simulator --bench speed >/dev/null 2>&1
python3 - <<'PYTHON'
import json
from pathlib import Path

print("rapier, step 0.1 ms\n\n| arm | simulated seconds per second |\n|---|---|")
for file in sorted(Path("target/criterion/one second of the WAM").glob("*/new/estimates.json")):
    benchmark = json.loads((file.parent / "benchmark.json").read_text())
    seconds = 1e-9 * json.loads(file.read_text())["median"]["point_estimate"]
    print(f"| {benchmark['function_id']} | {1 / seconds:.1f} |")
print()
PYTHON
python3 crates/simulator/benches/mujoco_speed.py
