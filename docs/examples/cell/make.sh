#!/usr/bin/env bash
# The arm and the logs of docs/src/ten-minutes.md, run in a checkout: arm.urdf, a UR5e with a gripper, and before_1.csv to
# after_3.csv, 125 rows a second, with columns as a logger of one's own may call them.
set -euo pipefail
cell=docs/examples/cell
sed '/<\/robot>/d' robots/ur5e/robot.urdf | cat - $cell/gripper.xml > arm.urdf
for logs in before after; do
    plumbline simulate $cell/$logs.toml --out simulated/$logs --csv --quiet
    for run in 1 2 3; do
        awk 'NR % 4 == 1' simulated/$logs/run_$run.csv | cut -d, -f1-19 |
            sed '1s/^time/t/; 1s/\.position/_angle/g; 1s/\.velocity/_speed/g; 1s/\.effort/_torque/g' > ${logs}_$run.csv
    done
done
