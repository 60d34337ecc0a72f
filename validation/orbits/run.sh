#!/bin/sh
# The frequency response of a pipeline on pads, which folds twice, beside sweeps up and down, and what it costs beside runs of
# one period.
#
#   validation/orbits/run.sh [PROGRAM]        some minutes on one core; prints the tables of README.md
set -eu
here=$(cd "$(dirname "$0")" && pwd)
program=${1:-$here/../../build/release/signorini}
out=$here/out
mkdir -p "$out"

seconds() { # NAME COMMAND...: CPU time of a command, in NAME.cpu
  name=$1
  shift
  sh -c '"$@" > "$0.txt" 2>&1; times' "$out/$name" "$@" | tail -1 > "$out/$name.cpu"
}

seconds response "$program" orbit "$here/pipeline-pads.toml" --over loads.1.history.omega=49.2:45.5 --step 0.04 --force --no-plots \
  -o "$out/response"
seconds hysteresis "$program" sweep "$here/pipeline-pads.toml" --strobe loads --carry --back --settle 50 --jobs 1 --force \
  --no-plots -o "$out/hysteresis" --vary loads.1.history.omega="$(python3 "$here/response.py" frequencies)"
# One period of the orbit at 47 rad/s, a thousand times: the load differs from run to run by less than matters.
"$program" orbit "$here/pipeline-pads.toml" --set loads.1.history.omega=47 --force --no-plots -o "$out/orbit" > "$out/orbit.txt"
seconds periods "$program" sweep "$out/orbit/run.toml" --vary loads.1.amplitude=2:2.000999:1e-6 --jobs 1 --force --no-plots \
  -o "$out/periods"
python3 "$here/response.py" "$out"
