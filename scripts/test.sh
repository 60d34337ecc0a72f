#!/usr/bin/env bash
# Installs what is missing, builds everything (Release, warnings are errors) and runs all tests but the deep ones (scripts/deep.sh).
set -euo pipefail

root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
"$root/scripts/setup.sh"
source "$root/scripts/configure.sh"

configure ci
cmake --build "$root/build/ci" -j "$(nproc)"
ctest --test-dir "$root/build/ci" --output-on-failure --no-tests=error -j 2 -LE '^deep'
