#!/usr/bin/env bash
# Runs, draws and compares a scene whose names and title try to be something else: shell, gnuplot, formats, paths,
# markup. Nothing may be executed, written elsewhere, lost, or drawn wrongly quoted.
# names.sh PROGRAM
set -euo pipefail
program="$(realpath "$1")"
folder="$(mktemp -d)"
trap 'rm -rf "$folder"' EXIT
mkdir "$folder/in"
cd "$folder/in"

python3 - <<'PYTHON'
import json
names = [  # what scenes refuse (blanks . , ; * " ' = [ ] { } #) cannot come in
    "%s%n%d", "100%", "$(touch$IFS$9owned)", "`touch$IFS$9owned`", "/tmp/owned", "a/b", "a\\b", "-rf", "--help",
    "<script>alert(1)</script>", "&amp", "^2_1@", "@owned", "$1", "\u202eabc", "\u00fc\u4e2d\U0001f600", "x" * 200,
    "con", "NaN", "inf", "1e5", "|touch$IFS$9owned", "!touch$IFS$9owned", "~", "?", "t", "-",
]
json.dump(names, open("names.json", "w"))
quoted = [json.dumps(n, ensure_ascii=False) for n in names]
text = "schema = 1\ntitle = " + json.dumps("'`touch owned` $(touch owned) %s <b>&'") + "\n"
text += 'units = { force = "N", mass = "kg", length = "m", time = "s" }\ngravity = [0.0, -9.81]\n'
text += "[run]\nt_end = 0.3\noutput_dt = 0.01\nframes = [0.1, 0.2]\n[nodes]\n"
for i in range(len(names)):
    text += f"n{i} = [{i}.0, {0.01 * (i + 1)}]\n"
for i, n in enumerate(quoted):
    text += f"[[masses]]\nnode = \"n{i}\"\nmass = 1.0\n[[contacts]]\nname = {n}\nnode = \"n{i}\"\nlaw = \"rigid\"\n"
    text += f"normal = [0.0, 1.0]\ngap = {0.01 * (i + 1)}\nfriction = 0.3\nrestitution = 0.3\n"
open("names.toml", "w").write(text)
PYTHON

complain() { echo "names.sh: $*" >&2; exit 1; }
"$program" check names.toml >../said 2>&1 || complain "check fails: $(cat ../said)"
"$program" run names.toml -o out >../said 2>&1 || complain "run fails: $(cat ../said)"
"$program" plot out >../said 2>&1 || complain "plot fails: $(cat ../said)"
# Of more than 24 contacts the rest is drawn as the run says.
(cd out/plots && for script in *.gp; do [[ -e "${script%.gp}.svg" ]] || gnuplot "./$script"; done) >../said 2>&1 ||
  complain "gnuplot fails: $(cat ../said)"
"$program" compare names.toml --engines exact,ida -o both >../said 2>&1 || complain "compare fails: $(cat ../said)"
[[ -z "$(find "$folder" -iname '*owned' -not -path '*/plots/*')" && ! -e /tmp/owned ]] || complain "something was executed"
[[ "$(ls -A "$folder")" == $'in\nsaid' ]] || complain "something was written elsewhere: $(ls -A "$folder")"

python3 - <<'PYTHON'
import collections, csv, json, pathlib, sys, xml.etree.ElementTree
names = json.load(open("names.json"))
for table, column in (("contacts.csv", "contact"), ("events.csv", "contact"), ("motion.csv", "contact")):
    seen = collections.OrderedDict((row[column], 0) for row in csv.DictReader(open("out/" + table, newline="")) if row[column])
    if sorted(seen) != sorted(names):
        sys.exit(f"names.sh: {table} has other names: {set(seen) ^ set(names)}")
if [c["name"] for c in json.load(open("out/summary.json"))["contacts"]] != names:
    sys.exit("names.sh: summary.json has other names")
for script in pathlib.Path("out/plots").glob("*.gp"):
    for end in (".svg", ".png"):
        if not script.with_suffix(end).exists():
            sys.exit(f"names.sh: {script.with_suffix(end)} was not drawn")
    xml.etree.ElementTree.parse(script.with_suffix(".svg"))
text = "".join(xml.etree.ElementTree.parse("out/plots/states.svg").getroot().itertext())
for name in ("%s%n%d", "100%", "`touch$IFS$9owned`", "<script>alert(1)</script>", "$1"):
    if name not in text:
        sys.exit(f"names.sh: {name} is not in states.svg as it is")
print(f"{len(names)} names: nothing executed, nothing lost, {len(list(pathlib.Path('out/plots').glob('*.svg')))} pictures")
PYTHON
