#!/usr/bin/env bash
# What is too long to run at every change. deep.sh [clang] [tidy] [threads]; without arguments all of them.
#   clang    builds everything with clang, warnings are errors, and runs the fast tests
#   tidy     clang-tidy over all sources (.clang-tidy)
#   threads  simulations side by side under ThreadSanitizer
set -euo pipefail

root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
cd "$root"
source scripts/configure.sh
exec </dev/null

build_with_clang() {
  scripts/setup.sh clang
  configure clang
  cmake --build build/clang -j "$(nproc)" -t all signorini_differential signorini_overhead signorini_exact_cost \
    signorini_newmark_errors signorini_reduction signorini_hard_cases
  ctest --test-dir build/clang --output-on-failure --no-tests=error -LE '^slow' -j 2
}

tidy() {
  scripts/setup.sh clang clang-tidy
  configure clang
  cmake --build build/clang -j "$(nproc)" -t signorini_program  # precompiled headers
  run-clang-tidy -quiet -p build/clang -j "$(nproc)" "$root/src/.*"
}

threads() {
  configure tsan
  cmake --build build/tsan -j "$(nproc)"
  ctest --test-dir build/tsan --output-on-failure --no-tests=error -L '^behaviour/threads$'
}

scripts/setup.sh
[[ $# -gt 0 ]] || set -- clang tidy threads
for what in "$@"; do
  printf '\n== %s (%d s)\n' "$what" "$SECONDS"
  case "$what" in
    clang) build_with_clang ;;
    tidy) tidy ;;
    threads) threads ;;
    *) echo "deep.sh: no part is called '$what': clang, tidy, threads" >&2; exit 2 ;;
  esac
done
printf '\n== done (%d s)\n' "$SECONDS"
