#!/usr/bin/env bash
# Times inverse dynamics of the WAM and its derivatives here and in Pinocchio's C++, turn by turn in one run,
# and prints the ratios. Needs: pip install pin cmeel-eigen cmeel-urdfdom-headers; g++.
set -euo pipefail
cd "$(dirname "$0")/../../.."
prefix=$(python3 -c 'import pinocchio, pathlib; print([p for p in pathlib.Path(pinocchio.__file__).parents if p.name == "cmeel.prefix"][0])')
version=$(python3 -c 'import pinocchio; print(pinocchio.__version__)')
build=$(mktemp -d)
trap 'rm -rf "$build"' EXIT

# The definitions are those of the wheel's own CMake files. No -march: the wheel's library
# is built for plain x86-64, as ours is, and Eigen crashes when the two differ.
flags=(-std=c++17 -O3 -DNDEBUG -w
  -DBOOST_MPL_LIMIT_LIST_SIZE=30 -DBOOST_MPL_LIMIT_VECTOR_SIZE=30 -DBOOST_FUSION_INVOKE_MAX_ARITY=12
  -DBOOST_MPL_CFG_NO_PREPROCESSED_HEADERS -DPINOCCHIO_WITH_URDFDOM
  -I"$prefix/include" -I"$prefix/include/eigen3" -I"$prefix/include/urdfdom"
  -I"$prefix/include/urdfdom_headers" -L"$prefix/lib" -Wl,-rpath,"$prefix/lib"
  crates/dynamics/benches/pinocchio.cpp -lpinocchio_parsers -lpinocchio_default)
g++ -o "$build/headers" "${flags[@]}"
g++ -DPINOCCHIO_ENABLE_TEMPLATE_INSTANTIATION -o "$build/library" "${flags[@]}"
cargo bench -q -p dynamics --bench rnea_time >/dev/null

urdf=robots/wam7/robot.urdf
for turn in 1 2 3 4 5 6 7; do
  cargo bench -q -p dynamics --bench rnea_time | sed 's/^/ours /'
  "$build/headers" "$urdf" | sed 's/^/headers /'
  "$build/library" "$urdf" | sed 's/^/library /'
done >"$build/times"

# The fastest turn of each: what disturbs a turn only adds to it.
awk -v version="$version" '
  { key = $1 " " $2 }
  !(key in best) || $3 < best[key] { best[key] = $3 }
  { sum[key] = $4 }
  function row(what, name, by,  key, own) {
    key = by " " what; own = "ours " what
    printf "%-12s %-44s %7.0f ns   checksum %s   ratio %.2f\n", what, name, best[key], sum[key], best[own] / best[key]
  }
  function rows(what) {
    row(what, "this crate", "ours")
    row(what, "pinocchio " version ", headers compiled -O3 -DNDEBUG", "headers")
    row(what, "pinocchio " version ", the code in its wheel", "library")
  }
  END { rows("rnea"); rows("derivatives") }' "$build/times"
