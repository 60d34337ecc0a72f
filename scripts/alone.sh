#!/usr/bin/env bash
# Each header compiles alone: it includes what it names. Builds that compile the files of a folder together (scripts/together.cmake)
# cannot notice an include that is missing; the presets debug and clang fail by it.
# alone.sh [--sources]: with .cpp files, too, which takes three times as long.
# As in a build, what it includes of the standard library is precompiled; not of include, which users compile.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
mkdir -p "$work/base"
sed -E 's/@[A-Z_]+@/0/' src/base/version.hpp.in >"$work/base/version.hpp"

flags=(-std=c++20 -w -ferror-limit=3 -Iinclude -Isrc -Itests -Ivalidation "-I$work" -isystem /usr/include/eigen3
  -isystem /usr/include/suitesparse -DTOML_HEADER_ONLY=0 -DTOML_SHARED_LIB=1 -DFMT_SHARED -DSIGNORINI_FUZZ_TARGET=scene)
for text in TEST_DATA MODELS CASES PUBLISHED PROGRAM; do flags+=("-DSIGNORINI_$text=\"\""); done

# precompile FILE TARGET NAME: with the headers that a CMakeLists.txt lists for the target.
precompile() {
  sed -n "/target_precompile_headers($2 PRIVATE/,/)/p" "$1" | grep -oE '<[^>]+>' | sed 's/^/#include /' >"$work/$3.hpp" ||
    { echo "alone.sh: $1 lists no precompiled headers of $2" >&2; exit 1; }
  clang++-16 "${flags[@]}" -fpch-instantiate-templates -x c++-header "$work/$3.hpp" -o "$work/$3.pch"
}
precompile CMakeLists.txt signorini src
precompile tests/CMakeLists.txt signorini_test_cases tests

# check FILE. A header is included by an empty file.
check() {
  local options=()
  case "$1" in
    include/* | tests/main.cpp) ;;
    tests/*) options=(-include-pch "$work/tests.pch") ;;
    *) options=(-include-pch "$work/src.pch") ;;
  esac
  case "$1" in
    *.hpp) options+=(-x c++ -include "$1" /dev/null) ;;
    *) options+=("$1") ;;
  esac
  clang++-16 "${flags[@]}" -fsyntax-only "${options[@]}" || { echo "alone.sh: $1 does not compile alone" >&2; return 1; }
}
{ declare -p work flags; declare -f check; } >"$work/check"

kinds=(-name '*.hpp')
[[ "${1:-}" == --sources ]] && kinds+=(-o -name '*.cpp')
find include src tests validation "${kinds[@]}" | sort |
  xargs -P "$(nproc)" -n 8 bash -c 'source "$0"; failed=0; for file; do check "$file" || failed=1; done; exit "$failed"' "$work/check"
