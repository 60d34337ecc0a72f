#!/usr/bin/env bash
# Whether two builds of the program compute the same: same-results.sh OLD NEW [SCENE.toml...]
#
# OLD and NEW are programs (build/release/signorini of two trees, built with the same options). Each scene of models and
# tests/cases, or each one named, is run by both: with its own engine and pictures, and with every other engine without.
#   equal byte for byte   all CSV files, the exit code
#   equal but for texts   SVG files: what stands between <text> and </text>, in <title> and <desc>
#   equal but for         summary.json: versions, command_line, times of the clock, texts (strings with a space)
# Prints a line a difference; exit code 1 if there is one.
set -euo pipefail

[[ $# -ge 2 ]] || { sed -n '2,9s/^# \{0,1\}//p' "${BASH_SOURCE[0]}" >&2; exit 2; }
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
old=$(realpath "$1") new=$(realpath "$2")
for program in "$old" "$new"; do
  "$program" --version >/dev/null || { echo "same-results.sh: $program is not a program of Signorini that runs" >&2; exit 2; }
done
shift 2
scenes=("$@")
[[ ${#scenes[@]} -gt 0 ]] || scenes=("$root"/models/*.toml "$root"/models/calculix/*.toml "$root"/tests/cases/*.toml)
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

# 4000 steps: engines with fixed steps need one, and few scenes say it.
step_of() { awk -F= '/^\[/ { run = /^\[run\]/ } run && $1 ~ /^ *t_end *$/ { sub(/#.*/, "", $2); print $2 / 4000; exit }' "$1"; }

run_both() {  # SCENE NAME OPTION...
  local scene=$1 name=$2
  shift 2
  local program=$old
  for side in old new; do
    local code=0
    "$program" run "$scene" -o "$work/$side/$name" --force --quiet "$@" >"$work/$side-$name.out" 2>&1 || code=$?
    echo "$code" >"$work/$side-$name.code"
    program=$new
  done
}

mkdir -p "$work/old" "$work/new"
for scene in "${scenes[@]}"; do
  name=$(basename "$scene" .toml)
  dt=$(step_of "$scene")
  run_both "$scene" "$name" &
  (
    for engine in exact ida; do run_both "$scene" "$name+$engine" --engine "$engine" --no-plots; done
    [[ -z "$dt" ]] || for engine in newmark friction-iteration; do
      run_both "$scene" "$name+$engine" --engine "$engine" --set "run.dt=$dt" --no-plots
    done
  ) &
  wait
done

/usr/bin/python3 - "$work" <<'PYTHON'
import json, os, re, sys

work = sys.argv[1]
differences = runs = files = 0


def differs(line):
    global differences
    differences += 1
    print("same-results.sh: " + line)


def without_texts(svg):
    return re.sub(r"<(text|title|desc)\b.*?</\1>", "", svg, flags=re.S)


def plain(value):
    """A summary without versions, command line, times of the clock and sentences."""
    if isinstance(value, dict):
        return {k: plain(v) for k, v in value.items() if k not in ("versions", "command_line", "wall_time", "wait")}
    if isinstance(value, list):
        return [plain(v) for v in value]
    return "a text" if isinstance(value, str) and " " in value else value


def paths(value, path=""):
    if isinstance(value, dict):
        for k, v in value.items():
            yield from paths(v, f"{path}.{k}" if path else k)
    elif isinstance(value, list):
        yield path, len(value)
        for k, v in enumerate(value):
            yield from paths(v, f"{path}[{k}]")
    else:
        yield path, repr(value)


def tree(side, name):
    top = os.path.join(work, side, name)
    return {os.path.relpath(os.path.join(folder, file), top): os.path.join(folder, file)
            for folder, _, names in os.walk(top) for file in names}


for name in sorted(file[4:-5] for file in os.listdir(work) if file.startswith("old-") and file.endswith(".code")):
    runs += 1
    codes = [open(os.path.join(work, f"{side}-{name}.code")).read().strip() for side in ("old", "new")]
    if codes[0] != codes[1]:
        differs(f"{name}: exit code {codes[0]}, now {codes[1]}")
    old, new = tree("old", name), tree("new", name)
    for file in sorted(set(old) | set(new)):
        if not file.endswith((".csv", ".svg", "summary.json")):
            continue
        files += 1
        if file not in old or file not in new:
            differs(f"{name}/{file}: only of the {'old' if file in old else 'new'} program")
            continue
        a, b = open(old[file], "rb").read(), open(new[file], "rb").read()
        if a == b:
            continue
        if file.endswith(".csv"):
            rows = [text.decode().splitlines() for text in (a, b)]
            row = next((i for i, (x, y) in enumerate(zip(*rows)) if x != y), min(map(len, rows)))
            differs(f"{name}/{file}: line {row + 1}: {rows[0][row:row + 1]}, now {rows[1][row:row + 1]}")
        elif file.endswith(".svg"):
            if without_texts(a.decode()) != without_texts(b.decode()):
                differs(f"{name}/{file}: other lines than texts differ")
        else:
            x, y = (dict(paths(plain(json.loads(text)))) for text in (a, b))
            for key in sorted(set(x) | set(y)):
                if x.get(key) != y.get(key):
                    differs(f"{name}/{file}: {key}: {x.get(key)}, now {y.get(key)}")
print(f"{runs} runs, {files} files compared: " + ("all the same" if not differences else f"{differences} differences"))
sys.exit(1 if differences else 0)
PYTHON
