#!/usr/bin/env bash
# The recipe of models/calculix/strip.toml with CalculiX itself: the same matrices but for rounding, and the frequencies that it
# finds are those of `check`.
# calculix.sh PROGRAM
set -euo pipefail
root="$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)"
program="$(realpath "$1")"
work="$(mktemp -d)"
trap 'rm -rf "$work"' EXIT
cp "$root/models/calculix/"* "$work"
cd "$work"
mkdir kept && mv strip.*.mtx kept
ccx strip >/dev/null
./take.sh strip >names
sed 's/, SOLVER=MATRIXSTORAGE/\n4/' strip.inp >modes.inp
ccx modes >/dev/null
"$program" check strip.toml --json >check.json
"$program" run strip.toml --quiet --no-plots -o run --set run.t_end=0.02
python3 - <<'END'
import json, re
scene = open("strip.toml").read()
names = re.search(r"dofs = \[(.*?)\]", scene, re.S).group(1).replace("\n", " ").split()
assert names == open("names").read().split("[")[1].rstrip("]\n").split(), "degrees of freedom"
for matrix in "KM":
    rows = [[list(map(float, line.split())) for line in open(folder + f"strip.{matrix}.mtx").readlines()[1:]] for folder in ("kept/", "")]
    entries = [{(i, j): x for i, j, x in part[1:]} for part in rows]
    greatest = max(abs(x) for x in entries[0].values())
    for place in entries[0].keys() | entries[1].keys():
        assert abs(entries[0].get(place, 0) - entries[1].get(place, 0)) < 1e-12 * greatest, (matrix, place)
printed = [float(line.split()[2]) for line in open("modes.dat").read().split("PARTICIPATION")[0].splitlines()
           if re.match(r"\s+\d+\s+\S+\s+\S+\s+\S+\s+\S+$", line)][:4]
found = [mode["omega"] for mode in json.load(open("check.json"))["frequencies"]["open"]["modes"]][:4]
assert len(printed) == 4 and all(abs(a - b) < 1e-6 * b for a, b in zip(found, printed)), (found, printed)
print("frequencies of CalculiX", printed, "rad/s; of the scene", found)
END
