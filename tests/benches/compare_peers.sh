#!/usr/bin/env bash
# Every peer beside this project, all in one run, as one table: Gaussian processes beside scikit-learn, GPyTorch and NumPy,
# inverse dynamics beside Pinocchio, the simulated arm beside MuJoCo, a diagnosis beside mujoco.sysid on the same logs.
#
#     pip install numpy scipy scikit-learn threadpoolctl torch gpytorch pin cmeel-eigen cmeel-urdfdom-headers \
#         "mujoco[sysid]" pyarrow
#     tests/benches/compare_peers.sh [ROUNDS]
#
# A peer that is absent is named below the table. PYTHON is the interpreter that has them (python3).
set -euo pipefail
cd "$(dirname "$0")/../.."
python=${PYTHON:-python3}
build=$(mktemp -d)
trap 'rm -rf "$build"' EXIT

cargo build -q --release
cargo build -q --release -p gaussian_process --example evidence_speed --example query_speed
cargo build -q --release -p simulator --example steps
bench() {
    cargo bench -q -p "$1" --bench "$2" --no-run --message-format=json |
        "$python" -c 'import json, sys; print([e for e in (json.loads(line).get("executable") for line in sys.stdin) if e][-1])'
}
rnea=$(bench dynamics rnea_time)
speed=$(bench simulator speed)
target=$(cargo metadata --no-deps --offline --format-version 1 |
    "$python" -c 'import json, sys; print(json.load(sys.stdin)["target_directory"])')

# The definitions are those of the wheel's own CMake files. No -march: the wheel's library is built for plain x86-64, as
# ours is, and Eigen crashes when the two differ. Headers of their own may lie in another folder than the wheel's.
pinocchio() {
    local path prefixes=() flags
    while read -r path; do prefixes+=("$path"); done < <("$python" - <<'PYTHON'
import sys
from pathlib import Path
for path in sys.path:
    prefix = Path(path or ".") / "cmeel.prefix"
    if prefix.is_dir():
        print(prefix)
PYTHON
    )
    flags=(-std=c++17 -O3 -DNDEBUG -w
        -DBOOST_MPL_LIMIT_LIST_SIZE=30 -DBOOST_MPL_LIMIT_VECTOR_SIZE=30 -DBOOST_FUSION_INVOKE_MAX_ARITY=12
        -DBOOST_MPL_CFG_NO_PREPROCESSED_HEADERS -DPINOCCHIO_WITH_URDFDOM)
    for path in "${prefixes[@]}"; do
        flags+=(-I"$path/include" -I"$path/include/eigen3" -I"$path/include/urdfdom" -I"$path/include/urdfdom_headers"
            -L"$path/lib" -Wl,-rpath,"$path/lib")
    done
    flags+=(crates/dynamics/benches/pinocchio.cpp -lpinocchio_parsers -lpinocchio_default)
    g++ -o "$build/headers" "${flags[@]}" && g++ -DPINOCCHIO_ENABLE_TEMPLATE_INSTANTIATION -o "$build/library" "${flags[@]}"
}
pinocchio 2>"$build/errors" || echo "Pinocchio's C++ is not there: $(grep -m1 -i error "$build/errors" || true)" >&2

"$python" -W ignore tests/benches/compare_peers.py "$target/release" "$rnea" "$speed" "$build" "${1:-3}"
