#!/usr/bin/env bash
# The program of the README, compiled against the installed library without a word on its standard, and run.
# readme.sh BUILD_FOLDER
set -euo pipefail
root="$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)"
work="$(mktemp -d)"
trap 'rm -rf "$work"' EXIT

cmake --install "$1" --prefix "$work/prefix" >/dev/null
awk '/^```cpp$/ { inside = 1; next } /^```$/ { inside = 0 } inside' "$root/README.md" >"$work/main.cpp"
grep -q simulate.hpp "$work/main.cpp"
cat >"$work/CMakeLists.txt" <<'END'
cmake_minimum_required(VERSION 3.25)
project(own CXX)
find_package(signorini REQUIRED)
add_executable(own main.cpp)
target_link_libraries(own PRIVATE signorini::signorini)
END
cmake -S "$work" -B "$work/build" -DCMAKE_PREFIX_PATH="$work/prefix" >/dev/null
cmake --build "$work/build" >/dev/null
events="$(cd "$root" && "$work/build/own" | wc -l)"
echo "$events events"
((events > 200))
