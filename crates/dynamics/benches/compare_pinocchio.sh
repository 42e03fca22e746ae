#!/usr/bin/env bash
# Times inverse dynamics of the WAM here and in Pinocchio's C++, turn by turn in one run,
# and prints the ratio. Needs: pip install pin cmeel-eigen; g++.
set -euo pipefail
cd "$(dirname "$0")/../../.."
prefix=$(python3 -c 'import pinocchio, pathlib; print([p for p in pathlib.Path(pinocchio.__file__).parents if p.name == "cmeel.prefix"][0])')
version=$(python3 -c 'import pinocchio; print(pinocchio.__version__)')
build=$(mktemp -d)
trap 'rm -rf "$build"' EXIT

# EIGEN_MAX_ALIGN_BYTES keeps the memory layout of the wheel's library under -march=native.
common=(-std=c++17 -O3 -DNDEBUG -DEIGEN_MAX_ALIGN_BYTES=16 -w
  -I"$prefix/include" -I"$prefix/include/eigen3" -L"$prefix/lib" -Wl,-rpath,"$prefix/lib"
  crates/dynamics/benches/pinocchio.cpp -lpinocchio_parsers -lpinocchio_default)
g++ -o "$build/portable" "${common[@]}"
g++ -march=native -o "$build/native" "${common[@]}"
cargo bench -q -p dynamics --bench rnea_time >/dev/null

urdf=robots/wam7/robot.urdf
for turn in 1 2 3 4 5 6 7; do
  echo "ours $(cargo bench -q -p dynamics --bench rnea_time)"
  echo "portable $("$build/portable" "$urdf")"
  echo "native $("$build/native" "$urdf")"
done >"$build/times"

# The fastest turn of each: what disturbs a turn only adds to it.
awk -v version="$version" '
  !($1 in best) || $2 < best[$1] { best[$1] = $2 }
  { sum[$1] = $3 }
  END {
    printf "inverse dynamics of the WAM (ns)   ours %.0f (checksum %s)\n", best["ours"], sum["ours"]
    printf "pinocchio %s, -O3                %.0f (checksum %s), ratio %.2f\n", version, best["portable"], sum["portable"], best["ours"] / best["portable"]
    printf "pinocchio %s, -O3 -march=native  %.0f (checksum %s), ratio %.2f\n", version, best["native"], sum["native"], best["ours"] / best["native"]
  }' "$build/times"
