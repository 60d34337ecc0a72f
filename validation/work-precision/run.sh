#!/bin/bash
# Tables and pictures of validation/work-precision: time over error of every engine on eight scenes.
#
#   validation/work-precision/run.sh [PROGRAM]     PROGRAM: default build/release/signorini
#
# Writes NAME.md and NAME.png beside itself; all files of the studies are in out/, which is removed first.
# One run at a time, on an idle machine; some twenty minutes.
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

study pipeline models/pipeline.toml --rtol 1e-4:1e-10 --dt 1e-3:1e-6 --time-limit 120
study pipeline-201 models/pipeline.toml --set members.1.elements=[16,50] --rtol 1e-4,1e-6,1e-8 --dt 1e-3:1e-6 --repeats 1
study pipeline-801 models/pipeline.toml --set members.1.elements=[66,200] --rtol 1e-4,1e-6 --dt 1e-3:1e-6 --repeats 2
study belt models/belt.toml
study den-hartog models/den-hartog.toml
study chain models/chain.toml --dt 1e-2:1e-5
study point-mass tests/cases/06_point_compliant_kn1e+06.toml
study rigid-frame models/rigid-frame.toml --dt 1e-3:1e-6

# What damping beta K costs `exact` and `ida`: two loads, one that makes events and one that is slow and long.
decay() { # NAME [OPTION...]
  local name=$1
  shift
  echo "decay $name" >&2
  "$program" sweep validation/work-precision/beam.toml --vary run.engine=exact,ida \
    --vary damping.beta=0,1e-6,1e-5,3e-5,1e-4,3e-4,1e-3 "$@" -o "$out/decay-$name" --jobs 1 --quiet --no-plots
}
decay lively
decay slow --set run.t_end=20 --set loads.1.history.omega=0.3 --set loads.1.amplitude=5
python3 - "$out" >"$here/decay.md" <<'PYTHON'
import csv, os, sys

print('# Damping beta K: exact beside ida\n')
print('beam.toml, rtol 1e-8. lively: as it is; slow: 20 s, a load of 0.3 rad/s and 5 kN.\n')
for name in ('lively', 'slow'):
    with open(os.path.join(sys.argv[1], 'decay-' + name, 'sweep.csv')) as f:
        rows = list(csv.DictReader(f))
    by = {(r['run.engine'], r['damping.beta']): r for r in rows}
    print('| %s: beta, s | events | exact: steps | s | ida: steps | s | exact / ida |' % name)
    print('|---|---|---|---|---|---|---|')
    for beta in dict.fromkeys(r['damping.beta'] for r in rows):
        e, i = by['exact', beta], by['ida', beta]
        print('| %s | %s | %s | %.3g | %s | %.3g | %.2f |' % (
            beta, i['events'], e['steps'], float(e['wall_time']), i['steps'], float(i['wall_time']),
            float(e['wall_time']) / float(i['wall_time'])))
    print()
PYTHON
