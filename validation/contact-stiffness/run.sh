#!/bin/sh
# How displacements, peak forces and events of the pipeline scene move as its contacts stiffen, up to rigid ones.
#
#   validation/contact-stiffness/run.sh [PROGRAM]        about two minutes on two cores
set -eu
here=$(cd "$(dirname "$0")" && pwd)
program=${1:-$here/../../build/release/signorini}
scene=$here/../../models/pipeline.toml
out=$here/out
mkdir -p "$out"
stiffness=1e4,1e5,1e6,1e7,1e8
for key in normal tangential; do
  "$program" sweep "$scene" --vary "contacts.*.${key}_stiffness=$stiffness" --set run.engine=exact --set 'run.frames=[]' \
    -o "$out/$key"
done
for e in 0.0 0.5; do
  "$program" run "$here/pipeline-rigid.toml" --engine exact --set "contacts.*.restitution=$e" --force --no-plots \
    -o "$out/rigid-$e"
done
