#!/usr/bin/env bash
# Builds the fuzzers with clang (libFuzzer, ASan, UBSan) and runs each of them; fails when one finds something.
# fuzz.sh [SECONDS] [TARGET...]      15 minutes each and all of them by default; findings and grown corpora are
#                                    kept in build/fuzz
set -euo pipefail
root="$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)"
seconds="${1:-900}"
shift || true
targets=("$@")
((${#targets[@]})) || targets=(scene matrix table setting results)

cmake -S "$root" -B "$root/build/fuzz" -G Ninja -DCMAKE_BUILD_TYPE=RelWithDebInfo \
  "-DCMAKE_CXX_FLAGS_RELWITHDEBINFO=-O1 -gline-tables-only -DNDEBUG" -DSIGNORINI_TESTS=OFF \
  -DCMAKE_CXX_COMPILER=clang++-16 -DCMAKE_C_COMPILER=clang-16 -DSIGNORINI_FUZZ=ON -DSIGNORINI_TOGETHER=ON
cmake --build "$root/build/fuzz" -j "${JOBS:-2}" --target "${targets[@]/#/fuzz_}"

failed=()
for target in "${targets[@]}"; do
  grown="$root/build/fuzz/corpus/$target"
  mkdir -p "$grown"
  echo "== $target, $seconds s"
  "$root/build/fuzz/fuzz_$target" -max_total_time="$seconds" -timeout=20 -rss_limit_mb=2048 -max_len=8192 \
    -print_final_stats=1 -dict="$root/validation/robustness/words.dict" \
    -artifact_prefix="$root/build/fuzz/$target-" "$grown" "$root/tests/fuzz/corpus/$target" 2>&1 |
    grep -E "^stat::|ERROR|SUMMARY|Test unit" || true
  [[ "${PIPESTATUS[0]}" == 0 ]] || failed+=("$target")
done
((${#failed[@]} == 0)) || { echo "fuzz.sh: findings in ${failed[*]}, see build/fuzz" >&2; exit 1; }
