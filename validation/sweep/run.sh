#!/bin/sh
# What friction and the pulse's duration, both uncertain, leave of slip on the pipeline: 10 000 samples.
#
#   validation/sweep/run.sh [PROGRAM] [JOBS]        some nine minutes on one core; the same command goes on where it was stopped
set -eu
here=$(cd "$(dirname "$0")" && pwd)
program=${1:-$here/../../build/release/signorini}
mkdir -p "$here/out"
"$program" sweep "$here/../../models/pipeline.toml" --set run.engine=exact --jobs "${2:-$(nproc)}" \
  --sample 'contacts.*.friction=normal(0.3,0.03)' --sample 'loads.1.history.end=normal(0.1,0.01)' --samples 10000 --seed 1 \
  --response residual:first --response residual:second -o "$here/out/pipeline-samples"
cp "$here/out/pipeline-samples/plots/exceedance.png" "$here/"
