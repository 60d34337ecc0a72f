#!/bin/bash
# Tables and pictures of validation/work-precision: time over error of every engine on six scenes.
#
#   validation/work-precision/run.sh [PROGRAM]     PROGRAM: default build/release/signorini
#
# Writes NAME.md and NAME.png beside itself; all files of the studies are in out/, which is removed first.
# One run at a time, on an idle machine; some fifteen minutes.
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd)
root=$(cd "$here/../.." && pwd)
program=$(realpath "${1:-$root/build/release/signorini}")
cd "$root"
out=validation/work-precision/out
rm -rf "$out"
mkdir -p "$out"

study() { # NAME SCENE [OPTION...]
  local name=$1 scene=$2
  shift 2
  echo "$name" >&2
  "$program" study "$scene" -o "$out/$name" --quiet "$@"
  sed "s#plots/work-precision.png#$name.png#" "$out/$name/study.md" >"$here/$name.md"
  cp "$out/$name/plots/work-precision.png" "$here/$name.png"
}

study pipeline models/pipeline.toml --rtol 1e-4:1e-10 --dt 1e-3:1e-7 --time-limit 120
study belt models/belt.toml
study den-hartog models/den-hartog.toml
study chain models/chain.toml --dt 1e-2:1e-5
study point-mass tests/cases/06_point_compliant_kn1e+06.toml
study rigid-frame models/rigid-frame.toml --dt 1e-3:1e-6
