#!/usr/bin/env python3
"""Entrant of CauseBench: Coulomb friction at every joint, whatever the logs say.

    tests/benches/entrants/coulomb.py SET ANSWERS

The whole of what an entrant has to do: read `manifest.json`, write an answer a trial, on a cluster of its part alone. It
needs nothing but Python.
"""

import json
import os
import sys
from pathlib import Path

folder, answers = map(Path, sys.argv[1:3])
answers.mkdir(parents=True, exist_ok=True)
part, parts = map(int, os.environ.get("CAUSE_BENCH_PART", "1/1").split("/"))
for trial in json.loads((folder / "manifest.json").read_text())["trials"][part - 1 :: parts]:
    names = [{"effect": "FR02", "joint": joint} for joint in trial["joints"]]
    answer = {"names": names, "seconds": 0.0}
    (answers / f"{trial['name']}.json").write_text(json.dumps(answer))
