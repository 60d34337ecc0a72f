#!/usr/bin/env bash
# Kills runs with SIGKILL, and looks at what they leave: whole rows, but for a last one that ends with a page of the
# file, a summary that says "running", no manifest, and a directory that can be drawn and computed again.
# kill.sh PROGRAM [TIMES]      100 by default; fails when something else is left
set -euo pipefail
program="$(realpath "$1")"
times="${2:-100}"
root="$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)"
folder="$(mktemp -d)"
trap 'rm -rf "$folder"' EXIT
cd "$folder"

# A belt that goes on for days; more than a thousand rows a second, so that kills meet writes.
sed 's/^t_end = .*/t_end = 5e6\noutput_dt = 5.0/' "$root/models/belt.toml" >belt.toml
# A run that ended, whose manifest must go before another run changes its files.
"$program" run "$root/models/belt.toml" -o ended --no-plots --quiet
[[ -e ended/manifest.json ]] || { echo "kill.sh: a run that ended has no manifest" >&2; exit 1; }

shopt -s nullglob
page=$(getconf PAGESIZE) cut=0 wrong=0 early=0
complain() { echo "kill.sh: $*" >&2; wrong=$((wrong + 1)); }
lines() { if [[ -e "$1" ]]; then wc -l <"$1"; else echo 0; fi; }

for ((i = 0; i < times; ++i)); do
  if ((i % 3)); then rm -rf out; fi  # every third run replaces the one that was killed
  if ((i % 6 == 3)); then rm -rf out && cp -r ended out; fi  # every sixth one that ended
  "$program" run belt.toml -o out --force --no-plots >/dev/null 2>&1 &
  child=$!
  if ((i % 3)); then
    until (($(lines out/events.csv) > 5)); do sleep 0.005; done
  fi
  sleep "0.0$((RANDOM % 10))"
  kill -KILL "$child"
  wait "$child" 2>/dev/null || true
  [[ -n "$(ls -A out 2>/dev/null)" ]] || continue  # before there was anything
  for table in out/*.csv; do
    [[ -z "$(tail -c 1 "$table")" ]] && continue  # a line end
    if (($(stat -c %s "$table") % page)); then complain "$table is cut elsewhere than at a page"; fi
    cut=$((cut + 1))
  done
  if [[ -e out/manifest.json ]] || grep -q '"done"' out/summary.json; then
    # Killed before the run changed anything but the manifest.
    diff -r -x manifest.json -x '*.part' ended out >/dev/null || complain "files of two runs, of which one says that it has ended"
    early=$((early + 1))
    continue
  fi
  grep -q '"running"' out/summary.json || complain "summary.json does not say that the run was running"
  if ((i % 9 == 1)); then "$program" plot out >/dev/null 2>&1 || complain "what is left cannot be drawn"; fi
done
echo "killed $times times, $early of them before the run began: $cut last rows cut at the end of a page, $wrong other findings"
((wrong == 0))
