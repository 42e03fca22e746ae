#!/usr/bin/env python3
"""What `robot check` says of every URDF of example-robot-data: a table of exit codes, and the reason of each that is not 0.

    python3 -m pip install example-robot-data
    tests/benches/published_robots.py PROGRAM [OLDER_PROGRAM]

With a second program the table has its exit codes as well. Where the package is elsewhere, EXAMPLE_ROBOT_DATA names
the folder that has `robots` in it.
"""

import os
import subprocess
import sys
import sysconfig
from collections import Counter
from pathlib import Path

# Where the wheels of cmeel put the files, below site-packages.
IN_WHEEL = Path("cmeel.prefix/share/example-robot-data")

# Longest reason in the table (characters): one error lists the joints of a humanoid.
LONGEST = 150


def robots():
    """The folder of the package, or an end that says how to get it."""
    given = os.environ.get("EXAMPLE_ROBOT_DATA")
    folder = Path(given) if given else Path(sysconfig.get_paths()["purelib"]) / IN_WHEEL
    if not (folder / "robots").is_dir():
        sys.exit(f"{folder / 'robots'}: there is no such folder, python3 -m pip install example-robot-data makes it")
    return folder / "robots"


def check(program, urdf):
    """Exit code and what is wrong, in words."""
    answer = subprocess.run([program, "robot", "check", urdf.name], cwd=urdf.parent, capture_output=True, text=True)
    if answer.returncode > 1:
        return answer.returncode, answer.stderr.splitlines()[0].removeprefix("error: ")[:LONGEST]
    wrong = ("positive number", "below 0 was expected", "exceeds", "gyration", "no <inertial>")
    links = [line for line in answer.stdout.splitlines() if any(word in line for word in wrong)]
    told = [line.removeprefix("warning: ") for line in links if line.startswith("warning: ")]
    more = f"; and {len(told) - 1} more" if len(told) > 1 else ""
    return answer.returncode, told[0] + more if answer.returncode and told else ""


def main():
    if len(sys.argv) < 2:
        sys.exit(__doc__)
    programs = [str(Path(program).resolve()) for program in sys.argv[1:3]]
    folder = robots()
    counts = [Counter() for _ in programs]
    heads = ["now", "before"][: len(programs)]
    print(f"| URDF | {' | '.join(heads)} | why now |\n|---|{'---|' * (len(programs) + 1)}")
    for urdf in sorted(folder.rglob("*.urdf")):
        answers = [check(program, urdf) for program in programs]
        codes = [code for code, _ in answers]
        for count, code in zip(counts, codes):
            count[code] += 1
        if any(codes):
            print(f"| {urdf.relative_to(folder)} | {' | '.join(map(str, codes))} | {answers[0][1]} |")
    for head, count in zip(heads, counts):
        print(f"{head}: " + ", ".join(f"{count[code]} with {code}" for code in sorted(count)))


if __name__ == "__main__":
    main()
