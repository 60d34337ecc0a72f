#!/bin/sh
# The tables of this page: what a cutoff costs in accuracy and brings in time, on the pipeline scene.
#
#   validation/reduction/run.sh [REPEATS]        some minutes
set -eu
root=$(cd "$(dirname "$0")/../.." && pwd)
cd "$root"
cmake --preset release > /dev/null
cmake --build build/release -t signorini_reduction > /dev/null
build/release/signorini_reduction "$@"
