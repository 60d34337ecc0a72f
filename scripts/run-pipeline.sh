#!/usr/bin/env bash
# Installs what is missing, builds the program and computes the pipeline scene into ./pipeline-run.
set -euo pipefail

root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
"$root/scripts/setup.sh"
source "$root/scripts/configure.sh"

configure release
cmake --build "$root/build/release" --target signorini_program -j "$(nproc)"
"$root/build/release/signorini" run "$root/models/pipeline.toml" -o "$root/pipeline-run" --force
echo
echo "Pictures: $root/pipeline-run/plots"
