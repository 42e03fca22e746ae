#!/usr/bin/env bash
# Hashes of the answers of a program, to be compared with those of another build:
#
#   tests/benches/answers.sh PROGRAM STORE > before.txt    # ... and of the other build > after.txt
#   diff before.txt after.txt
#
# With WITHOUT_REASONS=1 the words in which hypotheses are ruled out take no part: for a change that may alter reasons and
# must alter no finding, size or verdict.
#
# A line an answer: the SHA-256 of its diagnosis.json without the provenance, which holds the version, paths and the
# command, and what was diagnosed: the demo, the recorded sets of PLUMBLINE_DATA (../shared/data where it is unset) and
# every trial of STORE, a folder that `plumbline-bench work --store` has filled.
set -euo pipefail
program=$(realpath "$1")
store=${2:+$(realpath "$2")}
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
data=${PLUMBLINE_DATA:-../shared/data}
out=$(mktemp -d)
trap 'rm -rf "$out"' EXIT

# FILE: an answer without its provenance, which is the last entry.
print_answer() {
    if [[ ${WITHOUT_REASONS:-0} == 1 ]]; then
        sed -e '/^  "provenance": {/,$d' -e '/^  "ruled_out": \[/,/^  \]/{/^ *"because": /d}' "$1"
    else
        sed '/^  "provenance": {/,$d' "$1"
    fi
}

# NAME FOLDER: what lies in FOLDER is the answer NAME.
print_hash() {
    if [[ -f $2/diagnosis.json ]]; then
        printf '%s  %s\n' "$(print_answer "$2/diagnosis.json" | sha256sum | cut -d' ' -f1)" "$1"
    else
        printf 'no answer  %s\n' "$1"
    fi
    rm -rf "$2"
}

# NAME ROBOT LOG...
diagnose() {
    local name=$1 robot=$2
    shift 2
    "$program" diagnose --robot "$robot" --log "$@" --out "$out/answer" --quiet &>/dev/null || true
    print_hash "$name" "$out/answer"
}

"$program" demo --out "$out/demo" --quiet &>/dev/null || true
while IFS= read -r found; do print_hash demo "$(dirname "$found")"; done < <(find "$out/demo" -name diagnosis.json -not -path '*/stages/*')

for set in kuka_lwr4 kinova_gen3 staubli_tx40 ur10e_joint_by_joint panda; do
    robot=$data/$set/robot.toml
    [[ -f $robot ]] || robot=$data/$set/robot.urdf
    logs=("$data/$set"/*.parquet)
    [[ -f ${logs[0]} ]] && diagnose "$set" "$robot" "${logs[@]}"
done
log=$data/barrett_wam/shoulder_elbow_sweep.parquet
[[ -f $log ]] && diagnose barrett_wam robots/wam7/robot.toml "$log"
log=$data/ur10_bag/ur10_exciting_trajectory.db3.gz
[[ -f $log ]] && diagnose ur10_bag "$data/ur10_bag/ur10_robot.urdf" "$log"
log=$data/dfki_pendulum/ddp.parquet
[[ -f $log ]] && diagnose dfki_pendulum "$data/dfki_pendulum/robot.urdf" "$log"

[[ -n $store ]] || exit 0
for trial in "$store"/*/*/; do
    robot=$trial/nominal/robot.toml
    [[ -f $robot ]] || robot=$trial/nominal/robot.urdf
    diagnose "trial $(basename "$trial" | cut -c1-12)" "$robot" "$trial"/logs/*
done
